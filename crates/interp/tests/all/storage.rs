//! Buffers that programs write.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use halfvector_interp::{Column, Derivatives, Entry, Float, Limits, Outputs, Program, Resources, RunError};

use super::support::valid;

const NO_WORDS: &[AtomicU32] = &[];

fn words(count: usize) -> Vec<AtomicU32> {
    (0..count).map(|_| AtomicU32::new(0)).collect()
}

fn run<F: Float>(
    source: &str,
    entry: Entry<'_>,
    inputs: &[Column<'_, F>],
    lanes: usize,
    resources: &Resources<'_>,
    derivatives: Derivatives<'_, F>,
) -> Result<(), RunError> {
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, entry).expect("supported");
    program.run(inputs, lanes, &mut Outputs::default(), resources, derivatives, Limits::default())
}

/// Structs, matrices, arrays and f64 land where their layout says, and what is beside them stays.
#[test]
fn buffers_are_written_by_layout() {
    let source = "
        struct Part { position: vec3f, power: f32, m: mat3x3f, kind: i32 }
        struct All { count: u32, exact: f64, parts: array<Part> }
        @group(2) @binding(3) var<storage, read_write> all: All;
        fn f(i: u32) {
            let n = f32(i);
            all.parts[i].m = mat3x3f(vec3f(n), vec3f(1.0, 2.0, 3.0), vec3f(n + 0.5));
            all.parts[i].m[1].y = n / 3.0;
            all.parts[i].kind = -i32(i);
            if i == 1u { all.count = arrayLength(&all.parts); all.exact = 1.0lf / 3.0lf; }
        }";
    for double in [false, true] {
        let memory = words(4 + 3 * 20);
        for word in &memory {
            word.store(77, Relaxed);
        }
        let resources = Resources::default().storage(2, 3, &memory);
        let ids: &[u32] = &[0, 1, 2];
        if double {
            run::<f64>(source, Entry::Function("f"), &[Column::Word(ids)], 3, &resources, Derivatives::Zero)
        } else {
            run::<f32>(source, Entry::Function("f"), &[Column::Word(ids)], 3, &resources, Derivatives::Zero)
        }
        .expect("runs");
        let word = |at: usize| memory[at].load(Relaxed);
        assert_eq!([word(0), word(1)], [3, 77]);
        assert_eq!(f64::from_bits(u64::from(word(2)) | u64::from(word(3)) << 32), 1.0 / 3.0);
        for i in 0..3 {
            let at = 4 + 20 * i;
            let float = |k: usize| f32::from_bits(word(at + k));
            let n = i as f32;
            assert_eq!([word(at), word(at + 3)], [77; 2]);
            assert_eq!([float(4), float(8), float(9), float(10), float(14)], [n, 1.0, n / 3.0, 3.0, n + 0.5]);
            assert_eq!([word(at + 7), word(at + 11)], [77; 2]);
            assert_eq!(word(at + 16).cast_signed(), -(i as i32));
        }
    }
}

/// Each lane writes where it is active, reads what it has written, and indices beyond the end name the last element.
#[test]
fn lanes_write_their_own() {
    let source = "
        @group(0) @binding(0) var<storage, read_write> list: array<u32>;
        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3u) {
            if id.x >= 150u { return; }
            list[id.x] = 1u;
            for (var i = 0u; i < id.x % 5u; i++) {
                if i == 3u { break; }
                list[id.x] += list[id.x] + i;
            }
            if id.x == 149u { list[4000000000u + id.x] = 9u; }
        }";
    let memory = words(200);
    let ids: Vec<u32> = (0..192).collect();
    let inputs = [Column::<f32>::Word(&ids), Column::Word(&[0]), Column::Word(&[0])];
    let resources = Resources::default().storage(0, 0, &memory);
    run(source, Entry::EntryPoint("main"), &inputs, 192, &resources, Derivatives::Zero).expect("runs");
    for (id, word) in memory.iter().enumerate().take(199) {
        let mut expected = u32::from(id < 150);
        for i in 0..(id as u32 % 5).min(3) {
            expected += if id < 150 { expected + i } else { 0 };
        }
        assert_eq!(word.load(Relaxed), expected, "{id}");
    }
    assert_eq!(memory[199].load(Relaxed), 9);
    let resources = Resources::default().storage(0, 0, NO_WORDS);
    run(source, Entry::EntryPoint("main"), &inputs, 192, &resources, Derivatives::Zero).expect("writes nothing");
}

/// Lanes that only help with derivatives, and those that were discarded, write nothing.
#[test]
fn helpers_write_nothing() {
    let source = "
        @group(0) @binding(0) var<storage, read_write> list: array<f32>;
        @fragment
        fn main(@location(0) x: f32) -> @location(0) vec4f {
            let d = dpdx(x);
            if x == 4.0 { discard; }
            list[u32(x)] = d;
            return vec4f(d);
        }";
    let memory = words(16);
    let resources = Resources::default().storage(0, 0, &memory);
    let (x, step) = ([0.0_f32, 4.0, 8.0], [1.0_f32]);
    let derivatives = Derivatives::Given { ddx: &[Column::Float(&step)], ddy: &[Column::Float(&step)] };
    run(source, Entry::EntryPoint("main"), &[Column::Float(&x)], 3, &resources, derivatives).expect("runs");
    let found: Vec<f32> = memory.iter().map(|word| f32::from_bits(word.load(Relaxed))).collect();
    let mut expected = [0.0; 16];
    (expected[0], expected[8]) = (1.0, 1.0);
    assert_eq!(found, expected);
}

#[test]
fn a_buffer_that_is_only_read_is_not_written() {
    let source = "@group(0) @binding(1) var<storage, read_write> list: array<f32>; fn f(i: u32) { list[i] = 1.0; }";
    let resources = Resources::default().buffer(0, 1, &[0; 16]);
    let inputs = [Column::<f32>::Word(&[0])];
    let error = run(source, Entry::Function("f"), &inputs, 1, &resources, Derivatives::Zero).expect_err("refused");
    assert_eq!(
        error.to_string(),
        "the resource `list` at @group(0) @binding(1) is written: add it as storage, not as a buffer"
    );
}
