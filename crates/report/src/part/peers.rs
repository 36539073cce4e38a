//! Other programs at the same work: measured in this run where they are installed, else as recorded once, with the day, the machine,
//! and why they are not measured here.
//!
//! What Python has to run travels with the program: it does not matter where the report is started.

mod programs;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use halfvector_brdf::Real;
use halfvector_brdf::batch::kernels::SpecularEval;
use halfvector_brdf::batch::{Kernel, Simd};
use halfvector_ibl::{BakeOptions, Cube, LoadedEnvironment, Quadrature, Source, bake, sky};
use rayon::prelude::*;

use self::programs::{Generated, generated, mitsuba_rate, optimised_instructions};
use super::ibl::add;
use super::levels::texel_centre;
use super::shaders::default_surface;
use crate::error::Errors;
use crate::placed::Columns;
use crate::timing::{SITTINGS, measured, median};
use crate::{Effort, Row, Run};

/// When and where the figures of peers that are not there were recorded.
const RECORDED: &str = "2026-11-23, Intel(R) Xeon(R) Processor, 2 cores, linux";

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let effort = run.effort();
    let mut rows = lobes(run);
    run.keep(&rows, 0.3);
    rows.extend(shaders());
    run.keep(&rows, 0.5);
    rows.extend(bakes(effort, "cmgen"));
    rows
}

/// The row of another program: what was measured of it, or what was recorded and why it is not measured.
fn other<T>(mut row: Row, measured: Result<T, String>, recorded: T, fill: impl Fn(&mut Row, T)) -> Row {
    match measured {
        Ok(figures) => fill(&mut row, figures),
        Err(why) => {
            fill(&mut row, recorded);
            row.recorded = Some(RECORDED.to_owned());
            row.note = Some(
                [row.note, Some(format!("not measured in this run: {why}"))]
                    .into_iter()
                    .flatten()
                    .collect::<Vec<_>>()
                    .join("; "),
            );
        }
    }
    row
}

/// MaterialX's generator and ours at a surface that nobody has touched: instructions of the fragment stage.
fn shaders() -> [Row; 3] {
    const WORK: &str = "the fragment stage of a surface with its default values under one light and a prefiltered environment, after \
                        spirv-opt -O";
    let ours = |method: &str, how: &str, exposed: bool| {
        let mut row = Row::new("peer", method, &format!("{WORK}; {how}"));
        let spirv = default_surface(exposed).ok_or_else(|| "no shader was made".to_owned());
        match spirv.and_then(|spirv| optimised_instructions(&spirv)) {
            Ok(count) => row.instructions = Some(count),
            Err(why) => row.note = Some(format!("not counted: {why}")),
        }
        row
    };
    // The one with uniforms is set beside the other generator's, which has uniforms, too; the shorter one beside that.
    let specialised = ours("our specialised shader", "what the values do not need is left out", false);
    let ours = ours("our shader", "values as uniforms", true);
    let mut theirs = Row::new("peer", "MaterialX", &format!("{WORK}; its standard surface, values as uniforms"));
    theirs.note = Some("the time is that of its generator, from the surface to the text of the shader".to_owned());
    let recorded = Generated { version: "1.39.5".to_owned(), milliseconds: 12.9, instructions: 4045 };
    let theirs = other(theirs, generated(), recorded, |row, found| {
        row.instructions = Some(found.instructions);
        row.cost_ns = Some(found.milliseconds * 1e6);
        row.note = Some(format!("version {}; {}", found.version, row.note.clone().unwrap_or_default()));
    });
    [specialised, ours, theirs]
}

