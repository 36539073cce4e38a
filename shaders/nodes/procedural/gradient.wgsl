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
