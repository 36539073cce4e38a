//! The elementary functions of lanes against the standard library's in f64, over bit patterns of the whole f32 range.

use halfvector_brdf::{Lane, Real};

/// Units in the last place of the nearest f32; below the normal numbers, those of the smallest normal one.
fn ulps(value: f32, truth: f64) -> f64 {
    if value.is_nan() || truth.is_nan() {
        return if value.is_nan() == truth.is_nan() { 0.0 } else { f64::INFINITY };
    }
    let rounded = truth as f32;
    if value == rounded {
        return 0.0;
    }
    let exponent = truth.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor();
    (f64::from(value) - truth).abs() / (exponent - 23.0).exp2()
}

/// Every 997th f32, negative ones, infinities and NaN among them.
fn floats() -> impl Iterator<Item = f32> {
    let special = [0.0, -0.0, 1.0, -1.0, 0.5, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MIN_POSITIVE, 1e-45];
    special.into_iter().chain((0..=u32::MAX / 997).map(|i| f32::from_bits(i * 997)))
}

fn worst(name: &str, bound: f64, inputs: impl Iterator<Item = f32>, error: impl Fn(f32) -> f64) {
    let (error, at) = inputs.map(|x| (error(x), x)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
    println!("{name}: {error:.2e} at {at:e}");
    assert!(error <= bound, "{name}: error {error} at {at:e} ({:#x}), bound {bound}", at.to_bits());
}

fn one_argument<const FUSED: bool>() {
    let lane = Lane::<FUSED, true>;
    worst("exp2", 2.0, floats(), |x| ulps(lane(x).exp2().0, f64::from(x).exp2()));
    worst("log2", 2.0, floats(), |x| ulps(lane(x).log2().0, f64::from(x).log2()));
    let held = || floats().filter(|x| *x >= 1e-37 && x.is_finite() || *x == 0.0);
    worst("sqrt_by_products", 2.0, held(), |x| ulps(lane(x).sqrt_by_products().0, f64::from(x).sqrt()));
    let nan_if = |outside: bool, y: f32| if outside { f32::NAN } else { y };
    worst("acos", 2.0, floats(), |x| ulps(nan_if(x.abs() > 1.0, lane(x).acos().0), f64::from(x).acos()));
    let angles = || floats().filter(|x| x.abs() <= 8192.0);
    worst("sin", 1.2e-7, angles(), |x| (f64::from(lane(x).sin_cos().0.0) - f64::from(x).sin()).abs());
    worst("cos", 1.2e-7, angles(), |x| (f64::from(lane(x).sin_cos().1.0) - f64::from(x).cos()).abs());
    assert!(lane(1.5).acos().0.is_nan() && lane(f32::NAN).acos().0.is_nan() && lane(f32::NAN).sin_cos().0.0.is_nan());
}

#[test]
fn elementary_functions_fused() {
    one_argument::<true>();
}

#[test]
fn elementary_functions_not_fused() {
    one_argument::<false>();
}

#[test]
fn powers() {
    let exponents = [0.0, 1.0, -1.0, 0.5, 5.0, 0.454_545_45, 2.4, -7.3, 1e3, 1e-3, 2e4, 1e8, f32::INFINITY, f32::NAN];
    for y in exponents {
        worst(&format!("powf {y}"), 2.0, floats().step_by(7), |x| {
            // The standard library gives negative bases integer powers; of a NaN to the power 0 both say 1.
            let truth = if x < 0.0 && y != 0.0 { f64::NAN } else { f64::from(x).powf(f64::from(y)) };
            ulps(Lane::<true>(x).powf(Lane(y)).0, truth)
        });
    }
}
