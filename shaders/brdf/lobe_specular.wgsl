// The specular lobe of a rough surface: what codegen chains, one call a light and one call an environment.

/// Parameters of the specular lobe.
struct Specular {
    /// Reflectance at normal incidence.
    f0: vec3f,
    /// Reflectance at grazing incidence.
    f90: vec3f,
    /// Square of the perceptual roughness.
    alpha: f32,
}

/// Cook and Torrance 1982, A Reflectance Model for Computer Graphics: D V F times n.l for the unit direction `l` to a
/// light, V = G / (4 n.l n.v), in 1/sr; 0 where the light is behind the surface.
///
/// V n.l is taken first: it is at most 1/2 / max(alpha, n.v), while V alone is infinite at n.l = n.v = 0.
fn specular_eval(frame: Frame, l: vec3f, p: Specular) -> vec3f {
    let f = f_schlick(p.f0, p.f90, half_from_light(frame, l).l_dot_h);
    return f * specular_lit(frame, l, p);
}

/// specular_eval without its F: D V n.l.
fn specular_lit(frame: Frame, l: vec3f, p: Specular) -> f32 {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    return v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha) * h.n_dot_l * d;
}

/// The direction, not unit, from which the lobe's light comes in the mean: `mirror_dir` leaning to the normal by
/// the cube of the perceptual roughness. A wide lobe is cut by the surface and shadowed where it grazes: at roughness 1 it
/// sees what a diffuse surface sees. After Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering,
/// listing 22; the weight is our own fit.
fn specular_direction(frame: Frame, mirror_dir: vec3f, perceptual_roughness: f32) -> vec3f {
    let weight = perceptual_roughness * perceptual_roughness * perceptual_roughness;
    return mix(mirror_dir, frame.normal, weight);
}

/// Karis 2013, Real Shading in Unreal Engine 4, the split sum: prefiltered radiance about the reflection times
/// the lobe's directional albedo.
fn specular_environment(p: Specular, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return prefiltered_radiance * specular_albedo(p.f0, p.f90, dfg);
}
