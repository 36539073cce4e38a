//! Voronoi cells against the truth in f64: every point of the cells around, far beyond where the shader looks, by each metric.

use super::run::Node;

/// Cells on each side in which the truth looks.
const REACH: i32 = 5;
/// Points of each setting.
const POINTS: usize = 48;

/// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d.
fn hash(cell: [i32; 3], seed: i32) -> [u32; 3] {
    let moved = seed.cast_unsigned().wrapping_mul(0x9e37_79b9);
    let [x, y, z] = cell.map(i32::cast_unsigned);
    let mut h = [x, y, z.wrapping_add(moved)].map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let round = |h: &mut [u32; 3]| {
        for i in 0..3 {
            h[i] = h[i].wrapping_add(h[(i + 1) % 3].wrapping_mul(h[(i + 2) % 3]));
        }
    };
    round(&mut h);
    h = h.map(|v| v ^ (v >> 16));
    round(&mut h);
    h
}

fn length(v: [f64; 3], metric: i32, exponent: f64) -> f64 {
    let a = v.map(f64::abs);
    match metric {
        1 => a.iter().sum(),
        2 => a.iter().copied().fold(0.0, f64::max),
        3 => a.iter().map(|x| x.powf(exponent)).sum::<f64>().powf(1.0 / exponent),
        _ => a.iter().map(|x| x * x).sum::<f64>().sqrt(),
    }
}

/// A feature point that the truth knows: distance, value, place.
struct Feature {
    d: f64,
    id: f64,
    place: [f64; 3],
}

/// All points around p, nearest first.
fn features(p: [f64; 3], dimensions: usize, jitter: f64, metric: i32, exponent: f64, seed: i32) -> Vec<Feature> {
    let middle = p.map(|x| x.floor() as i32);
    let deep = if dimensions == 3 { REACH } else { 0 };
    let mut found = Vec::new();
    for z in -deep..=deep {
        for y in -REACH..=REACH {
            for x in -REACH..=REACH {
                let offset = [x, y, z];
                let cell: [i32; 3] = std::array::from_fn(|i| if i < dimensions { middle[i] + offset[i] } else { 0 });
                let words = hash(cell, seed);
                let unit = words.map(|w| f64::from(w >> 8) / 16_777_216.0);
                let place: [f64; 3] = std::array::from_fn(|i| {
                    if i < dimensions { f64::from(cell[i]) + 0.5 + (unit[i] - 0.5) * jitter } else { 0.0 }
                });
                let away = std::array::from_fn(|i| if i < dimensions { place[i] - p[i] } else { 0.0 });
                let id = if dimensions == 3 { f64::from(words[0] & 255) / 255.0 } else { unit[2] };
                found.push(Feature { d: length(away, metric, exponent), id, place });
            }
        }
    }
    found.sort_by(|a, b| a.d.total_cmp(&b.d));
    found
}

/// Settings: jitter, metric, exponent as it is set and as it is held, in the plane and in space.
const SETTINGS: [(f32, i32, f32, [f64; 2]); 10] = [
    (1.0, 0, 0.5, [2.0; 2]),
    (0.6, 0, 0.5, [2.0; 2]),
    (1.0, 1, 0.5, [1.0; 2]),
    (0.0, 1, 0.5, [1.0; 2]),
    (1.0, 2, 0.5, [32.0; 2]),
    (1.0, 3, 3.0, [3.0; 2]),
    (1.0, 3, 0.5, [0.5, 0.75]),
    (1.0, 3, 0.0, [0.5, 0.75]),
    (1.0, 3, -4.0, [0.5, 0.75]),
    (0.8, 3, 1e8, [32.0; 2]),
];

