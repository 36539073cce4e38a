//! Pictures of 8 bits whose slope is seen: under the surface's height, under Bump, and in nodes that make normals of heights. Devices blend texels
//! by weights of 8 bits, and llvmpipe rounds what it has blended to 8 bits; the slopes of that are steps, so texels are to be blended by arithmetic.

use std::path::Path;

use halfvector_codegen::Fold;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::{SocketType, Type};
use halfvector_ibl::BakedEnvironment;
use halfvector_raster::RasterOptions;
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Scene};

use super::{CODE, MOST_APART, SIDE, baked, compare};
use crate::support::{renderer, root};

/// What both draw, as [`compare`] has it, in so many pixels on a side and samples along a side of a pixel.
fn drawn(
    renderer: &Renderer,
    scene: &Scene,
    environment: Option<&BakedEnvironment>,
    [size, side]: [u32; 2],
) -> (f64, f32) {
    let options = RenderOptions { width: size, height: size, samples_per_side: side, ..RenderOptions::default() };
    let gpu = renderer.render(scene, environment, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    let options = RasterOptions { width: size, height: size, samples_per_side: side, fold: Fold::Export };
    let cpu = halfvector_raster::draw::<f32>(scene, environment, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    compare(scene, &cpu, &gpu)
}

fn scene_of(document: &str, folder: &Path, mesh: BuiltinMesh) -> Scene {
    let document = halfvector_graph::file::from_json(document).unwrap_or_else(|e| panic!("{e}\n{document}"));
    let scene = Scene::from_material(document, folder, &MeshSource::Builtin(mesh));
    let mut scene = scene.unwrap_or_else(|e| panic!("{e}"));
    scene.background = Background::None;
    scene.lights = vec![parse_light("directional:1,1,1:3").unwrap_or_else(|e| panic!("{e}"))];
    scene
}

/// A sine of whole turns over so many texels.
fn wave(turns: f64, texel: u32, texels: u32) -> f64 {
    (turns * std::f64::consts::TAU * f64::from(texel) / f64::from(texels)).sin()
}

/// A height map of 8 bits, as most are, over a plane and the sphere: displaced and shaded alike, however coarsely the device filters.
/// llvmpipe filters by weights of 8 bits and rounds what it has filtered to 8 bits: heights are to be blended by arithmetic.
#[test]
fn height_maps_of_8_bits_look_the_same_on_the_cpu() {
    let Some(renderer) = renderer() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    for texels in [32, 200, 512] {
        // The middle one is not square, and no power of two.
        let rows = if texels == 200 { 130 } else { texels };
        let map = image::GrayImage::from_fn(texels, rows, |u, v| {
            let h = 0.5 + 0.4 * wave(2.0, u, texels) * wave(1.0, v, rows) + 0.05 * wave(5.0, u, texels);
            image::Luma([(255.0 * h).round() as u8])
        });
        map.save(folder.path().join(format!("{texels}.png"))).expect("the map is saved");
    }
    let cobbles = image::open(root().join("examples/textures/cobbles_height.png")).expect("the example's map");
    cobbles.into_luma8().save(folder.path().join("cobbles.png")).expect("the map is saved");
    let studio = baked(&EnvironmentSource::Studio);
    println!("{:<44} {:>10} {:>10}", "map, mesh, preset, normals", "apart", "boxed/255");
    let mut failed = Vec::new();
    for map in ["32", "200", "512", "cobbles"] {
        let document = format!(
            r#"{{"halfvector": 1, "name": "relief", "nodes": {{"surface": {{"node": "surface/surface", "values": {{"perceptual_roughness": 0.4}}}},
            "map": {{"node": "textures/image", "values": {{"image": {{"file": "{map}.png", "color_space": "linear"}}}}}},
            "height": {{"node": "textures/height", "values": {{"scale": 0.2}}}}}},
            "links": [{{"from": "map.r", "to": "height.value"}}, {{"from": "height.out", "to": "surface.height"}}]}}"#
        );
        for mesh in [BuiltinMesh::Plane, BuiltinMesh::Sphere] {
            let mut scene = scene_of(&document, folder.path(), mesh);
            for preset in [Methods::default(), Methods::report()] {
                for normals in ["derived", "report"] {
                    scene.methods = preset.clone();
                    scene.methods.set("height_normals", normals).unwrap_or_else(|e| panic!("{e}"));
                    let (apart, edges) = drawn(&renderer, &scene, studio.as_ref(), [96, SIDE]);
                    let preset = if preset == Methods::default() { "default" } else { "report" };
                    let name = format!("{map}, {}, {preset}, {normals}", mesh.name());
                    println!("{name:<44} {:>9.3}% {:>10.3}", apart * 100.0, edges / CODE);
                    if apart > MOST_APART || edges > 4.0 * CODE {
                        failed.push(name);
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// How a picture's slope comes to be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// Under the surface's height, with the normals derived from it.
    Height,
    /// Under the height, with the mesh's normals.
    OldNormals,
    /// Under Bump.
    Bump,
    /// Out of the node as the colour of a normal map.
    Normal,
}

/// A material in which the first output of a node is seen in a way, as a polished metal, whose reflections show the least slope. The node's
/// text, without its braces, has values for its pictures.
fn metal(node: &str, output: &str, ty: Type, way: Way, functions: &str) -> String {
    let (number, split) = match ty {
        Type::F32 => (format!("read.{output}"), ""),
        Type::Vec2 => ("split.x".into(), r#""split": {"node": "vector/separate2"},"#),
        _ => ("split.x".into(), r#""split": {"node": "vector/separate3"},"#),
    };
    let into_split =
        if split.is_empty() { String::new() } else { format!(r#"{{"from": "read.{output}", "to": "split.v"}},"#) };
    let height = r#""height": {"node": "textures/height", "values": {"scale": 0.1, "level": 0.5}},"#;
    let to_height = format!(r#"{into_split} {{"from": "{number}", "to": "height.value"}},"#);
    let (nodes, links) = match way {
        Way::Height | Way::OldNormals => {
            (format!("{split} {height}"), format!(r#"{to_height} {{"from": "height.out", "to": "surface.height"}}"#))
        }
        Way::Bump => (
            format!(r#"{split} {height} "bump": {{"node": "textures/bump"}},"#),
            format!(
                r#"{to_height} {{"from": "height.out", "to": "bump.height"}}, {{"from": "bump.out", "to": "surface.normal"}}"#
            ),
        ),
        Way::Normal => (
            r#""map": {"node": "textures/normal_map"},"#.into(),
            format!(r#"{{"from": "read.{output}", "to": "map.color"}}, {{"from": "map.out", "to": "surface.normal"}}"#),
        ),
    };
    format!(
        r#"{{"halfvector": 1, "name": "relief", "nodes": {{"read": {{{node}}}, {nodes} "surface": {{"node": "surface/surface",
        "values": {{"base_color": [0.9, 0.7, 0.4], "metallic": 1, "perceptual_roughness": 0.2}}}}}}, "links": [{links}] {functions}}}"#
    )
}

/// The ways in which a node's slope can be seen.
fn ways(def: &NodeDef) -> Vec<Way> {
    let in_vertices = def.vertex_function.is_some() || !def.function.implicit_derivatives;
    let makes_normals = def.inputs.iter().any(|i| i.ty == SocketType::Texture && def.slopes.contains(&i.name));
    let mut ways = Vec::new();
    if makes_normals {
        ways.push(Way::Normal);
    } else {
        ways.push(Way::Bump);
    }
    if in_vertices {
        ways.extend([Way::Height, Way::OldNormals]);
    }
    ways
}

/// Normal maps of 8 bits on a polished metal, magnified: what is read between texels is not rounded to 8 bits on either side.
#[test]
fn normal_maps_of_8_bits_look_the_same_on_the_cpu() {
    const TEXELS: u32 = 16;
    let Some(renderer) = renderer() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let map = image::RgbImage::from_fn(TEXELS, TEXELS, |u, v| {
        let slope = [0.4 * wave(1.0, u, TEXELS), 0.4 * wave(1.0, v + u, TEXELS)];
        let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
        image::Rgb([slope[0], slope[1], 1.0].map(|x| (127.5 + 127.5 * x / length).round() as u8))
    });
    map.save(folder.path().join("map.png")).expect("the map is saved");
    let studio = baked(&EnvironmentSource::Studio);
    for node in ["image", "triplanar"] {
        let read = format!(
            r#""node": "textures/{node}", "values": {{"image": {{"file": "map.png", "color_space": "linear"}}}}"#
        );
        let document = metal(&read, "color", Type::Vec3, Way::Normal, "");
        for mesh in [BuiltinMesh::Plane, BuiltinMesh::Sphere] {
            let scene = scene_of(&document, folder.path(), mesh);
            let (apart, edges) = drawn(&renderer, &scene, studio.as_ref(), [96, 2]);
            println!("{node}, {}: {:.3} % apart, {:.3} codes after the box", mesh.name(), apart * 100.0, edges / CODE);
            assert!(apart <= MOST_APART && edges <= 4.0 * CODE, "{node}, {}: {apart}, {edges}", mesh.name());
        }
    }
}

/// Every node that reads a picture, and a document's own function, wherever the slope of what it reads is seen. A new node is tried as
/// soon as it is there.
#[test]
fn slopes_of_every_picture_look_the_same_on_the_cpu() {
    let Some(renderer) = renderer() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    for texels in [8, 64] {
        // The small one is magnified to eight pixels a texel and more, the large one has levels between.
        let map = image::GrayImage::from_fn(texels, texels, |u, v| {
            let h = 0.5 + 0.3 * wave(1.0, u, texels) * wave(1.0, v, texels) + 0.1 * wave(3.0, u + 2 * v, texels);
            image::Luma([(255.0 * h).round() as u8])
        });
        map.save(folder.path().join(format!("{texels}.png"))).expect("the map is saved");
    }
    let studio = baked(&EnvironmentSource::Studio);
    let own = r#", "functions": {"own": ["/// Own", "///", "/// Two reads.", "/// @node custom/own", "/// - image: map [image linear]",
        "/// - uv: place [context uv0]", "/// - return: height", "fn two(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> f32 {",
        "    return textureSampleGrad(image, image_sampler, uv.yx, vec2f(0.01, 0.0), vec2f(0.0, 0.01)).r;", "}",
        "fn own(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> f32 {",
        "    return 0.5 * (textureSampleLevel(image, image_sampler, uv, 0.4).r + two(image, image_sampler, uv));", "}"]}"#;
    let mut cases: Vec<(String, String, Way, BuiltinMesh)> = Vec::new();
    for (map, mesh) in [("8", BuiltinMesh::Plane), ("64", BuiltinMesh::Sphere)] {
        let picture = |input: &str| format!(r#""{input}": {{"file": "{map}.png", "color_space": "linear"}}"#);
        let reads = |def: &&NodeDef| def.inputs.iter().any(|input| input.ty == SocketType::Texture);
        for def in Library::standard().iter().filter(reads) {
            let pictures = def.inputs.iter().filter(|input| input.ty == SocketType::Texture).map(|i| picture(&i.name));
            let node = format!(r#""node": "{}", "values": {{{}}}"#, def.id, pictures.collect::<Vec<_>>().join(", "));
            let output = &def.outputs[0];
            let SocketType::Value(ty) = output.ty else { panic!("{} gives no value", def.id) };
            for way in ways(def) {
                cases.push((format!("{} of {map}", def.id), metal(&node, &output.name, ty, way, ""), way, mesh));
            }
        }
        let node = format!(r#""node": "custom/own", "values": {{{}}}"#, picture("image"));
        for way in [Way::Bump, Way::Height, Way::OldNormals] {
            cases.push((format!("custom/own of {map}"), metal(&node, "out", Type::F32, way, own), way, mesh));
        }
    }
    let mut failed = Vec::new();
    println!("{:<44} {:>10} {:>10}", "node, map, way, mesh", "apart", "boxed/255");
    for (name, document, way, mesh) in cases {
        let mut scene = scene_of(&document, folder.path(), mesh);
        let normals = if way == Way::OldNormals { "report" } else { "derived" };
        scene.methods.set("height_normals", normals).unwrap_or_else(|e| panic!("{e}"));
        let (apart, edges) = drawn(&renderer, &scene, studio.as_ref(), [64, 2]);
        let name = format!("{name}, {way:?}, {}", mesh.name());
        println!("{name:<60} {:>9.3}% {:>10.3}", apart * 100.0, edges / CODE);
        if apart > MOST_APART || edges > 4.0 * CODE {
            failed.push(name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
