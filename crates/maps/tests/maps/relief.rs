//! Height fields against true geometry: meshes moved by them, normals derived from them, and lines of sight into them.

use std::f64::consts::TAU;

use halfvector_maps::height::{displaced, normal_from_height};
use halfvector_maps::parallax::{parallax_occlusion, parallax_offset};

use crate::{cross, degrees_between, dot, length, unit};

/// The height field, 0..1, that repeats over the unit square: hills, and ripples on them.
fn field([x, y]: [f64; 2]) -> f64 {
    let hills = (2.0 * TAU * x).sin() * (TAU * y).cos();
    let ripples = (7.0 * TAU * (x + y)).sin();
    0.5 + 0.4 * hills + 0.1 * ripples
}

/// Its slopes by x and y.
fn slopes([x, y]: [f64; 2]) -> [f64; 2] {
    let ripples = 0.1 * 7.0 * TAU * (7.0 * TAU * (x + y)).cos();
    [
        0.4 * 2.0 * TAU * (2.0 * TAU * x).cos() * (TAU * y).cos() + ripples,
        -0.4 * TAU * (2.0 * TAU * x).sin() * (TAU * y).sin() + ripples,
    ]
}

/// Height of the field between black and white, and the value that stays where it is.
const SCALE: f64 = 0.05;
const LEVEL: f64 = 0.5;

/// The true normal of the moved plane at p.
fn true_normal(p: [f64; 2]) -> [f64; 3] {
    let [a, b] = slopes(p).map(|s| s * SCALE);
    unit([-a, -b, 1.0])
}

/// The moved vertex over p, on the plane z = 0.
fn vertex(p: [f64; 2]) -> [f64; 3] {
    displaced([p[0], p[1], 0.0], [0.0, 0.0, 1.0], (field(p) - LEVEL) * SCALE)
}

/// What a mesh of n x n squares over the field is off by: the most that its surface, and so its silhouette, lies beside
/// the true one, and the mean and largest angle of its faces' normals to the true ones.
fn mesh_errors(n: usize) -> (f64, f64, f64) {
    let (mut distance, mut sum, mut max, mut count) = (0.0_f64, 0.0, 0.0_f64, 0.0);
    let step = 1.0 / n as f64;
    for i in 0..n {
        for j in 0..n {
            let corner = |a: usize, b: usize| vertex([(i + a) as f64 * step, (j + b) as f64 * step]);
            for [a, b, c] in [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]] {
                let side = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| q[k] - p[k]);
                let facet = cross(side(a, b), side(a, c));
                for [u, v] in [[1.0 / 3.0, 1.0 / 3.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]] {
                    let p = [0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v);
                    let over = [p[0], p[1]];
                    // Across the surface, not upwards.
                    distance = distance.max((p[2] - vertex(over)[2]).abs() * true_normal(over)[2]);
                    let angle = degrees_between(facet, true_normal(over));
                    (sum, max, count) = (sum + angle, max.max(angle), count + 1.0);
                }
            }
        }
    }
    (distance, sum / count, max)
}

/// A mesh of n^2 squares is within its chords' sagitta of the true surface: a quarter for twice the squares.
#[test]
fn a_finer_mesh_nears_the_true_surface() {
    println!(
        "| squares a side | surface beside the truth, share of its height | facets' normals, mean / max deg |\n|---|---|---|"
    );
    let mut before = f64::INFINITY;
    for n in [32, 64, 128, 256] {
        let (distance, mean, max) = mesh_errors(n);
        println!("| {n} | {:.5} | {mean:.2} / {max:.2} |", distance / SCALE);
        assert!(distance < before / 3.0, "{n}: {distance} after {before}");
        before = distance;
    }
    assert!(before < 3e-3 * SCALE);
}

