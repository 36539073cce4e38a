//! `halfvector bake`: what it writes, what it says, what it refuses.

use super::Folder;

/// Numbers of a KTX2 file's header from byte 12: format, size of type, width, height, depth, layers, faces, levels.
fn header(bytes: &[u8]) -> Vec<u32> {
    bytes[12..44].chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().expect("four bytes"))).collect()
}

/// An HDR file of one colour.
fn write_hdr(folder: &Folder, name: &str, width: usize, height: usize, texel: [u8; 4]) {
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    bytes.extend(texel.repeat(width * height));
    std::fs::write(folder.path(name), bytes).expect("written");
}

#[test]
fn levels_irradiance_and_harmonics() {
    let folder = Folder::new();
    write_hdr(&folder, "grey.hdr", 8, 4, [64, 64, 64, 137]);
    let run = folder
        .run(&[
            "bake",
            "grey.hdr",
            "-o",
            "out/grey.ktx2",
            "--size",
            "32",
            "--irradiance",
            "diffuse.ktx2",
            "--sh",
            "sh.json",
        ])
        .ends(0)
        .says("out/grey.ktx2: 32 texels");
    assert!(run.stdout.is_empty() && !run.stderr.contains('\r'), "no progress in a pipe: {}", run.stderr);
    let read = |name: &str| std::fs::read(folder.path(name)).expect("written");
    let levels = read("out/grey.ktx2");
    assert_eq!(header(&levels)[..7], [97, 2, 32, 32, 0, 0, 6]);
    assert!(levels.windows(20).any(|text| text == b"halfvector.roughness"));
    assert_eq!(header(&read("diffuse.ktx2")), [97, 2, 192, 192, 0, 0, 6, 1]);
    let sh: serde_json::Value = serde_json::from_slice(&read("sh.json")).expect("JSON");
    let grey = sh["irradiance_over_pi_folded"][0][1].as_f64().expect("a number");
    assert!((grey - 128.0).abs() < 0.01, "{grey}");
    assert_eq!(std::fs::read_dir(folder.path("out")).expect("a folder").count(), 1, "no temporary file is left");
    // The same again gives the same bytes, and a baked file keeps its levels.
    folder.run(&["bake", "grey.hdr", "-o", "again.ktx2", "--size", "32", "--backend", "cpu"]).ends(0);
    folder.run(&["bake", "again.ktx2", "-o", "kept.ktx2"]).ends(0);
    assert!(read("again.ktx2") == levels && read("kept.ktx2") == levels);
}

#[test]
fn a_gpu_bakes_when_it_is_asked_to() {
    let folder = Folder::new();
    let run = folder.run(&["bake", "studio", "-o", "gpu.ktx2", "--size", "16", "--backend", "gpu"]);
    if run.code == Some(0) {
        folder.run(&["bake", "studio", "-o", "cpu.ktx2", "--size", "16", "--backend", "cpu"]).ends(0);
        let read = |name: &str| std::fs::read(folder.path(name)).expect("written");
        assert_eq!(header(&read("gpu.ktx2")), header(&read("cpu.ktx2")));
    } else {
        run.ends(1).says("no GPU was found").says("--backend cpu");
    }
}

