// The lobe of light that bounces more than once between the microfacets of a rough surface. Kulla and Conty 2017,
// Revisiting Physically Based Shading at Imageworks, after Kelemen and Szirmay-Kalos 2001:
// f_ms = color (1 - E(v)) (1 - E(l)) / (pi (1 - E_avg)). It is reciprocal. On smooth surfaces the losses are as small as a
// table's errors; there the form is shifted, f_ms = color ((1 - E(v) + s)(1 - E(l) + s) / (1 - E_avg + s) - s) / pi, which
// has the same albedo.

// Smallest average loss divided by: reached at perceptual roughness 0.147.
const AVERAGE_LOSS_FLOOR: f32 = 2e-3;

/// Parameters of the lobe.
struct Multiscatter {
    /// What leaves of the light that bounces on.
    color: vec3f,
    /// 1 - E(v) of the white lobe.
    loss: f32,
    /// 1 - E_avg of the white lobe.
    average_loss: f32,
}

/// The lobe beside a specular lobe of f0 and f90, whose split-sum pair towards the viewer is `dfg` (E(v) is its sum).
fn multiscatter_from_dfg(f0: vec3f, f90: vec3f, dfg: vec2f, perceptual_roughness: f32) -> Multiscatter {
    let average_loss = average_loss_ggx(perceptual_roughness);
    return Multiscatter(multiscatter_color(f0, f90, 1.0 - average_loss), saturate(1.0 - dfg.x - dfg.y), average_loss);
}

/// BRDF times n.l for the unit direction `l` to a light, in 1/sr, with the split-sum pair `dfg` of n.l and the same
/// roughness; 0 where the light is behind the surface.
fn multiscatter_eval(frame: Frame, l: vec3f, p: Multiscatter, dfg: vec2f) -> vec3f {
    let n_dot_l = half_from_light(frame, l).n_dot_l;
    let shift = max(AVERAGE_LOSS_FLOOR - p.average_loss, 0.0);
    let product = (p.loss + shift) * (saturate(1.0 - dfg.x - dfg.y) + shift) / (p.average_loss + shift) - shift;
    return p.color * (max(product, 0.0) * n_dot_l * INV_PI);
}

/// Radiance reflected from an environment: the lobe is wide and nearly Lambert's, so it is fed with the irradiance over pi.
/// Exact for a uniform environment.
fn multiscatter_environment(p: Multiscatter, irradiance_over_pi: vec3f) -> vec3f {
    return p.color * p.loss * irradiance_over_pi;
}
