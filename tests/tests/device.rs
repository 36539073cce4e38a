//! Pictures drawn on a GPU (llvmpipe is enough): orientation, alpha, samples, tiles, and that both ways to fold numbers
//! draw the same picture. The scenes are as small as the question.

use std::path::Path;

use halfvector_codegen::Fold;
use halfvector_graph::document::{AlphaMode, Document, Link, Node, Parameter, SocketRef};
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake};
use halfvector_render::RenderOptions;
use halfvector_scene::mesh::MeshData;
use halfvector_scene::{
    Background, BuiltinMesh, Camera, EnvironmentSource, Light, Mesh, MeshSource, Object, Picture, Scene, SceneMaterial,
};

use crate::support::renderer;

/// A surface that only glows.
fn glowing(color: [f32; 3]) -> Document {
    surface(&[
        ("base_color", Value::Vec3([0.0; 3])),
        ("specular", Value::Number(0.0)),
        ("emission", Value::Vec3(color)),
    ])
}

fn surface(values: &[(&str, Value)]) -> Document {
    let mut document = Document::with_surface("test");
    for (name, value) in values {
        document.graph.nodes.get_mut("surface").expect("the surface").values.insert((*name).into(), value.clone());
    }
    document
}

/// A rectangle in z = 0 that faces +Z, from (x0, y0) to (x1, y1), with (0, 0) of its coordinates at the top left.
fn rectangle(x0: f32, y0: f32, x1: f32, y1: f32) -> Mesh {
    Mesh::build(MeshData {
        positions: vec![[x0, y0, 0.0], [x1, y0, 0.0], [x1, y1, 0.0], [x0, y1, 0.0]],
        uv0: Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..MeshData::default()
    })
    .expect("a sound mesh")
}

/// Nothing but black; z = 0 is seen from -1 to 1 in both directions.
fn empty() -> Scene {
    Scene {
        camera: Camera {
            position: [0.0, 0.0, 2.0].into(),
            vertical_fov: 2.0 * 0.5f32.atan().to_degrees(),
            ..Camera::default()
        },
        environment: EnvironmentSource::None,
        background: Background::None,
        ..Scene::default()
    }
}

fn add(scene: &mut Scene, mesh: Mesh, document: Document, world_from_object: glam::Mat4) {
    let (mesh_index, material) = (scene.meshes.len(), scene.materials.len());
    scene.meshes.push(mesh.into());
    scene.materials.push(SceneMaterial { document, directory: "".into() });
    scene.objects.push(Object { name: String::new(), mesh: mesh_index, material, world_from_object });
}

fn options(width: u32, height: u32, samples_per_side: u32) -> RenderOptions {
    RenderOptions { width, height, samples_per_side, ..RenderOptions::default() }
}

/// Draws, or says that there is no GPU.
fn draw(scene: &Scene, environment: Option<&BakedEnvironment>, options: &RenderOptions) -> Option<Picture> {
    Some(renderer()?.render(scene, environment, options, |_| {}).expect("a picture"))
}

fn pixel(picture: &Picture, x: u32, y: u32) -> [f32; 4] {
    picture.pixels[(y * picture.width + x) as usize]
}

