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
    assert_eq!(header(&read("diffuse.ktx2")), [97, 2, 448, 448, 0, 0, 6, 1]);
    let sh: serde_json::Value = serde_json::from_slice(&read("sh.json")).expect("JSON");
    let grey = sh["irradiance_over_pi_folded"][0][1].as_f64().expect("a number");
    assert!((grey - 128.0).abs() < 0.01, "{grey}");
    assert_eq!(std::fs::read_dir(folder.path("out")).expect("a folder").count(), 1, "no temporary file is left");
    // The same again gives the same bytes, and a baked file keeps its levels.
    folder.run(&["bake", "grey.hdr", "-o", "again.ktx2", "--size", "32", "--backend", "cpu"]).ends(0);
    folder.run(&["bake", "again.ktx2", "-o", "kept.ktx2"]).ends(0);
    assert!(read("again.ktx2") == levels && read("kept.ktx2") == levels);
    // Baked anew with fewer texels than its levels need, it gets as many as there is room for.
    folder.run(&["bake", "again.ktx2", "-o", "small.ktx2", "--size", "4"]).ends(0);
    assert_eq!(header(&read("small.ktx2")), [97, 2, 4, 4, 0, 0, 6, 3]);
    folder
        .run(&["bake", "grey.hdr", "-o", "nine.ktx2", "--size", "32", "--texels", "rgb9e5"])
        .ends(0)
        .says("rgb9e5 has no room for the slopes");
    folder.run(&["bake", "nine.ktx2", "-o", "small.ktx2", "--size", "4"]).ends(0);
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
    bake(&["-o", "x.png", "--size", "16", "--irradiance", "diffuse.png"]).ends(0);
    // White, six faces wide and 16 + 8 + 4 + 2 + 1 rows high; what no level covers is black.
    let strip = image::load_from_memory(&read("x.png")).expect("a picture").into_rgb8();
    assert_eq!(strip.dimensions(), (96, 31));
    assert!(strip.get_pixel(95, 15)[0] > 200 && strip.get_pixel(47, 16)[0] > 200 && strip.get_pixel(48, 16)[0] == 0);
    let diffuse = image::load_from_memory(&read("diffuse.png")).expect("a picture").into_rgb8();
    assert_eq!((diffuse.width(), diffuse.get_pixel(0, 0)), (6 * diffuse.height(), strip.get_pixel(0, 0)));
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
    bake(&["white", "-o", "x.jpg"]).ends(2).says(".ktx2, .hdre, .exr or .png");
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

/// A name that is too long for a file fails when it is written: the first file is not left alone.
#[test]
fn all_files_or_none() {
    let folder = Folder::new();
    let long = format!("{}.json", "x".repeat(300));
    folder.run(&["bake", "white", "-o", "x.ktx2", "--size", "8", "--sh", &long]).ends(1).says("could not be written");
    let left = std::fs::read_dir(folder.path(".")).expect("a folder").flatten();
    assert!(left.into_iter().all(|file| file.file_name() == "plain.material.json"), "files are left");
}

/// Radiance of the test's environment: each axis has its colour, and a lamp stands aside of all of them.
fn light([x, y, z]: [f64; 3]) -> [f64; 3] {
    let lamp = 6.0 * (20.0 * (0.6 * x + 0.48 * y + 0.64 * z - 1.0)).exp();
    [0.6 + 0.5 * x + lamp, 0.6 + 0.5 * y + lamp, 0.6 + 0.5 * z + 0.5 * lamp]
}

/// Writes an HDR file of what `direction(column, row)` says, in texels.
fn write_light(
    folder: &Folder,
    name: &str,
    [width, height]: [usize; 2],
    direction: impl Fn(f64, f64) -> Option<[f64; 3]>,
) {
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    for k in 0..width * height {
        let color = match direction((k % width) as f64 + 0.5, (k / width) as f64 + 0.5) {
            Some(dir) => {
                let length = dir.iter().map(|x| x * x).sum::<f64>().sqrt();
                light(dir.map(|x| x / length))
            }
            None => [0.0; 3],
        };
        let exponent = color.into_iter().fold(1e-9, f64::max).log2().floor() as i32 + 1;
        bytes.extend(color.map(|x| (x * f64::from(8 - exponent).exp2()) as u8));
        bytes.push((128 + exponent) as u8);
    }
    std::fs::write(folder.path(name), bytes).expect("written");
}

/// A ball under a map, under its bake, under a cross and under six faces that show the same: one picture.
#[test]
fn a_ball_looks_the_same_under_every_form() {
    let folder = Folder::new();
    folder.write(
        "ball.material.json",
        r#"{"halfvector": 1, "name": "ball",
          "nodes": {"surface": {"node": "surface/surface",
            "values": {"base_color": [1, 1, 1], "metallic": 1, "perceptual_roughness": 0.25}}}, "links": []}"#,
    );
    write_light(&folder, "map.hdr", [256, 128], |column, row| {
        // The middle column is +X, and azimuth rises towards +Z.
        let (phi, theta) = ((column / 256.0 - 0.5) * std::f64::consts::TAU, row / 128.0 * std::f64::consts::PI);
        Some([theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()])
    });
    // What a GPU finds at (s, t), s to the right and t down, on +X -X +Y -Y +Z -Z.
    let on_face = |face: usize, s: f64, t: f64| match face {
        0 => [1.0, -t, -s],
        1 => [-1.0, -t, s],
        2 => [s, 1.0, t],
        3 => [s, -1.0, -t],
        4 => [s, -t, 1.0],
        _ => [-s, -t, -1.0],
    };
    let place = |x: f64| 2.0 * (x / 64.0).fract() - 1.0;
    for (face, name) in ["px", "nx", "py", "ny", "pz", "nz"].iter().enumerate() {
        write_light(&folder, &format!("face_{name}.hdr"), [64, 64], |i, j| Some(on_face(face, place(i), place(j))));
    }
    write_light(&folder, "cross.hdr", [256, 192], |i, j| {
        let face = match ((i / 64.0) as usize, (j / 64.0) as usize) {
            (1, 0) => 2,
            (1, 2) => 3,
            (column, 1) => [1, 4, 0, 5][column],
            _ => return None,
        };
        Some(on_face(face, place(i), place(j)))
    });
    folder.run(&["bake", "map.hdr", "-o", "map.ktx2", "--size", "256"]).ends(0);
    let mut pictures = Vec::new();
    for environment in ["map.hdr", "map.ktx2", "cross.hdr", "face_%s.hdr"] {
        let arguments = ["render", "ball.material.json", "--env", environment, "--size", "48x48", "-o", "ball.exr"];
        let run = folder.run(&arguments);
        if run.lacks_gpu() {
            return;
        }
        run.ends(0);
        pictures.push(image::open(folder.path("ball.exr")).expect("a picture").into_rgb32f());
    }
    let mean = pictures[0].as_raw().iter().sum::<f32>() / pictures[0].as_raw().len() as f32;
    for (picture, form) in pictures[1..].iter().zip(["the bake", "the cross", "the faces"]) {
        let difference = |a: &image::Rgb32FImage, b: &image::Rgb32FImage| {
            let squares: f32 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| (a - b).powi(2)).sum();
            (squares / a.as_raw().len() as f32).sqrt() / mean
        };
        let found = difference(&pictures[0], picture);
        let mirrored = difference(&image::imageops::flip_horizontal(&pictures[0]), picture);
        println!("{form}: {:.3} % rms from the map, {:.1} % from its mirror image", 100.0 * found, 100.0 * mirrored);
        assert!(found < 0.01 && mirrored > 0.1, "{form}: {found}, {mirrored}");
    }
}
