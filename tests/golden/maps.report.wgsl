// Four maps, made by Halfvector
// serves: an environment; returns linear radiance, Rec. 709
// methods: coupling=none, dfg=table, prefilter=ggx, level_map=report, irradiance=last_level, reflection=mirror,
//     encode=report
// left out: energy compensation: the method is `none`: single scattering only
// left out: emission: it is 0
// left out: occlusion: it is 1
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
@group(1) @binding(0) var albedo_texture: texture_2d<f32>;
@group(1) @binding(1) var metalness_texture: texture_2d<f32>;
@group(1) @binding(2) var roughness_texture: texture_2d<f32>;
@group(1) @binding(3) var normal_texture: texture_2d<f32>;
@group(1) @binding(4) var linear_repeat: sampler;
struct Object {
    world_from_object: mat4x4f,
    normal_from_object: mat3x3f,
}
@group(2) @binding(0) var<uniform> object: Object;

struct VertexInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(3) uv0: vec2f,
}
struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) world_normal: vec3f,
    @location(2) uv0: vec2f,
}

@vertex
fn vs_main(in: VertexInput) -> Varyings {
    let world_position = position_in_world(object.world_from_object, in.position);
    let world_normal = normal_in_world(object.normal_from_object, in.normal);
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(world_position, 1.0);
    out.world_position = world_position;
    out.world_normal = world_normal;
    out.uv0 = in.uv0;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let albedo = node_textures_image(albedo_texture, linear_repeat, in.uv0); // Albedo
    let metalness = node_textures_image(metalness_texture, linear_repeat, in.uv0); // Metalness
    let roughness = node_textures_image(roughness_texture, linear_repeat, in.uv0); // Roughness
    let normal_2 = node_textures_image(normal_texture, linear_repeat, in.uv0); // Normal
    let normal_map = node_textures_normal_map_rotation_report(normal_2.color, 1.0, false, world_normal); // Normal map
    let diffuse_albedo = albedo.color * (1.0 - metalness.r);
    let f0 = mix(vec3f(0.040000003), albedo.color, metalness.r);
    let frame = frame_from_normal(normal_map, view_dir);
    let specular = Specular(f0, vec3f(1.0), alpha_from_perceptual_roughness(roughness.r));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, roughness.r);
    let diffuse = Diffuse(diffuse_albedo, roughness.r);
    let reflection_dir = reflect(-frame.view_dir, frame.normal);
    let irradiance = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(1.0, view.environment_levels)));
    let reflection = gamma_from_linear(environment_sample(prefiltered_radiance, linear_clamp, reflection_dir, lod_report(roughness.r, view.environment_levels)));
    var radiance = diffuse_environment(diffuse, irradiance);
    radiance += specular_environment(specular, reflection, dfg);
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

/// Karis 2013, Real Shading in Unreal Engine 4, the split sum: prefiltered radiance about the reflection times
/// the lobe's directional albedo.
fn specular_environment(p: Specular, prefiltered_radiance: vec3f, dfg: vec2f) -> vec3f {
    return prefiltered_radiance * specular_albedo(p.f0, p.f90, dfg);
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

// ---- maps/normal.wgsl

/// The tangent-space unit normal that a texel says: t = 2 c - 1, x and y scaled by `strength`, y turned over by
/// `flip_y`. A texel that says nothing, such as (.5, .5, .5), is straight up. Read as unorm: 8-bit (128, 128, 255) leans
/// by 0.32 degrees.
fn normal_from_texel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    return normalize_or(tilt_from_texel(color, strength, flip_y), vec3f(0.0, 0.0, 1.0));
}

/// normal_from_texel before it is made unit; zero for a texel that says nothing.
fn tilt_from_texel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    let t = fma(color, vec3f(2.0), vec3f(-1.0));
    let y = select(t.y, -t.y, flip_y);
    return vec3f(t.x * strength, y * strength, t.z);
}

// (cos, sin) of atan2(y, x), without the angle: (x, y) / |(x, y)|. Both zero is the angle 0.
fn cos_sin_atan2(y: f32, x: f32) -> vec2f {
    let length_squared = x * x + y * y;
    return select(vec2f(1.0, 0.0), vec2f(x, y) * inverseSqrt(length_squared), length_squared > 0.0);
}

// (cos, sin) of atan(y / x), without the angle: atan2 with the fraction's sign carried by y.
// atan(y / 0) = sign(y) pi/2 and atan(0 / 0) = 0.
fn cos_sin_atan(y: f32, x: f32) -> vec2f {
    return cos_sin_atan2(select(y, -y, x < 0.0), abs(x));
}

/// Normal mapping by rotation, exactly as the report gives it: with t the texel's direction,
///   ax = atan(t.y / t.z),  ay = atan(t.x / t.z),  az = atan(t.y / t.z),   n = Rz(az) Ry(ay) Rx(ax) N
/// about the axes of the space that N is in (world). Only cosine and sine of the angles are needed, and those are
/// algebraic. It is kept to be measured: it needs no tangents. On N = +X it is near the truth (Rz is the turn that lifts
/// that normal); on +Z a tilt in y becomes a tilt of twice itself the other way.
fn normal_rotation_report(n_tangent: vec3f, normal: vec3f) -> vec3f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let x = cos_sin_atan(n_tangent.y, n_tangent.z);
    let y = cos_sin_atan(n_tangent.x, n_tangent.z);
    let z = x;
    let about_x = vec3f(n.x, x.x * n.y - x.y * n.z, x.y * n.y + x.x * n.z);
    let about_y = vec3f(y.x * about_x.x + y.y * about_x.z, about_x.y, y.x * about_x.z - y.y * about_x.x);
    let about_z = vec3f(z.x * about_y.x - z.y * about_y.y, z.y * about_y.x + z.x * about_y.y, about_y.z);
    return normalize_or(about_z, n);
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

// ---- nodes/textures/image.wgsl

/// The outputs of the node textures/image.
struct ImageOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// coverage; 1 for an image without it
    alpha: f32,
    /// red channel
    r: f32,
    /// green channel
    g: f32,
    /// blue channel
    b: f32,
}

/// Image
///
/// Reads a picture, with mip levels. Mark colours as sRGB, and everything else (roughness, normals, heights) as linear.
fn node_textures_image(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs {
    let texel = textureSample(image, image_sampler, uv);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}

// ---- nodes/textures/normal_map.wgsl

/// The normal map by three rotations as the report gives them: it needs no tangent.
fn node_textures_normal_map_rotation_report(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_report(normal_from_texel(color, strength, flip_y), normal);
}