fn largest_difference(a: &Picture, b: &Picture) -> f32 {
    assert_eq!((a.width, a.height), (b.width, b.height));
    let pairs = a.pixels.as_flattened().iter().zip(b.pixels.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];

#[test]
fn right_is_right_and_up_is_up() {
    let mut scene = empty();
    add(&mut scene, rectangle(0.0, 0.0, 1.0, 1.0), glowing([1.0, 0.0, 0.0]), glam::Mat4::IDENTITY);
    add(&mut scene, rectangle(-1.0, -1.0, 0.0, 0.0), glowing([0.0, 1.0, 0.0]), glam::Mat4::IDENTITY);
    let Some(picture) = draw(&scene, None, &options(8, 8, 1)) else { return };
    assert_eq!(pixel(&picture, 6, 1), RED);
    assert_eq!(pixel(&picture, 1, 6), GREEN);
    assert_eq!(pixel(&picture, 1, 1), [0.0; 4]);
    assert_eq!(pixel(&picture, 6, 6), [0.0; 4]);
}

#[test]
fn the_nearer_surface_hides_the_other_whatever_the_order() {
    for flip in [false, true] {
        let mut scene = empty();
        let behind = glam::Mat4::from_translation(glam::Vec3::new(0.0, 0.0, -0.5));
        let mut parts = vec![(glowing([1.0, 0.0, 0.0]), glam::Mat4::IDENTITY), (glowing([0.0, 1.0, 0.0]), behind)];
        if flip {
            parts.reverse();
        }
        for (document, transform) in parts {
            add(&mut scene, rectangle(-1.0, -1.0, 1.0, 1.0), document, transform);
        }
        let Some(picture) = draw(&scene, None, &options(4, 4, 1)) else { return };
        assert_eq!(pixel(&picture, 2, 2), RED);
    }
}

#[test]
fn images_stand_upright_and_keep_their_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let quarters = image::RgbImage::from_fn(2, 2, |x, y| match (x, y) {
        (0, 0) => image::Rgb([255, 0, 0]),
        (1, 0) => image::Rgb([0, 255, 0]),
        (0, 1) => image::Rgb([0, 0, 255]),
        _ => image::Rgb([188, 188, 188]),
    });
    quarters.save(folder.path().join("quarters.png")).expect("saved");
    for (color_space, grey) in [(ColorSpace::Srgb, 0.5029), (ColorSpace::Linear, 188.0 / 255.0)] {
        let mut document = glowing([0.0; 3]);
        let image = ImageRef {
            file: "quarters.png".into(),
            color_space,
            wrap_u: Default::default(),
            wrap_v: Default::default(),
            filter: halfvector_graph::value::Filter::Nearest,
        };
        document.graph.nodes.insert("image".into(), Node::new("textures/image").with("image", Value::Image(image)));
        document.graph.nodes.get_mut("surface").expect("the surface").values.remove("emission");
        document.graph.links.push(Link::new(SocketRef::new("image", "color"), SocketRef::new("surface", "emission")));
        let mut scene = empty();
        add(&mut scene, rectangle(-1.0, -1.0, 1.0, 1.0), document, glam::Mat4::IDENTITY);
        scene.materials[0].directory = folder.path().into();
        scene.load_images().expect("the image");
        let Some(picture) = draw(&scene, None, &options(8, 8, 1)) else { return };
        assert_eq!(pixel(&picture, 1, 1), RED, "{color_space:?}");
        assert_eq!(pixel(&picture, 6, 1), GREEN, "{color_space:?}");
        assert_eq!(pixel(&picture, 1, 6), BLUE, "{color_space:?}");
        let found = pixel(&picture, 6, 6)[0];
        assert!((found - grey).abs() < 2e-3, "{color_space:?}: {found}");
    }
}

#[test]
fn back_faces_are_left_out_and_mirrored_objects_keep_their_front() {
    let turned = glam::Mat4::from_rotation_y(std::f32::consts::PI);
    let mirrored = glam::Mat4::from_scale(glam::Vec3::new(-1.0, 1.0, 1.0));
    for (transform, double_sided, seen) in [
        (glam::Mat4::IDENTITY, false, true),
        (turned, false, false),
        (turned, true, true),
        (mirrored, false, true),
        (turned * mirrored, false, false),
    ] {
        let mut document = glowing([1.0, 0.0, 0.0]);
        document.surface.double_sided = double_sided;
        let mut scene = empty();
        add(&mut scene, rectangle(-1.0, -1.0, 1.0, 1.0), document, transform);
        let Some(picture) = draw(&scene, None, &options(4, 4, 1)) else { return };
        assert_eq!(pixel(&picture, 2, 2)[3] > 0.0, seen, "{transform} double-sided: {double_sided}");
    }
}

#[test]
fn a_mirrored_or_turned_surface_is_lit_from_its_front() {
    let lambert = || surface(&[("base_color", Value::Vec3([1.0; 3])), ("specular", Value::Number(0.0))]);
    let turned = glam::Mat4::from_rotation_y(std::f32::consts::PI);
    let mirrored = glam::Mat4::from_scale(glam::Vec3::new(-1.0, 1.0, 0.5));
    for (transform, double_sided) in [(glam::Mat4::IDENTITY, false), (mirrored, false), (turned, true)] {
        let mut document = lambert();
        document.surface.double_sided = double_sided;
        let mut scene = empty();
        scene.lights = vec![Light::Directional { direction_to_light: glam::Vec3::Z, illuminance: glam::Vec3::ONE }];
        add(&mut scene, rectangle(-1.0, -1.0, 1.0, 1.0), document, transform);
        let Some(picture) = draw(&scene, None, &options(4, 4, 1)) else { return };
        let found = pixel(&picture, 2, 2)[0];
        assert!(
            (found - std::f32::consts::FRAC_1_PI).abs() < 1e-5,
            "{transform}: {found}, a white Lambert at 1 lx is 1/pi"
        );
    }
}