#[test]
fn formats_and_levels_as_asked() {
    let folder = Folder::new();
    let read = |name: &str| std::fs::read(folder.path(name)).expect("written");
    let bake = |more: &[&str]| folder.run(&[&["bake", "white", "--quality", "preview"], more].concat());
    for (texels, format) in [("rgba16f", 97), ("rgba32f", 109), ("rgb9e5", 123)] {
        bake(&["-o", "x.ktx2", "--size", "16", "--roughness", "0.3,0.6", "--texels", texels])
            .ends(0)
            .says("2 levels for roughness 0.300 0.600");
        assert_eq!(header(&read("x.ktx2"))[..8], [format, if format == 97 { 2 } else { 4 }, 16, 16, 0, 0, 6, 2]);
    }
    bake(&["-o", "x.ktx2", "--size", "16", "--levels", "3"]).ends(0);
    assert_eq!(header(&read("x.ktx2"))[7], 3);
    bake(&["-o", "x.exr", "--size", "16"]).ends(0);
    assert!(read("x.exr").starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    bake(&["-o", "x.hdre", "--size", "16"]).ends(0).says("6 levels for roughness 0.000 0.200");
    let hdre = read("x.hdre");
    assert_eq!(hdre.len(), 256 + 16 * 6 * (256 + 5 * 64));
    // An HDRE file is kept as it is when an HDRE file is wanted.
    folder.run(&["bake", "x.hdre", "-o", "y.hdre"]).ends(0).says("kept as they are");
    assert!(read("y.hdre") == hdre);
}

#[test]
fn pictures_of_every_layout() {
    let folder = Folder::new();
    let out = ["-o", "x.ktx2", "--quality", "preview", "--levels", "2"];
    let bake = |name: &str| folder.run(&[&["bake", name], out.as_slice()].concat());
    write_hdr(&folder, "cross.hdr", 32, 24, [1, 2, 3, 136]);
    bake("cross.hdr").ends(0).says("a horizontal cross").says("8 texels");
    write_hdr(&folder, "odd.hdr", 32, 10, [1, 2, 3, 136]);
    folder.run(&["bake", "odd.hdr", "-o", "x.ktx2", "--size", "8"]).ends(0).says("taken as an equirectangular map");
    for face in ["px", "nx", "py", "ny", "pz", "nz"] {
        bake("face_%s.hdr").ends(1).says("six faces").says(&format!("face_{face}.hdr"));
        write_hdr(&folder, &format!("face_{face}.hdr"), 8, 8, [1, 2, 3, 136]);
    }
    bake("face_%s.hdr").ends(0).says("8 texels");
}

#[test]
fn wrong_input_says_what_to_do() {
    let folder = Folder::new();
    folder.write("text.hdr", "not a picture");
    folder.write("short.hdr", "#?RADIANCE\n\n-Y 4 +X 8\n");
    folder.write("empty.exr", "");
    let bake = |more: &[&str]| folder.run(&[&["bake"], more].concat());
    bake(&["text.hdr", "-o", "x.ktx2"]).ends(1).says("text.hdr").says("Radiance .hdr, OpenEXR, HDRE, KTX2, PNG, JPEG");
    bake(&["short.hdr", "-o", "x.ktx2"]).ends(1).says("line 0");
    bake(&["empty.exr", "-o", "x.ktx2"]).ends(1).says("empty");
    bake(&["none.hdr", "-o", "x.ktx2"]).ends(1).says("none.hdr");
    bake(&["none", "-o", "x.ktx2"]).ends(2).says("nothing to bake");
    bake(&["white", "-o", "x.png"]).ends(2).says(".ktx2, .hdre or .exr");
    bake(&["white", "-o", "x.ktx2", "--irradiance", "x.ktx2"]).ends(2).says("one file");
    bake(&["white", "-o", "x.ktx2", "--irradiance", "y.hdre"]).ends(2).says("six levels");
    bake(&["white", "-o", "x.hdre", "--levels", "5"]).ends(2).says("six levels");
    bake(&["white", "-o", "x.ktx2", "--size", "8", "--levels", "5"]).ends(2).says("4 at most");
    bake(&["white", "-o", "x.ktx2", "--size", "0"]).ends(2);
    bake(&["white", "-o", "x.ktx2", "--levels", "2", "--roughness", "0,1"]).ends(2);
    bake(&["white", "-o", "x.ktx2", "--roughness", "1,0"]).ends(2).says("rise");
    bake(&["white", "-o", "x.ktx2", "--quality", "perfect"]).ends(2).says("preview, default and best");
    assert!(!folder.path("x.ktx2").exists());
}
