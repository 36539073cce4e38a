// Surface, made by Halfvector
// serves: an environment; returns linear radiance, Rec. 709
// methods: coupling=none, dfg=table, prefilter=ggx, level_map=report, irradiance=last_level,
//     specular_occlusion=plain, height_normals=report, encode=report
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
    metallic: f32,
    perceptual_roughness: f32,
    ior: f32,
    specular: f32,
    occlusion: f32,
    emission: vec3f,
    height: f32,
    coat_weight: f32,
    coat_color: vec3f,
    coat_roughness: f32,
    coat_ior: f32,
    sheen_color: vec3f,
    sheen_roughness: f32,
    transmission_weight: f32,
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
}
struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) world_normal: vec3f,
}

@vertex
fn vs_main(in: VertexInput) -> Varyings {
    let world_position = position_in_world(object.world_from_object, in.position);
    let world_normal = normal_in_world(object.normal_from_object, in.normal);
    let displaced_position = displaced(world_position, world_normal, parameters.height);
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(displaced_position, 1.0);
    out.world_position = displaced_position;
    out.world_normal = world_normal;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let diffuse_albedo = parameters.base_color * (1.0 - parameters.metallic);
    let dielectric_f0 = f0_from_ior(parameters.ior);
    let dielectric_f0_2 = dielectric_f0 * parameters.specular;
    let f0 = f0_from_metallic(parameters.base_color, parameters.metallic, dielectric_f0_2);
    let f90 = mix(parameters.specular, 1.0, parameters.metallic);
    let coat_f0 = f0_from_ior(parameters.coat_ior);
    let frame = frame_from_normal(world_normal, view_dir);
    let specular = Specular(f0, vec3f(f90), alpha_from_perceptual_roughness(parameters.perceptual_roughness));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, parameters.perceptual_roughness);
    let diffuse = Diffuse(diffuse_albedo * (1.0 - parameters.transmission_weight), parameters.perceptual_roughness);
    let transmission = Transmission(diffuse_albedo * parameters.transmission_weight, parameters.ior, alpha_from_perceptual_roughness(parameters.perceptual_roughness));
    let coat = Coat(parameters.coat_weight, parameters.coat_color, coat_f0, alpha_from_perceptual_roughness(parameters.coat_roughness));
    let coat_dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, parameters.coat_roughness);
    let under_coat = coat_base(coat, frame.n_dot_v, coat_dfg);
    let sheen = Sheen(parameters.sheen_color, parameters.sheen_roughness);
    let under_sheen = sheen_base(sheen, frame.n_dot_v);
    let under_layers = under_coat * under_sheen;
    let reflection_dir = reflect(-frame.view_dir, frame.normal);
    let irradiance = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(1.0, view.environment_levels)));
    var radiance = diffuse_environment(diffuse, irradiance) * parameters.occlusion * under_layers;
    let reflection = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(parameters.perceptual_roughness, view.environment_levels)));
    radiance += specular_environment(specular, reflection, dfg) * parameters.occlusion * under_layers;
    let transmitted = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, transmission_direction(frame, transmission.eta), lod_report(parameters.perceptual_roughness, view.environment_levels)));
    radiance += transmission_environment(transmission, dielectric_f0_2, transmitted, dfg) * under_layers;
    let coat_mirror_dir = reflect(-frame.view_dir, frame.normal);
    let coat_reflection = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, coat_mirror_dir, lod_report(parameters.coat_roughness, view.environment_levels)));
    radiance += coat_environment(coat, coat_reflection, coat_dfg) * parameters.occlusion * under_sheen;
    radiance += sheen_environment(sheen, frame.n_dot_v, irradiance) * parameters.occlusion;
    radiance += parameters.emission * under_layers;
    return vec4f(radiance, 1.0);
}

// ---- brdf/dfg.wgsl

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
fn specular_albedo(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return f0 * dfg.x + f90 * dfg.y;
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
    let n_dot_v = dot(normal, view_dir);
    return Frame(normal, view_dir, select(N_DOT_V_FLOOR, min(n_dot_v, 1.0), n_dot_v > N_DOT_V_FLOOR));
}

