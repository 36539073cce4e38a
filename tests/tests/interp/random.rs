//! Random programs, run by the interpreter and by a GPU: integers must be equal, floats too, as every operation that is
//! generated is rounded correctly on both. A program is read off a tape of random bytes, so that a failing one shrinks to
//! a short one.
//!
//! The tape makes expressions of all four scalars, variables, an array, words of a storage buffer, if, switch, for with break and continue, early
//! returns, and calls with pointers. Numbers in the text stand beside a zero that only the run knows: naga refuses
//! constants that overflow. Floats are kept between 2^-40 and 2^40 in size, or 0: devices may flush smaller ones.

use std::fmt::Write;
use std::sync::atomic::AtomicU32;

use halfvector_interp::{Column, Derivatives, Entry, Limits, Outputs, Program, Resources};
use proptest::collection::vec;
use proptest::prelude::any;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

use super::valid;
use crate::twins::gpu::Gpu;

/// Invocations of each program.
const ROWS: usize = 200;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Type {
    Float,
    Signed,
    Unsigned,
    Bool,
}

/// Reads a program off a tape; beyond its end everything is the simplest.
struct Writer<'t> {
    tape: &'t [u8],
    at: usize,
    text: String,
    indent: usize,
    loops: usize,
    /// Calls of the helper are allowed: in `program`, not in the helper itself.
    calls: bool,
}

