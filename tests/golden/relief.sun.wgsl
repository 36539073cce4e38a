// Brushed relief, made by Halfvector
// serves: 1 directional light; returns linear radiance, Rec. 709
// methods: fresnel=schlick, compensation=turquin, dfg=table, height_normals=derived
// left out: environment light: the scene has no environment: 2 cubes and their lookups saved
// left out: diffuse lobe: metallic is 1: a metal reflects nothing diffusely
// left out: emission: it is 0
// left out: opacity: the material is opaque

struct View {
    clip_from_world: mat4x4f,
    camera_position: vec3f,
}
@group(0) @binding(0) var<uniform> view: View;
struct Lights {
    directional: DirectionalLight,
}
@group(0) @binding(1) var<uniform> lights: Lights;
@group(0) @binding(4) var dfg_table: texture_2d<f32>;
@group(0) @binding(5) var linear_clamp: sampler;
@group(1) @binding(0) var relief_texture: texture_2d<f32>;
@group(1) @binding(1) var linear_repeat: sampler;
struct Object {
    world_from_object: mat4x4f,
    normal_from_object: mat3x3f,
}
@group(2) @binding(0) var<uniform> object: Object;

struct VertexInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv0: vec2f,
}
struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) world_normal: vec3f,
    @location(2) world_tangent: vec4f,
    @location(3) uv0: vec2f,
}

@vertex
fn vs_main(in: VertexInput) -> Varyings {
    let world_position = position_in_world(object.world_from_object, in.position);
    let world_normal = normal_in_world(object.normal_from_object, in.normal);
    let world_tangent = tangent_in_world(object.world_from_object, in.tangent);
    let relief = blended_node_textures_image_vertex(relief_texture, linear_repeat, in.uv0); // Relief
    let height = relief.r * 0.05; // Height
    let displaced_position = displaced(world_position, world_normal, height);
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(displaced_position, 1.0);
    out.world_position = displaced_position;
    out.world_normal = world_normal;
    out.world_tangent = world_tangent;
    out.uv0 = in.uv0;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let relief = blended_node_textures_image(relief_texture, linear_repeat, in.uv0); // Relief
    let height = relief.r * 0.05; // Height
    let displaced_normal = normal_from_height(dpdx(in.world_position), dpdy(in.world_position), world_normal, dpdx(height), dpdy(height));
    let displaced_tangent_2 = displaced_tangent(world_normal, in.world_tangent, displaced_normal);
    let frame = frame_from_normal(displaced_normal, view_dir);
    let tangent = tangent_across(frame.normal, displaced_tangent_2);
    let alphas = anisotropic_alphas_gltf(max(0.4, PUNCTUAL_ROUGHNESS_FLOOR), 0.6);
    let specular_roughness = sqrt(sqrt(alphas.x * alphas.y));
    let specular = Anisotropic(vec3f(0.8), vec3f(1.0), tangent, alphas.x, alphas.y);
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, specular_roughness);
    let compensation = energy_compensation(specular.f0, specular.f90, dfg);
    let directional_light = directional_light_sample(lights.directional, in.world_position);
    var radiance = anisotropic_eval(frame, directional_light.dir, specular) * compensation * directional_light.illuminance;
    radiance = finite_or_zero(radiance);
    return vec4f(radiance, 1.0);
}

// ---- brdf/anisotropic.wgsl

// Smallest denominator of D's root: reached only for alphas below 1e-9, makes the 0 / 0 of alpha = 0 a 0.
const D_ANISOTROPIC_FLOOR: f32 = 1e-36;

// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0.
const V_ANISOTROPIC_FLOOR: f32 = 1e-36;

