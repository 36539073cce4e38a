//! Roughness for mip levels: the widened lobe against the mean of the fine level's lobes.

use halfvector_maps::lost_length::{Rule, Spread, lobe_error};
use halfvector_maps::{Channels, Image, Limits, Texels, adjusted_roughness, decode};

use crate::unit;

/// Normals of `side` x `side` texels of a surface with slopes (a, b) at texel (x, y).
fn patch(side: usize, slopes: impl Fn(f64, f64) -> [f64; 2]) -> Vec<[f64; 3]> {
    let at = |i: usize| {
        let [a, b] = slopes((i % side) as f64, (i / side) as f64);
        unit([a, b, 1.0])
    };
    (0..side * side).map(at).collect()
}

/// Pairs of independent normally distributed numbers, the same each time (Box and Muller 1958).
fn gaussian(i: f64, j: f64) -> [f64; 2] {
    let hash = |x: f64| ((x * 12.9898).sin() * 43_758.545_3).rem_euclid(1.0);
    let (u, v) = (hash(i + 57.0 * j + 1.0).max(1e-9), hash(3.0 * i + 113.0 * j + 0.5));
    let (radius, angle) = ((-2.0 * u.ln()).sqrt(), std::f64::consts::TAU * v);
    [radius * angle.cos(), radius * angle.sin()]
}

/// Name, patches of normals.
fn surfaces() -> Vec<(&'static str, Vec<Vec<[f64; 3]>>)> {
    let noise = |deviation: f64| {
        move |seed: f64| patch(8, move |x, y| gaussian(x + 31.0 * seed, y - 17.0 * seed).map(|g| g * deviation))
    };
    let many = |make: &dyn Fn(f64) -> Vec<[f64; 3]>| (0..4).map(|seed| make(f64::from(seed))).collect::<Vec<_>>();
    let mut surfaces = vec![
        ("noise, slope 0.05", many(&noise(0.05))),
        ("noise, slope 0.2", many(&noise(0.2))),
        ("noise, slope 0.5", many(&noise(0.5))),
        ("waves, slope 0.3", vec![patch(8, |x, y| [0.3 * (x * 0.785).cos(), 0.3 * (y * 0.785).cos()])]),
        ("grooves, slope 0.3", vec![patch(8, |x, _| [if x % 2.0 < 1.0 { 0.3 } else { -0.3 }, 0.0])]),
        (
            "pyramids, slope 0.5",
            vec![patch(8, |x, y| [if x < 4.0 { 0.5 } else { -0.5 }, if y < 4.0 { 0.5 } else { -0.5 }])],
        ),
    ];
    let path = crate::data().join("textures/Metal_Mesh_008/normalmap.jpg");
    match std::fs::read(&path) {
        Ok(bytes) => {
            let image = decode(&bytes, Limits::default()).unwrap().into_data().image;
            let tile = |k: u32| {
                let (left, top) = (k * 251 % 1008, k * 379 % 1008);
                let at = |i: u32| {
                    let [r, g, b, _] = image.texel(left + i % 8, top + i / 8).map(|c| 2.0 * f64::from(c) - 1.0);
                    unit([r, g, b])
                };
                (0..64).map(at).collect::<Vec<_>>()
            };
            surfaces.push(("Metal_Mesh_008", (1..25).map(tile).collect()));
        }
        Err(_) => println!("skipped: no {}", path.display()),
    }
    surfaces
}

/// The table, which the README carries. `cargo test -p halfvector-maps table_of_rules -- --nocapture` prints it.
#[test]
fn table_of_rules() {
    println!("| surface | roughness | unchanged | toksvig | von_mises_fisher | lean |\n|---|---|---|---|---|---|");
    let mut totals = [0.0; 4];
    for (name, patches) in surfaces() {
        for roughness in [0.3_f64, 0.5, 0.7] {
            let alpha = roughness * roughness;
            let mut errors = [0.0; 4];
            for normals in &patches {
                let spread = Spread::of(normals);
                let widths = [
                    alpha,
                    Rule::ALL[0].alpha(alpha, spread),
                    Rule::ALL[1].alpha(alpha, spread),
                    Rule::ALL[2].alpha(alpha, spread),
                ];
                for (error, width) in errors.iter_mut().zip(widths) {
                    *error += lobe_error(normals, alpha, width, 96) / patches.len() as f64;
                }
            }
            println!(
                "| {name} | {roughness} | {:.3} | {:.3} | {:.3} | {:.3} |",
                errors[0], errors[1], errors[2], errors[3]
            );
            totals.iter_mut().zip(errors).for_each(|(total, error)| *total += error);
        }
    }
    println!("sums: {totals:.3?}");
    let default = 1 + Rule::ALL.iter().position(|&rule| rule == Rule::default()).unwrap();
    assert!(totals[1..].iter().all(|&total| totals[default] <= total), "another rule is better: {totals:.3?}");
    assert!(totals[default] < 0.7 * totals[0], "{totals:.3?}");
}

