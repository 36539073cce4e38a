// The coat: a clear dielectric layer over all that lies below, smooth or rough. OpenPBR 1.1 (Academy Software Foundation
// 2024), section 3.4; Khronos 2020, KHR_materials_clearcoat, is the colour white, ior 1.5.

// Smallest channel of the coat's colour: its logarithm is taken.
const COLOR_FLOOR: f32 = 1e-6;

/// Parameters of the coat.
struct Coat {
    /// Presence of the coat in [0, 1].
    weight: f32,
    /// Transmittance through the coat and back, at normal incidence, in [0, 1].
    color: vec3f,
    /// Reflectance at normal incidence, ((ior - 1)/(ior + 1))^2.
    f0: f32,
    /// Square of the coat's perceptual roughness.
    alpha: f32,
}

/// The coat's reflection times n.l for the unit direction `l` to a light, weight D V F n.l in 1/sr, with Schlick's F from
/// f0 to 1; 0 where the light is behind the surface.
fn coat_eval(frame: Frame, l: vec3f, p: Coat) -> vec3f {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(vec3f(p.f0), vec3f(1.0), h.l_dot_h);
    return f * (p.weight * (v * h.n_dot_l * d));
}

/// Radiance that the coat reflects from an environment: `prefiltered_radiance` about its reflection at the coat's
/// roughness, times weight (f0 a + b) for the split-sum pair `dfg` at the coat's roughness.
fn coat_environment(p: Coat, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return prefiltered_radiance * (p.weight * (p.f0 * dfg.x + dfg.y));
}

/// What the base keeps of its own light below the coat, seen at n.v: 1 + weight (T (1 - f0 a - b) - 1), with the split-sum
/// pair `dfg` at the coat's roughness and the transmittance T = color^(1 / cos theta_t), cos theta_t the refracted cosine.
///
/// Beer and Lambert's law over the path of the refracted view ray. View-only. Each channel is in [0, 1].
fn coat_base(p: Coat, n_dot_v: f32, dfg: vec2f) -> vec3f {
    let s = sqrt(clamp(p.f0, 0.0, 0.9));
    let inv_eta = (1.0 - s) / (1.0 + s);
    let cos2 = mix(1.0, n_dot_v * n_dot_v, inv_eta * inv_eta);
    let path = inverseSqrt(max(cos2, 1e-4));
    let through = saturate(1.0 - p.f0 * dfg.x - dfg.y);
    let transmittance = exp2(log2(clamp(p.color, vec3f(COLOR_FLOOR), vec3f(1.0))) * path);
    return mix(vec3f(1.0), transmittance * through, saturate(p.weight));
}
