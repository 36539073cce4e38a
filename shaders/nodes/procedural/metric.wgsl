// Lengths by other metrics than Euclid's, for patterns of cells.

// Least and greatest exponent of Minkowski's metric: from 32 on it is Chebyshev's to 4 %; below 0.5 stars are as thin as pixels.
const LEAST_EXPONENT: f32 = 0.5;
const GREATEST_EXPONENT: f32 = 32.0;

/// The length of a vector by a metric: 0 Euclid's; 1 Manhattan's, |x| + |y| + |z|; 2 Chebyshev's, the greatest of them; 3 Minkowski's,
///   (|x|^e + |y|^e + |z|^e)^(1/e)
/// of which the others are e = 2, 1 and infinity. Any other number is 0.
fn metric_length(v: vec3f, metric: i32, exponent: f32) -> f32 {
    let a = abs(v);
    let greatest = max(a.x, max(a.y, a.z));
    if metric == 1 {
        return a.x + a.y + a.z;
    }
    if metric == 2 {
        return greatest;
    }
    if metric == 3 {
        // Parts of the greatest, at least 1e-12, so that no logarithm is of 0 and no power of all ends at 0.
        let parts = pow(clamp(a / max(greatest, 1e-12), vec3f(1e-12), vec3f(1.0)), vec3f(exponent));
        return greatest * pow(parts.x + parts.y + parts.z, 1.0 / exponent);
    }
    return length(v);
}

/// 1 over the exponent of a metric among Minkowski's.
fn inverse_exponent(metric: i32, exponent: f32) -> f32 {
    return select(select(select(0.5, 1.0, metric == 1), 0.0, metric == 2), 1.0 / exponent, metric == 3);
}

/// 0, -1, 1, -2, 2: from the middle outward.
fn outward(i: i32) -> i32 {
    return select(i / 2, -((i + 1) / 2), (i & 1) == 1);
}

/// How far, at least, a point of a unit cell lies from f, by any of the metrics: along one axis.
fn gap_to_cell(offset: vec3f, f: vec3f) -> f32 {
    let gap = abs(offset + 0.5 - f) - 0.5;
    return max(gap.x, max(gap.y, gap.z));
}
