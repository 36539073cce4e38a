/// The outputs of the node coordinates/polar.
struct PolarOutputs {
    /// distance from the centre
    radius: f32,
    /// in turns, 0 to 1, counter-clockwise on the image from its right; 0 in the centre
    angle: f32,
}

/// Polar Coordinates
///
/// Distance and angle about a centre, for rings and rays. The angle jumps from 1 to 0 to the right of the centre.
/// @node coordinates/polar   @also radial, angle, circular
/// - uv: coordinates [context uv0]
/// - center: about which point [0.5,0.5; 0..1]
fn node_coordinates_polar(uv: vec2f, center: vec2f) -> PolarOutputs {
    let d = uv - center;
    let in_center = max(abs(d.x), abs(d.y)) <= DIVISOR_FLOOR;
    // v runs down.
    let angle = select(atan2(-d.y, select(d.x, 1.0, in_center)), 0.0, in_center);
    return PolarOutputs(length(d), fract(angle * 0.5 * INV_PI));
}
