//! Specular anti-aliasing: a normal that turns within a pixel spreads a highlight as roughness does, so the turn is put into the roughness.
//!
//! Differences of the normal between neighbouring pixels tell the turn, to first order: what changes more than once within a
//! pixel is not seen by them.

use crate::Real;
use crate::ggx::alpha_from_perceptual_roughness;
use crate::math::INV_PI;
use crate::vector::dot;

/// Most that is added to alpha^2: where neighbouring normals have nothing to do with each other the differences say nothing.
/// Tokuyoshi and Kaplanyan 2019, Improved Geometric Specular Antialiasing.
pub const NORMAL_VARIANCE_CEILING: f64 = 0.18;

/// The roughness of a lobe whose alpha^2 is larger by this much, held at [`NORMAL_VARIANCE_CEILING`] and at roughness 1:
/// slopes of two independent rough surfaces add up with their variances. Negative counts as 0.
#[inline]
pub fn perceptual_roughness_widened<R: Real>(perceptual_roughness: R, alpha2: R) -> R {
    let alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    let added = alpha2.max(R::ZERO).min(R::of(NORMAL_VARIANCE_CEILING));
    (alpha * alpha + added).min(R::ONE).sqrt().sqrt()
}

/// Variance over the pixel's square: a normal that changes evenly by d over a pixel has a variance of |d|^2 / 12, here over two
/// directions of its slopes, and alpha^2 is twice the variance of each: (|dn/dx|^2 + |dn/dy|^2) / 12.
///
/// Domain: differences of unit normals between neighbouring pixels.
#[inline]
pub fn perceptual_roughness_filtered_box<R: Real>(
    perceptual_roughness: R,
    normal_ddx: [R; 3],
    normal_ddy: [R; 3],
) -> R {
    let change = dot(normal_ddx, normal_ddx) + dot(normal_ddy, normal_ddy);
    perceptual_roughness_widened(perceptual_roughness, change * R::of(1.0 / 12.0))
}

/// Variance under a Gaussian pixel filter: alpha^2 grows by 2 sigma^2 (|dn/dx|^2 + |dn/dy|^2) with sigma^2 = 1 / (2 pi).
/// Tokuyoshi and Kaplanyan 2019, Improved Geometric Specular Antialiasing.
///
/// Domain: differences of unit normals between neighbouring pixels.
#[inline]
pub fn perceptual_roughness_filtered_tokuyoshi<R: Real>(
    perceptual_roughness: R,
    normal_ddx: [R; 3],
    normal_ddy: [R; 3],
) -> R {
    let change = dot(normal_ddx, normal_ddx) + dot(normal_ddy, normal_ddy);
    perceptual_roughness_widened(perceptual_roughness, change * R::of(INV_PI))
}
