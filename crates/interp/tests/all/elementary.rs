//! Elementary functions in f32 against the standard library's in f64, in units in the last place.

use std::slice::from_ref;

use halfvector_interp::Column;

use super::support::run;

fn numbers(low: f64, high: f64, count: usize) -> Vec<f32> {
    // Golden-ratio steps: evenly spread, never the same.
    (0..count).map(|i| (low + (high - low) * (i as f64 * 0.618_033_988_749_895).fract()) as f32).collect()
}

/// Largest error of `f` over the inputs. Results below `floor` count as that large.
fn worst(body: &str, inputs: &[Vec<f32>], floor: f64, truth: impl Fn(&[f64]) -> f64) -> f64 {
    let names: Vec<String> = ["a", "b"].iter().take(inputs.len()).map(|n| format!("{n}: f32")).collect();
    let source = format!("fn f({}) -> f32 {{ return {body}; }}", names.join(", "));
    let columns: Vec<Column<'_, f32>> = inputs.iter().map(|c| Column::Float(c)).collect();
    let rows = run(&source, &columns, inputs[0].len());
    let mut most = 0.0_f64;
    for (i, row) in rows.iter().enumerate() {
        let arguments: Vec<f64> = inputs.iter().map(|c| f64::from(c[i])).collect();
        let expected = truth(&arguments);
        let size = expected.abs().max(floor).max(f64::from(f32::MIN_POSITIVE)) as f32;
        let ulp = f64::from(f32::from_bits(size.to_bits() + 1)) - f64::from(size);
        let error = (row[0] - expected).abs() / ulp;
        assert!(!error.is_nan(), "{body} at {arguments:?}: {} not {expected}", row[0]);
        most = most.max(error);
    }
    println!("{body}: {most:.3} ulp");
    most
}

#[test]
fn within_an_ulp() {
    let n = 20_000;
    let small = numbers(-3.2, 3.2, n);
    let large = numbers(-1e6, 1e6, n);
    let positive: Vec<f32> = numbers(-126.0, 127.0, n).iter().map(|x| x.exp2()).collect();
    let exponents = numbers(-120.0, 120.0, n);
    for inputs in [&small, &large] {
        assert!(worst("sin(a)", from_ref(inputs), 0.0, |x| x[0].sin()) <= 0.51);
        assert!(worst("cos(a)", from_ref(inputs), 0.0, |x| x[0].cos()) <= 0.51);
        assert!(worst("tan(a)", from_ref(inputs), 0.0, |x| x[0].tan()) <= 0.51);
        assert!(worst("atan(a)", from_ref(inputs), 0.0, |x| x[0].atan()) <= 0.51);
    }
    let unit = numbers(-1.0, 1.0, n);
    assert!(worst("asin(a)", from_ref(&unit), 0.0, |x| x[0].asin()) <= 0.51);
    assert!(worst("acos(a)", from_ref(&unit), 0.0, |x| x[0].acos()) <= 0.51);
    assert!(worst("atan2(a, b)", &[unit.clone(), large.clone()], 0.0, |x| x[0].atan2(x[1])) <= 0.51);
    assert!(worst("atan2(a, b)", &[large.clone(), small.clone()], 0.0, |x| x[0].atan2(x[1])) <= 0.51);
    assert!(worst("exp2(a)", from_ref(&exponents), 0.0, |x| x[0].exp2()) <= 0.51);
    assert!(worst("exp(a)", &[numbers(-80.0, 80.0, n)], 0.0, |x| x[0].exp()) <= 0.51);
    assert!(worst("log2(a)", from_ref(&positive), 0.0, |x| x[0].log2()) <= 0.51);
    assert!(worst("log(a)", from_ref(&positive), 0.0, |x| x[0].ln()) <= 0.51);
    assert!(worst("log(a)", &[numbers(0.99, 1.01, n)], 0.0, |x| x[0].ln()) <= 0.51);
    let base: Vec<f32> = numbers(-8.0, 8.0, n).iter().map(|x| x.exp2()).collect();
    assert!(worst("pow(a, b)", &[base, numbers(-9.0, 9.0, n)], 0.0, |x| x[0].powf(x[1])) <= 0.51);
}

#[test]
fn ends_of_the_ranges() {
    let f = |body: &str, x: f32| {
        run::<f32>(&format!("fn f(a: f32) -> f32 {{ return {body}; }}"), &[Column::Float(&[x])], 1)[0][0]
    };
    let inf = f64::INFINITY;
    assert_eq!(f("exp2(a)", 128.0), inf);
    assert_eq!(f("exp2(a)", -200.0), 0.0);
    assert_eq!(f("exp2(a)", -149.0), f64::from(f32::from_bits(1)));
    assert_eq!(f("exp(a)", f32::NEG_INFINITY), 0.0);
    assert_eq!(f("log2(a)", 0.0), -inf);
    assert_eq!(f("log2(a)", f32::INFINITY), inf);
    assert_eq!(f("log2(a)", f32::from_bits(1)), -149.0);
    assert!(f("log2(a)", -1.0).is_nan());
    assert!(f("sqrt(a)", -1.0).is_nan());
    assert!(f("asin(a)", 1.1).is_nan());
    assert!(f("sin(a)", f32::INFINITY).is_nan());
    assert!(f("exp(a)", f32::NAN).is_nan());
    assert!((f("sin(a)", 1e20) - f64::from(1e20_f32).sin()).abs() < 1e-6);
    assert_eq!(f("pow(a, 0.0)", 0.0), 1.0);
    assert_eq!(f("pow(a, 2.0)", 0.0), 0.0);
    assert_eq!(f("pow(a, -1.0)", 0.0), inf);
    assert!(f("pow(a, 2.0)", -2.0).is_nan());
    assert_eq!(f("pow(1.0, a)", f32::INFINITY), 1.0);
    assert_eq!(f("pow(a, 3.0)", f32::MAX), inf);
    assert_eq!(f("atan2(a, -1.0)", 0.0), f64::from(std::f32::consts::PI));
    assert_eq!(f("atan2(a, 0.0)", 0.0), 0.0);
    assert_eq!(f("atan(a)", f32::INFINITY), f64::from(std::f32::consts::FRAC_PI_2));
}
