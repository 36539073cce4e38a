//! Goldens drawn in three ways that give one picture: the WGSL by wgpu; the exported SPIR-V, which naga's `spv-in` reads
//! again, by wgpu; the exported GLSL ES 3.00 by WebGL 2 in a real browser.
//!
//! A browser is the judge of GLSL, and not a binding of GL in this process, because the workspace forbids `unsafe` and every call of
//! such a binding is; it compiles the exported text as it is, as WebGL wants it.
//!
//! Everything that the shaders read is made here and smooth, with one level for each image, so that devices which choose
//! levels and filter in their own way have nothing to differ in; a difference is then the text's.

mod device;
mod inputs;

use halfvector_codegen::target::{OutputFile, export, target};
use serde_json::{Value, json};

use crate::browser::{Browser, on_one_device};
use crate::golden::{Golden, goldens};
use device::Device;
use inputs::{Inputs, SIZE, sphere};

/// Codes of a channel that two pictures may be apart.
const APART: u8 = 1;

/// Holds two pictures (RGBA, 8 bits) against each other where both are covered, and says how they compare.
fn compare(golden: &str, way: &str, picture: &[u8], wgsl: &[u8]) -> [usize; 2] {
    assert_eq!(picture.len(), wgsl.len(), "{golden} by {way}");
    let pairs = || picture.chunks(4).zip(wgsl.chunks(4));
    let covered: Vec<_> = pairs().filter(|(a, b)| a[3] > 0 && b[3] > 0).collect();
    let edges = pairs().filter(|(a, b)| (a[3] > 0) != (b[3] > 0)).count();
    let difference = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let largest = covered.iter().map(difference).max().unwrap_or(0);
    let off = covered.iter().filter(|pair| difference(pair) > APART).count();
    let lit = wgsl.chunks(4).filter(|pixel| pixel[..3].iter().any(|c| *c > 8 && *c < 250)).count();
    assert!(lit > 40, "{golden}: a picture that shows nothing proves nothing: {lit} of its pixels are lit");
    println!(
        "{golden} by {way}: {off} of {} pixels are more than 1/255 apart, the most {largest}/255; {edges} at edges",
        covered.len()
    );
    assert!(covered.len() > 500 && edges * 20 <= covered.len(), "{golden} by {way}: the outlines differ");
    [off, covered.len()]
}

fn file<'f>(files: &'f [OutputFile], ending: &str) -> &'f [u8] {
    &files.iter().find(|file| file.name.ends_with(ending)).unwrap_or_else(|| panic!("no file {ending}")).bytes
}

fn exported(golden: &Golden, name: &str) -> Vec<OutputFile> {
    export(&golden.shader, target(name).expect("a target of the list"), "m")
        .unwrap_or_else(|e| panic!("{}: {e}", golden.name))
}

#[test]
fn spirv_draws_what_wgsl_draws() {
    let Some(device) = Device::open() else { return };
    let sphere = sphere();
    let (mut off, mut count) = (0, 0);
    for golden in goldens() {
        let inputs = Inputs::of(&golden);
        let wgsl = device.wgsl(&golden.shader.wgsl);
        let of_wgsl = device.draw([&wgsl, &wgsl], &golden, &inputs, &sphere);
        let files = exported(&golden, "spirv");
        let (vertex, fragment) = (device.spirv(file(&files, ".vert.spv")), device.spirv(file(&files, ".frag.spv")));
        let of_spirv = device.draw([&vertex, &fragment], &golden, &inputs, &sphere);
        let [more, pixels] = compare(&golden.name, "SPIR-V", &of_spirv, &of_wgsl);
        (off, count) = (off + more, count + pixels);
    }
    println!("SPIR-V on {}: {off} of {count} pixels are more than 1/255 apart", device.name);
    assert_eq!(off, 0, "SPIR-V draws another picture");
}

