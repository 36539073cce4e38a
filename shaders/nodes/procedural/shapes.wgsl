/// Stripes
///
/// Stripes across u: 1 in the stripe, 0 between. Turn the coordinates for another direction. Not filtered: fine stripes
/// alias.
/// @node procedural/stripes   @also lines, bands, zebra
/// - uv: coordinates [context uv0]
/// - count: stripes per unit [8; 1..64]
/// - width: part of the period that is stripe [0.5; 0..1]
/// - return: 0 or 1
fn node_procedural_stripes(uv: vec2f, count: f32, width: f32) -> f32 {
    return select(0.0, 1.0, fract(uv.x * count) < width);
}

/// Grid
///
/// Lines around squares: 1 on a line, 0 inside. Not filtered: fine grids alias.
/// @node procedural/grid   @also lines, lattice, graph paper
/// - uv: coordinates [context uv0]
/// - count: squares per unit, across and down [8,8; 1..64]
/// - width: of the lines, over the square's side [0.1; 0..1]
/// - return: 0 or 1
fn node_procedural_grid(uv: vec2f, count: vec2f, width: f32) -> f32 {
    let inner = fract(uv * count);
    let side = min(inner, 1.0 - inner);
    return select(0.0, 1.0, min(side.x, side.y) < 0.5 * width);
}

/// Dots
///
/// A round dot in the middle of each square: 1 in it, 0 outside. Not filtered: fine dots alias.
/// @node procedural/dots   @also circles, polka, halftone
/// - uv: coordinates [context uv0]
/// - count: dots per unit, across and down [8,8; 1..64]
/// - radius: over the square's side [0.3; 0..0.7]
/// - softness: width of the edge over the square's side [0; 0..0.5]
/// - return: 0 to 1
fn node_procedural_dots(uv: vec2f, count: vec2f, radius: f32, softness: f32) -> f32 {
    let d = distance(fract(uv * count), vec2f(0.5));
    return 1.0 - linear_step(radius - 0.5 * max(softness, 0.0), radius + 0.5 * max(softness, 0.0), d);
}
