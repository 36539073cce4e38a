//! Prefiltered radiance, irradiance and harmonics against brute-force tables of four environments, and a mirror ball
//! against a renderer's picture.
//!
//! The tables stand in another frame: exchange x and z of every direction.

use crate::{ENVIRONMENTS, data_file, data_table, environment, mirrored, numbers, relative_errors, rms, share};
use halfvector_ibl::environment::{dfg_from_table, environment_sample, irradiance_sh2, lod_linear, rotate_about_y};
use halfvector_ibl::{
    BakeOptions, Equirect, LevelMap, LoadedEnvironment, Quadrature, Quality, Source, Visibility, bake, dfg_table_with,
    direction_from_face, load,
};
use std::collections::BTreeMap;

fn mean_of(environment: &LoadedEnvironment) -> [f64; 3] {
    match &environment.source {
        Source::Equirect(map) => map.mean(),
        Source::Levels(_) => unreachable!("the tables belong to maps"),
    }
}

/// Each roughness of the table baked as a level of its own, read at the table's directions, which are not texel centres:
/// levels are baked at 256 texels so that what is measured is the filter. At 0.1 the lobe spans four texels, and reading
/// between them shows; the table's 0.05 spans one, so it is left out.
#[test]
fn prefiltered_radiance() {
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_prefilter.csv")))
        else {
            return;
        };
        let mean = mean_of(&environment);
        let mut errors: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        let mut rows: BTreeMap<u32, Vec<&Vec<String>>> = BTreeMap::new();
        for row in &table {
            let roughness: f64 = row[4].parse().expect("a number");
            if roughness < 0.09 {
                continue;
            }
            rows.entry((roughness * 1000.0).round() as u32).or_default().push(row);
        }
        for (&key, rows) in &rows {
            let roughness = key as f32 / 1000.0;
            let options = BakeOptions {
                size: 512,
                level_map: LevelMap::Listed(vec![0.0, roughness]),
                irradiance_size: 1,
                ..BakeOptions::default()
            };
            let baked = bake(&environment, &options);
            for row in rows {
                let value = baked.radiance[1].sample(mirrored(numbers(row, 1)));
                errors.entry(key).or_default().extend(relative_errors(value, numbers(row, 6), mean));
            }
        }
        for (key, errors) in errors {
            let roughness = f64::from(key) / 1000.0;
            let worst = errors.iter().copied().fold(0.0, f64::max);
            println!("{name} roughness {roughness}: rms {:.3} %, worst {:.3} %", 100.0 * rms(&errors), 100.0 * worst);
            let allowed = if roughness > 0.199 { 0.005 } else { 0.03 };
            assert!(rms(&errors) < allowed, "{name} at {roughness}: rms {}", rms(&errors));
        }
    }
}

/// A preview and a default bake, at texel centres of 256-texel faces from roughness 0.1 up, against sums over texels.
#[test]
fn preview() {
    for name in ENVIRONMENTS {
        let Some(environment) = environment(name) else { return };
        let Source::Equirect(map) = &environment.source else { unreachable!("these environments are maps") };
        let truth = Quadrature::new(map);
        for quality in [Quality::Preview, Quality::Default] {
            let options = BakeOptions { size: 256, irradiance_size: 1, quality, ..BakeOptions::default() };
            let baked = bake(&environment, &options);
            for (cube, &roughness) in baked.radiance.iter().zip(&baked.roughness).skip(1) {
                let n = cube.size;
                let error = |texel: usize| {
                    let place = |i: usize| (2.0 * i as f64 + 1.0) / n as f64 - 1.0;
                    let dir = direction_from_face(texel / (n * n), place(texel % n), place(texel / n % n));
                    let length = dir.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let exact = truth.prefiltered(dir.map(|x| x / length), f64::from(roughness));
                    relative_errors(cube.texels[texel], exact, truth.mean())
                };
                // Any texels, and the six brightest.
                let errors: Vec<f64> = (0..share(80)).flat_map(|k| error(k * 7919 % (6 * n * n))).collect();
                let mut order: Vec<usize> = (0..6 * n * n).collect();
                order.sort_by(|&a, &b| cube.texels[b][1].total_cmp(&cube.texels[a][1]));
                let brightest = order[..6].iter().flat_map(|&texel| error(texel)).fold(0.0, f64::max);
                let found = rms(&errors);
                println!(
                    "{name}, {quality:?}, roughness {roughness:.3}: rms {:.3} %, six brightest within {:.3} %",
                    100.0 * found,
                    100.0 * brightest
                );
                let (any, bright) = if quality == Quality::Preview { (0.01, 0.02) } else { (0.005, 0.01) };
                assert!(found < any && brightest < bright, "{name}, {quality:?}, {roughness}: {found}, {brightest}");
            }
        }
    }
}

