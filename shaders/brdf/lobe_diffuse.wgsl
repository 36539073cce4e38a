// The diffuse lobe: what codegen chains, one call a light and one call an environment.

/// Parameters of the diffuse lobe.
struct Diffuse {
    /// Albedo, linear Rec. 709.
    color: vec3f,
    /// Artist's roughness in [0, 1].
    perceptual_roughness: f32,
}

/// BRDF times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
fn diffuse_eval(frame: Frame, l: vec3f, p: Diffuse) -> vec3f {
    let h = half_from_light(frame, l);
    let brdf = diffuse_lambert(p.color, frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.perceptual_roughness);
    return brdf * h.n_dot_l;
}

/// Radiance reflected from an environment: color times irradiance over pi. Exact for Lambert's BRDF.
fn diffuse_environment(p: Diffuse, irradiance_over_pi: vec3f) -> vec3f {
    return p.color * irradiance_over_pi;
}
