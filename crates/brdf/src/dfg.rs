//! The split sum's second factor: the directional albedo of the specular lobe as f0 a + f90 b.

use crate::Real;

/// Karis 2014, Physically Based Shading on Mobile: a fit of (a, b) over n.v and perceptual roughness.
///
/// Domain: both arguments in [0, 1]. b of the fit falls to -0.0024 at roughness 1; both are held at 0 and above.
/// Error in f32: <= 3e-7. Against GGX with the height-correlated V, over the whole square: a off by up to 0.48 (rms 0.13),
/// b by up to 0.085 (rms 0.021), worst at grazing angles and roughness 1.
#[inline]
pub fn dfg_karis<R: Real>(n_dot_v: R, perceptual_roughness: R) -> [R; 2] {
    let fit = |slope: f64, offset: f64| perceptual_roughness * R::of(slope) + R::of(offset);
    let r = [fit(-1.0, 1.0), fit(-0.0275, 0.0425), fit(-0.572, 1.04), fit(0.022, -0.04)];
    let a004 = (r[0] * r[0]).min((R::of(-9.28) * n_dot_v).exp2()) * r[0] + r[1];
    [(R::of(-1.04) * a004 + r[2]).max(R::ZERO), (R::of(1.04) * a004 + r[3]).max(R::ZERO)]
}

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
#[inline]
pub fn specular_albedo<R: Real>(f0: [R; 3], f90: [R; 3], dfg: [R; 2]) -> [R; 3] {
    [0, 1, 2].map(|i| f0[i] * dfg[0] + f90[i] * dfg[1])
}
