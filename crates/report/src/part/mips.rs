//! Smaller levels of normal maps: each rule that turns the normals' spread into roughness, against the mean of the fine
//! level's lobes.

use crate::error::Errors;
use crate::timing::{Candidate, Time, measured};
use crate::{Row, Run};
use halfvector_maps::lost_length::{Rule, Spread, lobe_error};

/// Texels along the side of a footprint: three levels.
const SIDE: usize = 8;

/// A rule by name: the alpha that a footprint of this spread has.
type Method = (&'static str, Box<dyn Fn(f64, Spread) -> f64>);

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let effort = run.effort();
    const DOMAIN: &str = "footprints of 8 x 8 normals (noise, waves, pyramids; slopes 0.05..0.5), roughness 0.3, 0.5, 0.7; \
                          half the integral of |one lobe - mean of the fine lobes|, 0..1";
    let methods: Vec<Method> =
        std::iter::once(("unchanged", Box::new(|alpha, _| alpha) as Box<dyn Fn(f64, Spread) -> f64>))
            .chain(Rule::ALL.map(|rule| (rule.name(), Box::new(move |a, s| rule.alpha(a, s)) as _)))
            .collect();
    let spread = |i: usize| {
        let t = (i as f64 + 0.5) / 256.0;
        Spread { mean_length: 1.0 - 0.5 * t, slope_variance: t }
    };
    let mut runs: Vec<_> =
        methods.iter().map(|(_, rule)| |_| (0..256).map(|i| rule(0.2, spread(i))).sum::<f64>()).collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 200));

    let cells = effort.pick(48, 128);
    let surfaces = surfaces();
    let row = |((name, rule), time): (&Method, Time)| {
        let mut errors = Errors::default();
        for (surface, normals) in &surfaces {
            for roughness in [0.3_f64, 0.5, 0.7] {
                let alpha = roughness * roughness;
                let error = lobe_error(normals, alpha, rule(alpha, Spread::of(normals)), cells);
                errors.add(error, || format!("surface = {surface}, roughness = {roughness}"));
            }
        }
        let mut row = Row::new("normal_mips", name, DOMAIN);
        errors.fill(&mut row);
        row.take_time(time, 256);
        row
    };
    let timed: Vec<(&Method, Time)> = methods.iter().zip(times).collect();
    run.pieces(&timed, |&method| vec![row(method)])
}

/// Footprints of made surfaces, by name.
fn surfaces() -> Vec<(String, Vec<[f64; 3]>)> {
    let mut state = 1_u64;
    let mut number = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    // Twelve uniform numbers less 6 are nearly normally distributed.
    let mut gaussian = move || (0..12).map(|_| number()).sum::<f64>() - 6.0;
    let mut patches: Vec<(String, Vec<[f64; 3]>)> = Vec::new();
    for deviation in [0.05, 0.2, 0.5] {
        let normals = (0..SIDE * SIDE).map(|_| normal([deviation * gaussian(), deviation * gaussian()])).collect();
        patches.push((format!("noise of slope {deviation}"), normals));
    }
    let patch = |slopes: &dyn Fn(f64, f64) -> [f64; 2]| {
        (0..SIDE * SIDE).map(|i| normal(slopes((i % SIDE) as f64, (i / SIDE) as f64))).collect()
    };
    let wave = |t: f64| 0.3 * (t * std::f64::consts::TAU / SIDE as f64).cos();
    let face = |t: f64| if t < SIDE as f64 / 2.0 { 0.5 } else { -0.5 };
    patches.push(("waves of slope 0.3".to_owned(), patch(&|x, y| [wave(x), wave(y)])));
    patches.push(("a pyramid of slope 0.5".to_owned(), patch(&|x, y| [face(x), face(y)])));
    patches
}

/// The unit normal of slopes x/z and y/z.
fn normal([a, b]: [f64; 2]) -> [f64; 3] {
    let scale = 1.0 / (a * a + b * b + 1.0).sqrt();
    [a * scale, b * scale, scale]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every rule is better than leaving the roughness as it is, and the default has the least error.
    #[test]
    fn the_default_is_the_best() {
        let rows = rows(&Run::alone(crate::Effort::Quick));
        let error = |method: &str| rows.iter().find(|row| row.method == method).and_then(|row| row.error_rms);
        let default = error(Rule::default().name());
        assert!(rows.iter().all(|row| row.error_rms >= default), "{rows:?}");
        assert!(Rule::ALL.iter().all(|rule| error(rule.name()) < error("unchanged")), "{rows:?}");
    }
}
