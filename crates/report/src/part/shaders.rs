//! What each method makes of a shader: the instructions of the whole fragment stage with it, and the time of a pixel on the
//! device. One shader is the measure of all methods, so that these costs can be compared, and added, across terms.
//!
//! Nothing is folded: the material's numbers are uniforms. Methods that bakes and files follow, and not shaders, have no row.

use std::sync::Arc;

use glam::Vec3;
use halfvector_codegen::target::{export, target};
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::method::{TERMS, Term};
use halfvector_graph::needs::ShaderOutput;
use halfvector_graph::value::Value;
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake, studio};
use halfvector_render::{Cache, RenderOptions, Renderer};
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, Light, MeshSource, Scene, bake_options, needs};

use crate::{Effort, Row};

/// Pixels along a side of what is drawn: a square that fills the picture.
const SIDE: u32 = 256;

/// What shaders are compared with and without.
const DOMAIN: &str = "the whole fragment stage of a metal-rough surface with uniforms for numbers, under one directional light and an \
                      environment";

/// Terms that no fragment shader knows.
const BAKED: [&str; 2] = ["prefilter", "env_decode"];

/// Measures the part.
pub fn rows(effort: Effort) -> Vec<Row> {
    // Without a device its columns stay empty.
    let renderer = Renderer::new().ok();
    let mut cache = Cache::default();
    let mut rows = Vec::new();
    for (term, scenes) in terms() {
        let first = rows.len();
        rows.extend(scenes.iter().map(|scene| counted_row(term, scene)));
        let Some(renderer) = &renderer else { continue };
        for (row, time) in rows[first..].iter_mut().zip(device_times(renderer, &mut cache, &scenes, effort)) {
            row.gpu_ns = time.map(|seconds| seconds * 1e9 / f64::from(SIDE * SIDE));
            row.gpu = time.map(|_| renderer.adapter().to_owned());
        }
    }
    rows
}

/// The part's rows without the device's times: the same on every machine.
pub fn counted_rows() -> Vec<Row> {
    terms().flat_map(|(term, scenes)| scenes.into_iter().map(move |scene| counted_row(term, &scene))).collect()
}

/// The terms that shaders know, each with a scene for each of its methods.
fn terms() -> impl Iterator<Item = (&'static Term, Vec<Scene>)> {
    TERMS.iter().filter(|term| !BAKED.contains(&term.name)).map(|term| {
        let document = document(term).0;
        let scenes = term.methods.iter().filter_map(|method| {
            let mut scene = scene(document.clone())?;
            scene.methods.set(term.name, method.name).ok()?;
            Some(scene)
        });
        (term, scenes.collect())
    })
}

fn counted_row(term: &Term, scene: &Scene) -> Row {
    let mut row = Row::new(term.name, scene.methods.get(term.name).name, &format!("{DOMAIN}{}", document(term).1));
    row.instructions = shader(scene).and_then(|shader| instructions(&shader));
    row
}

/// Puts what was measured of a method's shader into the other rows of the method.
pub fn share(rows: &mut [Row]) {
    let known: Vec<Row> = rows.iter().filter(|row| row.domain.starts_with(DOMAIN)).cloned().collect();
    for row in rows.iter_mut().filter(|row| row.instructions.is_none()) {
        let name = row.method.split(',').next().unwrap_or_default();
        // A method that is measured on meshes is the same function.
        let term = if row.term == "normal_frame" { "normal" } else { &row.term };
        if let Some(known) = known.iter().find(|known| known.term == term && known.method == name) {
            row.instructions = known.instructions;
            (row.gpu_ns, row.gpu) = (known.gpu_ns, known.gpu.clone());
        }
    }
}

/// Whether a row says of another method's shader what that shader's own row says.
pub(crate) fn tells_of(row: &Row, shader: &Row) -> bool {
    shader.domain.starts_with(DOMAIN)
        && !row.domain.starts_with(DOMAIN)
        && row.term == shader.term
        && row.method.split(',').next() == Some(shader.method.as_str())
        && row.instructions == shader.instructions
}