// ---- brdf/fresnel.wgsl

// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f32 = 1e9;

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
    let r = select(1.0, max(perceptual_roughness, 0.0), perceptual_roughness < 1.0);
    return r * r;
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

/// Radiance that the coat reflects from an environment: `prefiltered_radiance` of the mirror direction at the coat's
/// roughness, times weight (f0 a + b) for the split-sum pair `dfg` at the coat's roughness.
fn coat_environment(p: Coat, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(prefiltered_radiance * (p.weight * (p.f0 * dfg.x + dfg.y)));
}

/// What the base keeps of its own light below the coat, seen at n.v: 1 + weight (T (1 - f0 a - b) - 1), with the split-sum
/// pair `dfg` at the coat's roughness and the transmittance T = color^(1 / cos theta_t), cos theta_t the refracted cosine.
///
/// Beer and Lambert's law over the path of the refracted view ray. View-only. Each channel is in [0, 1].
fn coat_base(p: Coat, n_dot_v: f32, dfg: vec2f) -> vec3f {
    let s = sqrt(clamp(p.f0, 0.0, 0.9));
    let inv_eta = (1.0 - s) / (1.0 + s);
    let mu = saturate(n_dot_v);
    let cos2 = 1.0 - inv_eta * inv_eta * (1.0 - mu * mu);
    let path = 1.0 / sqrt(max(cos2, 1e-4));
    let through = saturate(1.0 - p.f0 * dfg.x - dfg.y);
    let transmittance = exp2(log2(clamp(p.color, vec3f(COLOR_FLOOR), vec3f(1.0))) * path);
    return 1.0 + saturate(p.weight) * (transmittance * through - 1.0);
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
    return finite_or_zero(p.color * irradiance_over_pi);
}

// ---- brdf/lobe_sheen.wgsl

// Smallest perceptual roughness of the fit of the albedo.
const SHEEN_ROUGHNESS_FLOOR: f32 = 0.05;

/// Parameters of the sheen.
struct Sheen {
    /// Colour times weight, linear Rec. 709, in [0, 1].
    color: vec3f,
    /// Artist's roughness in [0, 1]; held above 0.05.
    perceptual_roughness: f32,
}

/// Directional albedo of the white lobe before it is held at 1: our own fit to quadrature in the perceptual roughness r,
/// E = (0.3848 + 0.0543 r + 0.1748 r^2) / r exp(-(1.0701 + 1.0386 / r - 0.7959 r) mu^0.89).
fn sheen_albedo(n_dot_w: f32, perceptual_roughness: f32) -> f32 {
    let r = clamp(perceptual_roughness, SHEEN_ROUGHNESS_FLOOR, 1.0);
    let inv_r = 1.0 / r;
    let mu = clamp(n_dot_w, 1e-7, 1.0);
    let at_grazing = (0.3848 + r * (0.0543 + r * 0.1748)) * inv_r;
    let falloff = 1.0701 + 1.0386 * inv_r - 0.7959 * r;
    // log2(e) = 1.4426950408889634
    return at_grazing * exp2(-1.4426950408889634 * falloff * exp2(0.89 * log2(mu)));
}

/// Radiance that the sheen reflects from an environment, seen at n.v: color min(E, 1) times the radiance filtered by the
/// lobe. It is wide: who has no level filtered by Charlie's distribution gives the irradiance over pi.
fn sheen_environment(p: Sheen, n_dot_v: f32, prefiltered_radiance: vec3f) -> vec3f {
    return finite_or_zero(p.color * min(sheen_albedo(n_dot_v, p.perceptual_roughness), 1.0) * prefiltered_radiance);
}

