//! Diffuse BRDFs, without n.l, in 1/sr. One signature, so that one can stand for another; each takes the albedo, in which
//! multiple scattering is not linear.

use crate::Real;
use crate::math::{INV_PI, pow5};
use crate::vector::scale;

/// Lambert 1760, Photometria: albedo / pi.
#[inline]
pub fn diffuse_lambert<R: Real>(
    albedo: [R; 3],
    _n_dot_v: R,
    _n_dot_l: R,
    _l_dot_h: R,
    _perceptual_roughness: R,
) -> [R; 3] {
    scale(albedo, R::of(INV_PI))
}

/// Burley 2012, Physically-Based Shading at Disney:
/// albedo (1 + (F90 - 1)(1 - n.l)^5)(1 + (F90 - 1)(1 - n.v)^5) / pi,  F90 = 1/2 + 2 perceptual_roughness (l.h)^2.
///
/// Domain: cosines and roughness in [0, 1]. It is reciprocal but does not keep energy: at high roughness and grazing
/// angles it reflects more than it receives. Error in f32: <= 8 ulp.
#[inline]
pub fn diffuse_burley<R: Real>(albedo: [R; 3], n_dot_v: R, n_dot_l: R, l_dot_h: R, perceptual_roughness: R) -> [R; 3] {
    let f90_minus_1 = R::of(2.0) * perceptual_roughness * l_dot_h * l_dot_h - R::of(0.5);
    let light = R::ONE + f90_minus_1 * pow5((R::ONE - n_dot_l).clamp(R::ZERO, R::ONE));
    let view = R::ONE + f90_minus_1 * pow5((R::ONE - n_dot_v).clamp(R::ZERO, R::ONE));
    scale(albedo, light * view * R::of(INV_PI))
}
