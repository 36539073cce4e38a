//! What a number format does to the hard cases: each form in f64, f32 and f16, on inputs at the ends of the library's domain:
//! grazing cosines, half vectors next to the normal, roughness from 0.0001 to 1.
//!
//! On the CPU, and by the WGSL on the device where there is one. On the CPU f16 is computed as a GPU with 16-bit arithmetic does
//! it: each operation is rounded to f16. Errors are in units
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

use halfvector_render::Renderer;
use halfvector_render::function::{Number, library};

use super::stations::NO_DEVICE;
use crate::error::{Errors, named};
use crate::missing::DEVICE;
use crate::{Row, Run};

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

/// A form in three formats, by the name that it has in Rust and in WGSL.
struct Form {
    name: &'static str,
    /// The arguments of each call, as the WGSL function takes them.
    inputs: fn() -> Vec<Vec<f64>>,
    /// Their names, and how many numbers each has.
    names: Names,
    double: fn(&[f64]) -> f64,
    single: fn(&[f32]) -> f32,
    half: fn(&[Half]) -> Half,
    /// How many of the WGSL function's numbers are added to give the form's.
    parts: usize,
}

macro_rules! form {
    ($name:ident, $inputs:ident $names:ident, $a:ident => $value:expr) => {
        form!($name, 1, $inputs $names, $a => $value)
    };
    ($name:ident, $parts:literal, $inputs:ident $names:ident, $a:ident => $value:expr) => {{
        fn value<R: Real>($a: &[R]) -> R {
            $value
        }
        let name = stringify!($name);
        Form { name, inputs: $inputs, names: $names, double: value::<f64>, single: value::<f32>, half: value::<Half>, parts: $parts }
    }};
}

/// Names of arguments, and how many numbers each has.
type Names = &'static [(&'static str, usize)];

const HALF_VECTOR: Names = &[("n.h", 1), ("1 - n.h^2", 1), ("alpha", 1)];
const DIRECTIONS: Names = &[("n.v", 1), ("n.l", 1), ("l.h", 1), ("alpha", 1)];
const LIT_DIRECTIONS: Names = &[("albedo", 3), ("n.v", 1), ("n.l", 1), ("l.h", 1), ("roughness", 1)];
const INCIDENCE: Names = &[("f0", 3), ("f90", 3), ("l.h", 1)];
const TINTED_INCIDENCE: Names = &[("f0", 3), ("tint", 3), ("l.h", 1)];
const INTERFACE: Names = &[("ior", 1), ("l.h", 1)];
const METAL: Names = &[("eta", 1), ("k", 1), ("l.h", 1)];
const LOBE: Names = &[("n.v", 1), ("roughness", 1)];
const ALBEDO: Names = &[("f0", 3), ("f90", 3), ("a", 1), ("b", 1)];

/// Cosines down to grazing, and roughness down to the floor of the library.
const COSINES: [f64; 9] = [1.0, 0.999_999, 0.99, 0.7, 0.3, 0.03, 1e-3, 1e-4, 1e-6];
const ROUGHNESS: [f64; 8] = [1.0, 0.7, 0.3, 0.089, 0.045, 0.02, 1e-3, 1e-4];

/// n.h, sin^2 and alpha: as far from the normal as the lobe is wide, and grazing.
fn half_vectors() -> Vec<Vec<f64>> {
    let sines = |alpha: f64| [0.0, 0.1 * alpha, alpha, (10.0 * alpha).min(1.0), 0.5, 1.0];
    let point = |roughness: f64| {
        let alpha = roughness * roughness;
        sines(alpha).map(|sine| vec![(1.0 - sine * sine).sqrt(), sine * sine, alpha])
    };
    ROUGHNESS.into_iter().flat_map(point).collect()
}

/// n.v, n.l, l.h in one plane, and a roughness squared.
fn directions() -> Vec<Vec<f64>> {
    let mut points = Vec::new();
    for v in COSINES {
        for l in COSINES {
            for roughness in ROUGHNESS {
                let l_dot_v = v * l + ((1.0 - v * v) * (1.0 - l * l)).sqrt();
                points.push(vec![v, l, (0.5 + 0.5 * l_dot_v).sqrt(), roughness * roughness]);
            }
        }
    }
    points
}

/// An albedo, and the directions.
fn lit_directions() -> Vec<Vec<f64>> {
    directions().into_iter().map(|point| [&[0.8; 3][..], &point].concat()).collect()
}

/// Reflectances at normal incidence.
const REFLECTANCES: [f64; 7] = [0.0, 1e-4, 0.02, 0.04, 0.5, 0.97, 1.0];

/// f0, f90 and a cosine.
fn incidences() -> Vec<Vec<f64>> {
    let with = |c: f64| REFLECTANCES.map(|f0| vec![f0, f0, f0, 1.0, 1.0, 1.0, c]);
    COSINES.into_iter().flat_map(with).collect()
}

