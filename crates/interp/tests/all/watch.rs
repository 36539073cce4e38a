//! What a program decides by, as further outputs.

use std::f64::consts::FRAC_1_SQRT_2;

use halfvector_interp::{Column, Derivatives, Entry, Limits, Outputs, Program, Resources, Watch};

use crate::support::valid;

/// A function's body, and what is watched at two points.
type Case = (&'static str, &'static [(Watch, [f64; 2])]);

/// The watched numbers of a function of `a`, each at all points; the result is what the plain program gives.
fn watched(body: &str, a: &[f64]) -> Vec<(Watch, Vec<f64>)> {
    let (module, info) = valid(&format!("fn f(a: f32) -> f32 {{ {body} }}"));
    let (program, watches) =
        Program::compile_watched(&module, &info, Entry::Function("f")).unwrap_or_else(|e| panic!("{e}"));
    let plain = Program::compile(&module, &info, Entry::Function("f")).unwrap_or_else(|e| panic!("{e}"));
    let run = |program: &Program| {
        let mut outputs = Outputs::<f64>::default();
        let (resources, limits) = (Resources::default(), Limits::default());
        program
            .run(&[Column::Float(a)], a.len(), &mut outputs, &resources, Derivatives::Zero, limits)
            .unwrap_or_else(|e| panic!("{body}: {e}"));
        outputs.columns.iter().map(|column| column.to_f64()).collect::<Vec<_>>()
    };
    let mut columns = run(&program);
    assert_eq!(columns.len(), 1 + watches.len(), "{body}");
    assert_eq!(program.outputs().len(), columns.len(), "{body}");
    let numbers = columns.split_off(1);
    assert_eq!(columns, run(&plain), "{body}");
    watches.into_iter().zip(numbers).collect()
}

#[test]
fn poles_comparisons_and_whole_parts_are_watched() {
    let cases: [Case; 13] = [
        ("return a * 2.0;", &[]),
        ("return 1.0 / (a - 2.0);", &[(Watch::Pole, [-1.75, 1.0])]),
        ("return log(a) * 0.5;", &[(Watch::Pole, [0.25, 3.0])]),
        ("return pow(a, 0.5);", &[(Watch::Pole, [0.25, 3.0])]),
        ("return acos(a * 0.5 - 1.0);", &[(Watch::Pole, [0.125, 0.5])]),
        ("return select(0.0, 1.0, a < 0.5);", &[(Watch::Sign, [-0.25, 2.5])]),
        ("return step(0.5, a);", &[(Watch::Sign, [-0.25, 2.5])]),
        ("return sign(a - 1.0);", &[(Watch::Sign, [-0.75, 2.0])]),
        ("return floor(a * 3.0);", &[(Watch::Whole, [0.75, 9.0])]),
        ("return round(a);", &[(Watch::Whole, [0.75, 3.5])]),
        ("return f32(i32(a * 5.0));", &[(Watch::Whole, [1.25, 15.0])]),
        // Where it was not computed it is no number.
        (
            "var x = 1.0; if a < 1.0 { x = sqrt(a); } return x;",
            &[(Watch::Sign, [-0.75, 2.0]), (Watch::Pole, [0.25, f64::NAN])],
        ),
        // The last turn's.
        (
            "var x = a; for (var i = 0; i < 3; i++) { x = sqrt(x); } return x;",
            &[(Watch::Pole, [FRAC_1_SQRT_2, 1.316_074_012_952_492_5])],
        ),
    ];
    for (body, expected) in cases {
        let found = watched(body, &[0.25, 3.0]);
        let is_near = |a: &f64, b: &f64| (a - b).abs() < 1e-12 || a.is_nan() && b.is_nan();
        assert_eq!(found.len(), expected.len(), "{body}: {found:?}");
        for ((watch, numbers), (of, expected)) in found.iter().zip(expected) {
            let is_same = watch == of && numbers.iter().zip(expected).all(|(a, b)| is_near(a, b));
            assert!(is_same, "{body}: {found:?}");
        }
    }
}
