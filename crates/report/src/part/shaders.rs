//! What each method makes of a shader: the instructions of the whole fragment stage with it, and the time of a pixel on the
//! device. One shader is the measure of all methods, so that these costs can be compared, and added, across terms.
//!
//! Nothing is folded: the material's numbers are uniforms. Methods that bakes and files follow, and not shaders, have no row.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use halfvector_codegen::target::{export, target};
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::method::TERMS;
use halfvector_graph::needs::ShaderOutput;
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake, studio};
use halfvector_render::RenderOptions;
use halfvector_scene::{BuiltinMesh, EnvironmentSource, MeshSource, Scene, bake_options, needs};

use super::pictures::variants::unspecialised;
use super::stations::{NO_DEVICE, Station, shared, station};
use crate::missing::DEVICE;
use crate::timing::{SITTINGS, median};
use crate::{Row, Run};

/// The part's name.
pub(crate) const PART: &str = "shaders";

/// Pixels along a side of what is drawn: a square that fills the picture.
const SIDE: u32 = 256;

/// What shaders are compared with and without.
const DOMAIN: &str = "the whole fragment stage of a metal-rough surface with uniforms for numbers, under one directional light and an \
                      environment";

/// Terms that no fragment shader knows.
const BAKED: [&str; 2] = ["prefilter", "env_decode"];

/// Terms with the method that is chosen for each.
type Chosen = &'static [(&'static str, &'static str)];

/// What is measured beside the terms' methods: what shaders have in place of a choice. Term, name of the row, the methods that are
/// chosen for it.
const OTHERS: [(&str, &str, Chosen); 8] = [
    ("coat", "leaning", &[]),
    ("coat", "mirror", &[("reflection", "mirror")]),
    ("transmission", "leaning facet, refracted width", &[]),
    ("transmission", "leaning", &[]),
    ("thin_film", "at the split sum's mean cosine", &[]),
    ("height_normals", "moved vertices, their own normals", &[("height_normals", "report")]),
    ("height_normals", "parallax occlusion", &[]),
    ("height_normals", "normal map without parallax", &[]),
];

/// A shader that is measured.
struct Subject {
    term: &'static str,
    method: &'static str,
    /// What its material has beside the plain one.
    with: &'static str,
    scene: Scene,
}

/// The device's shortest time of a pass [s], and how much longer the one in the middle took.
type DeviceTime = (f64, Option<f64>);

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let subjects = subjects();
    let rows: Vec<Row> = subjects.iter().map(counted_row).collect();
    run.keep(&rows, 0.05);
    // Without a device its columns stay empty.
    let stations = [station()];
    let Some(name) = stations.iter().flatten().map(Station::name).next() else {
        run.leave_out(PART, Some(DEVICE), NO_DEVICE.to_owned());
        return rows;
    };
    let timed = |times: Vec<Option<DeviceTime>>| -> Vec<Row> {
        let mut rows = rows.clone();
        for (row, time) in rows.iter_mut().zip(times) {
            let Some((shortest, spread)) = time else { continue };
            row.gpu_ns = Some(shortest * 1e9 / f64::from(SIDE * SIDE));
            row.gpu_spread = spread;
            row.gpu = Some(name.to_owned());
        }
        rows
    };
    let times = device_times(&stations, &subjects, run, &|times, done| run.keep(&timed(times), done));
    timed(times)
}

/// The part's rows without the device's times: the same on every machine.
pub fn counted_rows() -> Vec<Row> {
    subjects().iter().map(counted_row).collect()
}

/// Whether methods of a term are measured in shaders.
pub(crate) fn has(term: &str) -> bool {
    let term = if term == "normal_frame" { "normal" } else { term };
    let is_listed = TERMS.iter().any(|known| known.name == term) && !BAKED.contains(&term);
    is_listed || OTHERS.iter().any(|(known, ..)| *known == term)
}

/// A subject for each method of the terms that shaders know, and for each of [`OTHERS`].
fn subjects() -> Vec<Subject> {
    let Some(plain) = scene(Document::with_surface("plain")) else { return Vec::new() };
    let shown = TERMS.iter().filter(|term| !BAKED.contains(&term.name));
    let methods = shown.flat_map(|term| {
        term.methods.iter().filter_map(|method| subject(&plain, term.name, method.name, &[(term.name, method.name)]))
    });
    methods.chain(OTHERS.iter().filter_map(|&(term, name, chosen)| subject(&plain, term, name, chosen))).collect()
}