/// f0, a tint and a cosine.
fn tinted_incidences() -> Vec<Vec<f64>> {
    let with = |c: f64| REFLECTANCES.map(|f0| vec![f0, f0, f0, 0.9, 0.9, 0.9, c]);
    COSINES.into_iter().flat_map(with).collect()
}

/// A ratio of refractive indices from 1 to 3, and a cosine.
fn interfaces() -> Vec<Vec<f64>> {
    COSINES.into_iter().flat_map(|c| REFLECTANCES.map(|x| vec![1.0 + 2.0 * x, c])).collect()
}

/// A refractive index, an extinction and a cosine.
fn metals() -> Vec<Vec<f64>> {
    COSINES.into_iter().flat_map(|c| REFLECTANCES.map(|x| vec![0.05 + x, 4.0, c])).collect()
}

/// A cosine and a perceptual roughness.
fn lobes() -> Vec<Vec<f64>> {
    COSINES.into_iter().flat_map(|c| ROUGHNESS.map(|roughness| vec![c, roughness])).collect()
}

/// f0, f90 and the albedo of a white surface.
fn albedos() -> Vec<Vec<f64>> {
    let albedos = [1.0, 0.999, 0.9, 0.6, 0.4];
    let with = |f0: f64| albedos.map(|albedo| vec![f0, f0, f0, 1.0, 1.0, 1.0, albedo, 0.0]);
    [0.0, 0.04, 0.5, 0.97, 1.0].into_iter().flat_map(with).collect()
}

/// Three of the arguments.
fn rgb<R: Copy>(arguments: &[R], first: usize) -> [R; 3] {
    [arguments[first], arguments[first + 1], arguments[first + 2]]
}

fn forms() -> Vec<Form> {
    vec![
        form!(d_ggx, half_vectors HALF_VECTOR, a => d_ggx(a[0], a[1], a[2])),
        form!(d_beckmann, half_vectors HALF_VECTOR, a => d_beckmann(a[0], a[1], a[2])),
        form!(d_charlie, half_vectors HALF_VECTOR, a => d_charlie(a[0], a[1], a[2])),
        form!(v_smith_ggx_correlated, directions DIRECTIONS, a => v_smith_ggx_correlated(a[0], a[1], a[2], a[3])),
        form!(v_smith_ggx_separable, directions DIRECTIONS, a => v_smith_ggx_separable(a[0], a[1], a[2], a[3])),
        form!(v_hammon, directions DIRECTIONS, a => v_hammon(a[0], a[1], a[2], a[3])),
        form!(v_schlick_smith, directions DIRECTIONS, a => v_schlick_smith(a[0], a[1], a[2], a[3])),
        form!(v_kelemen, directions DIRECTIONS, a => v_kelemen(a[0], a[1], a[2], a[3])),
        form!(v_neubelt, directions DIRECTIONS, a => v_neubelt(a[0], a[1], a[2], a[3])),
        form!(v_smith_beckmann_correlated, directions DIRECTIONS, a => v_smith_beckmann_correlated(a[0], a[1], a[2], a[3])),
        form!(f_schlick, incidences INCIDENCE, a => f_schlick(rgb(a, 0), rgb(a, 3), a[6])[0]),
        form!(f_exact, incidences INCIDENCE, a => f_exact(rgb(a, 0), rgb(a, 3), a[6])[0]),
        form!(f_f82_tint, tinted_incidences TINTED_INCIDENCE, a => f_f82_tint(rgb(a, 0), rgb(a, 3), a[6])[0]),
        form!(f_dielectric, interfaces INTERFACE, a => f_dielectric(a[0], a[1])),
        form!(f_conductor, metals METAL, a => f_conductor(a[0], a[1], a[2])),
        form!(diffuse_burley, lit_directions LIT_DIRECTIONS, a => diffuse_burley(rgb(a, 0), a[3], a[4], a[5], a[6])[0]),
        form!(diffuse_eon, lit_directions LIT_DIRECTIONS, a => diffuse_eon(rgb(a, 0), a[3], a[4], a[5], a[6])[0]),
        form!(dfg_fit, 2, lobes LOBE, a => { let [f0, f90] = dfg_fit(a[0], a[1]); f0 + f90 }),
        form!(energy_compensation, albedos ALBEDO, a => energy_compensation(rgb(a, 0), rgb(a, 3), [a[6], a[7]])[0]),
        form!(energy_compensation_fdez_aguera, albedos ALBEDO, a =>
            energy_compensation_fdez_aguera(rgb(a, 0), rgb(a, 3), [a[6], a[7]])[0]),
    ]
}

/// Measures the part; the cases are the same for every effort.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let forms = forms();
    let mut rows: Vec<Row> = forms.iter().flat_map(on_cpu).collect();
    run.keep(&rows, 0.2);
    let (renderer, library) = match (Renderer::new(), library()) {
        (Ok(renderer), Ok(library)) => (renderer, library),
        (Err(_), _) => {
            run.leave_out("precision", Some(DEVICE), NO_DEVICE.to_owned());
            return rows;
        }
        (_, Err(error)) => {
            run.leave_out("precision", Some(DEVICE), format!("the library of shaders cannot be called: {error}"));
            return rows;
        }
    };
    for (done, form) in forms.iter().enumerate() {
        rows.extend(on_device(form, &renderer, &library));
        run.keep(&rows, 0.2 + 0.8 * (done + 1) as f64 / forms.len() as f64);
    }
    rows
}

