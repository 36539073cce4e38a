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
    let frame = frame_from_normal(world_normal, view_dir);
    let specular = Specular(f0, vec3f(f90), alpha_from_perceptual_roughness(parameters.perceptual_roughness));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, parameters.perceptual_roughness);
    let diffuse = Diffuse(diffuse_albedo, parameters.perceptual_roughness);
    let reflection_dir = reflect(-frame.view_dir, frame.normal);
    let irradiance = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(1.0, view.environment_levels)));
    var radiance = diffuse_environment(diffuse, irradiance) * parameters.occlusion;
    let reflection_lod = lod_report(parameters.perceptual_roughness, view.environment_levels);
    let reflection = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, reflection_lod));
    radiance += specular_environment(specular, reflection, dfg) * parameters.occlusion;
    radiance += parameters.emission;
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
