//! Programs that must end with an error in words, and soon.

use halfvector_interp::{Column, Entry, Limits, Program, RunError, Unsupported};

use super::support::{compile, try_run, valid};

fn refused(source: &str) -> String {
    match compile(source, "f") {
        Err(error) => error.to_string(),
        Ok(_) => panic!("not refused: {source}"),
    }
}

#[test]
fn endless_loops_end_with_the_name_of_the_function() {
    let limits = Limits { steps: 10_000, ..Limits::default() };
    for body in [
        "loop { }",
        "loop { if x > 1e9 { break; } }",
        "while true { y += 1.0; }",
        "loop { continue; }",
        "loop { if x > 0.5 { continue; } if x < 0.5 { return y; } }",
    ] {
        let source = format!(
            "fn spin(x: f32) -> f32 {{ var y = x; {body} return y; }} fn f(x: f32) -> f32 {{ return spin(x); }}"
        );
        let source = if body == "loop { }" || body.contains("while true") || body == "loop { continue; }" {
            source.replace(&format!("{body} return y;"), &format!("if x > -1.0 {{ {body} }} return y;"))
        } else {
            source
        };
        let inputs = [Column::Float(&[0.25_f32, 0.75][..])];
        let error = try_run(&source, &inputs, 2, limits).expect_err(body);
        let RunError::Steps { place, .. } = &error else { panic!("{error}") };
        assert_eq!(place.function, "spin");
        let span = place.span.clone().expect("a place in the text");
        assert!(source[span].contains(body.split(' ').next().expect("a word")), "{body}");
        assert!(error.to_string().contains("`spin`"), "{error}");
    }
}

#[test]
fn a_loop_that_all_lanes_are_killed_in_ends() {
    let source = "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {
        loop { if (x >= 0.0) { discard; } }
        return vec4f(x);
    }";
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, Entry::EntryPoint("main")).expect("supported");
    let mut out = halfvector_interp::Outputs::<f32>::default();
    let run = program.run(
        &[Column::Float(&[0.0, 1.0])],
        2,
        &mut out,
        &Default::default(),
        halfvector_interp::Derivatives::Zero,
        Limits { steps: 10_000, ..Limits::default() },
    );
    assert_eq!(run, Ok(()));
    assert_eq!(out.killed, [true, true]);
}

#[test]
fn large_arrays_are_refused_or_limited() {
    let error = refused("fn f(i: i32) -> f32 { var a: array<f32, 100000000>; return a[i]; }");
    assert!(error.contains("more than 131072 scalars"), "{error}");
    let source = "fn f(i: i32) -> f32 { var a: array<f32, 100000>; a[i] = f32(i); return a[i + 1]; }";
    let limits = Limits { bytes: 1 << 20, ..Limits::default() };
    let error = try_run::<f32>(source, &[Column::Word(&[1])], 1, limits).expect_err("over the limit");
    assert!(matches!(error, RunError::Memory { .. }), "{error}");
    assert!(try_run::<f32>(source, &[Column::Word(&[1])], 1, Limits::default()).is_ok());
}

#[test]
fn calls_that_double_are_refused() {
    let mut source = String::from("fn level0(x: f32) -> f32 { return sin(x) + 1.0; }\n");
    for i in 1..40 {
        source += &format!("fn level{i}(x: f32) -> f32 {{ return level{0}(x) + level{0}(x + 1.0); }}\n", i - 1);
    }
    source += "fn f(x: f32) -> f32 { return level39(x); }";
    let error = refused(&source);
    assert!(error.contains("more than 1048576 instructions"), "{error}");
}

#[test]
fn deep_chains_of_calls_are_refused() {
    let mut source = String::from("fn level0(x: f32) -> f32 { return x; }\n");
    for i in 1..1000 {
        source += &format!("fn level{i}(x: f32) -> f32 {{ return level{}(x); }}\n", i - 1);
    }
    source += "fn f(x: f32) -> f32 { return level999(x); }";
    assert!(refused(&source).contains("levels of nested blocks and calls"));
}

#[test]
fn deep_blocks_run() {
    let deep = 100;
    let source = format!(
        "fn f(x: f32) -> f32 {{ {} return 1.0; {} return 0.0; }}",
        "if x > 0.0 {".repeat(deep),
        "}".repeat(deep)
    );
    let rows = try_run::<f32>(&source, &[Column::Float(&[1.0, -1.0])], 2, Limits::default()).expect("runs");
    assert_eq!(rows.columns[0].to_f64(), [1.0, 0.0]);
}

#[test]
fn what_cannot_run_is_named() {
    let cases = [
        (
            "@group(0) @binding(0) var<storage, read_write> n: array<atomic<u32>>; fn f() { atomicAdd(&n[0], 1u); }",
            "atomic",
        ),
        ("fn f() { workgroupBarrier(); }", "a barrier"),
        ("var<workgroup> w: array<f32, 4>; fn f() -> f32 { return w[1]; }", "workgroup memory"),
        (
            "@group(0) @binding(0) var t: texture_depth_2d; fn f() -> f32 { return textureLoad(t, vec2i(0), 0); }",
            "a depth texture",
        ),
        (
            "@group(0) @binding(0) var t: texture_2d<u32>; fn f() -> vec4u { return textureLoad(t, vec2i(0), 0); }",
            "a texture of integers",
        ),
        (
            "@group(0) @binding(0) var t: texture_storage_2d<rgba8unorm, write>; fn f() { textureStore(t, vec2i(0), vec4f(0.0)); }",
            "writing to a texture",
        ),
        (
            "@group(0) @binding(0) var t: texture_multisampled_2d<f32>; fn f() -> vec4f { return textureLoad(t, vec2i(0), 0); }",
            "a multisampled texture",
        ),
        ("override k: f32; fn f() -> f32 { return k; }", "an override constant"),
        ("fn f(x: i64) -> i64 { return x + 1li; }", "the type i64, which cannot run on the CPU: use i32"),
        ("fn f(x: u64) -> u64 { return x + 1lu; }", "the type u64, which cannot run on the CPU: use u32"),
        ("fn f() -> i32 { return i32(1li + i64(2)); }", "the type i64"),
        ("fn f(x: f32) -> f32 { var sum = 0lu; sum += u64(x); return f32(sum); }", "the type u64"),
        ("enable f16; fn f(x: f16) -> f16 { return x; }", "the type f16, which cannot run on the CPU: use f32"),
        ("fn f(x: f32) -> f32 { return subgroupAdd(x); }", "subgroup operations"),
        ("fn f(x: f32) -> vec4u { return subgroupBallot(x > 0.0); }", "subgroup operations"),
        ("fn f(x: f32) -> f32 { return quadSwapX(x); }", "subgroup operations"),
    ];
    for (source, what) in cases {
        let error = refused(source);
        assert!(error.contains(what), "{source}: {error}");
        assert!(error.contains("`f`") && error.contains("CPU: "), "{error}");
        // In the words of WGSL, without those of the parser's data.
        assert!(!error.contains(['{', '(']), "{error}");
    }
    assert!(matches!(compile("fn f() {}", "g"), Err(Unsupported::Missing { .. })));
}
