// Four maps, made by Halfvector
// serves: 2 directional lights, 1 point light, 3 spot lights, an environment, turned about +Y; returns display values
//     through the tone map `pbr-neutral`
// methods: d=ggx, v=correlated, fresnel=schlick, diffuse=lambert, compensation=turquin, coupling=view, dfg=table,
//     prefilter=ggx, level_map=hermite, irradiance=cube, horizon=cone, reflection=leaning
// left out: emission: it is 0
// left out: occlusion: it is 1
// left out: opacity: the material is opaque
// left out: displacement: height is 0

struct View {
    clip_from_world: mat4x4f,
    camera_position: vec3f,
    environment_rotation: vec2f,
    exposure: f32,
    environment_levels: f32,
}
@group(0) @binding(0) var<uniform> view: View;
struct Lights {
    directional: array<DirectionalLight, 2>,
    point: PointLight,
    spot: array<SpotLight, 3>,
}
@group(0) @binding(1) var<uniform> lights: Lights;
@group(0) @binding(2) var prefiltered_radiance: texture_cube<f32>;
@group(0) @binding(3) var irradiance_over_pi: texture_cube<f32>;
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
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(world_position, 1.0);
    out.world_position = world_position;
    out.world_normal = world_normal;
    out.world_tangent = world_tangent;
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
    let normal_map = node_textures_normal_map_tbn(normal_2.color, 1.0, false, world_normal, in.world_tangent); // Normal map
    let diffuse_albedo = albedo.color * (1.0 - metalness.r);
    let f0 = mix(vec3f(0.040000003), albedo.color, metalness.r);
    let frame = frame_from_normal(normal_map, view_dir);
    let specular = Specular(f0, vec3f(1.0), alpha_from_perceptual_roughness(max(roughness.r, PUNCTUAL_ROUGHNESS_FLOOR)));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, roughness.r);
    let compensation = energy_compensation(specular.f0, specular.f90, dfg);
    let diffuse = Diffuse(diffuse_albedo * coupling_compensated(0.040000003, 1.0, dfg), roughness.r);
    var radiance = vec3f(0.0);
    for (var i = 0u; i < 2u; i++) {
        let light = directional_light_sample(lights.directional[i], in.world_position);
        var lit = diffuse_eval(frame, light.dir, diffuse);
        lit += specular_eval(frame, light.dir, specular) * compensation;
        radiance += lit * light.illuminance;
    }
    let point_light = point_light_sample(lights.point, in.world_position);
    var point_lit = diffuse_eval(frame, point_light.dir, diffuse);
    point_lit += specular_eval(frame, point_light.dir, specular) * compensation;
    radiance += point_lit * point_light.illuminance;
    for (var i = 0u; i < 3u; i++) {
        let light = spot_light_sample(lights.spot[i], in.world_position);
        var lit = diffuse_eval(frame, light.dir, diffuse);
        lit += specular_eval(frame, light.dir, specular) * compensation;
        radiance += lit * light.illuminance;
    }
    let mirror_dir = reflect(-frame.view_dir, frame.normal);
    let reflection_dir = rotate_about_y(specular_direction(frame, mirror_dir, roughness.r), view.environment_rotation);
    let irradiance = environment_sample(irradiance_over_pi, linear_clamp, rotate_about_y(frame.normal, view.environment_rotation), 0.0);
    let reflection = environment_sample_hermite(prefiltered_radiance, linear_clamp, reflection_dir, lod_geometric(roughness.r, view.environment_levels));
    let horizon = horizon_cone(dot(mirror_dir, world_normal), dot(frame.normal, world_normal), frame.n_dot_v, roughness.r);
    radiance += diffuse_environment(diffuse, irradiance);
    radiance += specular_environment(specular, reflection, dfg) * compensation * horizon;
    radiance = finite_or_zero(radiance);
    let display = srgb_from_linear(tone_map_pbr_neutral(radiance * view.exposure));
    return vec4f(display, 1.0);
}

// ---- brdf/coupling.wgsl

// 1 less what a table of 45 x 45 texels may be too low by: so that base and interface do not gain.
const ARRIVING: f32 = 0.9975;

/// Share that is left under an interface whose specular lobe is compensated for multiple scattering by any of the
/// methods: 1 - E_spec (1 + F_avg (1/E - 1)), a bound of them all.
fn coupling_compensated(f0: f32, f90: f32, dfg: vec2f) -> f32 {
    let average = mix(f0, f90, 1.0 / 21.0);
    let bounced = mix(1.0, 1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0), average);
    return saturate(ARRIVING - (f0 * dfg.x + f90 * dfg.y) * bounced);
}

// ---- brdf/dfg.wgsl

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
fn specular_albedo(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return f0 * dfg.x + f90 * dfg.y;
}

// ---- brdf/diffuse.wgsl

