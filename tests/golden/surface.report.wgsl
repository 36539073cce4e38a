// Surface, made by Halfvector
// serves: an environment; returns linear radiance, Rec. 709
// methods: coupling=none, dfg=table, prefilter=ggx, level_map=report, irradiance=last_level,
//     specular_occlusion=plain, reflection=mirror, sheen=irradiance, anisotropy=strips, height_normals=report,
//     encode=report
// left out: energy compensation: the method is `none`: single scattering only
// left out: horizon: the shading normal is the geometry's: no reflection comes from below
// left out: opacity: the material is opaque
// left out: normals of the displaced surface: the method is `report`: the old normal is kept

struct View {
    clip_from_world: mat4x4f,
    camera_position: vec3f,
    environment_levels: f32,
}
@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(2) var prefiltered_radiance: texture_cube<f32>;
@group(0) @binding(4) var dfg_table: texture_2d<f32>;
@group(0) @binding(5) var linear_clamp: sampler;
struct Parameters {
    base_color: vec3f,
    emission: vec3f,
    coat_color: vec3f,
    sheen_color: vec3f,
    metallic: f32,
    perceptual_roughness: f32,
    ior: f32,
    specular: f32,
    occlusion: f32,
    height: f32,
    coat_weight: f32,
    coat_roughness: f32,
    coat_ior: f32,
    sheen_roughness: f32,
    transmission_weight: f32,
    anisotropy: f32,
    anisotropy_rotation: f32,
    thin_film_weight: f32,
    thin_film_thickness: f32,
    thin_film_ior: f32,
}
@group(1) @binding(0) var<uniform> parameters: Parameters;
struct Object {
    world_from_object: mat4x4f,
    normal_from_object: mat3x3f,
}
@group(2) @binding(0) var<uniform> object: Object;

struct VertexInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
}
struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) world_normal: vec3f,
    @location(2) world_tangent: vec4f,
}