/// No spread, no change; more spread, more width; never beyond 1, never NaN.
#[test]
fn rules_are_sound() {
    for rule in Rule::ALL {
        for alpha in [0.0, 1e-4, 0.04, 0.3, 1.0] {
            let flat = rule.alpha(alpha, Spread { mean_length: 1.0, slope_variance: 0.0 });
            assert!((flat - alpha).abs() < 1e-5, "{rule:?} {alpha}: {flat}");
            let mut last = flat;
            for i in 0..=100 {
                let t = f64::from(i) / 100.0;
                let wider = rule.alpha(alpha, Spread { mean_length: 1.0 - t, slope_variance: 10.0 * t });
                assert!((last - 1e-12..=1.0 + 1e-12).contains(&wider), "{rule:?} {alpha} {t}: {wider}");
                last = wider;
            }
        }
    }
    assert_eq!(Spread::of(&[]), Spread { mean_length: 1.0, slope_variance: 0.0 });
    let opposed = Spread::of(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]);
    assert!(opposed.mean_length == 0.0 && opposed.slope_variance.is_finite());
}

/// A map of equal normals keeps its roughness in all levels; a bumpy one becomes rougher level by level; odd sizes too.
#[test]
fn levels_become_rougher() {
    let grey = |code: u8, width: u32, height: u32| {
        Image::new(width, height, Channels::Grey, Texels::U8(vec![[code, code, code, 255]; (width * height) as usize]))
            .unwrap()
    };
    let flat = Image::new(16, 8, Channels::Rgb, Texels::U8(vec![[128, 128, 255, 255]; 128])).unwrap();
    for (roughness, name) in [(grey(100, 16, 8), "a map"), (grey(100, 1, 1), "a constant")] {
        let levels = adjusted_roughness(&roughness, &flat, Rule::default()).unwrap();
        assert_eq!(levels.len(), 5, "{name}");
        for level in &levels {
            let Texels::U8(texels) = level.texels() else { panic!("8 bits expected") };
            assert!(texels.iter().all(|t| *t == [100, 100, 100, 255]), "{name}: {texels:?}");
        }
    }
    for (width, height) in [(16, 16), (15, 9), (1, 7)] {
        let bumpy = (0..width * height)
            .map(|i| if (i % width + i / width) % 2 == 0 { [200, 128, 220, 255] } else { [56, 128, 220, 255] });
        let bumpy = Image::new(width, height, Channels::Rgb, Texels::U8(bumpy.collect())).unwrap();
        for rule in Rule::ALL {
            let levels = adjusted_roughness(&grey(50, 1, 1), &bumpy, rule).unwrap();
            assert_eq!(levels[0].texel(0, 0)[0], 50.0 / 255.0);
            let last = levels.last().unwrap();
            assert!(
                (last.width(), last.height()) == (1, 1) && last.texel(0, 0)[0] > 0.5,
                "{rule:?} {width} x {height}"
            );
        }
    }
    let error = adjusted_roughness(&grey(1, 2, 2), &flat, Rule::Lean).unwrap_err();
    assert!(error.to_string().contains("2 x 2") && error.to_string().contains("16 x 8"), "{error}");
}

/// What the levels say is what the rule says of all normals of a footprint, each summed in f64; and a flat map stays as
/// smooth as it was, also a mirror and whichever way the map leans.
#[test]
fn levels_are_the_rule_of_their_footprints() {
    let mut state = 7_u32;
    let mut number = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    let (width, height) = (32_usize, 16_usize);
    let texels: Vec<_> = (0..width * height).map(|_| [number(), number(), 0.5 + 0.5 * number(), 1.0]).collect();
    let bumpy = Image::new(width as u32, height as u32, Channels::Rgb, Texels::F32(texels.clone())).unwrap();
    let roughness = Texels::F32((0..width * height).map(|i| [i as f32 / 512.0; 4]).collect());
    let roughness = Image::new(width as u32, height as u32, Channels::Grey, roughness).unwrap();
    for rule in Rule::ALL {
        let levels = adjusted_roughness(&roughness, &bumpy, rule).unwrap();
        for (k, level) in levels.iter().enumerate().skip(1) {
            let (sides, places) = ((width.min(1 << k), height.min(1 << k)), (level.width(), level.height()));
            for (i, j) in (0..places.1).flat_map(|j| (0..places.0).map(move |i| (i, j))) {
                let covered = (0..sides.0 * sides.1)
                    .map(|t| (j as usize * sides.1 + t / sides.0) * width + i as usize * sides.0 + t % sides.0);
                let normals: Vec<_> =
                    covered.clone().map(|t| unit([0, 1, 2].map(|k| 2.0 * f64::from(texels[t][k]) - 1.0))).collect();
                let alpha_squared = covered.map(|t| (t as f64 / 512.0).powi(4)).sum::<f64>() / normals.len() as f64;
                let truth = rule.alpha(alpha_squared.sqrt(), Spread::of(&normals)).sqrt();
                let found = f64::from(level.texel(i, j)[0]);
                assert!((found - truth).abs() < 1e-4, "{rule:?} level {k} ({i}, {j}): {found}, not {truth}");
            }
        }
        for lean in [[128, 128, 255], [255, 128, 128], [10, 200, 140], [90, 90, 200]] {
            let [r, g, b] = lean;
            let flat = Image::new(32, 9, Channels::Rgb, Texels::U8(vec![[r, g, b, 255]; 288])).unwrap();
            let mirror = Image::new(1, 1, Channels::Grey, Texels::F32(vec![[0.0; 4]])).unwrap();
            for level in adjusted_roughness(&mirror, &flat, rule).unwrap() {
                let Texels::F32(texels) = level.texels() else { panic!("floats expected") };
                assert!(texels.iter().all(|t| t[0] <= 0.032), "{rule:?} {lean:?}: {:?}", texels[0]);
            }
        }
    }
}
