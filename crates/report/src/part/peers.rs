//! Other programs at the same work: measured in this run where they are installed, else as recorded once, with day and machine.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use halfvector_brdf::Real;
use halfvector_brdf::batch::kernels::SpecularEval;
use halfvector_brdf::batch::{Kernel, Simd};
use halfvector_ibl::{BakeOptions, LoadedEnvironment, Source, bake, sky};

use super::shaders::default_surface;
use crate::placed::Columns;
use crate::timing::{SITTINGS, measured, median};
use crate::{Effort, Row};

/// Mitsuba 3's rates on one core, where the project lies.
const MITSUBA: &str = "benches/peers/mitsuba_brdf.py";

/// MaterialX's shader, counted.
const MATERIAL_X: &str = "benches/peers/materialx_shader.py";

/// Measures the part.
pub fn rows(effort: Effort) -> Vec<Row> {
    let mut rows = lobes(effort);
    rows.extend(bakes(effort));
    rows.extend(shaders(effort));
    rows
}

/// MaterialX's generator and ours at a surface that nobody has touched: instructions of the fragment stage.
fn shaders(effort: Effort) -> [Row; 2] {
    const WORK: &str = "the fragment stage of a surface with its default values under one light and a prefiltered environment, after \
                        spirv-opt -O";
    let measured = (effort == Effort::Full).then(material_x).flatten();
    let when = match measured {
        Some(_) => "measured in this run",
        None => "recorded on 2026-11-23",
    };
    let (theirs, milliseconds, ours) = measured.unwrap_or((4045, 13.3, 208));
    let row = |method: &str, what: &str, instructions: u64| {
        let mut row = Row::new("peer", method, &format!("{WORK}; {what}; {when}"));
        row.instructions = Some(instructions);
        row
    };
    let mut other = row("MaterialX 1.39", "its standard surface, values as uniforms", theirs);
    other.cost_ns = Some(milliseconds * 1e6);
    [row("our shader", "what the values do not need is left out", ours), other]
}

