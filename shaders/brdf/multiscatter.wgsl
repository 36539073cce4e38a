// The light that bounces more than once between microfacets, which a single-scattering lobe loses. The factors multiply
// the single-scattering lobe and look at the viewer alone: they are not reciprocal. Kulla and Conty's form is a lobe of its
// own, which is. Reflectances are held in [0, 1] here: the series of bounces has a pole for some F above 1.

// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f32 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one. `f90` is not looked at: all methods have one
/// signature.
fn energy_compensation(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR, 1.0)), saturate(f0));
}

/// Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting: the part E_ms = 1 - (a + b)
/// that is not reflected at once is reflected by F_avg at each further bounce, F_avg + F_avg^2 E_ms + ...; over the
/// single-scattering albedo that is the factor 1 / (1 - F_avg E_ms).
fn energy_compensation_fdez_aguera(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    let lost = 1.0 - clamp(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR, 1.0);
    return 1.0 / (1.0 - average_fresnel(f0, f90) * lost);
}

/// Cosine-weighted average of Schlick's Fresnel over the hemisphere, 2 Int F mu dmu = f0 + (f90 - f0) / 21.
fn average_fresnel(f0: vec3f, f90: vec3f) -> vec3f {
    let normal = saturate(f0);
    return normal + (saturate(f90) - normal) * (1.0 / 21.0);
}

/// Colour of the light that bounces more than once: Kulla and Conty 2017, Revisiting Physically Based Shading at
/// Imageworks, F_avg^2 E_avg / (1 - F_avg (1 - E_avg)).
///
/// The floor makes the 0 / 0 of E_avg = 0, F_avg = 1 a 0.
fn multiscatter_color(f0: vec3f, f90: vec3f, average_albedo: f32) -> vec3f {
    let f = average_fresnel(f0, f90);
    return f * f * average_albedo / max(1.0 - f * (1.0 - average_albedo), vec3f(1e-6));
}

/// The white lobe's average loss 1 - E_avg, E_avg = 2 Int E(mu) mu dmu, for height-correlated GGX: our own fit to
/// quadrature in the perceptual roughness, to 0.15 %.
fn average_loss_ggx(perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    let top = 8.3801 + r * (1.8173 - r * 3.2724);
    let bottom = 1.0 + r * (7.1 + r * (-4.0498 + r * 7.6654));
    let r2 = r * r;
    return r2 * r2 * top / bottom;
}
