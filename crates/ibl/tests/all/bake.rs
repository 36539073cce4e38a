//! Properties of a bake that need no truth: white stays white, no seams, no chance, hard cases.

use halfvector_ibl::environment::{dfg_from_table, environment_sample, environment_sample_hermite, irradiance_sh2};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Cube, DFG_SIZE, Equirect, LevelMap, Prefilter, Visibility, bake, bake_while,
    bake_with_progress, cube_from_equirect, dfg, dfg_table, direction_from_equirect, direction_from_face,
    face_from_direction, sky, studio, texel_solid_angle, white,
};
use std::f64::consts::PI;

fn small(size: usize) -> BakeOptions {
    BakeOptions { size, irradiance_size: 16, ..BakeOptions::default() }
}

#[test]
fn white_is_one() {
    let baked = bake(&white(), &small(64));
    let rising = [0.0, 0.1, 0.215_443_47, 0.464_158_9, 1.0];
    assert!(baked.roughness.iter().zip(rising).all(|(a, b)| (a - b).abs() < 1e-6), "{:?}", baked.roughness);
    assert!(baked.slope.iter().flatten().all(|slope| slope.abs() < 1e-4));
    for cube in baked.radiance.iter().chain([&baked.irradiance_over_pi]) {
        for x in cube.texels.iter().flatten() {
            assert!((x - 1.0).abs() < 1e-5, "{x}");
        }
    }
    for dir in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, -0.8]] {
        for x in irradiance_sh2(baked.irradiance_sh_padded(), dir) {
            assert!((x - 1.0f32).abs() < 1e-5, "{x}");
        }
    }
}

/// A map that says where it looks: sampling the cube with a world direction returns what the map has there.
#[test]
fn cube_shows_the_right_way() {
    let map = Equirect::from_fn(512, 256, |d| d.map(|x| (x + 1.0) as f32));
    let cube = cube_from_equirect(&map, 64);
    for k in 0..200 {
        let (u, v) = ((k as f64 * 0.618_034).fract(), (k as f64 + 0.5) / 200.0);
        let dir = direction_from_equirect(u, v);
        for (value, x) in cube.sample(dir).iter().zip(dir) {
            assert!((f64::from(*value) - x - 1.0).abs() < 2e-3, "{dir:?}: {value}");
        }
    }
    // At the corners of the cube three texels meet.
    for corner in [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]] {
        for (value, x) in cube.sample(corner).iter().zip(corner) {
            assert!((f64::from(*value) - x / 3f64.sqrt() - 1.0).abs() < 0.02, "{corner:?}: {value}");
        }
    }
    for face in 0..6 {
        let (f, s, t) = face_from_direction(direction_from_face(face, 0.3, -0.7));
        assert!(f == face && (s - 0.3).abs() < 1e-12 && (t + 0.7).abs() < 1e-12);
    }
    let sphere: f64 = (0..49).map(|k| 6.0 * texel_solid_angle(7, k % 7, k / 7)).sum();
    assert!((sphere - 4.0 * PI).abs() < 1e-12);
}

/// A large map is averaged by area: a fine chequerboard becomes even grey, at the poles too, and no energy is lost.
#[test]
fn fine_maps_do_not_alias() {
    let map = Equirect {
        width: 1024,
        height: 512,
        pixels: (0..1024 * 512).map(|k| [((k % 1024 + k / 1024) % 2) as f32; 3]).collect(),
    };
    let cube = cube_from_equirect(&map, 32);
    for x in cube.texels.iter().flatten() {
        assert!((x - 0.5).abs() < 0.06, "{x}");
    }
    // Of a map only a little finer than the cube a texel holds a square and some of its neighbours: no mean is even, but
    // none is as uneven as the map.
    let map = Equirect {
        width: 128,
        height: 64,
        pixels: (0..128 * 64).map(|k| [((k % 128 + k / 128) % 2) as f32; 3]).collect(),
    };
    let cube = cube_from_equirect(&map, 32);
    let squares: f32 = cube.texels.iter().map(|texel| (texel[0] - 0.5).powi(2)).sum();
    let deviation = (squares / cube.texels.len() as f32).sqrt();
    println!("chequers a little finer than the cube: {deviation}");
    assert!(deviation < 0.2, "{deviation}");

    let mut lamp = Equirect { width: 1024, height: 512, pixels: vec![[0.0; 3]; 1024 * 512] };
    lamp.pixels[200 * 1024 + 333] = [1000.0; 3];
    let cube = cube_from_equirect(&lamp, 64);
    let mean = |c: &Cube| -> f64 {
        let share = |k: usize| texel_solid_angle(c.size, k % c.size, k / c.size % c.size) / (4.0 * PI);
        c.texels.iter().enumerate().map(|(k, texel)| f64::from(texel[0]) * share(k)).sum()
    };
    let (kept, whole) = (mean(&cube), lamp.mean()[0]);
    assert!((kept / whole - 1.0).abs() < 1e-3, "{kept} of {whole}");
}