/// Burley 2012, Physically-Based Shading at Disney (appendix B); Heitz 2014, equation 85:
/// D = 1 / (pi alpha_t alpha_b ((t.h / alpha_t)^2 + (b.h / alpha_b)^2 + (n.h)^2)^2).
///
/// With s = alpha_t alpha_b and w = s / ((alpha_b t.h)^2 + (alpha_t b.h)^2 + (s n.h)^2) it is s w^2 / pi: no alpha is
/// divided by, and no square leaves f32 (w <= 1 / s).
fn d_ggx_anisotropic(h_in_tangent: vec3f, alpha_t: f32, alpha_b: f32) -> f32 {
    let s = alpha_t * alpha_b;
    let q = h_in_tangent * vec3f(alpha_b, alpha_t, s);
    let w = s / max(dot(q, q), D_ANISOTROPIC_FLOOR);
    return s * w * (w * INV_PI);
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equations 86 and 99 over 4 n.l n.v:
/// V = 1/2 / (n.l |(alpha_t t.v, alpha_b b.v, n.v)| + n.v |(alpha_t t.l, alpha_b b.l, n.l)|).
fn v_smith_ggx_anisotropic(view_in_tangent: vec3f, light_in_tangent: vec3f, alpha_t: f32, alpha_b: f32) -> f32 {
    let widths = vec3f(alpha_t, alpha_b, 1.0);
    let view = light_in_tangent.z * length(view_in_tangent * widths);
    let light = view_in_tangent.z * length(light_in_tangent * widths);
    return 0.5 / max(view + light, V_ANISOTROPIC_FLOOR);
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

/// The half vector h = (v + l) / |v + l| of one light, as the cosines that a microfacet lobe needs.
struct Half {
    /// n.l in [0, 1]; 0 where the light is behind the surface.
    n_dot_l: f32,
    /// n.h.
    n_dot_h: f32,
    /// l.h = v.h in [0, 1].
    l_dot_h: f32,
    /// sin^2 of the angle between n and h, as |n x h|^2.
    sin2_theta_h: f32,
    /// h, unit; zero where there is none.
    h: vec3f,
}

/// The frame of a unit shading normal and a unit direction to the viewer, with n.v held in [N_DOT_V_FLOOR, 1].
///
/// NaN in either gives n_dot_v = N_DOT_V_FLOOR.
fn frame_from_normal(normal: vec3f, view_dir: vec3f) -> Frame {
    return Frame(normal, view_dir, clamp(dot(normal, view_dir), N_DOT_V_FLOOR, 1.0));
}

/// The half vector of the unit direction `dir` to a light.
///
/// s = v + l,  l.h = |s| / 2,  n.h = n.s / |s|,  sin^2 = |n x s|^2 / |s|^2.
/// No term subtracts numbers of equal size but the cross product itself: 1 - (n.h)^2 has no correct digit left in f32
/// below an angle of 3e-4, and v.h by a dot product none where l is opposite to v.
/// Where v + l = 0 there is no half vector: l.h = n.h = 0 and sin^2 = 1, which is h in the tangent plane.
fn half_from_light(frame: Frame, dir: vec3f) -> Half {
    let sum = frame.view_dir + dir;
    let length2 = dot(sum, sum);
    let has_half = length2 > LENGTH2_FLOOR;
    let inv_length = select(0.0, inverseSqrt(length2), has_half);
    let h = sum * inv_length;
    let sine = cross(frame.normal, h);
    return Half(
        saturate(dot(frame.normal, dir)),
        dot(frame.normal, h),
        0.5 * length2 * inv_length,
        select(1.0, dot(sine, sine), has_half),
        h,
    );
}

// ---- brdf/fresnel.wgsl

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
fn f_schlick(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    return mix(f0, f90, pow5(max(1.0 - l_dot_h, 0.0)));
}

// ---- brdf/ggx.wgsl

// Perceptual roughness below which a highlight of a punctual light is narrower than f32 directions can resolve between
// neighbouring pixels; who shades with punctual lights holds the roughness above it. Environments have no floor.
const PUNCTUAL_ROUGHNESS_FLOOR: f32 = 0.045;

// ---- brdf/lobe_anisotropic.wgsl

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

// ---- brdf/multiscatter.wgsl

// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f32 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one. `f90` is not looked at: all methods have one
/// signature.
fn energy_compensation(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR, 1.0)), saturate(f0));
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

// ---- light.wgsl

/// A light so far away that its rays are parallel.
struct DirectionalLight {
    /// Unit direction from the surface to the light, in world space.
    direction: vec3f,
    /// Illuminance of a surface that faces it [lx].
    illuminance: vec3f,
}

/// What arrives at a point from a light.
struct LightSample {
    /// Unit direction from the point to the light, in world space; zero where the point is the light itself.
    dir: vec3f,
    /// Illuminance at normal incidence [lx].
    illuminance: vec3f,
}

// E = E_light everywhere.
fn directional_light_sample(light: DirectionalLight, position: vec3f) -> LightSample {
    return LightSample(light.direction, light.illuminance);
}

// ---- maps/height.wgsl

/// The position moved along its unit normal by `height` (a length in the position's unit).
fn displaced(position: vec3f, normal: vec3f, height: f32) -> vec3f {
    return position + normal * height;
}

