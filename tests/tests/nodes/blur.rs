//! The blur of a picture is the Gaussian that its help names.

use super::run::Node;

/// The picture of the tests, which repeats: red, green, blue.
fn texel(x: i32, y: i32) -> [f64; 3] {
    let value = (8 * y.rem_euclid(8) + x.rem_euclid(8)) as f32 / 63.0;
    [value, (7.0 * value).fract(), (3.0 * value).fract()].map(f64::from)
}

/// A Gaussian over the texels, its variance in texels squared.
fn gaussian(uv: [f64; 2], variance: f64) -> [f64; 3] {
    let (mut total, mut weights) = ([0.0; 3], 0.0);
    for y in -16..24 {
        for x in -16..24 {
            let [dx, dy] = [f64::from(x) + 0.5 - 8.0 * uv[0], f64::from(y) + 0.5 - 8.0 * uv[1]];
            let weight = (-0.5 * (dx * dx + dy * dy) / variance).exp();
            let color = texel(x, y);
            (0..3).for_each(|i| total[i] += weight * color[i]);
            weights += weight;
        }
    }
    total.map(|x| x / weights)
}

#[test]
fn blurs_are_gaussian() {
    let node = Node::new("textures/blur");
    let places: Vec<[f32; 2]> = (0..40).map(|i| [0.037 * i as f32, 0.618 * i as f32].map(f32::fract)).collect();
    // A standard deviation of one texel: the reads' own spread, and the tent of linear filtering, 1/6.
    for (radius, variance) in [(0.25, 0.731 + 1.0 / 6.0), (0.2, 0.64 * 0.731 + 1.0 / 6.0)] {
        let rows: Vec<Vec<f32>> = places.iter().map(|uv| node.row(&[("uv", uv), ("radius", &[radius])])).collect();
        let mut mean = 0.0;
        for (uv, found) in places.iter().zip(node.call::<f32>(&rows)) {
            let truth = gaussian(uv.map(f64::from), variance);
            for i in 0..3 {
                // The tent's spread is 1/6 on the mean over places: 1/4 between texels, 0 in their middles.
                let error = (found[i] - truth[i]).abs();
                assert!(error < 0.03, "{radius} at {uv:?}: {found:?}, not {truth:?}");
                mean += error / (3.0 * places.len() as f64);
            }
        }
        println!("radius {radius}: off by {mean:.4} in the mean");
        assert!(mean < 0.008, "{radius}: {mean}");
    }
}

/// No radius, or less than none, is the picture as it is; the sum of the weights is 1.
#[test]
fn no_blur_is_the_picture() {
    let (node, plain) = (Node::new("textures/blur"), Node::new("textures/image_level"));
    for radius in [0.0, -1.0] {
        let uv: &[f32] = &[0.31, 0.77];
        let found = &node.call::<f32>(&[node.row(&[("uv", uv), ("radius", &[radius])])])[0];
        let truth = &plain.call::<f32>(&[plain.row(&[("uv", uv)])])[0];
        assert!(found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 3e-6), "{found:?}, not {truth:?}");
    }
}
