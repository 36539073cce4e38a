//! CPU seconds of a bake against cmgen (Filament's tool, Debian package `libfilament-tools`): the same map, 256-texel
//! faces, interleaved runs, medians. cmgen's time is for its levels alone; ours has levels, irradiance and harmonics. Where the
//! program is built (`cargo build --release`), its preview counts, too, as a whole: start, reading, baking, writing.
//!
//! `cargo bench -p halfvector-benches --bench prefilter_peers [-- FILE.hdr]`; without a file, the sky of this project.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use halfvector_ibl::{BakeOptions, Equirect, LoadedEnvironment, Quality, bake};
use halfvector_report::part::peers::write_hdr;

/// Runs of each; the median counts.
const RUNS: usize = 3;

fn main() {
    memory();
    let file = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).map(PathBuf::from);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (environment, path) = match file {
        Some(path) => {
            let bytes = std::fs::read(&path).expect("the file can be read");
            (halfvector_ibl::load(&bytes, &path.display().to_string()).expect("an environment"), path)
        }
        None => {
            let sky = halfvector_ibl::sky();
            let path = write_hdr(&sky, folder.path().to_owned()).expect("the temporary folder can be written");
            (sky, path)
        }
    };
    let program = std::env::current_exe().ok().and_then(|path| Some(path.ancestors().nth(2)?.join("halfvector")));
    let mut seconds = [const { Vec::new() }; 5];
    for _ in 0..RUNS {
        for (times, quality) in seconds.iter_mut().zip([Quality::Preview, Quality::Default, Quality::Best]) {
            let irradiance_size = quality.irradiance_size();
            let options = BakeOptions { size: 256, irradiance_size, quality, ..BakeOptions::default() };
            let before = cpu_seconds(false);
            let baked = bake(&environment, &options);
            times.push(cpu_seconds(false) - before);
            assert!(baked.radiance.len() > 1);
        }
        if let Some(program) = program.as_ref().filter(|program| program.is_file()) {
            let before = cpu_seconds(true);
            let out = |name: &str| folder.path().join(name);
            let made = Command::new(program)
                .arg("bake")
                .arg(&path)
                .args(["--size", "256", "--quality", "preview", "--backend", "cpu", "-o"])
                .arg(out("levels.ktx2"))
                .arg("--irradiance")
                .arg(out("diffuse.ktx2"))
                .arg("--sh")
                .arg(out("sh.json"))
                .stderr(Stdio::null())
                .status();
            assert!(made.is_ok_and(|status| status.success()), "the program bakes");
            seconds[4].push(cpu_seconds(true) - before);
        }
        let before = cpu_seconds(true);
        let made = Command::new("cmgen")
            .args(["--quiet", "--size=256", "--ibl-samples=1024"])
            .arg(format!("--ibl-ld={}", folder.path().display()))
            .arg(&path)
            .stdout(Stdio::null())
            .status();
        match made {
            Ok(status) if status.success() => seconds[3].push(cpu_seconds(true) - before),
            _ => println!("cmgen is not installed, or failed: its row is left out"),
        }
    }
    let medians = seconds.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied()
    });
    for (name, time) in
        ["preview", "default", "best", "cmgen, 1,024 samples, levels alone", "the program, preview"].iter().zip(medians)
    {
        if let (Some(time), Some(cmgen)) = (time, medians[3]) {
            println!("{name}: {time:.2} CPU s, 1/{:.1} of cmgen", cmgen / time);
        } else if let Some(time) = time {
            println!("{name}: {time:.2} CPU s");
        }
    }
}

/// The most memory that a bake of an 8,192 x 4,096 map to 512-texel faces takes, as a multiple of the map itself.
fn memory() {
    let map = Equirect::from_fn(8192, 4096, |dir| dir.map(|x| (1.0 + x) as f32));
    let bytes = (map.pixels.len() * size_of::<[f32; 3]>()) as f64;
    let environment = LoadedEnvironment::from(map);
    let baked = bake(&environment, &BakeOptions::default());
    assert!(baked.radiance.len() > 1);
    let status = std::fs::read_to_string("/proc/self/status").expect("a Linux machine");
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("proc(5)");
    let most: f64 = most.trim().trim_end_matches(" kB").parse().expect("a number");
    println!("8,192 x 4,096 to 512: at most {:.2} times the map's {:.0} MB", most * 1024.0 / bytes, bytes / 1e6);
}

/// User and system time of this process, or of the children it has waited for, in seconds (Linux: proc(5), in hundredths).
fn cpu_seconds(children: bool) -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").expect("a Linux machine");
    // The name in parentheses may hold spaces; what follows it starts with field 3.
    let fields: Vec<&str> = stat.rsplit(')').next().expect("a name").split_whitespace().collect();
    let ticks = |field: usize| fields[field - 3].parse::<f64>().expect("a number");
    let first = if children { 16 } else { 14 };
    (ticks(first) + ticks(first + 1)) / 100.0
}