/// The value steps between two texels that share an edge of the cube are as large as those inside the faces.
#[test]
fn no_seams() {
    let baked = bake(&studio(), &small(128));
    for (cube, roughness) in baked.radiance.iter().zip(&baked.roughness).skip(1) {
        let (inside, across) = steps(cube);
        println!("roughness {roughness}: mean step inside {inside:.5}, across edges {across:.5}");
        // Texels at an edge are smaller than at the middle of a face, so the steps are, too.
        assert!(across < 1.3 * inside, "roughness {roughness}: {across} for {inside}");
    }
}

/// Mean absolute step between neighbours, relative to the mean, inside the faces and across their edges.
fn steps(cube: &Cube) -> (f64, f64) {
    let n = cube.size;
    let at = |face: usize, i: usize, j: usize| f64::from(cube.texels[(face * n + j) * n + i][1]);
    let mean: f64 = cube.texels.iter().map(|t| f64::from(t[1])).sum::<f64>() / cube.texels.len() as f64;
    let (mut inside, mut count) = (0.0, 0.0);
    for face in 0..6 {
        for j in 0..n {
            for i in 1..n {
                inside += (at(face, i, j) - at(face, i - 1, j)).abs() + (at(face, j, i) - at(face, j, i - 1)).abs();
                count += 2.0;
            }
        }
    }
    let (mut across, mut edges) = (0.0, 0.0);
    for face in 0..6 {
        for k in 0..n {
            let place = (2.0 * k as f64 + 1.0) / n as f64 - 1.0;
            for (i, j, s, t) in [(0, k, -1.0001, place), (n - 1, k, 1.0001, place), (k, 0, place, -1.0001)] {
                let (other, s, t) = face_from_direction(direction_from_face(face, s, t));
                let index = |x: f64| (((x + 1.0) / 2.0 * n as f64) as usize).min(n - 1);
                across += (at(face, i, j) - at(other, index(s), index(t))).abs();
                edges += 1.0;
            }
        }
    }
    (inside / count / mean, across / edges / mean)
}

/// The same bytes with one thread, two and five.
#[test]
fn no_chance_and_no_order() {
    let options = BakeOptions { level_map: LevelMap::Listed(vec![0.0, 0.05, 0.2, 0.7]), ..small(32) };
    let halfvector_ibl::Source::Equirect(sky) = sky().source else { unreachable!("the sky is a map") };
    let environment = sky.area_resampled(256, 128).into();
    let with_threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a thread pool");
        pool.install(|| (bake(&environment, &options), dfg_table(16)))
    };
    let one = with_threads(1);
    for n in [2, 5] {
        assert!(with_threads(n) == one, "{n} threads");
    }
}

/// One texel with half of the energy, a black map, one texel in all, all at the largest value.
#[test]
fn hard_maps() {
    let black = Equirect { width: 64, height: 32, pixels: vec![[0.0; 3]; 64 * 32] };
    let baked = bake(&black.clone().into(), &small(32));
    assert!(baked.radiance.iter().flat_map(|cube| cube.texels.iter().flatten()).all(|&x| x == 0.0));

    let mut lamp = Equirect { width: 256, height: 128, pixels: vec![[0.1; 3]; 256 * 128] };
    let (row, column) = (30, 77);
    let area = 2.0 * PI / 256.0 * ((row as f64 * PI / 128.0).cos() - ((row + 1) as f64 * PI / 128.0).cos());
    lamp.pixels[row * 256 + column] = [(0.1 * 4.0 * PI / area) as f32; 3];
    let dir = direction_from_equirect((column as f64 + 0.5) / 256.0, (row as f64 + 0.5) / 128.0);
    let away = dir.map(|x| -x);
    let baked = bake(&lamp.into(), &small(128));
    for (cube, &roughness) in baked.radiance.iter().zip(&baked.roughness).skip(1) {
        // The lobe of a direction more than 90 degrees from the lamp does not see it.
        let dark = cube.sample(away)[0];
        assert!((dark - 0.1).abs() < 2e-3, "roughness {roughness}: {dark} on the dark side");
        assert!(cube.texels.iter().flatten().all(|&x| (0.0..65504.0).contains(&x)));
        // At 0.1 the lobe is narrower than the lamp and than the face's texels.
        if roughness < 0.2 {
            continue;
        }
        // A far lamp through a GGX lobe: what the kernel says, texel by texel.
        let alpha = f64::from(roughness).powi(2);
        let kernel = |cos: f64| cos.max(0.0) / ((1.0 - cos) * (1.0 - alpha * alpha) / 2.0 + alpha * alpha).powi(2);
        let steps = 200_000;
        let whole: f64 =
            (0..steps).map(|i| kernel((i as f64 + 0.5) / steps as f64) / steps as f64).sum::<f64>() * 2.0 * PI;
        // At the centre of the texel, which is beside the lamp.
        let (face, s, t) = face_from_direction(dir);
        let centre = |x: f64| {
            let n = cube.size as f64;
            (((x + 1.0) / 2.0 * n).floor() * 2.0 + 1.0) / n - 1.0
        };
        let seen = direction_from_face(face, centre(s), centre(t));
        let length = seen.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cos = (0..3).map(|i| seen[i] * dir[i]).sum::<f64>() / length;
        let peak = 0.1 + (0.1 * 4.0 * PI - 0.1 * area) * kernel(cos) / whole;
        let value = f64::from(cube.sample(seen)[0]);
        println!("roughness {roughness}: {value} towards the lamp, a point lamp gives {peak}");
        assert!((value / peak - 1.0).abs() < 0.08, "roughness {roughness}: {value} for {peak}");
    }

    let full = Equirect { width: 1, height: 1, pixels: vec![[65504.0; 3]] };
    let baked = bake(&full.into(), &small(16));
    for x in baked.radiance.iter().flat_map(|cube| cube.texels.iter().flatten()) {
        assert!((x / 65504.0 - 1.0).abs() < 1e-5, "{x}");
    }
}

