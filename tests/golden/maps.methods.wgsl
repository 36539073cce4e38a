// Four maps, made by Halfvector
// serves: 1 directional light, an environment; returns linear radiance, Rec. 709
// methods: d=ggx, v=separable, fresnel=exact, diffuse=burley, compensation=turquin, coupling=view, dfg=karis,
//     prefilter=ggx, level_map=hermite, irradiance=sh2, horizon=cone, reflection=leaning
// left out: emission: it is 0
// left out: occlusion: it is 1
// left out: opacity: the material is opaque
// left out: displacement: height is 0

struct View {
    clip_from_world: mat4x4f,
    camera_position: vec3f,
    irradiance_sh: array<vec4f, 9>,
    environment_levels: f32,
}
@group(0) @binding(0) var<uniform> view: View;
struct Lights {
    directional: DirectionalLight,
}
@group(0) @binding(1) var<uniform> lights: Lights;
@group(0) @binding(2) var prefiltered_radiance: texture_cube<f32>;
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
    let normal_map = node_textures_normal_map_rotation_fixed(normal_2.color, 1.0, false, world_normal); // Normal map
    let diffuse_albedo = albedo.color * (1.0 - metalness.r);
    let f0 = mix(vec3f(0.040000003), albedo.color, metalness.r);
    let frame = frame_from_normal(normal_map, view_dir);
    let specular = Specular(f0, vec3f(1.0), alpha_from_perceptual_roughness(max(roughness.r, PUNCTUAL_ROUGHNESS_FLOOR)));
    let dfg = dfg_karis(frame.n_dot_v, roughness.r);
    let compensation = energy_compensation(specular.f0, specular.f90, dfg);
    let diffuse = Diffuse(diffuse_albedo * coupling_compensated(0.040000003, 1.0, dfg), roughness.r);
    let directional_light = directional_light_sample(lights.directional, in.world_position);
    var directional_lit = diffuse_eval(frame, directional_light.dir, diffuse);
    directional_lit += specular_eval(frame, directional_light.dir, specular) * compensation;
    var radiance = directional_lit * directional_light.illuminance;
    let mirror_dir = reflect(-frame.view_dir, frame.normal);
    let reflection_dir = specular_direction(frame, mirror_dir, roughness.r);
    let irradiance = irradiance_sh2(view.irradiance_sh, frame.normal);
    let reflection = environment_sample_hermite(prefiltered_radiance, linear_clamp, reflection_dir, lod_geometric(roughness.r, view.environment_levels));
    let horizon = horizon_cone(dot(mirror_dir, world_normal), dot(frame.normal, world_normal), frame.n_dot_v, roughness.r);
    radiance += diffuse_environment(diffuse, irradiance);
    radiance += specular_environment(specular, reflection, dfg) * compensation * horizon;
    radiance = finite_or_zero(radiance);
    return vec4f(radiance, 1.0);
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

/// Karis 2014, Physically Based Shading on Mobile: a fit of (a, b) over n.v and perceptual roughness.
///
/// b of the fit falls to -0.0024 at roughness 1; both are held at 0 and above.
fn dfg_karis(n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let r = perceptual_roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return max(vec2f(-1.04, 1.04) * a004 + r.zw, vec2f(0.0));
}

/// Karis 2013, Real Shading in Unreal Engine 4: the share of uniform light that the specular lobe reflects to the
/// viewer, f0 a + f90 b with dfg = (a, b).
fn specular_albedo(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return f0 * dfg.x + f90 * dfg.y;
}

// ---- brdf/diffuse.wgsl

