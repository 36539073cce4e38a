/// Four Corners
///
/// A colour at each corner of the texture, mixed linearly between them; the corners' own beyond.
/// @node color/four_corners   @also gradient, bilinear, ramp4, corners
/// - uv: coordinates; (0, 0) is the upper left corner, (1, 1) the lower right one [context uv0]
/// - upper_left: the colour at (0, 0) [0,0,0; 0..1; color]
/// - upper_right: the colour at (1, 0) [1,0,0; 0..1; color]
/// - lower_left: the colour at (0, 1) [0,1,0; 0..1; color]
/// - lower_right: the colour at (1, 1) [1,1,0; 0..1; color]
/// - return: the mixture
fn node_color_four_corners(
    uv: vec2f,
    upper_left: vec3f,
    upper_right: vec3f,
    lower_left: vec3f,
    lower_right: vec3f,
) -> vec3f {
    let t = clamp(uv, vec2f(0.0), vec2f(1.0));
    return mix(mix(upper_left, upper_right, t.x), mix(lower_left, lower_right, t.x), t.y);
}

/// Split
///
/// One colour on one side of a line, another on the other; pixels on the line have their part of both.
/// @node color/split   @also two colours, half, splitlr, splittb, step
/// - uv: coordinates [context uv0]
/// - first: the colour on the left, or above where it is turned by 90 degrees [0,0,0; 0..1; color]
/// - second: the colour on the other side [1,1,1; 0..1; color]
/// - at: where the line crosses, along the direction across it [0.5; 0..1]
/// - rotation: of the direction in which the colours follow each other; 0 to the right, 90 down [0; -360..360; deg]
/// - return: the colours
/// @vertex node_color_split_vertex
fn node_color_split(uv: vec2f, first: vec3f, second: vec3f, at: f32, rotation: f32) -> vec3f {
    let across = distance_across_split(uv, rotation);
    let part = clamp(0.5 + (across - at) / max(fwidth(across), DIVISOR_FLOOR), 0.0, 1.0);
    return mix(first, second, part);
}

/// The vertex stage has no pixels: the colour at the point.
fn node_color_split_vertex(uv: vec2f, first: vec3f, second: vec3f, at: f32, rotation: f32) -> vec3f {
    return select(first, second, distance_across_split(uv, rotation) >= at);
}

/// How far a point lies along the direction, from the corner or edge where it is 0.
fn distance_across_split(uv: vec2f, rotation: f32) -> f32 {
    let angle = radians(rotation);
    return dot(uv, vec2f(cos(angle), sin(angle)));
}
