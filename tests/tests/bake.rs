//! Environments baked on a GPU against the same on the CPU.

use halfvector_ibl::{BakeOptions, LevelMap, Source, bake, load};

use crate::support::{data, renderer};

/// Largest root mean square difference of a level, relative to max(CPU, 1e-3 of the mean radiance).
const RMS: f64 = 0.005;

#[test]
fn gpu_and_cpu_filter_alike() {
    let Some(renderer) = renderer() else { return };
    for name in ["bpy_city", "bpy_night"] {
        let Some(file) = data(&format!("env/{name}.exr")) else { return };
        let loaded = load(&std::fs::read(&file).expect("readable"), "a.exr").expect("an environment");
        let Source::Equirect(map) = &loaded.source else { panic!("{name} is no map") };
        let roughness = [0.0, 0.2, 0.4, 0.7, 1.0];
        let options =
            BakeOptions { size: 64, level_map: LevelMap::Listed(roughness.to_vec()), ..BakeOptions::default() };
        let cpu = bake(&loaded, &options);
        let lobes: Vec<_> = (1..5).map(|i| (f64::from(roughness[i]).powi(2), cpu.radiance[i].size)).collect();
        let gpu = renderer.filtered(map, &lobes).expect("filtered");
        let mean = map.mean();
        for (level, cube) in gpu.iter().enumerate() {
            let mut squares = 0.0;
            for (a, b) in cube.texels.iter().zip(&cpu.radiance[level + 1].texels) {
                for c in 0..3 {
                    let (a, b) = (f64::from(a[c]), f64::from(b[c]));
                    squares += ((a - b) / b.max(1e-3 * mean[c])).powi(2);
                }
            }
            let rms = (squares / (3 * cube.texels.len()) as f64).sqrt();
            println!("{name}, roughness {}: {:.3} % rms", roughness[level + 1], 100.0 * rms);
            assert!(rms < RMS, "{name}: {rms}");
        }
    }
}
