//! `halfvector render --backend reference`: needs no GPU.

use crate::Folder;

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
