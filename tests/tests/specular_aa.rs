//! Specular anti-aliasing, measured: the report's own figures, in full.

use halfvector_report::part::specular_aa::rows;
use halfvector_report::{Effort, Row, Run};

/// A turn of the normal within the pixel, as roughness, is nearer to the mean over the pixel than the normal at its middle alone.
#[test]
fn sharp_highlights_are_nearer_to_the_mean_over_the_pixel() {
    let rows = rows(&Run::alone(Effort::Full));
    assert_eq!(rows.len(), 18, "three methods on six things");
    println!("{:<40} {:>8} {:>8} {:>10}", "rms over mean", "none", "box", "tokuyoshi");
    let mut failed = Vec::new();
    for of_one in rows.chunks(3) {
        let error = |method: &str| {
            let row = of_one.iter().find(|row: &&Row| row.method == method).expect("a row");
            row.error_rms.expect("an error")
        };
        let [none, own, tokuyoshi] = ["none", "box", "tokuyoshi"].map(error);
        let (name, _) = of_one[0].domain.split_once(':').expect("what is drawn");
        println!("{name:<40} {none:>8.3} {own:>8.3} {tokuyoshi:>10.3}");
        if own > 0.8 * none {
            failed.push(format!("{name}: {own} instead of {none}"));
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
