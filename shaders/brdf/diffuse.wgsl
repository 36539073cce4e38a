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
