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
/// Rows of bricks, every second one shifted. The mask is averaged over the pixel; the random value fades to its mean of 0.5 where bricks are
/// smaller than pixels.
/// @node procedural/brick   @also wall, masonry, tiles, planks
/// - uv: coordinates [context uv0]
/// - count: bricks per unit across, rows down [4,8; 1..64]
/// - shift: of every second row, in bricks [0.5; 0..1]
/// - mortar: width of the joints, in heights of a row [0.1; 0..0.5]
/// - softness: width of the edge between brick and mortar, in heights of a row [0; 0..0.5]
/// - seed: another one, other values [0; 0..100]
/// @vertex node_procedural_brick_vertex
fn node_procedural_brick(uv: vec2f, count: vec2f, shift: f32, mortar: f32, softness: f32, seed: i32) -> BrickOutputs {
    let p = held2(uv * brick_count(count));
    return bricks(p, fwidth(p), brick_count(count), shift, mortar, softness, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_brick_vertex(uv: vec2f, count: vec2f, shift: f32, mortar: f32, softness: f32, seed: i32) -> BrickOutputs {
    return bricks(held2(uv * brick_count(count)), vec2f(0.0), brick_count(count), shift, mortar, softness, seed);
}

/// The counts, of which one is divided by the other.
fn brick_count(count: vec2f) -> vec2f {
    return clamp(count, vec2f(1e-3), vec2f(PATTERN_END));
}

/// Bricks over a window. A soft edge is a hard one in its middle, averaged over its width: its window and the pixel's are one of the squares' sum.
fn bricks(p: vec2f, window: vec2f, count: vec2f, shift: f32, mortar: f32, softness: f32, seed: i32) -> BrickOutputs {
    let row = floor(p.y);
    let odd = row - 2.0 * floor(0.5 * row);
    let q = vec2f(p.x + odd * shift, p.y);
    // In bricks and rows. From a whole row on nothing of a brick is left.
    let joint = clamp(mortar, 0.0, 1.0) * vec2f(count.x / count.y, 1.0);
    let soft = clamp(softness, 0.0, 1.0) * vec2f(count.x / count.y, 1.0);
    let w = sqrt(window * window + soft * soft);
    let edge = joint + soft;
    let across = pulse_wave(q.x - 0.5 * edge.x, w.x, 1.0 - edge.x);
    let down = pulse_wave(q.y - 0.5 * edge.y, w.y, 1.0 - edge.y);
    let id = unit_floats(lattice_hash(vec3i(vec2i(floor(q)), 0), seed)).x;
    let left = left_of_cells(0.5 * dot(window, window));
    return BrickOutputs(across * down, mix(0.5, id, left), fract(q));
}