/// One evaluation of a metal's lobe among many, on one core.
fn lobes(run: &Run<'_>) -> Vec<Row> {
    const WORK: &str = "evaluation of a GGX metal with RGB reflectance, one of many, on one core";
    let mut row = Row::new("peer", "our batches", WORK);
    our_evaluation(run.effort(), &mut row);
    run.keep(std::slice::from_ref(&row), 0.1);
    let theirs = Row::new("peer", "Mitsuba 3", &format!("{WORK}; its LLVM backend"));
    // 209 million a second.
    let recorded = ("3.9.1".to_owned(), 209.0);
    let theirs = other(theirs, mitsuba_rate(run.effort().pick(10, 35)), recorded, |row, (version, rate)| {
        row.cost_batch_ns = Some(1e3 / rate);
        row.note = Some(format!("version {version}"));
    });
    vec![row, theirs]
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

/// Faces of a cube as Filament names its files, in our order.
const FACES: [&str; 6] = ["px", "nx", "py", "ny", "pz", "nz"];

/// Levels of an environment: the perceptual roughness of each, and the radiance in a direction of the map.
struct Levels {
    /// Faces' texels along an edge, roughness, and the cube.
    levels: Vec<(usize, f64, Cube)>,
    /// Which directions of the map a direction of the cube is.
    in_map: fn([f64; 3]) -> [f64; 3],
}

/// Bakes of the same map, in turns with Filament's tool, a program of this name, and the error of each at texel centres of its levels.
fn bakes(effort: Effort, cmgen: &str) -> Vec<Row> {
    const WORK: &str = "bake of the sky to faces of 256 texels, processor time of all cores, levels of roughness >= 0.2 at texel centres";
    const AGAINST: &str = "relative error against a sum over texels of the same file";
    let folder = std::env::temp_dir().join(format!("halfvector-report-{}", std::process::id()));
    let Some(map) = write_hdr(&sky(), folder.clone()) else { return Vec::new() };
    // Both read the same file, which holds eight bits of each number.
    let read = std::fs::read(&map).ok().and_then(|bytes| halfvector_ibl::load(&bytes, "sky.hdr").ok());
    let Some(environment) = read else { return Vec::new() };
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let mut absent = None;
    let mut baked = None;
    for round in 0..effort.pick(3, 5) {
        let before = processor_seconds(false);
        let made = bake(&environment, &BakeOptions { size: 256, ..BakeOptions::default() });
        ours.extend(seconds_since(before, false));
        baked = Some(made);
        // Filament's tool takes ten seconds: once is enough for a quick look.
        if effort == Effort::Quick && round > 0 {
            continue;
        }
        let before = processor_seconds(true);
        let made = Command::new(cmgen)
            .args(["--quiet", "--size=256", "--ibl-samples=1024", "--no-mirror", "--format=exr"])
            .arg(format!("--ibl-ld={}", folder.display()))
            .arg(&map)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        match made {
            Ok(status) if status.success() => theirs.extend(seconds_since(before, true)),
            Ok(status) => absent = Some(format!("cmgen ended with {status}")),
            Err(error) => absent = Some(format!("cmgen could not be started ({error}); Filament's releases have it")),
        }
    }
    let our_levels = baked.map(|baked| Levels {
        levels: baked
            .radiance
            .into_iter()
            .zip(baked.roughness)
            .map(|(cube, r)| (cube.size, f64::from(r), cube))
            .collect(),
        in_map: |dir| dir,
    });
    let their_levels = filament_levels(&folder.join("sky"));
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    let Source::Equirect(map) = &environment.source else { return Vec::new() };
    let truth = Quadrature::new(map);
    let row = |method: &str, what: &str, seconds: &[f64], levels: Option<Levels>| {
        let mut row = Row::new("peer", method, &format!("{WORK}; {what}; {AGAINST}"));
        let least = seconds.iter().copied().fold(f64::INFINITY, f64::min);
        row.cost_ns = least.is_finite().then_some(least * 1e9);
        row.cost_spread = (seconds.len() > 2).then(|| median(seconds.to_vec()) / least - 1.0);
        if let Some(levels) = levels {
            levels.errors(&truth, effort.pick(24, 400)).fill(&mut row);
        }
        row
    };
    let ours = row("our bake", "levels, irradiance and harmonics", &ours, our_levels);
    let made = if theirs.is_empty() { Err(absent.unwrap_or("nothing was timed".to_owned())) } else { Ok(None) };
    let unread = their_levels.is_none().then(|| "it wrote no levels that can be read".to_owned());
    let mut theirs = row("Filament's cmgen", "its levels alone, 1,024 samples", &theirs, their_levels);
    theirs.note = unread.filter(|_| made.is_ok());
    // Seconds, and the errors.
    let recorded = Some([9.58, 0.0406, 0.187]);
    let theirs = other(theirs, made, recorded, |row, figures| {
        let Some([seconds, rms, largest]) = figures else { return };
        (row.cost_ns, row.error_rms, row.error_max) = (Some(seconds * 1e9), Some(rms), Some(largest));
    });
    vec![ours, theirs]
}

impl Levels {
    /// At evenly spread texel centres of all levels but the first, as the part of light has them.
    fn errors(&self, truth: &Quadrature, count: usize) -> Errors {
        let mut errors = Errors::default();
        let places = (0..count).filter_map(|k| Some((k, self.levels.get(1 + k % (self.levels.len() - 1))?)));
        let places: Vec<_> = places.filter(|(_, (_, roughness, _))| *roughness >= 0.19).collect();
        let expected: Vec<[f64; 3]> = places
            .par_iter()
            .map(|(k, (size, roughness, _))| truth.prefiltered((self.in_map)(texel_centre(*size, *k)), *roughness))
            .collect();
        for ((k, (size, roughness, cube)), expected) in places.into_iter().zip(expected) {
            let dir = texel_centre(*size, k);
            add(&mut errors, cube.sample(dir), expected, truth.mean(), || {
                format!("roughness = {roughness:?}, direction = {dir:?}")
            });
        }
        errors
    }
}

/// The levels that cmgen wrote, faces as files; none where they are not there. Level l of n has 1 - sqrt(1 - l / (n - 1)) as perceptual
/// roughness, and x and z are exchanged beside our maps' frame (Guy and Agopian 2018, "Physically Based Rendering in Filament").
fn filament_levels(folder: &Path) -> Option<Levels> {
    let level = |number: usize| -> Option<Cube> {
        let face = |name: &&str| std::fs::read(folder.join(format!("m{number}_{name}.exr"))).ok();
        let files: Vec<Vec<u8>> = FACES.iter().filter_map(face).collect();
        let files: [Vec<u8>; 6] = files.try_into().ok()?;
        match halfvector_ibl::load_faces(files.each_ref().map(|bytes| (bytes.as_slice(), "face.exr"))).ok()?.source {
            Source::Levels(stored) => stored.levels.into_iter().next(),
            Source::Equirect(_) => None,
        }
    };
    let cubes: Vec<Cube> = (0..16).map_while(level).collect();
    let last = cubes.len().checked_sub(1).filter(|last| *last > 0)? as f64;
    let roughness = |number: usize| 1.0 - (1.0 - number as f64 / last).sqrt();
    let levels = cubes.into_iter().enumerate().map(|(number, cube)| (cube.size, roughness(number), cube)).collect();
    Some(Levels { levels, in_map: |[x, y, z]| [z, y, x] })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::ibl::unit;

    /// Filament's tool is run where there is one: its time is that of this run, and what it wrote is judged.
    #[cfg(unix)]
    #[test]
    fn a_tool_that_is_there_is_run() {
        use std::os::unix::fs::PermissionsExt;
        let absent = bakes(Effort::Quick, "no-such-cmgen");
        assert!(absent[1].recorded.is_some() && absent[1].error_rms.is_some(), "{absent:?}");
        assert!(absent[1].note.as_deref().is_some_and(|note| note.contains("not measured in this run")), "{absent:?}");

        let folder = std::env::temp_dir().join(format!("halfvector-report-cmgen-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let tool = folder.join("cmgen");
        // Takes its time, and writes nothing.
        std::fs::write(&tool, "#!/bin/sh\ni=0\nwhile [ $i -lt 100000 ]; do i=$((i+1)); done\n").expect("a script");
        std::fs::set_permissions(&tool, std::fs::Permissions::from_mode(0o755)).expect("a script");
        let rows = bakes(Effort::Quick, &tool.to_string_lossy());
        let _ = std::fs::remove_dir_all(&folder);
        let theirs = &rows[1];
        assert!(theirs.recorded.is_none() && theirs.error_rms.is_none(), "{theirs:?}");
        assert_eq!(theirs.note.as_deref(), Some("it wrote no levels that can be read"));
        if cfg!(target_os = "linux") {
            assert!(theirs.cost_ns.is_some_and(|time| time < 9e9), "{theirs:?}");
        }
        assert!(rows[0].error_rms.is_some_and(|error| error < 1e-3), "{rows:?}");
    }

    /// What is exact has no error, in whatever frame its cube is; another frame has one.
    #[test]
    fn levels_are_judged_in_the_frame_of_the_map() {
        let map = halfvector_ibl::Equirect::from_fn(128, 64, |[x, y, z]| [2.0 + x, 2.0 + y, 2.0 + z].map(|v| v as f32));
        let truth = Quadrature::new(&map);
        let levels = |in_map: fn([f64; 3]) -> [f64; 3]| {
            let cube = |size: usize, roughness: f64| {
                let texel = |k: usize| {
                    let place = |i: usize| (2.0 * i as f64 + 1.0) / size as f64 - 1.0;
                    let dir =
                        halfvector_ibl::direction_from_face(k / (size * size), place(k % size), place(k / size % size));
                    truth.prefiltered(in_map(unit(dir)), roughness).map(|x| x as f32)
                };
                (size, roughness, Cube { size, texels: (0..6 * size * size).map(texel).collect() })
            };
            Levels { levels: vec![cube(8, 0.0), cube(4, 0.5)], in_map }
        };
        let exchanged = levels(|[x, y, z]| [z, y, x]);
        assert!(exchanged.errors(&truth, 24).max() < 1e-5, "{:?}", exchanged.errors(&truth, 24));
        let wrong = Levels { in_map: |dir| dir, ..exchanged };
        assert!(wrong.errors(&truth, 24).max() > 0.05);
    }
}
