//! What WGSL says of every operation, case by case: the corners that languages differ in.

use super::support::{floats, words};

fn signed(values: &[i32]) -> Vec<u32> {
    values.iter().map(|x| x.cast_unsigned()).collect()
}

fn first(rows: &[Vec<f64>]) -> Vec<f64> {
    rows.iter().map(|row| row[0]).collect()
}

fn ints(arguments: &str, body: &str, inputs: &[&[i32]]) -> Vec<i32> {
    let inputs: Vec<Vec<u32>> = inputs.iter().map(|c| signed(c)).collect();
    let columns: Vec<&[u32]> = inputs.iter().map(|c| &c[..]).collect();
    words(arguments, "i32", body, &columns).iter().map(|row| (row[0] as u32).cast_signed()).collect()
}

#[test]
fn integers_wrap() {
    let two = "a: i32, b: i32";
    assert_eq!(ints(two, "a + b", &[&[i32::MAX, 1], &[1, 2]]), [i32::MIN, 3]);
    assert_eq!(ints(two, "a - b", &[&[i32::MIN], &[1]]), [i32::MAX]);
    assert_eq!(ints(two, "a * b", &[&[i32::MIN, 65536], &[-1, 65536]]), [i32::MIN, 0]);
    assert_eq!(ints("a: i32", "-a", &[&[i32::MIN, 7]]), [i32::MIN, -7]);
    assert_eq!(ints("a: i32", "abs(a)", &[&[i32::MIN, -7]]), [i32::MIN, 7]);
    assert_eq!(ints("a: i32", "sign(a)", &[&[i32::MIN, -7, 0, 3]]), [-1, -1, 0, 1]);
}

#[test]
fn division_by_zero_and_overflow_have_values() {
    let two = "a: i32, b: i32";
    assert_eq!(ints(two, "a / b", &[&[7, i32::MIN, -7], &[0, -1, 2]]), [7, i32::MIN, -3]);
    assert_eq!(ints(two, "a % b", &[&[7, i32::MIN, -7], &[0, -1, 2]]), [0, 0, -1]);
    let unsigned = words("a: u32, b: u32", "u32", "a / b", &[&[7, u32::MAX], &[0, 2]]);
    assert_eq!(first(&unsigned), [7.0, 2_147_483_647.0]);
    let unsigned = words("a: u32, b: u32", "u32", "a % b", &[&[7, u32::MAX], &[0, 2]]);
    assert_eq!(first(&unsigned), [0.0, 1.0]);
}

#[test]
fn shifts_take_the_count_modulo_32() {
    let u = |body| first(&words("a: u32, b: u32", "u32", body, &[&[1, 1, 0x8000_0000], &[31, 33, 31]]));
    assert_eq!(u("a << b"), [2_147_483_648.0, 2.0, 0.0]);
    assert_eq!(u("a >> b"), [0.0, 0.0, 1.0]);
    let inputs = [signed(&[-8, -1]), vec![1, 31]];
    let rows = words("a: i32, b: u32", "i32", "a >> b", &[&inputs[0], &inputs[1]]);
    assert_eq!(first(&rows), [f64::from((-4_i32).cast_unsigned()), f64::from(u32::MAX)]);
}

#[test]
fn bits() {
    let u = |body: &str, a: &[u32]| first(&words("a: u32", "u32", body, &[a]));
    let none = f64::from(u32::MAX);
    assert_eq!(u("firstLeadingBit(a)", &[0, 1, 0x8000_0000]), [none, 0.0, 31.0]);
    assert_eq!(u("firstTrailingBit(a)", &[0, 8, 0x8000_0000]), [none, 3.0, 31.0]);
    assert_eq!(u("countLeadingZeros(a)", &[0, 1]), [32.0, 31.0]);
    assert_eq!(u("countTrailingZeros(a)", &[0, 8]), [32.0, 3.0]);
    assert_eq!(u("countOneBits(a)", &[0, 0xf0f0]), [0.0, 8.0]);
    assert_eq!(u("reverseBits(a)", &[1]), [2_147_483_648.0]);
    assert_eq!(ints("a: i32", "firstLeadingBit(a)", &[&[0, -1, -2, 1, i32::MIN]]), [-1, -1, 0, 0, 30]);
    assert_eq!(u("extractBits(a, 4u, 8u)", &[0xabcd]), [188.0]);
    assert_eq!(u("extractBits(a, 0u, 32u)", &[0xabcd]), [43981.0]);
    assert_eq!(u("extractBits(a, 40u, 8u)", &[0xabcd]), [0.0]);
    assert_eq!(u("extractBits(a, 28u, 8u)", &[0xabcd_ef01]), [10.0]);
    assert_eq!(ints("a: i32", "extractBits(a, 4u, 4u)", &[&[0xf0, 0x70]]), [-1, 7]);
    assert_eq!(ints("a: i32", "extractBits(a, 0u, 32u)", &[&[-5]]), [-5]);
    assert_eq!(ints("a: i32", "extractBits(a, 32u, 4u)", &[&[-5]]), [0]);
    assert_eq!(u("insertBits(a, 0xffu, 4u, 8u)", &[0]), [4080.0]);
    assert_eq!(u("insertBits(a, 0xffu, 32u, 8u)", &[5]), [5.0]);
    assert_eq!(u("insertBits(a, 0u, 0u, 32u)", &[5]), [0.0]);
    assert_eq!(u("~a", &[0]), [none]);
    assert_eq!(u("dot4U8Packed(a, 0x01010101u)", &[0x0102_03ff]), [261.0]);
    assert_eq!(u("u32(dot4I8Packed(a, 0x01010101u))", &[0x0102_03ff]), [5.0]);
}

