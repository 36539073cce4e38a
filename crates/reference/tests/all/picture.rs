//! The picture itself: framing, shadows, opacity, and the same bytes whoever renders it.

use halfvector_ibl::{studio, white};
use halfvector_reference::{Picture, Reference, RenderOptions};
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, BuiltinMesh, Scene};

use crate::{color, number, scene};

fn rendered(scene: &Scene, options: RenderOptions, steps: &[u64]) -> Picture {
    let mut reference = Reference::new(scene, Some(&studio()), options).expect("a sound scene");
    for step in steps {
        reference.add_samples(*step, &|_| {}).expect("rendered");
    }
    reference.picture()
}

#[test]
fn the_same_bytes_for_a_seed() {
    let scene = scene(BuiltinMesh::Torus, &[("base_color", color([0.7, 0.5, 0.2])), ("metallic", number(0.5))], &[]);
    let options = RenderOptions { width: 37, height: 29, seed: 5, bounces: 2, ..RenderOptions::default() };
    let at_once = rendered(&scene, options, &[6]);
    assert_eq!(at_once, rendered(&scene, options, &[1, 5]));
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    for threads in [1, 3] {
        assert_eq!(at_once, pool(threads).install(|| rendered(&scene, options, &[6])));
    }
    assert_ne!(at_once, rendered(&scene, RenderOptions { seed: 6, ..options }, &[6]));
}

/// A white Lambert that faces 1 lx has radiance 1 / pi; where a sphere stands before the light there is none.
#[test]
fn lights_and_their_shadows() {
    let values = [("base_color", color([1.0; 3])), ("specular", number(0.0))];
    let mut scene = scene(BuiltinMesh::Plane, &values, &[]);
    scene.lights = vec![parse_light("directional:0,0,1:1").expect("a light")];
    scene.background = Background::None;
    let options = RenderOptions { width: 16, height: 16, ..RenderOptions::default() };
    let look = |scene: &Scene, options| {
        let mut reference = Reference::new(scene, None, options).expect("a sound scene");
        reference.add_samples(4, &|_| {}).expect("rendered");
        reference.picture()
    };
    let lit = look(&scene, options);
    let middle = 8 * 16 + 8;
    assert!((lit.pixels[middle][0] - std::f64::consts::FRAC_1_PI).abs() < 1e-12);
    assert_eq!((lit.pixels[middle][3], lit.pixels[0]), (1.0, [0.0; 4]));
    assert!(lit.standard_error.as_ref().is_some_and(|errors| errors[middle][0] < 1e-9));
    // One sample has no spread, two have.
    let mut few = Reference::new(&scene, None, options).expect("a sound scene");
    few.add_samples(1, &|_| {}).expect("rendered");
    assert_eq!((few.picture().standard_error, few.picture().noise()), (None, None));
    few.add_samples(1, &|_| {}).expect("rendered");
    assert!(few.picture().standard_error.is_some() && few.picture().noise().is_some());
    // A small ball behind the camera's side, between plane and light.
    scene.lights = vec![parse_light("point:0,2,6:40").expect("a light")];
    let open = look(&scene, options);
    let ball = glam::Mat4::from_scale_rotation_translation(
        glam::Vec3::splat(0.3),
        glam::Quat::IDENTITY,
        glam::Vec3::new(0.0, 1.0, 3.0),
    );
    scene.add_builtin(BuiltinMesh::Sphere, 0, ball);
    let shaded = look(&scene, options);
    let unshadowed = look(&scene, RenderOptions { shadows: false, ..options });
    assert_eq!(shaded.pixels[middle][0], 0.0);
    assert_eq!(unshadowed.pixels[middle], open.pixels[middle]);
    // What is blended lets through what it does not cover.
    let mut veil = scene.materials[0].clone();
    veil.document.surface.alpha_mode = halfvector_graph::document::AlphaMode::Blend;
    let node = veil.document.graph.nodes.get_mut("surface").expect("the surface");
    node.values.insert("opacity".into(), number(0.25));
    scene.objects[1].material = scene.materials.len();
    scene.materials.push(veil);
    let dimmed = look(&scene, options);
    assert!((dimmed.pixels[middle][0] / open.pixels[middle][0] - 0.75).abs() < 0.01, "{:?}", dimmed.pixels[middle]);
}