#[test]
fn coverage_masks_and_blends() {
    let veil = |mode, opacity| {
        let mut document = glowing([1.0, 0.0, 0.0]);
        document
            .graph
            .nodes
            .get_mut("surface")
            .expect("the surface")
            .values
            .insert("opacity".into(), Value::Number(opacity));
        document.surface.alpha_mode = mode;
        document
    };
    let draw_veil = |document: Document| {
        let mut scene = empty();
        add(&mut scene, rectangle(-1.0, -1.0, 1.0, 1.0), document, glam::Mat4::IDENTITY);
        // Behind the veil on the left half, and later in the scene.
        let behind = glam::Mat4::from_translation(glam::Vec3::new(0.0, 0.0, -0.5));
        add(&mut scene, rectangle(-2.0, -2.0, 0.0, 2.0), glowing([0.0, 1.0, 0.0]), behind);
        draw(&scene, None, &options(8, 8, 1)).map(|picture| [pixel(&picture, 1, 4), pixel(&picture, 6, 4)])
    };
    let Some(opaque) = draw_veil(veil(AlphaMode::Opaque, 0.25)) else { return };
    assert_eq!(opaque, [RED, RED]);
    assert_eq!(draw_veil(veil(AlphaMode::Mask, 0.25)), Some([GREEN, [0.0; 4]]));
    assert_eq!(draw_veil(veil(AlphaMode::Mask, 0.75)), Some([RED, RED]));
    let [over_green, over_nothing] = draw_veil(veil(AlphaMode::Blend, 0.25)).expect("a GPU");
    // Emission is the surface's own light and is covered like the rest.
    for (found, expected) in [(over_green, [0.25, 0.75, 0.0, 1.0]), (over_nothing, [0.25, 0.0, 0.0, 0.25])] {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?} is not {expected:?}");
    }
}

#[test]
fn backgrounds_are_what_was_asked() {
    let sky = halfvector_ibl::Equirect::from_fn(64, 32, |dir| if dir[1] > 0.0 { [0.0, 0.0, 4.0] } else { [0.5; 3] });
    let mut loaded = halfvector_ibl::white();
    loaded.source = halfvector_ibl::Source::Equirect(sky);
    let baked = bake(&loaded, &BakeOptions { size: 64, ..BakeOptions::default() });
    let mut scene = empty();
    scene.environment = EnvironmentSource::White;
    let mut behind = |background, environment| {
        scene.background = background;
        draw(&scene, environment, &options(4, 4, 1)).map(|picture| [pixel(&picture, 1, 0), pixel(&picture, 1, 3)])
    };
    let Some(none) = behind(Background::None, Some(&baked)) else { return };
    assert_eq!(none, [[0.0; 4]; 2]);
    assert_eq!(behind(Background::Color([0.25, 3.0, 0.0]), Some(&baked)), Some([[0.25, 3.0, 0.0, 1.0]; 2]));
    assert_eq!(behind(Background::Environment, Some(&baked)), Some([[0.0, 0.0, 4.0, 1.0], [0.5, 0.5, 0.5, 1.0]]));
}

#[test]
fn the_environment_behind_turns_counter_clockwise_seen_from_above() {
    // A lamp in -Z, behind the sphere's place; seen from above +X is to the right and -Z up, so a quarter
    // turn counter-clockwise takes it to -X, and minus a quarter turn to +X.
    let lamp = halfvector_ibl::Equirect::from_fn(64, 32, |dir| if dir[2] < -0.7 { [1.0; 3] } else { [0.0; 3] });
    let mut loaded = halfvector_ibl::white();
    loaded.source = halfvector_ibl::Source::Equirect(lamp);
    let baked = bake(&loaded, &BakeOptions { size: 64, ..BakeOptions::default() });
    for (rotation, target, lit) in [
        (0.0, glam::Vec3::NEG_Z, true),
        (0.0, glam::Vec3::NEG_X, false),
        (90.0, glam::Vec3::NEG_X, true),
        (90.0, glam::Vec3::X, false),
        (-90.0, glam::Vec3::X, true),
    ] {
        let mut scene = empty();
        scene.environment = EnvironmentSource::White;
        scene.environment_rotation = rotation;
        scene.background = Background::Environment;
        scene.camera.position = glam::Vec3::ZERO;
        scene.camera.target = target;
        let Some(picture) = draw(&scene, Some(&baked), &options(2, 2, 1)) else { return };
        assert_eq!(pixel(&picture, 1, 1)[0] > 0.5, lit, "turned by {rotation}, looking along {target}");
    }
}

