// Cells that flow into each other: instead of the nearest point's, the mean of what all points around have, each weighted by exp(-d/s). So
// the order in which cells are looked into does not matter. A point's weight fades to 0 at the distance 2, where points begin to be missed.

/// The outputs of the node procedural/voronoi_smooth_2d.
struct VoronoiSmooth2dOutputs {
    /// smooth distance to the points around in cells, 0 to 2; a little more than that to the nearest
    f1: f32,
    /// a random value of the cell that flows into its neighbours', 0 to 1
    id: f32,
    /// the point of the cell as coordinates, which flows likewise
    point: vec2f,
}

/// Smooth Voronoi 2D
///
/// Voronoi cells without edges: distance, value and point of the nearest point flow into those of its neighbours. Drops, scales, hammered
/// metal, camouflage. The mean over the points around with the weights
///   exp(-d / smoothness) (1 - (d/2)^2)^2
/// All fade to their means where cells are smaller than pixels, the point to the coordinates. 25 cells are looked into.
/// @node procedural/voronoi_smooth_2d   @also worley, cellular, smooth f1, soft, blobs, hammered
/// - uv: coordinates [context uv0]
/// - scale: cells per unit [8; 0..64]
/// - jitter: 0 a square lattice, 1 random; held in 0..1 [1; 0..1]
/// - smoothness: over how many cells neighbours flow together; held in 0..1, and 0 is Voronoi 2D [0.1; 0..1]
/// - metric: 0 Euclid's, 1 Manhattan's, 2 Chebyshev's, 3 Minkowski's [0; 0..3]
/// - exponent: of Minkowski's metric; held in 0.5..32 [0.5; 0.5..4]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_smooth_2d_vertex
fn node_procedural_voronoi_smooth_2d(uv: vec2f, scale: f32, jitter: f32, smoothness: f32, metric: i32, exponent: f32, seed: i32) -> VoronoiSmooth2dOutputs {
    let cells = node_procedural_voronoi_smooth_2d_vertex(uv, scale, jitter, smoothness, metric, exponent, seed);
    let window = squared_footprint2(held2(uv * scale));
    let q = inverse_exponent(metric, clamp(exponent, LEAST_EXPONENT, GREATEST_EXPONENT));
    let j = clamp(jitter, 0.0, 1.0);
    let s = clamp(smoothness, 0.0, 1.0);
    let flow = s / (s + 0.4);
    // The mean over the pattern by metric, jitter and smoothness, measured; right to 0.06.
    let mean = 0.2366 + q * (0.0501 + 0.1423 * q) + j * j * (0.0601 - 0.012 * q - 0.0372 * flow) + flow * (0.7047 - q * (0.1894 + 0.05 * q));
    let left = left_of_cells(window);
    return VoronoiSmooth2dOutputs(mix(mean, cells.f1, left_of_noise(1.35, window)), mix(0.5, cells.id, left), mix(uv, cells.point, left));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_smooth_2d_vertex(uv: vec2f, scale: f32, jitter: f32, smoothness: f32, metric: i32, exponent: f32, seed: i32) -> VoronoiSmooth2dOutputs {
    let p = held2(uv * scale);
    let cell = vec2i(floor(p));
    let f = fract(p);
    let e = clamp(exponent, LEAST_EXPONENT, GREATEST_EXPONENT);
    let spread = clamp(jitter, 0.0, 1.0);
    let per_cell = 1.0 / clamp(smoothness, 1e-3, 1.0);
    var nearest = 2.0;
    // Distance, value and place, times the weights over the nearest's; and the weights.
    var total = vec4f(0.0);
    var weight = 0.0;
    for (var i = 0; i < 5; i++) {
        for (var k = 0; k < 5; k++) {
            let offset = vec2i(outward(k), outward(i));
            let feature = cell_point(cell + offset, spread, seed);
            let place = vec2f(offset) + feature.xy;
            let d = metric_length(vec3f(place - f, 0.0), metric, e);
            let closest = min(nearest, d);
            let kept = exp((closest - nearest) * per_cell);
            let w = exp((closest - d) * per_cell) * weight_within_two(d);
            total = total * kept + w * vec4f(d, feature.z, place);
            weight = weight * kept + w;
            nearest = closest;
        }
    }
    // 1e-12: no point within 2, and the distance is 2.
    let mean = select(vec4f(2.0, 0.5, 0.5, 0.5), total / max(weight, 1e-12), weight > 1e-12);
    let point = (vec2f(cell) + mean.zw) / select(scale, 1.0, abs(scale) < DIVISOR_FLOOR);
    return VoronoiSmooth2dOutputs(mean.x, mean.y, point);
}

/// 1 at 0, fading to 0 at 2.
fn weight_within_two(d: f32) -> f32 {
    let rest = max(1.0 - 0.25 * d * d, 0.0);
    return rest * rest;
}

/// The outputs of the node procedural/voronoi_smooth_3d.
struct VoronoiSmooth3dOutputs {
    /// smooth distance to the points around in cells, 0 to 2; a little more than that to the nearest
    f1: f32,
    /// a random value of the cell that flows into its neighbours', 0 to 1
    id: f32,
    /// the point of the cell in the space of the position, which flows likewise
    point: vec3f,
}

/// Smooth Voronoi 3D
///
/// Voronoi cells of space without edges: distance, value and point of the nearest point flow into those of its neighbours: the mean over the
/// points around with the weights
///   exp(-d / smoothness) (1 - (d/2)^2)^2
/// All fade to their means where cells are smaller than pixels, the point to the position. Up to 125 cells are looked into, those that weigh
/// less than 1e-6 left out: costly from a smoothness of 0.1 on.
/// @node procedural/voronoi_smooth_3d   @also worley, cellular, smooth f1, soft, blobs, hammered
/// - position: the point [context object_position]
/// - scale: cells per metre [8; 0..64]
/// - jitter: 0 a cubic lattice, 1 random; held in 0..1 [1; 0..1]
/// - smoothness: over how many cells neighbours flow together; held in 0..1, and 0 is Voronoi 3D [0.1; 0..1]
/// - metric: 0 Euclid's, 1 Manhattan's, 2 Chebyshev's, 3 Minkowski's [0; 0..3]
/// - exponent: of Minkowski's metric; held in 0.75..32, for stars of less reach further than 2 [0.75; 0.75..4]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_smooth_3d_vertex
fn node_procedural_voronoi_smooth_3d(position: vec3f, scale: f32, jitter: f32, smoothness: f32, metric: i32, exponent: f32, seed: i32) -> VoronoiSmooth3dOutputs {
    let cells = node_procedural_voronoi_smooth_3d_vertex(position, scale, jitter, smoothness, metric, exponent, seed);
    let window = squared_footprint(held3(position * scale));
    let q = inverse_exponent(metric, clamp(exponent, 0.75, GREATEST_EXPONENT));
    let j = clamp(jitter, 0.0, 1.0);
    let s = clamp(smoothness, 0.0, 1.0);
    let flow = s / (s + 0.4);
    // The mean over the pattern by metric, jitter and smoothness, measured; right to 0.05.
    let mean = 0.2703 + q * (0.0395 + 0.3751 * q) + j * j * (0.055 - 0.0259 * q - 0.0449 * flow) + flow * (0.9654 - q * (0.2802 + 0.2238 * q));
    let left = left_of_cells(window);
    return VoronoiSmooth3dOutputs(mix(mean, cells.f1, left_of_noise(1.35, window)), mix(0.5, cells.id, left), mix(position, cells.point, left));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_smooth_3d_vertex(position: vec3f, scale: f32, jitter: f32, smoothness: f32, metric: i32, exponent: f32, seed: i32) -> VoronoiSmooth3dOutputs {
    let p = held3(position * scale);
    let cell = vec3i(floor(p));
    let f = fract(p);
    let e = clamp(exponent, 0.75, GREATEST_EXPONENT);
    let spread = clamp(jitter, 0.0, 1.0);
    let s = clamp(smoothness, 1e-3, 1.0);
    var nearest = 2.0;
    // Place and distance, times the weights over the nearest's; value and weights.
    var total = vec4f(0.0);
    var others = vec2f(0.0);
    for (var n = 0; n < 5; n++) {
        for (var i = 0; i < 5; i++) {
            for (var k = 0; k < 5; k++) {
                let offset = vec3i(outward(k), outward(i), outward(n));
                // exp(-14) = 1e-6.
                if gap_to_cell(vec3f(offset), f) < nearest + 14.0 * s {
                    let h = lattice_hash(cell + offset, seed);
                    let place = vec3f(offset) + 0.5 + (unit_floats(h) - 0.5) * spread;
                    let d = metric_length(place - f, metric, e);
                    let closest = min(nearest, d);
                    let kept = exp((closest - nearest) / s);
                    let w = exp((closest - d) / s) * weight_within_two(d);
                    total = total * kept + w * vec4f(place, d);
                    others = others * kept + w * vec2f(f32(h.x & 255u) / 255.0, 1.0);
                    nearest = closest;
                }
            }
        }
    }
    // 1e-12: no point within 2, and the distance is 2.
    let is_near = others.y > 1e-12;
    let mean = select(vec4f(0.5, 0.5, 0.5, 2.0), total / max(others.y, 1e-12), is_near);
    let id = select(0.5, others.x / max(others.y, 1e-12), is_near);
    let point = (vec3f(cell) + mean.xyz) / select(scale, 1.0, abs(scale) < DIVISOR_FLOOR);
    return VoronoiSmooth3dOutputs(mean.w, id, point);
}
