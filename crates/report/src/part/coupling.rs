//! What a dielectric interface leaves to the diffuse base under it, by method, against the coupling that neither gains nor loses
//! light and does not tell light from viewer.

use halfvector_brdf::albedo::directional_albedo_ggx;
use halfvector_brdf::coupling::{coupling_light, coupling_single};

use crate::error::Errors;
use crate::{Effort, Row};

const ROUGHNESS: [f64; 4] = [0.2, 0.4, 0.7, 1.0];
const N_DOT: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 1.0];
/// Reflectance of glass at normal incidence.
const F0: f64 = 0.04;
/// Points of the average albedo's integral.
const STEPS: usize = 64;

const DOMAIN: &str = "white Lambert under a dielectric of f0 0.04, n.v and n.l 0.1..1, roughness 0.2..1: the base's share of light; relative \
                      error against (1 - E(v)) (1 - E(l)) / (1 - E_avg) by quadrature";

/// One row for each method. The truth is Shirley, Smits, Hu, Lafortune 1997, "A Practitioners' Assessment of Light Reflection Models";
/// of a smooth interface it is what all bounces under it come to (Wolff 1994, "Diffuse-Reflectance Model for Smooth Dielectric
/// Surfaces"). What the methods cost is in the shader's instructions.
pub(super) fn rows(_: Effort) -> Vec<Row> {
    let mut errors: [Errors; 3] = std::array::from_fn(|_| Errors::default());
    for roughness in ROUGHNESS {
        let albedo = |cosine: f64| {
            let [a, b] = directional_albedo_ggx(cosine, roughness);
            F0 * a + b
        };
        let average = (0..STEPS).map(|k| (k as f64 + 0.5) / STEPS as f64).map(|x| 2.0 * x * albedo(x)).sum::<f64>()
            / STEPS as f64;
        for n_dot_v in N_DOT {
            let pair = directional_albedo_ggx(n_dot_v, roughness);
            let view = coupling_single(F0, 1.0, pair);
            for n_dot_l in N_DOT {
                let truth = (1.0 - albedo(n_dot_v)) * (1.0 - albedo(n_dot_l)) / (1.0 - average);
                let light = coupling_light(F0, 1.0, directional_albedo_ggx(n_dot_l, roughness), roughness);
                for (errors, found) in errors.iter_mut().zip([view, view * light, 1.0]) {
                    errors.add(found / truth - 1.0, || {
                        format!("n.v = {n_dot_v}, n.l = {n_dot_l}, roughness = {roughness}")
                    });
                }
            }
        }
    }
    let row = |(name, errors): (&str, Errors)| {
        let mut row = Row::new("coupling", name, DOMAIN);
        errors.fill(&mut row);
        row
    };
    ["view", "reciprocal", "none"].into_iter().zip(errors).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reciprocal one is the truth but for its fits; none is far off where the interface reflects most.
    #[test]
    fn the_reciprocal_coupling_errs_least() {
        let rows = rows(Effort::Quick);
        let rms = |name: &str| rows.iter().find(|row| row.method == name).and_then(|row| row.error_rms).expect("a row");
        assert!(rms("reciprocal") < 0.01, "{rows:?}");
        assert!(rms("reciprocal") < rms("view") && rms("view") < rms("none"), "{rows:?}");
    }
}