/// A material in which a term has something to do, and what it has beside the plain one.
fn document(term: &Term) -> (Document, &'static str) {
    let mut document = Document::with_surface("measured");
    let Some(surface) = document.graph.nodes.get_mut("surface") else { return (document, "") };
    let mut set = |socket: &str, value: Value| drop(surface.values.insert(socket.into(), value));
    set("base_color", Value::Vec3([0.8, 0.5, 0.3]));
    set("metallic", Value::Number(0.5));
    set("perceptual_roughness", Value::Number(0.4));
    match term.name {
        "specular_occlusion" => {
            set("occlusion", Value::Number(0.7));
            (document, ", with an occlusion")
        }
        "sheen" => {
            set("sheen_color", Value::Vec3([0.6, 0.5, 0.4]));
            (document, ", with a sheen")
        }
        "anisotropy" => {
            set("anisotropy", Value::Number(0.6));
            (document, ", brushed")
        }
        "normal" | "normal_decode" | "horizon" => {
            let mut map = Node::new("textures/normal_map");
            map.values.insert("color".into(), Value::Vec3([0.6, 0.45, 0.9]));
            document.graph.nodes.insert("map".into(), map);
            document.graph.links.push(Link::new(SocketRef::new("map", "out"), SocketRef::new("surface", "normal")));
            (document, ", with a mapped normal")
        }
        "height_normals" => {
            document.graph.nodes.insert("hills".into(), Node::new("procedural/gradient_noise_2d"));
            document.graph.links.push(Link::new(SocketRef::new("hills", "out"), SocketRef::new("surface", "height")));
            (document, ", displaced by a noise")
        }
        _ => (document, ""),
    }
}

/// A square that fills the picture.
fn scene(document: Document) -> Option<Scene> {
    let plane = MeshSource::Builtin(BuiltinMesh::Plane);
    let mut scene = Scene::from_material(document, std::path::Path::new(""), &plane).ok()?;
    scene.environment = EnvironmentSource::Studio;
    scene.background = Background::None;
    let direction_to_light = Vec3::new(0.3, 0.5, 0.8).normalize();
    scene.lights = vec![Light::Directional { direction_to_light, illuminance: Vec3::ONE }];
    let bounds = scene.bounds()?;
    scene.camera.position = bounds.center() + 2.0 * (scene.camera.position - bounds.center()).normalize();
    scene.camera.vertical_fov = 20.0;
    Some(scene)
}

fn shader(scene: &Scene) -> Option<Shader> {
    let needs = needs(scene, ShaderOutput::Radiance);
    halfvector_codegen::shader(&scene.materials[0].document, Library::standard(), &needs, Fold::Live).ok()
}

/// The SPIR-V of the fragment stage of a surface with its default values, as it is exported.
pub(super) fn default_surface() -> Option<Vec<u8>> {
    let scene = scene(Document::with_surface("default"))?;
    let needs = needs(&scene, ShaderOutput::Radiance);
    let shader = halfvector_codegen::shader(&scene.materials[0].document, Library::standard(), &needs, Fold::Export);
    fragment(&shader.ok()?)
}

/// A shader's fragment stage in SPIR-V.
fn fragment(shader: &Shader) -> Option<Vec<u8>> {
    let files = export(shader, target("spirv")?, "m").ok()?;
    files.into_iter().find(|file| file.name == "m.frag.spv").map(|file| file.bytes)
}

/// Instructions of a shader's fragment stage in SPIR-V as naga writes it: those of the entry point's body, with those of each
/// called function in the place of the call.
pub(super) fn instructions(shader: &Shader) -> Option<u64> {
    let bytes = fragment(shader)?;
    let words: Vec<u32> = bytes.as_chunks::<4>().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
    counted(&words)
}

/// SPIR-V 1.0, 2.3 "Physical Layout of a SPIR-V Module and Instruction": five words of header, then instructions, each with its
/// count of words and its number in the first.
fn counted(words: &[u32]) -> Option<u64> {
    const ENTRY_POINT: u32 = 15;
    const FUNCTION: u32 = 54;
    const FUNCTION_END: u32 = 56;
    const CALL: u32 = 57;
    // Parameters, variables and labels do nothing.
    const NOTHING: [u32; 3] = [55, 59, 248];
    let (mut own, mut calls) = (Vec::<(u32, u64)>::new(), Vec::<(usize, u32)>::new());
    let (mut at, mut entry, mut inside) = (5, None, false);
    while at < words.len() {
        let (length, code) = ((words[at] >> 16) as usize, words[at] & 0xffff);
        let operand = |i: usize| words.get(at + i).copied();
        match code {
            ENTRY_POINT => entry = operand(2),
            FUNCTION => {
                own.push((operand(2)?, 0));
                inside = true;
            }
            FUNCTION_END => inside = false,
            CALL => calls.push((own.len() - 1, operand(3)?)),
            code if inside && !NOTHING.contains(&code) => own.last_mut()?.1 += 1,
            _ => {}
        }
        at += length.max(1);
    }
    let place = |id: u32| own.iter().position(|&(function, _)| function == id);
    // naga writes a function after those that it calls.
    let mut totals: Vec<u64> = Vec::new();
    for (number, &(_, count)) in own.iter().enumerate() {
        let called = calls.iter().filter(|call| call.0 == number);
        let called = called.filter_map(|call| totals.get(place(call.1)?)).sum::<u64>();
        totals.push(count + called);
    }
    totals.get(place(entry?)?).copied()
}

