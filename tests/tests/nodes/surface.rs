//! Mixed surfaces: the function that mixes them mixes each member with its own, whatever their order.

use super::run::Node;

#[test]
fn each_parameter_is_mixed_with_its_own() {
    let node = Node::new("surface/mix");
    let names: Vec<String> = node.program.inputs().iter().map(|slot| slot.name.clone()).collect();
    let count = (names.len() - 1) / 2;
    let a: Vec<f32> = (0..count).map(|i| 0.01 * i as f32).collect();
    let b: Vec<f32> = (0..count).map(|i| 1.0 - 0.02 * i as f32).collect();
    for (t, held) in [(0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (-2.0, 0.0), (3.0, 1.0)] {
        let row: Vec<f32> = a.iter().chain(&b).copied().chain([t]).collect();
        let out = &node.call::<f64>(&[row])[0];
        assert_eq!(out.len(), count);
        let mixed: Vec<f64> =
            a.iter().zip(&b).map(|(a, b)| f64::from(*a) * (1.0 - held) + f64::from(*b) * held).collect();
        for i in 0..count {
            let name = names[i].split('.').nth(1).unwrap_or_default();
            let first = names.iter().position(|n| n.split('.').nth(1) == Some(name)).expect("a member");
            let size = if name.ends_with("normal") {
                mixed[first..first + 3].iter().map(|x| x * x).sum::<f64>().sqrt()
            } else {
                1.0
            };
            assert!((out[i] - mixed[i] / size).abs() < 1e-9, "{} at {t}: {} {}", names[i], out[i], mixed[i] / size);
        }
    }
}
