// Forms of V = G / (4 n.l n.v) that are cheaper or older than Smith's own, with the signature of Smith's: one can stand
// for another. None of them follows from D, so none conserves energy with it.

// Smallest denominator: keeps V finite at n.l = n.v = 0, where it is infinite and V n.l is 0.
const V_DENOMINATOR_FLOOR: f32 = 1e-36;

/// Hammon 2017, PBR Diffuse Lighting for GGX+Smith Microfacets, an approximation of the height-correlated Smith form:
/// V = 1/2 / (2 n.l n.v (1 - alpha) + (n.l + n.v) alpha).
fn v_hammon(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let smooth_part = 2.0 * n_dot_l * n_dot_v * (1.0 - alpha);
    let rough_part = (n_dot_l + n_dot_v) * alpha;
    return 0.5 / max(smooth_part + rough_part, V_DENOMINATOR_FLOOR);
}

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering, G1(w) = n.w / (n.w (1 - k) + k), with the k of
/// Karis 2013, Real Shading in Unreal Engine 4, for punctual lights: k = (perceptual_roughness + 1)^2 / 8.
fn v_schlick_smith(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let r = sqrt(alpha) + 1.0;
    let k = r * r * 0.125;
    let view = n_dot_v * (1.0 - k) + k;
    let light = n_dot_l * (1.0 - k) + k;
    return 0.25 / (view * light);
}

/// Torrance and Sparrow 1967, Theory for Off-Specular Reflection From Roughened Surfaces; Cook and Torrance 1982, A
/// Reflectance Model for Computer Graphics: G = min(1, 2 n.h n.v / v.h, 2 n.h n.l / v.h), of long V-shaped grooves.
///
/// With n.h = (n.v + n.l) / (2 v.h), which holds for every half vector, all of it over 4 n.l n.v is
/// V = 1/4 / max(n.v n.l, (l.h)^2 max(n.v, n.l) / (n.v + n.l)).
fn v_cook_torrance(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let blocked = l_dot_h * l_dot_h * (max(n_dot_v, n_dot_l) / max(n_dot_v + n_dot_l, V_DENOMINATOR_FLOOR));
    return 0.25 / max(max(n_dot_v * n_dot_l, blocked), V_DENOMINATOR_FLOOR);
}

/// Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling:
/// V = 1 / (4 (l.h)^2), an approximation of Cook and Torrance's.
fn v_kelemen(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    return 0.25 / max(l_dot_h * l_dot_h, V_DENOMINATOR_FLOOR);
}
