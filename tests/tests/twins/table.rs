//! The one table of twins: functions that are written in WGSL and in Rust, with the domain on which they are compared and
//! how far apart they may be. A test proves that no function is missing.

use halfvector_brdf::frame::{Frame, frame_from_normal, half_from_light};
use halfvector_brdf::lobe_anisotropic::{self, Anisotropic, AnisotropicStrip};
use halfvector_brdf::lobe_coat::{Coat, coat_base, coat_environment, coat_eval};
use halfvector_brdf::lobe_diffuse::{Diffuse, diffuse_environment, diffuse_eval};
use halfvector_brdf::lobe_multiscatter::{
    Multiscatter, multiscatter_environment, multiscatter_eval, multiscatter_from_dfg,
};
use halfvector_brdf::lobe_sheen::{self, Sheen};
use halfvector_brdf::lobe_specular::{Specular, specular_direction, specular_environment, specular_eval};
use halfvector_brdf::lobe_thin_film::{
    ThinFilm, thin_film_cosine, thin_film_fresnel, thin_film_shift, thin_film_through,
};
use halfvector_brdf::lobe_transmission::{
    Transmission, TransmissionLookup, f0_of_sheet, transmission_compensation, transmission_direction,
    transmission_environment, transmission_eval, transmission_lookup, transmission_thin_compensation,
    transmission_thin_eval,
};
use halfvector_brdf::{
    anisotropic, beckmann, coupling, dfg, diffuse, fresnel, ggx, math, metallic_roughness, multiscatter, sheen,
    specular_aa, thin_film, visibility,
};
use halfvector_ibl::{environment, occlusion};
use halfvector_maps::{blend, color, derivative, height, normal, octahedral, parallax, texel};
use halfvector_scene::light::{
    DirectionalLight, LightSample, PointLight, SpotLight, directional_light_sample, point_light_sample,
    spot_light_sample,
};
use halfvector_scene::tone_map;

use super::domain::Domain::{self, *};

/// A function that is written twice.
pub(crate) struct Twin {
    /// The WGSL file, below `shaders/`.
    pub(crate) file: &'static str,
    /// The function's name, in both languages.
    pub(crate) name: &'static str,
    /// What its arguments are drawn from, in order.
    pub(crate) domain: &'static [Domain],
    /// The most that the GPU's f32 may differ from Rust's f64, in ulp of a result or of `floor`, whichever is more.
    pub(crate) ulp: f64,
    /// Size of a result below which the error of `floor` itself is allowed.
    pub(crate) floor: f64,
    /// Whether it is compared in f64 on the GPU too; WGSL's pow, exp2 and log2 exist there in f32 only.
    pub(crate) f64: bool,
    /// The Rust function on the numbers that its arguments are made of.
    pub(crate) rust: fn(&[f64]) -> Vec<f64>,
}

/// Library functions of WGSL without a twin that can be called, and why.
pub(crate) const WGSL_ONLY: &[(&str, &str)] = &[
    ("anisotropic_lit", "a part of anisotropic_eval"),
    ("any_tangent", "private in Rust: compared through normal_tbn"),
    ("bent_normal", "a part of normal_tbn"),
    ("blended", "private in Rust: compared through the five blend functions"),
    ("cos_sin_atan", "private in Rust: compared through normal_rotation_report"),
    ("cos_sin_atan2", "private in Rust: compared through both normal_rotation functions"),
    ("dfg_from_table", "takes a texture"),
    ("environment_sample", "takes a texture"),
    ("environment_sample_hermite", "takes a texture"),
    ("film_lobe", "private in Rust: compared through f_thin_film"),
    ("film_loss", "private in Rust: compared through f_thin_film_dielectric"),
    ("film_real_tones", "private in Rust: compared through f_thin_film_dielectric"),
    ("film_series", "private in Rust: compared through f_thin_film"),
    ("film_tones", "private in Rust: compared through f_thin_film"),
    ("fon", "private in Rust: compared through diffuse_fon"),
    ("fon_g_over_pi_fit", "private in Rust: compared through directional_albedo_fon"),
    ("fon_scale", "private in Rust: compared through diffuse_fon"),
    ("fujii_ratio", "private in Rust: compared through diffuse_fon and diffuse_oren_nayar"),
    ("masked_cosine", "private in Rust: compared through both v_smith_beckmann functions"),
    ("octahedral_folded", "private in Rust: compared through the octahedral functions"),
    ("parallax_occlusion", "takes a texture; in Rust a function: compared with traced rays by the crate's tests"),
    ("refracted_cosine", "private in Rust: compared through transmission_direction"),
    ("specular_lit", "a part of specular_eval"),
    ("tangent_across", "anisotropic_tangent for the rotation 0"),
    ("thin_film_lit", "thin_film_shift and thin_film_fresnel"),
    ("tilt_from_texel", "a part of normal_from_texel"),
];

/// Public functions of the twins' Rust files that WGSL has not, and why.
pub(crate) const RUST_ONLY: &[(&str, &str)] = &[
    ("diffuse_eon_exact", "the truth of diffuse_eon's polynomial; a GPU's arc cosine has 4096 ulp"),
    ("directional_albedo_fon_exact", "the truth of the polynomial; a GPU's arc cosine has 4096 ulp"),
    ("f_f82_tint_of_complement", "the equation without its clamp, for who measures it"),
    ("f_schlick_of_complement", "for who has 1 - l.h without cancellation, which a shader has not"),
    ("lights_by_kind", "sorts a scene's lights for the uniform buffer"),
    ("n_dot_w_lambda_beckmann", "the truth of Walter's fit, 27 Chebyshev terms"),
    ("parse_light", "reads the command line"),
    ("spot_cos_scale_offset", "makes a uniform once, from angles"),
    ("spot_effective_solid_angle", "turns lumens into candela when a file is read"),
    ("tone_map_from_name", "reads the command line"),
    ("tone_mapped", "chooses a tone map by name; a shader is linked with the one it needs"),
    ("v_smith_beckmann_exact", "the truth of Walter's fit, 27 Chebyshev terms"),
];

