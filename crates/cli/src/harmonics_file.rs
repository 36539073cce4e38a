//! Spherical harmonics as JSON, in the scales that programs expect.

use halfvector_ibl::BakedEnvironment;
use halfvector_ibl::sh::{ShOrder, ShWindow, cosine_factor, harmonic_constants};
use serde_json::{Map, Value, json};

/// The polynomials in their order.
const POLYNOMIALS: [&str; 16] = [
    "1",
    "y",
    "z",
    "x",
    "xy",
    "yz",
    "3z^2-1",
    "xz",
    "x^2-y^2",
    "y(3x^2-y^2)",
    "xyz",
    "y(5z^2-1)",
    "z(5z^2-3)",
    "x(5z^2-1)",
    "z(x^2-y^2)",
    "x(x^2-3y^2)",
];

/// Degree of each.
const DEGREE: [usize; 16] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3];

/// The text of the file.
pub(crate) fn text(baked: &BakedEnvironment) -> String {
    let constants = harmonic_constants();
    let irradiance: Vec<[f64; 3]> =
        (0..9).map(|k| baked.radiance_sh[k].map(|x| f64::from(x) * cosine_factor(DEGREE[k]))).collect();
    let folded: Vec<[f64; 3]> = irradiance.iter().zip(constants).map(|(row, c)| row.map(|x| x * c)).collect();
    let window = |order: ShOrder, degrees: usize| -> Vec<f64> {
        (0..=degrees).map(|degree| ShWindow::Hann.factor(degree, order)).collect()
    };
    let mut file = Map::new();
    let mut put = |key: &str, value: Value| file.insert(key.to_owned(), value);
    put("about", json!("rows are polynomials, columns linear Rec. 709 red, green, blue; right-handed, +Y up"));
    put("polynomials", json!(POLYNOMIALS));
    put("degree", json!(DEGREE));
    put("irradiance_over_pi_folded", json!(folded));
    put("irradiance_over_pi", json!(irradiance));
    put("radiance", json!(baked.radiance_sh));
    put("window_order_2", json!(window(ShOrder::Two, 2)));
    put("window_order_3", json!(window(ShOrder::Three, 3)));
    put(
        "use",
        json!(
            "irradiance / pi at the unit normal (x, y, z) is the sum of irradiance_over_pi_folded times the first nine \
             polynomials (the seven of degree 3 have no part in it); irradiance_over_pi and radiance are coefficients of the \
             orthonormal real harmonics, radiance up to degree 3; a window's numbers multiply the rows of each degree, rings \
             less and errs more"
        ),
    );
    format!("{:#}\n", Value::Object(file))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use halfvector_ibl::{BakeOptions, Equirect, bake};

    use super::*;

    /// White light: 1 from everywhere is sqrt(4 pi) times the first orthonormal harmonic.
    #[test]
    fn scales_agree() {
        let map = Equirect::from_fn(64, 32, |d| [1.0, (1.0 + 0.5 * d[2]) as f32, 0.0]);
        let options = BakeOptions { size: 4, levels: Some(1), irradiance_size: 1, ..BakeOptions::default() };
        let file: Value = serde_json::from_str(&text(&bake(&map.into(), &options))).expect("JSON");
        let number = |key: &str, k: usize, c: usize| file[key][k][c].as_f64().expect("a number");
        assert!((number("radiance", 0, 0) - (4.0 * PI).sqrt()).abs() < 1e-5);
        assert!((number("irradiance_over_pi_folded", 0, 0) - 1.0).abs() < 1e-6);
        // 1 + z/2 is seen by a white surface as 1 + z/3.
        assert!((number("irradiance_over_pi_folded", 2, 1) - 1.0 / 3.0).abs() < 1e-3);
        let ratio = number("irradiance_over_pi", 2, 1) / number("radiance", 2, 1);
        assert!((ratio - 2.0 / 3.0).abs() < 1e-6);
        assert_eq!(
            (file["polynomials"][7].clone(), file["radiance"].as_array().map(Vec::len)),
            (json!("xz"), Some(16))
        );
        assert_eq!(file["window_order_2"][2].as_f64().map(|x| (100.0 * x).round()), Some(25.0));
    }
}
