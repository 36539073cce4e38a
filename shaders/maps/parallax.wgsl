// Parallax occlusion: where the line of sight meets a height field below the mesh, as texture coordinates. The mesh lies
// at the field's top (value 1); nothing sticks out, so silhouettes stay those of the mesh.

// Steps of the linear search. A ridge narrower than a 32nd of the way is stepped over.
const PARALLAX_STEPS: u32 = 32u;
// Halvings of the last step.
const PARALLAX_HALVINGS: u32 = 5u;

/// How far the texture coordinates move on the way from value 1 to value 0 along the line of sight:
///   -depth (v.T, -v.B) / max(v.N, 0.05),   B = w cross(N, T)
/// `depth` is the distance between white and black, in units of the texture's edge. `view_dir` points to the viewer.
/// v runs down the picture, against B. A tangent that is zero or along N is replaced as in `normal_tbn`.
fn parallax_offset(view_dir: vec3f, normal: vec3f, tangent: vec4f, depth: f32) -> vec2f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let in_plane = tangent.xyz - n * dot(n, tangent.xyz);
    let usable = dot(in_plane, in_plane) > 1e-12 * dot(tangent.xyz, tangent.xyz);
    let fallback = tangent_from_normal(n);
    let t = select(fallback, normalize_or(in_plane, fallback), usable);
    let b = cross(n, t) * f32(select(1.0, -1.0, usable & (tangent.w < 0.0)));
    let v = normalize_or(view_dir, n);
    // The way has an end: 0.05 is the cosine of 87.1 degrees.
    let reach = depth / max(dot(v, n), 0.05);
    return vec2f(-reach * dot(v, t), reach * dot(v, b));
}

/// Where the line of sight meets the height field in the red of `height`, on the way from `uv` to `uv + offset`: the first
/// of 32 equal steps that is not above the field, halved five times, and the chord between its ends. Tatarchuk 2006,
/// "Practical Parallax Occlusion Mapping". The level is chosen by the derivatives of `uv`, which do not jump where the
/// relief hides itself, so that the reads may stand under the loop's condition.
fn parallax_occlusion(height: texture_2d<f32>, height_sampler: sampler, uv: vec2f, uv_ddx: vec2f, uv_ddy: vec2f, offset: vec2f) -> vec2f {
    var low = 0.0;
    var above_low = 1.0 - textureSampleGrad(height, height_sampler, uv, uv_ddx, uv_ddy).r;
    var high = low;
    var above_high = above_low;
    for (var i = 0u; i < PARALLAX_STEPS; i++) {
        if above_high <= 0.0 {
            break;
        }
        low = high;
        above_low = above_high;
        high += 1.0 / f32(PARALLAX_STEPS);
        above_high = 1.0 - high - textureSampleGrad(height, height_sampler, uv + offset * high, uv_ddx, uv_ddy).r;
    }
    for (var i = 0u; i < PARALLAX_HALVINGS; i++) {
        let middle = 0.5 * (low + high);
        let above_middle = 1.0 - middle - textureSampleGrad(height, height_sampler, uv + offset * middle, uv_ddx, uv_ddy).r;
        let is_above = above_middle > 0.0;
        low = select(low, middle, is_above);
        above_low = select(above_low, above_middle, is_above);
        high = select(middle, high, is_above);
        above_high = select(above_middle, above_high, is_above);
    }
    // Both are at one place, or the line leaves the field there, when the denominator is 0.
    let gap = above_low - above_high;
    let part = select(1.0, above_low / gap, gap > 1e-12);
    return uv + offset * mix(low, high, min(part, 1.0));
}
