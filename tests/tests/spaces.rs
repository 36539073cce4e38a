//! Transforms between spaces: what the nodes give on a body that is turned, moved and scaled unevenly, drawn by the CPU's rasteriser,
//! the GPU and the reference, against the same transforms done here.

use std::path::Path;

use glam::{EulerRot, Mat3, Mat4, Quat, Vec3};
use halfvector_codegen::Fold;
use halfvector_graph::document::Document;
use halfvector_raster::RasterOptions;
use halfvector_reference::Reference;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Scene, View};

use crate::support::renderer;

const SIZE: u32 = 12;
/// Added to what is shown, for light is not negative.
const RAISED: f32 = 8.0;
/// Pictures of the GPU may be of half floats.
const TOLERANCE: f32 = 0.012;

fn body() -> Mat4 {
    let turn = Quat::from_euler(EulerRot::XYZ, 0.5, 0.8, -0.3);
    Mat4::from_scale_rotation_translation(Vec3::new(1.0, 1.6, 0.7), turn, Vec3::new(0.4, -0.2, 0.3))
}

/// The body, glowing with what comes out of `node` of these nodes.
pub(crate) fn scene(nodes: &str, links: &str, node: &str) -> Scene {
    let text = format!(
        r#"{{"halfvector": 1, "name": "Spaces", "nodes": {{{nodes}, "raised": {{"node": "math/multiply_add", "values": {{"b": 1, "c": {RAISED}}}}},
            "surface": {{"node": "surface/surface", "values": {{"base_color": [0, 0, 0], "specular": 0}}}}}},
            "links": [{links} {{"from": "{node}.out", "to": "raised.a"}}, {{"from": "raised.out", "to": "surface.emission"}}]}}"#
    );
    let document: Document = halfvector_graph::file::from_json(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let cube = MeshSource::Builtin(BuiltinMesh::Cube);
    let mut scene = Scene::from_material(document, Path::new(""), &cube).expect("a scene");
    scene.objects.iter_mut().for_each(|object| object.world_from_object = body());
    (scene.environment, scene.background) = (EnvironmentSource::None, Background::None);
    (scene.camera.position, scene.camera.target) = (Vec3::new(2.0, 1.0, 5.0), Vec3::new(0.3, 0.1, 0.0));
    scene
}

/// The covered pixels of each engine, less what was added.
fn shown(scene: &Scene) -> Vec<(&'static str, Vec<Vec3>)> {
    let covered = |pixels: Vec<[f32; 4]>| -> Vec<Vec3> {
        let covered = pixels.into_iter().filter(|p| p[3] == 1.0);
        covered.map(|[r, g, b, _]| Vec3::new(r, g, b) - RAISED).collect()
    };
    let mut all = Vec::new();
    for (name, fold) in [("cpu", Fold::Export), ("cpu, live", Fold::Live)] {
        let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side: 1, fold };
        let picture = halfvector_raster::draw::<f32>(scene, None, &options, |_| {}).expect("a picture");
        all.push((name, covered(picture.pixels)));
    }
    if let Some(renderer) = renderer() {
        let options =
            halfvector_render::RenderOptions { width: SIZE, height: SIZE, samples_per_side: 1, ..Default::default() };
        let picture = renderer.render(scene, None, &options, |_| {}).expect("a picture");
        all.push(("gpu", covered(picture.pixels)));
    }
    let options = halfvector_reference::RenderOptions { width: SIZE, height: SIZE, ..Default::default() };
    let mut reference = Reference::new(scene, None, options).expect("a sound scene");
    reference.add_samples(1, &|_| {}).expect("rendered");
    let pixels = reference.picture().pixels;
    all.push(("reference", covered(pixels.into_iter().map(|p| p.map(|x| x as f32)).collect())));
    all
}

pub(crate) fn told(scene: &Scene, wanted: Vec3) {
    for (engine, pixels) in shown(scene) {
        assert!(pixels.len() > 8, "{engine}: {} pixels", pixels.len());
        for pixel in pixels {
            assert!((pixel - wanted).abs().max_element() < TOLERANCE, "{engine}: {pixel} instead of {wanted}");
        }
    }
}

#[test]
fn each_transform_is_that_of_the_body_and_the_viewer() {
    let (m, back) = (body(), body().inverse());
    let v = Vec3::new(0.5, -0.3, 0.9);
    let some = scene(r#""n": {"node": "spaces/world_from_view_position"}"#, "", "n");
    let view = View::new(&some.camera, 0.1, 1.0).view_from_world();
    let normal = |m: Mat4| (Mat3::from_mat4(m).transpose() * v).normalize();
    for (node, input, wanted) in [
        ("object_from_world_position", "p", back.transform_point3(v)),
        ("object_from_world_direction", "v", back.transform_vector3(v)),
        ("object_from_world_normal", "n", normal(m)),
        ("world_from_object_position", "p", m.transform_point3(v)),
        ("world_from_object_direction", "v", m.transform_vector3(v)),
        ("world_from_object_normal", "n", normal(back)),
        ("view_from_world_position", "p", view.transform_point3(v)),
        ("view_from_world_direction", "v", view.transform_vector3(v)),
        ("world_from_view_position", "p", view.inverse().transform_point3(v)),
        ("world_from_view_direction", "v", view.inverse().transform_vector3(v)),
    ] {
        let value =
            format!(r#""n": {{"node": "spaces/{node}", "values": {{"{input}": [{}, {}, {}]}}}}"#, v.x, v.y, v.z);
        println!("{node}: {wanted}");
        told(&scene(&value, "", "n"), wanted);
    }
    let ahead = scene(r#""n": {"node": "spaces/world_from_view_position", "values": {"p": [0, 0, -2]}}"#, "", "n");
    let forward = (ahead.camera.target - ahead.camera.position).normalize();
    told(&ahead, ahead.camera.position + 2.0 * forward);
}

/// What is known of a point in one space is what is known of it in the other, pixel by pixel.
#[test]
fn a_point_is_where_it_is_in_either_space() {
    let nodes = r#""home": {"node": "spaces/object_from_world_position"}, "place": {"node": "coordinates/object_position"},
        "n": {"node": "math/subtract"}"#;
    let links = r#"{"from": "home.out", "to": "n.a"}, {"from": "place.out", "to": "n.b"},"#;
    told(&scene(nodes, links, "n"), Vec3::ZERO);
}