/// Instructions of MaterialX's shader, the milliseconds of its generator, instructions of ours; none where MaterialX, its
/// script or the tools that it calls are not there.
fn material_x() -> Option<(u64, f64, u64)> {
    let folder = std::env::temp_dir().join(format!("halfvector-report-shader-{}", std::process::id()));
    std::fs::create_dir_all(&folder).ok()?;
    let path = folder.join("ours.spv");
    std::fs::write(&path, default_surface()?).ok()?;
    let output = Command::new("python3").arg(MATERIAL_X).arg(&path).stderr(Stdio::null()).output();
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    let text = String::from_utf8(output.ok()?.stdout).ok()?;
    let mut numbers = text.split_whitespace();
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

/// One evaluation of a metal's lobe among many, on one core.
fn lobes(effort: Effort) -> Vec<Row> {
    const WORK: &str = "evaluation of a GGX metal with RGB reflectance, one of many, on one core";
    let mut row = Row::new("peer", "our batches", &format!("{WORK}; measured in this run"));
    our_evaluation(effort, &mut row);
    let measured = (effort == Effort::Full).then(mitsuba).flatten();
    let domain = match measured {
        Some(_) => format!("{WORK}; measured in this run, LLVM backend"),
        None => format!(
            "{WORK}; recorded on 2026-11-22, Intel Xeon of family 6, model 207 at 3.0 GHz: 239 million a second"
        ),
    };
    let mut other = Row::new("peer", "Mitsuba 3", &domain);
    other.cost_batch_ns = Some(measured.unwrap_or(1e3 / 239.0));
    vec![row, other]
}

/// Puts the time of one of our evaluations into the row.
fn our_evaluation(effort: Effort, row: &mut Row) {
    const COUNT: usize = 4096;
    #[derive(Clone, Copy)]
    struct Metal;
    impl Kernel<10, 3> for Metal {
        #[inline(always)]
        fn call<R: Real>(&self, input: [R; 10]) -> [R; 3] {
            SpecularEval.call(input)
        }
    }
    let number = |k: usize, g: f64| ((0.5 + g * k as f64).fract()) as f32;
    let column = |i: usize| -> Vec<f32> {
        let steps = [0.754_877_666, 0.569_840_291, 0.618_033_989, 0.414_213_562, 0.732_050_808, 0.236_067_977, 0.0];
        (0..COUNT)
            .map(|k| match i {
                2 | 5 => 0.2 + 0.6 * number(k, steps[i]),
                0 | 1 | 3 | 4 => 0.5 * number(k, steps[i]),
                6 => 0.25,
                i => [0.9, 0.6, 0.3][i - 7],
            })
            .collect()
    };
    let columns: [Vec<f32>; 10] = std::array::from_fn(column);
    let inputs: [Columns<10>; SITTINGS] =
        std::array::from_fn(|sitting| Columns::read(columns.each_ref().map(Vec::as_slice), sitting));
    let mut out: [Columns<3>; SITTINGS] = std::array::from_fn(|sitting| Columns::written(COUNT, sitting));
    let mut run = |sitting: usize| {
        let equal = Simd::best().run(&Metal, inputs[sitting].slices(), out[sitting].slices_mut());
        assert!(equal.is_ok(), "columns of one length");
        f64::from(out[sitting].slices()[0][COUNT / 2])
    };
    row.take_batch_time(measured(&mut [&mut run], effort.pick(200, 2000))[0], COUNT);
}

/// Nanoseconds of one of Mitsuba's evaluations; none where it or its script is not there.
fn mitsuba() -> Option<f64> {
    let output = Command::new("python3").args([MITSUBA, "--rates"]).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let rate: f64 = text.split_whitespace().next()?.parse().ok()?;
    output.status.success().then_some(1e3 / rate)
}

/// Bakes of the same map, in turns with Filament's tool.
fn bakes(effort: Effort) -> Vec<Row> {
    const WORK: &str = "bake of the sky to faces of 256 texels, processor time of all cores";
    let environment = sky();
    let folder = std::env::temp_dir().join(format!("halfvector-report-{}", std::process::id()));
    let Some(map) = write_hdr(&environment, folder.clone()) else { return Vec::new() };
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..effort.pick(1, 5) {
        let before = processor_seconds(false);
        let baked = bake(&environment, &BakeOptions { size: 256, ..BakeOptions::default() });
        std::hint::black_box(baked.irradiance_sh[0]);
        ours.extend(seconds_since(before, false));
        let before = processor_seconds(true);
        let made = Command::new("cmgen")
            .args(["--quiet", "--size=256", "--ibl-samples=1024"])
            .arg(format!("--ibl-ld={}", folder.display()))
            .arg(&map)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        if made.is_ok_and(|status| status.success()) {
            theirs.extend(seconds_since(before, true));
        }
    }
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    let row = |method: &str, what: &str, seconds: Vec<f64>| {
        let mut row = Row::new("peer", method, &format!("{WORK}; {what}; measured in this run"));
        row.cost_ns = (!seconds.is_empty()).then(|| median(seconds) * 1e9);
        row.cost_ns.is_some().then_some(row)
    };
    let rows = [
        row("our bake", "levels, irradiance and harmonics", ours),
        row("Filament's cmgen", "its levels alone, 1,024 samples", theirs),
    ];
    rows.into_iter().flatten().collect()
}

fn seconds_since(before: Option<f64>, children: bool) -> Option<f64> {
    Some(processor_seconds(children)? - before?)
}

/// User and system time of this process, or of the children it has waited for: proc(5) of Linux, in hundredths; none elsewhere.
fn processor_seconds(children: bool) -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name in parentheses may hold spaces; what follows it starts with field 3.
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    let first = if children { 16 } else { 14 };
    Some((ticks(first)? + ticks(first + 1)?) / 100.0)
}

/// An equirectangular map as `sky.hdr` in a folder, a Radiance file without compression; none for other sources, and where
/// the folder cannot be written.
pub fn write_hdr(environment: &LoadedEnvironment, folder: PathBuf) -> Option<PathBuf> {
    let Source::Equirect(map) = &environment.source else { return None };
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", map.height, map.width).into_bytes();
    for &[r, g, b] in &map.pixels {
        let most = r.max(g).max(b);
        let exponent = if most > 1e-30 { most.log2().floor() as i32 + 1 } else { -127 };
        let scale = (8.0 - exponent as f32).exp2();
        bytes.extend([r, g, b].map(|x| (x * scale) as u8));
        bytes.push((exponent + 128) as u8);
    }
    std::fs::create_dir_all(&folder).ok()?;
    let path = folder.join("sky.hdr");
    std::fs::write(&path, bytes).ok()?;
    Some(path)
}
