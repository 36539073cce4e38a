// Cellular noise. Worley 1996, "A Cellular Texture Basis Function": one point in each unit cell, and the distances to the
// nearest ones. Looking into the cells around finds every point nearer than 1, so distances are cut off there: exact and
// without seams (at full jitter 0.05 % of the plane is further than 1 from its nearest point, 4 % from its second).

/// The outputs of the nodes procedural/worley_2d and procedural/worley_3d.
struct WorleyOutputs {
    /// distance to the nearest point in cells, 0 to 1
    f1: f32,
    /// distance to the second nearest point in cells, 0 to 1; f2 - f1 is 0 on the borders between cells
    f2: f32,
    /// a random value of the nearest point's cell, 0 to 1
    id: f32,
}

/// Worley Noise 2D
///
/// Cells around random points: distance to the nearest, to the second nearest, and a value for each cell. Worley 1996,
/// "A Cellular Texture Basis Function". Distances are cut off at 1. All fade to their means where cells are
/// smaller than pixels; the borders of `id` are hard.
/// @node procedural/worley_2d   @also voronoi, cellular, cells, cracks, stones
/// - uv: coordinates [context uv0]
/// - scale: cells per unit [8; 0..64]
/// - jitter: 0 a square lattice, 1 random; held in 0..1 [1; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_worley_2d_vertex
fn node_procedural_worley_2d(uv: vec2f, scale: f32, jitter: f32, seed: i32) -> WorleyOutputs {
    let cells = node_procedural_worley_2d_vertex(uv, scale, jitter, seed);
    let window = squared_footprint2(held2(uv * scale));
    let j = clamp(jitter, 0.0, 1.0);
    // Means over the pattern, by jitter, measured.
    let f1 = mix(0.382 + j * (0.0079 + 0.039 * j), cells.f1, left_of_noise(1.35, window));
    let f2 = mix(0.7009 + j * (0.0069 - 0.0114 * j), cells.f2, left_of_noise(1.0, window));
    return WorleyOutputs(f1, f2, mix(0.5, cells.id, left_of_cells(window)));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_worley_2d_vertex(uv: vec2f, scale: f32, jitter: f32, seed: i32) -> WorleyOutputs {
    let p = held2(uv * scale);
    let cell = vec2i(floor(p));
    let f = fract(p);
    var nearest = WorleyOutputs(1.0, 1.0, 0.0);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let random = unit_floats(lattice_hash(vec3i(cell + vec2i(x, y), 0), seed));
            let feature = vec2f(f32(x), f32(y)) + 0.5 + (random.xy - 0.5) * clamp(jitter, 0.0, 1.0);
            let d = distance(f, feature);
            nearest.id = select(nearest.id, random.z, d < nearest.f1);
            nearest.f2 = min(nearest.f2, max(d, nearest.f1));
            nearest.f1 = min(nearest.f1, d);
        }
    }
    return nearest;
}

/// Worley Noise 3D
///
/// Cells around random points: distance to the nearest, to the second nearest, and a value for each cell. Worley 1996,
/// "A Cellular Texture Basis Function". Distances are cut off at 1. All fade to their means where cells are
/// smaller than pixels; the borders of `id` are hard. 27 cells are
/// looked into: three times the cost of the plane's.
/// @node procedural/worley_3d   @also voronoi, cellular, cells, cracks, stones
/// - position: the point [context object_position]
/// - scale: cells per metre [8; 0..64]
/// - jitter: 0 a cubic lattice, 1 random; held in 0..1 [1; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_worley_3d_vertex
fn node_procedural_worley_3d(position: vec3f, scale: f32, jitter: f32, seed: i32) -> WorleyOutputs {
    let cells = node_procedural_worley_3d_vertex(position, scale, jitter, seed);
    let window = squared_footprint(held3(position * scale));
    let j = clamp(jitter, 0.0, 1.0);
    // Means over the pattern, by jitter, measured.
    let f1 = mix(0.48 + j * (0.0085 + 0.0318 * j), cells.f1, left_of_noise(1.35, window));
    let f2 = mix(0.703 + j * (0.021 - 0.0076 * j), cells.f2, left_of_noise(1.0, window));
    return WorleyOutputs(f1, f2, mix(0.5, cells.id, left_of_cells(window)));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_worley_3d_vertex(position: vec3f, scale: f32, jitter: f32, seed: i32) -> WorleyOutputs {
    let p = held3(position * scale);
    let cell = vec3i(floor(p));
    let f = fract(p);
    var nearest = WorleyOutputs(1.0, 1.0, 0.0);
    for (var z = -1; z <= 1; z++) {
        for (var y = -1; y <= 1; y++) {
            for (var x = -1; x <= 1; x++) {
                let h = lattice_hash(cell + vec3i(x, y, z), seed);
                let feature = vec3f(f32(x), f32(y), f32(z)) + 0.5 + (unit_floats(h) - 0.5) * clamp(jitter, 0.0, 1.0);
                let d = distance(f, feature);
                // All three words place the point; the low bits of one, which it does not use, name it.
                nearest.id = select(nearest.id, f32(h.x & 255u) / 255.0, d < nearest.f1);
                nearest.f2 = min(nearest.f2, max(d, nearest.f1));
                nearest.f1 = min(nearest.f1, d);
            }
        }
    }
    return nearest;
}
