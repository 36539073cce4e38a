// The specular lobe of a brushed surface: GGX with two widths, along the tangent and across it.

/// Parameters of the anisotropic specular lobe.
struct Anisotropic {
    /// Reflectance at normal incidence.
    f0: vec3f,
    /// Reflectance at grazing incidence.
    f90: vec3f,
    /// Unit tangent across the normal, along which alpha_t counts, in world space.
    tangent: vec3f,
    /// Width along the tangent.
    alpha_t: f32,
    /// Width along the bitangent.
    alpha_b: f32,
}

/// (alpha_t, alpha_b) of KHR_materials_anisotropy (Khronos 2023): alpha_t = mix(alpha, 1, anisotropy^2), alpha_b = alpha.
fn anisotropic_alphas_gltf(perceptual_roughness: f32, anisotropy: f32) -> vec2f {
    let r = saturate(perceptual_roughness);
    let strength = saturate(anisotropy);
    let alpha = r * r;
    return vec2f(alpha + (1.0 - alpha) * strength * strength, alpha);
}

/// (alpha_t, alpha_b) of OpenPBR 1.1 (Academy Software Foundation 2024), section 3.3: alpha_t = alpha sqrt(2 / (1 + q^2)),
/// alpha_b = q alpha_t, q = 1 - anisotropy.
fn anisotropic_alphas_openpbr(perceptual_roughness: f32, anisotropy: f32) -> vec2f {
    let r = saturate(perceptual_roughness);
    let q = 1.0 - saturate(anisotropy);
    let alpha_t = r * r * sqrt(2.0 / (1.0 + q * q));
    return vec2f(alpha_t, q * alpha_t);
}

/// D V F times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
fn anisotropic_eval(frame: Frame, l: vec3f, p: Anisotropic) -> vec3f {
    let half = half_from_light(frame, l);
    let bitangent = cross(frame.normal, p.tangent);
    let h = normalize_or(frame.view_dir + l, vec3f(0.0));
    let h_in_tangent = vec3f(dot(p.tangent, h), dot(bitangent, h), half.n_dot_h);
    let view = vec3f(dot(p.tangent, frame.view_dir), dot(bitangent, frame.view_dir), frame.n_dot_v);
    let light = vec3f(dot(p.tangent, l), dot(bitangent, l), half.n_dot_l);
    let d = d_ggx_anisotropic(h_in_tangent, p.alpha_t, p.alpha_b);
    let v = v_smith_ggx_anisotropic(view, light, p.alpha_t, p.alpha_b);
    let f = f_schlick(p.f0, p.f90, half.l_dot_h);
    return finite_or_zero(f * (v * half.n_dot_l * d));
}

/// The direction in which an environment is looked up for an anisotropic highlight: the mirror direction about a normal
/// that is bent from n towards the plane of the bitangent and v, the more the narrower the lobe is across.
/// Khronos 2023, KHR_materials_anisotropy, implementation notes: after McAuley 2015, Rendering the World of Far Cry 4.
fn anisotropic_reflection(frame: Frame, tangent: vec3f, anisotropy: f32, perceptual_roughness: f32) -> vec3f {
    let bitangent = cross(frame.normal, tangent);
    let across = normalize_or(cross(bitangent, frame.view_dir), tangent);
    let bent = cross(across, bitangent);
    let rest = 1.0 - saturate(anisotropy) * (1.0 - saturate(perceptual_roughness));
    let keep = rest * rest * (rest * rest);
    let normal = normalize_or(bent * (1.0 - keep) + frame.normal * keep, frame.normal);
    return 2.0 * dot(frame.view_dir, normal) * normal - frame.view_dir;
}

/// Karis 2013, the split sum: prefiltered radiance of anisotropic_reflection times the lobe's directional albedo, taken as
/// that of the width sqrt(alpha_t alpha_b).
fn anisotropic_environment(p: Anisotropic, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(prefiltered_radiance * (p.f0 * dfg.x + p.f90 * dfg.y));
}