@vertex
fn vs_main(in: VertexInput) -> Varyings {
    let world_position = position_in_world(object.world_from_object, in.position);
    let world_normal = normal_in_world(object.normal_from_object, in.normal);
    let world_tangent = tangent_in_world(object.world_from_object, in.tangent);
    let displaced_position = displaced(world_position, world_normal, parameters.height);
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(displaced_position, 1.0);
    out.world_position = displaced_position;
    out.world_normal = world_normal;
    out.world_tangent = world_tangent;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let diffuse_albedo = parameters.base_color * (1.0 - parameters.metallic);
    let dielectric_f0 = f0_from_ior(parameters.ior);
    let dielectric_f0_2 = dielectric_f0 * parameters.specular;
    let f0 = mix(vec3f(dielectric_f0_2), parameters.base_color, parameters.metallic);
    let f90 = mix(parameters.specular, 1.0, parameters.metallic);
    let coat_f0 = f0_from_ior(parameters.coat_ior);
    let frame = frame_from_normal(world_normal, view_dir);
    let tangent = anisotropic_tangent(frame.normal, in.world_tangent, parameters.anisotropy_rotation);
    let alphas = anisotropic_alphas_gltf(parameters.perceptual_roughness, parameters.anisotropy);
    let specular_roughness = sqrt(sqrt(alphas.x * alphas.y));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, specular_roughness);
    let film = ThinFilm(parameters.thin_film_weight, 1000.0 * parameters.thin_film_thickness, parameters.thin_film_ior);
    let film_cosine = thin_film_cosine(dfg);
    let film_shift = thin_film_shift(f0, vec3f(f90), film, film_cosine);
    let dielectric_shift = film_shift * (1.0 - parameters.metallic);
    let film_through = thin_film_through(dielectric_shift, vec3f(dielectric_f0_2), vec3f(parameters.specular), film_cosine);
    let specular = Anisotropic(f0 + film_shift, vec3f(f90) + film_shift, tangent, alphas.x, alphas.y);
    let diffuse = Diffuse(diffuse_albedo * (1.0 - parameters.transmission_weight), parameters.perceptual_roughness);
    let transmission = Transmission(diffuse_albedo * parameters.transmission_weight * film_through, parameters.ior, alpha_from_perceptual_roughness(parameters.perceptual_roughness));
    let coat = Coat(parameters.coat_weight, parameters.coat_color, coat_f0, alpha_from_perceptual_roughness(parameters.coat_roughness));
    let coat_dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, parameters.coat_roughness);
    let under_coat = coat_base(coat, frame.n_dot_v, coat_dfg);
    let sheen = Sheen(parameters.sheen_color, parameters.sheen_roughness);
    let under_sheen = sheen_base(sheen, frame.n_dot_v);
    let reflection_dir = reflect(-frame.view_dir, frame.normal);
    let irradiance = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(1.0, view.environment_levels)));
    let behind = transmission_lookup(frame, transmission.eta, transmission.alpha);
    let coat_mirror_dir = reflect(-frame.view_dir, frame.normal);
    var strips = vec4f(0.0);
    for (var i = 0u; i < ANISOTROPIC_STRIPS; i++) {
        let strip = anisotropic_strip(frame, tangent, alphas.x, alphas.y, f32(i));
        strips += strip.weight * vec4f(gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, strip.dir, lod_report(strip.perceptual_roughness, view.environment_levels))), 1.0);
    }
    let reflection = strips.rgb / strips.a;
    let transmitted = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, behind.dir, lod_report(behind.perceptual_roughness, view.environment_levels)));
    let coat_reflection = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, coat_mirror_dir, lod_report(parameters.coat_roughness, view.environment_levels)));
    var reflected = diffuse_environment(diffuse, irradiance) * parameters.occlusion;
    reflected += anisotropic_environment(specular, reflection, dfg) * parameters.occlusion;
    reflected += transmission_environment(transmission, dielectric_f0_2, transmitted, dfg);
    reflected = reflected * under_coat + coat_environment(coat, coat_reflection, coat_dfg) * parameters.occlusion;
    reflected = reflected * under_sheen + sheen_environment(sheen, frame.n_dot_v, irradiance) * parameters.occlusion;
    var radiance = reflected;
    radiance += parameters.emission * under_coat * under_sheen;
    radiance = finite_or_zero(radiance);
    return vec4f(radiance, 1.0);
}

// ---- brdf/frame.wgsl

// Smallest n.v: below the library's domain of cosines, which starts at 1e-6. A shading normal may face away from the
// viewer (n.v < 0), where no BRDF is defined: such a point is shaded as seen at grazing incidence.
const N_DOT_V_FLOOR: f32 = 1e-7;

/// A shading normal and the viewer.
struct Frame {
    /// Shading normal in world space, unit.
    normal: vec3f,
    /// From the surface to the viewer in world space, unit.
    view_dir: vec3f,
    /// n.v in [1e-7, 1].
    n_dot_v: f32,
}

/// The frame of a unit shading normal and a unit direction to the viewer, with n.v held in [N_DOT_V_FLOOR, 1].
///
/// NaN in either gives n_dot_v = N_DOT_V_FLOOR.
fn frame_from_normal(normal: vec3f, view_dir: vec3f) -> Frame {
    return Frame(normal, view_dir, clamp(dot(normal, view_dir), N_DOT_V_FLOOR, 1.0));
}

// ---- brdf/fresnel.wgsl

// Nearest that f0 / f90 comes to 1, where the index of refraction that it implies is infinite: 1 - 2^-20, an exact f32,
// so that 1 - f0 / f90 is exact there too.
const F0_CEILING: f32 = 0.99999904632568359375;

// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both f0 and f90 to nothing.
const F90_FLOOR: f32 = 1e-30;

// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f32 = 1e9;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
fn f_schlick(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    return mix(f0, f90, pow5(max(1.0 - l_dot_h, 0.0)));
}

/// Reflectance at normal incidence of a dielectric in air: ((ior - 1)/(ior + 1))^2.
///
/// KHR_materials_ior writes 0 for an infinite index: 0, and all that is no index (below 0, NaN), gives 1.
fn f0_from_ior(ior: f32) -> f32 {
    let n = select(0.0, min(ior, ETA_CEILING), ior > 0.0);
    let s = (n - 1.0) / (n + 1.0);
    return s * s;
}

