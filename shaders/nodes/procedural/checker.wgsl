/// Checker 2D
///
/// A chess board: 0 where column and row are both even or both odd, 1 elsewhere. Averaged over the pixel.
/// @node procedural/checker   @also chess, checkerboard, squares
/// - uv: coordinates [context uv0]
/// - count: squares per unit, across and down [8,8; 1..64]
/// - return: 0 to 1
/// @vertex node_procedural_checker_vertex
fn node_procedural_checker(uv: vec2f, count: vec2f) -> f32 {
    let p = held2(uv * count);
    let w = fwidth(p);
    return odd_share(odd_share(0.0, p.x, w.x), p.y, w.y);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_checker_vertex(uv: vec2f, count: vec2f) -> f32 {
    let p = held2(uv * count);
    return odd_share(odd_share(0.0, p.x, 0.0), p.y, 0.0);
}

/// The part of a window where the sum of some cells is odd, when one more axis is added to those for which it is `share`.
fn odd_share(share: f32, x: f32, width: f32) -> f32 {
    let odd = 1.0 - pulse_wave(0.5 * x, 0.5 * width, 0.5);
    return share + odd - 2.0 * share * odd;
}

/// Checker 3D
///
/// Cubes of two kinds in turn, in space. Averaged over the pixel.
/// @node procedural/checker_3d   @also chess, cubes, solid
/// - position: the point [context object_position]
/// - count: cubes per metre along each axis [8,8,8; 1..64]
/// - return: 0 to 1
/// @vertex node_procedural_checker_3d_vertex
fn node_procedural_checker_3d(position: vec3f, count: vec3f) -> f32 {
    let p = held3(position * count);
    let w = fwidth(p);
    return odd_share(odd_share(odd_share(0.0, p.x, w.x), p.y, w.y), p.z, w.z);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_checker_3d_vertex(position: vec3f, count: vec3f) -> f32 {
    let p = held3(position * count);
    return odd_share(odd_share(odd_share(0.0, p.x, 0.0), p.y, 0.0), p.z, 0.0);
}
