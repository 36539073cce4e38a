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
    return vec2f(mix(alpha, 1.0, strength * strength), alpha);
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
    let t = tangent_across(normal, tangent);
    let side = select(sin(rotation), -sin(rotation), tangent.w < 0.0);
    return cos(rotation) * t + side * cross(normal, t);
}

/// anisotropic_tangent for the rotation 0.
fn tangent_across(normal: vec3f, tangent: vec4f) -> vec3f {
    return normalize_or(tangent.xyz - normal * dot(normal, tangent.xyz), any_tangent(normal));
}

/// D V F times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
fn anisotropic_eval(frame: Frame, l: vec3f, p: Anisotropic) -> vec3f {
    let f = f_schlick(p.f0, p.f90, half_from_light(frame, l).l_dot_h);
    return f * anisotropic_lit(frame, l, p);
}

/// anisotropic_eval without its F: D V n.l.
fn anisotropic_lit(frame: Frame, l: vec3f, p: Anisotropic) -> f32 {
    let half = half_from_light(frame, l);
    let world_from_tangent = mat3x3f(p.tangent, cross(frame.normal, p.tangent), frame.normal);
    // Of v only n.v is held, as in the frame.
    let view = max(frame.view_dir * world_from_tangent, vec3f(-1.0, -1.0, N_DOT_V_FLOOR));
    let light = l * world_from_tangent;
    let d = d_ggx_anisotropic(half.h * world_from_tangent, p.alpha_t, p.alpha_b);
    return v_smith_ggx_anisotropic(view, light, p.alpha_t, p.alpha_b) * half.n_dot_l * d;
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
    let apart = spread2 / max(alpha_t * alpha_t, 1e-18);
    let along = dot(frame.view_dir, tangent);
    let x = (2.0 / f32(ANISOTROPIC_STRIPS)) * index + (1.0 / f32(ANISOTROPIC_STRIPS) - 1.0);
    let widening2 = 1.0 / (1.0 - x * x);
    let slope = x * sqrt(spread2 * widening2);
    let cos_h = inverseSqrt(1.0 + slope * slope);
    let dir = reflect(-frame.view_dir, (frame.normal + slope * tangent) * cos_h);
    let lean = (along - slope * frame.n_dot_v) * cos_h;
    let across = alpha_b * mix(1.0, sqrt(max(1.0 - lean * lean, 1e-4)), apart);
    // 1 less the square of what of v lies across the strips.
    let aside = along * along + frame.n_dot_v * frame.n_dot_v;
    let gap = widening2 * cos_h;
    // 0.2 of the gap 2 / ANISOTROPIC_STRIPS in x, squared.
    let gap2 = 0.0064 * gap * gap * widening2 * (spread2 * aside);
    let alpha2 = (across * across * mix(1.0, widening2, apart) + gap2) * (cos_h * cos_h);
    // Where v.h < 0, n.l is, too.
    return AnisotropicStrip(dir, sqrt(sqrt(min(alpha2, 1.0))), max(dot(frame.normal, dir), 1e-3));
}

/// Karis 2013, the split sum: prefiltered radiance of anisotropic_strip or of anisotropic_reflection times the lobe's directional albedo, taken as
/// that of the width sqrt(alpha_t alpha_b).
fn anisotropic_environment(p: Anisotropic, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return prefiltered_radiance * (p.f0 * dfg.x + p.f90 * dfg.y);
}
