/// Stripes
///
/// Stripes across u: 1 in the stripe, 0 between. Turn the coordinates for another direction. Averaged over the pixel.
/// @node procedural/stripes   @also lines, bands, zebra
/// - uv: coordinates [context uv0]
/// - count: stripes per unit [8; 1..64]
/// - width: part of the period that is stripe [0.5; 0..1]
/// - return: 0 to 1
/// @vertex node_procedural_stripes_vertex
fn node_procedural_stripes(uv: vec2f, count: f32, width: f32) -> f32 {
    let x = held1(uv.x * count);
    return pulse_wave(x, fwidth(x), width);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_stripes_vertex(uv: vec2f, count: f32, width: f32) -> f32 {
    return pulse_wave(held1(uv.x * count), 0.0, width);
}

/// Grid
///
/// Lines around squares: 1 on a line, 0 inside. Averaged over the pixel.
/// @node procedural/grid   @also lines, lattice, graph paper
/// - uv: coordinates [context uv0]
/// - count: squares per unit, across and down [8,8; 1..64]
/// - width: of the lines, over the square's side [0.1; 0..1]
/// - return: 0 to 1
/// @vertex node_procedural_grid_vertex
fn node_procedural_grid(uv: vec2f, count: vec2f, width: f32) -> f32 {
    let p = held2(uv * count);
    return grid_share(p, fwidth(p), width);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_grid_vertex(uv: vec2f, count: vec2f, width: f32) -> f32 {
    return grid_share(held2(uv * count), vec2f(0.0), width);
}

/// The part of a window that lines around unit squares cover.
fn grid_share(p: vec2f, window: vec2f, width: f32) -> f32 {
    let across = pulse_wave(p.x + 0.5 * width, window.x, width);
    let down = pulse_wave(p.y + 0.5 * width, window.y, width);
    return across + down - across * down;
}

/// Dots
///
/// A round dot in the middle of each square: 1 in it, 0 outside. Averaged over the pixel: exact far away, a ramp as wide as the pixel near by.
/// @node procedural/dots   @also circles, polka, halftone
/// - uv: coordinates [context uv0]
/// - count: dots per unit, across and down [8,8; 1..64]
/// - radius: over the square's side [0.3; 0..0.7]
/// - softness: width of the edge over the square's side [0; 0..0.5]
/// - return: 0 to 1
/// @vertex node_procedural_dots_vertex
fn node_procedural_dots(uv: vec2f, count: vec2f, radius: f32, softness: f32) -> f32 {
    let p = held2(uv * count);
    return dots_share(p, squared_footprint2(p), radius, softness);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_dots_vertex(uv: vec2f, count: vec2f, radius: f32, softness: f32) -> f32 {
    return dots_share(held2(uv * count), 0.0, radius, softness);
}

/// The part of a window that dots in unit squares cover.
fn dots_share(p: vec2f, squared_width: f32, radius: f32, softness: f32) -> f32 {
    let d = distance(fract(p), vec2f(0.5)) - radius;
    let near = inside_share(d, max(softness, 0.0), sqrt(squared_width));
    // The area of a disc in its unit square: from 1/2 on the square's sides cut segments off.
    let r = clamp(radius, 0.0, 0.70710678);
    let half_chord = sqrt(max(r * r - 0.25, 0.0));
    let segment = select(0.0, r * r * atan2(half_chord, 0.5) - 0.5 * half_chord, r > 0.5);
    return mix(near, clamp(PI * r * r - 4.0 * segment, 0.0, 1.0), share_of_mean(squared_width));
}
