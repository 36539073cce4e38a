// Transmission through a rough dielectric interface. Walter, Marschner, Li, Torrance 2007, Microfacet Models for
// Refraction through Rough Surfaces. Solid: the interface bends light. Thin-walled (KHR_materials_transmission, Khronos
// 2020): a sheet, which light leaves in the direction in which it came, blurred as a reflection is.

// Smallest square of the denominator of the change of angles: 0 / 0 where eta = 1 and l = -v, which has no half vector.
const JACOBIAN_FLOOR: f32 = 1e-24;

/// Parameters of transmission.
struct Transmission {
    /// Share of the light that passes, linear Rec. 709.
    color: vec3f,
    /// Index of refraction behind the surface over the index on the viewer's side: ior from outside, 1 / ior from inside.
    eta: f32,
    /// Square of the perceptual roughness.
    alpha: f32,
}

/// Solid: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it, in 1/sr:
/// color (1 - F) |v.h| |l.h| G D / (n.v (v.h + eta l.h)^2), equation 21 of the paper, over the index on the viewer's side.
/// G = G1(v) G1(l), h = -(v + eta l) / |v + eta l| on the viewer's side. Total internal reflection gives 0.
fn transmission_eval(frame: Frame, l: vec3f, p: Transmission) -> vec3f {
    // h times |s|, of either sign: D over |s|^4 needs no |s|, and v.h + eta l.h is |s|.
    let s = frame.view_dir + p.eta * l;
    let n_dot_s = dot(frame.normal, s);
    let v_dot_s = dot(frame.view_dir, s);
    let l_dot_s = dot(l, s);
    let sine = cross(frame.normal, s);
    let width = n_dot_s * p.alpha;
    let k = p.alpha / max(width * width + dot(sine, sine), JACOBIAN_FLOOR);
    // G / (n.v |n.l|) is four times V of Smith's separable form; times |n.l| it is finite at the horizon.
    let front = max(-dot(frame.normal, l), 0.0);
    let g = 4.0 * INV_PI * front * v_smith_ggx_separable(frame.n_dot_v, front, 0.0, p.alpha);
    let f = f_dielectric(p.eta, abs(v_dot_s) * inverseSqrt(max(dot(s, s), JACOBIAN_FLOOR)));
    let part = (1.0 - f) * g * (k * v_dot_s) * (k * -l_dot_s);
    // Both rays stand on their sides of the microfacet, and the light behind the surface.
    let through = min(v_dot_s * n_dot_s, -l_dot_s * n_dot_s) > 0.0;
    return p.color * select(0.0, part, through);
}

/// f0 of a surface of which `weight` is a sheet with two faces: all bounces between them together reflect 2 f / (1 + f),
/// and the rest, (1 - f) / (1 + f), passes.
fn f0_of_sheet(f0: f32, weight: f32) -> f32 {
    return f0 + weight * (f0 * (1.0 - f0) / (1.0 + f0));
}

/// Factor on transmission_eval that brings back what the microfacets beyond the first block of the light that comes through
/// a solid body's surface: 1 / (1 - loss), loss = alpha (0.317 (1 - 1/eta) + q (0.361 - 0.335/eta + q (1.405/eta - 0.456)))
/// / (1 - 0.067 alpha), q = 1 - n.v: our own fit to quadrature for eta from 1 up.
fn transmission_compensation(n_dot_v: f32, p: Transmission) -> f32 {
    let inv_eta = saturate(1.0 / max(p.eta, 1.0));
    let q = 1.0 - n_dot_v;
    let slope = 0.317 * (1.0 - inv_eta) + q * (0.361 - 0.335 * inv_eta + q * (1.405 * inv_eta - 0.456));
    return 1.0 / (1.0 - clamp(p.alpha * slope / (1.0 - 0.067 * p.alpha), 0.0, 0.85));
}

