// Fresnel reflectance. `f0` is the reflectance at normal incidence, `f90` the one at grazing incidence.

// Nearest that f0 / f90 comes to 1, where the index of refraction that it implies is infinite: 1 - 2^-20, an exact f32,
// so that 1 - f0 / f90 is exact there too.
const F0_CEILING: f32 = 0.99999904632568359375;
// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both f0 and f90 to nothing.
const F90_FLOOR: f32 = 1e-30;
// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f32 = 1e9;
// Smallest sum of cosines divided by: 0 / 0 at eta = 1, cos = 0. Its square is still a normal f32.
const COSINE_SUM_FLOOR: f32 = 1e-18;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
fn f_schlick(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    return f0 + (f90 - f0) * pow5(clamp(1.0 - l_dot_h, 0.0, 1.0));
}

/// Fresnel's equations for the dielectric that f0 / f90 implies, per channel, scaled to f90:
/// eta = (1 + s) / (1 - s), s = sqrt(f0 / f90);  F = f90 f_dielectric(eta, l.h), which is f0 at l.h = 1 and f90 at 0.
///
/// 1 / (1 - s) is taken as (1 + s) / (1 - s^2), which keeps its digits near s = 1. f0 / f90 is held below F0_CEILING.
fn f_exact(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    let s2 = clamp(f0 / max(f90, vec3f(F90_FLOOR)), vec3f(0.0), vec3f(F0_CEILING));
    let s = 1.0 + sqrt(s2);
    let eta = s * s / (1.0 - s2);
    return f90 * vec3f(f_dielectric(eta.x, l_dot_h), f_dielectric(eta.y, l_dot_h), f_dielectric(eta.z, l_dot_h));
}

/// Fresnel's equations, unpolarised light, real index `eta` = inside over outside, cosine on the outside:
/// g = sqrt(eta^2 - 1 + c^2),  r_s = (c - g)/(c + g),  r_p = (eta^2 c - g)/(eta^2 c + g),  F = (r_s^2 + r_p^2)/2.
/// Born and Wolf 1999, Principles of Optics, section 1.5.
///
/// Both differences are written with e = (eta - 1)(eta + 1) as a factor, which has no cancellation at eta near 1:
/// g - c = e/(g + c),  eta^2 c - g = e (c (g + c) - 1)/(g + c).  Total internal reflection (g^2 < 0) is 1.
fn f_dielectric(eta: f32, cos_theta: f32) -> f32 {
    let c = clamp(cos_theta, 0.0, 1.0);
    let n = min(eta, ETA_CEILING);
    let e = (n - 1.0) * (n + 1.0);
    let g2 = e + c * c;
    let g = sqrt(max(g2, 0.0));
    let sum = max(g + c, COSINE_SUM_FLOOR);
    let r_s = e / (sum * sum);
    let r_p = r_s * sum * (c * sum - 1.0) / max(n * n * c + g, COSINE_SUM_FLOOR);
    return select(0.5 * (r_s * r_s + r_p * r_p), 1.0, g2 < 0.0);
}

/// Reflectance at normal incidence of a dielectric in air: ((ior - 1)/(ior + 1))^2.
///
/// KHR_materials_ior writes 0 for an infinite index: 0, and all that is no index (below 0, NaN), gives 1.
fn f0_from_ior(ior: f32) -> f32 {
    let n = select(0.0, min(ior, ETA_CEILING), ior > 0.0);
    let s = (n - 1.0) / (n + 1.0);
    return s * s;
}