#[test]
fn glsl_es_draws_what_wgsl_draws() {
    let Some(device) = Device::open() else { return };
    let Some(mut browser) = Browser::open() else { return };
    let goldens = goldens();
    let sphere = sphere();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("index.html");
    let asked: Vec<Value> = goldens.iter().map(|golden| as_json(golden, &Inputs::of(golden))).collect();
    let data = json!({ "size": SIZE, "mesh": sphere.as_json(), "shaders": asked });
    let page = include_str!("page.html").replace("{DATA}", &data.to_string().replace('<', "\\u003c"));
    std::fs::write(&path, page).expect("written");
    let said = browser.page(&path, "", "[document.documentElement.dataset.error ?? '', document.body.textContent]");
    if said[0] == "no WebGL 2" {
        println!("skipped: the browser has no WebGL 2");
        return;
    }
    assert_eq!(said[0], "", "the browser has something against the GLSL");
    let pictures: Vec<&str> = said[1].as_str().expect("text").split_whitespace().collect();
    assert_eq!(pictures.len(), goldens.len());
    let (mut off, mut count) = (0, 0);
    for (golden, picture) in goldens.iter().zip(pictures) {
        let inputs = Inputs::of(golden);
        let wgsl = device.wgsl(&golden.shader.wgsl);
        let of_wgsl = device.draw([&wgsl, &wgsl], golden, &inputs, &sphere);
        let mut rows: Vec<&[u8]> = Vec::new();
        let bytes = inputs::bytes_of_hex(picture);
        // GL counts rows from below.
        rows.extend(bytes.chunks(SIZE as usize * 4).rev());
        let [more, pixels] = compare(&golden.name, "GLSL ES", &rows.concat(), &of_wgsl);
        (off, count) = (off + more, count + pixels);
    }
    println!("GLSL ES 3.00 by WebGL 2 beside {}: {off} of {count} pixels are more than 1/255 apart", device.name);
    // Devices filter images in their own way, and cut out at edges that lie between two pixels.
    let share = if on_one_device() { 5000 } else { 200 };
    assert!(off * share <= count, "GLSL draws another picture: {off} of {count} pixels");
}

/// A golden as the page takes it: both stages, and what each name in them is fed with.
fn as_json(golden: &Golden, inputs: &Inputs) -> Value {
    let files = exported(golden, "glsl-es");
    let text = |ending| String::from_utf8_lossy(file(&files, ending)).into_owned();
    let reflection: Value = serde_json::from_slice(file(&files, ".json")).expect("JSON");
    let glsl = &reflection["glsl"];
    let blocks = inputs.blocks.iter().map(|(binding, bytes)| {
        let names: Vec<&Value> = ["vert", "frag"].iter().map(|stage| &glsl[stage]["blocks"][&binding.name]).collect();
        json!({ "names": names, "bytes": inputs::hex(bytes) })
    });
    let textures = inputs.textures.iter().map(|(binding, texture)| {
        let samplers = ["vert", "frag"].into_iter().flat_map(|stage| glsl[stage]["samplers"].as_array());
        let names: Vec<&Value> =
            samplers.flatten().filter(|entry| entry["texture"] == binding.name).map(|entry| &entry["name"]).collect();
        let sampler = glsl_sampler(golden, glsl, &binding.name);
        json!({ "names": names, "texture": texture.as_json(), "sampler": sampler })
    });
    json!({
        "name": golden.name,
        "vertex": text(".vert"),
        "fragment": text(".frag"),
        "attributes": golden.shader.reflection.vertex_inputs.iter()
            .map(|input| json!({ "name": input.name, "location": input.location })).collect::<Vec<_>>(),
        "double_sided": golden.shader.reflection.double_sided,
        "blocks": blocks.collect::<Vec<_>>(),
        "textures": textures.collect::<Vec<_>>(),
    })
}

/// How the sampler that GLSL joins with a texture wraps and filters.
fn glsl_sampler(golden: &Golden, glsl: &Value, texture: &str) -> Value {
    let entries = ["vert", "frag"].into_iter().filter_map(|stage| glsl[stage]["samplers"].as_array()).flatten();
    let sampler = entries.filter(|entry| entry["texture"] == texture).find_map(|entry| entry["sampler"].as_str());
    let binding = golden.shader.reflection.bindings.iter().find(|binding| Some(binding.name.as_str()) == sampler);
    match binding.map(|binding| &binding.resource) {
        Some(halfvector_codegen::reflection::Resource::Sampler(source)) => {
            let [u, v, filter] = inputs::sampler(source);
            json!({ "u": u, "v": v, "filter": filter })
        }
        _ => panic!("{}: the texture {texture} has no sampler", golden.name),
    }
}