/// The square of a plain material with the material of a method in its place.
fn subject(plain: &Scene, term: &'static str, method: &'static str, chosen: &[(&str, &str)]) -> Option<Subject> {
    let (document, with) = document(term, method);
    let mut scene = plain.clone();
    // The picture that it may name is no file, and a shader is made without one.
    scene.materials.first_mut()?.document = document;
    for (term, method) in chosen {
        scene.methods.set(term, method).ok()?;
    }
    Some(Subject { term, method, with, scene })
}

fn counted_row(subject: &Subject) -> Row {
    let mut row = Row::new(subject.term, subject.method, &format!("{DOMAIN}{}", subject.with));
    row.instructions = shader(&subject.scene).and_then(|shader| instructions(&shader));
    row
}

/// Whether a counted row is of a shader whose pictures are no files: it is not drawn.
pub(crate) fn reads_no_file(row: &Row) -> bool {
    ["parallax occlusion", "normal map without parallax"].contains(&row.method.as_str())
}

/// Whether a row is of the method that a shader's row is of: some rows say more of it behind a comma.
fn is_of(row: &Row, shader: &Row) -> bool {
    // A method that is measured on meshes is the same function.
    let term = if row.term == "normal_frame" { "normal" } else { &row.term };
    let first = row.method.split(',').next().unwrap_or_default();
    term == shader.term && (row.method == shader.method || first == shader.method)
}

/// Puts what was measured of a method's shader into the other rows of the method.
pub fn share(rows: &mut [Row]) {
    let known: Vec<Row> = rows.iter().filter(|row| row.domain.starts_with(DOMAIN)).cloned().collect();
    for row in rows.iter_mut().filter(|row| row.instructions.is_none()) {
        if let Some(known) = known.iter().find(|known| is_of(row, known)) {
            row.instructions = known.instructions;
            (row.gpu_ns, row.gpu_spread, row.gpu) = (known.gpu_ns, known.gpu_spread, known.gpu.clone());
        }
    }
}

/// Whether a row says of another method's shader what that shader's own row says.
pub(crate) fn tells_of(row: &Row, shader: &Row) -> bool {
    shader.domain.starts_with(DOMAIN)
        && !row.domain.starts_with(DOMAIN)
        && row.term == shader.term
        && is_of(row, shader)
        && row.instructions == shader.instructions
}

/// A material in which a term has something to do, and what it has beside the plain one.
fn document(term: &str, method: &str) -> (Document, &'static str) {
    let mut document = Document::with_surface("measured");
    let Document { graph, surface: settings, .. } = &mut document;
    let Some(surface) = graph.nodes.get_mut("surface") else { return (document, "") };
    let mut set = |socket: &str, value: Value| drop(surface.values.insert(socket.into(), value));
    set("base_color", Value::Vec3([0.8, 0.5, 0.3]));
    set("metallic", Value::Number(0.5));
    set("perceptual_roughness", Value::Number(0.4));
    let mut link = |from: (&str, &str), to: (&str, &str)| {
        graph.links.push(Link::new(SocketRef::new(from.0, from.1), SocketRef::new(to.0, to.1)));
    };
    let with = match (term, method) {
        ("specular_occlusion", _) => {
            set("occlusion", Value::Number(0.7));
            ", with an occlusion"
        }
        ("sheen", _) => {
            set("sheen_color", Value::Vec3([0.6, 0.5, 0.4]));
            ", with a sheen"
        }
        ("anisotropy", _) => {
            set("anisotropy", Value::Number(0.6));
            ", brushed"
        }
        ("coat", _) => {
            set("coat_weight", Value::Number(0.8));
            set("coat_roughness", Value::Number(0.2));
            ", with a coat"
        }
        ("transmission", _) => {
            set("transmission_weight", Value::Number(0.8));
            settings.thin_walled = method == "leaning";
            if settings.thin_walled { ", a thin wall that lets light through" } else { ", that lets light through" }
        }
        ("thin_film", _) => {
            set("thin_film_weight", Value::Number(0.8));
            ", with a thin film"
        }
        ("normal" | "normal_decode" | "horizon", _) => {
            let mut map = Node::new("textures/normal_map");
            map.values.insert("color".into(), Value::Vec3([0.6, 0.45, 0.9]));
            graph.nodes.insert("map".into(), map);
            link(("map", "out"), ("surface", "normal"));
            ", with a mapped normal"
        }
        ("height_normals", "parallax occlusion" | "normal map without parallax") => {
            let of_picture = |definition: &str| {
                let (file, color_space) = ("relief.png".to_owned(), ColorSpace::Linear);
                let (wrap_u, wrap_v, filter) = Default::default();
                let mut node = Node::new(definition);
                node.values
                    .insert("image".into(), Value::Image(ImageRef { file, color_space, wrap_u, wrap_v, filter }));
                node
            };
            graph.nodes.insert("normal".into(), of_picture("textures/height_normal"));
            graph.nodes.insert("bend".into(), Node::new("textures/normal_map"));
            link(("normal", "out"), ("bend", "color"));
            link(("bend", "out"), ("surface", "normal"));
            if method == "parallax occlusion" {
                graph.nodes.insert("relief".into(), of_picture("textures/parallax"));
                link(("relief", "out"), ("normal", "uv"));
                ", with the normals of a height map, read where the line of sight meets it"
            } else {
                ", with the normals of a height map"
            }
        }
        ("height_normals", _) => {
            graph.nodes.insert("hills".into(), Node::new("procedural/gradient_noise_2d"));
            link(("hills", "out"), ("surface", "height"));
            ", displaced by a noise"
        }
        _ => "",
    };
    (document, with)
}

