// Constants and small functions that the whole library leans on.

const PI: f32 = 3.14159265358979323846;
const INV_PI: f32 = 0.31830988618379067154;

// Shortest squared length that is still divided by: below it lie the denormal numbers, which a GPU may flush to 0.
const LENGTH2_FLOOR: f32 = 1e-37;
// Longest squared length that is still divided by: above it the sum of squares overflows to infinity.
const LENGTH2_CEILING: f32 = 1e37;
// Every number of the library's domain is smaller; f32 ends at 3.4e38.
const FINITE_CEILING: f32 = 3e38;

/// x^5 by three products.
///
/// `pow(x, 5)` is exp2(5 log2(x)) on a GPU: NaN for x < 0, and some 10 ulp worse.
fn pow5(x: f32) -> f32 {
    let x2 = x * x;
    return x2 * x2 * x;
}

/// v / |v|, or `fallback` where v has no direction: zero, NaN, infinite, or of a length outside 3e-19 .. 3e18.
///
/// `fallback` is returned as it is. A comparison with NaN is false, so NaN takes the fallback too; `max` would not do,
/// WGSL leaves its result for NaN open.
fn normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
    let length2 = dot(v, v);
    let has_direction = clamp(length2, LENGTH2_FLOOR, LENGTH2_CEILING) == length2;
    return select(fallback, normalize(v), has_direction);
}

/// A unit direction across a unit normal, any.
fn any_tangent(normal: vec3f) -> vec3f {
    let aside = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.x) > 0.7);
    return normalize(cross(normal, aside));
}

/// The colour with each channel that is NaN or infinite set to 0.
///
/// What a shader ends in, so that one bad texel stays one dark pixel and does not spread through a filter. (The Rust lobes,
/// which are called one by one, each end in it.)
fn finite_or_zero(c: vec3f) -> vec3f {
    return select(vec3f(0.0), c, abs(c) < vec3f(FINITE_CEILING));
}
