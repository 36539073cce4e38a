// What a dielectric interface leaves to the diffuse base under it, so that both together reflect no more than arrives.
// A base colour is the albedo of the base as it is seen through the interface (glTF 2.0 appendix B; OpenPBR 1.1).

// 1 less what a table of 45 x 45 texels may be too low by: so that base and interface do not gain.
const ARRIVING: f32 = 0.9975;
// Largest albedo of an interface that is divided by in coupling_light.
const AVERAGE_CEILING: f32 = 0.99;

/// Share 1 - E_spec(v) of a diffuse BRDF that is left under an interface of reflectances f0 and f90 that scatters once:
/// E_spec = f0 a + f90 b. Kulla and Conty 2017; OpenPBR 1.1 section 3. View-only.
fn coupling_single(f0: f32, f90: f32, dfg: vec2f) -> f32 {
    return saturate(ARRIVING - f0 * dfg.x - f90 * dfg.y);
}

/// Share that is left under an interface whose specular lobe is compensated for multiple scattering by any of the
/// methods: 1 - E_spec (1 + F_avg (1/E - 1)), a bound of them all.
fn coupling_compensated(f0: f32, f90: f32, dfg: vec2f) -> f32 {
    let average = mix(f0, f90, 1.0 / 21.0);
    let bounced = mix(1.0, 1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0), average);
    return saturate(ARRIVING - (f0 * dfg.x + f90 * dfg.y) * bounced);
}

/// coupling_compensated of each channel: an interface under a film.
fn coupling_colored(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    let average = mix(f0, f90, 1.0 / 21.0);
    let bounced = mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0)), average);
    return saturate(ARRIVING - (f0 * dfg.x + f90 * dfg.y) * bounced);
}

/// What makes the coupling reciprocal: (1 - E_spec(l)) / (1 - E_spec,avg) for a light whose split-sum pair is `dfg`; times
/// coupling_single of the viewer. Shirley, Smits, Hu, Lafortune 1997, A Practitioners' Assessment of Light Reflection
/// Models. The average of b is our own fit.
fn coupling_light(f0: f32, f90: f32, dfg: vec2f, perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    let b = 0.0476 / (1.0 + 12.6 * r * r * r);
    let a = 1.0 - average_loss_ggx(perceptual_roughness) - b;
    let average = clamp(f0 * a + f90 * b, 0.0, AVERAGE_CEILING);
    return coupling_single(f0, f90, dfg) / (1.0 - average);
}
