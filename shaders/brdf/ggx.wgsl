// The GGX (Trowbridge-Reitz) microfacet distribution, isotropic: D, and V = G / (4 n.l n.v). All V have one signature,
// so that one can stand for another; Smith's forms do not look at l.h.

// Perceptual roughness below which a highlight of a punctual light is narrower than f32 directions can resolve between
// neighbouring pixels; who shades with punctual lights holds the roughness above it. Environments have no floor.
const PUNCTUAL_ROUGHNESS_FLOOR: f32 = 0.045;
// Smallest denominator of D's root. It is reached only for alpha < 1e-9 (perceptual roughness 3e-5), keeps D <= 3.2e35
// for any cosines, and makes the 0 / 0 of alpha = 0 a 0.
const D_FLOOR: f32 = 1e-18;
// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0, where V is infinite and V n.l is 0.
const V_FLOOR: f32 = 1e-36;

/// alpha = perceptual_roughness^2. Burley 2012, Physically-Based Shading at Disney.
///
/// Held in [0, 1]; NaN gives 1.
fn alpha_from_perceptual_roughness(perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    return r * r;
}

/// Walter, Marschner, Li, Torrance 2007, Microfacet Models for Refraction through Rough Surfaces:
/// D = alpha^2 / (pi ((n.h)^2 alpha^2 + |n x h|^2)^2).
///
/// With k = alpha / ((n.h)^2 alpha^2 + |n x h|^2) it is k^2 / pi: k is at most 1 / alpha where the square of the
/// denominator would be alpha^4. 1 - (n.h)^2 in the place of |n x h|^2 loses every digit at the peak.
/// alpha = 0 is a mirror, whose D is a delta: 0 here.
fn d_ggx(n_dot_h: f32, sin2_theta_h: f32, alpha: f32) -> f32 {
    let a = n_dot_h * alpha;
    let k = alpha / max(a * a + sin2_theta_h, D_FLOOR);
    return k * (k * INV_PI);
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equation 99 over 4 n.l n.v:
/// V = 1/2 / (n.l sqrt(alpha^2 + (1 - alpha^2)(n.v)^2) + n.v sqrt(alpha^2 + (1 - alpha^2)(n.l)^2)).
fn v_smith_ggx_correlated(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_l * sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_v * sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 0.5 / max(view + light, V_FLOOR);
}

/// Walter et al. 2007: G = G1(v) G1(l), G1(w) = 2 n.w / (n.w + sqrt(alpha^2 + (1 - alpha^2)(n.w)^2)), over 4 n.l n.v:
/// V = 1 / ((n.v + sqrt(alpha^2 + (1 - alpha^2)(n.v)^2)) (n.l + sqrt(alpha^2 + (1 - alpha^2)(n.l)^2))).
fn v_smith_ggx_separable(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_v + sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_l + sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 1.0 / max(view * light, V_FLOOR);
}
