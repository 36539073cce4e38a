//! `halfvector render --backend reference`: needs no GPU.

use crate::Folder;

const SURFACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/surface.material.json");

#[test]
fn the_reference_renders_without_a_gpu() {
    let folder = Folder::new();
    let render = |name: &str, more: &[&str]| {
        let plain = [
            "render",
            "plain.material.json",
            "--backend",
            "reference",
            "--size",
            "12x10",
            "--samples",
            "5",
            "-o",
            name,
        ];
        folder.run(&[&plain, more].concat())
    };
    render("a.exr", &["--seed", "7"]).ends(0).says("standard error").says("drawn by the reference");
    render("b.exr", &["--seed", "7"]).ends(0);
    render("c.exr", &["--seed", "8", "--bounces", "2"]).ends(0);
    let bytes = |name: &str| std::fs::read(folder.path(name)).expect("the picture");
    assert!(bytes("a.exr") == bytes("b.exr") && bytes("a.exr") != bytes("c.exr"));
    // A Lambert of albedo 0.5, 0.2, 0.1 under light of 1 from everywhere, before nothing.
    let white =
        ["--env", "white", "--background", "none", "--method", "coupling=none", "--method", "compensation=none"];
    render("white.exr", &white).ends(0);
    let picture = image::open(folder.path("white.exr")).expect("the picture").into_rgba32f();
    let (middle, corner) = (picture.get_pixel(6, 5), picture.get_pixel(0, 0));
    assert!(middle[3] == 1.0 && middle[0] > 0.5 && middle[2] < 0.2 && corner.0 == [0.0; 4], "{middle:?} {corner:?}");
    render("shown.png", &[]).ends(0);
    render("coded.png", &["--method", "encode=report"]).ends(1).says("encode=report");
    // Others' models: the filter of a map and a measured metal. Of a light that is the same everywhere the filter shows nothing.
    let metal = ["--env", "white", "--background", "none", "--method", "compensation=none", "--set", "metallic=1"];
    let metal = |name: &str, more: &[&str]| {
        let surface = ["render", SURFACE, "--backend", "reference", "--size", "9x9", "--samples", "64", "-o", name];
        folder.run(&[&surface[..], &metal, more].concat())
    };
    let smooth = ["--set", "perceptual_roughness=0.1"];
    metal("gold.exr", &[&smooth[..], &["--conductor", "0.143,0.375,1.442:3.983,2.386,1.603"]].concat()).ends(0);
    let gold = image::open(folder.path("gold.exr")).expect("the picture").into_rgb32f();
    // What it reflects upright: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    let upright = [(0.143, 3.983), (0.375, 2.386), (1.442, 1.603)]
        .map(|(n, k): (f32, f32)| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k));
    for (found, wanted) in gold.get_pixel(4, 4).0.into_iter().zip(upright) {
        assert!((found - wanted).abs() < 0.01, "{found} {wanted}");
    }
    for filter in ["bilinear", "box", "vertex-rows"] {
        render("filtered.exr", &["--env", "studio", "--env-filter", filter]).ends(0);
    }
    render("a.exr", &["--env-filter", "nearest"]).ends(2).says("bilinear, box or vertex-rows");
    for wrong in ["1,1,1", "1,1,1:0,0", "0,1,1:1,1,1", "1,1,1:-1,0,0", "1,1,1:NaN,0,0", "1,1,1:inf,0,0"] {
        render("a.exr", &["--conductor", wrong]).ends(2).says("N_R,N_G,N_B:K_R,K_G,K_B");
    }
    let elsewhere = ["render", "plain.material.json", "--backend", "cpu", "--size", "4x4", "-o", "plain.png"];
    folder.run(&[&elsewhere[..], &["--env-filter", "box"]].concat()).ends(0).says("--env-filter does nothing here");
    // One path has no spread: nothing is said of its noise but that it is not known. Two have one, of which it is said how rough it is.
    let two = ["--samples", "2", "--seed", "3"];
    let few = |name: &str, more: &[&str]| {
        let plain = ["render", "plain.material.json", "--backend", "reference", "--size", "12x10", "-o", name];
        folder.run(&[&plain[..], more].concat())
    };
    // Counts are asked for in words, negative ones, too.
    for (option, wrong, range) in [
        ("--samples", "-1", "from 1 to 1048576"),
        ("--samples", "1.5", "from 1 to 1048576"),
        ("--samples", "abc", "from 1 to 1048576"),
        ("--bounces", "-1", "from 0 to"),
        ("--seed", "-1", "from 0"),
    ] {
        let run = few("a.exr", &[option, wrong]).ends(2).says(&format!("write a whole number {range}"));
        assert!(!run.stderr.contains("unexpected argument") && run.stderr.contains(option), "{}", run.stderr);
    }
    few("one.exr", &["--samples", "1"]).ends(0).says("its noise is not known");
    few("two.exr", &two).ends(0).says("2 paths").says("about 71 % only");
    let compared = folder.run(&["compare", "one.exr", "two.exr", "--format", "json"]).ends(0);
    let json =
        compared.says("one.exr: drawn with one path").says("two.exr: the standard error of a pixel of 2 paths").json();
    assert!(json["standard_error"].is_null() && json["rmse"].as_f64() > Some(0.0), "{json}");
    // Not an abort for want of memory; and more paths than a grid has.
    let other = |size: &str, samples: &str| {
        let plain = ["render", "plain.material.json", "--backend", "reference", "-o", "other.exr"];
        folder.run(&[&plain[..], &["--size", size, "--samples", samples]].concat())
    };
    other("16384x16384", "1").ends(1).says("16384 x 16384").says("2^25 pixels");
    other("4x4", "5000").ends(0).says("5000 paths");
    let grid = ["render", "plain.material.json", "--backend", "cpu", "--samples", "5000", "-o", "grid.png"];
    folder.run(&grid).ends(2).says("more than 4096").says("--backend reference");
}