/// The filter itself, from a cube so large that reading between texels adds nothing, and as stored: between texels, where lamps stand on the horizon, the light has a kink that a linear mix rounds off.
#[test]
fn irradiance() {
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_irradiance.csv")))
        else {
            return;
        };
        let mean = mean_of(&environment);
        let baked = |irradiance_size| {
            bake(&environment, &BakeOptions { size: 8, levels: Some(1), irradiance_size, ..BakeOptions::default() })
        };
        let (stored, fine) = (baked(BakeOptions::default().irradiance_size), baked(512));
        let mut errors = [(); 3].map(|()| 0.0f64);
        for row in &table {
            let dir = mirrored(numbers(row, 1));
            // The table's own order-2 value may be negative; ours stops at 0.
            let order_2 = numbers(row, 7).map(|x| x.max(0.0));
            let harmonics = irradiance_sh2(stored.irradiance_sh_padded(), dir.map(|x| x as f32));
            let found = [
                relative_errors(fine.irradiance_over_pi.sample(dir), numbers(row, 4), mean),
                relative_errors(stored.irradiance_over_pi.sample(dir), numbers(row, 4), mean),
                relative_errors(harmonics, order_2, mean),
            ];
            for (worst, found) in errors.iter_mut().zip(found) {
                *worst = found.into_iter().fold(*worst, f64::max);
            }
        }
        let [filter, stored, harmonics] = errors.map(|e| 100.0 * e);
        println!(
            "{name}: irradiance worst {filter:.4} %, as stored {stored:.4} %, order 2 against order 2 {harmonics:.4} %"
        );
        assert!(filter < 0.05 && stored < 0.2 && harmonics < 0.01, "{name}");
    }
}

/// The nine coefficients against the table's, turned into our frame and given their constants.
#[test]
fn harmonics() {
    use std::f64::consts::PI;
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_sh.csv"))) else {
            return;
        };
        let t: Vec<[f64; 3]> = table.iter().map(|row| numbers(row, 6)).collect();
        // Exchanging x and z: y and xz stay, z and x swap, xy and yz swap, and the two last mix.
        let mixed = |a: f64, b: f64| -> [f64; 3] { std::array::from_fn(|c| a * t[6][c] + b * t[8][c]) };
        let half_root_3 = 3.0f64.sqrt() / 2.0;
        let ours = [t[0], t[1], t[3], t[2], t[5], t[4], mixed(-0.5, half_root_3), t[7], mixed(half_root_3, 0.5)];
        let n1 = (3.0 / (4.0 * PI)).sqrt();
        let n2 = (15.0 / (4.0 * PI)).sqrt();
        let constants = [
            (1.0 / (4.0 * PI)).sqrt(),
            n1,
            n1,
            n1,
            n2,
            n2,
            (5.0 / (16.0 * PI)).sqrt(),
            n2,
            (15.0 / (16.0 * PI)).sqrt(),
        ];
        let scale = ours[0].map(|x| x * constants[0]);
        for quality in [Quality::Preview, Quality::Default] {
            let options =
                BakeOptions { size: 8, levels: Some(1), irradiance_size: 1, quality, ..BakeOptions::default() };
            let baked = bake(&environment, &options);
            let mut worst = 0.0f64;
            for (k, constant) in constants.into_iter().enumerate() {
                for (c, scale) in scale.into_iter().enumerate() {
                    let (value, truth) = (f64::from(baked.irradiance_sh[k][c]), ours[k][c] * constant);
                    worst = worst.max((value - truth).abs() / scale);
                }
            }
            println!("{name}, {quality:?}: coefficients within {worst:.1e} of the mean");
            assert!(worst < 1e-4, "{name}, {quality:?}: {worst}");
        }
    }
}

/// The map of a path tracer's pictures in our rows, and one of the pictures.
fn picture(name: &str) -> Option<(LoadedEnvironment, Equirect)> {
    let equirect = |path: &str| match load(&data_file(path)?, path).expect("the file is sound").source {
        Source::Equirect(map) => Some(map),
        Source::Levels(_) => unreachable!("an EXR file is a map"),
    };
    // That renderer's rows stand at v = j / (height - 1).
    let map = equirect("mitsuba/venice.exr")?;
    let rows = 4 * map.height;
    Some((map.resampled_rows_from_vertex_grid(rows).into(), equirect(&format!("mitsuba/{name}__hdr.exr"))?))
}

/// The pictures need the environment turned by -90 degrees.
const TURN: [f64; 2] = [0.0, -1.0];

/// What a mirror ball shows through a 512-texel cube, against a path tracer's picture, by the same lookups as a shader's.
#[test]
fn mirror_ball() {
    let Some((environment, truth)) = picture("mirror") else { return };
    let baked = bake(&environment, &BakeOptions { levels: Some(1), irradiance_size: 1, ..BakeOptions::default() });
    let (error, bias) =
        ball_error(&truth, |normal, view| environment_sample(&baked.radiance, mirrored_view(normal, view).0, 0.0));
    println!("mirror ball: {:.3} %, bias {:.3} %", 100.0 * error, 100.0 * bias);
    assert!(error < 0.012, "{error}");
}