// ---- brdf/ggx.wgsl

/// alpha = perceptual_roughness^2. Burley 2012, Physically-Based Shading at Disney.
///
/// Held in [0, 1]; NaN gives 1.
fn alpha_from_perceptual_roughness(perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    return r * r;
}

// ---- brdf/lobe_anisotropic.wgsl

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

// ---- brdf/lobe_coat.wgsl

// Smallest channel of the coat's colour: its logarithm is taken.
const COLOR_FLOOR: f32 = 1e-6;

/// Parameters of the coat.
struct Coat {
    /// Presence of the coat in [0, 1].
    weight: f32,
    /// Transmittance through the coat and back, at normal incidence, in [0, 1].
    color: vec3f,
    /// Reflectance at normal incidence, ((ior - 1)/(ior + 1))^2.
    f0: f32,
    /// Square of the coat's perceptual roughness.
    alpha: f32,
}

/// Radiance that the coat reflects from an environment: `prefiltered_radiance` about its reflection at the coat's
/// roughness, times weight (f0 a + b) for the split-sum pair `dfg` at the coat's roughness.
fn coat_environment(p: Coat, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return prefiltered_radiance * (p.weight * (p.f0 * dfg.x + dfg.y));
}

/// What the base keeps of its own light below the coat, seen at n.v: 1 + weight (T (1 - f0 a - b) - 1), with the split-sum
/// pair `dfg` at the coat's roughness and the transmittance T = color^(1 / cos theta_t), cos theta_t the refracted cosine.
///
/// Beer and Lambert's law over the path of the refracted view ray. View-only. Each channel is in [0, 1].
fn coat_base(p: Coat, n_dot_v: f32, dfg: vec2f) -> vec3f {
    let s = sqrt(clamp(p.f0, 0.0, 0.9));
    let inv_eta = (1.0 - s) / (1.0 + s);
    let cos2 = mix(1.0, n_dot_v * n_dot_v, inv_eta * inv_eta);
    let path = inverseSqrt(max(cos2, 1e-4));
    let through = saturate(1.0 - p.f0 * dfg.x - dfg.y);
    let transmittance = exp2(log2(clamp(p.color, vec3f(COLOR_FLOOR), vec3f(1.0))) * path);
    return mix(vec3f(1.0), transmittance * through, saturate(p.weight));
}

// ---- brdf/lobe_diffuse.wgsl

/// Parameters of the diffuse lobe.
struct Diffuse {
    /// Albedo, linear Rec. 709.
    color: vec3f,
    /// Artist's roughness in [0, 1].
    perceptual_roughness: f32,
}

/// Radiance reflected from an environment: color times irradiance over pi. Exact for Lambert's BRDF.
fn diffuse_environment(p: Diffuse, irradiance_over_pi: vec3f) -> vec3f {
    return p.color * irradiance_over_pi;
}

// ---- brdf/lobe_sheen.wgsl

// Smallest perceptual roughness of the fit of the albedo.
const SHEEN_ROUGHNESS_FLOOR: f32 = 0.05;

// 1 / 1.06: what the lobe reflects where the fit would have it reflect all.
const SHEEN_ALBEDO_CEILING: f32 = 0.94339622641509433;

/// Parameters of the sheen.
struct Sheen {
    /// Colour times weight, linear Rec. 709, in [0, 1].
    color: vec3f,
    /// Artist's roughness in [0, 1]; held above 0.05.
    perceptual_roughness: f32,
}

