//! Noise of four numbers: 0 at lattice points, within its bounds, of even spread, smooth in each of them.

use super::run::Node;

#[test]
fn noise_of_four_numbers_is_gradient_noise() {
    let node = Node::of(Node::new("procedural/gradient_noise_4d").def, halfvector_graph::value::Type::F32, true);
    let at = |p: [f64; 4]| {
        let [x, y, z, w] = p.map(|x| x as f32);
        node.row(&[("position", &[x, y, z]), ("scale", &[1.0]), ("evolution", &[w])])
    };
    let lattice: Vec<_> = (0..16).map(|i| at([f64::from(i % 3), f64::from(i % 5) - 2.0, f64::from(i), 7.0])).collect();
    assert!(node.call::<f32>(&lattice).iter().all(|found| found[0].abs() < 1e-6));

    let place = |i: usize| {
        [0.754_877_67, 0.569_840_29, 0.819_172_5, 0.671_043_6].map(|k| ((i as f64 + 0.5) * k).fract() * 40.0)
    };
    let points: Vec<_> = (0..3000).map(|i| at(place(i))).collect();
    let found: Vec<f64> = node.call::<f64>(&points).iter().map(|row| row[0]).collect();
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    let spread = (found.iter().map(|x| x * x).sum::<f64>() / found.len() as f64).sqrt();
    println!("mean {mean:.4}, spread {spread:.4}");
    assert!(mean.abs() < 0.02 && (0.15..0.35).contains(&spread) && found.iter().all(|x| x.abs() <= 1.0));

    // A step of 1e-3 in any of the four changes little, and in each of them something.
    for axis in 0..4 {
        let moved: Vec<_> = (0..3000)
            .map(|i| {
                let mut p = place(i);
                p[axis] += 1e-3;
                at(p)
            })
            .collect();
        let steps = node.call::<f64>(&moved).iter().zip(&found).map(|(a, b)| (a[0] - b).abs()).collect::<Vec<_>>();
        let (greatest, mean) = (steps.iter().copied().fold(0.0, f64::max), steps.iter().sum::<f64>() / 3000.0);
        assert!(greatest < 4e-3 && mean > 2e-4, "axis {axis}: {greatest} {mean}");
    }
}
