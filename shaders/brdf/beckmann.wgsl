// The Beckmann distribution (Gaussian slopes), which Cook and Torrance used, and Smith's V for it.

// Smallest denominator of D's root: reached only for alpha n.h < 1e-18, makes the 0 / 0 of alpha = 0 a 0.
const BECKMANN_D_FLOOR: f32 = 1e-36;
// Smallest denominator of V: keeps it finite at n.l = n.v = 0.
const BECKMANN_V_FLOOR: f32 = 1e-36;
// Smallest tangent, over alpha, that the cosine is divided by.
const SLOPE_FLOOR: f32 = 1e-18;
// Largest exponent: 2^-200 squared is 0 in f32.
const BECKMANN_EXPONENT_CEILING: f32 = 200.0;

/// Beckmann and Spizzichino 1963; Cook and Torrance 1982, A Reflectance Model for Computer Graphics; as Walter et al. 2007:
/// D = exp(-tan^2(theta_h) / alpha^2) / (pi alpha^2 (n.h)^4).
///
/// With m = 1 / (alpha (n.h)^2) it is (m exp(-tan^2 / (2 alpha^2)))^2 / pi, whose factors stay in f32.
/// alpha = 0 is a mirror, whose D is a delta: 0 here.
fn d_beckmann(n_dot_h: f32, sin2_theta_h: f32, alpha: f32) -> f32 {
    let a2_cos2 = max(alpha * alpha * (n_dot_h * n_dot_h), BECKMANN_D_FLOOR);
    // Half of log2(e).
    let exponent = min(0.72134752044448170368 * (sin2_theta_h / a2_cos2), BECKMANN_EXPONENT_CEILING);
    let k = alpha / a2_cos2 * exp2(-exponent);
    return k * (k * INV_PI);
}

/// n.w Lambda(w) by the rational fit of Walter et al. 2007: with a = n.w / (alpha sin(theta_w)),
/// Lambda = (1 - 1.259 a + 0.396 a^2) / (3.535 a + 2.181 a^2) below a = 1.6, 0 above. n.w / a is alpha sin(theta_w), so
/// that nothing is divided by n.w.
fn masked_cosine(n_dot_w: f32, alpha: f32) -> f32 {
    let slope = alpha * sqrt(max((1.0 - n_dot_w) * (1.0 + n_dot_w), 0.0));
    let a = min(n_dot_w / max(slope, SLOPE_FLOOR), 1.6);
    return slope * max(1.0 - 1.259 * a + 0.396 * a * a, 0.0) / (3.535 + 2.181 * a);
}

/// Height-correlated Smith form, G = 1 / (1 + Lambda(v) + Lambda(l)) over 4 n.l n.v, with Walter's fit of Lambda:
/// V = 1/4 / (n.l n.v + n.l (n.v Lambda(v)) + n.v (n.l Lambda(l))).
fn v_smith_beckmann_correlated(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let masked = n_dot_l * masked_cosine(n_dot_v, alpha) + n_dot_v * masked_cosine(n_dot_l, alpha);
    return 0.25 / max(n_dot_l * n_dot_v + masked, BECKMANN_V_FLOOR);
}

/// Separable Smith form, G = G1(v) G1(l), G1 = 1 / (1 + Lambda), over 4 n.l n.v, with Walter's fit of Lambda:
/// V = 1/4 / ((n.v + n.v Lambda(v)) (n.l + n.l Lambda(l))).
fn v_smith_beckmann_separable(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let view = n_dot_v + masked_cosine(n_dot_v, alpha);
    let light = n_dot_l + masked_cosine(n_dot_l, alpha);
    return 0.25 / max(view * light, BECKMANN_V_FLOOR);
}