/// A sphere with a little of everything that changes from sample to sample.
fn sphere() -> (Scene, BakedEnvironment) {
    let mut document =
        surface(&[("base_color", Value::Vec3([0.6, 0.3, 0.1])), ("perceptual_roughness", Value::Number(0.3))]);
    document.graph.nodes.insert("checker".into(), Node::new("procedural/checker_3d"));
    document.graph.links.push(Link::new(SocketRef::new("checker", "out"), SocketRef::new("surface", "metallic")));
    let mesh = MeshSource::Builtin(BuiltinMesh::Sphere);
    let mut scene = Scene::from_material(document, Path::new(""), &mesh).expect("a scene");
    scene.lights = vec![Light::Point { position: glam::Vec3::new(2.0, 2.0, 3.0), intensity: glam::Vec3::splat(20.0) }];
    scene.environment_rotation = 30.0;
    (scene, bake(&halfvector_ibl::studio(), &BakeOptions { size: 32, ..BakeOptions::default() }))
}

#[test]
fn a_pixel_is_the_mean_of_the_pixels_of_a_finer_picture() {
    let (scene, baked) = sphere();
    let Some(coarse) = draw(&scene, Some(&baked), &options(24, 24, 3)) else { return };
    let fine = draw(&scene, Some(&baked), &options(72, 72, 1)).expect("a GPU");
    for y in 0..24 {
        for x in 0..24 {
            for channel in 0..4 {
                let samples = (0..9).map(|i| pixel(&fine, 3 * x + i % 3, 3 * y + i / 3)[channel]);
                let mean = samples.sum::<f32>() / 9.0;
                let found = pixel(&coarse, x, y)[channel];
                assert!((found - mean).abs() < 1e-5 * mean.max(1.0), "{x} {y}: {found}, not {mean}");
            }
        }
    }
}

#[test]
fn tiles_make_the_same_picture() {
    let (scene, baked) = sphere();
    let whole = options(50, 40, 2);
    let Some(one) = draw(&scene, Some(&baked), &whole) else { return };
    let tiled = draw(&scene, Some(&baked), &RenderOptions { tile_edge: 26, ..whole }).expect("a GPU");
    // At edges a sample may fall on the other side: vertices are rounded in another clip space.
    let pairs = one.pixels.iter().zip(&tiled.pixels);
    let far = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-3)).count();
    assert!(far <= 4, "{far} of {} pixels differ", one.pixels.len());
}

#[test]
fn live_and_exported_numbers_draw_the_same_picture() {
    let (mut scene, baked) = sphere();
    let document = &mut scene.materials[0].document;
    let socket = SocketRef::new("surface", "perceptual_roughness");
    document.parameters.push(Parameter { name: "roughness".into(), label: None, socket, range: None });
    let Some(live) = draw(&scene, Some(&baked), &RenderOptions { fold: Fold::Live, ..options(64, 64, 1) }) else {
        return;
    };
    let export =
        draw(&scene, Some(&baked), &RenderOptions { fold: Fold::Export, ..options(64, 64, 1) }).expect("a GPU");
    let difference = largest_difference(&live, &export);
    assert!(difference < 1e-4, "{difference}");
}

#[test]
fn a_picture_is_the_same_each_time() {
    let (scene, baked) = sphere();
    let Some(first) = draw(&scene, Some(&baked), &options(40, 40, 2)) else { return };
    assert_eq!(Some(first), draw(&scene, Some(&baked), &options(40, 40, 2)));
}

#[test]
fn what_cannot_be_drawn_is_an_error() {
    let Some(renderer) = renderer() else { return };
    let (mut scene, baked) = sphere();
    let fails = |scene: &Scene, environment, options: &RenderOptions| {
        renderer.render(scene, environment, options, |_| {}).expect_err("refused").to_string()
    };
    assert!(fails(&scene, Some(&baked), &options(0, 4, 1)).contains("0 x 4"));
    assert!(fails(&scene, Some(&baked), &options(1 << 20, 1 << 20, 1)).contains("smaller size"));
    assert!(fails(&scene, None, &options(4, 4, 1)).contains("bake it first"));
    scene.objects[0].material = 7;
    assert!(fails(&scene, Some(&baked), &options(4, 4, 1)).contains("material 7"));
    // The device still works.
    scene.objects[0].material = 0;
    renderer.render(&scene, Some(&baked), &options(4, 4, 1), |_| {}).expect("a picture");
}
