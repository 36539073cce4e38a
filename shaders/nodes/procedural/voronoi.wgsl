// Cells around random points by a chosen metric. Every metric's length is at least its greatest component, so the two cells around on each side
// hold every point nearer than 2, and distances are cut off there: exact and without seams. A cell is looked into when it can hold a
// point nearer than the second nearest: with Euclid's metric mostly the nine around (27 in space).

/// The outputs of the node procedural/voronoi_2d.
struct Voronoi2dOutputs {
    /// distance to the nearest point in cells, 0 to 2
    f1: f32,
    /// distance to the second nearest point in cells, 0 to 2; f2 - f1 is 0 on the borders between cells
    f2: f32,
    /// a random value of the nearest point's cell, 0 to 1
    id: f32,
    /// the nearest point, as coordinates: what is read there is one value for each cell
    point: vec2f,
}

/// Voronoi 2D
///
/// Cells around random points by a metric of choice, with borders that are straight (Euclid's), along the diagonals (Manhattan's), square
/// (Chebyshev's) or stars (Minkowski's of an exponent below 1). Distances to the nearest and second nearest point, cut off at 2; a value for each
/// cell, and its point. All fade to their means where cells are smaller than pixels, the point to the coordinates. Worley Noise is
/// Euclid's metric for half the cost. Worley 1996, "A Cellular Texture Basis Function".
/// @node procedural/voronoi_2d   @also cellular, metric, euclidean, manhattan, chebyshev, minkowski, mosaic, crystals
/// - uv: coordinates [context uv0]
/// - scale: cells per unit [8; 0..64]
/// - jitter: 0 a square lattice, 1 random; held in 0..1 [1; 0..1]
/// - metric: 0 Euclid's, 1 Manhattan's, 2 Chebyshev's, 3 Minkowski's [0; 0..3]
/// - exponent: of Minkowski's metric; held in 0.5..32 [0.5; 0.5..4]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_2d_vertex
fn node_procedural_voronoi_2d(uv: vec2f, scale: f32, jitter: f32, metric: i32, exponent: f32, seed: i32) -> Voronoi2dOutputs {
    let cells = node_procedural_voronoi_2d_vertex(uv, scale, jitter, metric, exponent, seed);
    let window = squared_footprint2(held2(uv * scale));
    let q = inverse_exponent(metric, clamp(exponent, LEAST_EXPONENT, GREATEST_EXPONENT));
    let j = clamp(jitter, 0.0, 1.0);
    // Means over the pattern, by metric and jitter, measured; right to 0.03.
    let f1 = mix(0.333 + q * (0.0345 + 0.1314 * q) + j * j * (0.0548 - 0.018 * q), cells.f1, left_of_noise(1.35, window));
    let f2 = mix(0.657 + q * (0.2036 * q - 0.012) + j * j * (0.0574 * q - 0.0325), cells.f2, left_of_noise(1.0, window));
    let left = left_of_cells(window);
    return Voronoi2dOutputs(f1, f2, mix(0.5, cells.id, left), mix(uv, cells.point, left));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_2d_vertex(uv: vec2f, scale: f32, jitter: f32, metric: i32, exponent: f32, seed: i32) -> Voronoi2dOutputs {
    let p = held2(uv * scale);
    let cell = vec2i(floor(p));
    let f = fract(p);
    let e = clamp(exponent, LEAST_EXPONENT, GREATEST_EXPONENT);
    let spread = clamp(jitter, 0.0, 1.0);
    var nearest = vec2f(2.0);
    var id = 0.5;
    var at = vec2f(0.5);
    for (var i = 0; i < 5; i++) {
        for (var k = 0; k < 5; k++) {
            let offset = vec2i(outward(k), outward(i));
            if gap_to_cell(vec3f(vec2f(offset), 0.0), vec3f(f, 0.5)) < nearest.y {
                let feature = cell_point(cell + offset, spread, seed);
                let place = vec2f(offset) + feature.xy;
                let d = metric_length(vec3f(place - f, 0.0), metric, e);
                id = select(id, feature.z, d < nearest.x);
                at = select(at, place, d < nearest.x);
                nearest.y = min(nearest.y, max(d, nearest.x));
                nearest.x = min(nearest.x, d);
            }
        }
    }
    let point = (vec2f(cell) + at) / select(scale, 1.0, abs(scale) < DIVISOR_FLOOR);
    return Voronoi2dOutputs(nearest.x, nearest.y, id, point);
}

/// The outputs of the node procedural/voronoi_3d.
struct Voronoi3dOutputs {
    /// distance to the nearest point in cells, 0 to 2
    f1: f32,
    /// distance to the second nearest point in cells, 0 to 2; f2 - f1 is 0 on the borders between cells
    f2: f32,
    /// a random value of the nearest point's cell, 0 to 1
    id: f32,
    /// the nearest point, in the space of the position: what is read there is one value for each cell
    point: vec3f,
}

/// Voronoi 3D
///
/// Cells of space around random points by a metric of choice: Euclid's, Manhattan's, Chebyshev's or Minkowski's. Distances to the nearest and
/// second nearest point, cut off at 2; a value for each cell, and its point. All fade to their means where cells are smaller than pixels, the
/// point to the position. Worley Noise is Euclid's metric for less. Worley 1996, "A Cellular Texture Basis Function".
/// @node procedural/voronoi_3d   @also cellular, metric, euclidean, manhattan, chebyshev, minkowski, mosaic, crystals
/// - position: the point [context object_position]
/// - scale: cells per metre [8; 0..64]
/// - jitter: 0 a cubic lattice, 1 random; held in 0..1 [1; 0..1]
/// - metric: 0 Euclid's, 1 Manhattan's, 2 Chebyshev's, 3 Minkowski's [0; 0..3]
/// - exponent: of Minkowski's metric; held in 0.75..32, for stars of less reach further than 2 [0.75; 0.75..4]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_3d_vertex
fn node_procedural_voronoi_3d(position: vec3f, scale: f32, jitter: f32, metric: i32, exponent: f32, seed: i32) -> Voronoi3dOutputs {
    let cells = node_procedural_voronoi_3d_vertex(position, scale, jitter, metric, exponent, seed);
    let window = squared_footprint(held3(position * scale));
    let q = inverse_exponent(metric, clamp(exponent, 0.75, GREATEST_EXPONENT));
    let j = clamp(jitter, 0.0, 1.0);
    // Means over the pattern, by metric and jitter, measured; right to 0.02.
    let f1 = mix(0.3756 + q * (0.0429 + 0.3302 * q) + j * j * (0.0552 - 0.0416 * q), cells.f1, left_of_noise(1.35, window));
    let f2 = mix(0.6167 + q * (0.4457 * q - 0.0457) + j * j * (0.0826 * q - 0.0371), cells.f2, left_of_noise(1.0, window));
    let left = left_of_cells(window);
    return Voronoi3dOutputs(f1, f2, mix(0.5, cells.id, left), mix(position, cells.point, left));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_3d_vertex(position: vec3f, scale: f32, jitter: f32, metric: i32, exponent: f32, seed: i32) -> Voronoi3dOutputs {
    let p = held3(position * scale);
    let cell = vec3i(floor(p));
    let f = fract(p);
    let e = clamp(exponent, 0.75, GREATEST_EXPONENT);
    let spread = clamp(jitter, 0.0, 1.0);
    var nearest = vec2f(2.0);
    var id = 0.5;
    var at = vec3f(0.5);
    for (var n = 0; n < 5; n++) {
        for (var i = 0; i < 5; i++) {
            for (var k = 0; k < 5; k++) {
                let offset = vec3i(outward(k), outward(i), outward(n));
                if gap_to_cell(vec3f(offset), f) < nearest.y {
                    let h = lattice_hash(cell + offset, seed);
                    let place = vec3f(offset) + 0.5 + (unit_floats(h) - 0.5) * spread;
                    let d = metric_length(place - f, metric, e);
                    // All three words place the point; the low bits of one, which it does not use, name it.
                    id = select(id, f32(h.x & 255u) / 255.0, d < nearest.x);
                    at = select(at, place, d < nearest.x);
                    nearest.y = min(nearest.y, max(d, nearest.x));
                    nearest.x = min(nearest.x, d);
                }
            }
        }
    }
    let point = (vec3f(cell) + at) / select(scale, 1.0, abs(scale) < DIVISOR_FLOOR);
    return Voronoi3dOutputs(nearest.x, nearest.y, id, point);
}
