//! `halfvector compare`: figures, heat map, and the mistakes.

use crate::Folder;

fn png(folder: &Folder, name: &str, size: [u32; 2], color: [u8; 4]) {
    let picture = image::RgbaImage::from_pixel(size[0], size[1], image::Rgba(color));
    picture.save(folder.path(name)).expect("written");
}

fn exr(folder: &Folder, name: &str, color: [f32; 3]) {
    let picture = image::Rgb32FImage::from_pixel(12, 8, image::Rgb(color));
    picture.save(folder.path(name)).expect("written");
}

#[test]
fn figures_and_a_heat_map() {
    let folder = Folder::new();
    png(&folder, "black.png", [12, 8], [0, 0, 0, 255]);
    png(&folder, "white.png", [12, 8], [255; 4]);
    let same = folder.run(&["compare", "white.png", "white.png", "--format", "json"]).ends(0).json();
    assert_eq!((same["flip"]["mean"].as_f64(), same["rmse"].as_f64()), (Some(0.0), Some(0.0)));
    let run = folder.run(&["compare", "black.png", "white.png", "-o", "heat.png", "--format", "json"]).ends(0);
    let far = run.json();
    assert!((far["flip"]["mean"].as_f64().expect("FLIP") - 0.967_386_5).abs() < 1e-4, "{far}");
    assert_eq!((far["rmse"].as_f64(), far["flip"]["kind"].as_str()), (Some(1.0), Some("ldr")));
    let heat = image::open(folder.path("heat.png")).expect("the heat map").into_rgb8();
    assert!(heat.dimensions() == (12, 8) && heat.get_pixel(3, 3)[1] > 200);
    let text = folder.run(&["compare", "black.png", "white.png"]).ends(0).stdout;
    assert!(text.contains("FLIP (LDR)") && text.contains("RMSE"), "{text}");

    exr(&folder, "one.exr", [1.0; 3]);
    exr(&folder, "more.exr", [1.01; 3]);
    let bright = folder.run(&["compare", "more.exr", "one.exr", "--format", "json"]).ends(0).json();
    assert!((bright["mean_relative"].as_f64().expect("a mean") - 0.01).abs() < 1e-6, "{bright}");
    assert_eq!(bright["flip"]["kind"].as_str(), Some("hdr"));
}

/// Pictures of the reference know their noise: what it adds is taken off, and what it looks like is told.
#[test]
fn noise_that_is_known_is_no_difference() {
    let folder = Folder::new();
    for (name, seed) in [("a.exr", "1"), ("b.exr", "2")] {
        let plain = ["render", "plain.material.json", "--backend", "reference", "--size", "24x24"];
        folder.run(&[&plain[..], &["--samples", "64", "--seed", seed, "-o", name]].concat()).ends(0);
    }
    let noisy = folder.run(&["compare", "a.exr", "b.exr", "--format", "json"]).ends(0).json();
    let figure = |name: &str| noisy[name].as_f64().unwrap_or_else(|| panic!("{name}: {noisy}"));
    assert!(figure("rmse") < 0.5 * figure("standard_error") && figure("standard_error") > 0.0, "{noisy}");
    let (flip, of_noise) = (noisy["flip"]["mean"].as_f64(), noisy["flip"]["of_noise"].as_f64());
    let ratio = flip.expect("FLIP") / of_noise.expect("of noise");
    assert!((0.85..1.18).contains(&ratio), "{noisy}");
    // One rule for all figures: noise is no error, and what it hides is bounded.
    assert_eq!((figure("rmse"), figure("relative")), (0.0, 0.0), "{noisy}");
    for name in ["rmse", "relative"] {
        let [most, with] = ["at_most", "with_noise"].map(|end| figure(&format!("{name}_{end}")));
        assert!(most > 0.0 && most < with, "{noisy}");
    }
    assert!(figure("mean_relative").abs() < 4.0 * figure("mean_relative_standard_error"), "{noisy}");
    let text = folder.run(&["compare", "a.exr", "b.exr"]).ends(0).stdout;
    assert!(text.matches("chance may explain all").count() == 2, "{text}");
    assert!(text.contains("taken off RMSE") && text.contains("FLIP of noise"), "{text}");
    // A light that is a twentieth brighter hides in the noise of each pixel, and not in their mean.
    for (name, seed, light) in [("dim.exr", "1", "1"), ("same.exr", "2", "1"), ("bright.exr", "3", "1.05")] {
        let lit = ["render", "plain.material.json", "--backend", "reference", "--size", "32x32", "--env", "none"];
        let light = format!("directional:1,1,1:{light}");
        folder.run(&[&lit[..], &["--light", &light, "--samples", "8", "--seed", seed, "-o", name]].concat()).ends(0);
    }
    for (name, is_equal) in [("same.exr", true), ("bright.exr", false)] {
        let json = folder.run(&["compare", name, "dim.exr", "--format", "json"]).ends(0).json();
        let figure = |name: &str| json[name].as_f64().unwrap_or_else(|| panic!("{name}: {json}"));
        let (mean, of_mean) = (figure("mean_relative"), figure("mean_relative_standard_error"));
        assert_eq!(mean.abs() < 3.0 * of_mean, is_equal, "{name}: {json}");
        assert_eq!((figure("rmse") == 0.0, figure("relative") == 0.0), (is_equal, is_equal), "{name}: {json}");
    }
}

