// Diffuse BRDFs, without n.l, in 1/sr. One signature, so that one can stand for another; each takes the albedo, in which
// multiple scattering is not linear.

/// Lambert 1760, Photometria: albedo / pi.
fn diffuse_lambert(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    return albedo * INV_PI;
}

/// Burley 2012, Physically-Based Shading at Disney:
/// albedo (1 + (F90 - 1)(1 - n.l)^5)(1 + (F90 - 1)(1 - n.v)^5) / pi,  F90 = 1/2 + 2 perceptual_roughness (l.h)^2.
///
/// It is reciprocal but does not keep energy: at high roughness and grazing angles it reflects more than it receives.
fn diffuse_burley(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    let f90_minus_1 = 2.0 * perceptual_roughness * l_dot_h * l_dot_h - 0.5;
    let light = 1.0 + f90_minus_1 * pow5(clamp(1.0 - n_dot_l, 0.0, 1.0));
    let view = 1.0 + f90_minus_1 * pow5(clamp(1.0 - n_dot_v, 0.0, 1.0));
    return albedo * (light * view * INV_PI);
}

// Smallest cosine divided by: below the library's domain, which begins at 1e-6, and far from overflow.
const DIFFUSE_COSINE_FLOOR: f32 = 1e-18;
// 1/2 - 2/(3 pi): both FON's A and G(0) / pi, the most that the directional albedo's G / pi is.
const FON_A: f32 = 0.28779340921080620;
// 2/3 - 28/(15 pi): the hemisphere's average of G / pi.
const FON_AVERAGE: f32 = 0.07248821245692394;

/// |v_t||l_t| cos(phi) / max(n.v, n.l) where it is positive, itself where it is negative: Fujii's s / t. The dot product
/// of the tangential parts is v.l - n.v n.l, and v.l = 2 (l.h)^2 - 1.
fn fujii_ratio(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32) -> f32 {
    let s = 2.0 * l_dot_h * l_dot_h - 1.0 - n_dot_v * n_dot_l;
    let t = max(max(n_dot_v, n_dot_l), DIFFUSE_COSINE_FLOOR);
    return select(s / t, s, s < 0.0);
}

/// Oren and Nayar 1994, Generalization of Lambert's Reflectance Model, the qualitative form:
/// albedo / pi (A + B max(0, cos(phi)) sin(a) tan(b)), a and b the greater and the smaller of the two angles,
/// A = 1 - s2 / (2 (s2 + 0.33)), B = 0.45 s2 / (s2 + 0.09), s2 = sigma^2, sigma = perceptual_roughness.
fn diffuse_oren_nayar(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    let sigma2 = perceptual_roughness * perceptual_roughness;
    let a = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
    let b = 0.45 * sigma2 / (sigma2 + 0.09);
    let ratio = max(fujii_ratio(n_dot_v, n_dot_l, l_dot_h), 0.0);
    return albedo * ((a + b * ratio) * INV_PI);
}

/// FON's A.
fn fon_scale(r: f32) -> f32 {
    return 1.0 / (1.0 + FON_A * r);
}

/// pi times the FON BRDF of albedo 1. 1 + r s/t is not below 0: -1 where light and viewer are opposite in the horizon.
fn fon(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, r: f32) -> f32 {
    return fon_scale(r) * max(1.0 + r * fujii_ratio(n_dot_v, n_dot_l, l_dot_h), 0.0);
}

/// Fujii's improved Oren-Nayar (FON), as Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving Rough Diffuse BRDF:
/// albedo / pi A (1 + r s/t), A = 1 / (1 + (1/2 - 2/(3 pi)) r), s = v.l - n.v n.l, t = max(n.v, n.l) where s > 0, else 1.
///
/// Single scattering only: a white surface of roughness 1 loses up to 22 %.
fn diffuse_fon(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    return albedo * (fon(n_dot_v, n_dot_l, l_dot_h, perceptual_roughness) * INV_PI);
}

/// The EON paper's polynomial for G / pi; off by 4.7e-4 at most.
fn fon_g_over_pi_fit(n_dot_w: f32) -> f32 {
    let m = 1.0 - n_dot_w;
    return m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
}

/// Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving Rough Diffuse BRDF, with the paper's polynomial for the
/// directional albedo: FON plus
/// m / pi (1 - E(v)) (1 - E(l)) / (1 - E_avg),  m = albedo^2 E_avg / (1 - albedo (1 - E_avg)).
///
/// 1 - E = A r (c - G/pi), c = 1/2 - 2/(3 pi), and 1 - E_avg = A r (c - c_avg): the quotient is A r (..)(..) / (c - c_avg),
/// which is 0 at r = 0, where the paper's is 0 / 0. Albedos are held in [0, 1]: at 5.98 m has a pole.
fn diffuse_eon(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    let r = perceptual_roughness;
    let lost = (FON_A - fon_g_over_pi_fit(n_dot_v)) * (FON_A - fon_g_over_pi_fit(n_dot_l));
    let a = fon_scale(r);
    let average = a * (1.0 + FON_AVERAGE * r);
    let multiple = average * (a * r * lost * (1.0 / (FON_A - FON_AVERAGE)));
    let rho = clamp(albedo, vec3f(0.0), vec3f(1.0));
    let bounced = rho * multiple / (1.0 - rho * (1.0 - average));
    // The polynomial makes `lost` as low as -1.4e-4 at grazing angles.
    return rho * max(fon(n_dot_v, n_dot_l, l_dot_h, r) + bounced, vec3f(0.0)) * INV_PI;
}

/// Directional albedo of FON of albedo 1 by the EON paper's polynomial; relative error of the fit <= 6e-4.
fn directional_albedo_fon(n_dot_v: f32, perceptual_roughness: f32) -> f32 {
    return fon_scale(perceptual_roughness) * (1.0 + perceptual_roughness * fon_g_over_pi_fit(n_dot_v));
}

/// Average albedo of FON of albedo 1: 2 times the integral of E(mu) mu = A (1 + (2/3 - 28/(15 pi)) r).
fn average_albedo_fon(perceptual_roughness: f32) -> f32 {
    return fon_scale(perceptual_roughness) * (1.0 + FON_AVERAGE * perceptual_roughness);
}

/// Directional albedo of EON: albedo E + m (1 - E), with m as in diffuse_eon and the polynomial for E.
fn directional_albedo_eon(albedo: vec3f, n_dot_v: f32, perceptual_roughness: f32) -> vec3f {
    let single = directional_albedo_fon(n_dot_v, perceptual_roughness);
    let average = average_albedo_fon(perceptual_roughness);
    let rho = clamp(albedo, vec3f(0.0), vec3f(1.0));
    let bounced = rho * average / (1.0 - rho * (1.0 - average));
    return rho * (single + bounced * (1.0 - single));
}
