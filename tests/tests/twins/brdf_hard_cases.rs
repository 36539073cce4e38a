//! The rows of `hard_cases.csv` that a BRDF meets, each a test of the WGSL library on a GPU, in f32, in f64 and in f16 where
//! the GPU has them. The list is the one that the package of the BRDF tests in Rust.

#[path = "../../../crates/brdf/tests/all/hard_cases/list.rs"]
mod list;

use std::sync::OnceLock;

use halfvector_shaders::FILES;
use naga::Module;

use super::gpu::{Gpu, Number, library};
use list::{Case, case_names, cases};

/// One GPU and one library for all of these tests.
fn shared() -> Option<&'static (Gpu, Module)> {
    static SHARED: OnceLock<Option<(Gpu, Module)>> = OnceLock::new();
    SHARED.get_or_init(|| Some((Gpu::open()?, library()))).as_ref()
}

fn value<N: Number>(gpu: &Gpu, module: &Module, case: &Case) -> f64 {
    // Two rows: a buffer of f16 needs an even number of them.
    let row: Vec<f32> = case.arguments.iter().map(|x| *x as f32).collect();
    gpu.call::<N>(module, case.function, &[row.clone(), row].concat()).values[case.component]
}

fn check_by_name(name: &str) {
    let Some((gpu, module)) = shared() else { return };
    let cases = cases();
    let case = cases.iter().find(|c| c.name == name).expect("a case of the list");
    let check = |number: &str, value: f64, tolerance: f64| {
        let (function, arguments, answer) = (case.function, &case.arguments, case.answer);
        assert!(
            (value - answer).abs() <= tolerance * answer.abs(),
            "{}: {number} {function} of {arguments:?}: {value}, the right answer is {answer} (row {:?})",
            gpu.name,
            case.row
        );
    };
    // A GPU's division and square root have an ulp or two that Rust's have not.
    check("f32", value::<f32>(gpu, module, case), case.tolerance + 4e-7);
    if gpu.has_f64 {
        check("f64", value::<f64>(gpu, module, case), case.tolerance);
    }
    if gpu.has_f16 {
        let half = value::<half::f16>(gpu, module, case);
        match case.half {
            Some(tolerance) => check("f16", half, tolerance),
            None => assert!(half.is_finite() && half >= 0.0, "{}: f16 {name} is {half}", gpu.name),
        }
    }
}

macro_rules! named_tests {
    ($($name:ident),* $(,)?) => {
        $(#[test] fn $name() { check_by_name(stringify!($name)); })*
    };
}

case_names!(named_tests);

#[test]
fn the_floors_of_f16_are_those_of_the_library() {
    let source: String = FILES.iter().map(|f| f.source).collect();
    let names = half::f16::PRELUDE.lines().filter_map(|line| line.strip_prefix("const ")?.split(':').next());
    for name in names {
        assert!(source.contains(&format!("const {name}:")), "f16.wgsl defines {name}, which the library has not");
    }
}
