/// The outputs of the node procedural/hexagons.
struct HexagonsOutputs {
    /// 1 in a tile, 0 in the joint
    mask: f32,
    /// a random value of the tile, 0 to 1
    id: f32,
    /// distance to the tile's nearest side over half of its width: 0 at the side, 1 in the centre
    side_distance: f32,
}

/// Hexagons
///
/// Regular six-sided tiles, standing on a corner. Their centres are those of two lattices of 1 by sqrt(3), one shifted by
/// half; the nearer centre has the tile. The mask is averaged over the pixel; the other outputs fade to their means, 0.5 and 1/3, where tiles are
/// smaller than pixels.
/// @node procedural/hexagons   @also honeycomb, hexagonal tiles
/// - uv: coordinates [context uv0]
/// - count: tiles per unit across [8; 1..64]
/// - joint: width of the joints over the tile's [0.05; 0..0.5]
/// - seed: another one, other values [0; 0..100]
/// @vertex node_procedural_hexagons_vertex
fn node_procedural_hexagons(uv: vec2f, count: f32, joint: f32, seed: i32) -> HexagonsOutputs {
    let p = held2(uv * count);
    return hexagons(p, squared_footprint2(p), joint, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_hexagons_vertex(uv: vec2f, count: f32, joint: f32, seed: i32) -> HexagonsOutputs {
    return hexagons(held2(uv * count), 0.0, joint, seed);
}

/// Hexagons one unit wide over a window.
fn hexagons(p: vec2f, squared_width: f32, joint: f32, seed: i32) -> HexagonsOutputs {
    let period = vec2f(1.0, 1.7320508);
    let even_cell = floor(p / period + 0.5);
    let odd_cell = floor(p / period);
    let even = p - even_cell * period;
    let odd = p - (odd_cell + 0.5) * period;
    let is_odd = dot(odd, odd) < dot(even, even);
    let d = abs(select(even, odd, is_odd));
    // The sides look along x and along 60 degrees from it.
    let from_center = max(d.x, 0.5 * d.x + 0.8660254 * d.y);
    let cell = vec2i(select(even_cell, odd_cell, is_odd));
    let id = unit_floats(lattice_hash(vec3i(cell, i32(is_odd)), seed)).x;
    let side_distance = clamp(1.0 - 2.0 * from_center, 0.0, 1.0);
    let gap = clamp(joint, 0.0, 1.0);
    let near = 1.0 - line_share(0.5 * side_distance, 0.5 * gap, sqrt(squared_width));
    let mask = mix(near, (1.0 - gap) * (1.0 - gap), share_of_mean(squared_width));
    return HexagonsOutputs(mask, mix(0.5, id, left_of_cells(squared_width)), mix(1.0 / 3.0, side_distance, left_of_noise(1.35, squared_width)));
}
