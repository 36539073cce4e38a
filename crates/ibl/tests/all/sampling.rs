//! Importance sampling of environments: the density is a density, the directions follow it, hard maps are drawn from.

use halfvector_ibl::{EnvironmentSampler, Equirect, Source, equirect_from_direction, equirect_texel_solid_angle, sky};
use std::f64::consts::PI;

/// Two numbers, even over the unit square: Roberts's additive recurrence.
fn point(k: usize) -> [f64; 2] {
    [0.754_877_666_246_69, 0.569_840_290_998_05].map(|g: f64| (0.5 + g * k as f64).fract())
}

/// Pseudo-random numbers of 0..1 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators").
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn small_sky() -> Equirect {
    let Source::Equirect(map) = sky().source else { unreachable!("the sky is a map") };
    map.area_resampled(64, 32)
}

/// Pearson's chi-square over texels, or groups of them where few are expected: 400,000 draws.
#[test]
fn draws_follow_the_density() {
    let map = small_sky();
    let sampler = EnvironmentSampler::new(map.clone());
    let draws = 400_000;
    let mut counts = vec![0u32; map.pixels.len()];
    let mut state = 1;
    for _ in 0..draws {
        let drawn = sampler.sample([random(&mut state), random(&mut state)]);
        let (u, v) = equirect_from_direction(drawn.dir);
        let (column, row) = (((u * 64.0) as usize).min(63), ((v * 32.0) as usize).min(31));
        counts[row * 64 + column] += 1;
        assert_eq!(drawn.radiance, map.pixels[row * 64 + column]);
        assert_eq!(drawn.pdf_solid_angle, sampler.pdf_solid_angle(drawn.dir));
    }
    let (mut square, mut degrees, mut seen, mut expected) = (0.0, 0.0, 0.0, 0.0);
    for (k, &count) in counts.iter().enumerate() {
        let (u, v) = (((k % 64) as f64 + 0.5) / 64.0, ((k / 64) as f64 + 0.5) / 32.0);
        let dir = halfvector_ibl::direction_from_equirect(u, v);
        expected += f64::from(draws) * sampler.pdf_solid_angle(dir) * equirect_texel_solid_angle(64, 32, k / 64);
        seen += f64::from(count);
        if expected >= 10.0 {
            square += (seen - expected).powi(2) / expected;
            degrees += 1.0;
            (seen, expected) = (0.0, 0.0);
        }
    }
    // A chi-square of so many degrees is normal with this mean and deviation.
    let deviations = (square - (degrees - 1.0)) / (2.0 * (degrees - 1.0f64)).sqrt();
    println!("chi-square {square:.1} for {degrees} cells: {deviations:.2} deviations");
    assert!(deviations.abs() < 4.0, "{deviations}");
}

/// The density is 1 in all, and the mean of f / pdf is the integral of f.
#[test]
fn integrals_come_out() {
    let map = small_sky();
    let sampler = EnvironmentSampler::new(map.clone());
    let areas = (0..map.pixels.len()).map(|k| equirect_texel_solid_angle(64, 32, k / 64));
    let whole: f64 = areas
        .enumerate()
        .map(|(k, area)| {
            let (u, v) = (((k % 64) as f64 + 0.5) / 64.0, ((k / 64) as f64 + 0.5) / 32.0);
            area * sampler.pdf_solid_angle(halfvector_ibl::direction_from_equirect(u, v))
        })
        .sum();
    assert!((whole - 1.0).abs() < 1e-12, "{whole}");
    let draws = 50_000;
    // Irradiance over pi of a floor.
    let estimate: f64 = (0..draws)
        .map(|k| sampler.sample(point(k)))
        .map(|s| f64::from(s.radiance[1]) * s.dir[1].max(0.0) / PI / s.pdf_solid_angle / draws as f64)
        .sum();
    let exact: f64 = map
        .pixels
        .iter()
        .enumerate()
        .map(|(k, pixel)| {
            let (top, bottom) = ((k / 64) as f64 * PI / 32.0, (k / 64 + 1) as f64 * PI / 32.0);
            let cosines = 0.5 * (top.cos().max(0.0).powi(2) - bottom.cos().max(0.0).powi(2));
            f64::from(pixel[1]) * cosines * 2.0 * PI / 64.0 / PI
        })
        .sum();
    println!("irradiance {estimate} for {exact}");
    assert!((estimate / exact - 1.0).abs() < 2e-3);
}

/// A black map is drawn evenly; of a map with one lit texel only that is drawn; one texel in all is the sphere.
#[test]
fn hard_maps() {
    let black = EnvironmentSampler::new(Equirect { width: 8, height: 4, pixels: vec![[0.0; 3]; 32] });
    let mut mean = [0.0; 3];
    for k in 0..4096 {
        let drawn = black.sample(point(k));
        assert!((drawn.pdf_solid_angle - 0.25 / PI).abs() < 1e-15 && drawn.radiance == [0.0; 3]);
        (0..3).for_each(|i| mean[i] += drawn.dir[i] / 4096.0);
    }
    assert!(mean.iter().all(|x| x.abs() < 0.01), "{mean:?}");

    for lit in [0, 77, 64 * 31 + 63] {
        let mut lamp = Equirect { width: 64, height: 32, pixels: vec![[0.0; 3]; 64 * 32] };
        lamp.pixels[lit] = [65504.0; 3];
        let sampler = EnvironmentSampler::new(lamp);
        let density = 1.0 / equirect_texel_solid_angle(64, 32, lit / 64);
        for u in (0..1000).map(point).chain([[0.0, 0.0], [1.0, 1.0], [f64::NAN, -1.0], [0.999_999_999, 0.5]]) {
            let drawn = sampler.sample(u);
            assert_eq!(drawn.radiance[0], 65504.0, "{u:?}");
            assert!((drawn.pdf_solid_angle / density - 1.0).abs() < 1e-12);
            let length: f64 = drawn.dir.iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-12);
        }
    }
    let one = EnvironmentSampler::new(Equirect { width: 1, height: 1, pixels: vec![[2.0; 3]] });
    assert!((one.sample([0.3, 0.6]).pdf_solid_angle - 0.25 / PI).abs() < 1e-15);
}

/// The solid angles of a 16,384-wide map at its poles: exact in f64, where the difference of cosines in f32 is 0.
#[test]
fn solid_angles_at_the_poles_of_a_16k_map() {
    let (width, height) = (16384, 8192);
    let first = equirect_texel_solid_angle(width, height, 0);
    // theta^2 / 2 (1 - theta^2 / 12) dphi, with the next term below 1e-15.
    let step = PI / height as f64;
    let exact = 2.0 * PI / width as f64 * 0.5 * step * step * (1.0 - step * step / 12.0);
    assert!((first / exact - 1.0).abs() < 1e-13, "{first} for {exact}");
    assert!(((step as f32).cos() - 1.0f32).abs() < 1e-6);
    let whole: f64 = (0..height).map(|row| width as f64 * equirect_texel_solid_angle(width, height, row)).sum();
    assert!((whole - 4.0 * PI).abs() < 1e-11, "{whole}");
    assert_eq!(first, equirect_texel_solid_angle(width, height, height - 1));
}
