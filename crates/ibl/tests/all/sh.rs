//! Spherical harmonics by order and window: the coefficients, and which of them errs least.

use crate::{ENVIRONMENTS, data_table, environment, mirrored, numbers, relative_errors, rms};
use halfvector_ibl::environment::irradiance_sh2;
use halfvector_ibl::sh::{RADIANCE_SH, ShOrder, ShWindow, irradiance_from_radiance_sh, real_harmonics};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Equirect, LoadedEnvironment, Quadrature, Source, bake, sky, studio,
};

fn baked(environment: &LoadedEnvironment) -> BakedEnvironment {
    bake(environment, &BakeOptions { size: 8, levels: Some(1), irradiance_size: 1, ..BakeOptions::default() })
}

/// A map of each harmonic in turn has that coefficient and no other.
#[test]
fn each_harmonic_is_found() {
    for k in 0..RADIANCE_SH {
        let value = |d: [f64; 3]| 2.0 + real_harmonics(d)[k];
        let map = Equirect::from_fn(256, 128, |d| [1.0, 0.5, 0.0].map(|c| (c * value(d)) as f32));
        let found = baked(&map.into()).radiance_sh;
        for (j, [r, g, b]) in found.into_iter().enumerate() {
            let mean = if j == 0 { 2.0 * (4.0 * std::f32::consts::PI).sqrt() } else { 0.0 };
            let expected = mean + f32::from(u8::from(j == k));
            assert!(
                (r - expected).abs() < 2e-3 && (g - expected / 2.0).abs() < 1e-3 && b == 0.0,
                "{k}, {j}: {r} {g} {b}"
            );
        }
    }
}

/// The choice: irradiance by each order and window against a sum over texels. Order 2 as it is errs least, and without a
/// window order 3 is the same, for the cosine has nothing of degree 3.
#[test]
fn order_and_window_by_error() {
    let methods = [
        ("order 2", ShOrder::Two, ShWindow::None),
        ("order 3", ShOrder::Three, ShWindow::None),
        ("order 1", ShOrder::One, ShWindow::None),
        ("order 2, windowed", ShOrder::Two, ShWindow::Hann),
        ("order 3, windowed", ShOrder::Three, ShWindow::Hann),
    ];
    let mut cases = Vec::new();
    for (name, environment) in [("studio", studio()), ("sky", sky())] {
        let Source::Equirect(map) = &environment.source else { unreachable!("it is a map") };
        let truth = Quadrature::new(map);
        let direction = |k: usize| {
            let (z, phi) = (1.0 - (2.0 * k as f64 + 1.0) / 60.0, 2.399_963 * k as f64);
            let across = (1.0 - z * z).sqrt();
            [across * phi.cos(), z, across * phi.sin()]
        };
        let points = (0..60).map(|k| (direction(k), truth.prefiltered(direction(k), 1.0))).collect();
        cases.push((name, truth.mean(), points, baked(&environment)));
    }
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_irradiance.csv")))
        else {
            continue;
        };
        let Source::Equirect(map) = &environment.source else { unreachable!("it is a map") };
        let points: Vec<_> = table.iter().map(|row| (mirrored(numbers(row, 1)), numbers(row, 4))).collect();
        cases.push((name, map.mean(), points, baked(&environment)));
    }
    for (name, mean, points, baked) in cases {
        let found = methods.map(|(_, order, window)| {
            let value = |dir| irradiance_from_radiance_sh(&baked.radiance_sh, order, window, dir);
            let errors: Vec<f64> =
                points.iter().flat_map(|&(dir, truth)| relative_errors(value(dir), truth, mean)).collect();
            (rms(&errors), errors.iter().copied().fold(0.0, f64::max))
        });
        for ((method, ..), (rms, worst)) in methods.iter().zip(found) {
            println!(
                "{name}: irradiance of harmonics, {method}: {:.2} % rms, {:.1} % worst",
                100.0 * rms,
                100.0 * worst
            );
            assert!(found[0].0 <= rms + 1e-9, "{name}: {method} errs less than order 2");
        }
        assert_eq!(found[0], found[1], "{name}");
        for (dir, _) in points {
            let shader = irradiance_sh2(baked.irradiance_sh_padded(), dir.map(|x| x as f32));
            let library = irradiance_from_radiance_sh(&baked.radiance_sh, ShOrder::Two, ShWindow::None, dir);
            for c in 0..3 {
                assert!(
                    (shader[c] - library[c]).abs() < 1e-5 * mean[c].max(1.0) as f32 * 10.0,
                    "{shader:?} {library:?}"
                );
            }
        }
    }
}