/// Lambert 1760, Photometria: albedo / pi.
fn diffuse_lambert(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    return albedo * INV_PI;
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

// ---- brdf/lobe_diffuse.wgsl

/// Parameters of the diffuse lobe.
struct Diffuse {
    /// Albedo, linear Rec. 709.
    color: vec3f,
    /// Artist's roughness in [0, 1].
    perceptual_roughness: f32,
}

/// BRDF times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
fn diffuse_eval(frame: Frame, l: vec3f, p: Diffuse) -> vec3f {
    let h = half_from_light(frame, l);
    let brdf = diffuse_lambert(p.color, frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.perceptual_roughness);
    return brdf * h.n_dot_l;
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

// ---- brdf/multiscatter.wgsl

// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f32 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one. `f90` is not looked at: all methods have one
/// signature.
fn energy_compensation(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR, 1.0)), saturate(f0));
}

// ---- color.wgsl

/// sRGB-encoded from linear. IEC 61966-2-1:1999, section 5.2:
///   s = 12.92 c                         where c <= 0.0031308
///   s = 1.055 c^(1/2.4) - 0.055         elsewhere
/// Below 0 the line goes on, above 1 the power does; the max keeps pow off negative numbers in the unused branch.
fn srgb_from_linear(c: vec3f) -> vec3f {
    let power = 1.055 * pow(max(c, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055;
    return select(power, 12.92 * c, c <= vec3f(0.0031308));
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

/// World direction to environment direction when the environment is turned counter-clockwise seen from above (+Y) by an
/// angle a: the rotation Ry(-a). `cos_sin` = (cos a, sin a), computed once on the CPU.
fn rotate_about_y(dir: vec3f, cos_sin: vec2f) -> vec3f {
    return vec3f(dot(vec2f(cos_sin.x, -cos_sin.y), dir.xz), dir.y, dot(cos_sin.yx, dir.xz));
}

/// Level that holds a perceptual roughness when level 0 is the unfiltered environment, level 1 is prefiltered for 0.1, the
/// last for 1, and each between them for the same multiple of the one before.
fn lod_geometric(perceptual_roughness: f32, levels: f32) -> f32 {
    let place = 10.0 * perceptual_roughness;
    let above = (levels - 2.0) * (log2(max(place, 1.0)) / log2(10.0));
    return min(min(place, 1.0) + above, levels - 1.0);
}

/// Radiance that arrives from a direction, prefiltered as much as the level says; mixed linearly between levels.
/// `dir` need not be unit. An explicit level, so it may stand under control flow and in any stage.
fn environment_sample(cube: texture_cube<f32>, cube_sampler: sampler, dir: vec3f, lod: f32) -> vec3f {
    return textureSampleLevel(cube, cube_sampler, dir, lod).rgb;
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

// ---- ibl/occlusion.wgsl

/// 0 below -width, 1 above width, a cubic step between.
fn smooth_step_about_zero(x: f32, width: f32) -> f32 {
    return smoothstep(-width, width, x);
}

/// The part of the specular lobe above the geometry's horizon, where the shading normal n is not the geometric normal g;
/// r is the mirror direction about n. The lobe's middle moves from r to n as it widens; the part above g's horizon is a
/// smooth step of the middle's height over it, divided by the part above n's own, which the lobe has lost already.
/// The constants are fitted to the integral.
///
/// Domain: cosines r.g in [-1, 1], n.g and n.v in [0, 1], perceptual roughness in [0, 1]. n = g gives 1.
/// Error against the integral of GGX for tilts up to 60 degrees: 0.030 rms, 0.19 max (none: 0.26 and 1).
fn horizon_cone(r_dot_g: f32, n_dot_g: f32, n_dot_v: f32, perceptual_roughness: f32) -> f32 {
    let alpha = perceptual_roughness * perceptual_roughness;
    let wide = min(1.226 * alpha, 1.0);
    let width = max(0.659 * alpha + 1.23 * perceptual_roughness - 0.0717, 0.01);
    let sunk = 0.379 * alpha;
    let above = smooth_step_about_zero(mix(r_dot_g, n_dot_g, wide) - sunk, width);
    let own = smooth_step_about_zero(mix(n_dot_v, 1.0, wide) - sunk, width);
    // Where n = g both are one number; the floor keeps inputs outside of the domain finite.
    return min(above / max(own, 1e-6), 1.0);
}

// ---- light.wgsl

/// A light so far away that its rays are parallel.
struct DirectionalLight {
    /// Unit direction from the surface to the light, in world space.
    direction: vec3f,
    /// Illuminance of a surface that faces it [lx].
    illuminance: vec3f,
}

/// A light that shines from one point into all directions alike.
struct PointLight {
    /// Where it is, in world space [m].
    position: vec3f,
    /// Luminous intensity [cd].
    intensity: vec3f,
}

/// A light that shines from one point into a cone.
struct SpotLight {
    /// Where it is, in world space [m].
    position: vec3f,
    /// Scale that takes the cosine to the axis, with cos_offset, to 0 at the outer and 1 at the inner cone. Each number
    /// fills the fourth of a vector: every shading language lays that out alike.
    cos_scale: f32,
    /// Luminous intensity on the axis [cd].
    intensity: vec3f,
    /// Offset of the scaled cosine.
    cos_offset: f32,
    /// Unit direction of the axis, the way the light shines, in world space.
    direction: vec3f,
}

/// What arrives at a point from a light.
struct LightSample {
    /// Unit direction from the point to the light, in world space; zero where the point is the light itself.
    dir: vec3f,
    /// Illuminance at normal incidence [lx].
    illuminance: vec3f,
}

/// Squared distance below which the inverse square law stops [m^2]: 1 cm keeps the illuminance finite at the light.
const LIGHT_MIN_DISTANCE_SQUARED: f32 = 1e-4;

// E = E_light everywhere.
fn directional_light_sample(light: DirectionalLight, position: vec3f) -> LightSample {
    return LightSample(light.direction, light.illuminance);
}

// Lambert 1760, "Photometria": E = I / d^2, with d^2 >= 1e-4 m^2.
fn point_light_sample(light: PointLight, position: vec3f) -> LightSample {
    let to_light = light.position - position;
    let distance_squared = dot(to_light, to_light);
    // 1e-30 keeps the division finite in the light itself, where the direction becomes zero.
    let dir = to_light / sqrt(max(distance_squared, 1e-30));
    return LightSample(dir, light.intensity / max(distance_squared, LIGHT_MIN_DISTANCE_SQUARED));
}

// Khronos 2017, "KHR_lights_punctual", inner and outer cone angles: E = I / d^2 * a^2,
// a = saturate((cos - cos_outer) / (cos_inner - cos_outer)), as one multiplication and one addition.
fn spot_light_sample(light: SpotLight, position: vec3f) -> LightSample {
    let all_around = point_light_sample(PointLight(light.position, light.intensity), position);
    let cos_to_axis = -dot(light.direction, all_around.dir);
    let cone = saturate(cos_to_axis * light.cos_scale + light.cos_offset);
    return LightSample(all_around.dir, all_around.illuminance * (cone * cone));
}

// ---- maps/normal.wgsl

/// normal_from_texel before it is made unit; zero for a texel that says nothing.
fn tilt_from_texel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    let t = fma(color, vec3f(2.0), vec3f(-1.0));
    let y = select(t.y, -t.y, flip_y);
    return vec3f(t.x * strength, y * strength, t.z);
}

/// normal_tbn of a direction `n_tangent` of any length, zero being straight up, where the unit normal is known.
fn bent_normal(n_tangent: vec3f, normal: vec3f, unit_normal: vec3f, tangent: vec4f) -> vec3f {
    let across = cross(unit_normal, tangent.xyz);
    // |N x T| <= 1e-6 |N| |T|: the direction of B would be rounding noise, or 0 / 0.
    let usable = dot(across, across) > 1e-12 * dot(tangent.xyz, tangent.xyz);
    let t = select(any_tangent(unit_normal), tangent.xyz, usable);
    let n = select(unit_normal, normal, usable);
    let b = f32(select(1.0, -1.0, tangent.w < 0.0)) * cross(n, t);
    return normalize_or(mat3x3f(t, b, n) * n_tangent, unit_normal);
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

/// The normal map by the tangent frame of the mesh.
fn node_textures_normal_map_tbn(color: vec3f, strength: f32, flip_y: bool, normal: vec3f, tangent: vec4f) -> vec3f {
    return bent_normal(tilt_from_texel(color, strength, flip_y), normal, normal, tangent);
}

// ---- tone_map.wgsl

/// The largest radiance that the tone maps tell from infinity: the largest half float.
const TONE_MAP_MAX: f32 = 65504.0;

// Khronos 2024, "Khronos PBR Neutral tone mapper": colours up to 0.8 are kept but for the 4 % that a dielectric's
// reflection adds (subtracted: f = x - x^2 / (4 * 0.04) below x = min(r, g, b) = 0.08, else 0.04), the peak above
// s = 0.76 is compressed by 1 - d^2 / (p + d - s), d = 1 - s, and mixed towards white by 1 - 1 / (0.15 (p - p') + 1).
fn tone_map_pbr_neutral(c: vec3f) -> vec3f {
    let positive = clamp(c, vec3f(0.0), vec3f(TONE_MAP_MAX));
    let dark = min(min(positive.r, min(positive.g, positive.b)), 0.08);
    let x = positive - vec3f(dark - 6.25 * dark * dark);
    let start: f32 = 0.76;
    // A lower peak is taken as s, where nothing is compressed or mixed: no branch.
    let peak = max(max(x.r, max(x.g, x.b)), start);
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(x * (new_peak / peak), vec3f(new_peak), white);
}