/// Burley 2012, Physically-Based Shading at Disney:
/// albedo (1 + (F90 - 1)(1 - n.l)^5)(1 + (F90 - 1)(1 - n.v)^5) / pi,  F90 = 1/2 + 2 perceptual_roughness (l.h)^2.
///
/// It is reciprocal but does not keep energy: at high roughness and grazing angles it reflects more than it receives.
fn diffuse_burley(albedo: vec3f, n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, perceptual_roughness: f32) -> vec3f {
    let f90_minus_1 = 2.0 * perceptual_roughness * l_dot_h * l_dot_h - 0.5;
    let light = 1.0 + f90_minus_1 * pow5(clamp(1.0 - n_dot_l, 0.0, 1.0));
    let view = 1.0 + f90_minus_1 * pow5(clamp(1.0 - n_dot_v, 0.0, 1.0));
    return albedo * (light * view * INV_PI);
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

// Nearest that f0 / f90 comes to 1, where the index of refraction that it implies is infinite: 1 - 2^-20, an exact f32,
// so that 1 - f0 / f90 is exact there too.
const F0_CEILING: f32 = 0.99999904632568359375;

// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both f0 and f90 to nothing.
const F90_FLOOR: f32 = 1e-30;

// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f32 = 1e9;

// Smallest sum of cosines divided by: 0 / 0 at eta = 1, cos = 0. Its square is still a normal f32.
const COSINE_SUM_FLOOR: f32 = 1e-18;

/// Fresnel's equations for the dielectric that f0 / f90 implies, per channel, scaled to f90:
/// eta = (1 + s) / (1 - s), s = sqrt(f0 / f90);  F = f90 f_dielectric(eta, l.h), which is f0 at l.h = 1 and f90 at 0.
///
/// 1 / (1 - s) is taken as (1 + s) / (1 - s^2), which keeps its digits near s = 1. f0 / f90 is held below F0_CEILING.
fn f_exact(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    let s2 = clamp(f0 / max(f90, vec3f(F90_FLOOR)), vec3f(0.0), vec3f(F0_CEILING));
    let s = 1.0 + sqrt(s2);
    let eta = s * s / (1.0 - s2);
    return f90 * vec3f(f_dielectric(eta.x, l_dot_h), f_dielectric(eta.y, l_dot_h), f_dielectric(eta.z, l_dot_h));
}

/// Fresnel's equations, unpolarised light, real index `eta` = inside over outside, cosine on the outside:
/// g = sqrt(eta^2 - 1 + c^2),  r_s = (c - g)/(c + g),  r_p = (eta^2 c - g)/(eta^2 c + g),  F = (r_s^2 + r_p^2)/2.
/// Born and Wolf 1999, Principles of Optics, section 1.5.
///
/// Both differences are written with e = (eta - 1)(eta + 1) as a factor, which has no cancellation at eta near 1:
/// g - c = e/(g + c),  eta^2 c - g = e (c (g + c) - 1)/(g + c).  Total internal reflection (g^2 < 0) is 1.
fn f_dielectric(eta: f32, cos_theta: f32) -> f32 {
    let c = clamp(cos_theta, 0.0, 1.0);
    let n = min(eta, ETA_CEILING);
    let e = (n - 1.0) * (n + 1.0);
    let g = sqrt(max(e + c * c, 0.0));
    let sum = max(g + c, COSINE_SUM_FLOOR);
    let r_s = e / (sum * sum);
    let r_p = r_s * sum * (c * sum - 1.0) / max(n * n * c + g, COSINE_SUM_FLOOR);
    // Where all is reflected both are 1 or more.
    return min(0.5 * (r_s * r_s + r_p * r_p), 1.0);
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

/// Walter et al. 2007: G = G1(v) G1(l), G1(w) = 2 n.w / (n.w + sqrt(alpha^2 + (1 - alpha^2)(n.w)^2)), over 4 n.l n.v:
/// V = 1 / ((n.v + sqrt(alpha^2 + (1 - alpha^2)(n.v)^2)) (n.l + sqrt(alpha^2 + (1 - alpha^2)(n.l)^2))).
fn v_smith_ggx_separable(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_v + sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_l + sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 1.0 / max(view * light, V_FLOOR);
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
    let brdf = diffuse_burley(p.color, frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.perceptual_roughness);
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
    let f = f_exact(p.f0, p.f90, half_from_light(frame, l).l_dot_h);
    return f * specular_lit(frame, l, p);
}

/// specular_eval without its F: D V n.l.
fn specular_lit(frame: Frame, l: vec3f, p: Specular) -> f32 {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    return v_smith_ggx_separable(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha) * h.n_dot_l * d;
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

/// Diffuse irradiance over pi of nine spherical-harmonic coefficients (order 2).
/// Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation 13, with the
/// basis constants and the cosine factors (1, 2/3, 1/4) folded into the coefficients:
///   E/pi = c0 + c1 y + c2 z + c3 x + c4 xy + c5 yz + c6 (3z^2 - 1) + c7 xz + c8 (x^2 - y^2)
/// `dir` is unit. The floor at 0 removes the negative lobe that order 2 leaves opposite a small bright lamp.
fn irradiance_sh2(coefficients: array<vec4f, 9>, dir: vec3f) -> vec3f {
    let c = coefficients;
    let linear = c[1].xyz * dir.y + c[2].xyz * dir.z + c[3].xyz * dir.x;
    let mixed = c[4].xyz * (dir.x * dir.y) + c[5].xyz * (dir.y * dir.z) + c[7].xyz * (dir.x * dir.z);
    let squares = c[6].xyz * (3.0 * dir.z * dir.z - 1.0) + c[8].xyz * (dir.x * dir.x - dir.y * dir.y);
    return max(c[0].xyz + linear + mixed + squares, vec3f(0.0));
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

/// Normal mapping by rotation with its signs mended: Ry(ay) Rx(-ax) N, without Rz. On N = +Z this is
///   (cos ax sin ay, sin ax, cos ax cos ay)
/// whose x / z = t.x / t.z is the texel's own and whose y / z = (t.y / t.z) / cos ay is not quite, since the second
/// rotation shortens what the first one did. ax = atan(t.y / |t.z|) and ay = atan2(t.x, t.z) keep the quadrant of a texel
/// that points below the surface. On +Z the error is at most 0.2 degrees for a tilt of 15, 1.7 for 30, 5.9 for 45. The axes
/// are still those of N's space, so away from +Z the tilt goes astray.
fn normal_rotation_fixed(n_tangent: vec3f, normal: vec3f) -> vec3f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let x = cos_sin_atan2(n_tangent.y, abs(n_tangent.z));
    let y = cos_sin_atan2(n_tangent.x, n_tangent.z);
    let about_x = vec3f(n.x, x.x * n.y + x.y * n.z, x.x * n.z - x.y * n.y);
    let about_y = vec3f(y.x * about_x.x + y.y * about_x.z, about_x.y, y.x * about_x.z - y.y * about_x.x);
    return normalize_or(about_y, n);
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

/// The normal map by two rotations with the report's signs mended: it needs no tangent.
fn node_textures_normal_map_rotation_fixed(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_fixed(normal_from_texel(color, strength, flip_y), normal);
}