/// A white Lambert ball of albedo 0.8 under the irradiance cube and under the harmonics, against a path tracer's picture.
#[test]
fn diffuse_ball() {
    let Some((environment, truth)) = picture("diffuse_080") else { return };
    let baked = bake(&environment, &BakeOptions { size: 8, levels: Some(1), ..BakeOptions::default() });
    let turned = |normal| rotate_about_y(normal, TURN);
    let (cube, bias) = ball_error(&truth, |normal, _| baked.irradiance_over_pi.sample(turned(normal)).map(|x| 0.8 * x));
    let (harmonics, _) = ball_error(&truth, |normal, _| {
        irradiance_sh2(baked.irradiance_sh_padded(), turned(normal).map(|x| x as f32)).map(|x| 0.8 * x)
    });
    println!("diffuse ball: {:.3} %, bias {:.3} %, order 2 {:.3} %", 100.0 * cube, 100.0 * bias, 100.0 * harmonics);
    assert!(cube < 0.01, "{cube}");
}

/// A gold ball of roughness 0.4 by the split sum, with the default levels, against a path tracer's picture: the levels and
/// their linear mix, the table, and the split sum's own error together.
#[test]
fn metal_ball() {
    let Some((environment, truth)) = picture("principled_gold_m1_r040") else { return };
    let table = dfg_table_with(64, Visibility::Separable);
    for (name, level_map) in [("linear", LevelMap::Linear), ("report", LevelMap::Report)] {
        let baked = bake(&environment, &BakeOptions { level_map, irradiance_size: 1, ..BakeOptions::default() });
        let lod = lod_linear(0.4, baked.radiance.len() as f64);
        let (error, bias) = ball_error(&truth, |normal, view| {
            let (reflected, n_dot_v) = mirrored_view(normal, view);
            let prefiltered = environment_sample(&baked.radiance, reflected, lod);
            let [a, b] = dfg_from_table(&table, n_dot_v, 0.4);
            let f0 = [1.0, 0.766, 0.336];
            std::array::from_fn(|c| prefiltered[c] * (f0[c] * a + b))
        });
        println!("metal ball, {name} levels: {:.3} %, bias {:.3} %", 100.0 * error, 100.0 * bias);
        assert!(error < 0.1 && bias.abs() < 0.04, "{name}: {error}, bias {bias}");
    }
}

/// The mirror direction in the environment's frame, and n.v.
fn mirrored_view(normal: [f64; 3], view: [f64; 3]) -> ([f64; 3], f64) {
    let n_dot_v = normal[0] * view[0] + normal[1] * view[1] + normal[2] * view[2];
    (rotate_about_y(std::array::from_fn(|i| 2.0 * n_dot_v * normal[i] - view[i]), TURN), n_dot_v)
}

/// sqrt(mean (a - b)^2) / mean(b) and mean(a - b) / mean(b) within 96 px of the middle of a picture of a unit sphere, camera at (0, 0, 5), vertical
/// field of view 30 degrees, 4 x 4 samples per pixel.
fn ball_error(truth: &Equirect, radiance: impl Fn([f64; 3], [f64; 3]) -> [f32; 3]) -> (f64, f64) {
    let size = truth.width;
    let tangent = 15f64.to_radians().tan();
    let (mut squares, mut difference, mut sum, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (k, expected) in truth.pixels.iter().enumerate() {
        let (px, py) = (k % size, k / size);
        let middle = size as f64 / 2.0;
        if (px as f64 + 0.5 - middle).hypot(py as f64 + 0.5 - middle) > 96.0 {
            continue;
        }
        let mut value = [0.0f64; 3];
        for s in 0..16 {
            let x = (px as f64 + (f64::from(s % 4) + 0.5) / 4.0) / middle - 1.0;
            let y = 1.0 - (py as f64 + (f64::from(s / 4) + 0.5) / 4.0) / middle;
            let length = (1.0 + (x * x + y * y) * tangent * tangent).sqrt();
            let dir = [x * tangent / length, y * tangent / length, -1.0 / length];
            // |(0, 0, 5) + t dir|^2 = 1.
            let b = 5.0 * dir[2];
            let root = (b * b - 24.0).max(0.0).sqrt();
            let t = -b - root;
            let normal = [t * dir[0], t * dir[1], 5.0 + t * dir[2]];
            let texel = radiance(normal, dir.map(|x| -x));
            for c in 0..3 {
                value[c] += f64::from(texel[c]) / 16.0;
            }
        }
        for c in 0..3 {
            squares += (value[c] - f64::from(expected[c])).powi(2);
            difference += value[c] - f64::from(expected[c]);
            sum += f64::from(expected[c]);
            count += 1.0;
        }
    }
    ((squares / count).sqrt() / (sum / count), difference / sum)
}