/// The device's time of each scene's pass [s], in turns; none for what it refuses, and for all when it has no clock. The
/// shortest of the turns: a software device shares its cores with whatever else the machine does, which only ever adds.
fn device_times(renderer: &Renderer, cache: &mut Cache, scenes: &[Scene], effort: Effort) -> Vec<Option<f64>> {
    let environment = studio();
    let mut baked: Vec<(BakeOptions, Arc<BakedEnvironment>)> = Vec::new();
    let mut light = |scene: &Scene| {
        let options = bake_options(&scene.environment, &scene.methods, &environment);
        let options = BakeOptions { size: 64, irradiance_size: 16, ..options };
        if let Some((_, light)) = baked.iter().find(|(known, _)| *known == options) {
            return light.clone();
        }
        let light = Arc::new(bake(&environment, &options));
        baked.push((options, light.clone()));
        light
    };
    let lights: Vec<Arc<BakedEnvironment>> = scenes.iter().map(&mut light).collect();
    let options = RenderOptions { width: SIDE, height: SIDE, samples_per_side: 1, ..RenderOptions::default() };
    let mut shortest: Vec<Option<f64>> = vec![None; scenes.len()];
    for round in 0..=effort.pick(5, 31) {
        for ((scene, light), shortest) in scenes.iter().zip(&lights).zip(&mut shortest) {
            let drawn = renderer.render_timed(cache, scene, Some(light), &options);
            if let Ok((_, Some(time))) = drawn
                && round > 0
            {
                *shortest = Some(shortest.map_or(time, |known: f64| known.min(time)));
            }
        }
    }
    shortest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn called_functions_count_where_they_are_called() {
        let word = |length: u32, code: u32| length << 16 | code;
        let function = |id: u32, body: &[u32]| {
            let mut words = vec![word(5, 54), 1, id, 0, 2, word(2, 248), 9];
            words.extend_from_slice(body);
            words.push(word(1, 56));
            words
        };
        let call = |id: u32| [word(4, 57), 1, 20, id];
        let mut words = vec![0; 5];
        words.extend([word(4, 15), 4, 12, 0]);
        // Two instructions; the first function twice and one instruction; an entry point of one instruction and the second.
        words.extend(function(10, &[word(1, 252), word(1, 253)]));
        words.extend(function(11, &[call(10), call(10)].concat()));
        words.extend(function(12, &[&call(11)[..], &[word(1, 253)]].concat()));
        assert_eq!(counted(&words), Some(5));
    }

    /// The exact Fresnel term is longer than Schlick's, no compensation shorter than one.
    #[test]
    fn dearer_methods_have_more_instructions() {
        let of = |term: &str, method: &str| {
            let term = halfvector_graph::method::term(term).expect("a term");
            let mut scene = scene(document(term).0).expect("a scene");
            scene.methods.set(term.name, method).expect("a method");
            instructions(&shader(&scene).expect("a shader")).expect("SPIR-V")
        };
        assert!(of("fresnel", "exact") > of("fresnel", "schlick"));
        assert!(of("compensation", "none") < of("compensation", "turquin"));
        assert!(of("diffuse", "lambert") < of("diffuse", "eon"));
    }

    /// What is measured has the lobe that the term is about: no two methods make the same shader.
    #[test]
    fn methods_of_lobes_show_in_their_shaders() {
        for name in ["sheen", "anisotropy", "specular_occlusion", "horizon"] {
            let term = halfvector_graph::method::term(name).expect("a term");
            let text = |method: &str| {
                let mut scene = scene(document(term).0).expect("a scene");
                scene.methods.set(term.name, method).expect("a method");
                shader(&scene).expect("a shader").wgsl
            };
            let texts: std::collections::BTreeSet<String> = term.methods.iter().map(|m| text(m.name)).collect();
            assert_eq!(texts.len(), term.methods.len(), "{name}");
        }
    }
}
