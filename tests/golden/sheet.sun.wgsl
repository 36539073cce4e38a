// A sheet of glass, made by Halfvector
// serves: 1 directional light; returns linear radiance, Rec. 709
// methods: d=ggx, v=correlated, fresnel=schlick, dfg=table
// left out: environment light: the scene has no environment: 2 cubes and their lookups saved
// left out: diffuse lobe: transmission_weight is 1: what enters the surface leaves it behind
// left out: metal: metallic is 0: f0 comes from the index of refraction alone
// left out: energy compensation: f0 is 0.040 and perceptual roughness 0.200, both fixed: it would change the specular
//     lobe by less than 0.8 %
// left out: emission: it is 0
// left out: opacity: the material is opaque
// left out: displacement: height is 0

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
    let specular = Specular(vec3f(0.07692309), vec3f(1.0), alpha_from_perceptual_roughness(max(0.2, PUNCTUAL_ROUGHNESS_FLOOR)));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, 0.2);
    let transmission = Transmission(vec3f(0.8, 0.9, 1.0), 1.5, alpha_from_perceptual_roughness(max(0.2, PUNCTUAL_ROUGHNESS_FLOOR)));
    let transmission_gain = transmission_thin_compensation(0.07692309, dfg);
    let directional_light = directional_light_sample(lights.directional, in.world_position);
    var directional_lit = specular_eval(frame, directional_light.dir, specular);
    directional_lit += transmission_thin_eval(frame, directional_light.dir, transmission) * transmission_gain;
    var radiance = directional_lit * directional_light.illuminance;
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

// Perceptual roughness below which a highlight of a punctual light is narrower than f32 directions can resolve between
// neighbouring pixels; who shades with punctual lights holds the roughness above it. Environments have no floor.
const PUNCTUAL_ROUGHNESS_FLOOR: f32 = 0.045;

// Smallest denominator of D's root. It is reached only for alpha < 1e-9 (perceptual roughness 3e-5), keeps D <= 3.2e35
// for any cosines, and makes the 0 / 0 of alpha = 0 a 0.
const D_FLOOR: f32 = 1e-18;

// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0, where V is infinite and V n.l is 0.
const V_FLOOR: f32 = 1e-36;

/// alpha = perceptual_roughness^2. Burley 2012, Physically-Based Shading at Disney.
///
/// Held in [0, 1]; NaN gives 1.
fn alpha_from_perceptual_roughness(perceptual_roughness: f32) -> f32 {
    let r = saturate(perceptual_roughness);
    return r * r;
}

/// Walter, Marschner, Li, Torrance 2007, Microfacet Models for Refraction through Rough Surfaces:
/// D = alpha^2 / (pi ((n.h)^2 alpha^2 + |n x h|^2)^2).
///
/// With k = alpha / ((n.h)^2 alpha^2 + |n x h|^2) it is k^2 / pi: k is at most 1 / alpha where the square of the
/// denominator would be alpha^4. 1 - (n.h)^2 in the place of |n x h|^2 loses every digit at the peak.
/// alpha = 0 is a mirror, whose D is a delta: 0 here.
fn d_ggx(n_dot_h: f32, sin2_theta_h: f32, alpha: f32) -> f32 {
    let a = n_dot_h * alpha;
    let k = alpha / max(a * a + sin2_theta_h, D_FLOOR);
    return k * (k * INV_PI);
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equation 99 over 4 n.l n.v:
/// V = 1/2 / (n.l sqrt(alpha^2 + (1 - alpha^2)(n.v)^2) + n.v sqrt(alpha^2 + (1 - alpha^2)(n.l)^2)).
fn v_smith_ggx_correlated(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_l * sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_v * sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 0.5 / max(view + light, V_FLOOR);
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

/// Cook and Torrance 1982, A Reflectance Model for Computer Graphics: D V F times n.l for the unit direction `l` to a
/// light, V = G / (4 n.l n.v), in 1/sr; 0 where the light is behind the surface.
///
/// V n.l is taken first: it is at most 1/2 / max(alpha, n.v), while V alone is infinite at n.l = n.v = 0.
fn specular_eval(frame: Frame, l: vec3f, p: Specular) -> vec3f {
    let f = f_schlick(p.f0, p.f90, half_from_light(frame, l).l_dot_h);
    return f * specular_lit(frame, l, p);
}

/// specular_eval without its F: D V n.l.
fn specular_lit(frame: Frame, l: vec3f, p: Specular) -> f32 {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    return v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha) * h.n_dot_l * d;
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

/// f0 of a surface of which `weight` is a sheet with two faces: all bounces between them together reflect 2 f / (1 + f),
/// and the rest, (1 - f) / (1 + f), passes.
fn f0_of_sheet(f0: f32, weight: f32) -> f32 {
    return f0 + weight * (f0 * (1.0 - f0) / (1.0 + f0));
}

/// Thin-walled: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it: a reflection whose light
/// is mirrored at the surface, color (1 - F) D V |n.l|, F of both faces, Schlick's from f0_of_sheet as in the reflection, so
/// that a smooth sheet keeps all light.
fn transmission_thin_eval(frame: Frame, l: vec3f, p: Transmission) -> vec3f {
    let h = half_from_light(frame, l - 2.0 * dot(frame.normal, l) * frame.normal);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(vec3f(f0_of_sheet(f0_from_ior(p.eta), 1.0)), vec3f(1.0), h.l_dot_h);
    return p.color * (1.0 - f) * (v * h.n_dot_l * d);
}

/// Factor on transmission_thin_eval that brings back what single scattering loses: with it a white sheet of reflectance f0
/// at normal incidence keeps all light, (1 - (f0 a + b) (1 + f0 (1/E - 1))) / ((1 - f0) a), E = a + b of the pair `dfg`.
fn transmission_thin_compensation(f0: f32, dfg: vec2f) -> f32 {
    let gain = 1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0) - 1.0;
    let reflected = (f0 * dfg.x + dfg.y) * (1.0 + f0 * gain);
    return clamp((1.0 - reflected) / max((1.0 - f0) * dfg.x, 1e-4), 0.0, 10.0);
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

/// The colour with each channel that is NaN or infinite set to 0.
///
/// What a shader ends in, so that one bad texel stays one dark pixel and does not spread through a filter. (The Rust lobes,
/// which are called one by one, each end in it.)
fn finite_or_zero(c: vec3f) -> vec3f {
    return select(vec3f(0.0), c, abs(c) < vec3f(FINITE_CEILING));
}
