//! Structs, arrays, pointers, buffers, f64.

use halfvector_interp::{Column, Derivatives, Entry, Float, Half, Limits, OutputColumn, Outputs, Program, Resources};

use super::support::{run, valid};

#[test]
fn arrays_are_indexed_by_lane_and_indices_are_limited() {
    let source = "
        const TABLE = array<f32, 4>(10.0, 20.0, 30.0, 40.0);
        fn f(i: i32) -> vec3f {
            var a = array<vec2f, 3>(vec2f(1.0), vec2f(2.0, 3.0), vec2f(4.0, 5.0));
            a[i].y += 100.0;
            let t = TABLE;
            return vec3f(a[i][i], a[1].y, t[i]);
        }";
    let rows = run::<f32>(source, &[Column::Word(&[0, 1, 2, 7, u32::MAX])], 5);
    assert_eq!(rows[0], [1.0, 3.0, 10.0]);
    assert_eq!(rows[1], [103.0, 103.0, 20.0]);
    assert_eq!(rows[2], [105.0, 3.0, 30.0]);
    // Out of range: the last element.
    assert_eq!(rows[3], [105.0, 3.0, 40.0]);
    assert_eq!(rows[4], [105.0, 3.0, 40.0]);
}

#[test]
fn pointers_write_to_the_callers_variables() {
    let source = "
        struct S { a: f32, b: array<vec2f, 2>, n: u32 }
        fn add(p: ptr<function, f32>, x: f32) -> f32 { let old = *p; *p += x; return old; }
        fn fill(s: ptr<function, S>, i: u32, x: f32) {
            (*s).b[i] = vec2f(x, x + 1.0);
            (*s).n += 1u;
        }
        fn f(x: f32, i: u32) -> S {
            var s = S(x, array<vec2f, 2>(), 0u);
            let old = add(&s.a, 10.0);
            fill(&s, i, old);
            fill(&s, 1u - i, s.a);
            return s;
        }";
    let rows = run::<f32>(source, &[Column::Float(&[1.0, 2.0]), Column::Word(&[0, 1])], 2);
    assert_eq!(rows[0], [11.0, 1.0, 2.0, 11.0, 12.0, 2.0]);
    assert_eq!(rows[1], [12.0, 12.0, 13.0, 2.0, 3.0, 2.0]);
}

#[test]
fn a_loaded_value_does_not_follow_its_variable() {
    let source = "
        fn change(p: ptr<function, f32>, x: f32) -> f32 { *p = 100.0; return x + *p; }
        fn give(p: ptr<function, f32>) -> f32 { return *p; }
        fn f(x: f32) -> vec4f {
            var v = x;
            let before = v;
            v = v + 1.0;
            let r = change(&v, v);
            var w = x;
            let given = give(&w);
            w = 7.0;
            var s = vec2f(x, 2.0 * x);
            s = s.yx;
            return vec4f(before, r, given, s.x);
        }";
    assert_eq!(run::<f32>(source, &[Column::Float(&[1.0])], 1), [[1.0, 102.0, 1.0, 2.0]]);
    let source = "
        fn f(n: i32) -> vec2i {
            var a = 0; var b = 1;
            for (var i = 0; i < n; i++) { let t = a; a = b; b = t + b; }
            return vec2i(a, b);
        }";
    let rows = run::<f32>(source, &[Column::Word(&[0, 1, 10])], 3);
    assert_eq!(rows, [[0.0, 1.0], [1.0, 1.0], [55.0, 89.0]]);
}

#[test]
fn private_variables_begin_anew() {
    let source = "
        var<private> count: i32 = 5;
        fn more() -> i32 { count += 1; return count; }
        fn f(x: i32) -> i32 { if (x > 0) { _ = more(); } return more(); }";
    assert_eq!(run::<f32>(source, &[Column::Word(&[0, 1, 0])], 3), [[6.0], [7.0], [6.0]]);
}

