//! The light that bounces more than once between microfacets, which a single-scattering lobe loses.

use crate::Real;

/// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f64 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one.
///
/// Domain: f0 in [0, 1], a + b in [0.1, 1] (held above 0.1). Has no pole for f0 above 1. Error in f32: <= 2 ulp.
#[inline]
pub fn energy_compensation<R: Real>(f0: [R; 3], dfg: [R; 2]) -> [R; 3] {
    let directional_albedo = (dfg[0] + dfg[1]).max(R::of(DIRECTIONAL_ALBEDO_FLOOR));
    f0.map(|f| R::ONE + f * (R::ONE / directional_albedo - R::ONE))
}
