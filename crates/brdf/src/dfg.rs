//! The split sum's second factor: the directional albedo of the specular lobe as f0 a + f90 b.

use crate::Real;
use crate::math::pow5;

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

/// c0 + c1 r + c2 r^2 + c3 r^3.
#[inline]
fn cubic<R: Real>(r: R, c: [f64; 4]) -> R {
    R::of(c[0]) + r * (R::of(c[1]) + r * (R::of(c[2]) + r * R::of(c[3])))
}

/// Our own fit of (a, b) for GGX with the height-correlated V, to quadrature, by Levenberg and Marquardt's method.
///
/// The loss of a white lobe is 1 - E = mu (P0 a + P1 mu) / (a^2 + Q1 a mu + Q2 mu^2) with mu = n.v, a = alpha and cubic
/// P, Q in the perceptual roughness. The part weighted by Schlick's (1 - l.h)^5 is b = (1 - M)^5, where M is a smooth
/// greater of mu's own line s mu and of m0 + k mu, which light off the mirror direction brings.
///
/// Domain: both arguments in [0, 1] (held). Error of a + b: <= 0.014 for n.v >= 0.05 and roughness >= 0.089, 0.026 for
/// n.v >= 0.001 and roughness >= 0.02 (rms 0.007); of b: <= 0.017 and 0.063 (rms 0.008). a, b and a + b are in [0, 1].
/// In f32: <= 64 ulp of 1.
#[inline]
pub fn dfg_fit<R: Real>(n_dot_v: R, perceptual_roughness: R) -> [R; 2] {
    let mu = n_dot_v.clamp(R::of(1e-7), R::ONE);
    let r = perceptual_roughness.clamp(R::ZERO, R::ONE);
    let alpha = r * r;
    let p0 = cubic(r, [0.1107, 1.1086, -3.7147, 6.065]);
    let p1 = cubic(r, [-0.0125, 0.1195, -0.9887, 1.5658]);
    let q1 = cubic(r, [-0.1184, -2.2723, 13.4711, -6.0875]);
    let q2 = cubic(r, [0.6698, 1.4563, -1.7584, -0.5975]).abs();
    let bottom = alpha * alpha + mu * (q1 * alpha + q2 * mu);
    let loss = (mu * (p0 * alpha + p1 * mu) / bottom).clamp(R::ZERO, R::ONE);
    let line = mu * (R::ONE + alpha * (R::of(-2.9479) + r * R::of(4.2227)));
    let slope = R::of(-1.608) + r * (R::of(11.4914) - r * R::of(21.624));
    let other = r * (R::of(0.757) + r * (R::of(-3.3267) + r * R::of(0.085))) + mu * slope;
    let width = alpha * (R::of(4.8929) - r * R::of(2.5196));
    let apart = line - other;
    let greater = R::of(0.5) * (line + other + (apart * apart + width * width).sqrt());
    let bias = pow5((R::ONE - greater).clamp(R::ZERO, R::ONE)).min(R::ONE - loss);
    [R::ONE - loss - bias, bias]
}

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
#[inline]
pub fn specular_albedo<R: Real>(f0: [R; 3], f90: [R; 3], dfg: [R; 2]) -> [R; 3] {
    [0, 1, 2].map(|i| f0[i] * dfg[0] + f90[i] * dfg[1])
}
