//! All value columns of `brdf_points_shared.csv` at one point, in one precision. The shading normal is +Z.

use halfvector_brdf::Scalar;
use halfvector_brdf::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use halfvector_brdf::diffuse::{
    diffuse_burley, diffuse_eon, diffuse_eon_exact, diffuse_fon, diffuse_lambert, diffuse_oren_nayar,
};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_f82_tint_of_complement, f_schlick_of_complement};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::sampling::{g1_smith_ggx, pdf_solid_angle_ggx_vndf};
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::vector::{add, dot, scale};

/// Columns that a point is read from, in the order of [`Point`]'s numbers.
pub(crate) const INPUTS: [&str; 12] =
    ["roughness", "alpha_x", "alpha_y", "f0", "f82_tint", "rho", "vx", "vy", "vz", "lx", "ly", "lz"];

/// Columns that are computed, in order.
pub(crate) const OUTPUTS: [&str; 30] = [
    "D_ggx",
    "V_smith_hc",
    "G2_smith_hc",
    "G2_smith_sep",
    "G1_v",
    "G1_l",
    "F_schlick",
    "F_f82",
    "F_diel_1p33",
    "F_diel_1p5",
    "F_diel_2p4",
    "F_cond_n0p2_k3p9",
    "F_cond_n1p5_k7",
    "F_cond_n2p9_k3p1",
    "spec_schlick",
    "spec_schlick_cos",
    "spec_diel1p5",
    "spec_cond_n0p2_k3p9",
    "pdf_vndf_l",
    "D_aniso",
    "V_aniso",
    "spec_aniso_schlick",
    "lambert",
    "burley",
    "fon",
    "eon_exact",
    "eon_approx",
    "oren_nayar_qual",
    "D_charlie",
    "V_neubelt",
];

/// A point: the numbers of [`INPUTS`].
pub(crate) type Point = [f64; INPUTS.len()];

/// The unit vectors of a point and their half vector.
struct Geometry<R> {
    view: [R; 3],
    light: [R; 3],
    half: [R; 3],
    sin2_theta_h: R,
    l_dot_h: R,
    one_minus_l_dot_h: R,
}

/// Normalises v and l, and with them their sum and difference, each to full relative precision.
///
/// v / |v| + l / |l| is (|l| (v + l) + l (|v| - |l|)) / (|v| |l|), and |v| - |l| = (v - l).(v + l) / (|v| + |l|): where l is
/// nearly opposite to v their sum is exact, whereas the two unit vectors have lost it in their own rounding. The difference
/// is |l| (v - l) - l (|v| - |l|), and 1 - l.h = |v - l|^2 / (4 (1 + l.h)) for unit vectors.
fn geometry<R: Scalar>(v: [R; 3], l: [R; 3]) -> Geometry<R> {
    let minus = |a: [R; 3], b: [R; 3]| add(a, scale(b, -R::ONE));
    let (v_length, l_length) = (dot(v, v).sqrt(), dot(l, l).sqrt());
    let (sum, difference) = (add(v, l), minus(v, l));
    let longer_by = dot(difference, sum) / (v_length + l_length);
    let inverse = R::ONE / (v_length * l_length);
    let sum = scale(add(scale(sum, l_length), scale(l, longer_by)), inverse);
    let difference = scale(minus(scale(difference, l_length), scale(l, longer_by)), inverse);
    let length = dot(sum, sum).sqrt();
    let half = if length > R::ZERO { scale(sum, R::ONE / length) } else { [R::ONE, R::ZERO, R::ZERO] };
    let l_dot_h = R::of(0.5) * length;
    Geometry {
        view: scale(v, R::ONE / v_length),
        light: scale(l, R::ONE / l_length),
        half,
        sin2_theta_h: half[0] * half[0] + half[1] * half[1],
        l_dot_h,
        one_minus_l_dot_h: R::of(0.25) * dot(difference, difference) / (R::ONE + l_dot_h),
    }
}

/// The values of [`OUTPUTS`] at a point.
pub(crate) fn values<R: Scalar>(point: &Point) -> [R; OUTPUTS.len()] {
    let [roughness, alpha_t, alpha_b, f0, f82_tint, rho, v @ .., lx, ly, lz] = point.map(R::of);
    let g = geometry(v, [lx, ly, lz]);
    let (n_dot_v, n_dot_l) = (g.view[2].max(R::ZERO), g.light[2].max(R::ZERO));
    let alpha = alpha_from_perceptual_roughness(roughness);

    let d = d_ggx(g.half[2], g.sin2_theta_h, alpha);
    let visibility = v_smith_ggx_correlated(n_dot_v, n_dot_l, g.l_dot_h, alpha);
    let separable = v_smith_ggx_separable(n_dot_v, n_dot_l, g.l_dot_h, alpha);
    let g2_over_v = R::of(4.0) * n_dot_v * n_dot_l;
    let schlick = f_schlick_of_complement(f0, R::ONE, g.one_minus_l_dot_h);
    let dielectric = |ior: f64| f_dielectric(R::of(ior), g.l_dot_h);
    let conductor = |n: f64, k: f64| f_conductor(R::of(n), R::of(k), g.l_dot_h);
    let spec = |f: R| d * visibility * f;
    let d_anisotropic = d_ggx_anisotropic(g.half, alpha_t, alpha_b);
    let v_anisotropic = v_smith_ggx_anisotropic(g.view, g.light, alpha_t, alpha_b);
    let diffuse = |form: fn([R; 3], R, R, R, R) -> [R; 3]| form([rho; 3], n_dot_v, n_dot_l, g.l_dot_h, roughness)[0];

    [
        d,
        visibility,
        visibility * g2_over_v,
        separable * g2_over_v,
        g1_smith_ggx(n_dot_v, alpha),
        g1_smith_ggx(n_dot_l, alpha),
        schlick,
        f_f82_tint_of_complement(f0, f82_tint, g.one_minus_l_dot_h),
        dielectric(1.33),
        dielectric(1.5),
        dielectric(2.4),
        conductor(0.2, 3.9),
        conductor(1.5, 7.0),
        conductor(2.9, 3.1),
        spec(schlick),
        spec(schlick) * n_dot_l,
        spec(dielectric(1.5)),
        spec(conductor(0.2, 3.9)),
        pdf_solid_angle_ggx_vndf(n_dot_v, g.half[2], g.sin2_theta_h, alpha),
        d_anisotropic,
        v_anisotropic,
        d_anisotropic * v_anisotropic * schlick,
        diffuse(diffuse_lambert),
        diffuse(diffuse_burley),
        diffuse(diffuse_fon),
        diffuse(diffuse_eon_exact),
        diffuse(diffuse_eon),
        diffuse(diffuse_oren_nayar),
        d_charlie(g.half[2], g.sin2_theta_h, alpha),
        v_neubelt(n_dot_v, n_dot_l, g.l_dot_h, alpha),
    ]
}