/// A form by Rust, in three formats.
fn on_cpu(form: &Form) -> [Row; 3] {
    fn row<F: Format>(form: &Form, value: fn(&[F]) -> F) -> Row {
        let stored: Vec<Vec<F>> =
            (form.inputs)().iter().map(|input| input.iter().map(|&x| F::of(x)).collect()).collect();
        let found: Vec<f64> = stored.iter().map(|input| value(input).wide()).collect();
        let wide: Vec<Vec<f64>> = stored.iter().map(|input| input.iter().map(|x| x.wide()).collect()).collect();
        judged::<F>(form, F::NAME, "on the CPU", &wide, &found)
    }
    [row(form, form.double), row(form, form.single), row(form, form.half)]
}

/// A form by the WGSL of its name on the device, in the formats that the device has.
fn on_device(form: &Form, renderer: &Renderer, library: &naga::Module) -> Vec<Row> {
    fn row<N: Number, F: Format>(form: &Form, renderer: &Renderer, library: &naga::Module) -> Option<Row> {
        // As the device stores them; the second call of the last input is for the even number that a buffer of f16 needs.
        let mut inputs: Vec<Vec<f32>> =
            (form.inputs)().iter().map(|input| input.iter().map(|&x| x as f32).collect()).collect();
        inputs.extend(inputs.last().cloned());
        inputs.truncate(inputs.len() / 2 * 2);
        let results = renderer.call::<N>(library, form.name, &inputs.concat()).ok()?;
        let found: Vec<f64> =
            results.values.chunks_exact(results.results).map(|value| value[..form.parts].iter().sum()).collect();
        let stored = |input: &Vec<f32>| input.iter().map(|&x| N::from_f32(x).to_f64()).collect();
        let wide: Vec<Vec<f64>> = inputs.iter().map(stored).collect();
        let name = format!("{} device", F::NAME);
        let mut row = judged::<F>(form, &name, "on the device", &wide, &found);
        row.gpu = Some(renderer.adapter().to_owned());
        Some(row)
    }
    let rows = [
        row::<f64, f64>(form, renderer, library),
        row::<f32, f32>(form, renderer, library),
        row::<f16, Half>(form, renderer, library),
    ];
    rows.into_iter().flatten().collect()
}

/// What was found for each stored input, against the form in f64.
fn judged<F: Format>(form: &Form, name: &str, place: &str, stored: &[Vec<f64>], found: &[f64]) -> Row {
    let domain = format!(
        "{} {place}, hard cases: cosines from 1e-6, roughness from 0.0001; in ulp of {0} against the same form in f64 on the \
         inputs as stored",
        F::NAME
    );
    let mut row = Row::new("precision", &format!("{} {name}", form.name), &domain);
    let (mut errors, mut failures) = (Errors::default(), 0);
    for (x, &found) in stored.iter().zip(found) {
        let truth = (form.double)(x);
        let representable = truth.is_finite() && truth.abs() < 2_f64.powi(F::MOST) * 1.99;
        if found.is_finite() && truth.is_finite() {
            errors.add((found - truth) / F::ulp(truth), || named(form.names, x));
        } else if representable {
            failures += 1;
            row.first_failure.get_or_insert_with(|| format!("{}: {found}, not {truth:?}", named(form.names, x)));
        }
    }
    row.not_finite = Some(failures);
    // The form in f64 is the truth: it has no error of its own.
    if name != "f64" {
        errors.fill(&mut row);
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Effort;

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
        let rows = rows(&Run::alone(Effort::Quick));
        let of = |name: &str| rows.iter().find(|row| row.method == name);
        for row in rows.iter().filter(|row| !row.method.contains(" f16")) {
            assert_eq!(row.not_finite, Some(0), "{row:?}");
        }
        let largest = |name: &str| of(name).and_then(|row| row.error_max).expect("a row");
        assert!(of("d_ggx f64").is_some_and(|row| row.error_max.is_none()));
        assert!(largest("d_ggx f32") < 8.0, "{:?}", of("d_ggx f32"));
        assert!(largest("d_ggx f16") > largest("d_ggx f32"));
        let Some(device) = of("d_ggx f32 device") else {
            assert!(std::env::var("HALFVECTOR_REQUIRE_GPU").as_deref() != Ok("1"), "no GPU");
            println!("skipped: no GPU");
            return;
        };
        // WGSL, "Floating Point Accuracy": a division may be 2.5 ulp off, and a square root as much.
        assert!(device.gpu.is_some() && device.error_max < Some(16.0), "{device:?}");
    }
}
