//! Terms of the BRDF: each form in f32 against the same form in f64, or against the exact form it stands for.

use crate::error::Errors;
use crate::timing::interleaved;
use crate::{Effort, Row};
use halfvector_brdf::fresnel::{f_dielectric, f_exact, f_schlick};

/// A form of the reflectance: f0, f90, l.h.
type Fresnel = fn([f32; 3], [f32; 3], f32) -> [f32; 3];

/// Measures the part.
pub fn rows(effort: Effort) -> Vec<Row> {
    fresnel(effort)
}

/// Fresnel of a dielectric of ior 1.5: the forms in f32 against Fresnel's equations in f64.
fn fresnel(effort: Effort) -> Vec<Row> {
    const DOMAIN: &str = "dielectric, ior 1.5, l.h evenly in 0..1; absolute error against Fresnel's equations in f64";
    let points = effort.pick(1 << 10, 1 << 14);
    let cosines: Vec<f32> = (0..points).map(|i| (i as f32 + 0.5) / points as f32).collect();
    let (f0, f90) = ([0.04f32; 3], [1.0f32; 3]);
    let forms: [(&str, Fresnel); 2] = [("schlick", f_schlick), ("exact", f_exact)];

    let mut runs: Vec<_> =
        forms.iter().map(|(_, form)| || cosines.iter().map(|&c| f64::from(form(f0, f90, c)[0])).sum::<f64>()).collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as &mut dyn FnMut() -> f64).collect();
    let seconds = interleaved(&mut candidates, effort.pick(20, 200));

    forms
        .iter()
        .zip(seconds)
        .map(|((name, form), seconds)| {
            let mut errors = Errors::default();
            for &cosine in &cosines {
                let truth = f_dielectric(1.5f64, f64::from(cosine));
                errors.add(f64::from(form(f0, f90, cosine)[0]) - truth, || format!("l.h = {cosine}"));
            }
            let mut row = Row::new("fresnel", name, DOMAIN);
            errors.fill(&mut row);
            row.cost_ns = Some(seconds * 1e9 / points as f64);
            row
        })
        .collect()
}