/// Any options give something that can be read.
#[test]
fn any_options() {
    let environment = white();
    for size in [0, 1, 3, 17] {
        for level_map in [
            LevelMap::Geometric,
            LevelMap::Linear,
            LevelMap::Report,
            LevelMap::Listed(vec![]),
            LevelMap::Listed(vec![f32::NAN, -1.0, 9.0, 0.3]),
        ] {
            let counted = matches!(level_map, LevelMap::Geometric | LevelMap::Linear);
            for levels in [None, Some(0), Some(3)].into_iter().take(if counted { 3 } else { 1 }) {
                let options = BakeOptions {
                    size,
                    levels,
                    level_map: level_map.clone(),
                    decode_report: true,
                    irradiance_size: 0,
                    ..BakeOptions::default()
                };
                let baked = bake(&environment, &options);
                assert_eq!(baked.radiance.len(), baked.roughness.len());
                let slopes = if level_map == LevelMap::Geometric { baked.radiance.len() } else { 0 };
                assert_eq!(baked.slope.len(), slopes);
                for (i, level) in baked.radiance.iter().enumerate() {
                    assert_eq!(level.size, (size >> i).max(1));
                    assert_eq!(level.texels.len(), 6 * level.size * level.size);
                    assert!(level.texels.iter().flatten().all(|x| (x - 0.5).abs() < 1e-5));
                }
            }
        }
    }
    let BakedEnvironment { radiance: levels, slope, .. } = bake(&environment, &small(16));
    for lod in [f64::NAN, -1.0, 0.0, 0.5, 99.0, f64::INFINITY] {
        assert!((environment_sample(&levels, [0.0, 0.0, 0.0], lod)[0] - 1.0).abs() < 1e-5);
        let seen = environment_sample_hermite(&levels, &slope, [0.0, 0.0, 0.0], lod)[0];
        assert!((seen - 1.0).abs() < 1e-4, "{lod}: {seen}");
    }
}

