// All lobes, made by Halfvector
// serves: 2 directional lights, 1 point light, 3 spot lights, an environment, turned about +Y; returns display values
//     through the tone map `pbr-neutral`
// methods: d=ggx, v=correlated, fresnel=schlick, diffuse=lambert, compensation=turquin, coupling=view, dfg=table,
//     prefilter=ggx, level_map=hermite, irradiance=cube, reflection=leaning, sheen=ring, anisotropy=strips
// left out: metal: metallic is 0: f0 comes from the index of refraction alone
// left out: emission: it is 0
// left out: occlusion: it is 1
// left out: horizon: the shading normal is the geometry's: no reflection comes from below
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
    var out: Varyings;
    out.clip_position = view.clip_from_world * vec4f(world_position, 1.0);
    out.world_position = world_position;
    out.world_normal = world_normal;
    out.world_tangent = world_tangent;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let world_normal = normalize_or(in.world_normal, vec3f(0.0, 0.0, 1.0));
    let view_dir = normalize(view.camera_position - in.world_position);
    let frame = frame_from_normal(world_normal, view_dir);
    let tangent = anisotropic_tangent(frame.normal, in.world_tangent, 0.5);
    let alphas = anisotropic_alphas_gltf(max(0.5, PUNCTUAL_ROUGHNESS_FLOOR), 0.6);
    let specular_roughness = sqrt(sqrt(alphas.x * alphas.y));
    let dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, specular_roughness);
    let film = ThinFilm(0.5, 1000.0 * 0.5, 1.4);
    let film_cosine = thin_film_cosine(dfg);
    let film_shift = thin_film_shift(vec3f(0.040000003), vec3f(1.0), film, film_cosine);
    let film_through = thin_film_through(film_shift, vec3f(0.040000003), vec3f(1.0), film_cosine);
    let specular = Anisotropic(vec3f(0.040000003) + film_shift, vec3f(1.0) + film_shift, tangent, alphas.x, alphas.y);
    let compensation = energy_compensation(specular.f0, specular.f90, dfg);
    let diffuse = Diffuse(vec3f(0.7, 0.3, 0.2) * (1.0 - 0.4) * coupling_colored(vec3f(0.040000003) + film_shift, vec3f(1.0) + film_shift, dfg), 0.5);
    let transmission = Transmission(vec3f(0.7, 0.3, 0.2) * 0.4 * film_through, 1.5, alpha_from_perceptual_roughness(max(0.5, PUNCTUAL_ROUGHNESS_FLOOR)));
    let transmission_gain = transmission.eta * transmission.eta * transmission_compensation(frame.n_dot_v, transmission);
    let coat = Coat(0.8, vec3f(1.0, 0.9, 0.8), 0.040000003, alpha_from_perceptual_roughness(max(0.1, PUNCTUAL_ROUGHNESS_FLOOR)));
    let coat_dfg = dfg_from_table(dfg_table, linear_clamp, frame.n_dot_v, 0.1);
    let under_coat = coat_base(coat, frame.n_dot_v, coat_dfg);
    let sheen = Sheen(vec3f(0.2, 0.2, 0.3), 0.3);
    let under_sheen = sheen_base(sheen, frame.n_dot_v);
    var radiance = vec3f(0.0);
    for (var i = 0u; i < 2u; i++) {
        let light = directional_light_sample(lights.directional[i], in.world_position);
        let light_film = thin_film_fresnel(vec3f(0.040000003), vec3f(1.0), film, half_from_light(frame, light.dir).l_dot_h);
        var lit = diffuse_eval(frame, light.dir, diffuse);
        lit += anisotropic_lit(frame, light.dir, specular) * light_film * compensation;
        lit += transmission_eval(frame, light.dir, transmission) * transmission_gain;
        lit = lit * under_coat + coat_eval(frame, light.dir, coat);
        lit = lit * under_sheen + sheen_eval(frame, light.dir, sheen);
        radiance += lit * light.illuminance;
    }
    let point_light = point_light_sample(lights.point, in.world_position);
    let point_light_film = thin_film_fresnel(vec3f(0.040000003), vec3f(1.0), film, half_from_light(frame, point_light.dir).l_dot_h);
    var point_lit = diffuse_eval(frame, point_light.dir, diffuse);
    point_lit += anisotropic_lit(frame, point_light.dir, specular) * point_light_film * compensation;
    point_lit += transmission_eval(frame, point_light.dir, transmission) * transmission_gain;
    point_lit = point_lit * under_coat + coat_eval(frame, point_light.dir, coat);
    point_lit = point_lit * under_sheen + sheen_eval(frame, point_light.dir, sheen);
    radiance += point_lit * point_light.illuminance;
    for (var i = 0u; i < 3u; i++) {
        let light = spot_light_sample(lights.spot[i], in.world_position);
        let light_film = thin_film_fresnel(vec3f(0.040000003), vec3f(1.0), film, half_from_light(frame, light.dir).l_dot_h);
        var lit = diffuse_eval(frame, light.dir, diffuse);
        lit += anisotropic_lit(frame, light.dir, specular) * light_film * compensation;
        lit += transmission_eval(frame, light.dir, transmission) * transmission_gain;
        lit = lit * under_coat + coat_eval(frame, light.dir, coat);
        lit = lit * under_sheen + sheen_eval(frame, light.dir, sheen);
        radiance += lit * light.illuminance;
    }
    let irradiance = environment_sample(irradiance_over_pi, linear_clamp, rotate_about_y(frame.normal, view.environment_rotation), 0.0);
    let behind = transmission_lookup(frame, transmission.eta, transmission.alpha);
    let coat_mirror_dir = reflect(-frame.view_dir, frame.normal);
    var strips = vec4f(0.0);
    var transmitted = vec3f(0.0);
    for (var i = 0u; i < ANISOTROPIC_STRIPS + 1u; i++) {
        var lookup = vec4f(behind.dir, behind.perceptual_roughness);
        var weight = 0.0;
        if i < ANISOTROPIC_STRIPS {
            let strip = anisotropic_strip(frame, tangent, alphas.x, alphas.y, f32(i));
            lookup = vec4f(specular_direction(frame, strip.dir, strip.perceptual_roughness), strip.perceptual_roughness);
            weight = strip.weight;
        }
        let seen = environment_sample_hermite(prefiltered_radiance, linear_clamp, rotate_about_y(lookup.xyz, view.environment_rotation), lod_geometric(lookup.w, view.environment_levels));
        strips += weight * vec4f(seen, 1.0);
        transmitted = seen;
    }
    let reflection = strips.rgb / strips.a;
    let coat_reflection = environment_sample(prefiltered_radiance, linear_clamp, rotate_about_y(specular_direction(frame, coat_mirror_dir, 0.1), view.environment_rotation), lod_geometric(0.1, view.environment_levels));
    let sheen_around = environment_sample(irradiance_over_pi, linear_clamp, rotate_about_y(sheen_direction(frame), view.environment_rotation), 0.0);
    let sheen_middle = environment_sample(prefiltered_radiance, linear_clamp, rotate_about_y(frame.normal, view.environment_rotation), view.environment_levels - 2.0);
    var reflected = diffuse_environment(diffuse, irradiance);
    reflected += anisotropic_environment(specular, reflection, dfg) * compensation;
    reflected += transmission_environment(transmission, 0.040000003, transmitted, dfg);
    reflected = reflected * under_coat + coat_environment(coat, coat_reflection, coat_dfg);
    reflected = reflected * under_sheen + sheen_environment(sheen, frame.n_dot_v, sheen_ring(sheen, sheen_around, sheen_middle));
    radiance += reflected;
    radiance = finite_or_zero(radiance);
    let display = srgb_from_linear(tone_map_pbr_neutral(radiance * view.exposure));
    return vec4f(display, 1.0);
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

