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
// (1 - m)^5 at m = 1/7, the cosine of 82 degrees.
const F82_SCHLICK_WEIGHT: f32 = 7776.0 / 16807.0;
// 1 / (m (1 - m)^6) at m = 1/7.
const F82_SCALE: f32 = 823543.0 / 46656.0;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
fn f_schlick(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    return mix(f0, f90, pow5(max(1.0 - l_dot_h, 0.0)));
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
    let g = sqrt(max(e + c * c, 0.0));
    let sum = max(g + c, COSINE_SUM_FLOOR);
    let r_s = e / (sum * sum);
    let r_p = r_s * sum * (c * sum - 1.0) / max(n * n * c + g, COSINE_SUM_FLOOR);
    // Where all is reflected both are 1 or more.
    return min(0.5 * (r_s * r_s + r_p * r_p), 1.0);
}

/// Reflectance at normal incidence of a dielectric in air: ((ior - 1)/(ior + 1))^2.
///
/// KHR_materials_ior writes 0 for an infinite index: 0, and all that is no index (below 0, NaN), gives 1.
fn f0_from_ior(ior: f32) -> f32 {
    let n = select(0.0, min(ior, ETA_CEILING), ior > 0.0);
    let s = (n - 1.0) / (n + 1.0);
    return s * s;
}

/// Index of refraction, relative to the outside, of the dielectric that reflects `f0` at normal incidence:
/// (1 + s) / (1 - s), s = sqrt(f0).
///
/// 1 / (1 - s) is taken as (1 + s) / (1 - f0), which keeps its digits near 1. f0 is held below F0_CEILING.
fn ior_from_f0(f0: f32) -> f32 {
    let s2 = clamp(f0, 0.0, F0_CEILING);
    let s = 1.0 + sqrt(s2);
    return s * s / (1.0 - s2);
}

/// Kutz, Hasan, Edmondson 2021, Novel Aspects of the Adobe Standard Material, as in OpenPBR 1.1: Schlick's F with a metal's
/// edge tint, the reflectance at l.h = 1/7 relative to Schlick's there:
/// F = F_S(l.h) - l.h (1 - l.h)^6 / (m (1 - m)^6) F_S(m) (1 - f82_tint), m = 1/7 (82 degrees), F_S of f90 = 1.
///
/// The equation is as low as -0.13 for a dark f0 with a dark tint, which no metal has: F is held in [0, 1].
fn f_f82_tint(f0: vec3f, f82_tint: vec3f, l_dot_h: f32) -> vec3f {
    let x = clamp(1.0 - l_dot_h, 0.0, 1.0);
    let at_82 = f0 + (1.0 - f0) * F82_SCHLICK_WEIGHT;
    let lost = at_82 * (1.0 - f82_tint) * F82_SCALE;
    let x5 = pow5(x);
    return clamp(f0 + (1.0 - f0) * x5 - (1.0 - x) * (x5 * x) * lost, vec3f(0.0), vec3f(1.0));
}

/// Fresnel's equations of a conductor, unpolarised light, index `eta` + i `k` relative to the outside, cosine on the
/// outside. Born and Wolf 1999, Principles of Optics, section 14.2.
///
/// With c the cosine, s2 = 1 - c^2 and (a + i b)^2 = (eta + i k)^2 - s2:
/// R_s = ((a - c)^2 + b^2) / ((a + c)^2 + b^2),  R_p = R_s ((a c - s2)^2 + b^2 c^2) / ((a c + s2)^2 + b^2 c^2),
/// F = (R_s + R_p) / 2. Of a and b the greater is a square root of a sum and the smaller eta k over it; a - c is
/// (eta^2 - 1 - k^2 + b^2) / (a + c) where a is the greater, so that an index near 1 keeps its digits.
fn f_conductor(eta: f32, k: f32, cos_theta: f32) -> f32 {
    let c = clamp(cos_theta, 0.0, 1.0);
    let n = clamp(eta, 0.0, ETA_CEILING);
    let extinction = clamp(k, 0.0, ETA_CEILING);
    let c2 = c * c;
    let s2 = (1.0 - c) * (1.0 + c);
    let nk = n * extinction;
    let e = (n - 1.0) * (n + 1.0) - extinction * extinction;
    let t = e + c2;
    let greater = sqrt(0.5 * (sqrt(t * t + 4.0 * nk * nk) + abs(t)));
    let smaller = nk / max(greater, COSINE_SUM_FLOOR);
    let is_metal = t < 0.0;
    let a = select(greater, smaller, is_metal);
    let b = select(smaller, greater, is_metal);
    let sum = max(a + c, COSINE_SUM_FLOOR);
    let difference = select((e + b * b) / sum, a - c, is_metal);
    let b2 = b * b;
    let r_s = (difference * difference + b2) / (sum * sum + b2);
    let minus = a * c - s2;
    let plus = a * c + s2;
    let p_over_s = (minus * minus + b2 * c2) / max(plus * plus + b2 * c2, COSINE_SUM_FLOOR * COSINE_SUM_FLOOR);
    return min(0.5 * r_s * (1.0 + p_over_s), 1.0);
}