/// A square that fills the picture, under one light and the studio.
fn scene(document: Document) -> Option<Scene> {
    let any = MeshSource::Builtin(BuiltinMesh::Sphere);
    let material = Scene::from_material(document, std::path::Path::new(""), &any).ok()?.materials.pop()?;
    let mut scene = Scene::filling_square(material).ok()?;
    scene.environment = EnvironmentSource::Studio;
    Some(scene)
}

fn shader(scene: &Scene) -> Option<Shader> {
    let needs = needs(scene, ShaderOutput::Radiance);
    halfvector_codegen::shader(&scene.materials[0].document, Library::standard(), &needs, Fold::Live).ok()
}

/// The SPIR-V of the fragment stage of a surface with its default values, as it is exported: known when it is made, or exposed, each a
/// uniform.
pub(super) fn default_surface(exposed: bool) -> Option<Vec<u8>> {
    let mut scene = scene(Document::with_surface("default"))?;
    if exposed {
        scene = unspecialised(&scene);
    }
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
pub(super) fn counted(words: &[u32]) -> Option<u64> {
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

/// The device's time of each subject's pass [s], and how sure it is; none for what it refuses, and for all when it has no clock.
///
/// A sitting draws each shader several times, one after the other, and takes the shortest: a software device shares its cores with
/// whatever else the machine does, which only ever adds. Sittings of one shader lie apart, and every other one goes through the
/// shaders from the last to the first. The time is that of the fastest sitting, the spread how much longer the one in the middle
/// took; of fewer than three sittings it is not known. What makes the same shader is drawn once for all. After each sitting `told` gets the
/// times so far, and how much is done.
fn device_times<'s>(
    stations: &[Option<Station>],
    subjects: &'s [Subject],
    run: &Run<'_>,
    told: &dyn Fn(Vec<Option<DeviceTime>>, f64),
) -> Vec<Option<DeviceTime>> {
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
    let mut different: Vec<(String, &'s Scene, Arc<BakedEnvironment>)> = Vec::new();
    let place = |subject: &'s Subject| {
        let (text, light) = (shader(&subject.scene)?.wgsl, light(&subject.scene));
        let known = different.iter().position(|(known, _, lit)| *known == text && Arc::ptr_eq(lit, &light));
        Some(known.unwrap_or_else(|| {
            different.push((text, &subject.scene, light));
            different.len() - 1
        }))
    };
    let places: Vec<Option<usize>> = subjects.iter().map(place).collect();
    let options = RenderOptions { width: SIDE, height: SIDE, samples_per_side: 1, ..RenderOptions::default() };
    let (ready, all) = (AtomicUsize::new(0), different.len() as f64);
    let drawn = shared(stations, &different, |station, (_, scene, light)| {
        let drawn = station.is_some_and(|station| station.draw(scene, Some(light), &options).is_ok());
        run.at(0.05 + 0.45 * (ready.fetch_add(1, Ordering::Relaxed) + 1) as f64 / all);
        drawn
    });
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); different.len()];
    for sitting in 0..SITTINGS {
        let mut order: Vec<usize> = (0..different.len()).collect();
        if sitting % 2 == 1 {
            order.reverse();
        }
        for (done, at) in order.into_iter().enumerate() {
            let ((_, scene, light), (station, drawn)) = (&different[at], drawn[at]);
            let Some(station) = stations[station].as_ref().filter(|_| drawn) else { continue };
            let pass = || station.draw(scene, Some(light), &options).ok().and_then(|(_, time)| time);
            let shortest = (0..run.effort().pick(2, 8)).filter_map(|_| pass()).min_by(f64::total_cmp);
            times[at].extend(shortest.filter(|time| *time > 0.0));
            run.at(0.5 + 0.5 * (sitting as f64 + done as f64 / all) / SITTINGS as f64);
        }
        told(of_subjects(&places, &times), 0.5 + 0.5 * (sitting + 1) as f64 / SITTINGS as f64);
    }
    of_subjects(&places, &times)
}

