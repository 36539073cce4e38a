//! Against the tables of `data/ibl`: light of real environments reflected by single-scattering GGX, by brute force in f64
//! with each texel constant. A pixel of one point: a camera far along v that looks at the sphere's point n.

use halfvector_reference::{EnvironmentFilter, Picture, Reference, RenderOptions};
use halfvector_scene::{BuiltinMesh, Camera};

use crate::{color, data, is_full, number, scene};

/// Error bar of the tables: relative, and at grazing view and roughness 0.1.
const BAR: f64 = 1e-4;
const GRAZING_BAR: f64 = 2e-3;
/// Up to this roughness it is open which of box and bilinear a texel means: their gap counts where it is larger.
const OPEN_ROUGHNESS: f64 = 0.1;

#[test]
fn the_tables_of_reflected_light() {
    let Some(folder) = data("ibl") else { return };
    for name in ["bpy_city", "bpy_interior", "bpy_night", "bpy_studio"] {
        let Some(environment) = data(&format!("env/{name}.exr")) else { return };
        let bytes = std::fs::read(environment).expect("the environment");
        let light = halfvector_ibl::load(&bytes, name).expect("an environment");
        let table = std::fs::read_to_string(folder.join(format!("{name}_full.csv"))).expect("the table");
        let (step, samples) = if is_full() { (1, 262_144) } else { (17, 16_384) };
        let (mut worst, mut square, mut count) = (0.0_f64, 0.0, 0);
        for line in table.lines().skip(1).step_by(step) {
            let fields: Vec<&str> = line.split(',').collect();
            let x = |i: usize| fields[i].parse::<f64>().expect("a number");
            // The tables' frame is ours with x and z exchanged.
            let (n, v) = ([x(7), x(6), x(5)], [x(10), x(9), x(8)]);
            let (n_dot_v, roughness, expected) = (x(11), x(12), [x(13), x(14), x(15)]);
            let base = if fields[0] == "gold" { [x(1), x(2), x(3)] } else { [0.0; 3] };
            let values = [
                ("base_color", color(base)),
                ("metallic", number(f64::from(u8::from(fields[0] == "gold")))),
                ("perceptual_roughness", number(roughness)),
            ];
            let mut scene = scene(BuiltinMesh::Sphere, &values, &[]);
            let place = |t: f64| glam::DVec3::from(std::array::from_fn(|i| n[i] + t * v[i])).as_vec3();
            let up = if v[1].abs() > 0.9 { glam::Vec3::X } else { glam::Vec3::Y };
            scene.camera = Camera { position: place(4.0), target: place(0.0), up, vertical_fov: 1e-3 };
            let render = |environment_filter| {
                let options = RenderOptions { width: 4, height: 4, environment_filter, ..RenderOptions::default() };
                let mut reference = Reference::new(&scene, Some(&light), options).expect("a sound scene");
                reference.add_samples(samples / 16, &|_| {}).expect("rendered");
                reference.picture()
            };
            let mean = |picture: &Picture, c: usize| picture.pixels.iter().map(|pixel| pixel[c]).sum::<f64>() / 16.0;
            let picture = render(EnvironmentFilter::Box);
            let other = (roughness <= OPEN_ROUGHNESS).then(|| render(EnvironmentFilter::Bilinear));
            for c in 0..3 {
                let gap = other.as_ref().map_or(0.0, |other| (mean(other, c) - mean(&picture, c)).abs());
                let mean = mean(&picture, c);
                let error =
                    picture.standard_error.iter().flatten().map(|error| error[c].powi(2)).sum::<f64>().sqrt() / 16.0;
                let bar = if n_dot_v < 0.3 { GRAZING_BAR } else { BAR };
                let bar = (bar * expected[c]).max(gap);
                let z = ((mean - expected[c]).abs() - bar).max(0.0) / error;
                let plain = (mean - expected[c]) / error.hypot(bar);
                worst = worst.max(z);
                square += plain * plain;
                count += 1;
                assert!(z < 5.0, "{name}: {line}: {mean} +- {error} against {}", expected[c]);
            }
        }
        let rms = (square / f64::from(count)).sqrt();
        println!("{name}: {count} numbers, {samples} paths each, z rms {rms:.2}, largest beyond the bar {worst:.2}");
    }
}
