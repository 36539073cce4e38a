//! Built-in functions that random programs do not call, by the interpreter and by a GPU.

use std::fmt::Write;
use std::sync::atomic::AtomicU32;

use halfvector_interp::{Column, Derivatives, Entry, Limits, Outputs, Program, Resources};

use super::valid;
use crate::twins::gpu::Gpu;

/// Rows of arguments: two floats from -8 to 8, an i32 and an u32.
const ROWS: usize = 256;

/// Exact on every device: words.
const WORDS: [&str; 26] = [
    "countOneBits(u)",
    "countLeadingZeros(u)",
    "countTrailingZeros(u)",
    "firstLeadingBit(u)",
    "firstTrailingBit(u)",
    "u32(countLeadingZeros(i))",
    "u32(firstTrailingBit(i))",
    "extractBits(u, u % 40u, u % 37u)",
    "u32(extractBits(i, u % 40u, u % 37u))",
    "insertBits(u, u32(i), u % 40u, u % 37u)",
    "u32(insertBits(i, i32(u), u % 40u, u % 37u))",
    "dot4U8Packed(u, u32(i))",
    "u32(dot4I8Packed(u, u32(i)))",
    "pack4xI8(unpack4xI8(u) + vec4i(i))",
    "pack4xU8(unpack4xU8(u) + vec4u(1u))",
    "pack4xI8Clamp(vec4i(i, -i, i % 300, 7))",
    "pack4xU8Clamp(vec4u(u, u % 300u, 255u, 256u))",
    "pack2x16float(vec2f(x, y))",
    "bitcast<u32>(quantizeToF16(x))",
    "bitcast<u32>(unpack2x16float(u & 0xbbffbbffu).x + 1.0)",
    "u32(clamp(i, -50, 50))",
    "u32(abs(i)) + u32(sign(i))",
    "u32(dot(vec3i(i, 3, i), vec3i(5, i, 7)))",
    "select(bitcast<u32>(modf(x).whole), 0u, modf(x).whole == 0.0)",
    "bitcast<u32>(round(x * 2.0) + ceil(y) + 0.0)",
    "u32(i32(x * 3.0)) + u32(y * 3.0)",
];

/// Floats, each with the error that WGSL leaves a device, or what one of Mesa's makes of that: relative to the result or 1, the
/// larger.
const FLOATS: [(&str, f32); 24] = [
    ("fma(x, y, 1.0)", 1e-5),
    ("inverseSqrt(abs(x) + 0.01)", 1e-6),
    ("degrees(x)", 1e-5),
    ("radians(x)", 1e-6),
    ("sinh(x)", 1e-3),
    ("cosh(x)", 1e-3),
    ("tanh(x)", 1e-3),
    ("asinh(x)", 1e-3),
    ("acosh(abs(x) + 1.0)", 1e-3),
    ("atanh(x / 9.0)", 1e-3),
    ("asin(x / 8.0)", 1e-3),
    ("acos(x / 8.0)", 1e-3),
    ("atan2(x, y)", 1e-3),
    ("ldexp(x, 5) + frexp(y + 9.0).fract", 1e-6),
    ("smoothstep(-1.0, 2.0, x)", 1e-5),
    ("mix(x, y, 0.3)", 1e-5),
    ("length(vec3f(x, y, 1.0)) + distance(vec2f(x, y), vec2f(1.0))", 1e-5),
    ("normalize(vec3f(x, y, 1.0)).x", 1e-5),
    ("reflect(vec3f(x, y, 1.0), vec3f(0.0, 0.6, 0.8)).z", 1e-4),
    ("refract(normalize(vec3f(x, y, -1.0)), vec3f(0.0, 0.0, 1.0), 0.7).z", 1e-4),
    ("faceForward(vec2f(x, y), vec2f(y, x), vec2f(1.0, 0.5)).y", 1e-6),
    ("determinant(mat3x3f(x, y, 1.0, y, 1.0, x, 1.0, x, y))", 1e-2),
    ("unpack4x8snorm(u).y + unpack4x8unorm(u).z + unpack2x16snorm(u).x + unpack2x16unorm(u).y", 1e-5),
    ("saturate(x) + step(y, x) + fract(y)", 1e-5),
];