#[test]
fn opacity_is_alpha() {
    let mut scene = scene(BuiltinMesh::Sphere, &[("opacity", number(0.25)), ("specular", number(0.0))], &[]);
    scene.background = Background::None;
    scene.materials[0].document.surface.alpha_mode = halfvector_graph::document::AlphaMode::Blend;
    let options = RenderOptions { width: 9, height: 9, ..RenderOptions::default() };
    let mut reference = Reference::new(&scene, Some(&white()), options).expect("a sound scene");
    reference.add_samples(4000, &|_| {}).expect("rendered");
    let [r, _, _, alpha] = reference.picture().pixels[4 * 9 + 4];
    assert!((alpha - 0.25).abs() < 0.03 && (r - 0.8 * alpha).abs() < 1e-6, "{r} {alpha}");
}

/// The exact sphere and its triangles are the same picture but for what the triangles cut off.
#[test]
fn the_sphere_stands_for_its_triangles() {
    let exact = scene(BuiltinMesh::Sphere, &[("metallic", number(1.0)), ("perceptual_roughness", number(0.3))], &[]);
    let mut triangles = exact.clone();
    // One vertex moved by a hair: it is no longer the built-in mesh.
    std::sync::Arc::make_mut(&mut triangles.meshes[0]).uv1[0][0] += 1e-6;
    let options = RenderOptions { width: 48, height: 48, ..RenderOptions::default() };
    let [a, b] = [&exact, &triangles].map(|scene| rendered(scene, options, &[16]));
    let d = halfvector_reference::metrics::difference(&a.radiance(), &b.radiance(), None);
    println!("sphere against triangles: {d:?}");
    assert!(d.mean_relative.abs() < 1e-3 && d.rmse < 0.02, "{d:?}");
}

/// A material that is no number somewhere is told by name and share; a sound one is not.
#[test]
fn what_is_not_finite_is_told() {
    let document = |body: &str| {
        let source = format!(
            r#"{{"halfvector": 1, "name": "Odd", "nodes": {{"surface": {{"node": "surface/surface"}}, "odd": {{"node": "custom/odd"}}}},
              "links": [{{"from": "odd.out", "to": "surface.emission"}}], "functions": {{"odd": [
                "/// Odd", "///", "/// Test.", "/// @node custom/odd", "/// - uv: where [context uv0]", "/// - return: light",
                "fn odd(uv: vec2f) -> vec3f {{", "return vec3f({body});", "}}"]}}}}"#
        );
        halfvector_graph::file::from_json(&source).expect("a document")
    };
    for (text, is_odd) in [("sqrt(uv.x - 0.5)", true), ("sqrt(uv.x + 0.5)", false)] {
        let mesh = halfvector_scene::MeshSource::Builtin(BuiltinMesh::Plane);
        let scene = Scene::from_material(document(text), std::path::Path::new(""), &mesh).expect("a scene");
        let options = RenderOptions { width: 16, height: 16, ..RenderOptions::default() };
        let mut reference = Reference::new(&scene, Some(&white()), options).expect("a sound scene");
        reference.add_samples(4, &|_| {}).expect("rendered");
        let faults = reference.faults();
        assert_eq!(!faults.is_empty(), is_odd, "{text}: {faults:?}");
        assert!(faults.iter().all(|fault| fault.contains("`Odd`") && fault.contains(" % of the points")), "{faults:?}");
        assert!(reference.picture().pixels.as_flattened().iter().all(|x| x.is_finite()));
    }
}
