// Other readings of a normal map's texel than 2 c - 1: centred on code 128, and from two channels. The plain reading is
// normal_from_texel; all have its signature.

/// The tangent-space unit normal of a texel whose zero is code 128 of 255: signed 8-bit numbers moved up by 128, as many
/// bakers write them: t = max((255 c - 128) / 127, -1). (128, 128, 255) is straight up, where 2 c - 1 leans by 0.318
/// degrees; codes 0 and 1 are both -1. x and y are scaled by `strength`, y is turned over by `flip_y`.
fn normal_from_texel_snorm(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    let t = max((255.0 * color - 128.0) / 127.0, vec3f(-1.0));
    let y = select(t.y, -t.y, flip_y);
    return normalize_or(vec3f(t.x * strength, y * strength, t.z), vec3f(0.0, 0.0, 1.0));
}

/// The colour that a normal has in a map whose zero is code 128: (127 n + 128) / 255. The inverse of
/// `normal_from_texel_snorm` with strength 1; nodes that write a texel for others to read call it where that is the decode.
fn texel_from_normal_snorm(n_tangent: vec3f) -> vec3f {
    return (127.0 * n_tangent + 128.0) / 255.0;
}

/// The tangent-space unit normal of a texel with x and y only (BC5, ATI2, 3Dc; red and green), blue not read:
///   (x, y) = 2 c - 1,   z = sqrt(max(0, 1 - x^2 - y^2))
/// Where compression has made x^2 + y^2 > 1, z is 0 and the result lies on the horizon, made unit. x and y are scaled by
/// `strength` after z is found, y is turned over by `flip_y`.
fn normal_from_texel_two_channel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    let t = 2.0 * color.xy - 1.0;
    let z = sqrt(max(1.0 - t.x * t.x - t.y * t.y, 0.0));
    let y = select(t.y, -t.y, flip_y);
    return normalize_or(vec3f(t.x * strength, y * strength, z), vec3f(0.0, 0.0, 1.0));
}