#[test]
fn floats_to_integers_saturate() {
    let inputs: &[f32] = &[1.9, -1.9, 1e20, -1e20, f32::NAN, f32::INFINITY];
    let i: Vec<i32> = floats("i32", "i32(a)", &[inputs], 0.0).iter().map(|r| (r[0] as u32).cast_signed()).collect();
    assert_eq!(i, [1, -1, 2_147_483_520, i32::MIN, 0, 2_147_483_520]);
    let u = floats("u32", "u32(a)", &[inputs], 0.0);
    assert_eq!(first(&u), [1.0, 0.0, 4_294_967_040.0, 0.0, 0.0, 4_294_967_040.0]);
    assert_eq!(first(&floats("bool", "bool(a)", &[&[0.0, -0.0, 2.0, f32::NAN]], 0.0)), [0.0, 0.0, 1.0, 1.0]);
}

#[test]
fn integers_to_floats_round() {
    let rows = words("a: u32", "f32", "f32(a)", &[&[16_777_217, u32::MAX]]);
    assert_eq!(first(&rows), [16_777_216.0, 4_294_967_296.0]);
    let inputs = signed(&[-16_777_217]);
    assert_eq!(first(&words("a: i32", "f32", "f32(a)", &[&inputs])), [-16_777_216.0]);
    assert_eq!(first(&words("a: bool", "f32", "f32(a)", &[&[0, 1, 7]])), [0.0, 1.0, 1.0]);
    assert_eq!(first(&words("a: bool", "u32", "u32(!a)", &[&[0, 1, 7]])), [1.0, 0.0, 0.0]);
}

#[test]
fn bitcasts_keep_bits_and_round_f64_to_f32_first() {
    let bits = floats("u32", "bitcast<u32>(a * 1.0)", &[&[1.0, -0.0, 0.1]], 0.0);
    assert_eq!(first(&bits), [1.0_f32, -0.0, 0.1].map(|x| f64::from(x.to_bits())));
    let third = floats("u32", "bitcast<u32>(a / b)", &[&[1.0], &[3.0]], 0.0);
    assert_eq!(first(&third), [f64::from((1.0_f32 / 3.0).to_bits())]);
    let back = words("a: u32", "f32", "bitcast<f32>(a)", &[&[0x3f80_0000]]);
    assert_eq!(first(&back), [1.0]);
}

#[test]
fn not_a_number() {
    let nan: &[f32] = &[f32::NAN];
    assert_eq!(first(&floats("f32", "min(a, b)", &[nan, &[1.0]], 0.0)), [1.0]);
    assert_eq!(first(&floats("f32", "max(b, a)", &[nan, &[1.0]], 0.0)), [1.0]);
    assert_eq!(first(&floats("f32", "clamp(a, 2.0, 3.0)", &[nan], 0.0)), [2.0]);
    assert_eq!(first(&floats("bool", "a == a", &[nan], 0.0)), [0.0]);
    assert_eq!(first(&floats("bool", "a != a", &[nan], 0.0)), [1.0]);
    assert_eq!(first(&floats("bool", "a >= 0.0 || a < 0.0", &[nan], 0.0)), [0.0]);
    assert_eq!(first(&floats("f32", "sign(a)", &[&[-3.0, 0.0, 5.0, f32::NAN]], 0.0)), [-1.0, 0.0, 1.0, 0.0]);
}