/// Runs a node at points of all settings and hands each result to a test, with the point in cells and the true points around.
fn each(
    id: &str,
    dimensions: usize,
    set: &[(&str, &[f32])],
    mut test: impl FnMut(&[f64], [f64; 3], &[Feature], String),
) {
    let node = Node::of(Node::new(id).def, halfvector_graph::value::Type::F32, true);
    for (jitter, metric, exponent, held) in SETTINGS {
        let rows: Vec<Vec<f32>> = (0..POINTS)
            .map(|i| {
                let mut row = node.row(set);
                let step = |k: f64| ((i as f64 + 0.5) * k).fract() as f32 * 6.0 - 3.0;
                let at = [step(0.754_877_67), step(0.569_840_29), step(0.819_172_5)];
                row[..dimensions].copy_from_slice(&at[..dimensions]);
                let named = [("scale", 2.0), ("jitter", jitter), ("metric", metric as f32), ("exponent", exponent)];
                for (name, value) in named {
                    let at = node.at(name);
                    row[at] = value;
                }
                let at = node.at("seed");
                row[at] = 7.0;
                row
            })
            .collect();
        for (row, found) in rows.iter().zip(node.call::<f32>(&rows)) {
            let p = std::array::from_fn(|i| if i < dimensions { 2.0 * f64::from(row[i]) } else { 0.0 });
            let truth = features(p, dimensions, f64::from(jitter), metric, held[dimensions - 2], 7);
            test(
                &found,
                p,
                &truth,
                format!("{id} by metric {metric}, {exponent}, jitter {jitter}, at {p:?}: {found:?}"),
            );
        }
    }
}

#[test]
fn voronoi_cells_are_those_of_the_metric() {
    for (id, dimensions) in [("procedural/voronoi_2d", 2), ("procedural/voronoi_3d", 3)] {
        let mut far = 0;
        each(id, dimensions, &[], |found, _, truth, what| {
            let [f1, f2] = [truth[0].d, truth[1].d].map(|d| d.min(2.0));
            assert!((found[0] - f1).abs() < 2e-5 && (found[1] - f2).abs() < 2e-5, "{what}, not {f1}, {f2}");
            far += usize::from(truth[0].d >= 2.0);
            // Where two points are as near, either may be the cell's.
            if truth[0].d < 1.999 && truth[1].d - truth[0].d > 1e-4 {
                assert!((found[2] - truth[0].id).abs() < 1e-6, "{what}, not of the value {}", truth[0].id);
                for (i, place) in found[3..].iter().enumerate() {
                    assert!((2.0 * place - truth[0].place[i]).abs() < 1e-5, "{what}, not at {:?}", truth[0].place);
                }
            }
        });
        println!("{id}: {far} of {} points lie beyond the reach", POINTS * SETTINGS.len());
        assert!(far * 50 < POINTS * SETTINGS.len(), "{id}: {far}");
    }
}

#[test]
fn smooth_voronoi_is_the_weighted_mean_of_all_points_around() {
    for (id, dimensions) in [("procedural/voronoi_smooth_2d", 2), ("procedural/voronoi_smooth_3d", 3)] {
        for smoothness in [0.0, 0.03, 0.4] {
            each(id, dimensions, &[("smoothness", &[smoothness])], |found, _, truth, what| {
                let s = f64::from(smoothness.max(1e-3));
                let near: Vec<_> = truth.iter().filter(|feature| feature.d < 2.0).collect();
                let weight = |f: &Feature| ((truth[0].d - f.d) / s).exp() * (1.0 - 0.25 * f.d * f.d).powi(2);
                let total: f64 = near.iter().map(|f| weight(f)).sum();
                if total < 1e-6 {
                    return;
                }
                let mean = |of: &dyn Fn(&Feature) -> f64| near.iter().map(|f| weight(f) * of(f)).sum::<f64>() / total;
                // A difference of two distances is right to 5e-7, and counts for its part of the smoothness.
                let tolerance = 2e-5 + 2e-6 / s;
                assert!((found[0] - mean(&|f| f.d)).abs() < tolerance, "{what}, not {}", mean(&|f| f.d));
                assert!((found[1] - mean(&|f| f.id)).abs() < tolerance, "{what}, not of {}", mean(&|f| f.id));
                for (i, place) in found[2..].iter().enumerate() {
                    let there = mean(&|f| f.place[i]);
                    assert!((2.0 * place - there).abs() < 4.0 * tolerance, "{what}, not at {there}");
                }
            });
        }
    }
}
