//! The interpreter's speed: scalar components of naga expressions per second on one core, beside the same function in
//! Rust. After criterion's own lines one of each function says both and their ratio. Counted are the expressions that a lane evaluates and that are work: arithmetic, comparisons, functions,
//! selections. Names, constants, swizzles and constructors count nothing.

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfvector_brdf::frame::Frame;
use halfvector_brdf::ggx;
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_interp::{Column, Derivatives, Entry, Limits, Outputs, Program, Resources};
use halfvector_maps::{color, normal};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Expression, Module, Statement, TypeInner};

const ROWS: usize = 1 << 14;

/// What the interpreter is to do at least [operations/s].
const BAR: f64 = 300e6;

/// Work of one call of a function, by component.
fn work(module: &Module, info: &naga::valid::ModuleInfo, name: &str) -> u64 {
    let (handle, _) = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(name)).expect("the function");
    work_of(module, info, handle)
}

fn work_of(module: &Module, info: &naga::valid::ModuleInfo, handle: naga::Handle<naga::Function>) -> u64 {
    let function = &module.functions[handle];
    function.body.iter().map(|s| work_of_statement(module, info, handle, s)).sum()
}

fn work_of_statement(
    module: &Module,
    info: &naga::valid::ModuleInfo,
    handle: naga::Handle<naga::Function>,
    statement: &Statement,
) -> u64 {
    let function = &module.functions[handle];
    match statement {
        Statement::Emit(range) => range
            .clone()
            .map(|expression| {
                let components = match info[handle][expression].ty.inner_with(&module.types) {
                    TypeInner::Scalar(_) => 1,
                    TypeInner::Vector { size, .. } => *size as u64,
                    TypeInner::Matrix { columns, rows, .. } => *columns as u64 * *rows as u64,
                    _ => 0,
                };
                match function.expressions[expression] {
                    Expression::Unary { .. }
                    | Expression::Binary { .. }
                    | Expression::Select { .. }
                    | Expression::Math { .. }
                    | Expression::Relational { .. }
                    | Expression::As { .. } => components,
                    _ => 0,
                }
            })
            .sum(),
        // Both ways count half: lanes take one of them.
        Statement::If { accept, reject, .. } => {
            let block = |b: &naga::Block| b.iter().map(|s| work_of_statement(module, info, handle, s)).sum::<u64>();
            (block(accept) + block(reject)) / 2
        }
        Statement::Block(block) => block.iter().map(|s| work_of_statement(module, info, handle, s)).sum(),
        Statement::Call { function, .. } => work_of(module, info, *function),
        _ => 0,
    }
}

fn numbers(seed: usize) -> Vec<f32> {
    (0..ROWS).map(|i| 0.05 + 0.9 * (((i * 7 + seed * 13) as f64) * 0.618_033_988_749_895).fract() as f32).collect()
}

/// A function of numbers to numbers, as Rust has it.
type Native = fn(&[f32]) -> [f32; 3];

/// Three numbers from `at` on.
fn three(x: &[f32], at: usize) -> [f32; 3] {
    [x[at], x[at + 1], x[at + 2]]
}

/// The functions that are measured, with their twins where calling those is one line.
const FUNCTIONS: &[(&str, Option<Native>)] = &[
    ("d_ggx", Some(|x| [ggx::d_ggx(x[0], x[1], x[2]); 3])),
    (
        "specular_eval",
        Some(|x| {
            let frame = Frame { normal: three(x, 0), view_dir: three(x, 3), n_dot_v: x[6] };
            specular_eval(frame, three(x, 7), Specular { f0: three(x, 10), f90: three(x, 13), alpha: x[16] })
        }),
    ),
    ("srgb_from_linear", Some(|x| color::srgb_from_linear(three(x, 0)))),
    ("tone_map_agx", None),
    ("normal_rotation_report", Some(|x| normal::normal_rotation_report(three(x, 0), three(x, 3)))),
];

/// The fastest of some runs [s].
fn fastest(mut run: impl FnMut()) -> f64 {
    let times = (0..200).map(|_| {
        let begin = Instant::now();
        run();
        begin.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}

fn bench(c: &mut Criterion) {
    let source: String = halfvector_shaders::FILES
        .iter()
        .filter(|f| !f.path.starts_with("nodes/") && !f.path.starts_with("entry/"))
        .map(|f| f.source)
        .collect();
    let module = naga::front::wgsl::parse_str(&source).expect("the library parses");
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).expect("and is valid");
    for (name, native) in FUNCTIONS {
        let program = Program::compile(&module, &info, Entry::Function(name)).expect("supported");
        let columns: Vec<Vec<f32>> = (0..program.inputs().len()).map(numbers).collect();
        let inputs: Vec<Column<'_, f32>> = columns.iter().map(|c| Column::Float(c)).collect();
        let mut group = c.benchmark_group("interp");
        let operations = work(&module, &info, name) * ROWS as u64;
        group.throughput(Throughput::Elements(operations));
        let mut machine = program.machine::<f32>(Limits::default()).expect("within limits");
        let mut outputs = Outputs::default();
        let mut interpreted = || {
            machine
                .run(black_box(&inputs), ROWS, &mut outputs, &Resources::default(), Derivatives::Zero)
                .expect("runs");
        };
        let width = columns.len();
        let rows: Vec<f32> = (0..ROWS * width).map(|i| columns[i % width][i / width]).collect();
        let mut results = vec![[0.0; 3]; ROWS];
        let mut natively = |native: Native| {
            for (result, row) in results.iter_mut().zip(black_box(&rows).chunks_exact(width)) {
                *result = native(row);
            }
            black_box(&results);
        };
        if let Some(native) = native {
            group.bench_function(format!("{name} in Rust"), |b| b.iter(|| natively(*native)));
        }
        group.bench_function(*name, |b| b.iter(&mut interpreted));
        let speed = operations as f64 / fastest(&mut interpreted);
        let beside = native.map(|native| {
            let native = operations as f64 / fastest(|| natively(native));
            format!("; native Rust {:.0} million, ratio {:.2}", native / 1e6, speed / native)
        });
        println!(
            "interp {name}: {:.0} million lane operations/s on one core in f32, {:.0} wanted{}",
            speed / 1e6,
            BAR / 1e6,
            beside.unwrap_or_default()
        );
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2)).warm_up_time(std::time::Duration::from_millis(500));
    targets = bench
}
criterion_main!(benches);
