/// UV Transform
///
/// Scales, then turns, then moves texture coordinates, in the order and sense of glTF's KHR_texture_transform (Khronos
/// 2018): with c and s the cosine and sine of the rotation and q = uv scale,
///   (c q.x + s q.y + offset.x,  c q.y - s q.x + offset.y)
/// The coordinates turn counter-clockwise as seen on the image (v runs down), so the picture turns clockwise.
/// @node coordinates/uv_transform   @also mapping, tiling, rotate, scale, offset, texture transform
/// - uv: coordinates [context uv0]
/// - offset: what is added last [0,0; -1..1]
/// - rotation: about the origin [0; -360..360; deg]
/// - scale: repeats per unit [1,1; 0..10]
/// - return: the new coordinates
fn node_coordinates_uv_transform(uv: vec2f, offset: vec2f, rotation: f32, scale: vec2f) -> vec2f {
    let c = cos(radians(rotation));
    let s = sin(radians(rotation));
    let q = uv * scale;
    return vec2f(c * q.x + s * q.y, c * q.y - s * q.x) + offset;
}
