/// Place 2D
///
/// Lays a picture onto the surface: sizes it, turns it about a pivot, then moves it. The coordinates go the way back:
///   R(-rotation) (uv - pivot - offset) / size + pivot
/// The picture turns counter-clockwise. A size nearer to 0 than 1e-6 counts as 1e-6.
/// @node coordinates/place2d   @also mapping, transform, decal, pivot, rotate
/// - uv: coordinates [context uv0]
/// - pivot: what stays when it is turned and sized [0.5,0.5; 0..1]
/// - offset: where it is moved, v down [0,0; -1..1]
/// - rotation: how far it is turned [0; -360..360; deg]
/// - size: how many times as large [1,1; 0.1..4]
/// - return: the new coordinates
fn node_coordinates_place2d(uv: vec2f, pivot: vec2f, offset: vec2f, rotation: f32, size: vec2f) -> vec2f {
    let c = cos(radians(rotation));
    let s = sin(radians(rotation));
    let d = uv - pivot - offset;
    let held = select(vec2f(1.0), vec2f(-1.0), size < vec2f(0.0)) * max(abs(size), vec2f(1e-6));
    return vec2f(c * d.x - s * d.y, s * d.x + c * d.y) / held + pivot;
}