const FLOAT: bool = false;
const DOUBLE: bool = true;

macro_rules! twin {
    ($file:literal $name:literal, [$($domain:expr),*], $ulp:expr, $floor:expr, $f64:expr, |$x:pat_param| $body:expr) => {
        Twin {
            file: $file, name: $name, domain: &[$($domain),*], ulp: $ulp, floor: $floor, f64: $f64,
            rust: |$x| { let r = $body; r.to_vec() },
        }
    };
}

/// N numbers from `at` on.
fn v<const N: usize>(x: &[f64], at: usize) -> [f64; N] {
    x[at..at + N].try_into().expect("as many numbers as the WGSL function takes")
}

fn frame(x: &[f64]) -> Frame<f64> {
    Frame { normal: v(x, 0), view_dir: v(x, 3), n_dot_v: x[6] }
}

fn specular(x: &[f64], at: usize) -> Specular<f64> {
    Specular { f0: v(x, at), f90: v(x, at + 3), alpha: x[at + 6] }
}

fn diffuse(x: &[f64], at: usize) -> Diffuse<f64> {
    Diffuse { color: v(x, at), perceptual_roughness: x[at + 3] }
}

fn anisotropic_lobe(x: &[f64], at: usize) -> Anisotropic<f64> {
    let (alpha_t, alpha_b) = (x[at + 9], x[at + 10]);
    Anisotropic { f0: v(x, at), f90: v(x, at + 3), tangent: v(x, at + 6), alpha_t, alpha_b }
}

fn strip(s: AnisotropicStrip<f64>) -> [f64; 5] {
    let [x, y, z] = s.dir;
    [x, y, z, s.perceptual_roughness, s.weight]
}

fn looked_up(t: TransmissionLookup<f64>) -> [f64; 4] {
    let [x, y, z] = t.dir;
    [x, y, z, t.perceptual_roughness]
}

fn sheen_lobe(x: &[f64]) -> Sheen<f64> {
    Sheen { color: v(x, 0), perceptual_roughness: x[3] }
}

fn coat(x: &[f64], at: usize) -> Coat<f64> {
    Coat { weight: x[at], color: v(x, at + 1), f0: x[at + 4], alpha: x[at + 5] }
}

fn film(x: &[f64], at: usize) -> ThinFilm<f64> {
    ThinFilm { weight: x[at], thickness: x[at + 1], ior: x[at + 2] }
}

fn transmitted(x: &[f64], at: usize) -> Transmission<f64> {
    Transmission { color: v(x, at), eta: x[at + 3], alpha: x[at + 4] }
}

fn multiscatter(x: &[f64]) -> Multiscatter<f64> {
    Multiscatter { color: v(x, 0), loss: x[3], average_loss: x[4] }
}

fn sample(s: LightSample<f64>) -> [f64; 6] {
    let ([x, y, z], [r, g, b]) = (s.dir, s.illuminance);
    [x, y, z, r, g, b]
}

