//! Fresnel reflectance of a surface under a thin transparent film, whose two reflections interfere: soap bubbles, oil, heat
//! tint. In linear Rec. 709, by sensitivities of the eye in closed form; no spectrum is sampled.
//!
//! Domain: see [`f_thin_film`]. The film does not absorb and has one index for all wavelengths.

use crate::Real;

/// Below this thickness [nm] the film's index goes to the outside's, so that a film of no thickness is none
/// (KHR_materials_iridescence). The series alone would leave there what its missing orders hold.
const FADE_THICKNESS: f64 = 30.0;
/// Thickest film [nm]: from a few micrometres on all colours have merged and the result no longer changes.
const THICKNESS_CEILING: f64 = 1e5;
/// Range of the film's index.
const FILM_IOR_CEILING: f64 = 10.0;
/// Smallest index of film and base that is divided by.
const FILM_IOR_FLOOR: f64 = 1e-3;
/// Largest index and extinction of the base; the fourth power must not overflow.
const BASE_IOR_CEILING: f64 = 1e6;
/// Smallest denominator.
const FILM_FLOOR: f64 = 1e-18;

/// The colour matching functions of the CIE 1931 observer over the angular wavenumber k = 2 pi / wavelength [1/nm] as
/// Gaussians: centre, standard deviation. Three for x, one each for y and z.
///
/// Derived here: least squares in k on the analytic functions of Wyman, Sloan, Shirley 2013, Simple Analytic Approximations
/// to the CIE XYZ Color Matching Functions. Their Fourier transforms differ by at most 0.007 (x), 0.028 (y), 0.030 (z) of
/// the value at 0 over optical paths of 0 to 4000 nm.
const LOBES: [[f64; 2]; 5] = [
    [0.010258501116189029, 0.0004333990052411747],
    [0.010910616526684985, 0.0005365664975144916],
    [0.01405857181573468, 0.0006182748601196432],
    [0.011209009787066005, 0.0008357307798945551],
    [0.013915925235247472, 0.0007077886426635069],
];

/// What the lobes weigh in linear Rec. 709 red, green and blue: the matrix from XYZ (IEC 61966-2-1) times the white point
/// D65, and for x the areas of its three lobes, 0.43566, 0.39576, 0.16858. The five of a row add up to 1, so that a
/// reflectance that is the same at all wavelengths is that grey.
const LOBE_WEIGHTS: [[f64; 5]; 3] = [
    [1.341800362, 1.218921421, 0.519232538, -1.537138409, -0.542815912],
    [-0.401351635, -0.364596791, -0.155309862, 1.876010867, 0.045247421],
    [0.023040702, 0.020930688, 0.008915993, -0.204025901, 1.151138518],
];

/// Belcour and Barla 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence: reflectance
/// of a base of index `base_eta` + i `base_k` (per channel) under a film of index `film_ior` and `thickness` in nanometres,
/// in air, unpolarised.
///
/// For each polarisation, with the amplitudes r12 (air, film) and r23 (film, base), T = 1 - r12^2, z = -r12 r23 and the
/// optical path D = 2 film_ior thickness cos(theta_2), Airy's sum is, as a Fourier series in the wavenumber k,
///   R = r12^2 + C + 2 (C - T) sum over m of Re(z^m exp(i m k D)),  C = T^2 |r23|^2 / (1 - |z|^2).
/// The eye's response to exp(i m k D) is the Fourier transform of its sensitivity: for a Gaussian lobe (centre c, deviation s)
/// exp(-(m s D)^2 / 2) exp(i m c D). The orders m = 1..3 are summed; the rest is at most 2 |z|^4 / (1 - |z|) of C - T.
///
/// Domain: film_ior in [1, 10], thickness in [0, 1e5], base_eta in [1e-3, 1e6], base_k in [0, 1e6], cos_theta in [0, 1] (all
/// held there; a film_ior below 1 reflects all beyond its critical angle). The result is held in [0, 1]: colours outside
/// Rec. 709 lose what is negative. Thickness 0 is the bare base, exactly.
/// Against integration over the spectrum ([`f_thin_film_spectral`](crate::thin_film_spectral::f_thin_film_spectral)), film_ior 1.2 to 2.4,
/// thickness 40 to 1240: off by 0.01 on glass; on silver and iron by 0.03 for cosines from 0.5, 0.29 at 0.1, where the orders beyond
/// the third count. Error in f32: 1e-5 to a thickness of 1000.
///
/// ```
/// use halfvector_brdf::{fresnel::f_dielectric, thin_film::f_thin_film};
/// let glass = |thickness: f64| f_thin_film(1.33, thickness, [1.5; 3], [0.0; 3], 0.8);
/// assert!((glass(0.0)[0] - f_dielectric(1.5, 0.8)).abs() < 1e-9);
/// // A quarter of a wavelength of water darkens glass.
/// assert!(glass(110.0)[1] < 0.5 * glass(0.0)[1]);
/// ```
#[inline]
pub fn f_thin_film<R: Real>(film_ior: R, thickness: R, base_eta: [R; 3], base_k: [R; 3], cos_theta: R) -> [R; 3] {
    let c1 = cos_theta.clamp(R::ZERO, R::ONE);
    let thickness = thickness.clamp(R::ZERO, R::of(THICKNESS_CEILING));
    let present = (thickness * R::of(1.0 / FADE_THICKNESS)).min(R::ONE);
    let fade = present * present * (R::of(3.0) - R::of(2.0) * present);
    let ior = R::ONE + fade * (film_ior.clamp(R::of(FILM_IOR_FLOOR), R::of(FILM_IOR_CEILING)) - R::ONE);
    // film_ior cos(theta_2), from which both the path and the amplitudes are made.
    let q2 = (ior - R::ONE) * (ior + R::ONE) + c1 * c1;
    let q = q2.max(R::ZERO).sqrt();
    let floor = R::of(FILM_FLOOR);
    let ior2 = ior * ior;
    let r12 = [(c1 - q) / (c1 + q).max(floor), (ior2 * c1 - q) / (ior2 * c1 + q).max(floor)];
    let tones = tones(R::of(2.0) * thickness * q);
    let mut result = [R::ZERO; 3];
    for channel in 0..3 {
        let base = amplitudes(ior2, q, c1, base_eta[channel], base_k[channel]);
        let tones = [tones[0][channel], tones[1][channel], tones[2][channel]];
        let both = film_series(r12[0], base[0], tones) + film_series(r12[1], base[1], tones);
        result[channel] = R::choose(q2.lt(R::ZERO), R::ONE, (R::of(0.5) * both).clamp(R::ZERO, R::ONE));
    }
    result
}