/// Directional albedo of the white lobe before it is held at 1: our own fit to quadrature in the perceptual roughness r,
/// E = (0.347 + 0.1492 r + 0.1148 r^2) / r exp(-mu (b - mu (c - mu d))), b = 0.7769 + 1.4284 / r, c = 0.9992 + 1.1096 / r,
/// d = 0.2518 + 0.9523 / r + 0.1776 / r^2.
fn sheen_albedo(n_dot_w: f32, perceptual_roughness: f32) -> f32 {
    let r = clamp(perceptual_roughness, SHEEN_ROUGHNESS_FLOOR, 1.0);
    let inv_r = 1.0 / r;
    let at_grazing = (0.347 + r * (0.1492 + r * 0.1148)) * inv_r;
    // Each coefficient times log2(e).
    let b = 1.1208297772666358 + 2.0607455964057952 * inv_r;
    let c = 1.441540884856252 + 1.6008144173703938 * inv_r;
    let d = 0.36327061129584104 + inv_r * (1.37387848743856 + 0.25622263926187994 * inv_r);
    return at_grazing * exp2(-n_dot_w * (b - n_dot_w * (c - n_dot_w * d)));
}

/// Radiance that the sheen reflects from an environment, seen at n.v: color min(E, 1/1.06) times the radiance filtered by
/// the lobe: sheen_ring's, or, one lookup less and a worse fit, the irradiance over pi of the normal.
fn sheen_environment(p: Sheen, n_dot_v: f32, prefiltered_radiance: vec3f) -> vec3f {
    let albedo = min(sheen_albedo(n_dot_v, p.perceptual_roughness), SHEEN_ALBEDO_CEILING);
    return p.color * albedo * prefiltered_radiance;
}

/// What the base keeps of its own light below the sheen: 1 - max(color) min(E(v), 1). Estevez and Kulla 2017, albedo
/// scaling. View-only. In [0, 1].
fn sheen_base(p: Sheen, n_dot_v: f32) -> f32 {
    let albedo = min(sheen_albedo(n_dot_v, p.perceptual_roughness), 1.0);
    return saturate(1.0 - max(max(p.color.r, p.color.g), p.color.b) * albedo);
}

// ---- brdf/lobe_thin_film.wgsl

/// Parameters of the film.
struct ThinFilm {
    /// Presence of the film in [0, 1].
    weight: f32,
    /// Thickness [nm].
    thickness: f32,
    /// Index of refraction.
    ior: f32,
}

/// What the film adds to the reflectance at the cosine l.h of a base of reflectances f0 and f90, in [-1, 1]:
/// weight (f90 F_film - F(f0, f90)). For the light of a whole lobe it is added to both f0 and f90.
fn thin_film_shift(f0: vec3f, f90: vec3f, p: ThinFilm, l_dot_h: f32) -> vec3f {
    // ior_from_f0 of each channel.
    let s2 = clamp(f0 / max(f90, vec3f(F90_FLOOR)), vec3f(0.0), vec3f(F0_CEILING));
    let s = 1.0 + sqrt(s2);
    let film = f90 * f_thin_film_dielectric(p.ior, p.thickness, s * s / (1.0 - s2), l_dot_h);
    return saturate(p.weight) * (film - f_schlick(f0, f90, l_dot_h));
}

/// The cosine l.h at which Schlick's F is the lobe's mean, from the split-sum pair: b / (a + b) is the mean of
/// (1 - l.h)^5. An environment meets the film at it; on a smooth surface it is n.v.
fn thin_film_cosine(dfg: vec2f) -> f32 {
    let mean = clamp(dfg.y / max(dfg.x + dfg.y, 1e-6), 1e-30, 1.0);
    return 1.0 - pow(mean, 0.2);
}

/// What a film that adds `shift` to the reflectance changes of the light that passes the base: (1 - F - shift) / (1 - F), all
/// at one cosine. Held in [0, 4].
fn thin_film_through(shift: vec3f, f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    let bare = f_schlick(f0, f90, l_dot_h);
    return clamp(1.0 - shift / max(1.0 - bare, vec3f(1e-3)), vec3f(0.0), vec3f(4.0));
}

// ---- brdf/lobe_transmission.wgsl

/// Parameters of transmission.
struct Transmission {
    /// Share of the light that passes, linear Rec. 709.
    color: vec3f,
    /// Index of refraction behind the surface over the index on the viewer's side: ior from outside, 1 / ior from inside.
    eta: f32,
    /// Square of the perceptual roughness.
    alpha: f32,
}