/// The unit normal of the surface raised by a height field. Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the
/// GPU": with the derivatives of the position, p_x and p_y, along any two directions (the screen's),
///   R1 = p_y x n,  R2 = n x p_x,  det = p_x . R1,   grad = (h_x R1 + h_y R2) / det,   n' = normalize(n - grad)
/// The derivatives of the height are along the same two directions. `normal` is the old one, unit; an empty footprint keeps it.
/// Of the displaced position p + h n the derivatives along x are p_x + h n_x + h_x n, whose part across n holds how much wider or
/// narrower a curved surface is at that height: with them n' is exact. Those of p alone give the slope that it has at height 0.
fn normal_from_height(position_ddx: vec3f, position_ddy: vec3f, normal: vec3f, height_ddx: f32, height_ddy: f32) -> vec3f {
    let r1 = cross(position_ddy, normal);
    let r2 = cross(normal, position_ddx);
    let det = dot(position_ddx, r1);
    let gradient = (height_ddx * r1 + height_ddy * r2) / det;
    // A footprint of no area (under 1e-30, where 1 / det nears overflow) has no gradient.
    return normalize_or(normal - select(vec3f(0.0), gradient, abs(det) > 1e-30), normal);
}

/// The tangent (w is its handedness) of the surface raised by a height field: moved along the old normal into the new surface,
///   t' ~ t - n (t . n') / (n . n')
/// which for a flat surface is t + n (t . grad h), exactly. Written as t (n . n') - n (t . n'), which divides by nothing; not unit. Both
/// normals are unit.
fn displaced_tangent(normal: vec3f, tangent: vec4f, displaced_normal: vec3f) -> vec4f {
    let moved = tangent.xyz * dot(normal, displaced_normal) - normal * dot(tangent.xyz, displaced_normal);
    return vec4f(moved, tangent.w);
}

// ---- math.wgsl

const INV_PI: f32 = 0.31830988618379067154;

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

// ---- nodes/textures/blend_texels.wgsl

/// One level of a picture: the four texels around the place, blended bilinearly.
fn blended_texels(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, level: u32) -> vec4f {
    let size = vec2f(max(textureDimensions(image) >> vec2u(level), vec2u(1u)));
    let place = uv * size - 0.5;
    let corner = floor(place);
    let weight = place - corner;
    let low = (corner + 0.5) / size;
    let high = (corner + 1.5) / size;
    let lod = f32(level);
    let above_left = textureSampleLevel(image, image_sampler, low, lod);
    let above_right = textureSampleLevel(image, image_sampler, vec2f(high.x, low.y), lod);
    let below_left = textureSampleLevel(image, image_sampler, vec2f(low.x, high.y), lod);
    let below_right = textureSampleLevel(image, image_sampler, high, lod);
    return mix(mix(above_left, above_right, weight.x), mix(below_left, below_right, weight.x), weight.y);
}

/// A picture at a level that may lie between two of its own, which are blended linearly.
fn blended_level(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, lod: f32) -> vec4f {
    // No texture has more than 2^15 texels a side.
    let level = clamp(lod, 0.0, 15.0);
    let fine = blended_texels(image, image_sampler, uv, u32(level));
    let part = fract(level);
    // Magnified: four reads do.
    if part == 0.0 {
        return fine;
    }
    return mix(fine, blended_texels(image, image_sampler, uv, u32(level) + 1u), part);
}

/// A picture at the level whose texels are as wide as a pixel is, as a sampler chooses it, at least 0; the pixel's sides are given in
/// coordinates of the picture.
fn blended_grad(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, uv_ddx: vec2f, uv_ddy: vec2f) -> vec4f {
    let size = vec2f(textureDimensions(image));
    let x = uv_ddx * size;
    let y = uv_ddy * size;
    return blended_level(image, image_sampler, uv, 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0)));
}

/// A picture at the pixel's own level: one for a block of 2 x 2 pixels, whose difference is then one of places, and not of levels.
fn blended_sample(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> vec4f {
    return blended_grad(image, image_sampler, uv, dpdxCoarse(uv), dpdyCoarse(uv));
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

/// For a slope, with texels blended by arithmetic:
///
/// Image
///
/// Reads a picture, with mip levels. Mark colours as sRGB, and everything else (roughness, normals, heights) as linear.
fn blended_node_textures_image(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs {
    let texel = blended_sample(image, image_sampler, uv);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}

/// For a slope, with texels blended by arithmetic:
///
/// The image read at its finest level: the vertex stage has no derivatives to choose another one by.
fn blended_node_textures_image_vertex(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs {
    let texel = blended_level(image, image_sampler, uv, 0.0);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