fn arguments() -> Vec<[u32; 4]> {
    let row = |row: u32| {
        let hash = |n: u32| (row * 4 + n).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b);
        let float = |n: u32| ((hash(n) % 4096) as f32 / 256.0 - 8.0).to_bits();
        let int = |n: u32| if row.is_multiple_of(4) { hash(n) % 9 } else { hash(n) };
        [float(0), float(1), int(2).wrapping_sub(4), int(3)]
    };
    (0..ROWS as u32).map(row).collect()
}

/// Every call on every row, by the interpreter and by the GPU.
fn both(gpu: &Gpu, calls: &[String]) -> [Vec<u32>; 2] {
    let mut text = String::new();
    for (number, call) in calls.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "    results[row][{number}] = {call};");
    }
    let shader = include_str!("builtins.wgsl").replace("COUNT", &calls.len().to_string()).replace("CALLS", &text);
    let arguments = arguments();
    let bytes: Vec<u8> = bytemuck::cast_slice(&arguments).to_vec();
    let count = ROWS * calls.len();
    let device: Vec<u32> = bytemuck::pod_collect_to_vec(&gpu.run(&shader, &bytes, 4 * count as u64, ROWS));
    let (module, info) = valid(&shader).unwrap_or_else(|e| panic!("{e}"));
    let program = Program::compile(&module, &info, Entry::EntryPoint("call")).unwrap_or_else(|e| panic!("{e}"));
    let results: Vec<AtomicU32> = (0..count).map(|_| AtomicU32::new(0)).collect();
    let resources = Resources::default().buffer(0, 0, &bytes).storage(0, 1, &results);
    let ids: Vec<u32> = (0..ROWS as u32).collect();
    let id = [Column::Word(&ids), Column::Word(&[0]), Column::Word(&[0])];
    let mut out = Outputs::<f32>::default();
    program
        .run(&id, ROWS, &mut out, &resources, Derivatives::Zero, Limits::default())
        .unwrap_or_else(|e| panic!("{e}"));
    [results.into_iter().map(AtomicU32::into_inner).collect(), device]
}

#[test]
fn builtins_give_what_a_gpu_gives() {
    let Some(gpu) = Gpu::open() else { return };
    let arguments = arguments();
    let mut wrong = Vec::new();
    let calls = WORDS.map(str::to_owned);
    let [found, device] = both(&gpu, &calls);
    for (at, (found, device)) in found.iter().zip(&device).enumerate() {
        if found != device {
            let [x, y, i, u] = arguments[at / calls.len()];
            let (x, y, i) = (f32::from_bits(x), f32::from_bits(y), i.cast_signed());
            wrong.push(format!("{} at {x}, {y}, {i}, {u}: {found:#x}, {device:#x}", WORDS[at % calls.len()]));
        }
    }
    let calls = FLOATS.map(|(call, _)| format!("bitcast<u32>({call})"));
    let [found, device] = both(&gpu, &calls);
    for (at, (found, device)) in found.iter().zip(&device).enumerate() {
        let (found, device) = (f32::from_bits(*found), f32::from_bits(*device));
        let (call, allowed) = FLOATS[at % calls.len()];
        // Two that are no number are alike.
        let is_apart = (found - device).abs() > allowed * found.abs().max(1.0) || found.is_nan() != device.is_nan();
        if is_apart {
            let [x, y, ..] = arguments[at / calls.len()].map(f32::from_bits);
            wrong.push(format!("{call} at {x}, {y}: {found}, {device}"));
        }
    }
    wrong.truncate(40);
    assert!(wrong.is_empty(), "interpreter, {}:\n{}", gpu.name, wrong.join("\n"));
}
