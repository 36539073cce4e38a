// The split sum's second factor: the directional albedo of the specular lobe as f0 a + f90 b.

/// Karis 2014, Physically Based Shading on Mobile: a fit of (a, b) over n.v and perceptual roughness.
///
/// b of the fit falls to -0.0024 at roughness 1; both are held at 0 and above.
fn dfg_karis(n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let r = perceptual_roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return max(vec2f(-1.04, 1.04) * a004 + r.zw, vec2f(0.0));
}

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
fn specular_albedo(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return f0 * dfg.x + f90 * dfg.y;
}
