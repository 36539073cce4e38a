/// Mirror Tiles
///
/// Coordinates folded back and forth, so that a picture is mirrored in every second tile and has no seams.
/// @node coordinates/mirror   @also mirrored repeat, fold, seamless
/// - uv: coordinates [context uv0]
/// - count: tiles per unit, across and down [2,2; 1..16]
/// - return: coordinates in 0..1
fn node_coordinates_mirror(uv: vec2f, count: vec2f) -> vec2f {
    let q = uv * count;
    return 1.0 - abs(q - 2.0 * floor(0.5 * q) - 1.0);
}