/// [`f_thin_film`] on a dielectric base, of index `base_eta` from 1 up: all amplitudes are real there, which is a third of
/// the work for a shader.
#[inline]
pub fn f_thin_film_dielectric<R: Real>(film_ior: R, thickness: R, base_eta: [R; 3], cos_theta: R) -> [R; 3] {
    f_thin_film(film_ior, thickness, base_eta.map(|n| n.max(R::ONE)), [R::ZERO; 3], cos_theta)
}

/// Each channel's response to exp(i m k `path`), m = 1..3: by order and channel, real and imaginary part.
#[inline(always)]
fn tones<R: Real>(path: R) -> [[[R; 2]; 3]; 3] {
    let mut sums = [[[R::ZERO; 2]; 3]; 3];
    for (lobe, [centre, deviation]) in LOBES.into_iter().enumerate() {
        for (order, sums) in sums.iter_mut().enumerate() {
            let m = (order + 1) as f64;
            let (sin, cos) = (R::of(m * centre) * path).sin_cos();
            let spread = R::of(m * deviation) * path;
            let size = (R::of(-0.5 * core::f64::consts::LOG2_E) * spread * spread).exp2();
            for ([re, im], weights) in sums.iter_mut().zip(LOBE_WEIGHTS) {
                let weight = R::of(weights[lobe]) * size;
                *re = *re + weight * cos;
                *im = *im + weight * sin;
            }
        }
    }
    sums
}

/// Amplitudes of reflection at the base, both polarisations, complex. `q` is the film's index times the cosine in it, `c1`
/// the cosine outside.
#[inline(always)]
fn amplitudes<R: Real>(ior2: R, q: R, c1: R, base_eta: R, base_k: R) -> [[R; 2]; 2] {
    let n = base_eta.clamp(R::of(FILM_IOR_FLOOR), R::of(BASE_IOR_CEILING));
    let k = base_k.clamp(R::ZERO, R::of(BASE_IOR_CEILING));
    // (a + i b)^2 = (n + i k)^2 - 1 + c1^2, each root without cancellation as in f_conductor. A base of nearly the index
    // outside has a = c1 at grazing incidence: 1 - c1^2 would have lost it.
    let nk = n * k;
    let squared = [n * n - k * k, R::of(2.0) * nk];
    let t = (n - R::ONE) * (n + R::ONE) + c1 * c1 - k * k;
    let modulus = (t * t + squared[1] * squared[1]).sqrt();
    let greater = (R::of(0.5) * (modulus + t.abs())).sqrt();
    let smaller = nk / greater.max(R::of(FILM_FLOOR));
    let is_metal = t.lt(R::ZERO);
    let a = R::choose(is_metal, smaller, greater);
    let b = R::choose(is_metal, greater, smaller);
    let s = quotient([q - a, -b], [q + a, b]);
    let p = quotient(
        [squared[0] * q - ior2 * a, squared[1] * q - ior2 * b],
        [squared[0] * q + ior2 * a, squared[1] * q + ior2 * b],
    );
    [s, p]
}

/// Quotient of two complex numbers; 0 / 0 is 0.
#[inline(always)]
fn quotient<R: Real>(x: [R; 2], y: [R; 2]) -> [R; 2] {
    let inverse = R::ONE / (y[0] * y[0] + y[1] * y[1]).max(R::of(FILM_FLOOR * FILM_FLOOR));
    [(x[0] * y[0] + x[1] * y[1]) * inverse, (x[1] * y[0] - x[0] * y[1]) * inverse]
}

/// Airy's sum of one polarisation seen through `tones`, see [`f_thin_film`].
#[inline(always)]
fn film_series<R: Real>(r12: R, r23: [R; 2], tones: [[R; 2]; 3]) -> R {
    let big_r12 = r12 * r12;
    let big_r23 = r23[0] * r23[0] + r23[1] * r23[1];
    let t = R::ONE - big_r12;
    // 1 where both reflect all: then T is 0 too.
    let c = t * t * big_r23 / (R::ONE - big_r12 * big_r23).max(R::of(FILM_FLOOR));
    let z = [-r12 * r23[0], -r12 * r23[1]];
    let mut power = z;
    let mut sum = R::ZERO;
    for tone in tones {
        sum = sum + power[0] * tone[0] - power[1] * tone[1];
        power = [power[0] * z[0] - power[1] * z[1], power[0] * z[1] + power[1] * z[0]];
    }
    big_r12 + c + R::of(2.0) * (c - t) * sum
}