/// Shading normals of the moved plane: the report keeps the old one, the derived one nears the truth with the pixel.
#[test]
fn derived_normals_near_the_truth() {
    let points = || (0..64).flat_map(|i| (0..64).map(move |j| [i, j].map(|k| (f64::from(k) + 0.37) / 64.0)));
    let error = |normal: &dyn Fn([f64; 2]) -> [f64; 3]| {
        let angles: Vec<f64> = points().map(|p| degrees_between(normal(p), true_normal(p))).collect();
        (angles.iter().sum::<f64>() / angles.len() as f64, angles.iter().copied().fold(0.0, f64::max))
    };
    let old = error(&|_| [0.0, 0.0, 1.0]);
    println!(
        "| normal of the moved plane | mean / max deg |\n|---|---|\n| `report`: the old one | {:.2} / {:.2} |",
        old.0, old.1
    );
    assert!(old.0 > 8.0 && old.1 > 20.0);
    let mut before = f64::INFINITY;
    for pixels in [256.0, 512.0, 1024.0] {
        // Differences to the next pixel, as a GPU takes them, seen askew.
        let (x, y) = ([1.0 / pixels, 0.2 / pixels], [-0.3 / pixels, 1.5 / pixels]);
        let derived = error(&|p| {
            let ahead = |d: [f64; 2]| SCALE * (field([p[0] + d[0], p[1] + d[1]]) - field(p));
            normal_from_height([x[0], x[1], 0.0], [y[0], y[1], 0.0], [0.0, 0.0, 1.0], ahead(x), ahead(y))
        });
        println!("| `derived`, {pixels} pixels over it | {:.2} / {:.2} |", derived.0, derived.1);
        assert!(derived.1 < 0.6 * before);
        before = derived.1;
    }
    assert!(before < 0.6);
}

/// On a sphere slopes lie further out than the sphere: steps of the displaced position know it, those of the sphere's own are
/// right for low relief.
#[test]
fn derived_normals_on_a_sphere() {
    let height = |n: [f64; 3], scale: f64| scale * (9.0 * n[0]).sin() * (7.0 * n[1] + 1.0).cos();
    for (scale, of_the_sphere) in [(0.01, 0.02..0.03), (0.03, 0.2..0.25), (0.1, 1.9..2.2), (0.2, 5.3..6.0)] {
        let point = |n: [f64; 3]| displaced(n, n, height(n, scale));
        let (mut max, mut before) = (0.0_f64, 0.0_f64);
        for i in 0..2000 {
            let z = 1.0 - (f64::from(i) + 0.5) / 1000.0;
            let (s, c) = (f64::from(i) * 2.399_963).sin_cos();
            let sine = (1.0 - z * z).sqrt();
            let n = [sine * c, sine * s, z];
            let t = unit(cross(n, if z.abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] }));
            let b = cross(n, t);
            const STEP: f64 = 1e-5;
            let moved = |d: [f64; 3], by: f64| unit([0, 1, 2].map(|k| n[k] + by * d[k]));
            let between = |d: [f64; 3]| {
                let (p, q) = (point(moved(d, STEP)), point(moved(d, -STEP)));
                [0, 1, 2].map(|k| p[k] - q[k])
            };
            let truth = cross(between(t), between(b));
            let along = |d: [f64; 3]| height(moved(d, STEP), scale) - height(moved(d, -STEP), scale);
            let derived = normal_from_height(between(t), between(b), n, along(t), along(b));
            max = max.max(degrees_between(derived, truth));
            let derived =
                normal_from_height(t.map(|x| 2.0 * STEP * x), b.map(|x| 2.0 * STEP * x), n, along(t), along(b));
            before = before.max(degrees_between(derived, truth));
        }
        println!(
            "sphere of radius 1, relief of {scale}: within {max:.1e} degrees by steps of the displaced place, {before:.3} by the \
             sphere's"
        );
        assert!(max < 1e-3 && of_the_sphere.contains(&before), "{scale}: {max} {before}");
    }
}

/// Where the line of sight truly meets the field, by steps a hundredth as long, in units of the way.
fn traced(uv: [f64; 2], offset: [f64; 2]) -> [f64; 2] {
    let at = |t: f64| [uv[0] + offset[0] * t, uv[1] + offset[1] * t];
    let above = |t: f64| 1.0 - t - field(at(t));
    let steps = 3200;
    let hit = (0..=steps).map(|k| f64::from(k) / f64::from(steps)).find(|&t| above(t) <= 0.0).unwrap_or(1.0);
    let (mut low, mut high) = ((hit - 1.0 / f64::from(steps)).max(0.0), hit);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if above(middle) > 0.0 { low = middle } else { high = middle }
    }
    at(high)
}

