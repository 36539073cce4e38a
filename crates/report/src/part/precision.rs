//! What a number format does to the hard cases: each form in f64, f32 and f16, on inputs at the ends of the library's domain:
//! grazing cosines, half vectors next to the normal, roughness from 0.0001 to 1.
//!
//! On the CPU. f16 is computed as a GPU with 16-bit arithmetic does it: each operation is rounded to f16. Errors are in units
//! in the last place of the format; what an input loses when it is stored in the format is not counted, because the truth
//! takes the stored input. A result that is infinite or NaN while the truth is in the format's range is counted apart.

use std::ops::{Add, Div, Mul, Neg, Sub};

use half::f16;
use halfvector_brdf::Real;
use halfvector_brdf::beckmann::{d_beckmann, v_smith_beckmann_correlated};
use halfvector_brdf::dfg::dfg_fit;
use halfvector_brdf::diffuse::{diffuse_burley, diffuse_eon};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_exact, f_f82_tint, f_schlick};
use halfvector_brdf::ggx::{d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::multiscatter::{energy_compensation, energy_compensation_fdez_aguera};
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::visibility::{v_hammon, v_kelemen, v_schlick_smith};

use crate::error::Errors;
use crate::{Effort, Row};

/// A number that every operation rounds to 16 bits.
#[derive(Clone, Copy, Debug)]
struct Half(f32);

impl Half {
    fn rounded(x: f32) -> Half {
        Half(f16::from_f32(x).to_f32())
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt),*) => {
        $(impl $trait for Half {
            type Output = Half;
            fn $method(self, other: Half) -> Half {
                Half::rounded(self.0 $operator other.0)
            }
        })*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Half {
    type Output = Half;
    fn neg(self) -> Half {
        Half(-self.0)
    }
}

impl Real for Half {
    type Mask = bool;
    const ZERO: Half = Half(0.0);
    const ONE: Half = Half(1.0);
    fn of(x: f64) -> Half {
        Half(f16::from_f64(x).to_f32())
    }
    fn sqrt(self) -> Half {
        Half::rounded(self.0.sqrt())
    }
    fn abs(self) -> Half {
        Half(self.0.abs())
    }
    fn exp2(self) -> Half {
        Half::rounded(self.0.exp2())
    }
    fn log2(self) -> Half {
        Half::rounded(self.0.log2())
    }
    fn acos(self) -> Half {
        Half::rounded(self.0.acos())
    }
    fn sin_cos(self) -> (Half, Half) {
        let (sine, cosine) = self.0.sin_cos();
        (Half::rounded(sine), Half::rounded(cosine))
    }
    fn max(self, other: Half) -> Half {
        Half(self.0.max(other.0))
    }
    fn min(self, other: Half) -> Half {
        Half(self.0.min(other.0))
    }
    fn lt(self, other: Half) -> bool {
        self.0 < other.0
    }
    fn le(self, other: Half) -> bool {
        self.0 <= other.0
    }
    fn choose(mask: bool, a: Half, b: Half) -> Half {
        if mask { a } else { b }
    }
    fn powf(self, power: Half) -> Half {
        Half::rounded(self.0.powf(power.0))
    }
}

/// A number format.
trait Format: Real {
    const NAME: &'static str;
    /// Bits behind the point, and the exponents of the smallest and largest normal number.
    const DIGITS: i32;
    const LEAST: i32;
    const MOST: i32;
    fn wide(self) -> f64;

    /// The distance of neighbouring numbers at `x`.
    fn ulp(x: f64) -> f64 {
        let exponent = if x == 0.0 { Self::LEAST } else { (x.abs().log2().floor() as i32).max(Self::LEAST) };
        2_f64.powi(exponent - Self::DIGITS)
    }
}

impl Format for f64 {
    const NAME: &'static str = "f64";
    const DIGITS: i32 = 52;
    const LEAST: i32 = -1022;
    const MOST: i32 = 1023;
    fn wide(self) -> f64 {
        self
    }
}

impl Format for f32 {
    const NAME: &'static str = "f32";
    const DIGITS: i32 = 23;
    const LEAST: i32 = -126;
    const MOST: i32 = 127;
    fn wide(self) -> f64 {
        f64::from(self)
    }
}

impl Format for Half {
    const NAME: &'static str = "f16";
    const DIGITS: i32 = 10;
    const LEAST: i32 = -14;
    const MOST: i32 = 15;
    fn wide(self) -> f64 {
        f64::from(self.0)
    }
}

/// A form in three formats; it takes up to four numbers.
struct Form {
    name: &'static str,
    inputs: fn() -> Vec<[f64; 4]>,
    double: fn([f64; 4]) -> f64,
    single: fn([f32; 4]) -> f32,
    half: fn([Half; 4]) -> Half,
}

macro_rules! form {
    ($name:literal, $inputs:ident, $arguments:pat => $value:expr) => {{
        fn value<R: Real>($arguments: [R; 4]) -> R {
            $value
        }
        Form { name: $name, inputs: $inputs, double: value::<f64>, single: value::<f32>, half: value::<Half> }
    }};
}

/// Cosines down to grazing, and roughness down to the floor of the library.
const COSINES: [f64; 9] = [1.0, 0.999_999, 0.99, 0.7, 0.3, 0.03, 1e-3, 1e-4, 1e-6];
const ROUGHNESS: [f64; 8] = [1.0, 0.7, 0.3, 0.089, 0.045, 0.02, 1e-3, 1e-4];

/// n.h, sin^2 and alpha: as far from the normal as the lobe is wide, and grazing.
fn half_vectors() -> Vec<[f64; 4]> {
    let sines = |alpha: f64| [0.0, 0.1 * alpha, alpha, (10.0 * alpha).min(1.0), 0.5, 1.0];
    let point = |roughness: f64| {
        let alpha = roughness * roughness;
        sines(alpha).map(|sine| [(1.0 - sine * sine).sqrt(), sine * sine, alpha, 0.0])
    };
    ROUGHNESS.into_iter().flat_map(point).collect()
}

/// n.v, n.l, l.h in one plane, and a roughness squared.
fn directions() -> Vec<[f64; 4]> {
    let mut points = Vec::new();
    for v in COSINES {
        for l in COSINES {
            for roughness in ROUGHNESS {
                let l_dot_v = v * l + ((1.0 - v * v) * (1.0 - l * l)).sqrt();
                points.push([v, l, (0.5 + 0.5 * l_dot_v).sqrt(), roughness * roughness]);
            }
        }
    }
    points
}

/// A cosine and a reflectance.
fn incidences() -> Vec<[f64; 4]> {
    let reflectances = [0.0, 1e-4, 0.02, 0.04, 0.5, 0.97, 1.0];
    COSINES.into_iter().flat_map(|c| reflectances.map(|f0| [c, f0, 0.0, 0.0])).collect()
}

/// A cosine and a perceptual roughness.
fn lobes() -> Vec<[f64; 4]> {
    COSINES.into_iter().flat_map(|c| ROUGHNESS.map(|roughness| [c, roughness, 0.0, 0.0])).collect()
}

/// A reflectance and the albedo of a white surface.
fn albedos() -> Vec<[f64; 4]> {
    let albedos = [1.0, 0.999, 0.9, 0.6, 0.4];
    [0.0, 0.04, 0.5, 0.97, 1.0].into_iter().flat_map(|f0| albedos.map(|albedo| [f0, albedo, 0.0, 0.0])).collect()
}

fn forms() -> Vec<Form> {
    vec![
        form!("d_ggx", half_vectors, [h, sin2, alpha, _] => d_ggx(h, sin2, alpha)),
        form!("d_beckmann", half_vectors, [h, sin2, alpha, _] => d_beckmann(h, sin2, alpha)),
        form!("d_charlie", half_vectors, [h, sin2, alpha, _] => d_charlie(h, sin2, alpha)),
        form!("v_smith_ggx_correlated", directions, [v, l, h, alpha] => v_smith_ggx_correlated(v, l, h, alpha)),
        form!("v_smith_ggx_separable", directions, [v, l, h, alpha] => v_smith_ggx_separable(v, l, h, alpha)),
        form!("v_hammon", directions, [v, l, h, alpha] => v_hammon(v, l, h, alpha)),
        form!("v_schlick_smith", directions, [v, l, h, alpha] => v_schlick_smith(v, l, h, alpha)),
        form!("v_kelemen", directions, [v, l, h, alpha] => v_kelemen(v, l, h, alpha)),
        form!("v_neubelt", directions, [v, l, h, alpha] => v_neubelt(v, l, h, alpha)),
        form!("v_smith_beckmann_correlated", directions, [v, l, h, a] => v_smith_beckmann_correlated(v, l, h, a)),
        form!("f_schlick", incidences, [c, f0, _, _] => f_schlick([f0; 3], [R::ONE; 3], c)[0]),
        form!("f_exact", incidences, [c, f0, _, _] => f_exact([f0; 3], [R::ONE; 3], c)[0]),
        form!("f_f82_tint", incidences, [c, f0, _, _] => f_f82_tint([f0; 3], [R::of(0.9); 3], c)[0]),
        form!("f_dielectric", incidences, [c, f0, _, _] => f_dielectric(R::ONE + f0 + f0, c)),
        form!("f_conductor", incidences, [c, f0, _, _] => f_conductor(R::of(0.05) + f0, R::of(4.0), c)),
        form!("diffuse_burley", directions, [v, l, h, r] => diffuse_burley([R::of(0.8); 3], v, l, h, r)[0]),
        form!("diffuse_eon", directions, [v, l, h, r] => diffuse_eon([R::of(0.8); 3], v, l, h, r)[0]),
        form!("dfg_fit", lobes, [v, r, _, _] => { let [a, b] = dfg_fit(v, r); a + b }),
        form!("energy_compensation", albedos, [f0, albedo, _, _] =>
            energy_compensation([f0; 3], [R::ONE; 3], [albedo, R::ZERO])[0]),
        form!("energy_compensation_fdez_aguera", albedos, [f0, albedo, _, _] =>
            energy_compensation_fdez_aguera([f0; 3], [R::ONE; 3], [albedo, R::ZERO])[0]),
    ]
}

/// Measures the part; the cases are the same for every effort.
pub fn rows(_: Effort) -> Vec<Row> {
    let all = |form: &Form| [row(form, form.double), row(form, form.single), row(form, form.half)];
    forms().iter().flat_map(all).collect()
}

fn row<F: Format>(form: &Form, value: fn([F; 4]) -> F) -> Row {
    let domain = format!(
        "{} on the CPU, hard cases: cosines from 1e-6, roughness from 0.0001; in ulp of {0} against the same form in f64 on \
         the inputs as stored",
        F::NAME
    );
    let mut row = Row::new("precision", &format!("{} {}", form.name, F::NAME), &domain);
    let (mut errors, mut failures) = (Errors::default(), 0);
    for x in (form.inputs)() {
        let stored = x.map(F::of);
        let (truth, found) = ((form.double)(stored.map(F::wide)), value(stored).wide());
        let representable = truth.is_finite() && truth.abs() < 2_f64.powi(F::MOST) * 1.99;
        if found.is_finite() && truth.is_finite() {
            errors.add((found - truth) / F::ulp(truth), || format!("{x:?}"));
        } else if representable {
            failures += 1;
            row.first_failure.get_or_insert_with(|| format!("{x:?}: {found}, not {truth:.4e}"));
        }
    }
    row.not_finite = Some(failures);
    errors.fill(&mut row);
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_of_neighbours() {
        assert_eq!(f32::ulp(1.0), f64::from(f32::EPSILON));
        assert_eq!(f32::ulp(0.0), f64::from(f32::from_bits(1)));
        assert_eq!(Half::ulp(1000.0), 0.5);
        assert_eq!((Half::of(0.1) * Half::of(3.0)).wide(), f64::from(f16::from_f32(f16::from_f32(0.1).to_f32() * 3.0)));
    }

    /// f32 never gives what is no number, f64 is the truth, and f16 loses what everybody knows that it loses: the peak of a
    /// narrow lobe.
    #[test]
    fn single_precision_keeps_to_numbers() {
        let rows = rows(Effort::Quick);
        let of = |name: &str| rows.iter().find(|row| row.method == name).expect("a row");
        for row in rows.iter().filter(|row| !row.method.ends_with("f16")) {
            assert_eq!(row.not_finite, Some(0), "{row:?}");
        }
        assert_eq!(of("d_ggx f64").error_max, Some(0.0));
        assert!(of("d_ggx f32").error_max < Some(8.0), "{:?}", of("d_ggx f32"));
        assert!(of("d_ggx f16").error_max > of("d_ggx f32").error_max);
    }
}
