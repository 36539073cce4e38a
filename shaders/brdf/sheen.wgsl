// Cloth: the Charlie distribution, whose microfacets stand up like fibres, and the visibility that goes with it.
// Together they reflect more than they receive at grazing angles: the lobe made of them is scaled by its directional albedo.

// Smallest alpha: the library's domain begins here, and the exponent 1 / alpha ends at 1e8.
const CHARLIE_ALPHA_FLOOR: f32 = 1e-8;
// Smallest sin^2 whose logarithm is taken.
const SIN2_FLOOR: f32 = 1e-37;
// Smallest denominator of V: keeps it finite at n.l = n.v = 0.
const NEUBELT_FLOOR: f32 = 1e-36;

/// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF:
/// D = (2 + 1/alpha) sin(theta_h)^(1/alpha) / (2 pi). KHR_materials_sheen: alpha = perceptual_roughness^2.
///
/// Where sin^2 is near 1 its distance from 1 decides: there log2(1 - x), x = (n.h)^2, is x log2(1 - x) / ((1 - x) - 1), in
/// which the rounding of 1 - x cancels.
fn d_charlie(n_dot_h: f32, sin2_theta_h: f32, alpha: f32) -> f32 {
    let exponent = 1.0 / max(alpha, CHARLIE_ALPHA_FLOOR);
    let x = n_dot_h * n_dot_h;
    let rest = 1.0 - x;
    let log2_sin2 = log2(select(max(sin2_theta_h, SIN2_FLOOR), rest, x < 0.5)) + 1.44269504088896340736 * ((1.0 - rest) - x);
    return (2.0 + exponent) * exp2(0.5 * exponent * log2_sin2) * (0.5 * INV_PI);
}

/// Neubelt and Pettineo 2013, Crafting a Next-Gen Material Pipeline for The Order: 1886: V = 1 / (4 (n.l + n.v - n.l n.v)).
fn v_neubelt(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    return 0.25 / max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, NEUBELT_FLOOR);
}