/// Two estimates of one seed have most of their noise in common: what they differ by is no sum of two noises.
#[test]
fn shared_noise_is_not_taken_off() {
    let folder = Folder::new();
    for (name, light) in [("a.exr", "point:2,2,2:100"), ("b.exr", "point:2,2,2:110")] {
        let plain = ["render", "plain.material.json", "--backend", "reference", "--size", "16x16", "--samples", "16"];
        folder.run(&[&plain[..], &["--seed", "7", "--light", light, "-o", name]].concat()).ends(0);
    }
    let run = folder.run(&["compare", "a.exr", "b.exr", "--format", "json"]).ends(0).says("--seed 7");
    let json = run.json();
    assert_eq!(json["shared_seed"], 7);
    assert!(json["standard_error"].is_null() && json["rmse"].as_f64() > Some(0.0), "{json}");
    assert!(json["flip"]["of_noise"].is_null(), "{json}");
}

#[test]
fn alpha_and_a_black_reference_are_told() {
    let folder = Folder::new();
    png(&folder, "black.png", [12, 8], [0, 0, 0, 255]);
    png(&folder, "clear.png", [12, 8], [0, 0, 0, 0]);
    let run = folder.run(&["compare", "clear.png", "black.png", "--format", "json"]).ends(0).json();
    assert_eq!((run["alpha"]["pixels"].as_u64(), run["alpha"]["largest"].as_f64()), (Some(96), Some(1.0)), "{run}");
    assert!(run["mean_relative"].is_null() && run["relative"].is_null() && run["standard_error"].is_null(), "{run}");
    let text = folder.run(&["compare", "clear.png", "black.png"]).ends(0).stdout;
    assert!(
        text.contains("relative error   none: the reference is black")
            && text.contains("alpha            differs in 96 pixels"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_compared() {
    let folder = Folder::new();
    png(&folder, "a.png", [12, 8], [9; 4]);
    png(&folder, "b.png", [8, 12], [9; 4]);
    exr(&folder, "c.exr", [1.0; 3]);
    exr(&folder, "nan.exr", [f32::NAN; 3]);
    folder.run(&["compare", "a.png", "b.png"]).ends(1).says("8 x 12 pixels").says("12 x 8");
    folder.run(&["compare", "a.png", "c.exr"]).ends(1).says("one file holds display values, the other radiance");
    folder.run(&["compare", "c.exr", "nan.exr"]).ends(1).says("not finite").says("column 0, row 0");
    folder.run(&["compare", "a.png", "none.png"]).ends(1).says("none.png");
    folder.run(&["compare", "a.png", "plain.material.json"]).ends(1).says(".png, .exr or .hdr");
    folder.run(&["compare", "a.png", "a.png", "-o", "heat.exr"]).ends(2).says(".png");
    folder.run(&["compare", "a.png"]).ends(2);
    // Folders are made as other commands make them.
    folder.run(&["compare", "a.png", "a.png", "-o", "new/heat.png"]).ends(0);
    assert!(folder.path("new/heat.png").is_file());
    exr(&folder, "negative.exr", [-1.0; 3]);
    folder.run(&["compare", "negative.exr", "c.exr"]).ends(0).says("288 numbers are negative");
}
