//! A thin film by integration over the spectrum, in f64: the truth that [`f_thin_film`](crate::thin_film::f_thin_film)'s
//! series is measured against. Nothing here is for a shader.

use crate::Real;
use crate::math::PI;

/// Wavelengths [nm]: the first one, the last one, and the step. From step to step the phase of a film of 1240 nm and index 2.4 turns by
/// less than half a radian, and its fifth echo's by less than half a turn.
const WAVELENGTHS: [f64; 3] = [360.0, 830.0, 2.0];

/// Smallest index that is divided by, and the largest; so for the extinction of the base.
const INDEX: [f64; 2] = [1e-3, 1e6];

/// Thickest film [nm].
const THICKNESS_CEILING: f64 = 1e5;

type Complex = [f64; 2];

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn quotient(a: Complex, b: Complex) -> Complex {
    let size = f64::max(b[0] * b[0] + b[1] * b[1], f64::MIN_POSITIVE);
    [(a[0] * b[0] + a[1] * b[1]) / size, (a[1] * b[0] - a[0] * b[1]) / size]
}

/// The CIE 1931 colour matching functions at a wavelength [nm]. Wyman, Sloan, Shirley 2013, Simple Analytic Approximations
/// to the CIE XYZ Color Matching Functions, the fits of several lobes.
fn observer(wavelength: f64) -> [f64; 3] {
    let lobe = |height: f64, centre: f64, below: f64, above: f64| {
        let steps = (wavelength - centre) / if wavelength < centre { below } else { above };
        height * Real::exp2(-0.5 * core::f64::consts::LOG2_E * steps * steps)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

/// Reflectance in air of a base of index `base_eta` + i `base_k`, the same at all wavelengths, under a film of index `film_ior`
/// and `thickness` in nanometres, unpolarised, as linear Rec. 709 on a white of D65.
///
/// At each wavelength Airy's sum in closed form, |(r12 + r23 e) / (1 + r12 r23 e)|^2 with the film's phase
/// e = exp(i 4 pi / wavelength thickness film_ior cos(theta_2)), for both polarisations (Born and Wolf 1999, Principles of Optics,
/// section 7.6); over 360 to 830 nm with the observer's sensitivities.
///
/// Domain: every number; film_ior and base_eta are held in [1e-3, 1e6], base_k in [0, 1e6], thickness in [0, 1e5], cos_theta in [0, 1];
/// NaN counts as a lower end. The result is held in [0, 1]. Error of the sum to a thickness of 1240: <= 1e-4; a thicker film needs
/// nearer wavelengths.
pub fn f_thin_film_spectral(film_ior: f64, thickness: f64, base_eta: f64, base_k: f64, cos_theta: f64) -> [f64; 3] {
    let held = |x: f64, low: f64, high: f64| f64::min(f64::max(x, low), high);
    let cosine = held(cos_theta, 0.0, 1.0);
    let [ior, n] = [film_ior, base_eta].map(|x| held(x, INDEX[0], INDEX[1]));
    let k = held(base_k, 0.0, INDEX[1]);
    let thickness = held(thickness, 0.0, THICKNESS_CEILING);
    let sin2 = 1.0 - cosine * cosine;
    if ior * ior < sin2 {
        return [1.0; 3];
    }
    let q = Real::sqrt(ior * ior - sin2);
    let squared = [n * n - k * k, 2.0 * n * k];
    // The cosine in the base times its index.
    let re = squared[0] - sin2;
    let size = Real::sqrt(re * re + squared[1] * squared[1]);
    let u = [Real::sqrt(f64::max(0.5 * (size + re), 0.0)), Real::sqrt(f64::max(0.5 * (size - re), 0.0))];
    let over = |a: f64, b: f64| a / f64::max(b, f64::MIN_POSITIVE);
    let i2 = ior * ior;
    // Both polarisations: the amplitude at the film, and that at the base.
    let amplitudes = [
        (over(cosine - q, cosine + q), quotient([q - u[0], -u[1]], [q + u[0], u[1]])),
        (
            over(i2 * cosine - q, i2 * cosine + q),
            quotient(
                [squared[0] * q - i2 * u[0], squared[1] * q - i2 * u[1]],
                [squared[0] * q + i2 * u[0], squared[1] * q + i2 * u[1]],
            ),
        ),
    ];
    let (mut sum, mut white) = ([0.0; 3], [0.0; 3]);
    let [first, last, step] = WAVELENGTHS;
    let count = ((last - first) / step) as usize;
    for wavelength in (0..=count).map(|i| first + step * i as f64) {
        let (sin, cos) = Real::sin_cos(4.0 * PI / wavelength * thickness * q);
        let reflectance: f64 = amplitudes
            .iter()
            .map(|&(r12, r23)| {
                let echo = product(r23, [cos, sin]);
                let amplitude = quotient([r12 + echo[0], echo[1]], [1.0 + r12 * echo[0], r12 * echo[1]]);
                0.5 * (amplitude[0] * amplitude[0] + amplitude[1] * amplitude[1])
            })
            .sum();
        for (i, weight) in observer(wavelength).into_iter().enumerate() {
            sum[i] += weight * reflectance;
            white[i] += weight;
        }
    }
    // The white point D65 and the matrix of IEC 61966-2-1.
    let white_point = [0.950_47, 1.0, 1.088_83];
    let [x, y, z]: [f64; 3] = core::array::from_fn(|i| white_point[i] * sum[i] / white[i]);
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
    .map(|c| held(c, 0.0, 1.0))
}
