//! Gabor noise has the spread, the wavelength and the direction that its help names.

use super::run::Node;

const POINTS: usize = 4000;

/// Mean of what a test makes of the outputs at a point, and at the same point moved, in cells.
fn mean(set: &[(&str, &[f32])], moved: [f32; 2], of: impl Fn(&[f64], &[f64]) -> f64) -> f64 {
    let node = Node::of(Node::new("procedural/gabor_noise").def, halfvector_graph::value::Type::F32, true);
    let rows = |moved: [f32; 2]| -> Vec<Vec<f32>> {
        let place = |i: usize, step: f64| ((i as f64 + 0.5) * step).fract() as f32 * 90.0;
        (0..POINTS)
            .map(|i| {
                let mut row = node.row(set);
                row[..2].copy_from_slice(&[place(i, 0.754_877_67) + moved[0], place(i, 0.569_840_29) + moved[1]]);
                let at = node.at("scale");
                row[at] = 1.0;
                row
            })
            .collect()
    };
    let (here, there) = (node.call::<f32>(&rows([0.0; 2])), node.call::<f32>(&rows(moved)));
    here.iter().zip(&there).map(|(a, b)| of(a, b)).sum::<f64>() / POINTS as f64
}

#[test]
fn gabor_noise_is_normalized() {
    for anisotropy in [0.0, 1.0] {
        let set: &[(&str, &[f32])] = &[("anisotropy", &[anisotropy])];
        let [value, square, phase, intensity] = [
            mean(set, [0.0; 2], |a, _| a[0]),
            mean(set, [0.0; 2], |a, _| a[0] * a[0]),
            mean(set, [0.0; 2], |a, _| a[1]),
            mean(set, [0.0; 2], |a, _| a[2]),
        ];
        println!("anisotropy {anisotropy}: {value:.4} {:.4} {phase:.4} {intensity:.4}", square.sqrt());
        assert!(value.abs() < 0.02 && (square.sqrt() - 1.0 / 3.0).abs() < 0.015, "{value} {}", square.sqrt());
        assert!((phase - 0.5).abs() < 0.02 && (intensity - 0.417_77).abs() < 0.02, "{phase} {intensity}");
    }
}

/// Half a wave on the sign turns, a whole one on it is back; along the crests it stays.
#[test]
fn gabor_noise_has_its_wavelength_and_its_direction() {
    for (orientation, along, across) in
        [(0.0, [0.25, 0.0], [0.0, 0.25]), (90.0, [0.0, -0.25], [0.25, 0.0]), (45.0, [0.177, -0.177], [0.177, 0.177])]
    {
        let set: &[(&str, &[f32])] = &[("orientation", &[orientation]), ("frequency", &[2.0])];
        let correlation = |moved: [f32; 2]| mean(set, moved, |a, b| 9.0 * a[0] * b[0]);
        let [half, whole, crest] = [correlation(along), correlation(along.map(|x: f32| 2.0 * x)), correlation(across)];
        println!("{orientation} degrees: {half:.3} {whole:.3} {crest:.3}");
        assert!(half < -0.7 && whole > 0.4 && crest > 0.7, "{orientation}: {half} {whole} {crest}");
        // On the way of the waves the phase grows by a half.
        let turned = mean(set, along, |a, b| f64::from(u8::from(((b[1] - a[1]).rem_euclid(1.0) - 0.5).abs() < 0.2)));
        assert!(turned > 0.8, "{orientation}: {turned}");
    }
}
