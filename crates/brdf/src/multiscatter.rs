//! The light that bounces more than once between microfacets, which a single-scattering lobe loses.
//!
//! The factors multiply the single-scattering lobe and look at the viewer alone: they are not reciprocal. Kulla and Conty's
//! form is a lobe of its own, which is: [`crate::lobe_multiscatter`]. Reflectances are held in [0, 1] here, because each of
//! the series 1 + F + F^2 + ... has its pole at some F above 1: f0 = 1.5 would gain 2.4 times the light at roughness 1.

use crate::Real;

/// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f64 = 0.1;

/// a + b, held in [0.1, 1].
#[inline]
fn white_albedo<R: Real>(dfg: [R; 2]) -> R {
    (dfg[0] + dfg[1]).clamp(R::of(DIRECTIONAL_ALBEDO_FLOOR), R::ONE)
}

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one.
///
/// View-only. A white metal (f0 = f90 = 1) reflects exactly 1. `f90` is not looked at: all methods have one signature.
/// Domain: f0 in [0, 1] (held), a + b in [0.1, 1] (held): the factor is in [1, 10]. NaN in f0 counts as 0.
/// Error in f32: <= 2 ulp.
#[inline]
pub fn energy_compensation<R: Real>(f0: [R; 3], _f90: [R; 3], dfg: [R; 2]) -> [R; 3] {
    let gain = R::ONE / white_albedo(dfg) - R::ONE;
    f0.map(|f| R::ONE + f.clamp(R::ZERO, R::ONE) * gain)
}

/// Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting: the part E_ms = 1 - (a + b)
/// that is not reflected at once is reflected by F_avg at each further bounce, F_avg + F_avg^2 E_ms + ...; over the
/// single-scattering albedo that is the factor 1 / (1 - F_avg E_ms).
///
/// View-only. A white metal reflects exactly 1. Domain: as [`energy_compensation`]. Error in f32: <= 4 ulp.
#[inline]
pub fn energy_compensation_fdez_aguera<R: Real>(f0: [R; 3], f90: [R; 3], dfg: [R; 2]) -> [R; 3] {
    let lost = R::ONE - white_albedo(dfg);
    average_fresnel(f0, f90).map(|f| R::ONE / (R::ONE - f * lost))
}

/// Cosine-weighted average of Schlick's Fresnel over the hemisphere, 2 Int F mu dmu = f0 + (f90 - f0) / 21, with f0 and f90
/// held in [0, 1]. Error in f32: <= 2 ulp.
#[inline]
pub fn average_fresnel<R: Real>(f0: [R; 3], f90: [R; 3]) -> [R; 3] {
    [0, 1, 2].map(|i| {
        let (normal, grazing) = (f0[i].clamp(R::ZERO, R::ONE), f90[i].clamp(R::ZERO, R::ONE));
        normal + (grazing - normal) * R::of(1.0 / 21.0)
    })
}

/// Colour of the light that bounces more than once: Kulla and Conty 2017, Revisiting Physically Based Shading at
/// Imageworks, F_avg^2 E_avg / (1 - F_avg (1 - E_avg)): what leaves after the second, third, ... bounce.
///
/// Domain: f0 and f90 in [0, 1] (held: the pole stands at F_avg = 1 / (1 - E_avg) >= 1.69), average_albedo in [0, 1].
/// F_avg = 1 gives exactly 1 up to rounding. E_avg = 0 and F_avg = 1, a surface that never lets go of light, gives 0.
/// Error in f32: <= 6 ulp.
#[inline]
pub fn multiscatter_color<R: Real>(f0: [R; 3], f90: [R; 3], average_albedo: R) -> [R; 3] {
    let lost = R::ONE - average_albedo;
    // 0 / 0 at E_avg = 0, F_avg = 1.
    average_fresnel(f0, f90).map(|f| f * f * average_albedo / (R::ONE - f * lost).max(R::of(1e-6)))
}

/// The white lobe's average loss 1 - E_avg, E_avg = 2 Int E(mu) mu dmu, for height-correlated GGX: our own fit
/// r^4 (8.3801 + r (1.8173 - 3.2724 r)) / (1 + r (7.1 + r (-4.0498 + 7.6654 r))) in the perceptual roughness r.
///
/// Domain: perceptual_roughness in [0, 1] (held). Error of the fit: <= 0.15 % for r >= 0.15, 4e-6 below;
/// it is (4 ln 2 - 1)/3 = 0.59086 at 1. In f32: <= 8 ulp.
#[inline]
pub fn average_loss_ggx<R: Real>(perceptual_roughness: R) -> R {
    let r = perceptual_roughness.clamp(R::ZERO, R::ONE);
    let top = R::of(8.3801) + r * (R::of(1.8173) - r * R::of(3.2724));
    let bottom = R::ONE + r * (R::of(7.1) + r * (R::of(-4.0498) + r * R::of(7.6654)));
    let r2 = r * r;
    r2 * r2 * top / bottom
}
