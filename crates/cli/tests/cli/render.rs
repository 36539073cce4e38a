//! `halfvector render`: its files, and what it does without a display or a GPU.

use std::path::Path;
use std::process::Command;

use crate::{Folder, Run};

#[test]
fn render_writes_each_format_and_leaves_nothing_else() {
    let folder = Folder::new();
    let options = ["--size", "12x8", "--samples", "3", "--env", "white", "--set", "metallic=1"];
    for name in ["a.png", "deep/er/a.exr", "a.hdr"] {
        let mut arguments = vec!["render", "plain.material.json", "-o", name];
        arguments.extend(options);
        let run = folder.run(&arguments);
        if run.lacks_gpu() {
            return;
        }
        let run = run.ends(0).says("4 are taken instead of 3");
        assert!(run.stdout.is_empty());
        let picture = image::open(folder.path(name)).expect("a picture");
        assert_eq!((picture.width(), picture.height()), (12, 8));
    }
    assert_eq!(folder.names(), ["a.hdr", "a.png", "deep", "plain.material.json"]);
}

#[test]
fn alpha_is_straight_in_a_png() {
    let folder = Folder::new();
    let arguments = [
        "render",
        "plain.material.json",
        "-o",
        "a.png",
        "--size",
        "16x16",
        "--env",
        "white",
        "--background",
        "none",
        "--set",
        "base_color=1,1,1",
        "--tone-map",
        "none",
    ];
    let run = folder.run(&arguments);
    if run.lacks_gpu() {
        return;
    }
    run.ends(0);
    let picture = image::open(folder.path("a.png")).expect("a picture").into_rgba8();
    assert_eq!(picture.get_pixel(0, 0).0, [0; 4]);
    assert_eq!(picture.get_pixel(8, 8)[3], 255);
    let edge = picture.pixels().find(|p| (20..235).contains(&p[3])).expect("a pixel that is partly covered");
    assert!(edge[0] > 200, "the colour is not darkened by the coverage: {edge:?}");
}

#[test]
fn without_a_display_the_start_material_is_drawn() {
    let folder = Folder::new();
    let run = folder.run(&[]).says("there is no display");
    assert!(folder.path("out/example.wgsl").is_file());
    if run.lacks_gpu() {
        return;
    }
    run.ends(0);
    let picture = image::open(folder.path("out/example.png")).expect("a picture");
    assert!(picture.width() >= 256);
}

/// Runs the program with no GPU to be found.
fn without_a_driver(folder: &Folder, arguments: &[&str]) -> Run {
    let nowhere = Path::new("/nonexistent");
    let output = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(arguments)
        .current_dir(folder.0.path())
        .env("VK_DRIVER_FILES", nowhere)
        .env("VK_ICD_FILENAMES", nowhere)
        .env("WGPU_BACKEND", "vulkan")
        .output()
        .expect("the program starts");
    Run::new(arguments, &output)
}

#[test]
fn without_a_gpu_the_cpu_draws_and_says_so() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let folder = Folder::new();
    let render = ["render", "plain.material.json", "--env", "white", "--size", "16x16", "-o"];
    without_a_driver(&folder, &[&render[..], &["gpu.png", "--backend", "gpu"]].concat())
        .ends(1)
        .says("mesa-vulkan-drivers")
        .says("--backend cpu");
    assert_eq!(folder.names(), ["plain.material.json"]);
    without_a_driver(&folder, &[&render[..], &["auto.png"]].concat())
        .ends(0)
        .says("drawn on the CPU")
        .says("mesa-vulkan-drivers");
    folder.run(&[&render[..], &["cpu.png", "--backend", "cpu"]].concat()).ends(0).says("drawn by the CPU");
    let bytes = |name: &str| std::fs::read(folder.path(name)).expect("a picture");
    assert_eq!(bytes("auto.png"), bytes("cpu.png"));
}
