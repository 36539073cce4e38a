// The light that bounces more than once between microfacets, which a single-scattering lobe loses.

// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f32 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one.
fn energy_compensation(f0: vec3f, dfg: vec2f) -> vec3f {
    let directional_albedo = max(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR);
    return 1.0 + f0 * (1.0 / directional_albedo - 1.0);
}
