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
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(p.f0, p.f90, h.l_dot_h);
    return finite_or_zero(f * (v * h.n_dot_l * d));
}

/// Karis 2013, Real Shading in Unreal Engine 4, the split sum: prefiltered radiance of the mirror direction times the
/// lobe's directional albedo.
fn specular_environment(p: Specular, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(prefiltered_radiance * specular_albedo(p.f0, p.f90, dfg));
}
