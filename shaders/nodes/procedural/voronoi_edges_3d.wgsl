/// Voronoi Edges 3D
///
/// Cells of space around random points with walls of even thickness between them: cracked rock and dried mud on solids without coordinates, foam,
/// stained glass. The distance is that to the nearest bisector. Quilez 2012, "Voronoi - distances", in space. The mask is averaged over the
/// pixel; the others fade to their means where cells are smaller than pixels. Up to 152 cells are looked into, those left out that are too far to matter.
/// @node procedural/voronoi_edges_3d   @also cracks, borders, cellular, foam, scales, solid
/// - position: the point [context object_position]
/// - scale: cells per metre [4; 0..64]
/// - jitter: 0 a cubic lattice, 1 random; held in 0..1 [1; 0..1]
/// - width: of the walls, in cells [0.1; 0..0.5]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_voronoi_edges_3d_vertex
fn node_procedural_voronoi_edges_3d(position: vec3f, scale: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    let p = held3(position * scale);
    return voronoi_edges3(p, squared_footprint(p), clamp(jitter, 0.0, 1.0), width, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_voronoi_edges_3d_vertex(position: vec3f, scale: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    return voronoi_edges3(held3(position * scale), 0.0, clamp(jitter, 0.0, 1.0), width, seed);
}

/// Voronoi cells of space and the walls between them over a window.
fn voronoi_edges3(p: vec3f, squared_width: f32, jitter: f32, width: f32, seed: i32) -> VoronoiEdgesOutputs {
    let cell = vec3i(floor(p));
    let f = fract(p);
    var nearest = vec3f(0.0);
    var nearest_cell = vec3i(0);
    var least = 12.0;
    var id = 0.0;
    for (var i = 0; i < 27; i++) {
        let offset = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let h = lattice_hash(cell + offset, seed);
        let d = vec3f(offset) + 0.5 + (unit_floats(h) - 0.5) * jitter - f;
        let closer = dot(d, d) < least;
        least = select(least, dot(d, d), closer);
        nearest = select(nearest, d, closer);
        nearest_cell = select(nearest_cell, offset, closer);
        // All three words place the point; the low bits of one, which it does not use, name it.
        id = select(id, f32(h.x & 255u) / 255.0, closer);
    }
    // The bisectors around the nearest point, from the middle outward. A point at the distance d has its bisector at (d - r)/2 or more.
    let r = sqrt(least);
    var edge = 1.0;
    for (var z = 0; z < 5; z++) {
        for (var y = 0; y < 5; y++) {
            for (var x = 0; x < 5; x++) {
                let other_cell = nearest_cell + vec3i(outward(x), outward(y), outward(z));
                if gap_to_cell(vec3f(other_cell), f) < 2.0 * edge + r {
                    let d = vec3f(other_cell) + 0.5 + (unit_floats(lattice_hash(cell + other_cell, seed)) - 0.5) * jitter - f;
                    let across = d - nearest;
                    let apart = dot(across, across);
                    // The point itself has no bisector with itself.
                    let to_edge = dot(0.5 * (nearest + d), across) * inverseSqrt(max(apart, 1e-12));
                    edge = select(edge, min(edge, to_edge), apart > 1e-8);
                }
            }
        }
    }
    let away = max(edge, 0.0);
    let wall = max(width, 0.0);
    let near = 1.0 - line_share(away, 0.5 * wall, sqrt(squared_width));
    let rest = max(1.0 - wall, 0.0);
    let mask = mix(near, rest * rest * rest, share_of_mean(squared_width));
    // The mean distance to a wall lies near that of cubes, 1/8.
    return VoronoiEdgesOutputs(mask, mix(0.125, away, left_of_noise(1.35, squared_width)), mix(0.5, id, left_of_cells(squared_width)));
}
