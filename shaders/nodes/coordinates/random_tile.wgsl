/// The outputs of the node coordinates/random_tile.
struct RandomTileOutputs {
    /// coordinates in the turned tile, 0 to 1
    uv: vec2f,
    /// a random value of the tile, 0 to 1
    id: f32,
}

/// Random Tiles
///
/// Divides the unit square into tiles and turns each by 0, 90, 180 or 270 degrees, and mirrors half of them: floors and walls of single
/// stones that do not repeat. Read pictures by Image at Moved Coordinates, with uv times count as the smooth ones. Hash pcg3d of Jarzynski
/// and Olano 2020.
/// @node coordinates/random_tile   @also truchet, rotate tiles, break repetition, flip
/// - uv: coordinates [context uv0]
/// - count: columns and rows [4,4; 1..32]
/// - seed: another one, other turns [0; 0..100]
fn node_coordinates_random_tile(uv: vec2f, count: vec2f, seed: i32) -> RandomTileOutputs {
    let q = uv * count;
    let h = lattice_hash(vec3i(vec2i(floor(q)), 0), seed);
    let inner = fract(q);
    let swapped = select(inner, inner.yx, (h.y & 0x80000000u) != 0u);
    let turned = select(swapped, 1.0 - swapped, vec2<bool>((h.y & 0x40000000u) != 0u, (h.y & 0x20000000u) != 0u));
    return RandomTileOutputs(turned, unit_floats(h).x);
}