/// Thin-walled: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it: a reflection whose light
/// is mirrored at the surface, color (1 - F) D V |n.l|, F of both faces, Schlick's from f0_of_sheet as in the reflection, so
/// that a smooth sheet keeps all light.
fn transmission_thin_eval(frame: Frame, l: vec3f, p: Transmission) -> vec3f {
    let h = half_from_light(frame, l - 2.0 * dot(frame.normal, l) * frame.normal);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(vec3f(f0_of_sheet(f0_from_ior(p.eta), 1.0)), vec3f(1.0), h.l_dot_h);
    return p.color * (1.0 - f) * (v * h.n_dot_l * d);
}

/// Factor on transmission_thin_eval that brings back what single scattering loses: with it a white sheet of reflectance f0
/// at normal incidence keeps all light, (1 - (f0 a + b) (1 + f0 (1/E - 1))) / ((1 - f0) a), E = a + b of the pair `dfg`.
fn transmission_thin_compensation(f0: f32, dfg: vec2f) -> f32 {
    let gain = 1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0) - 1.0;
    let reflected = (f0 * dfg.x + dfg.y) * (1.0 + f0 * gain);
    return clamp((1.0 - reflected) / max((1.0 - f0) * dfg.x, 1e-4), 0.0, 10.0);
}

/// The direction in which an environment is looked up for solid transmission: v refracted by the smooth surface, Snell's
/// law; where it is totally reflected, the grazing ray.
fn transmission_direction(frame: Frame, eta: f32) -> vec3f {
    let inv_eta = 1.0 / max(eta, 1e-6);
    let along = inv_eta * frame.n_dot_v - refracted_cosine(frame.n_dot_v, inv_eta);
    return normalize(frame.normal * along - frame.view_dir * inv_eta);
}

/// The cosine of v refracted by the smooth surface, Snell's law; 0 where it is totally reflected.
fn refracted_cosine(n_dot_v: f32, inv_eta: f32) -> f32 {
    return sqrt(max(mix(1.0, n_dot_v * n_dot_v, inv_eta * inv_eta), 0.0));
}

/// One lookup of an environment through a surface.
struct TransmissionLookup {
    /// Unit direction of the lookup in world space.
    dir: vec3f,
    /// The roughness of the lookup.
    perceptual_roughness: f32,
}

/// Where and how wide an environment is looked up for solid transmission. The microfacets that the viewer sees lean to
/// them: v is refracted about n + alpha (v - n.v n). A facet turned by an angle turns the refracted ray by
/// X = cos_t - n.v / eta of it out of its plane and by X / cos_t within, a reflected one by twice the angle: the lobe is as
/// wide as a reflection's of alpha X / (2 sqrt(cos_t)). 0.45 in the place of 1/2 and the lean are fitted to the integral.
fn transmission_lookup(frame: Frame, eta: f32, alpha: f32) -> TransmissionLookup {
    let leaning = frame.normal + alpha * (frame.view_dir - frame.n_dot_v * frame.normal);
    let facet = frame_from_normal(normalize(leaning), frame.view_dir);
    let inv_eta = 1.0 / max(eta, 1e-6);
    let cos_t = max(refracted_cosine(facet.n_dot_v, inv_eta), 0.01);
    let turn = abs(cos_t - facet.n_dot_v * inv_eta);
    return TransmissionLookup(transmission_direction(facet, eta), sqrt(saturate(0.45 * alpha * turn / sqrt(cos_t))));
}

/// Radiance that arrives through the surface from an environment: color (1 - f0 a - b) times the radiance of
/// transmission_lookup, or of a thin wall's lookup at the roughness itself, with the split-sum pair `dfg` and the interface's
/// f0.
/// The compression by eta^2 is left out: a ray that enters a body leaves it again.
fn transmission_environment(p: Transmission, f0: f32, transmitted_radiance: vec3f, dfg: vec2f) -> vec3f {
    return p.color * saturate(1.0 - f0 * dfg.x - dfg.y) * transmitted_radiance;
}