/// Of each subject the shortest time of its sittings, and how much longer the one in the middle took.
fn of_subjects(places: &[Option<usize>], times: &[Vec<f64>]) -> Vec<Option<DeviceTime>> {
    let found = |place: &Option<usize>| {
        let times = &times[(*place)?];
        let shortest = times.iter().copied().min_by(f64::total_cmp)?;
        Some((shortest, (times.len() > 2).then(|| median(times.clone()) / shortest - 1.0)))
    };
    places.iter().map(found).collect()
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
        let all = subjects();
        let of = |term: &str, method: &str| {
            let subject =
                all.iter().find(|subject| subject.term == term && subject.method == method).expect("a subject");
            instructions(&shader(&subject.scene).expect("a shader")).expect("SPIR-V")
        };
        assert!(of("fresnel", "exact") > of("fresnel", "schlick"));
        assert!(of("compensation", "none") < of("compensation", "turquin"));
        assert!(of("diffuse", "lambert") < of("diffuse", "eon"));
    }

    /// What is measured has the lobe that the term is about: no two methods make the same shader.
    #[test]
    fn methods_of_lobes_show_in_their_shaders() {
        let all = subjects();
        for name in ["sheen", "anisotropy", "specular_occlusion", "horizon", "coat", "transmission", "thin_film"] {
            let own: Vec<&Subject> = all.iter().filter(|subject| subject.term == name).collect();
            let text = |subject: &&Subject| shader(&subject.scene).expect("a shader").wgsl;
            let texts: std::collections::BTreeSet<String> = own.iter().map(text).collect();
            assert!(!own.is_empty() && texts.len() == own.len(), "{name}");
        }
    }

    /// What is in no term's list is measured, too, and every subject makes a shader.
    #[test]
    fn every_subject_is_counted() {
        let rows = counted_rows();
        let of = |term: &str, method: &str| {
            let row = rows.iter().find(|row| row.term == term && row.method == method).expect("a row");
            row.instructions.unwrap_or_else(|| panic!("{term} {method} makes no shader"))
        };
        let plain = of("d", "ggx");
        for (term, method, _) in OTHERS {
            let moved = method.starts_with("moved");
            assert!(of(term, method) > plain || moved, "{term} {method}: {} beside {plain}", of(term, method));
        }
        assert!(of("height_normals", "parallax occlusion") > of("height_normals", "normal map without parallax"));
        assert!(rows.iter().all(|row| row.instructions.is_some()));
    }

    #[test]
    fn what_a_shader_costs_is_shared_with_every_row_of_its_method() {
        let shader =
            |term: &str, method: &str, count| Row { instructions: Some(count), ..Row::new(term, method, DOMAIN) };
        let mut rows = vec![
            shader("coat", "leaning", 7),
            shader("transmission", "leaning facet, refracted width", 8),
            Row::new("coat", "leaning", "studio"),
            Row::new("transmission", "leaning facet, refracted width", "studio"),
            Row::new("transmission", "refracted, width of a reflection", "studio"),
        ];
        share(&mut rows);
        let counts: Vec<_> = rows[2..].iter().map(|row| row.instructions).collect();
        assert_eq!(counts, [Some(7), Some(8), None]);
    }
}
