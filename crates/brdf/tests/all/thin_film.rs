//! The thin film against integration over the spectrum with Airy's sum in closed form, and at its edges.

use halfvector_brdf::coupling::{coupling_colored, coupling_compensated};
use halfvector_brdf::fresnel::f_conductor;
use halfvector_brdf::fresnel::f_schlick;
use halfvector_brdf::lobe_thin_film::{ThinFilm, thin_film_cosine, thin_film_fresnel, thin_film_shift};
use halfvector_brdf::math::PI;
use halfvector_brdf::thin_film::f_thin_film;

/// The colour matching functions of Wyman, Sloan, Shirley 2013 at a wavelength in nm.
fn observer(wavelength: f64) -> [f64; 3] {
    let lobe = |height: f64, centre: f64, below: f64, above: f64| {
        let width = if wavelength < centre { below } else { above };
        height * (-0.5 * ((wavelength - centre) / width).powi(2)).exp()
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

type Complex = (f64, f64);

fn mul(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn div(a: Complex, b: Complex) -> Complex {
    let size = b.0 * b.0 + b.1 * b.1;
    ((a.0 * b.0 + a.1 * b.1) / size, (a.1 * b.0 - a.0 * b.1) / size)
}

/// Reflectance at one wavelength: the amplitude (r12 + r23 e) / (1 + r12 r23 e), squared, both polarisations.
fn airy(ior: f64, thickness: f64, (n, k): (f64, f64), cosine: f64, wavelength: f64) -> f64 {
    let sin2 = 1.0 - cosine * cosine;
    let q = (ior * ior - sin2).sqrt();
    let n2 = (n * n - k * k, 2.0 * n * k);
    let (re, im) = (n2.0 - sin2, n2.1);
    let size = re.hypot(im);
    let u = ((0.5 * (size + re)).max(0.0).sqrt(), (0.5 * (size - re)).max(0.0).sqrt());
    let (sin, cos) = (4.0 * PI / wavelength * thickness * q).sin_cos();
    let s = ((cosine - q) / (cosine + q), div((q - u.0, -u.1), (q + u.0, u.1)));
    let i2 = ior * ior;
    let p = (
        (i2 * cosine - q) / (i2 * cosine + q),
        div((n2.0 * q - i2 * u.0, n2.1 * q - i2 * u.1), (n2.0 * q + i2 * u.0, n2.1 * q + i2 * u.1)),
    );
    let both = [s, p].map(|(r12, r23)| {
        let echo = mul(r23, (cos, sin));
        let amplitude = div((r12 + echo.0, echo.1), (1.0 + r12 * echo.0, r12 * echo.1));
        amplitude.0 * amplitude.0 + amplitude.1 * amplitude.1
    });
    0.5 * (both[0] + both[1])
}

/// The reflectance as linear Rec. 709 on a white of D65, held in [0, 1].
fn integrated(ior: f64, thickness: f64, base: (f64, f64), cosine: f64) -> [f64; 3] {
    let (mut sum, mut white) = ([0.0; 3], [0.0; 3]);
    for wavelength in 360..830 {
        let wavelength = f64::from(wavelength);
        let reflectance = airy(ior, thickness, base, cosine, wavelength);
        let weights = observer(wavelength);
        for i in 0..3 {
            sum[i] += weights[i] * reflectance;
            white[i] += weights[i];
        }
    }
    let xyz = [0.950_47, 1.0, 1.088_83].map(f64::from);
    let [x, y, z] = [0, 1, 2].map(|i| xyz[i] * sum[i] / white[i]);
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
    .map(|c| c.clamp(0.0, 1.0))
}

#[test]
fn thin_films_are_near_the_spectrum_s() {
    // The orders beyond the third are what is missing: most at grazing incidence, where both boundaries reflect.
    let bases =
        [("glass", (1.5, 0.0), 0.01, 0.01), ("silver", (0.2, 3.9), 0.18, 0.03), ("iron", (2.9, 3.1), 0.12, 0.02)];
    for (name, base, grazing_bound, bound) in bases {
        for (cosines, bound) in [([0.1, 0.2], grazing_bound), ([0.5, 1.0], bound)] {
            let (mut worst, mut at) = (0.0, (0.0, 0.0, 0.0));
            for ior in [1.2, 1.33, 1.8, 2.4] {
                for (step, cosine) in (0..60).flat_map(|step| cosines.map(|c| (step, c))) {
                    let thickness = 40.0 + 20.0 * f64::from(step);
                    let truth = integrated(ior, thickness, base, cosine);
                    let ours = f_thin_film(ior, thickness, [base.0; 3], [base.1; 3], cosine);
                    for error in ours.iter().zip(truth).map(|(a, b)| (a - b).abs()) {
                        if error > worst {
                            (worst, at) = (error, (ior, thickness, cosine));
                        }
                    }
                }
            }
            println!("thin film on {name}, cosines {cosines:?}: off by {worst:.3} at most (ior, nm, cosine {at:?})");
            assert!(worst < bound, "{name}: {worst} at {at:?}");
        }
    }
}

#[test]
fn no_film_is_the_bare_base() {
    for (n, k) in [(1.5, 0.0), (0.2, 3.9), (2.9, 3.1), (1.0, 0.0)] {
        for cosine in [0.0, 0.01, 0.5, 1.0] {
            let bare = f_conductor(n, k, cosine);
            for (ior, thickness) in [(1.5, 0.0), (1.0, 500.0), (2.0, -1.0)] {
                let film = f_thin_film::<f64>(ior, thickness, [n; 3], [k; 3], cosine);
                assert!(film.iter().all(|f| (f - bare).abs() < 1e-8), "{n} {k} {cosine}: {film:?}, {bare}");
            }
        }
    }
}

/// What a shader leaves out when the film's weight is known to be 0 is what it computes when the weight is only 0 now.
#[test]
fn a_film_of_weight_0_changes_nothing() {
    let (f0, f90, dfg): ([f64; 3], _, _) = ([0.04, 0.5, 0.9], [1.0; 3], [0.7, 0.1]);
    let film = ThinFilm { weight: 0.0, thickness: 400.0, ior: 1.4 };
    for cosine in [0.0, 0.3, 1.0] {
        assert_eq!(thin_film_shift(f0, f90, film, cosine), [0.0; 3]);
        assert_eq!(thin_film_fresnel(f0, f90, film, cosine), f_schlick(f0, f90, cosine));
    }
    assert_eq!(coupling_colored(f0, f90, dfg), f0.map(|f0| coupling_compensated(f0, 1.0, dfg)));
}

/// A film's reflectance at the mean cosine, through the split sum of both shifted reflectances.
#[test]
fn the_split_sum_of_a_shifted_base_is_the_film_s() {
    let (f0, f90): ([f64; 3], _) = ([0.04, 0.5, 0.9], [1.0; 3]);
    for dfg in [[0.7, 0.1], [0.2, 0.5], [0.96, 0.001]] {
        for weight in [0.3, 1.0] {
            let film = ThinFilm { weight, thickness: 400.0, ior: 1.4 };
            let cosine = thin_film_cosine(dfg);
            let (shift, whole) = (thin_film_shift(f0, f90, film, cosine), thin_film_fresnel(f0, f90, film, cosine));
            for i in 0..3 {
                let split = (f0[i] + shift[i]) * dfg[0] + (f90[i] + shift[i]) * dfg[1];
                let film = whole[i] * (dfg[0] + dfg[1]);
                assert!((split - film).abs() < 1e-9, "{dfg:?} {weight}: {split} and {film}");
            }
        }
    }
}
