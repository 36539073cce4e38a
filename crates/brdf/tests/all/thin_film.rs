//! The thin film against integration over the spectrum, and at its edges.

use halfvector_brdf::coupling::{coupling_colored, coupling_compensated};
use halfvector_brdf::fresnel::f_conductor;
use halfvector_brdf::fresnel::f_schlick;
use halfvector_brdf::lobe_thin_film::{ThinFilm, thin_film_cosine, thin_film_fresnel, thin_film_shift};
use halfvector_brdf::thin_film::f_thin_film;
use halfvector_brdf::thin_film_spectral::f_thin_film_spectral;

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
                    let truth = f_thin_film_spectral(ior, thickness, base.0, base.1, cosine);
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

/// Nothing that a caller may ask for gives anything but a reflectance.
#[test]
fn the_spectral_sum_takes_any_number() {
    let odd = [f64::NAN, f64::NEG_INFINITY, -1.0, 0.0, 1e-300, 0.5, 1.0, 1e300, f64::INFINITY];
    for (ior, thickness) in odd.into_iter().flat_map(|a| odd.map(|b| (a, b))) {
        for (eta, k) in odd.into_iter().flat_map(|a| odd.map(|b| (a, b))) {
            let found = f_thin_film_spectral(ior, thickness, eta, k, 0.3);
            assert!(found.iter().all(|c| (0.0..=1.0).contains(c)), "{ior} {thickness} {eta} {k}: {found:?}");
        }
    }
    assert!(odd.iter().all(|&c| f_thin_film_spectral(1.3, 400.0, 1.5, 0.0, c).iter().all(|c| (0.0..=1.0).contains(c))));
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
