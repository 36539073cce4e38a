//! What a dielectric interface leaves to the diffuse base under it, so that both together reflect no more than arrives.
//!
//! A base colour is the albedo of the base as it is seen through the interface (glTF 2.0 appendix B; OpenPBR 1.1,
//! "albedo scaling"): light that bounces under the interface is part of it and darkens nothing a second time.
//! Reflectances are scalars: a dielectric's reflection has no colour.

use crate::Real;
use crate::multiscatter::average_loss_ggx;

/// 1 less what a table of 45 x 45 texels may be too low by: so that base and interface do not gain.
const ARRIVING: f64 = 0.9975;
/// Largest albedo of an interface that is divided by in [`coupling_light`].
const AVERAGE_CEILING: f64 = 0.99;

/// Share 1 - E_spec(v) of a diffuse BRDF that is left under an interface of reflectances f0 and f90 that scatters once:
/// E_spec = f0 a + f90 b. Kulla and Conty 2017; OpenPBR 1.1 section 3.
///
/// View-only: with a diffuse BRDF of albedo 1 the two reflect 0.9975, whatever its shape, but exchanging v and l changes
/// the product by (1 - E(v)) / (1 - E(l)). The 1 is 0.9975, less the largest error of the table that shaders read.
/// Domain: every number; the result is held in [0, 1], NaN gives 0.
/// Error in f32: <= 4 ulp of 1.
#[inline]
pub fn coupling_single<R: Real>(f0: R, f90: R, dfg: [R; 2]) -> R {
    (R::of(ARRIVING) - f0 * dfg[0] - f90 * dfg[1]).clamp(R::ZERO, R::ONE)
}

/// Share that is left under an interface whose specular lobe is compensated for multiple scattering by any of the
/// methods: 1 - E_spec (1 + F_avg (1/E - 1)), E = a + b, F_avg = f0 + (f90 - f0) / 21.
///
/// F_avg in the place of Turquin's f0 bounds his factor, Fdez-Aguera's and Kulla and Conty's lobe, so that no method gains
/// energy; it exceeds what the least of them adds by at most 3e-3 for f0 = 0.04. Domain and edges: as [`coupling_single`].
#[inline]
pub fn coupling_compensated<R: Real>(f0: R, f90: R, dfg: [R; 2]) -> R {
    let average = f0 + (f90 - f0) * R::of(1.0 / 21.0);
    let gain = R::ONE / (dfg[0] + dfg[1]).clamp(R::of(0.1), R::ONE) - R::ONE;
    let single = f0 * dfg[0] + f90 * dfg[1];
    (R::of(ARRIVING) - single * (R::ONE + average * gain)).clamp(R::ZERO, R::ONE)
}

/// [`coupling_compensated`] of each channel: an interface under a film.
///
/// Domain and edges: as [`coupling_single`].
#[inline]
pub fn coupling_colored<R: Real>(f0: [R; 3], f90: [R; 3], dfg: [R; 2]) -> [R; 3] {
    [0, 1, 2].map(|i| coupling_compensated(f0[i], f90[i], dfg))
}

/// What makes the coupling reciprocal: (1 - E_spec(l)) / (1 - E_spec,avg) for a light whose split-sum pair is `dfg`; times
/// [`coupling_single`] of the viewer. Shirley, Smits, Hu, Lafortune 1997, A Practitioners' Assessment of Light Reflection
/// Models; Kelemen and Szirmay-Kalos 2001.
///
/// With Lambert's BRDF of albedo 1 the sum is 0.995 up to the fits of the averages (2e-4); a BRDF that is not constant, such as
/// EON, is up to 0.7 % above at normal incidence and 4 % below at grazing.
/// Average of b: our own fit 0.0476 / (1 + 12.6 r^3), within 7e-4. Domain: as [`coupling_single`]; held in [0, 100].
#[inline]
pub fn coupling_light<R: Real>(f0: R, f90: R, dfg: [R; 2], perceptual_roughness: R) -> R {
    let r = perceptual_roughness.clamp(R::ZERO, R::ONE);
    let b = R::of(0.0476) / (R::ONE + R::of(12.6) * r * r * r);
    let a = R::ONE - average_loss_ggx(perceptual_roughness) - b;
    let average = (f0 * a + f90 * b).clamp(R::ZERO, R::of(AVERAGE_CEILING));
    coupling_single(f0, f90, dfg) / (R::ONE - average)
}