/// The distance of parallax occlusion from the true place on the relief, in units of the picture's edge, beside that of
/// one step along the way ("parallax mapping") and of none.
#[test]
fn parallax_finds_the_true_place() {
    const DEPTH: f64 = 0.1;
    println!("| view from the normal | none, mean | one step, mean | occlusion, mean | occlusion, within 1/512 |");
    println!("|---|---|---|---|---|");
    for (angle, most_mean, least_close) in
        [(0.0, 1e-12, 1.0), (30.0, 1e-4, 1.0), (60.0, 3e-4, 0.998), (75.0, 2e-3, 0.98)]
    {
        let (s, c) = f64::to_radians(angle).sin_cos();
        let [mut none, mut one, mut occlusion, mut close, mut count] = [0.0; 5];
        for i in 0..40 {
            for j in 0..40 {
                let uv = [i, j].map(|k| (f64::from(k) + 0.21) / 40.0);
                let azimuth = f64::from(i * 7 + j * 3);
                let view = [s * azimuth.cos(), s * azimuth.sin(), c];
                let offset = parallax_offset(view, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], DEPTH);
                let truth = traced(uv, offset);
                let off = |p: [f64; 2]| (p[0] - truth[0]).hypot(p[1] - truth[1]);
                let step = 1.0 - field(uv);
                none += off(uv);
                one += off([uv[0] + offset[0] * step, uv[1] + offset[1] * step]);
                let found = off(parallax_occlusion(field, uv, offset));
                occlusion += found;
                close += f64::from(u8::from(found < 1.0 / 512.0));
                count += 1.0;
            }
        }
        let [none, one, occlusion, close] = [none, one, occlusion, close].map(|x| x / count);
        println!("| {angle} | {none:.5} | {one:.5} | {occlusion:.6} | {:.2} % |", close * 100.0);
        assert!(occlusion <= most_mean && close >= least_close, "{angle}: {occlusion} {close}");
        assert!(angle == 0.0 || occlusion < 0.2 * one);
    }
}

/// The way into the relief goes where the line of sight goes on the true plane: the point at the floor seen through uv.
#[test]
fn the_way_is_the_line_of_sight() {
    let (normal, tangent) = ([0.6, 0.0, 0.8], [0.8, 0.0, -0.6]);
    for w in [1.0, -1.0] {
        let bitangent = cross(normal, tangent).map(|x| w * x);
        let view = unit([0.5, 0.4, 0.9]);
        let [x, y, z] = tangent;
        let depth = 0.07;
        let [u, v] = parallax_offset(view, normal, [x, y, z, w], depth);
        // From the mesh to the floor along -view, in the plane's own coordinates; v runs against the bitangent.
        let reach = depth / dot(view, normal);
        let floor = [0, 1, 2].map(|k| -reach * view[k] + depth * normal[k]);
        assert!((u - dot(floor, tangent)).abs() < 1e-12 && (v + dot(floor, bitangent)).abs() < 1e-12);
        assert!(length(floor) > 0.01);
    }
    // From the floor up, along the surface, with no tangent, of no numbers: finite, and never far.
    for view in [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0; 3], [f64::NAN; 3]] {
        for tangent in [[1.0, 0.0, 0.0, 1.0], [0.0; 4], [0.0, 0.0, 1.0, -1.0], [f64::NAN; 4]] {
            let offset = parallax_offset(view, [0.0, 0.0, 1.0], tangent, 0.1);
            assert!(offset[0].hypot(offset[1]) <= 2.0 + 1e-12, "{view:?} {tangent:?}: {offset:?}");
        }
    }
    // Nothing is moved on a white field, and a black or broken one is seen at the floor.
    assert_eq!(parallax_occlusion(|_| 1.0, [0.25, 0.5], [0.5, 0.25]), [0.25, 0.5]);
    for floor in [0.0, f64::NAN] {
        let [u, v] = parallax_occlusion(|_| floor, [0.25, 0.5], [0.5, 0.25]);
        assert!((u - 0.75).abs() < 1e-9 && (v - 0.75).abs() < 1e-9 || floor.is_nan() && u.is_finite() && v.is_finite());
    }
}