#[test]
fn buffers_are_read_by_layout() {
    let source = "
        struct Light { position: vec3f, power: f32, m: mat3x3f, kind: u32 }
        struct All { scale: vec2f, lights: array<Light, 2> }
        @group(1) @binding(2) var<uniform> all: All;
        @group(0) @binding(0) var<storage, read> list: array<vec2f>;
        fn f(i: u32) -> array<f32, 6> {
            let l = all.lights[i];
            return array<f32, 6>(l.position.z, l.power, l.m[2].y, f32(l.kind), list[i].y * all.scale.x, f32(arrayLength(&list)));
        }";
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, Entry::Function("f")).expect("supported");
    let mut bytes = vec![0_u8; 16 + 2 * 80];
    let mut put = |at: usize, x: [u8; 4]| bytes[at..at + 4].copy_from_slice(&x);
    put(0, 3_f32.to_le_bytes());
    for i in 0..2 {
        let at = 16 + 80 * i;
        put(at + 8, (10.0 + i as f32).to_le_bytes());
        put(at + 12, (20.0 + i as f32).to_le_bytes());
        put(at + 16 + 32 + 4, (30.0 + i as f32).to_le_bytes());
        put(at + 64, (40 + i as u32).to_le_bytes());
    }
    let list: Vec<u8> = [1_f32, 2.0, 3.0, 4.0, 5.0, 6.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let resources = Resources::default().buffer(1, 2, &bytes).buffer(0, 0, &list);
    let mut out = Outputs::<f64>::default();
    let inputs = [Column::Word(&[0, 1, 9][..])];
    program.run(&inputs, 3, &mut out, &resources, Derivatives::Zero, Limits::default()).expect("runs");
    let columns: Vec<Vec<f64>> = out.columns.iter().map(|c| c.to_f64()).collect();
    assert_eq!(columns[0], [10.0, 11.0, 11.0]);
    assert_eq!(columns[1], [20.0, 21.0, 21.0]);
    assert_eq!(columns[2], [30.0, 31.0, 31.0]);
    assert_eq!(columns[3], [40.0, 41.0, 41.0]);
    assert_eq!(columns[4], [6.0, 12.0, 18.0]);
    assert_eq!(columns[5], [3.0, 3.0, 3.0]);
    let missing = program.run(&inputs, 3, &mut out, &Resources::default(), Derivatives::Zero, Limits::default());
    let error = missing.expect_err("no buffers").to_string();
    assert!(error.contains("`all` at @group(1) @binding(2)"), "{error}");
}

#[test]
fn f64_of_the_shader_stay_f64_in_both_runs() {
    let source = "
        fn f(x: f64, y: f32) -> vec2<f64> { let third = x / 3.0lf; return vec2<f64>(sqrt(third), f64(y) * third); }";
    let x = [1.0_f64];
    let single = run::<f32>(source, &[Column::Double(&x), Column::Float(&[0.1])], 1);
    let double = run::<f64>(source, &[Column::Double(&x), Column::Float(&[f64::from(0.1_f32)])], 1);
    assert_eq!(single, double);
    assert_eq!(single, [[(1.0_f64 / 3.0).sqrt(), f64::from(0.1_f32) * (1.0 / 3.0)]]);
}

#[test]
fn the_same_program_in_f64_is_exact() {
    let source = "fn f(x: f32) -> f32 { return (1.0 + x) - 1.0; }";
    assert_eq!(run::<f32>(source, &[Column::Float(&[1e-10])], 1), [[0.0]]);
    assert!((run::<f64>(source, &[Column::Float(&[1e-10])], 1)[0][0] - 1e-10).abs() < 1e-16);
}