impl Writer<'_> {
    fn pick(&mut self, count: usize) -> usize {
        let byte = self.tape.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        usize::from(byte) % count
    }

    fn is_over(&self) -> bool {
        self.at >= self.tape.len()
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.text, "{:1$}{text}", "", 4 * self.indent);
    }

    fn expression(&mut self, ty: Type, depth: usize) -> String {
        if depth == 0 || self.is_over() {
            return self.leaf(ty);
        }
        let d = depth - 1;
        match ty {
            Type::Float => {
                let kind = self.pick(14);
                if kind == 0 {
                    return self.leaf(ty);
                }
                let (a, b) = (self.expression(ty, d), self.expression(ty, d));
                match kind {
                    1 => format!("small({a} + {b})"),
                    2 => format!("small({a} - {b})"),
                    3 | 4 => format!("small({a} * {b})"),
                    5 => format!("small({a} / (abs({b}) + 1.0))"),
                    6 => format!("min({a}, {b})"),
                    7 => format!("max({a}, -{b})"),
                    8 => format!("floor({a})"),
                    9 => format!("small(fract({a}))"),
                    10 => format!("select({a}, {b}, {})", self.expression(Type::Bool, d)),
                    11 => format!("f32({} % 1000)", self.expression(Type::Signed, d)),
                    12 => format!("clamp({a}, -8.0, 8.0)"),
                    _ => format!("small(sign({a}) * trunc({b}))"),
                }
            }
            Type::Signed | Type::Unsigned => {
                let kind = self.pick(15);
                if kind == 0 {
                    return self.leaf(ty);
                }
                let (a, b) = (self.expression(ty, d), self.expression(ty, d));
                let (one, other) = if ty == Type::Signed { ("i32", Type::Unsigned) } else { ("u32", Type::Signed) };
                match kind {
                    1 => format!("({a} + {b})"),
                    2 => format!("({a} - {b})"),
                    3 => format!("({a} * {b})"),
                    4 => format!("({a} / {b})"),
                    5 => format!("({a} % {b})"),
                    6 => format!("({a} & {b})"),
                    7 => format!("({a} | ~{b})"),
                    8 => format!("({a} ^ {b})"),
                    9 => format!("({a} << ({} % 32u))", self.expression(Type::Unsigned, d)),
                    10 => format!("({a} >> ({} % 32u))", self.expression(Type::Unsigned, d)),
                    11 => format!("min({a}, max({b}, {one}(3)))"),
                    12 => format!("{one}({})", self.expression(other, d)),
                    13 => format!("{one}({})", self.expression(Type::Float, d)),
                    _ => format!("({} + reverseBits({b}) + firstLeadingBit({a}))", self.leaf(ty)),
                }
            }
            Type::Bool => {
                let kind = self.pick(8);
                let inner = [Type::Float, Type::Signed, Type::Unsigned][self.pick(3)];
                match kind {
                    0 => self.leaf(ty),
                    1 => format!("({} && {})", self.expression(ty, d), self.expression(ty, d)),
                    2 => format!("({} || {})", self.expression(ty, d), self.expression(ty, d)),
                    3 => format!("!{}", self.expression(ty, d)),
                    4 => format!("({} < {})", self.expression(inner, d), self.expression(inner, d)),
                    5 => format!("({} >= {})", self.expression(inner, d), self.expression(inner, d)),
                    6 => format!("({} == {})", self.expression(inner, d), self.expression(inner, d)),
                    _ => format!("({} != {})", self.expression(inner, d), self.expression(inner, d)),
                }
            }
        }
    }

    fn leaf(&mut self, ty: Type) -> String {
        let choice = self.pick(6);
        match (ty, choice) {
            (Type::Float, 0) => "x".into(),
            (Type::Float, 1) => "y".into(),
            (Type::Float, 2) => format!("a[{}]", self.expression(Type::Unsigned, 0)),
            (Type::Float, _) => ["vf", "(zf + 0.5)", "(zf - 3.25)"][choice % 3].into(),
            (Type::Signed, _) => ["vi", "i", "vi", "(zi - 7)", "(zi + 2147483647)", "vi"][choice].into(),
            (Type::Unsigned, _) => ["vu", "u", "vu", "(zu + 5u)", "(zu + 4294967295u)", "vu"][choice].into(),
            (Type::Bool, _) => ["vb", "(x < y)", "true", "vb", "(i > 0)", "vb"][choice].into(),
        }
    }

    fn statements(&mut self, depth: usize) {
        for _ in 0..1 + self.pick(4) {
            if self.is_over() {
                return;
            }
            self.statement(depth);
        }
    }

    fn block(&mut self, head: &str, depth: usize) {
        self.line(&format!("{head} {{"));
        self.indent += 1;
        self.statements(depth);
        self.indent -= 1;
        self.line("}");
    }

    fn statement(&mut self, depth: usize) {
        let kind = if depth == 0 { self.pick(7) } else { self.pick(15) };
        match kind {
            0 => {
                let value = self.expression(Type::Float, 3);
                self.line(&format!("vf = {value};"));
            }
            1 => {
                let value = self.expression(Type::Signed, 3);
                self.line(&format!("vi = {value};"));
            }
            2 => {
                let value = self.expression(Type::Unsigned, 3);
                self.line(&format!("vu = {value};"));
            }
            3 => {
                let value = self.expression(Type::Bool, 2);
                self.line(&format!("vb = {value};"));
            }
            4 => {
                let (index, value) = (self.expression(Type::Unsigned, 1), self.expression(Type::Float, 2));
                self.line(&format!("a[{index} % 3u] = {value};"));
            }
            5 if self.calls => {
                let (value, x) = (self.expression(Type::Signed, 1), self.expression(Type::Float, 1));
                self.line(&format!("vi += helper({x}, {value}, &vf, &vu);"));
            }
            5 => self.line("vu += 1u;"),
            6 => {
                let (index, value) = (self.expression(Type::Unsigned, 1), self.expression(Type::Signed, 1));
                self.line(&format!(
                    "results[row].kept[{index} % 3u] = u32({value}); vu ^= results[row].kept[vu % 3u];"
                ));
            }
            7 | 8 => {
                let condition = self.expression(Type::Bool, 2);
                self.block(&format!("if {condition}"), depth - 1);
                if self.pick(2) == 1 {
                    self.block("else", depth - 1);
                }
            }
            9 => {
                let condition = self.expression(Type::Bool, 1);
                self.line(&format!(
                    "if {condition} {{ {} }}",
                    if self.calls { "return Result(vf, vi, vu, vb);" } else { "return vi;" }
                ));
            }
            10 | 11 => {
                self.loops += 1;
                let name = format!("k{}", self.loops);
                let bound = if self.pick(2) == 0 {
                    "4".into()
                } else {
                    format!("abs({} % 5)", self.expression(Type::Signed, 1))
                };
                self.line(&format!("for (var {name} = 0; {name} < {bound}; {name}++) {{"));
                self.indent += 1;
                self.line(&format!("vi += {name};"));
                self.statements(depth - 1);
                if self.pick(2) == 0 {
                    let condition = self.expression(Type::Bool, 1);
                    let leave = ["break", "continue"][self.pick(2)];
                    self.line(&format!("if {condition} {{ {leave}; }}"));
                    self.statements(depth - 1);
                }
                self.indent -= 1;
                self.line("}");
            }
            12 => {
                let selector = self.expression(Type::Signed, 1);
                self.line(&format!("switch {selector} % 4 {{"));
                self.indent += 1;
                self.block("case 0, 1:", depth - 1);
                self.block("case -1:", depth - 1);
                self.block("default:", depth - 1);
                self.indent -= 1;
                self.line("}");
            }
            _ => {
                let value = self.expression(Type::Float, 2);
                self.line(&format!("{{ let t = {value}; vf = small(vf + t); a[0] = t; }}"));
            }
        }
    }
}

