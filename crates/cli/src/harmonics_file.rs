//! Spherical harmonics as JSON, in the three scales that programs expect.

use std::f64::consts::PI;

use serde_json::{Map, Value, json};

/// The polynomials in their order.
const POLYNOMIALS: [&str; 9] = ["1", "y", "z", "x", "xy", "yz", "3z^2-1", "xz", "x^2-y^2"];

/// Degree of each.
const DEGREE: [usize; 9] = [0, 1, 1, 1, 2, 2, 2, 2, 2];

/// The text of the file. `folded` are coefficients of diffuse irradiance over pi with the constants of the basis folded in,
/// as `irradiance_sh2` takes them.
pub(crate) fn text(folded: &[[f32; 3]; 9]) -> String {
    // The orthonormal real harmonics are these times the polynomials; the cosine lobe multiplies each degree by these
    // (Ramamoorthi and Hanrahan 2001).
    let (first, second) = ((3.0 / (4.0 * PI)).sqrt(), (15.0 / (4.0 * PI)).sqrt());
    let constants = [
        (1.0 / (4.0 * PI)).sqrt(),
        first,
        first,
        first,
        second,
        second,
        (5.0 / (16.0 * PI)).sqrt(),
        second,
        (15.0 / (16.0 * PI)).sqrt(),
    ];
    let cosine = [1.0, 2.0 / 3.0, 0.25];
    let scaled = |factor: &dyn Fn(usize) -> f64| -> Vec<[f64; 3]> {
        (0..9).map(|k| folded[k].map(|x| f64::from(x) * factor(k))).collect()
    };
    let mut file = Map::new();
    let mut put = |key: &str, value: Value| file.insert(key.to_owned(), value);
    put("about", json!("rows are polynomials, columns linear Rec. 709 red, green, blue; right-handed, +Y up"));
    put("polynomials", json!(POLYNOMIALS));
    put("irradiance_over_pi_folded", json!(folded));
    put("irradiance_over_pi", json!(scaled(&|k| 1.0 / constants[k])));
    put("radiance", json!(scaled(&|k| 1.0 / (constants[k] * cosine[DEGREE[k]]))));
    put(
        "use",
        json!(
            "irradiance / pi at the unit normal (x, y, z) is the sum of irradiance_over_pi_folded times the polynomials; \
             the other two are coefficients of the orthonormal real harmonics"
        ),
    );
    format!("{:#}\n", Value::Object(file))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// White light: 1 from everywhere is sqrt(4 pi) times the first orthonormal harmonic.
    #[test]
    fn scales_agree() {
        let mut folded = [[0.0f32; 3]; 9];
        folded[0] = [1.0; 3];
        folded[2] = [0.0, 1.0, 0.0];
        let file: Value = serde_json::from_str(&text(&folded)).expect("JSON");
        let number = |key: &str, k: usize, c: usize| file[key][k][c].as_f64().expect("a number");
        assert!((number("radiance", 0, 1) - (4.0 * PI).sqrt()).abs() < 1e-12);
        assert_eq!(number("irradiance_over_pi_folded", 2, 1), 1.0);
        let ratio = number("irradiance_over_pi", 2, 1) / number("radiance", 2, 1);
        assert!((ratio - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(file["polynomials"][7], "xz");
    }
}
