/// Linear Gradient
///
/// Rises from 0 to 1 across the unit square along a direction, through 0.5 in its middle; level outside of 0..1.
/// @node procedural/linear_gradient   @also ramp, fade
/// - uv: coordinates [context uv0]
/// - rotation: direction of the rise, counter-clockwise on the image from its right [0; -180..180; deg]
/// - return: 0 to 1
fn node_procedural_linear_gradient(uv: vec2f, rotation: f32) -> f32 {
    let angle = radians(rotation);
    // v runs down.
    return clamp(0.5 + dot(uv - 0.5, vec2f(cos(angle), -sin(angle))), 0.0, 1.0);
}

/// Radial Gradient
///
/// Falls from 1 in a centre to 0 at a radius, linearly. A radius of 0 is a hard border.
/// @node procedural/radial_gradient   @also spot, sphere, vignette, circle
/// - uv: coordinates [context uv0]
/// - center: where it is 1 [0.5,0.5; 0..1]
/// - radius: where it is 0 [0.5; 0..1]
/// - return: 0 to 1
fn node_procedural_radial_gradient(uv: vec2f, center: vec2f, radius: f32) -> f32 {
    return 1.0 - linear_step(0.0, max(radius, 0.0), distance(uv, center));
}

/// Conical Gradient
///
/// Rises from 0 to 1 once around a centre, counter-clockwise on the image from a direction, where it jumps back. The jump is averaged over the
/// pixel.
/// @node procedural/conical_gradient   @also sweep, angular, radar, clock
/// - uv: coordinates [context uv0]
/// - center: around which point [0.5,0.5; 0..1]
/// - rotation: where it begins, from the image's right [0; -180..180; deg]
/// - return: 0 to 1
/// @vertex node_procedural_conical_gradient_vertex
fn node_procedural_conical_gradient(uv: vec2f, center: vec2f, rotation: f32) -> f32 {
    // A pixel of width w at distance r is w / (2 pi r) of a turn.
    let turn = 0.5 * INV_PI * sqrt(squared_footprint2(uv)) / max(distance(uv, center), 1e-6);
    return saw_wave(node_coordinates_polar(uv, center).angle - rotation / 360.0, min(turn, 1.0));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_conical_gradient_vertex(uv: vec2f, center: vec2f, rotation: f32) -> f32 {
    return fract(node_coordinates_polar(uv, center).angle - rotation / 360.0);
}
