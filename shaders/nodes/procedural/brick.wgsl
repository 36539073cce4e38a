/// The outputs of the node procedural/brick.
struct BrickOutputs {
    /// 1 in a brick, 0 in the mortar
    mask: f32,
    /// a random value of the brick, 0 to 1
    id: f32,
    /// coordinates in the brick and its half of the mortar, 0 to 1
    uv: vec2f,
}

/// Brick
///
/// Rows of bricks, every second one shifted. Not filtered: fine walls alias.
/// @node procedural/brick   @also wall, masonry, tiles, planks
/// - uv: coordinates [context uv0]
/// - count: bricks per unit across, rows down [4,8; 1..64]
/// - shift: of every second row, in bricks [0.5; 0..1]
/// - mortar: width of the joints, in heights of a row [0.1; 0..0.5]
/// - softness: width of the edge between brick and mortar, in heights of a row [0; 0..0.5]
/// - seed: another one, other values [0; 0..100]
fn node_procedural_brick(uv: vec2f, count: vec2f, shift: f32, mortar: f32, softness: f32, seed: i32) -> BrickOutputs {
    let n = max(count, vec2f(1e-3));
    let row = floor(uv.y * n.y);
    let odd = row - 2.0 * floor(0.5 * row);
    let q = vec2f(uv.x * n.x + odd * shift, uv.y * n.y);
    let inner = fract(q);
    // Distance to the brick's nearest side, in heights of a row.
    let side = min(inner, 1.0 - inner) * vec2f(n.y / n.x, 1.0);
    let edge = min(side.x, side.y) - 0.5 * mortar;
    let id = unit_floats(lattice_hash(vec3i(vec2i(floor(q)), 0), seed)).x;
    return BrickOutputs(linear_step(0.0, max(softness, 0.0), edge), id, inner);
}
