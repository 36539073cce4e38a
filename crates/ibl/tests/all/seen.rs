//! What is seen: radiance at any direction and roughness, read as a shader reads it, against a sum over every texel of
//! the map at the very roughness.

use crate::{ENVIRONMENTS, data_table, environment, full, mirrored, numbers, relative_errors, rms, share};
use halfvector_ibl::environment::{
    environment_sample, environment_sample_hermite, lod_geometric, lod_linear, lod_report,
};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Equirect, LevelMap, LoadedEnvironment, Quadrature, Source, bake, sky, studio,
};
use rayon::prelude::*;
use std::f64::consts::PI;

fn map_of(environment: &LoadedEnvironment) -> &Equirect {
    match &environment.source {
        Source::Equirect(map) => map,
        Source::Levels(_) => unreachable!("these environments are maps"),
    }
}

/// How a shader reads a bake: by direction and perceptual roughness.
type Read<'a> = dyn Fn(&BakedEnvironment, [f64; 3], f64) -> [f32; 3] + 'a;

/// The quadrature itself against the tables.
#[test]
fn quadrature_is_the_tables() {
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_prefilter.csv")))
        else {
            return;
        };
        let truth = Quadrature::new(map_of(&environment));
        let worst = table
            .par_iter()
            .filter(|row| row[4].parse::<f64>().is_ok_and(|roughness| roughness > 0.09))
            .map(|row| {
                let value = truth.prefiltered(mirrored(numbers(row, 1)), row[4].parse().expect("a number"));
                let errors = relative_errors(value.map(|x| x as f32), numbers(row, 6), truth.mean());
                errors.into_iter().fold(0.0, f64::max)
            })
            .reduce(|| 0.0, f64::max);
        println!("{name}: quadrature against the table, worst {:.3} %", 100.0 * worst);
        assert!(worst < 0.01, "{name}: {worst}");
    }
}

/// Small lamps of three colours on a dim ground: none of the pictures.
fn lamps() -> LoadedEnvironment {
    let mut map = Equirect::from_fn(512, 256, |d| {
        let ground = if d[1] < 0.0 { 0.02 } else { 0.05 + 0.05 * d[1] };
        [ground, ground * 0.9, ground * 0.8].map(|x| x as f32)
    });
    for (row, column, color) in [
        (40, 30, [4000.0, 3000.0, 1500.0]),
        (90, 200, [200.0, 900.0, 3000.0]),
        (120, 333, [9000.0, 700.0, 300.0]),
        (200, 480, [100.0, 120.0, 100.0]),
    ] {
        for k in 0..4 {
            map.pixels[(row + k / 2) * 512 + column + k % 2] = color;
        }
    }
    map.into()
}

/// Rms and worst error of 1,000 random (direction, roughness in 0.1..1), 300 in environments of our own, by the default
/// levels; a quarter of them, or all with `HALFVECTOR_FULL=1`, which prints the errors of the other mappings too.
#[test]
fn any_roughness() {
    let mut cases: Vec<(&str, LoadedEnvironment)> = vec![("studio", studio()), ("sky", sky()), ("lamps", lamps())];
    for name in ENVIRONMENTS {
        if let Some(environment) = environment(name) {
            cases.push((name, environment));
        }
    }
    for (name, environment) in &cases {
        let truth = Quadrature::new(map_of(environment));
        let count = share(if name.starts_with("bpy") { 1000 } else { 300 });
        let points: Vec<([f64; 3], f64)> = (0..count as u32).map(random_point).collect();
        let expected: Vec<[f64; 3]> = points.par_iter().map(|&(dir, r)| truth.prefiltered(dir, r)).collect();
        let errors = |baked: &BakedEnvironment, read: &Read<'_>| {
            let errors: Vec<f64> = points
                .iter()
                .zip(&expected)
                .flat_map(|(&(dir, r), &expected)| relative_errors(read(baked, dir, r), expected, truth.mean()))
                .collect();
            (rms(&errors), errors.iter().copied().fold(0.0, f64::max))
        };
        let count = |baked: &BakedEnvironment| baked.radiance.len() as f64;
        let options = |level_map| BakeOptions { level_map, irradiance_size: 1, ..BakeOptions::default() };
        let geometric = bake(environment, &options(LevelMap::Geometric));
        let (default_rms, default_worst) = errors(&geometric, &|b, dir, r| {
            environment_sample_hermite(&b.radiance, &b.slope, dir, lod_geometric(r, count(b)))
        });
        let percent = |(rms, worst): (f64, f64)| format!("{:.2} % / {:.1} %", 100.0 * rms, 100.0 * worst);
        println!("{name}: as seen, rms / worst: hermite {}", percent((default_rms, default_worst)));
        if full() {
            let plain =
                errors(&geometric, &|b, dir, r| environment_sample(&b.radiance, dir, lod_geometric(r, count(b))));
            let linear = errors(&bake(environment, &options(LevelMap::Linear)), &|b, dir, r| {
                environment_sample(&b.radiance, dir, lod_linear(r, count(b)))
            });
            let report = errors(&bake(environment, &options(LevelMap::Report)), &|b, dir, r| {
                environment_sample(&b.radiance, dir, lod_report(r, count(b)))
            });
            println!("  geometric {}, linear {}, report {}", percent(plain), percent(linear), percent(report));
        }
        // One number for three colours is too few beside lamps of a single colour on a black ground.
        let allowed = if *name == "lamps" { 0.4 } else { 0.15 };
        assert!(default_rms < 0.05 && default_worst < allowed, "{name}: rms {default_rms}, worst {default_worst}");
    }
}

/// The k-th direction and roughness: an even spread by an additive recurrence (Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences").
fn random_point(k: u32) -> ([f64; 3], f64) {
    let [u, v, w] = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9].map(|g: f64| (0.5 + g * f64::from(k)).fract());
    let (z, phi) = (2.0 * u - 1.0, 2.0 * PI * v);
    let across = (1.0 - z * z).sqrt();
    ([across * phi.cos(), z, across * phi.sin()], 0.1 + 0.9 * w)
}
