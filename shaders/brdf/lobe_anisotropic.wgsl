// The specular lobe of a brushed surface: GGX with two widths, along the tangent and across it.

// Lookups of an environment along the stretched highlight.
const ANISOTROPIC_STRIPS: u32 = 5;

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

/// The unit direction across `normal` along which a surface is brushed: the mesh's tangent (w is the handedness of its
/// bitangent), made perpendicular to the shading normal and turned by `rotation` [rad] towards the bitangent, as
/// KHR_materials_anisotropy (Khronos 2023) counts it. A tangent of zero or along the normal is replaced by any other.
fn anisotropic_tangent(normal: vec3f, tangent: vec4f, rotation: f32) -> vec3f {
    let aside = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.x) > 0.7);
    let other = normalize_or(aside - normal * dot(normal, aside), aside);
    let t = normalize_or(tangent.xyz - normal * dot(normal, tangent.xyz), other);
    let across = cross(normal, t);
    let bitangent = select(across, -across, tangent.w < 0.0);
    return cos(rotation) * t + sin(rotation) * bitangent;
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

/// One of the lookups of an environment that stand for an anisotropic highlight.
struct AnisotropicStrip {
    /// Unit direction of the lookup in world space.
    dir: vec3f,
    /// The roughness of the lookup.
    perceptual_roughness: f32,
    /// What it counts, above 0; the weights of all strips do not add up to 1.
    weight: f32,
}

/// Strip `index` of 0 to ANISOTROPIC_STRIPS - 1: the stretched lobe as a row of round ones, side by side along the tangent.
///
/// The slopes of GGX along the tangent beyond those of the width across, of width sqrt(alpha_t^2 - alpha_b^2), have the
/// density (1 + s^2)^(-3/2) / 2: the strips stand in the middles of equal parts of it, s = x / sqrt(1 - x^2), and mirror v
/// each about its own half vector. A lobe's width is what is left across there, alpha_b sqrt(1 + s^2), less where v leans
/// along the strips, and 0.2 of the gap to the next one. Constants are our own; the weight is n.l (Karis 2013).
fn anisotropic_strip(frame: Frame, tangent: vec3f, alpha_t: f32, alpha_b: f32, index: f32) -> AnisotropicStrip {
    let spread2 = max(alpha_t * alpha_t - alpha_b * alpha_b, 0.0);
    let spread = sqrt(spread2);
    let apart = spread2 / max(alpha_t * alpha_t, 1e-18);
    let x = (2.0 * index + 1.0) / f32(ANISOTROPIC_STRIPS) - 1.0;
    let widening2 = 1.0 / (1.0 - x * x);
    let widening = sqrt(widening2);
    let slope = spread * x * widening;
    let cos_h = 1.0 / sqrt(1.0 + slope * slope);
    let h = (frame.normal + slope * tangent) * cos_h;
    let axis = (tangent - slope * frame.normal) * cos_h;
    let v_dot_h = dot(frame.view_dir, h);
    let dir = 2.0 * v_dot_h * h - frame.view_dir;
    let lean = dot(frame.view_dir, axis);
    let aside = dot(frame.view_dir, cross(frame.normal, tangent));
    let across = 1.0 + (sqrt(max(1.0 - lean * lean, 1e-4)) - 1.0) * apart;
    let gap2 = spread2 * widening2 * widening2 * widening2 * (cos_h * cos_h) * max(1.0 - aside * aside, 1e-4);
    let width2 = alpha_b * alpha_b * (1.0 + (widening2 - 1.0) * apart) * across * across;
    // 0.2 of the gap 2 / ANISOTROPIC_STRIPS in x, squared.
    let alpha2 = (width2 + 0.0064 * gap2) * (cos_h * cos_h);
    let weight = select(1e-3, max(dot(frame.normal, dir), 1e-3), v_dot_h > 0.0);
    return AnisotropicStrip(dir, sqrt(sqrt(min(alpha2, 1.0))), weight);
}

/// Karis 2013, the split sum: prefiltered radiance of anisotropic_strip or of anisotropic_reflection times the lobe's directional albedo, taken as
/// that of the width sqrt(alpha_t alpha_b).
fn anisotropic_environment(p: Anisotropic, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(prefiltered_radiance * (p.f0 * dfg.x + p.f90 * dfg.y));
}
