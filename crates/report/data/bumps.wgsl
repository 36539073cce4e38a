/// Bumps
///
/// Waves of a normal map.
/// @node custom/bumps
/// - uv: where [context uv0]
/// - count: waves over the unit [9]
/// - return: as in a normal map
fn bumps(uv: vec2f, count: f32) -> vec3f {
    let w = 6.2831853 * count * uv;
    return vec3f(0.5 + 0.12 * cos(w.x) * cos(0.7 * w.y), 0.5 - 0.1 * sin(w.x) * sin(0.7 * w.y), 1.0);
}
