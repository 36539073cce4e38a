//! Built-in functions that other tests do not hold: in f32 and in f64, against Rust's own functions or values worked by hand.

use halfvector_interp::Column;

use super::support::{floats, run, words};

/// A function, its argument's range, Rust's own, and the error allowed in f32 in units in the last place.
type Case = (&'static str, [f64; 2], fn(f64) -> f64, f64);

const CASES: [Case; 22] = [
    ("sinh(a)", [-80.0, 80.0], f64::sinh, 1.0),
    ("sinh(a)", [-1e-3, 1e-3], f64::sinh, 1.0),
    ("cosh(a)", [-80.0, 80.0], f64::cosh, 1.0),
    ("tanh(a)", [-12.0, 12.0], f64::tanh, 1.0),
    ("tanh(a)", [-1e-3, 1e-3], f64::tanh, 1.0),
    ("asinh(a)", [-1e6, 1e6], f64::asinh, 1.0),
    ("asinh(a)", [-1e-3, 1e-3], f64::asinh, 1.0),
    ("acosh(a)", [1.0, 1e6], f64::acosh, 1.0),
    ("acosh(a)", [1.0, 1.01], f64::acosh, 1.0),
    ("atanh(a)", [-0.999, 0.999], f64::atanh, 1.0),
    ("atanh(a)", [-1e-3, 1e-3], f64::atanh, 1.0),
    ("sqrt(a)", [0.0, 1e9], f64::sqrt, 0.5),
    ("inverseSqrt(a)", [1e-9, 1e9], |x| 1.0 / x.sqrt(), 1.5),
    ("degrees(a)", [-10.0, 10.0], f64::to_degrees, 1.5),
    ("radians(a)", [-720.0, 720.0], f64::to_radians, 1.5),
    ("fma(a, a, 1.0)", [-30.0, 30.0], |x| x * x + 1.0, 1.5),
    ("ceil(a)", [-9.0, 9.0], f64::ceil, 0.0),
    ("floor(a)", [-9.0, 9.0], f64::floor, 0.0),
    ("exp2(a)", [-20.0, 20.0], f64::exp2, 0.51),
    ("log2(a)", [1e-3, 1e3], f64::log2, 0.51),
    ("asin(a)", [-1.0, 1.0], f64::asin, 0.51),
    ("atan(a)", [-9.0, 9.0], f64::atan, 0.51),
];

#[test]
fn of_one_number_as_rust_has_them() {
    for (body, [low, high], truth, allowed) in CASES {
        let source = format!("fn f(a: f32) -> f32 {{ return {body}; }}");
        // Golden-ratio steps: evenly spread, never the same.
        let at = |i: u32| low + (high - low) * (f64::from(i) * 0.618_033_988_749_895).fract();
        let single: Vec<f32> = (0..4000).map(|i| (at(i) as f32).clamp(low as f32, high as f32)).collect();
        let double: Vec<f64> = single.iter().map(|x| f64::from(*x)).collect();
        let narrow = run(&source, &[Column::Float(&single)], single.len());
        let wide = run(&source, &[Column::Float(&double)], double.len());
        for ((x, narrow), wide) in double.iter().zip(narrow).zip(wide) {
            let expected = truth(*x);
            let size = (expected.abs() as f32).max(f32::MIN_POSITIVE);
            let ulp = f64::from(f32::from_bits(size.to_bits() + 1)) - f64::from(size);
            let error = (narrow[0] - expected).abs() / ulp;
            assert!(error <= allowed, "{body} at {x}: {} in f32, {expected}: {error} ulp", narrow[0]);
            let error = (wide[0] - expected).abs();
            assert!(error <= 1e-13 * expected.abs(), "{body} at {x}: {} in f64, {expected}", wide[0]);
        }
    }
}

#[test]
fn ends_of_the_ranges() {
    let f = |body: &str, x: f32| floats("f32", body, &[&[x]], 0.0)[0][0];
    let inf = f32::INFINITY;
    assert_eq!((f("tanh(a)", inf), f("tanh(a)", -inf)), (1.0, -1.0));
    assert_eq!((f("sinh(a)", -inf), f("cosh(a)", -inf)), (f64::NEG_INFINITY, f64::INFINITY));
    assert_eq!((f("asinh(a)", -inf), f("acosh(a)", inf)), (f64::NEG_INFINITY, f64::INFINITY));
    assert_eq!((f("atanh(a)", 1.0), f("atanh(a)", -1.0)), (f64::INFINITY, f64::NEG_INFINITY));
    assert!(f("acosh(a)", 0.5).is_nan() && f("atanh(a)", 1.5).is_nan() && f("log(a)", -1.0).is_nan());
    assert_eq!((f("inverseSqrt(a)", 0.0), f("inverseSqrt(a)", inf)), (f64::INFINITY, 0.0));
    assert!(f("inverseSqrt(a)", -1.0).is_nan());
    assert!(f("normalize(vec2f(a, 0.0)).x", 0.0).is_nan());
    assert!(f("fract(a)", inf).is_nan() && f("a % 0.0", 1.0).is_nan());
    assert_eq!(
        (f("floor(a)", -inf), f("ceil(a)", inf), f("round(a)", inf)),
        (f64::NEG_INFINITY, inf.into(), inf.into())
    );
    assert_eq!((f("saturate(a)", f32::NAN), f("step(a, 1.0)", f32::NAN)), (0.0, 0.0));
    assert!(f("smoothstep(a, a, a)", 1.0) == 0.0);
}

/// What takes vectors and gives structures does it by component.
#[test]
fn by_component() {
    let two: [&[f32]; 2] = [&[-5.25], &[6.0]];
    let f = |result, body: &str| floats(result, body, &two, 0.0)[0].clone();
    assert_eq!(f("vec2f", "modf(vec2f(a, b)).fract"), [-0.25, 0.0]);
    assert_eq!(f("vec2f", "modf(vec2f(a, b)).whole"), [-5.0, 6.0]);
    assert_eq!(f("vec2f", "frexp(vec2f(a, b)).fract"), [-0.656_25, 0.75]);
    assert_eq!(f("vec2i", "frexp(vec2f(a, b)).exp"), [3.0, 3.0]);
    assert_eq!(f("vec2f", "ldexp(vec2f(a, b), vec2i(1, -1))"), [-10.5, 3.0]);
    assert_eq!(f("vec2f", "fma(vec2f(a, b), vec2f(2.0), vec2f(b, a))"), [-4.5, 6.75]);
    assert_eq!(f("vec2f", "step(vec2f(a, b), vec2f(0.0))"), [1.0, 0.0]);
    assert_eq!(f("vec2f", "smoothstep(vec2f(0.0), vec2f(12.0), vec2f(a, b))"), [0.0, 0.5]);
    assert_eq!(f("vec2f", "clamp(vec2f(a, b), vec2f(-1.0), vec2f(1.0))"), [-1.0, 1.0]);
    assert_eq!(f("vec2f", "mix(vec2f(a, b), vec2f(0.0), vec2f(0.0, 0.5))"), [-5.25, 3.0]);
    assert_eq!(f("vec2f", "quantizeToF16(vec2f(a, b) * 10000.0 / 10000.0)"), [-5.25, 6.0]);
    assert_eq!(f("f32", "distance(a, b)"), [11.25]);
    assert_eq!(f("f32", "length(vec4f(b, b, b, b))"), [12.0]);
    assert_eq!(f("vec3f", "cross(vec3f(a, b, 0.0), vec3f(b, a, 0.0))"), [0.0, 0.0, 27.5625 - 36.0]);
    assert_eq!(f("vec2f", "refract(vec2f(0.0, -1.0), vec2f(0.0, 1.0), b)"), [0.0, -1.0]);
    assert_eq!(f("vec2f", "sign(vec2f(a, b))"), [-1.0, 1.0]);
    assert_eq!(f("f32", "dot(vec4f(a, b, a, b), vec4f(1.0, 2.0, 3.0, 4.0))"), [15.0]);
}

#[test]
fn of_integers() {
    let i = |body: &str, a: i32, b: i32| {
        let (a, b) = (a.cast_unsigned(), b.cast_unsigned());
        (words("a: i32, b: i32", "i32", body, &[&[a], &[b]])[0][0] as u32).cast_signed()
    };
    let u = |body: &str, a: u32, b: u32| words("a: u32, b: u32", "u32", body, &[&[a], &[b]])[0][0] as u32;
    assert_eq!(
        (i("countOneBits(a)", -1, 0), i("countLeadingZeros(a)", -1, 0), i("countTrailingZeros(a)", -8, 0)),
        (32, 0, 3)
    );
    assert_eq!((i("firstTrailingBit(a)", -8, 0), i("reverseBits(a)", 1, 0)), (3, i32::MIN));
    assert_eq!(i("insertBits(a, b, 8u, 8u)", -1, 0x12), 0xffff_12ff_u32.cast_signed());
    assert_eq!(i("insertBits(a, b, 28u, 8u)", 0, -1), 0xf000_0000_u32.cast_signed());
    assert_eq!(i("dot(vec2i(a, b), vec2i(b, a))", 46341, 46341), (2_i64 * 46341 * 46341) as i32);
    assert_eq!(u("dot(vec2u(a, b), vec2u(3u, 5u))", 7, 11), 76);
    assert_eq!((i("clamp(a, -3, b)", -9, 4), i("clamp(a, -3, b)", 9, 4), u("clamp(a, 3u, b)", 9, 4)), (-3, 4, 4));
    assert_eq!(
        (u("abs(a)", u32::MAX, 0), u("min(a, b)", u32::MAX, 1), u("max(a, b)", u32::MAX, 1)),
        (u32::MAX, 1, u32::MAX)
    );
    assert_eq!((i("max(a, b)", -1, 1), i("min(a, b)", -1, 1)), (1, -1));
    // The low eight bits of each.
    assert_eq!(
        words("a: i32", "u32", "pack4xI8(vec4i(a, 1, -2, 300))", &[&[u32::MAX]]),
        [[f64::from(0x2cfe_01ff_u32)]]
    );
    assert_eq!(
        i("dot4I8Packed(u32(a), u32(b))", 0x80ff_7f01_u32.cast_signed(), 0x8001_7f02_u32.cast_signed()),
        2 + 127 * 127 - 1 + 128 * 128
    );
    assert_eq!(u("dot4U8Packed(a, b)", 0xffff_ffff, 0xffff_ffff), 4 * 255 * 255);
    assert_eq!(u("select(a, b, a > b)", 3, 2), 2);
}