/// The direction in which an environment is looked up for solid transmission: v refracted by the smooth surface, Snell's
/// law; where it is totally reflected, the grazing ray.
fn transmission_direction(frame: Frame, eta: f32) -> vec3f {
    let inv_eta = 1.0 / max(eta, 1e-6);
    let along = inv_eta * frame.n_dot_v - refracted_cosine(frame.n_dot_v, inv_eta);
    return normalize(frame.normal * along - frame.view_dir * inv_eta);
}

/// The cosine of v refracted by the smooth surface, Snell's law; 0 where it is totally reflected.
fn refracted_cosine(n_dot_v: f32, inv_eta: f32) -> f32 {
    return sqrt(max(mix(1.0, n_dot_v * n_dot_v, inv_eta * inv_eta), 0.0));
}

/// One lookup of an environment through a surface.
struct TransmissionLookup {
    /// Unit direction of the lookup in world space.
    dir: vec3f,
    /// The roughness of the lookup.
    perceptual_roughness: f32,
}

/// Where and how wide an environment is looked up for solid transmission. The microfacets that the viewer sees lean to
/// them: v is refracted about n + alpha (v - n.v n). A facet turned by an angle turns the refracted ray by
/// X = cos_t - n.v / eta of it out of its plane and by X / cos_t within, a reflected one by twice the angle: the lobe is as
/// wide as a reflection's of alpha X / (2 sqrt(cos_t)). 0.45 in the place of 1/2 and the lean are fitted to the integral.
fn transmission_lookup(frame: Frame, eta: f32, alpha: f32) -> TransmissionLookup {
    let leaning = frame.normal + alpha * (frame.view_dir - frame.n_dot_v * frame.normal);
    let facet = frame_from_normal(normalize(leaning), frame.view_dir);
    let inv_eta = 1.0 / max(eta, 1e-6);
    let cos_t = max(refracted_cosine(facet.n_dot_v, inv_eta), 0.01);
    let turn = abs(cos_t - facet.n_dot_v * inv_eta);
    return TransmissionLookup(transmission_direction(facet, eta), sqrt(saturate(0.45 * alpha * turn / sqrt(cos_t))));
}

/// Radiance that arrives through the surface from an environment: color (1 - f0 a - b) times the radiance of
/// transmission_lookup, or of a thin wall's lookup at the roughness itself, with the split-sum pair `dfg` and the interface's
/// f0.
/// The compression by eta^2 is left out: a ray that enters a body leaves it again.
fn transmission_environment(p: Transmission, f0: f32, transmitted_radiance: vec3f, dfg: vec2f) -> vec3f {
    return p.color * saturate(1.0 - f0 * dfg.x - dfg.y) * transmitted_radiance;
}

// ---- brdf/thin_film.wgsl

// Below this thickness [nm] the film's index goes to the outside's, so that a film of no thickness is none.
const FADE_THICKNESS: f32 = 30.0;

// Thickest film [nm]: from a few micrometres on all colours have merged and the result no longer changes.
const THICKNESS_CEILING: f32 = 1e5;

// Range of the film's index.
const FILM_IOR_CEILING: f32 = 10.0;

// Smallest index of film and base that is divided by.
const FILM_IOR_FLOOR: f32 = 1e-3;

// Largest index and extinction of the base; the fourth power must not overflow.
const BASE_IOR_CEILING: f32 = 1e6;

/// f_thin_film on a dielectric base, of index `base_eta` from 1 up: all amplitudes are real there, which is a third of the
/// work.
fn f_thin_film_dielectric(film_ior: f32, thickness: f32, base_eta: vec3f, cos_theta: f32) -> vec3f {
    // Above 0, and so is every denominator.
    let c1 = clamp(cos_theta, 1e-6, 1.0);
    let depth = clamp(thickness, 0.0, THICKNESS_CEILING);
    let present = min(depth * (1.0 / FADE_THICKNESS), 1.0);
    let fade = present * present * (3.0 - 2.0 * present);
    let ior = 1.0 + fade * (clamp(film_ior, FILM_IOR_FLOOR, FILM_IOR_CEILING) - 1.0);
    // 0 where the film reflects all: then nothing is lost below.
    let q = sqrt(max((ior - 1.0) * (ior + 1.0) + c1 * c1, 0.0));
    let tones = film_real_tones(2.0 * depth * q);
    let ior2 = ior * ior;
    let n = clamp(base_eta, vec3f(1.0), vec3f(BASE_IOR_CEILING));
    let a = sqrt((n - 1.0) * (n + 1.0) + c1 * c1);
    return saturate(1.0 - (film_loss(q, c1, a, tones) + film_loss(q, ior2 * c1, ior2 * a / (n * n), tones)));
}

