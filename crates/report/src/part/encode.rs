//! Where the display's coding is applied: what is written to a picture, against the sRGB coding of the whole product.

use halfvector_maps::color::{gamma_from_linear, srgb_from_linear};

use crate::search::CHEAP;
use crate::timing::{Candidate, measured};
use crate::{Effort, Row};

const DOMAIN: &str = "reflections 0..1 over albedos 0.04..1: what is written, 0..1; absolute error, against IEC 61966-2-1 of their product in f64";

/// What is written of a reflection and an albedo.
type Written = fn(f32, f32) -> f32;

/// One row for each method: coded at the end, or the reflection alone before it meets the albedo.
pub(super) fn rows(effort: Effort) -> Vec<Row> {
    const METHODS: [(&str, Written); 2] = [
        ("srgb", |reflection, albedo| srgb_from_linear([reflection * albedo; 3])[0]),
        ("report", |reflection, albedo| gamma_from_linear([reflection; 3])[0] * albedo),
    ];
    let side = effort.pick(32, 128);
    let place = |k: usize| (k as f64 + 0.5) / side as f64;
    let points: Vec<[f64; 2]> = (0..side * side).map(|k| [place(k % side), 0.04 + 0.96 * place(k / side)]).collect();
    let mut runs: Vec<_> = METHODS
        .iter()
        .map(|(_, written)| |_| points.iter().map(|&[r, a]| f64::from(written(r as f32, a as f32))).sum::<f64>())
        .collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 200));
    let row = |((name, written), time): (&(&str, Written), _)| {
        // Anywhere on the square that the grid covers.
        let reflection_and_albedo = |[x, y]: [f64; 2]| [x, 0.04 + 0.96 * y];
        let error = |place: [f64; 2]| {
            let [reflection, albedo] = reflection_and_albedo(place);
            let truth = srgb_from_linear([reflection * albedo; 3])[0];
            (f64::from(written(reflection as f32, albedo as f32)) - truth).abs()
        };
        let at = |place: [f64; 2]| {
            let [reflection, albedo] = reflection_and_albedo(place);
            format!("reflection = {reflection:?}, albedo = {albedo:?}")
        };
        let mut row = Row::new("encode", name, DOMAIN);
        let places = (0..side * side).map(|k| [place(k % side), place(k / side)]);
        CHEAP.errors(places, error, at).fill(&mut row);
        row.take_time(time, points.len());
        row
    };
    METHODS.iter().zip(times).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coding_before_the_albedo_is_seen() {
        let rows = rows(Effort::Quick);
        let rms = |name: &str| rows.iter().find(|row| row.method == name).and_then(|row| row.error_rms).expect("a row");
        assert!(rms("srgb") < 1e-6 && rms("report") > 0.05, "{rows:?}");
    }
}
