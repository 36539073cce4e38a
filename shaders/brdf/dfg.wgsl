// The split sum's second factor: the directional albedo of the specular lobe as f0 a + f90 b.

/// Karis 2014, Physically Based Shading on Mobile: a fit of (a, b) over n.v and perceptual roughness.
///
/// b of the fit falls to -0.0024 at roughness 1; both are held at 0 and above.
fn dfg_karis(n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let r = perceptual_roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return max(vec2f(-1.04, 1.04) * a004 + r.zw, vec2f(0.0));
}

/// Our own fit of (a, b) for GGX with the height-correlated V, to quadrature.
///
/// The loss of a white lobe is 1 - E = mu (P0 a + P1 mu) / (a^2 + Q1 a mu + Q2 mu^2) with mu = n.v, a = alpha and cubic
/// P, Q in the perceptual roughness. The part weighted by Schlick's (1 - l.h)^5 is b = (1 - M)^5, where M is a smooth
/// greater of mu's own line s mu and of m0 + k mu, which light off the mirror direction brings.
fn dfg_fit(n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let mu = clamp(n_dot_v, 1e-7, 1.0);
    let r = saturate(perceptual_roughness);
    let alpha = r * r;
    let c = vec4f(0.1107, -0.0125, -0.1184, 0.6698)
        + r * (vec4f(1.1086, 0.1195, -2.2723, 1.4563)
        + r * (vec4f(-3.7147, -0.9887, 13.4711, -1.7584) + r * vec4f(6.065, 1.5658, -6.0875, -0.5975)));
    let bottom = alpha * alpha + mu * (c.z * alpha + abs(c.w) * mu);
    let loss = saturate(mu * (c.x * alpha + c.y * mu) / bottom);
    let line = mu * (1.0 + alpha * (-2.9479 + r * 4.2227));
    let slope = -1.608 + r * (11.4914 - r * 21.624);
    let other = r * (0.757 + r * (-3.3267 + r * 0.085)) + mu * slope;
    let width = alpha * (4.8929 - r * 2.5196);
    let apart = line - other;
    let greater = 0.5 * (line + other + sqrt(apart * apart + width * width));
    let bias = min(pow5(saturate(1.0 - greater)), 1.0 - loss);
    return vec2f(1.0 - loss - bias, bias);
}

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
fn specular_albedo(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return f0 * dfg.x + f90 * dfg.y;
}
