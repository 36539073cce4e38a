/// Checker 2D
///
/// A chess board: 0 where column and row are both even or both odd, 1 elsewhere. Not filtered: fine boards alias.
/// @node procedural/checker   @also chess, checkerboard, squares
/// - uv: coordinates [context uv0]
/// - count: squares per unit, across and down [8,8; 1..64]
/// - return: 0 or 1
fn node_procedural_checker(uv: vec2f, count: vec2f) -> f32 {
    let cell = floor(uv * count);
    let sum = cell.x + cell.y;
    return sum - 2.0 * floor(0.5 * sum);
}

/// Checker 3D
///
/// Cubes of two kinds in turn, in space. Not filtered: fine patterns alias.
/// @node procedural/checker_3d   @also chess, cubes, solid
/// - position: the point [context object_position]
/// - count: cubes per metre along each axis [8,8,8; 1..64]
/// - return: 0 or 1
fn node_procedural_checker_3d(position: vec3f, count: vec3f) -> f32 {
    let cell = floor(position * count);
    let sum = cell.x + cell.y + cell.z;
    return sum - 2.0 * floor(0.5 * sum);
}