#[test]
fn rounding() {
    let halves: &[f32] = &[-1.5, -0.5, 0.5, 1.5, 2.5, 8_388_609.0];
    assert_eq!(first(&floats("f32", "round(a)", &[halves], 0.0)), [-2.0, 0.0, 0.0, 2.0, 2.0, 8_388_609.0]);
    assert_eq!(first(&floats("f32", "trunc(a)", &[&[-1.7, 1.7]], 0.0)), [-1.0, 1.0]);
    assert_eq!(first(&floats("f32", "fract(a)", &[&[-0.25, 1.75]], 0.0)), [0.75, 0.75]);
    assert_eq!(first(&floats("f32", "a % b", &[&[-7.5, 7.5], &[2.0, -2.0]], 0.0)), [-1.5, 1.5]);
    assert_eq!(first(&floats("f32", "quantizeToF16(a)", &[&[1.0 / 3.0]], 0.0)), [0.333_251_953_125]);
}

#[test]
fn taking_floats_apart() {
    let inputs: &[f32] = &[0.0, 1.0, -3.5, 1e-40, f32::MAX, f32::INFINITY];
    let fract = first(&floats("f32", "frexp(a).fract", &[inputs], 0.0));
    let exp = first(&floats("i32", "frexp(a).exp", &[inputs], 0.0));
    for ((x, fract), exp) in inputs.iter().zip(fract).zip(exp) {
        if x.is_finite() {
            let exp = (exp as u32).cast_signed();
            assert_eq!(fract * 2_f64.powi(exp), f64::from(*x), "frexp({x})");
            assert!(*x == 0.0 || (0.5..1.0).contains(&fract.abs()), "frexp({x}).fract = {fract}");
        }
    }
    let parts = floats("vec2f", "vec2f(modf(a).fract, modf(a).whole)", &[&[-1.25, 3.5]], 0.0);
    assert_eq!(parts, [[-0.25, -1.0], [0.5, 3.0]]);
    assert_eq!(first(&floats("f32", "ldexp(a, 3)", &[&[1.5, -0.5]], 0.0)), [12.0, -4.0]);
    assert_eq!(first(&floats("f32", "ldexp(a, -149)", &[&[1.0]], 1.0)), [f64::from(f32::from_bits(1))]);
}

#[test]
fn interpolation() {
    assert_eq!(first(&floats("f32", "mix(a, b, c)", &[&[2.0], &[4.0], &[0.25]], 0.0)), [2.5]);
    assert_eq!(first(&floats("f32", "step(a, b)", &[&[1.0, 1.0], &[1.0, 0.5]], 0.0)), [1.0, 0.0]);
    let s = floats("f32", "smoothstep(a, b, c)", &[&[0.0, 0.0, 1.0], &[2.0, 2.0, 0.0], &[0.5, 3.0, 0.25]], 0.0);
    assert_eq!(first(&s), [0.15625, 1.0, 0.84375]);
    assert_eq!(first(&floats("f32", "saturate(a)", &[&[-1.0, 0.5, 2.0]], 0.0)), [0.0, 0.5, 1.0]);
    assert_eq!(floats("vec3f", "mix(vec3f(0.0), vec3f(a), 0.5)", &[&[2.0]], 0.0), [[1.0; 3]]);
}

#[test]
fn geometry() {
    let v = "vec3f(a, b, c)";
    let one: [&[f32]; 3] = [&[1.0], &[2.0], &[2.0]];
    let f = |result, body: &str| floats(result, &body.replace('V', v), &one, 1e-6)[0].clone();
    assert_eq!(f("f32", "length(V)"), [3.0]);
    assert_eq!(f("f32", "distance(V, vec3f(1.0))"), [f64::from(2_f32.sqrt())]);
    assert_eq!(f("f32", "dot(V, vec3f(1.0, 10.0, 100.0))"), [221.0]);
    assert_eq!(f("vec3f", "cross(V, vec3f(0.0, 0.0, 1.0))"), [2.0, -1.0, 0.0]);
    assert_eq!(f("vec3f", "reflect(V, vec3f(0.0, 1.0, 0.0))"), [1.0, -2.0, 2.0]);
    assert_eq!(f("vec3f", "faceForward(V, vec3f(0.0, 0.0, 1.0), vec3f(0.0, 0.0, -1.0))"), [1.0, 2.0, 2.0]);
    assert_eq!(f("vec3f", "faceForward(V, vec3f(0.0, 0.0, 1.0), vec3f(0.0, 0.0, 1.0))"), [-1.0, -2.0, -2.0]);
    assert_eq!(f("f32", "length(a * 3.0)"), [3.0]);
    let total =
        floats("vec2f", "refract(vec2f(a, b), vec2f(0.0, 1.0), c)", &[&[0.8, 0.0], &[-0.6, -1.0], &[1.5, 1.5]], 1e-6);
    assert_eq!(total, [[0.0, 0.0], [0.0, -1.0]]);
    let unit = floats("vec3f", "normalize(vec3f(a, b, c))", &one, 1e-6);
    assert_eq!(unit[0], [1.0_f32 / 3.0, 2.0 / 3.0, 2.0 / 3.0].map(f64::from));
}

