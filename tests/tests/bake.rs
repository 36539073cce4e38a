//! Environments baked on a GPU against the same on the CPU.

use halfvector_ibl::{BakeOptions, BakedEnvironment, Cube, bake, load, studio};

use crate::support::{data, renderer};

/// Largest root mean square difference of a level, relative to max(CPU, 1e-3 of the mean radiance).
const RMS: f64 = 0.005;

/// Root mean square difference of two cubes, relative to the second.
fn difference(a: &Cube, b: &Cube, mean: f64) -> f64 {
    let pairs = a.texels.as_flattened().iter().zip(b.texels.as_flattened());
    let squares: f64 = pairs.map(|(&a, &b)| (f64::from(a - b) / f64::from(b).max(1e-3 * mean)).powi(2)).sum();
    (squares / (3 * a.texels.len()) as f64).sqrt()
}

fn compare(name: &str, gpu: &BakedEnvironment, cpu: &BakedEnvironment) {
    let last = cpu.radiance.last().expect("levels");
    let mean = f64::from(last.texels.as_flattened().iter().sum::<f32>()) / (3 * last.texels.len()) as f64;
    assert_eq!(gpu.roughness, cpu.roughness);
    for (level, roughness) in cpu.roughness.iter().enumerate() {
        let rms = difference(&gpu.radiance[level], &cpu.radiance[level], mean);
        let slopes = gpu.slope[level].iter().zip(&cpu.slope[level]);
        let worst = slopes.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        println!("{name}, roughness {roughness:.3}: {:.3} % rms, slope {worst:.3} at most", 100.0 * rms);
        assert!(rms < RMS, "{name}, roughness {roughness}: {rms}");
        assert!(worst < 0.1, "{name}, roughness {roughness}: slopes differ by {worst}");
    }
    let rms = difference(&gpu.irradiance_over_pi, &cpu.irradiance_over_pi, mean);
    println!("{name}, irradiance: {:.3} % rms", 100.0 * rms);
    assert!(rms < RMS, "{name}, irradiance: {rms}");
    for (a, b) in gpu.irradiance_sh.as_flattened().iter().zip(cpu.irradiance_sh.as_flattened()) {
        assert!(f64::from(a - b).abs() < 1e-4 * mean, "{name}: harmonics {a} and {b}");
    }
}

#[test]
fn gpu_and_cpu_bake_alike() {
    let Some(renderer) = renderer() else { return };
    let options = BakeOptions { size: 64, irradiance_size: 16, ..BakeOptions::default() };
    let check = |name: &str, environment| {
        let gpu = renderer.bake(&environment, &options, |_| ()).expect("baked");
        compare(name, &gpu, &bake(&environment, &options));
    };
    check("studio", studio());
    for name in ["bpy_city", "bpy_night", "bpy_interior", "bpy_studio"] {
        let Some(file) = data(&format!("env/{name}.exr")) else { return };
        check(name, load(&std::fs::read(&file).expect("readable"), "a.exr").expect("an environment"));
    }
}