// ---- brdf/coupling.wgsl

// 1 less what a table of 45 x 45 texels may be too low by: so that base and interface do not gain.
const ARRIVING: f32 = 0.9975;

/// coupling_compensated of each channel: an interface under a film.
fn coupling_colored(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    let average = mix(f0, f90, 1.0 / 21.0);
    let bounced = mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, 0.1, 1.0)), average);
    return saturate(ARRIVING - (f0 * dfg.x + f90 * dfg.y) * bounced);
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

// Nearest that f0 / f90 comes to 1, where the index of refraction that it implies is infinite: 1 - 2^-20, an exact f32,
// so that 1 - f0 / f90 is exact there too.
const F0_CEILING: f32 = 0.99999904632568359375;

// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both f0 and f90 to nothing.
const F90_FLOOR: f32 = 1e-30;

// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f32 = 1e9;

// Smallest sum of cosines divided by: 0 / 0 at eta = 1, cos = 0. Its square is still a normal f32.
const COSINE_SUM_FLOOR: f32 = 1e-18;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
fn f_schlick(f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    return mix(f0, f90, pow5(max(1.0 - l_dot_h, 0.0)));
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

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equation 99 over 4 n.l n.v:
/// V = 1/2 / (n.l sqrt(alpha^2 + (1 - alpha^2)(n.v)^2) + n.v sqrt(alpha^2 + (1 - alpha^2)(n.l)^2)).
fn v_smith_ggx_correlated(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_l * sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_v * sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 0.5 / max(view + light, V_FLOOR);
}

/// Walter et al. 2007: G = G1(v) G1(l), G1(w) = 2 n.w / (n.w + sqrt(alpha^2 + (1 - alpha^2)(n.w)^2)), over 4 n.l n.v:
/// V = 1 / ((n.v + sqrt(alpha^2 + (1 - alpha^2)(n.v)^2)) (n.l + sqrt(alpha^2 + (1 - alpha^2)(n.l)^2))).
fn v_smith_ggx_separable(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let view = n_dot_v + sqrt(mix(n_dot_v * n_dot_v, 1.0, a2));
    let light = n_dot_l + sqrt(mix(n_dot_l * n_dot_l, 1.0, a2));
    return 1.0 / max(view * light, V_FLOOR);
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

/// The coat's reflection times n.l for the unit direction `l` to a light, weight D V F n.l in 1/sr, with Schlick's F from
/// f0 to 1; 0 where the light is behind the surface.
fn coat_eval(frame: Frame, l: vec3f, p: Coat) -> vec3f {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(vec3f(p.f0), vec3f(1.0), h.l_dot_h);
    return f * (p.weight * (v * h.n_dot_l * d));
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

// ---- brdf/lobe_sheen.wgsl

// Smallest perceptual roughness of the fit of the albedo.
const SHEEN_ROUGHNESS_FLOOR: f32 = 0.05;

// What the fit of the albedo may be too low by, as a factor, where the albedo is near 1.
const SHEEN_MARGIN: f32 = 1.06;

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

/// BRDF times n.l for the unit direction `l` to a light, color D V n.l / max(1, 1.06 E(v), 1.06 E(l)) in 1/sr; 0 where the
/// light is behind the surface.
fn sheen_eval(frame: Frame, l: vec3f, p: Sheen) -> vec3f {
    let h = half_from_light(frame, l);
    let r = clamp(p.perceptual_roughness, SHEEN_ROUGHNESS_FLOOR, 1.0);
    let d = d_charlie(h.n_dot_h, h.sin2_theta_h, r * r);
    let v = v_neubelt(frame.n_dot_v, h.n_dot_l, h.l_dot_h, r * r);
    let most = max(sheen_albedo(frame.n_dot_v, p.perceptual_roughness), sheen_albedo(h.n_dot_l, p.perceptual_roughness)) * SHEEN_MARGIN;
    return p.color * (v * h.n_dot_l * d / max(most, 1.0));
}

/// The direction, not unit, about which the sheen's light is gathered: the normal, leaning to the viewer, to whom fibres
/// that stand up reflect most of what comes from behind them.
fn sheen_direction(frame: Frame) -> vec3f {
    return frame.normal + 0.4 * frame.view_dir;
}

/// Radiance filtered by the sheen's lobe, a ring that narrows to the horizon with the roughness r, from two lookups:
/// `around`, the irradiance over pi about sheen_direction, and `middle`, prefiltered about the normal for a roughness near
/// 0.56, which the ring does not see: max(around + (0.84 - 0.7 r) (around - middle), 0.4 around). Our own fit.
fn sheen_ring(p: Sheen, around: vec3f, middle: vec3f) -> vec3f {
    return max(mix(middle, around, 1.84 - 0.7 * p.perceptual_roughness), 0.4 * around);
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

// ---- brdf/lobe_specular.wgsl

/// The direction, not unit, from which the lobe's light comes in the mean: `mirror_dir` leaning to the normal by
/// the cube of the perceptual roughness. A wide lobe is cut by the surface and shadowed where it grazes: at roughness 1 it
/// sees what a diffuse surface sees. After Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering,
/// listing 22; the weight is our own fit.
fn specular_direction(frame: Frame, mirror_dir: vec3f, perceptual_roughness: f32) -> vec3f {
    let weight = perceptual_roughness * perceptual_roughness * perceptual_roughness;
    return mix(mirror_dir, frame.normal, weight);
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

/// Reflectance at the cosine l.h, `p.weight` of the base under the film: F(f0, f90) + thin_film_shift. It takes the place of
/// F in a lobe lit from one direction.
fn thin_film_fresnel(f0: vec3f, f90: vec3f, p: ThinFilm, l_dot_h: f32) -> vec3f {
    return f_schlick(f0, f90, l_dot_h) + thin_film_shift(f0, f90, p, l_dot_h);
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

// Smallest square of the denominator of the change of angles: 0 / 0 where eta = 1 and l = -v, which has no half vector.
const JACOBIAN_FLOOR: f32 = 1e-24;

/// Parameters of transmission.
struct Transmission {
    /// Share of the light that passes, linear Rec. 709.
    color: vec3f,
    /// Index of refraction behind the surface over the index on the viewer's side: ior from outside, 1 / ior from inside.
    eta: f32,
    /// Square of the perceptual roughness.
    alpha: f32,
}

/// Solid: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it, in 1/sr:
/// color (1 - F) |v.h| |l.h| G D / (n.v (v.h + eta l.h)^2), equation 21 of the paper, over the index on the viewer's side.
/// G = G1(v) G1(l), h = -(v + eta l) / |v + eta l| on the viewer's side. Total internal reflection gives 0.
fn transmission_eval(frame: Frame, l: vec3f, p: Transmission) -> vec3f {
    // h times |s|, of either sign: D over |s|^4 needs no |s|, and v.h + eta l.h is |s|.
    let s = frame.view_dir + p.eta * l;
    let n_dot_s = dot(frame.normal, s);
    let v_dot_s = dot(frame.view_dir, s);
    let l_dot_s = dot(l, s);
    let sine = cross(frame.normal, s);
    let width = n_dot_s * p.alpha;
    let k = p.alpha / max(width * width + dot(sine, sine), JACOBIAN_FLOOR);
    // G / (n.v |n.l|) is four times V of Smith's separable form; times |n.l| it is finite at the horizon.
    let front = max(-dot(frame.normal, l), 0.0);
    let g = 4.0 * INV_PI * front * v_smith_ggx_separable(frame.n_dot_v, front, 0.0, p.alpha);
    let f = f_dielectric(p.eta, abs(v_dot_s) * inverseSqrt(max(dot(s, s), JACOBIAN_FLOOR)));
    let part = (1.0 - f) * g * (k * v_dot_s) * (k * -l_dot_s);
    // Both rays stand on their sides of the microfacet, and the light behind the surface.
    let through = min(v_dot_s * n_dot_s, -l_dot_s * n_dot_s) > 0.0;
    return p.color * select(0.0, part, through);
}

/// Factor on transmission_eval that brings back what the microfacets beyond the first block of the light that comes through
/// a solid body's surface: 1 / (1 - loss), loss = alpha (0.317 (1 - 1/eta) + q (0.361 - 0.335/eta + q (1.405/eta - 0.456)))
/// / (1 - 0.067 alpha), q = 1 - n.v: our own fit to quadrature for eta from 1 up.
fn transmission_compensation(n_dot_v: f32, p: Transmission) -> f32 {
    let inv_eta = saturate(1.0 / max(p.eta, 1.0));
    let q = 1.0 - n_dot_v;
    let slope = 0.317 * (1.0 - inv_eta) + q * (0.361 - 0.335 * inv_eta + q * (1.405 * inv_eta - 0.456));
    return 1.0 / (1.0 - clamp(p.alpha * slope / (1.0 - 0.067 * p.alpha), 0.0, 0.85));
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

// ---- brdf/multiscatter.wgsl

// Smallest albedo divided by. GGX's smallest is 1 - ln 2 = 0.307 (alpha 1, n.v 1); only an empty table is below this.
const DIRECTIONAL_ALBEDO_FLOOR: f32 = 0.1;

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the factor 1 + f0 (1/E - 1) on the
/// single-scattering lobe, E = a + b the directional albedo of a white one. `f90` is not looked at: all methods have one
/// signature.
fn energy_compensation(f0: vec3f, f90: vec3f, dfg: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(1.0 / clamp(dfg.x + dfg.y, DIRECTIONAL_ALBEDO_FLOOR, 1.0)), saturate(f0));
}

// ---- brdf/sheen.wgsl

// Smallest alpha: the library's domain begins here, and the exponent 1 / alpha ends at 1e8.
const CHARLIE_ALPHA_FLOOR: f32 = 1e-8;

// Smallest sin^2 whose logarithm is taken.
const SIN2_FLOOR: f32 = 1e-37;

// Smallest denominator of V: keeps it finite at n.l = n.v = 0.
const NEUBELT_FLOOR: f32 = 1e-36;

/// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF:
/// D = (2 + 1/alpha) sin(theta_h)^(1/alpha) / (2 pi). KHR_materials_sheen: alpha = perceptual_roughness^2.
///
/// Where sin^2 is near 1 its distance from 1 decides: there log2(1 - x), x = (n.h)^2, is x log2(1 - x) / ((1 - x) - 1), in
/// which the rounding of 1 - x cancels.
fn d_charlie(n_dot_h: f32, sin2_theta_h: f32, alpha: f32) -> f32 {
    let exponent = 1.0 / max(alpha, CHARLIE_ALPHA_FLOOR);
    let x = n_dot_h * n_dot_h;
    let rest = 1.0 - x;
    let log2_sin2 = log2(select(max(sin2_theta_h, SIN2_FLOOR), rest, x < 0.5)) + 1.44269504088896340736 * ((1.0 - rest) - x);
    return (2.0 + exponent) * exp2(0.5 * exponent * log2_sin2) * (0.5 * INV_PI);
}

/// Neubelt and Pettineo 2013, Crafting a Next-Gen Material Pipeline for The Order: 1886: V = 1 / (4 (n.l + n.v - n.l n.v)).
fn v_neubelt(n_dot_v: f32, n_dot_l: f32, l_dot_h: f32, alpha: f32) -> f32 {
    return 0.25 / max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, NEUBELT_FLOOR);
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
