// A sheet of glass, made by Halfvector
// serves: an environment; returns linear radiance, Rec. 709
// methods: dfg=table, prefilter=ggx, level_map=hermite, reflection=leaning
// left out: diffuse lobe: transmission_weight is 1: what enters the surface leaves it behind
// left out: metal: metallic is 0: f0 comes from the index of refraction alone
// left out: energy compensation: f0 is 0.040 and perceptual roughness 0.200, both fixed: it would change the specular
//     lobe by less than 0.8 %
// left out: emission: it is 0
// left out: occlusion: it is 1
// left out: horizon: the shading normal is the geometry's: no reflection comes from below
// left out: opacity: the material is opaque
// left out: displacement: height is 0

struct View {
    clip_from_world: mat4x4f,
    camera_position: vec3f,
    environment_levels: f32,
}
@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(2) var prefiltered_radiance: texture_cube<f32>;
@group(0) @binding(4) var dfg_table: texture_2d<f32>;
@group(0) @binding(5) var linear_clamp: sampler;
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
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(world_position, 1.0);
    out.world_position = world_position;
    out.world_normal = world_normal;
    return out;
}

@fragment
fn fs_main(in: Varyings, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let normal = select(-world_normal, world_normal, front_facing);
    let frame = frame_from_normal(normal, view_dir);
    let specular = Specular(vec3f(0.07692309), vec3f(1.0), alpha_from_perceptual_roughness(0.2));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, 0.2);
    let transmission = Transmission(vec3f(0.8, 0.9, 1.0), 1.5, alpha_from_perceptual_roughness(0.2));
    let reflection_dir = specular_direction(frame, reflect(-frame.view_dir, frame.normal), 0.2);
    let reflection = environment_sample_hermite(prefiltered_radiance, linear_clamp, reflection_dir, lod_geometric(0.2, view.environment_levels));
    let transmitted = environment_sample_hermite(prefiltered_radiance, linear_clamp, -specular_direction(frame, frame.view_dir, 0.2), lod_geometric(0.2, view.environment_levels));
    var radiance = specular_environment(specular, reflection, dfg);
    radiance += transmission_environment(transmission, 0.07692309, transmitted, dfg);
    radiance = finite_or_zero(radiance);
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
    return Frame(normal, view_dir, clamp(dot(normal, view_dir), N_DOT_V_FLOOR, 1.0));
}

// ---- brdf/ggx.wgsl

/// alpha = perceptual_roughness^2. Burley 2012, Physically-Based Shading at Disney.
///
/// Held in [0, 1]; NaN gives 1.
fn alpha_from_perceptual_roughness(perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    return r * r;
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

/// Radiance that arrives through the surface from an environment: color (1 - f0 a - b) times the radiance of
/// transmission_lookup, or of a thin wall's lookup at the roughness itself, with the split-sum pair `dfg` and the interface's
/// f0.
/// The compression by eta^2 is left out: a ray that enters a body leaves it again.
fn transmission_environment(p: Transmission, f0: f32, transmitted_radiance: vec3f, dfg: vec2f) -> vec3f {
    return p.color * saturate(1.0 - f0 * dfg.x - dfg.y) * transmitted_radiance;
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

/// Level that holds a perceptual roughness when level 0 is the unfiltered environment, level 1 is prefiltered for 0.1, the
/// last for 1, and each between them for the same multiple of the one before.
fn lod_geometric(perceptual_roughness: f32, levels: f32) -> f32 {
    let place = 10.0 * perceptual_roughness;
    let above = (levels - 2.0) * (log2(max(place, 1.0)) / log2(10.0));
    return min(min(place, 1.0) + above, levels - 1.0);
}

/// Radiance between two levels of which the fourth channel holds how log2(red + green + blue) changes from level to level,
/// as a derivative; `t` is 0 at `near` and 1 at `far`.
/// Where a lobe meets a lamp the light goes with a power of its width, falling in the middle and rising outside, so that
/// logarithms are mixed: of the colours linearly, and of their sum by Hermite's cubic, which also follows the slopes.
/// Black is taken as 1e-7, about the least that half precision holds.
fn mix_levels(near: vec4f, far: vec4f, t: f32) -> vec3f {
    let one = vec3f(1.0);
    let n = max(near.rgb, vec3f(1e-7));
    let f = max(far.rgb, vec3f(1e-7));
    let rise = log2(dot(f, one) / dot(n, one));
    let bend = t * (1.0 - t) * mix(near.a - rise, rise - far.a, t);
    return pow(f / n, vec3f(t)) * n * exp2(bend);
}

/// Radiance that arrives from a direction, prefiltered as much as the level says, from levels with slopes: see
/// `mix_levels`. Below level 1, where the environment itself may be black, the mix is linear.
fn environment_sample_hermite(cube: texture_cube<f32>, cube_sampler: sampler, dir: vec3f, lod: f32) -> vec3f {
    let mip = floor(lod);
    let near = textureSampleLevel(cube, cube_sampler, dir, mip);
    let far = textureSampleLevel(cube, cube_sampler, dir, mip + 1.0);
    let t = lod - mip;
    return select(mix_levels(near, far, t), mix(near.rgb, far.rgb, t), lod < 1.0);
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
    let has_direction = clamp(length2, LENGTH2_FLOOR, LENGTH2_CEILING) == length2;
    return select(fallback, normalize(v), has_direction);
}

/// The colour with each channel that is NaN or infinite set to 0.
///
/// What a shader ends in, so that one bad texel stays one dark pixel and does not spread through a filter. (The Rust lobes,
/// which are called one by one, each end in it.)
fn finite_or_zero(c: vec3f) -> vec3f {
    return select(vec3f(0.0), c, abs(c) < vec3f(FINITE_CEILING));
}