/// The report's levels: six, at fifths, each half as large as the one before.
#[test]
fn report_levels() {
    let options = BakeOptions { level_map: LevelMap::Report, irradiance_size: 64, ..small(64) };
    let baked = bake(&studio(), &options);
    assert_eq!(baked.roughness, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
    assert_eq!(baked.radiance.iter().map(|cube| cube.size).collect::<Vec<_>>(), [64, 32, 16, 8, 4, 2]);
    // GGX at roughness 1 is the cosine lobe: the last level is the diffuse light.
    for dir in [[0.5, 1.0, 0.5], [1.0, -0.5, 0.5], [0.5, -0.5, -1.0]] {
        let (last, diffuse) = (baked.radiance[5].sample(dir)[0], baked.irradiance_over_pi.sample(dir)[0]);
        assert!((last / diffuse - 1.0).abs() < 0.02, "{last} for {diffuse}");
    }
}

/// The lobes that are not GGX: white stays white, and HDRE's powers of the cosine are what its formula says.
#[test]
fn other_lobes() {
    let options = |prefilter, level_map| BakeOptions { prefilter, level_map, ..small(64) };
    for (prefilter, level_map) in [(Prefilter::Hdre, LevelMap::Report), (Prefilter::Charlie, LevelMap::Linear)] {
        for cube in bake(&white(), &options(prefilter, level_map)).radiance {
            assert!(cube.texels.iter().flatten().all(|x| (x - 1.0).abs() < 1e-5), "{prefilter:?}");
        }
    }
    // The environment y + 1: a lobe keeps its mean, and k_1 of y; (p + 1) / (p + 2) for a power p of the cosine.
    let map = Equirect::from_fn(256, 128, |d| [(d[1] + 1.0) as f32; 3]);
    let baked = bake(&map.clone().into(), &options(Prefilter::Hdre, LevelMap::Report));
    for (i, cube) in baked.radiance.iter().enumerate().skip(1) {
        let r: f64 = ((i + 1) as f64 / 6.0).min(0.98);
        let power = 8.0 * (1.0 - r) * 64.0 / (5.0 * r).exp2();
        let dir = [1.0, 1.0 / 3.0, -0.2];
        let (value, y) = (f64::from(cube.sample(dir)[0]), dir[1] / (1.0f64 + dir[1] * dir[1] + 0.04).sqrt());
        // The smallest faces have two texels.
        let allowed = if cube.size < 32 { 0.2 / cube.size as f64 } else { 3e-3 };
        let exact = 1.0 + y * (power + 1.0) / (power + 2.0);
        assert!((value - exact).abs() < allowed, "level {i}: {value} for {exact}");
    }
    // Smooth sheen sees the horizon, rough sheen half of the light above.
    let baked = bake(&map.into(), &options(Prefilter::Charlie, LevelMap::Linear));
    let above = |level: usize| baked.radiance[level].sample([0.0, 1.0, 0.0])[0];
    assert!(above(0) < 1.05 && above(2) > 1.2 && above(2) < 1.6, "{} {}", above(0), above(2));
}

/// Both built-in pictures have the brightness and the range that their documentation states.
#[test]
fn built_ins() {
    for (name, environment, mean_range) in [("studio", studio(), 0.45..0.6), ("sky", sky(), 0.4..0.7)] {
        assert!(environment.repairs.is_none(), "{name}: {}", environment.repairs);
        let baked = bake(&environment, &small(64));
        let mean = baked.irradiance_sh[0];
        println!("{name}: mean radiance {mean:?}");
        for x in mean {
            assert!(mean_range.contains(&x), "{name}: {mean:?}");
        }
    }
}

/// The table that shaders read, at its texels.
#[test]
fn dfg_table_is_accurate() {
    let table = dfg_table(DFG_SIZE);
    assert!(table.texels.len() * 4 <= 8192, "8 KiB of f16 pairs");
    let last = (DFG_SIZE - 1) as f64;
    let mut worst = 0.0f64;
    for k in (0..table.texels.len()).step_by(23) {
        let (x, y) = ((k % DFG_SIZE) as f64 / last, (k / DFG_SIZE) as f64 / last);
        let truth = dfg(x.powi(4), y.powi(2), Visibility::Correlated);
        for (value, truth) in table.texels[k].iter().zip(truth) {
            worst = worst.max((f64::from(*value) - truth).abs());
        }
    }
    println!("dfg table: {worst:.2e} at texels");
    assert!(worst < 3e-4);
    // A mirror reflects Schlick's share.
    for n_dot_v in [0.0, 0.2, 0.5, 1.0] {
        let [a, b] = dfg(n_dot_v, 0.0, Visibility::Correlated);
        let fresnel = (1.0 - n_dot_v).powi(5);
        assert!((b - fresnel).abs() < 1e-4 && (a - 1.0 + fresnel).abs() < 1e-4, "{n_dot_v}: {a}, {b}");
    }
    for (x, y) in [(f64::NAN, f64::NAN), (-1.0, 2.0), (0.0, 1.0), (1e300, -1e300)] {
        assert!(
            dfg(x, y, Visibility::Separable)
                .iter()
                .chain(&dfg_from_table(&table, x, y).map(f64::from))
                .all(|v| (0.0..=1.0).contains(v))
        );
    }
}

/// A bake that is told to stop at a step stops there; one that is not gives what `bake` gives.
#[test]
fn a_bake_stops_when_it_is_told_to() {
    let mut steps = 0;
    let stopped = bake_while(&white(), &small(32), &mut |_| {
        steps += 1;
        steps < 3
    });
    assert!(stopped.is_none() && steps == 3, "{steps}");
    let whole = bake_while(&white(), &small(32), &mut |_| true).expect("a whole bake");
    assert_eq!(whole.irradiance_sh, bake(&white(), &small(32)).irradiance_sh);
}

/// Progress starts at 0, never falls and ends at 1.
#[test]
fn progress_rises() {
    let mut seen = Vec::new();
    bake_with_progress(&white(), &small(32), &mut |share| seen.push(share));
    assert!(seen.len() > 3 && seen[0] == 0.0 && seen.last() == Some(&1.0), "{seen:?}");
    assert!(seen.is_sorted(), "{seen:?}");
}