/// All twins, by file.
#[rustfmt::skip]
pub(crate) const TWINS: &[Twin] = &[
    twin!("brdf/anisotropic.wgsl" "d_ggx_anisotropic", [UnitUp, Alpha, Alpha], 16.0, 0.0, DOUBLE, |x| [anisotropic::d_ggx_anisotropic(v(x, 0), x[3], x[4])]),
    twin!("brdf/anisotropic.wgsl" "v_smith_ggx_anisotropic", [UnitUp, UnitUp, Alpha, Alpha], 10.0, 0.0, DOUBLE, |x| [anisotropic::v_smith_ggx_anisotropic(v(x, 0), v(x, 3), x[6], x[7])]),
    // exp2 and log2: the error of a power is its own logarithm times that of the exponent.
    twin!("brdf/beckmann.wgsl" "d_beckmann", [HalfAngle, Alpha], 512.0, 1e-30, FLOAT, |x| [beckmann::d_beckmann(x[0], x[1], x[2])]),
    // Where Walter's fit goes to 0, at a = 1.6, it is a difference.
    twin!("brdf/beckmann.wgsl" "v_smith_beckmann_correlated", [Cosine, Cosine, Cosine, Alpha], 32.0, 0.0, DOUBLE, |x| [beckmann::v_smith_beckmann_correlated(x[0], x[1], x[2], x[3])]),
    twin!("brdf/beckmann.wgsl" "v_smith_beckmann_separable", [Cosine, Cosine, Cosine, Alpha], 32.0, 0.0, DOUBLE, |x| [beckmann::v_smith_beckmann_separable(x[0], x[1], x[2], x[3])]),
    twin!("brdf/coupling.wgsl" "coupling_colored", [Color(0.0, 1.0), Color(0.0, 1.0), Pair(0.05, 0.5)], 16.0, 1.0, DOUBLE, |x| coupling::coupling_colored(v(x, 0), v(x, 3), v(x, 6))),
    twin!("brdf/coupling.wgsl" "coupling_compensated", [Range(0.0, 0.2), Range(0.0, 1.0), Pair(0.0, 0.5)], 8.0, 1.0, DOUBLE, |x| [coupling::coupling_compensated(x[0], x[1], v(x, 2))]),
    twin!("brdf/coupling.wgsl" "coupling_light", [Range(0.0, 0.2), Range(0.0, 1.0), Pair(0.0, 0.5), Roughness], 8.0, 1.0, DOUBLE, |x| [coupling::coupling_light(x[0], x[1], v(x, 2), x[4])]),
    twin!("brdf/coupling.wgsl" "coupling_single", [Range(0.0, 0.2), Range(0.0, 1.0), Pair(0.0, 0.5)], 4.0, 1.0, DOUBLE, |x| [coupling::coupling_single(x[0], x[1], v(x, 2))]),
    twin!("brdf/dfg.wgsl" "dfg_fit", [Range(0.001, 1.0), Range(0.02, 1.0)], 256.0, 1.0, DOUBLE, |x| dfg::dfg_fit(x[0], x[1])),
    twin!("brdf/dfg.wgsl" "dfg_karis", [Cosine, Roughness], 16.0, 1.0, FLOAT, |x| dfg::dfg_karis(x[0], x[1])),
    twin!("brdf/dfg.wgsl" "specular_albedo", [Reflectances(1.0), Pair(0.0, 1.0)], 4.0, 0.0, DOUBLE, |x| dfg::specular_albedo(v(x, 0), v(x, 3), v(x, 6))),
    twin!("brdf/diffuse.wgsl" "average_albedo_fon", [Roughness], 4.0, 0.0, DOUBLE, |x| [diffuse::average_albedo_fon(x[0])]),
    twin!("brdf/diffuse.wgsl" "diffuse_burley", [Color(0.0, 1.0), Cosine, Cosine, Cosine, Roughness], 8.0, 0.0, DOUBLE, |x| diffuse::diffuse_burley(v(x, 0), x[3], x[4], x[5], x[6])),
    // The rounding of v.l = 2 (l.h)^2 - 1 counts 1 / max(n.v, n.l) times: cosines from 0.05 here, all in the points' test.
    twin!("brdf/diffuse.wgsl" "diffuse_eon", [Color(0.0, 1.0), Range(0.05, 1.0), Range(0.05, 1.0), Range(0.0, 1.0), Roughness], 64.0, 1.0, DOUBLE, |x| diffuse::diffuse_eon(v(x, 0), x[3], x[4], x[5], x[6])),
    twin!("brdf/diffuse.wgsl" "diffuse_fon", [Color(0.0, 1.0), Range(0.05, 1.0), Range(0.05, 1.0), Range(0.0, 1.0), Roughness], 64.0, 1.0, DOUBLE, |x| diffuse::diffuse_fon(v(x, 0), x[3], x[4], x[5], x[6])),
    twin!("brdf/diffuse.wgsl" "diffuse_lambert", [Color(0.0, 1.0), Cosine, Cosine, Cosine, Roughness], 2.0, 0.0, DOUBLE, |x| diffuse::diffuse_lambert(v(x, 0), x[3], x[4], x[5], x[6])),
    twin!("brdf/diffuse.wgsl" "diffuse_oren_nayar", [Color(0.0, 1.0), Range(0.05, 1.0), Range(0.05, 1.0), Range(0.0, 1.0), Roughness], 64.0, 1.0, DOUBLE, |x| diffuse::diffuse_oren_nayar(v(x, 0), x[3], x[4], x[5], x[6])),
    twin!("brdf/diffuse.wgsl" "directional_albedo_eon", [Color(0.0, 1.0), Cosine, Roughness], 12.0, 0.0, DOUBLE, |x| diffuse::directional_albedo_eon(v(x, 0), x[3], x[4])),
    twin!("brdf/diffuse.wgsl" "directional_albedo_fon", [Cosine, Roughness], 6.0, 0.0, DOUBLE, |x| [diffuse::directional_albedo_fon(x[0], x[1])]),
    twin!("brdf/frame.wgsl" "frame_from_normal", [Unit, Unit], 2.0, 1.0, DOUBLE, |x| {
        let f = frame_from_normal(v(x, 0), v(x, 3));
        [x[0], x[1], x[2], x[3], x[4], x[5], f.n_dot_v]
    }),
    twin!("brdf/frame.wgsl" "half_from_light", [Frame, FrontOfLast], 8.0, 1.0, DOUBLE, |x| {
        let h = half_from_light(frame(x), v(x, 7));
        [h.n_dot_l, h.n_dot_h, h.l_dot_h, h.sin2_theta_h, h.h[0], h.h[1], h.h[2]]
    }),
    twin!("brdf/fresnel.wgsl" "f0_from_ior", [Range(1.0, 3.0)], 6.0, 0.0, DOUBLE, |x| [fresnel::f0_from_ior(x[0])]),
    twin!("brdf/fresnel.wgsl" "f_conductor", [Range(0.05, 4.0), Range(0.0, 8.0), Cosine], 64.0, 0.02, DOUBLE, |x| [fresnel::f_conductor(x[0], x[1], x[2])]),
    twin!("brdf/fresnel.wgsl" "f_dielectric", [Range(0.3, 4.0), Cosine], 32.0, 0.01, DOUBLE, |x| [fresnel::f_dielectric(x[0], x[1])]),
    // f0 / f90 nearer to 1 is the index of a metal: eta there has 1 / (1 - f0/f90) times the rounding of the ratio.
    twin!("brdf/fresnel.wgsl" "f_exact", [Reflectances(0.9), Cosine], 64.0, 0.02, DOUBLE, |x| fresnel::f_exact(v(x, 0), v(x, 3), x[6])),
    twin!("brdf/fresnel.wgsl" "f_f82_tint", [Color(0.0, 1.0), Color(0.0, 1.0), Cosine], 48.0, 0.1, DOUBLE, |x| fresnel::f_f82_tint(v(x, 0), v(x, 3), x[6])),
    twin!("brdf/fresnel.wgsl" "f_schlick", [Reflectances(1.0), Cosine], 8.0, 0.02, DOUBLE, |x| fresnel::f_schlick(v(x, 0), v(x, 3), x[6])),
    twin!("brdf/fresnel.wgsl" "ior_from_f0", [Range(0.0, 0.9)], 8.0, 0.0, DOUBLE, |x| [fresnel::ior_from_f0(x[0])]),
    twin!("brdf/ggx.wgsl" "alpha_from_perceptual_roughness", [Range(-0.5, 1.5)], 0.5, 0.0, DOUBLE, |x| [ggx::alpha_from_perceptual_roughness(x[0])]),
    twin!("brdf/ggx.wgsl" "d_ggx", [HalfAngle, Alpha], 12.0, 0.0, DOUBLE, |x| [ggx::d_ggx(x[0], x[1], x[2])]),
    twin!("brdf/ggx.wgsl" "v_smith_ggx_correlated", [Cosine, Cosine, Cosine, Alpha], 8.0, 0.0, DOUBLE, |x| [ggx::v_smith_ggx_correlated(x[0], x[1], x[2], x[3])]),
    twin!("brdf/ggx.wgsl" "v_smith_ggx_separable", [Cosine, Cosine, Cosine, Alpha], 10.0, 0.0, DOUBLE, |x| [ggx::v_smith_ggx_separable(x[0], x[1], x[2], x[3])]),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_alphas_gltf", [Range(-0.5, 1.5), Range(-0.5, 1.5)], 4.0, 0.0, DOUBLE, |x| lobe_anisotropic::anisotropic_alphas_gltf(x[0], x[1])),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_alphas_openpbr", [Range(-0.5, 1.5), Range(-0.5, 1.5)], 8.0, 0.0, DOUBLE, |x| lobe_anisotropic::anisotropic_alphas_openpbr(x[0], x[1])),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_environment", [Reflectances(1.0), Unit, Alpha, Alpha, Color(0.0, 1e4), Pair(0.0, 0.5)], 4.0, 0.0, DOUBLE, |x| lobe_anisotropic::anisotropic_environment(anisotropic_lobe(x, 0), v(x, 11), v(x, 14))),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_eval", [Frame, FrontOfLast, Reflectances(1.0), Unit, Range(0.1, 1.0), Range(0.1, 1.0)], 256.0, 0.1, DOUBLE, |x| lobe_anisotropic::anisotropic_eval(frame(x), v(x, 7), anisotropic_lobe(x, 10))),
    // A tangent nearly along the view leaves a short cross product.
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_reflection", [Frame, Unit, Range(0.0, 1.0), Range(0.0, 1.0)], 65536.0, 1.0, DOUBLE, |x| lobe_anisotropic::anisotropic_reflection(frame(x), v(x, 7), x[10], x[11])),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_strip", [Frame, Unit, Range(0.1, 1.0), Range(0.1, 1.0), Range(0.0, 4.0)], 65536.0, 1.0, DOUBLE, |x| strip(lobe_anisotropic::anisotropic_strip(frame(x), v(x, 7), x[10], x[11], x[12]))),
    twin!("brdf/lobe_anisotropic.wgsl" "anisotropic_tangent", [Unit, TangentOfLast, Range(-3.2, 3.2)], 64.0, 1.0, FLOAT, |x| lobe_anisotropic::anisotropic_tangent(v(x, 0), v(x, 3), x[7])),
    twin!("brdf/lobe_coat.wgsl" "coat_base", [Range(0.0, 1.0), Color(0.01, 1.0), Range(0.0, 0.2), Alpha, Cosine, Pair(0.0, 0.5)], 64.0, 1.0, FLOAT, |x| coat_base(coat(x, 0), x[6], v(x, 7))),
    twin!("brdf/lobe_coat.wgsl" "coat_environment", [Range(0.0, 1.0), Color(0.01, 1.0), Range(0.0, 0.2), Alpha, Color(0.0, 1e4), Pair(0.0, 0.5)], 4.0, 0.0, DOUBLE, |x| coat_environment(coat(x, 0), v(x, 6), v(x, 9))),
    twin!("brdf/lobe_coat.wgsl" "coat_eval", [Frame, FrontOfLast, Range(0.0, 1.0), Color(0.01, 1.0), Range(0.0, 0.2), Range(0.09, 1.0)], 64.0, 0.1, DOUBLE, |x| coat_eval(frame(x), v(x, 7), coat(x, 10))),
    twin!("brdf/lobe_diffuse.wgsl" "diffuse_environment", [Color(0.0, 1.0), Roughness, Color(0.0, 1e4)], 1.0, 0.0, DOUBLE, |x| diffuse_environment(diffuse(x, 0), v(x, 4))),
    twin!("brdf/lobe_diffuse.wgsl" "diffuse_eval", [Frame, FrontOfLast, Color(0.0, 1.0), Roughness], 8.0, 0.3, DOUBLE, |x| diffuse_eval(frame(x), v(x, 7), diffuse(x, 10))),
    twin!("brdf/lobe_multiscatter.wgsl" "multiscatter_environment", [Color(0.0, 1.0), Range(0.0, 1.0), Range(0.0, 0.6), Color(0.0, 1e4)], 2.0, 0.0, DOUBLE, |x| multiscatter_environment(multiscatter(x), v(x, 5))),
    twin!("brdf/lobe_multiscatter.wgsl" "multiscatter_eval", [Frame, FrontOfLast, Color(0.0, 1.0), Range(0.0, 1.0), Range(0.01, 0.6), Pair(0.0, 0.5)], 32.0, 1.0, DOUBLE, |x| multiscatter_eval(frame(x), v(x, 7), multiscatter(&x[10..]), v(x, 15))),
    twin!("brdf/lobe_multiscatter.wgsl" "multiscatter_from_dfg", [Reflectances(1.0), Pair(0.0, 0.5), Roughness], 16.0, 1.0, DOUBLE, |x| {
        let p = multiscatter_from_dfg(v(x, 0), v(x, 3), v(x, 6), x[8]);
        [p.color[0], p.color[1], p.color[2], p.loss, p.average_loss]
    }),
    twin!("brdf/lobe_sheen.wgsl" "sheen_albedo", [Cosine, Range(0.05, 1.0)], 512.0, 1.0, FLOAT, |x| [lobe_sheen::sheen_albedo(x[0], x[1])]),
    twin!("brdf/lobe_sheen.wgsl" "sheen_base", [Color(0.0, 1.0), Range(0.05, 1.0), Cosine], 512.0, 1.0, FLOAT, |x| [lobe_sheen::sheen_base(sheen_lobe(x), x[4])]),
    twin!("brdf/lobe_sheen.wgsl" "sheen_direction", [Frame], 4.0, 1.0, DOUBLE, |x| lobe_sheen::sheen_direction(frame(x))),
    twin!("brdf/lobe_sheen.wgsl" "sheen_environment", [Color(0.0, 1.0), Range(0.05, 1.0), Cosine, Color(0.0, 1.0)], 512.0, 1.0, FLOAT, |x| lobe_sheen::sheen_environment(sheen_lobe(x), x[4], v(x, 5))),
    twin!("brdf/lobe_sheen.wgsl" "sheen_eval", [Frame, FrontOfLast, Color(0.0, 1.0), Range(0.2, 1.0)], 2048.0, 1.0, FLOAT, |x| lobe_sheen::sheen_eval(frame(x), v(x, 7), sheen_lobe(&x[10..]))),
    twin!("brdf/lobe_sheen.wgsl" "sheen_ring", [Color(0.0, 1.0), Roughness, Color(0.0, 1e2), Color(0.0, 1e2)], 64.0, 100.0, DOUBLE, |x| lobe_sheen::sheen_ring(sheen_lobe(x), v(x, 4), v(x, 7))),
    twin!("brdf/lobe_specular.wgsl" "specular_direction", [Frame, Unit, Roughness], 64.0, 1.0, DOUBLE, |x| specular_direction(frame(x), v(x, 7), x[10])),
    // The directions' own rounding is 1 / alpha times as large in D: roughness from 0.3 here, all of it in d_ggx and in
    // the test against the truth.
    twin!("brdf/lobe_specular.wgsl" "specular_eval", [Frame, FrontOfLast, Reflectances(1.0), Range(0.09, 1.0)], 64.0, 0.1, DOUBLE, |x| specular_eval(frame(x), v(x, 7), specular(x, 10))),
    twin!("brdf/lobe_specular.wgsl" "specular_environment", [Reflectances(1.0), Alpha, Color(0.0, 1e4), Pair(0.0, 1.0)], 4.0, 0.0, DOUBLE, |x| specular_environment(specular(x, 0), v(x, 7), v(x, 10))),
    twin!("brdf/lobe_thin_film.wgsl" "thin_film_cosine", [Pair(0.0, 0.5)], 4096.0, 1.0, FLOAT, |x| [thin_film_cosine(v(x, 0))]),
    twin!("brdf/lobe_thin_film.wgsl" "thin_film_fresnel", [Reflectances(0.9), Range(-0.5, 1.5), Range(0.0, 1000.0), Range(1.0, 3.0), Cosine], 1024.0, 1.0, FLOAT, |x| thin_film_fresnel(v(x, 0), v(x, 3), film(x, 6), x[9])),
    twin!("brdf/lobe_thin_film.wgsl" "thin_film_shift", [Reflectances(0.9), Range(-0.5, 1.5), Range(0.0, 1000.0), Range(1.0, 3.0), Cosine], 1024.0, 1.0, FLOAT, |x| thin_film_shift(v(x, 0), v(x, 3), film(x, 6), x[9])),
    twin!("brdf/lobe_thin_film.wgsl" "thin_film_through", [Color(-1.0, 1.0), Reflectances(0.9), Range(0.3, 1.0)], 256.0, 1.0, DOUBLE, |x| thin_film_through(v(x, 0), v(x, 3), v(x, 6), x[9])),
    twin!("brdf/lobe_transmission.wgsl" "f0_of_sheet", [Range(0.0, 1.0), Range(0.0, 1.0)], 8.0, 0.0, DOUBLE, |x| [f0_of_sheet(x[0], x[1])]),
    twin!("brdf/lobe_transmission.wgsl" "transmission_compensation", [Cosine, Color(0.0, 1.0), Range(0.4, 2.5), Alpha], 64.0, 1.0, DOUBLE, |x| [transmission_compensation(x[0], transmitted(x, 1))]),
    twin!("brdf/lobe_transmission.wgsl" "transmission_direction", [Frame, Range(0.4, 2.5)], 4096.0, 1.0, DOUBLE, |x| transmission_direction(frame(x), x[7])),
    twin!("brdf/lobe_transmission.wgsl" "transmission_environment", [Color(0.0, 1.0), Range(0.4, 2.5), Alpha, Range(0.0, 0.2), Color(0.0, 1e4), Pair(0.0, 0.5)], 8.0, 1.0, DOUBLE, |x| transmission_environment(transmitted(x, 0), x[5], v(x, 6), v(x, 9))),
    // Half vectors of refraction are short where v and -l are near each other: their rounding is that much larger.
    twin!("brdf/lobe_transmission.wgsl" "transmission_eval", [Frame, BackOfLast, Color(0.0, 1.0), Range(1.3, 2.0), Range(0.2, 1.0)], 1024.0, 1.0, DOUBLE, |x| transmission_eval(frame(x), v(x, 7), transmitted(x, 10))),
    twin!("brdf/lobe_transmission.wgsl" "transmission_lookup", [Frame, Range(0.4, 2.5), Range(0.01, 1.0)], 65536.0, 1.0, DOUBLE, |x| looked_up(transmission_lookup(frame(x), x[7], x[8]))),
    twin!("brdf/lobe_transmission.wgsl" "transmission_thin_compensation", [Range(0.0, 0.5), Pair(0.1, 0.5)], 64.0, 1.0, DOUBLE, |x| [transmission_thin_compensation(x[0], v(x, 1))]),
    twin!("brdf/lobe_transmission.wgsl" "transmission_thin_eval", [Frame, BackOfLast, Color(0.0, 1.0), Range(1.1, 2.5), Range(0.09, 1.0)], 64.0, 0.1, DOUBLE, |x| transmission_thin_eval(frame(x), v(x, 7), transmitted(x, 10))),
    twin!("brdf/metallic_roughness.wgsl" "diffuse_color", [Color(0.0, 1.0), Range(0.0, 1.0)], 2.0, 0.0, DOUBLE, |x| metallic_roughness::diffuse_color(v(x, 0), x[3])),
    twin!("brdf/metallic_roughness.wgsl" "f0_from_metallic", [Color(0.0, 1.0), Range(0.0, 1.0), Range(0.0, 1.0)], 4.0, 0.0, DOUBLE, |x| metallic_roughness::f0_from_metallic(v(x, 0), x[3], x[4])),
    twin!("brdf/multiscatter.wgsl" "average_fresnel", [Reflectances(1.0)], 4.0, 0.0, DOUBLE, |x| multiscatter::average_fresnel(v(x, 0), v(x, 3))),
    twin!("brdf/multiscatter.wgsl" "average_loss_ggx", [Roughness], 16.0, 0.0, DOUBLE, |x| [multiscatter::average_loss_ggx(x[0])]),
    twin!("brdf/multiscatter.wgsl" "energy_compensation", [Reflectances(1.0), Pair(0.0, 0.5)], 6.0, 0.0, DOUBLE, |x| multiscatter::energy_compensation(v(x, 0), v(x, 3), v(x, 6))),
    twin!("brdf/multiscatter.wgsl" "energy_compensation_fdez_aguera", [Reflectances(1.0), Pair(0.1, 0.5)], 16.0, 0.0, DOUBLE, |x| multiscatter::energy_compensation_fdez_aguera(v(x, 0), v(x, 3), v(x, 6))),
    twin!("brdf/multiscatter.wgsl" "multiscatter_color", [Reflectances(1.0), Range(0.3, 1.0)], 16.0, 0.0, DOUBLE, |x| multiscatter::multiscatter_color(v(x, 0), v(x, 3), x[6])),
    // A GPU's log2 has an absolute error of 2^-21 near 1, which the exponent 1 / alpha multiplies.
    twin!("brdf/sheen.wgsl" "d_charlie", [HalfAngle, Range(0.02, 1.0)], 512.0, 0.01, FLOAT, |x| [sheen::d_charlie(x[0], x[1], x[2])]),
    twin!("brdf/sheen.wgsl" "v_neubelt", [Cosine, Cosine, Cosine, Alpha], 8.0, 0.0, DOUBLE, |x| [sheen::v_neubelt(x[0], x[1], x[2], x[3])]),
    twin!("brdf/specular_aa.wgsl" "perceptual_roughness_filtered_box", [Roughness, Point(1.0), Point(1.0)], 8.0, 0.0, DOUBLE, |x| [specular_aa::perceptual_roughness_filtered_box(x[0], v(x, 1), v(x, 4))]),
    twin!("brdf/specular_aa.wgsl" "perceptual_roughness_filtered_tokuyoshi", [Roughness, Point(1.0), Point(1.0)], 8.0, 0.0, DOUBLE, |x| [specular_aa::perceptual_roughness_filtered_tokuyoshi(x[0], v(x, 1), v(x, 4))]),
    twin!("brdf/specular_aa.wgsl" "perceptual_roughness_widened", [Range(-0.5, 1.5), Range(-0.1, 0.4)], 8.0, 0.0, DOUBLE, |x| [specular_aa::perceptual_roughness_widened(x[0], x[1])]),
    twin!("brdf/thin_film.wgsl" "f_thin_film", [Range(1.0, 3.0), Range(0.0, 1000.0), Color(0.2, 4.0), Color(0.0, 6.0), Cosine], 1024.0, 1.0, FLOAT, |x| thin_film::f_thin_film(x[0], x[1], v(x, 2), v(x, 5), x[8])),
    twin!("brdf/thin_film.wgsl" "f_thin_film_dielectric", [Range(1.0, 3.0), Range(0.0, 1000.0), Color(1.0, 4.0), Cosine], 1024.0, 1.0, FLOAT, |x| thin_film::f_thin_film_dielectric(x[0], x[1], v(x, 2), x[5])),
    twin!("brdf/visibility.wgsl" "v_cook_torrance", [Cosine, Cosine, Cosine, Alpha], 8.0, 0.0, DOUBLE, |x| [visibility::v_cook_torrance(x[0], x[1], x[2], x[3])]),
    twin!("brdf/visibility.wgsl" "v_hammon", [Cosine, Cosine, Cosine, Alpha], 8.0, 0.0, DOUBLE, |x| [visibility::v_hammon(x[0], x[1], x[2], x[3])]),
    twin!("brdf/visibility.wgsl" "v_kelemen", [Cosine, Cosine, Cosine, Alpha], 6.0, 0.0, DOUBLE, |x| [visibility::v_kelemen(x[0], x[1], x[2], x[3])]),
    twin!("brdf/visibility.wgsl" "v_schlick_smith", [Cosine, Cosine, Cosine, Alpha], 12.0, 0.0, DOUBLE, |x| [visibility::v_schlick_smith(x[0], x[1], x[2], x[3])]),
    twin!("color.wgsl" "gamma_from_linear", [Color(-1.0, 8.0)], 32.0, 0.01, FLOAT, |x| color::gamma_from_linear(v(x, 0))),
    twin!("color.wgsl" "linear_from_srgb", [Color(-1.0, 2.0)], 32.0, 0.001, FLOAT, |x| color::linear_from_srgb(v(x, 0))),
    twin!("color.wgsl" "luminance", [Color(0.0, 100.0)], 4.0, 0.0, DOUBLE, |x| [color::luminance(v(x, 0))]),
    twin!("color.wgsl" "srgb_from_linear", [Color(-1.0, 8.0)], 32.0, 0.01, FLOAT, |x| color::srgb_from_linear(v(x, 0))),
    twin!("ibl/environment.wgsl" "irradiance_sh2", [Harmonics, Unit], 32.0, 1.0, DOUBLE, |x| {
        environment::irradiance_sh2([0, 1, 2, 3, 4, 5, 6, 7, 8].map(|i| v(x, 4 * i)), v(x, 36))
    }),
    twin!("ibl/environment.wgsl" "lod_geometric", [Roughness, Range(2.0, 12.0)], 32.0, 0.1, FLOAT, |x| [environment::lod_geometric(x[0], x[1])]),
    twin!("ibl/environment.wgsl" "lod_linear", [Roughness, Range(1.0, 12.0)], 2.0, 0.0, DOUBLE, |x| [environment::lod_linear(x[0], x[1])]),
    twin!("ibl/environment.wgsl" "lod_report", [Roughness, Range(1.0, 12.0)], 2.0, 0.0, DOUBLE, |x| [environment::lod_report(x[0], x[1])]),
    twin!("ibl/environment.wgsl" "mix_levels", [Color(0.0, 1e3), Range(-4.0, 4.0), Color(0.0, 1e3), Range(-4.0, 4.0), Range(0.0, 1.0)], 256.0, 0.01, FLOAT, |x| {
        environment::mix_levels(v(x, 0), v(x, 4), x[8])
    }),
    twin!("ibl/environment.wgsl" "rotate_about_y", [Unit, Pair(-1.0, 1.0)], 4.0, 1.0, DOUBLE, |x| environment::rotate_about_y(v(x, 0), v(x, 3))),
    twin!("ibl/occlusion.wgsl" "horizon_cone", [Range(-1.0, 1.0), Range(0.0, 1.0), Cosine, Roughness], 64.0, 1.0, DOUBLE, |x| [occlusion::horizon_cone(x[0], x[1], x[2], x[3])]),
    twin!("ibl/occlusion.wgsl" "horizon_squared", [Range(-1.0, 1.0), Range(0.0, 1.0), Cosine, Roughness], 4.0, 1.0, DOUBLE, |x| [occlusion::horizon_squared(x[0], x[1], x[2], x[3])]),
    twin!("ibl/occlusion.wgsl" "smooth_step_about_zero", [Range(-1.0, 1.0), Range(0.01, 1.0)], 16.0, 1.0, DOUBLE, |x| [occlusion::smooth_step_about_zero(x[0], x[1])]),
    // Near its ends the step is 1e-4 wide: a rounding of the occlusion's root counts 1e4 times.
    twin!("ibl/occlusion.wgsl" "specular_occlusion_cone", [Cosine, Range(0.0, 1.0), Roughness], 1024.0, 1.0, DOUBLE, |x| [occlusion::specular_occlusion_cone(x[0], x[1], x[2])]),
    twin!("ibl/occlusion.wgsl" "specular_occlusion_lagarde", [Cosine, Range(0.0, 1.0), Roughness], 32.0, 1.0, FLOAT, |x| [occlusion::specular_occlusion_lagarde(x[0], x[1], x[2])]),
    twin!("light.wgsl" "directional_light_sample", [Unit, Color(0.0, 1e5), Point(10.0)], 0.0, 0.0, DOUBLE, |x| {
        sample(directional_light_sample(DirectionalLight { direction: v(x, 0), illuminance: v(x, 3) }, v(x, 6)))
    }),
    twin!("light.wgsl" "point_light_sample", [Point(0.02), Color(0.0, 1e3), Point(0.02)], 8.0, 0.0, DOUBLE, |x| {
        sample(point_light_sample(PointLight { position: v(x, 0), intensity: v(x, 3) }, v(x, 6)))
    }),
    // Within the cone's edge the light falls to 0 by a difference: errors are those of the light on the axis, <= 1.
    twin!("light.wgsl" "spot_light_sample", [Color(1.0, 4.0), Range(-8.0, 8.0), Color(0.0, 1.0), Range(-8.0, 8.0), Unit, Point(0.5)], 64.0, 1.0, DOUBLE, |x| {
        let light = SpotLight { position: v(x, 0), cos_scale: x[3], intensity: v(x, 4), cos_offset: x[7], direction: v(x, 8) };
        sample(spot_light_sample(light, v(x, 11)))
    }),
    twin!("maps/blend.wgsl" "blend_linear", [UnitUp, UnitUp], 8.0, 1.0, DOUBLE, |x| blend::blend_linear(v(x, 0), v(x, 3))),
    twin!("maps/blend.wgsl" "blend_partial_derivatives", [UnitUp, UnitUp], 8.0, 1.0, DOUBLE, |x| blend::blend_partial_derivatives(v(x, 0), v(x, 3))),
    twin!("maps/blend.wgsl" "blend_rnm", [UnitUp, Unit], 8.0, 1.0, DOUBLE, |x| blend::blend_rnm(v(x, 0), v(x, 3))),
    twin!("maps/blend.wgsl" "blend_udn", [UnitUp, UnitUp], 8.0, 1.0, DOUBLE, |x| blend::blend_udn(v(x, 0), v(x, 3))),
    twin!("maps/blend.wgsl" "blend_whiteout", [UnitUp, UnitUp], 8.0, 1.0, DOUBLE, |x| blend::blend_whiteout(v(x, 0), v(x, 3))),
    twin!("maps/blend.wgsl" "normal_with_strength", [UnitUp, Range(-2.0, 2.0)], 8.0, 1.0, DOUBLE, |x| blend::normal_with_strength(v(x, 0), x[3])),
    twin!("maps/blend.wgsl" "texel_from_normal", [Unit], 1.0, 0.0, DOUBLE, |x| blend::texel_from_normal(v(x, 0))),
    twin!("maps/derivative.wgsl" "normal_from_slopes", [Range(-4.0, 4.0), Range(-4.0, 4.0)], 8.0, 1.0, DOUBLE, |x| derivative::normal_from_slopes(x[0], x[1])),
    twin!("maps/derivative.wgsl" "normal_tbn_derivative", [UnitUp, Footprint, UvFootprint], 8.0, 1.0, DOUBLE, |x| {
        derivative::normal_tbn_derivative(v(x, 0), v(x, 3), v(x, 6), v(x, 9), v(x, 12), v(x, 14))
    }),
    twin!("maps/derivative.wgsl" "tangent_from_derivatives", [Footprint, UvFootprint], 8.0, 1.0, DOUBLE, |x| {
        derivative::tangent_from_derivatives(v(x, 0), v(x, 3), v(x, 6), v(x, 9), v(x, 11))
    }),
    twin!("maps/height.wgsl" "displaced", [Point(10.0), Unit, Range(-1.0, 1.0)], 2.0, 1.0, DOUBLE, |x| height::displaced(v(x, 0), v(x, 3), x[6])),
    twin!("maps/height.wgsl" "displaced_tangent", [Unit, TangentOfLast, Unit], 4.0, 1.0, DOUBLE, |x| height::displaced_tangent(v(x, 0), v(x, 3), v(x, 7))),
    twin!("maps/height.wgsl" "normal_from_height", [Footprint, Range(-0.01, 0.01), Range(-0.01, 0.01)], 8.0, 1.0, DOUBLE, |x| {
        height::normal_from_height(v(x, 0), v(x, 3), v(x, 6), x[9], x[10])
    }),
    twin!("maps/normal.wgsl" "normal_from_texel", [Color(0.0, 1.0), Range(0.0, 2.0), Bool], 8.0, 1.0, DOUBLE, |x| normal::normal_from_texel(v(x, 0), x[3], x[4] != 0.0)),
    twin!("maps/normal.wgsl" "normal_rotation_fixed", [Unit, Vector], 8.0, 1.0, DOUBLE, |x| normal::normal_rotation_fixed(v(x, 0), v(x, 3))),
    twin!("maps/normal.wgsl" "normal_rotation_report", [Unit, Vector], 8.0, 1.0, DOUBLE, |x| normal::normal_rotation_report(v(x, 0), v(x, 3))),
    twin!("maps/normal.wgsl" "normal_tbn", [UnitUp, Unit, TangentOfLast], 8.0, 1.0, DOUBLE, |x| normal::normal_tbn(v(x, 0), v(x, 3), v(x, 6))),
    twin!("maps/normal.wgsl" "tangent_from_normal", [Unit], 8.0, 1.0, DOUBLE, |x| normal::tangent_from_normal(v(x, 0))),
    twin!("maps/octahedral.wgsl" "direction_from_octahedral", [Pair(-1.0, 1.0)], 8.0, 1.0, DOUBLE, |x| octahedral::direction_from_octahedral(v(x, 0))),
    twin!("maps/octahedral.wgsl" "octahedral_from_direction", [Unit], 8.0, 1.0, DOUBLE, |x| octahedral::octahedral_from_direction(v(x, 0))),
    // At grazing incidence the way is 20 times the depth, and the cosine that it is divided by a difference.
    twin!("maps/parallax.wgsl" "parallax_offset", [Unit, Unit, TangentOfLast, Range(0.0, 0.2)], 16.0, 4.0, DOUBLE, |x| parallax::parallax_offset(v(x, 0), v(x, 3), v(x, 6), x[10])),
    // A texel whose three codes are near 128 has a direction of rounding noise: blue well above it here.
    twin!("maps/texel.wgsl" "normal_from_texel_snorm", [Pair(0.0, 1.0), Range(0.7, 1.0), Range(0.0, 2.0), Bool], 16.0, 1.0, DOUBLE, |x| texel::normal_from_texel_snorm(v(x, 0), x[3], x[4] != 0.0)),
    // Near the rim of the unit circle z is the root of what rounding leaves: inside of it here, the rim in the tests of maps.
    twin!("maps/texel.wgsl" "normal_from_texel_two_channel", [Color(0.2, 0.8), Range(0.0, 2.0), Bool], 16.0, 1.0, DOUBLE, |x| texel::normal_from_texel_two_channel(v(x, 0), x[3], x[4] != 0.0)),
    twin!("maps/texel.wgsl" "texel_from_normal_snorm", [Unit], 2.0, 1.0, DOUBLE, |x| texel::texel_from_normal_snorm(v(x, 0))),
    twin!("math.wgsl" "finite_or_zero", [Color(-1e38, 1e38)], 0.0, 0.0, DOUBLE, |x| math::finite_or_zero(v(x, 0))),
    twin!("math.wgsl" "normalize_or", [Vector, Unit], 6.0, 0.0, DOUBLE, |x| math::normalize_or(v(x, 0), v(x, 3))),
    twin!("math.wgsl" "pow5", [Range(-2.0, 2.0)], 3.0, 0.0, DOUBLE, |x| [math::pow5(x[0])]),
    twin!("tone_map.wgsl" "agx_contrast", [Color(0.0, 1.0)], 64.0, 1.0, DOUBLE, |x| tone_map::agx_contrast(v(x, 0))),
    twin!("tone_map.wgsl" "tone_map_aces", [Color(-1.0, 20.0)], 16.0, 0.1, DOUBLE, |x| tone_map::tone_map_aces(v(x, 0))),
    twin!("tone_map.wgsl" "tone_map_agx", [Color(-1.0, 20.0)], 256.0, 1.0, FLOAT, |x| tone_map::tone_map_agx(v(x, 0))),
    twin!("tone_map.wgsl" "tone_map_none", [Color(-1.0, 2.0)], 0.0, 0.0, DOUBLE, |x| tone_map::tone_map_none(v(x, 0))),
    twin!("tone_map.wgsl" "tone_map_pbr_neutral", [Color(-1.0, 20.0)], 64.0, 1.0, DOUBLE, |x| tone_map::tone_map_pbr_neutral(v(x, 0))),
    twin!("tone_map.wgsl" "tone_map_reinhard", [Color(-1.0, 20.0)], 6.0, 0.0, DOUBLE, |x| tone_map::tone_map_reinhard(v(x, 0))),
];