#[test]
fn slots_are_named() {
    let source = "
        struct In { @location(0) uv: vec2f, @builtin(position) p: vec4f }
        struct Out { @location(1) c: vec4f }
        @fragment fn main(i: In, @builtin(front_facing) front: bool) -> Out {
            if (i.uv.x > 0.5) { discard; }
            return Out(select(vec4f(0.0), i.p + i.uv.y, front));
        }";
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, Entry::EntryPoint("main")).expect("supported");
    let names: Vec<&str> = program.inputs().iter().map(|s| &s.name[..]).collect();
    assert_eq!(names, ["i.uv.x", "i.uv.y", "i.p.x", "i.p.y", "i.p.z", "i.p.w", "front"]);
    assert!(matches!(program.inputs()[0].binding, Some(naga::Binding::Location { location: 0, .. })));
    assert_eq!(program.outputs()[3].name, "c.w");
    let mut out = Outputs::<f32>::default();
    let inputs = [
        Column::Float(&[0.0, 1.0, 0.0][..]),
        Column::Float(&[1.0]),
        Column::Float(&[1.0]),
        Column::Float(&[2.0]),
        Column::Float(&[3.0]),
        Column::Float(&[4.0]),
        Column::Word(&[1, 1, 0]),
    ];
    program.run(&inputs, 3, &mut out, &Resources::default(), Derivatives::Quads, Limits::default()).expect("runs");
    assert_eq!(out.killed, [false, true, false]);
    let OutputColumn::Float(w) = &out.columns[3] else { panic!("a float") };
    assert_eq!((w[0], w[2]), (5.0, 0.0));
}

#[test]
fn wrong_columns_are_told() {
    let (module, info) = valid("fn f(a: f32, n: i32) -> f32 { return a * f32(n); }");
    let program = Program::compile(&module, &info, Entry::Function("f")).expect("supported");
    let mut out = Outputs::<f32>::default();
    let mut run = |inputs: &[Column<'_, f32>]| {
        let run = program.run(inputs, 2, &mut out, &Resources::default(), Derivatives::Zero, Limits::default());
        run.expect_err("refused").to_string()
    };
    assert!(run(&[Column::Float(&[1.0])]).contains("input 1 (`n`) has no column"));
    assert!(run(&[Column::Word(&[1]), Column::Word(&[1])]).contains("input 0 (`a`) has a column of another type"));
    assert!(run(&[Column::Float(&[1.0]), Column::Word(&[])]).contains("fewer numbers"));
}

/// What is the same in all lanes beside what is not, in every place of an operation of three.
#[test]
fn three_operands_the_same_or_not() {
    let source = "
        fn weight(r: f32) -> f32 { return r * r * r; }
        fn lean(n: vec3f, v: vec3f, r: f32) -> vec3f { return mix(reflect(-v, n), n, weight(r)); }
        struct Both { a: vec3f, b: vec3f }
        fn f(n: vec3f, v: vec3f, r: f32) -> Both { return Both(lean(n, v, 1.0), lean(n, v, r)); }";
    let columns: [[f32; 2]; 7] = [[0.6, 0.0], [0.8, 0.0], [0.0, 1.0], [0.0, 0.6], [1.0, 0.0], [0.0, 0.8], [1.0, 1.0]];
    let inputs: Vec<Column<'_, f32>> = columns.iter().map(|c| Column::Float(c)).collect();
    for row in run::<f32>(source, &inputs, 2) {
        assert_eq!(row[..3], row[3..]);
    }
}

/// The same program in f16: every result is rounded to 11 bits, beyond 65504 there is nothing, below 2^-24 there is 0.
#[test]
fn halves() {
    let source = "fn f(a: f32, b: f32) -> vec4f { return vec4f(a + b, a * b, a / b, exp(a)); }";
    let (a, b) = ([1.0, 2048.0, 300.0, 1e-4], [3.0, 1.0, 300.0, 1e-4]);
    let columns = [a, b].map(|all: [f64; 4]| all.map(Half::from_f64));
    let inputs = [Column::Float(&columns[0][..]), Column::Float(&columns[1][..])];
    let rows = run(source, &inputs, 4);
    let [sum, product, quotient, exp] = [0, 1, 2, 3].map(|i| rows.iter().map(|row| row[i]).collect::<Vec<f64>>());
    // 2049 lies between two numbers of f16, and is rounded to the even one.
    assert_eq!(sum[..3], [4.0, 2048.0, 600.0]);
    assert_eq!(product, [3.0, 2048.0, f64::INFINITY, 0.0]);
    assert_eq!(quotient[0], 0.333_251_953_125);
    assert_eq!((exp[0], exp[1]), (2.718_75, f64::INFINITY));
}
