//! FLIP of plain colours, whose errors can be told by hand, and of pictures that the authors' program has judged.

use super::*;

fn flat(color: [f64; 3]) -> Vec<[f64; 3]> {
    vec![color; 32 * 24]
}

fn mean(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len() as f64
}

#[test]
fn equal_pictures_do_not_differ() {
    let picture: Vec<[f64; 3]> = (0..32 * 24).map(|i| [f64::from(i % 7) / 7.0, 0.3, f64::from(i % 5)]).collect();
    for flip in [flip_ldr, flip_hdr] {
        assert!(flip(&picture, &picture, 32, FlipOptions::default()).iter().all(|error| *error == 0.0));
    }
}

#[test]
fn black_and_white_differ_most_but_for_green_and_blue() {
    let options = FlipOptions::default();
    let black_white = mean(&flip_ldr(&flat([0.0; 3]), &flat([1.0; 3]), 32, options));
    assert!((0.95..1.0).contains(&black_white), "{black_white}");
    let green_blue = mean(&flip_ldr(&flat([0.0, 1.0, 0.0]), &flat([0.0, 0.0, 1.0]), 32, options));
    assert!((green_blue - 1.0).abs() < 1e-9, "{green_blue}");
}

#[test]
fn the_inverse_of_the_opponent_space() {
    for rgb in [[0.0; 3], [1.0; 3], [0.2, 0.7, 0.05]] {
        let back = rgb_from_opponent(opponent_from_rgb(rgb));
        assert!(rgb.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-6), "{rgb:?} {back:?}");
    }
}

#[test]
fn nothing_breaks_on_odd_pictures() {
    let odd = [[f64::NAN, f64::INFINITY, -1.0]; 6];
    for flip in [flip_ldr, flip_hdr] {
        assert!(flip(&odd, &[[0.5; 3]; 6], 3, FlipOptions::default()).iter().all(|e| (0.0..=1.0).contains(e)));
        assert!(flip(&[], &[], 3, FlipOptions::default()).is_empty());
    }
    assert_eq!(flip_hdr(&[[0.0; 3]; 6], &[[0.0; 3]; 6], 3, FlipOptions::default()), [0.0; 6]);
}

/// Made by flip_evaluator 1.7, the authors' own program, on the same pictures (f32, 67.02 pixels per degree).
#[test]
fn the_authors_program_says_the_same() {
    let (width, height) = (24, 16);
    let share = |i: usize, n: usize| (i % n) as f64 / n as f64;
    let a: Vec<[f64; 3]> = (0..width * height).map(|i| [share(i, 7), share(i, 5), share(i, 3)]).collect();
    let darker = |(i, p): (usize, &[f64; 3])| p.map(|x| (x * 0.9 + 0.03 * (i % 4) as f64).clamp(0.0, 1.0));
    let b: Vec<[f64; 3]> = a.iter().enumerate().map(darker).collect();
    let bright = |p: &[[f64; 3]]| -> Vec<[f64; 3]> { p.iter().map(|p| p.map(|x| 8.0 * x)).collect() };
    let ldr = flip_ldr(&a, &b, width, FlipOptions::default());
    let hdr = flip_hdr(&bright(&a), &bright(&b), width, FlipOptions::default());
    for (errors, pooled, single) in [
        (ldr, 0.093_674_91, [0.120_927_58, 0.074_366_26, 0.108_500_75]),
        (hdr, 0.206_702_25, [0.186_954_1, 0.249_369_43, 0.124_239_64]),
    ] {
        assert!((mean(&errors) - pooled).abs() < 2e-4, "{} against {pooled}", mean(&errors));
        for (i, expected) in [0, 100, 383].into_iter().zip(single) {
            assert!((errors[i] - expected).abs() < 1e-3, "{} against {expected}", errors[i]);
        }
    }
    let options = FlipOptions::default();
    let black_white = mean(&flip_ldr(&flat([0.0; 3]), &flat([1.0; 3]), 32, options));
    assert!((black_white - 0.967_386_5).abs() < 1e-5, "{black_white}");
}

/// Two pictures with noise of known sizes, the same in all channels, look as far apart as that noise is said to look, whether one or
/// both are noisy, and two of which one is wrong as well farther. A difference is not taken for noise.
#[test]
fn noise_is_told_from_a_difference() {
    let (width, height) = (48, 48);
    let clean: Vec<[f64; 3]> = (0..width * height).map(|i| [0.3, 0.4, 0.2 + (i % 8) as f64 * 0.05]).collect();
    let options = FlipOptions::default();
    let noisy = |seed: u64, by: f64, error: f64| -> Vec<[f64; 3]> {
        let of = |(i, pixel): (usize, &[f64; 3])| {
            let mut random = crate::random::Random::new(seed, i as u64, 0);
            // Twelve even numbers make a normal one.
            let normal = (0..12).map(|_| random.number()).sum::<f64>() - 6.0;
            pixel.map(|x| x + by + error * normal)
        };
        clean.iter().enumerate().map(of).collect()
    };
    for flip in [flip_ldr, flip_hdr] {
        for (of_test, of_reference) in [(0.02, 0.0), (0.0, 0.02), (0.02, 0.02), (0.01, 0.04)] {
            let reference = noisy(6, 0.0, of_reference);
            let errors = [of_test, of_reference].map(|error| vec![[error; 3]; clean.len()]);
            let told = |test: &[[f64; 3]]| {
                let noise = flip_of_noise(
                    flip,
                    Noisy { pixels: test, standard_error: &errors[0] },
                    Noisy { pixels: &reference, standard_error: &errors[1] },
                    width,
                    options,
                );
                (mean(&flip(&reference, test, width, options)), mean(&noise))
            };
            let (same, noise) = told(&noisy(5, 0.0, of_test));
            assert!((same / noise - 1.0).abs() < 0.1, "{of_test} {of_reference}: {noise} {same}");
            let (other, noise) = told(&noisy(5, 0.1, of_test));
            assert!(other > 1.5 * noise, "{of_test} {of_reference}: {noise} {other}");
            let exact = |pixels| Noisy { pixels, standard_error: &[] };
            let silent = flip_of_noise(flip, exact(&clean), exact(&reference), width, options);
            assert!(silent.iter().all(|error| *error == 0.0));
        }
    }
}