/// The real parts of film_tones, a column for each order: five Gaussians at three orders as four vectors.
fn film_real_tones(path: f32) -> mat3x3f {
    let centres = vec4f(0.010258501116189029, 0.010910616526684985, 0.01405857181573468, 0.011209009787066005);
    let last_centre = vec3f(0.013915925235247472, 0.027831850470494944, 0.041747775705742416);
    // Minus half of log2(e), times the squares of the deviations.
    let spreads = vec4f(-1.3549409347110175e-7, -2.0767855249904617e-7, -2.757450462015585e-7, -5.038222444322254e-7);
    let last_spread = vec3f(-3.6136968939176454e-7, -1.4454787575670581e-6, -3.2523272045258807e-6);
    let weights = mat4x3f(
        1.341800362, -0.401351635, 0.023040702,
        1.218921421, -0.364596791, 0.020930688,
        0.519232538, -0.155309862, 0.008915993,
        -1.537138409, 1.876010867, -0.204025901,
    );
    let last_weight = vec3f(-0.542815912, 0.045247421, 1.151138518);
    let path2 = path * path;
    let last = exp2(path2 * last_spread) * cos(path * last_centre);
    let one = weights * (exp2(path2 * spreads) * cos(path * centres));
    let two = weights * (exp2(path2 * (4.0 * spreads)) * cos(path * (2.0 * centres)));
    let three = weights * (exp2(path2 * (9.0 * spreads)) * cos(path * (3.0 * centres)));
    return mat3x3f(one + last.xxx * last_weight, two + last.yyy * last_weight, three + last.zzz * last_weight);
}

/// What one polarisation does not reflect of its half of the light, (1 - R)/2 of film_series with the real amplitudes
/// -r12 = (q - c)/(q + c) and r23 = (q - a)/(q + a). With m = q^2 + c a and s = q (c + a) it is
/// 4 q c a / (m (c + a)) (1/2 + sum over j of z^j Re(..)), z = (m - s)/(m + s).
fn film_loss(q: f32, c: f32, a: vec3f, tones: mat3x3f) -> vec3f {
    let ca = c * a;
    let sum = c + a;
    let m = q * q + ca;
    let s = q * sum;
    let z = (m - s) / (m + s);
    return 4.0 * q * ca / (m * sum) * (0.5 + z * (tones[0] + z * (tones[1] + z * tones[2])));
}

// ---- color.wgsl

/// Gamma-encoded from linear with one power, the report's encode: c^(1/2.2). Negative values become 0.
fn gamma_from_linear(c: vec3f) -> vec3f {
    return pow(max(c, vec3f(0.0)), vec3f(1.0 / 2.2));
}

// ---- entry/transform.wgsl

/// A point of the object in world space: M p.
fn position_in_world(world_from_object: mat4x4f, position: vec3f) -> vec3f {
    return (world_from_object * vec4f(position, 1.0)).xyz;
}

/// A normal of the object in world space, unit. `normal_from_object` is |det M| (M^-1)^T of the upper 3x3 M, which exists
/// for flat transforms too. A vertex without a normal gives zero, which the interpolation then ignores.
fn normal_in_world(normal_from_object: mat3x3f, normal: vec3f) -> vec3f {
    return normalize_or(normal_from_object * normal, vec3f(0.0));
}

