/// The outputs of the node procedural/voronoi_edges.
struct VoronoiEdgesOutputs {
    /// 1 in a cell, 0 on the lines between cells
    mask: f32,
    /// distance to the nearest border in cells
    edge_distance: f32,
    /// a random value of the cell, 0 to 1
    id: f32,
}

/// Voronoi Edges
///
/// Cells around random points with lines of even width between them: cracked mud, crazy paving, leading of windows. The distance is that to
/// the nearest bisector, unlike f2 - f1 of Worley Noise, whose lines swell. Quilez 2012, "Voronoi - distances". The mask is averaged over
/// the pixel; the others fade to their means where cells are smaller than pixels. 34 cells are looked into.
/// @node procedural/voronoi_edges   @also cracks, borders, cellular, paving, scales, leather
/// - uv: coordinates [context uv0]
/// - scale: cells per unit [8; 0..64]
/// - jitter: 0 a square lattice, 1 random; held in 0..1 [1; 0..1]
/// - width: of the lines, in cells [0.1; 0..0.5]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_edges_vertex
fn node_procedural_voronoi_edges(uv: vec2f, scale: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    let p = held2(uv * scale);
    return voronoi_edges(p, squared_footprint2(p), clamp(jitter, 0.0, 1.0), width, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_edges_vertex(uv: vec2f, scale: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    return voronoi_edges(held2(uv * scale), 0.0, clamp(jitter, 0.0, 1.0), width, seed);
}

/// The random point of a cell, and in z the cell's random value.
fn cell_point(cell: vec2i, jitter: f32, seed: i32) -> vec3f {
    let random = unit_floats(lattice_hash(vec3i(cell, 0), seed));
    return vec3f(0.5 + (random.xy - 0.5) * jitter, random.z);
}

/// Voronoi cells and the lines between them over a window.
fn voronoi_edges(p: vec2f, squared_width: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    let cell = vec2i(floor(p));
    let f = fract(p);
    var nearest = vec2f(0.0);
    var nearest_cell = vec2i(0);
    var least = 8.0;
    var id = 0.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let feature = cell_point(cell + vec2i(x, y), jitter, seed);
            let d = vec2f(f32(x), f32(y)) + feature.xy - f;
            let closer = dot(d, d) < least;
            least = select(least, dot(d, d), closer);
            nearest = select(nearest, d, closer);
            nearest_cell = select(nearest_cell, vec2i(x, y), closer);
            id = select(id, feature.z, closer);
        }
    }
    // The bisectors around the nearest point: its neighbours lie within two cells of it.
    var edge = 1.0;
    for (var y = -2; y <= 2; y++) {
        for (var x = -2; x <= 2; x++) {
            let other_cell = nearest_cell + vec2i(x, y);
            let d = vec2f(other_cell) + cell_point(cell + other_cell, jitter, seed).xy - f;
            let across = d - nearest;
            let apart = dot(across, across);
            // The point itself has no bisector with itself.
            let to_edge = dot(0.5 * (nearest + d), across) * inverseSqrt(max(apart, 1e-12));
            edge = select(edge, min(edge, to_edge), apart > 1e-8);
        }
    }
    let away = max(edge, 0.0);
    let line = max(width, 0.0);
    let near = 1.0 - line_share(away, 0.5 * line, sqrt(squared_width));
    let rest = max(1.0 - line, 0.0);
    let mask = mix(near, rest * rest, share_of_mean(squared_width));
    // The mean distance to a line lies between that of squares, 1/6, and that of cells around random points.
    return VoronoiEdgesOutputs(mask, mix(0.165, away, left_of_noise(1.35, squared_width)), mix(0.5, id, left_of_cells(squared_width)));
}
