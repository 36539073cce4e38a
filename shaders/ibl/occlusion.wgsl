// How much of an environment's reflection the surface itself hides: under an occlusion map, and below the horizon of the
// geometry where a normal map turns the shading normal. The environment is taken as uniform.

/// 0 below -width, 1 above width, a cubic step between.
fn smooth_step_about_zero(x: f32, width: f32) -> f32 {
    return smoothstep(-width, width, x);
}

/// The part of the specular lobe that a cone about the normal leaves. `occlusion` is the open part of the cosine-weighted
/// hemisphere, and the cone's half angle t has cos t = sqrt(1 - occlusion) (Jimenez et al. 2016, "Practical Real-Time
/// Strategies for Accurate Indirect Occlusion"). A narrow lobe is inside or not, with a smooth step about the mirror
/// direction, whose cosine is n.v; a wide one is hidden as diffuse light is. The constants are fitted to the integral.
///
/// Domain: all in [0, 1]. occlusion = 1 gives 1, 0 gives 0.
/// Error against the integral of GGX inside the cone: 0.045 rms, 0.32 max (the occlusion itself: 0.23 and 0.96).
fn specular_occlusion_cone(n_dot_v: f32, occlusion: f32, perceptual_roughness: f32) -> f32 {
    let open = saturate(occlusion);
    let alpha = perceptual_roughness * perceptual_roughness;
    let edge = sqrt(1.0 - open);
    let edge2 = edge * edge;
    let edge4 = edge2 * edge2;
    // 0 for a closed cone, which hides narrow lobes too.
    let spread = 1.0 - edge4 * edge4;
    let width = max(min((1.027 * perceptual_roughness - 0.0688) * spread, 2.0 * edge), 1e-4);
    // The small numbers make a whole hemisphere 1 and none 0, at any n.v.
    let inside = n_dot_v + 1e-4 - 1.001 * edge + 0.0548 * alpha * spread;
    return mix(smooth_step_about_zero(inside, width), open, saturate(2.053 * alpha));
}

/// Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.10.2:
/// saturate((n.v + occlusion)^(2^(-16 r - 1)) - 1 + occlusion).
/// Error against the integral of GGX inside the cone of `specular_occlusion_cone`: 0.23 rms, 0.98 max.
fn specular_occlusion_lagarde(n_dot_v: f32, occlusion: f32, perceptual_roughness: f32) -> f32 {
    return saturate(pow(n_dot_v + occlusion, exp2(-16.0 * perceptual_roughness - 1.0)) - 1.0 + occlusion);
}

/// The part of the specular lobe above the geometry's horizon, where the shading normal n is not the geometric normal g;
/// r is the mirror direction about n. The lobe's middle moves from r to n as it widens; the part above g's horizon is a
/// smooth step of the middle's height over it, divided by the part above n's own, which the lobe has lost already.
/// The constants are fitted to the integral.
///
/// Domain: cosines r.g in [-1, 1], n.g and n.v in [0, 1], perceptual roughness in [0, 1]. n = g gives 1.
/// Error against the integral of GGX for tilts up to 60 degrees: 0.030 rms, 0.19 max (none: 0.26 and 1).
fn horizon_cone(r_dot_g: f32, n_dot_g: f32, n_dot_v: f32, perceptual_roughness: f32) -> f32 {
    let alpha = perceptual_roughness * perceptual_roughness;
    let wide = min(1.226 * alpha, 1.0);
    let width = max(0.659 * alpha + 1.23 * perceptual_roughness - 0.0717, 0.01);
    let sunk = 0.379 * alpha;
    let above = smooth_step_about_zero(mix(r_dot_g, n_dot_g, wide) - sunk, width);
    let own = smooth_step_about_zero(mix(n_dot_v, 1.0, wide) - sunk, width);
    // Where n = g both are one number; the floor keeps inputs outside of the domain finite.
    return min(above / max(own, 1e-6), 1.0);
}

/// Lagarde and de Rousiers 2014, as in Filament: saturate(1 + r.g)^2.
/// Error against the integral of GGX for tilts up to 60 degrees: 0.17 rms, 0.90 max.
fn horizon_squared(r_dot_g: f32, n_dot_g: f32, n_dot_v: f32, perceptual_roughness: f32) -> f32 {
    let above = saturate(1.0 + r_dot_g);
    return above * above;
}