/// The functions of a program.
fn program(tape: &[u8]) -> String {
    let mut writer = Writer { tape, at: 0, text: String::new(), indent: 0, loops: 0, calls: false };
    for line in [
        "struct Result { x: f32, i: i32, u: u32, b: bool }",
        "fn small(x: f32) -> f32 { let s = abs(x); return select(clamp(x, -1e12, 1e12), 0.0, s < 1e-12); }",
        "fn helper(x: f32, i: i32, f: ptr<function, f32>, n: ptr<function, u32>) -> i32 {",
        "    var vf = *f; var vi = i; var vu = *n; var vb = false; let y = x; let u = vu;",
        "    var a = array<f32, 3>(x, vf, 1.0);",
        "    let zf = 0.0 * y; let zi = 0 * i; let zu = 0u * u;",
    ] {
        writer.line(line);
    }
    writer.indent = 1;
    writer.statements(2);
    writer.line("*f = vf; *n = vu + u32(vb);");
    writer.line("return vi;");
    writer.indent = 0;
    writer.line("}");
    writer.line("fn program(x: f32, y: f32, i: i32, u: u32) -> Result {");
    writer.indent = 1;
    writer.line("var vf = x; var vi = i; var vu = u; var vb = x > y;");
    writer.line("var a = array<f32, 3>(y, 2.0, x);");
    writer.line("let zf = 0.0 * y; let zi = 0 * i; let zu = 0u * u;");
    writer.calls = true;
    while !writer.is_over() {
        writer.statement(3);
    }
    writer.line("return Result(small(vf + a[0] + a[2]), vi, vu, vb);");
    writer.indent = 0;
    writer.line("}");
    writer.text
}

/// The words that an invocation writes: a float, two integers and a bool, then those that it keeps and a gap.
type Row = [u32; 8];

/// Four words for each invocation: two floats, two integers.
fn inputs() -> Vec<[u32; 4]> {
    (0..ROWS as u32)
        .map(|row| {
            let hash = |n: u32| (row * 4 + n).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b);
            let float = |n: u32| ((hash(n) % 4096) as f32 / 64.0 - 32.0).to_bits();
            let int = |n: u32| if row % 8 == 0 { hash(n) } else { hash(n) % 21 };
            [float(0), float(1), int(2).wrapping_sub(10), int(3)]
        })
        .collect()
}

/// Runs the shader's entry point as the GPU does: what it says stands in a buffer that it has written.
fn interpret(source: &str, inputs: &[u8]) -> Vec<Row> {
    let (module, info) = valid(source).unwrap_or_else(|e| panic!("{e}"));
    let program = Program::compile(&module, &info, Entry::EntryPoint("call")).unwrap_or_else(|e| panic!("{e}"));
    let results: Vec<AtomicU32> = (0..ROWS * size_of::<Row>() / 4).map(|_| AtomicU32::new(0)).collect();
    let resources = Resources::default().buffer(0, 0, inputs).storage(0, 1, &results);
    let ids: Vec<u32> = (0..ROWS.next_multiple_of(64) as u32).collect();
    let id = [Column::Word(&ids), Column::Word(&[0]), Column::Word(&[0])];
    let mut out = Outputs::<f32>::default();
    program
        .run(&id, ids.len(), &mut out, &resources, Derivatives::Zero, Limits::default())
        .unwrap_or_else(|e| panic!("{e}\n{source}"));
    let words: Vec<u32> = results.into_iter().map(AtomicU32::into_inner).collect();
    bytemuck::pod_collect_to_vec(&words)
}

#[test]
fn random_programs_give_what_a_gpu_gives() {
    let Some(gpu) = Gpu::open() else { return };
    let inputs = inputs();
    let bytes: Vec<u8> = bytemuck::cast_slice(&inputs).to_vec();
    let mut runner = TestRunner::new_with_rng(
        Config {
            cases: std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(48),
            failure_persistence: None,
            ..Config::default()
        },
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let outcome = runner.run(&vec(any::<u8>(), 20..400), |tape| {
        let functions = program(&tape);
        let shader = include_str!("random.wgsl").replace("FUNCTIONS", &functions);
        let size = (ROWS * size_of::<Row>()) as u64;
        let device: Vec<Row> = bytemuck::pod_collect_to_vec(&gpu.run(&shader, &bytes, size, ROWS));
        let found = interpret(&shader, &bytes);
        for (row, (found, device)) in found.iter().zip(&device).enumerate() {
            // 0 and -0 are the same number.
            let same = found[1..] == device[1..] && f32::from_bits(found[0]) == f32::from_bits(device[0]);
            if !same {
                let float = f32::from_bits;
                return Err(TestCaseError::fail(format!(
                    "on {:?}: {:?}, {}: {:?}\n{functions}",
                    (float(inputs[row][0]), float(inputs[row][1]), inputs[row][2].cast_signed(), inputs[row][3]),
                    (float(found[0]), found[1].cast_signed(), found[2], found[3]),
                    gpu.name,
                    (float(device[0]), device[1].cast_signed(), device[2], device[3]),
                )));
            }
        }
        Ok(())
    });
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
}
