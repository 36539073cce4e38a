// Sheen: the fuzz of cloth over all that lies below. Charlie's distribution (Estevez and Kulla 2017, Production Friendly
// Microfacet Sheen BRDF) with Neubelt and Pettineo's visibility, as in Khronos 2020, KHR_materials_sheen. That pair reflects
// more than it receives at grazing angles; the lobe is divided by max(1, 1.06 E(v), 1.06 E(l)), which is reciprocal.

// Smallest perceptual roughness of the fit of the albedo.
const SHEEN_ROUGHNESS_FLOOR: f32 = 0.05;
// What the fit of the albedo may be too low by, as a factor, where the albedo is near 1.
const SHEEN_MARGIN: f32 = 1.06;

// 1 / 1.06: what the lobe reflects where the fit would have it reflect all.
const SHEEN_ALBEDO_CEILING: f32 = 0.94339622641509433;

/// Parameters of the sheen.
struct Sheen {
    /// Colour times weight, linear Rec. 709, in [0, 1].
    color: vec3f,
    /// Artist's roughness in [0, 1]; held above 0.05.
    perceptual_roughness: f32,
}

/// Directional albedo of the white lobe before it is held at 1: our own fit to quadrature in the perceptual roughness r,
/// E = (0.347 + 0.1492 r + 0.1148 r^2) / r exp(-mu (b - mu (c - mu d))), b = 0.7769 + 1.4284 / r, c = 0.9992 + 1.1096 / r,
/// d = 0.2518 + 0.9523 / r + 0.1776 / r^2.
fn sheen_albedo(n_dot_w: f32, perceptual_roughness: f32) -> f32 {
    let r = clamp(perceptual_roughness, SHEEN_ROUGHNESS_FLOOR, 1.0);
    let inv_r = 1.0 / r;
    let at_grazing = (0.347 + r * (0.1492 + r * 0.1148)) * inv_r;
    // Each coefficient times log2(e).
    let b = 1.1208297772666358 + 2.0607455964057952 * inv_r;
    let c = 1.441540884856252 + 1.6008144173703938 * inv_r;
    let d = 0.36327061129584104 + inv_r * (1.37387848743856 + 0.25622263926187994 * inv_r);
    return at_grazing * exp2(-n_dot_w * (b - n_dot_w * (c - n_dot_w * d)));
}

/// BRDF times n.l for the unit direction `l` to a light, color D V n.l / max(1, 1.06 E(v), 1.06 E(l)) in 1/sr; 0 where the
/// light is behind the surface.
fn sheen_eval(frame: Frame, l: vec3f, p: Sheen) -> vec3f {
    let h = half_from_light(frame, l);
    let r = clamp(p.perceptual_roughness, SHEEN_ROUGHNESS_FLOOR, 1.0);
    let d = d_charlie(h.n_dot_h, h.sin2_theta_h, r * r);
    let v = v_neubelt(frame.n_dot_v, h.n_dot_l, h.l_dot_h, r * r);
    let most = max(sheen_albedo(frame.n_dot_v, p.perceptual_roughness), sheen_albedo(h.n_dot_l, p.perceptual_roughness)) * SHEEN_MARGIN;
    return p.color * (v * h.n_dot_l * d / max(most, 1.0));
}

/// The direction, not unit, about which the sheen's light is gathered: the normal, leaning to the viewer, to whom fibres
/// that stand up reflect most of what comes from behind them.
fn sheen_direction(frame: Frame) -> vec3f {
    return frame.normal + 0.4 * frame.view_dir;
}

/// Radiance filtered by the sheen's lobe, a ring that narrows to the horizon with the roughness r, from two lookups:
/// `around`, the irradiance over pi about sheen_direction, and `middle`, prefiltered about the normal for a roughness near
/// 0.56, which the ring does not see: max(around + (0.84 - 0.7 r) (around - middle), 0.4 around). Our own fit.
fn sheen_ring(p: Sheen, around: vec3f, middle: vec3f) -> vec3f {
    return max(mix(middle, around, 1.84 - 0.7 * p.perceptual_roughness), 0.4 * around);
}

/// Radiance that the sheen reflects from an environment, seen at n.v: color min(E, 1/1.06) times the radiance filtered by
/// the lobe: sheen_ring's, or, one lookup less and a worse fit, the irradiance over pi of the normal.
fn sheen_environment(p: Sheen, n_dot_v: f32, prefiltered_radiance: vec3f) -> vec3f {
    let albedo = min(sheen_albedo(n_dot_v, p.perceptual_roughness), SHEEN_ALBEDO_CEILING);
    return p.color * albedo * prefiltered_radiance;
}

/// What the base keeps of its own light below the sheen: 1 - max(color) min(E(v), 1). Estevez and Kulla 2017, albedo
/// scaling. View-only. In [0, 1].
fn sheen_base(p: Sheen, n_dot_v: f32) -> f32 {
    let albedo = min(sheen_albedo(n_dot_v, p.perceptual_roughness), 1.0);
    return saturate(1.0 - max(max(p.color.r, p.color.g), p.color.b) * albedo);
}