#[test]
fn matrices() {
    let inputs: [&[f32]; 3] = [&[2.0], &[3.0], &[5.0]];
    let f = |result, body: &str| floats(result, body, &inputs, 0.0)[0].clone();
    let m = "mat3x2f(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)";
    assert_eq!(f("vec2f", &format!("{m} * vec3f(a, b, c)")), [36.0, 46.0]);
    assert_eq!(f("vec3f", &format!("vec2f(a, b) * {m}")), [8.0, 18.0, 28.0]);
    let n = "mat2x2f(a, b, c, 1.0)";
    assert_eq!(f("vec2f", &format!("({n} * {n})[1]")), [15.0, 16.0]);
    assert_eq!(f("f32", &format!("determinant({n})")), [-13.0]);
    assert_eq!(f("f32", "determinant(mat3x3f(a, b, c, 1.0, 2.0, 3.0, 4.0, 7.0, 9.0))"), [-2.0]);
    assert_eq!(f("vec3f", &format!("transpose({m})[1]")), [2.0, 4.0, 6.0]);
    assert_eq!(f("vec2f", &format!("(2.0 * {m} - {m})[2]")), [5.0, 6.0]);
    assert_eq!(f("f32", "determinant(mat4x4f(a,0.0,0.0,1.0, 0.0,b,0.0,0.0, 0.0,0.0,c,0.0, 1.0,0.0,0.0,1.0))"), [15.0]);
}

#[test]
fn packing() {
    let pack = |body: &str| floats("u32", body, &[&[1.0], &[-0.5], &[0.0]], 0.0)[0][0] as u32;
    assert_eq!(pack("pack4x8unorm(vec4f(a, b, c, 0.5))"), 0x8000_00ff);
    assert_eq!(pack("pack4x8snorm(vec4f(a, b, c, -2.0))"), 0x8100_c17f);
    assert_eq!(pack("pack2x16unorm(vec2f(a, c))"), 0xffff);
    assert_eq!(pack("pack2x16snorm(vec2f(a, -1.0))"), 0x8001_7fff);
    assert_eq!(pack("pack2x16float(vec2f(a, b))"), 0xb800_3c00);
    let unpack = |result, body: &str| words("a: u32", result, body, &[&[0x8081_7fff]])[0].clone();
    assert_eq!(unpack("vec4f", "unpack4x8snorm(a)"), [f64::from(-1_f32 / 127.0), 1.0, -1.0, -1.0]);
    assert_eq!(unpack("vec4f", "unpack4x8unorm(a)").last(), Some(&f64::from(128_f32 / 255.0)));
    assert_eq!(unpack("vec2f", "unpack2x16unorm(a)")[0], f64::from(32767_f32 / 65535.0));
    assert_eq!(unpack("vec2f", "unpack2x16snorm(a)")[0], 1.0);
    assert_eq!(words("a: u32", "vec2f", "unpack2x16float(a)", &[&[0xb800_3c00]]), [[1.0, -0.5]]);
    assert_eq!(unpack("vec4u", "unpack4xU8(a)"), [255.0, 127.0, 129.0, 128.0]);
    assert_eq!(unpack("vec4i", "unpack4xI8(a) + vec4i(200)"), [199.0, 327.0, 73.0, 72.0]);
    assert_eq!(words("a: u32", "u32", "pack4xU8Clamp(vec4u(a, 1u, 2u, 3u))", &[&[300]]), [[50_463_231.0]]);
    assert_eq!(words("a: i32", "u32", "pack4xI8Clamp(vec4i(a, 1, 2, 3))", &[&[300]]), [[50_463_103.0]]);
    assert_eq!(words("a: u32", "u32", "pack4xU8(vec4u(a, 1u, 2u, 3u))", &[&[300]]), [[50_463_020.0]]);
}

#[test]
fn logic_and_selection() {
    let two: [&[f32]; 2] = [&[1.0, 2.0], &[2.0, 1.0]];
    assert_eq!(first(&floats("f32", "select(a, b, a < b)", &two, 0.0)), [2.0, 2.0]);
    assert_eq!(
        floats("vec2f", "select(vec2f(a), vec2f(b), vec2<bool>(true, a > b))", &two, 0.0),
        [[2.0, 1.0], [1.0, 1.0]]
    );
    assert_eq!(first(&floats("bool", "all(vec2f(a, b) > vec2f(1.5, 0.5))", &two, 0.0)), [0.0, 1.0]);
    assert_eq!(first(&floats("bool", "any(vec2f(a, b) > vec2f(1.5, 2.5))", &two, 0.0)), [0.0, 1.0]);
    assert_eq!(first(&floats("bool", "!(a < b) && true", &two, 0.0)), [0.0, 1.0]);
}