/// What the base keeps of its own light below the sheen: 1 - max(color) min(E(v), 1). Estevez and Kulla 2017, albedo
/// scaling. View-only. In [0, 1].
fn sheen_base(p: Sheen, n_dot_v: f32) -> f32 {
    let albedo = min(sheen_albedo(n_dot_v, p.perceptual_roughness), 1.0);
    return saturate(1.0 - max(max(p.color.r, p.color.g), p.color.b) * albedo);
}

// ---- brdf/lobe_specular.wgsl

/// Parameters of the specular lobe.
struct Specular {
    /// Reflectance at normal incidence.
    f0: vec3f,
    /// Reflectance at grazing incidence.
    f90: vec3f,
    /// Square of the perceptual roughness.
    alpha: f32,
}

/// Karis 2013, Real Shading in Unreal Engine 4, the split sum: prefiltered radiance of the mirror direction times the
/// lobe's directional albedo.
fn specular_environment(p: Specular, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(prefiltered_radiance * specular_albedo(p.f0, p.f90, dfg));
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
/// law; where it is totally reflected, the grazing ray. For a thin wall it is -v.
fn transmission_direction(frame: Frame, eta: f32) -> vec3f {
    let inv_eta = 1.0 / max(eta, 1e-6);
    let cos2 = 1.0 - inv_eta * inv_eta * (1.0 - frame.n_dot_v * frame.n_dot_v);
    let along = inv_eta * frame.n_dot_v - sqrt(max(cos2, 0.0));
    return normalize_or(frame.normal * along - frame.view_dir * inv_eta, -frame.normal);
}

/// Radiance that arrives through the surface from an environment: color (1 - f0 a - b) times the radiance of
/// transmission_direction, filtered by the lobe's roughness, with the split-sum pair `dfg` and the interface's f0.
/// The compression by eta^2 is left out: a ray that enters a body leaves it again.
fn transmission_environment(p: Transmission, f0: f32, transmitted_radiance: vec3f, dfg: vec2f) -> vec3f {
    return finite_or_zero(p.color * saturate(1.0 - f0 * dfg.x - dfg.y) * transmitted_radiance);
}

// ---- brdf/metallic_roughness.wgsl

/// Reflectance at normal incidence: dielectric_f0 (1 - metallic) + base_color metallic.
fn f0_from_metallic(base_color: vec3f, metallic: f32, dielectric_f0: f32) -> vec3f {
    return vec3f(dielectric_f0 * (1.0 - metallic)) + base_color * metallic;
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

/// Split-sum scale and bias (a, b) from a square table: specular albedo = f0 a + f90 b.
/// Karis 2013, "Real Shading in Unreal Engine 4", the environment BRDF. Texel centre i of n holds the value at i / (n - 1),
/// along x for the fourth root of n_dot_v and along y for the square root of the perceptual roughness: both ends of each
/// range are texels, and smooth surfaces at grazing angles, whose albedo changes within n_dot_v of about alpha, have most.
fn dfg_from_table(table: texture_2d<f32>, table_sampler: sampler, n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let size = vec2f(textureDimensions(table));
    let place = sqrt(vec2f(sqrt(saturate(n_dot_v)), saturate(perceptual_roughness)));
    let uv = (place * (size - 1.0) + 0.5) / size;
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

/// v / |v|, or `fallback` where v has no direction: zero, NaN, infinite, or of a length outside 3e-19 .. 3e18.
///
/// `fallback` is returned as it is. A comparison with NaN is false, so NaN takes the fallback too; `max` would not do,
/// WGSL leaves its result for NaN open.
fn normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
    let length2 = dot(v, v);
    let has_direction = (length2 > LENGTH2_FLOOR) & (length2 < LENGTH2_CEILING);
    return select(fallback, v * inverseSqrt(length2), has_direction);
}

/// The colour with each channel that is NaN or infinite set to 0.
///
/// The last line of every lobe, so that one bad texel stays one dark pixel and does not spread through a filter.
fn finite_or_zero(c: vec3f) -> vec3f {
    return select(vec3f(0.0), c, abs(c) < vec3f(FINITE_CEILING));
}