/// A tangent of the object in world space, unit, with the handedness in w: a tangent lies in the surface, so M carries it.
/// A transform that mirrors (det M < 0) turns cross(N, T) over, and so the handedness.
fn tangent_in_world(world_from_object: mat4x4f, tangent: vec4f) -> vec4f {
    let m = mat3x3f(world_from_object[0].xyz, world_from_object[1].xyz, world_from_object[2].xyz);
    let handedness = select(tangent.w, -tangent.w, determinant(m) < 0.0);
    return vec4f(normalize_or(m * tangent.xyz, vec3f(0.0)), handedness);
}

// ---- ibl/environment.wgsl

/// Level as the report reads it: lod = 5 roughness, for six levels 0..5 (fewer levels end at their last).
fn lod_report(perceptual_roughness: f32, levels: f32) -> f32 {
    return min(5.0 * perceptual_roughness, levels - 1.0);
}

/// Radiance that arrives from a direction, prefiltered as much as the level says; mixed linearly between levels.
/// `dir` need not be unit. An explicit level, so it may stand under control flow and in any stage.
fn environment_sample(cube: texture_cube<f32>, cube_sampler: sampler, dir: vec3f, lod: f32) -> vec3f {
    return textureSampleLevel(cube, cube_sampler, dir, lod).rgb;
}

// Texels on a side of the split-sum table.
const DFG_SIZE: f32 = 45.0;

/// Split-sum scale and bias (a, b) from a table of DFG_SIZE x DFG_SIZE texels: specular albedo = f0 a + f90 b.
/// Karis 2013, "Real Shading in Unreal Engine 4", the environment BRDF. Texel centre i of n holds the value at i / (n - 1),
/// along x for the fourth root of n_dot_v, from 0 up, and along y for the square root of the perceptual roughness: both ends of each
/// range are texels, and smooth surfaces at grazing angles, whose albedo changes within n_dot_v of about alpha, have most.
fn dfg_from_table(table: texture_2d<f32>, table_sampler: sampler, n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let place = sqrt(vec2f(sqrt(n_dot_v), saturate(perceptual_roughness)));
    let uv = place * vec2f((DFG_SIZE - 1.0) / DFG_SIZE) + vec2f(0.5 / DFG_SIZE);
    return textureSampleLevel(table, table_sampler, uv, 0.0).rg;
}

// ---- maps/height.wgsl

/// The position moved along its unit normal by `height` (a length in the position's unit).
fn displaced(position: vec3f, normal: vec3f, height: f32) -> vec3f {
    return position + normal * height;
}

// ---- math.wgsl

// Shortest squared length that is still divided by: below it lie the denormal numbers, which a GPU may flush to 0.
const LENGTH2_FLOOR: f32 = 1e-37;

// Longest squared length that is still divided by: above it the sum of squares overflows to infinity.
const LENGTH2_CEILING: f32 = 1e37;

// Every number of the library's domain is smaller; f32 ends at 3.4e38.
const FINITE_CEILING: f32 = 3e38;

/// x^5 by three products.
///
/// `pow(x, 5)` is exp2(5 log2(x)) on a GPU: NaN for x < 0, and some 10 ulp worse.
fn pow5(x: f32) -> f32 {
    let x2 = x * x;
    return x2 * x2 * x;
}

/// v / |v|, or `fallback` where v has no direction: zero, NaN, infinite, or of a length outside 3e-19 .. 3e18.
///
/// `fallback` is returned as it is. A comparison with NaN is false, so NaN takes the fallback too; `max` would not do,
/// WGSL leaves its result for NaN open.
fn normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
    let length2 = dot(v, v);
    let has_direction = clamp(length2, LENGTH2_FLOOR, LENGTH2_CEILING) == length2;
    return select(fallback, normalize(v), has_direction);
}

/// A unit direction across a unit normal, any.
fn any_tangent(normal: vec3f) -> vec3f {
    let aside = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.x) > 0.7);
    return normalize(cross(normal, aside));
}

/// The colour with each channel that is NaN or infinite set to 0.
///
/// What a shader ends in, so that one bad texel stays one dark pixel and does not spread through a filter. (The Rust lobes,
/// which are called one by one, each end in it.)
fn finite_or_zero(c: vec3f) -> vec3f {
    return select(vec3f(0.0), c, abs(c) < vec3f(FINITE_CEILING));
}
