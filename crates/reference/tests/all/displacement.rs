//! Height: the mesh that is moved, against meshes that are so by themselves, and against the shader's own vertex stage.

use std::path::Path;
use std::sync::Arc;

use halfvector_codegen::Fold;
use halfvector_graph::document::Document;
use halfvector_ibl::studio;
use halfvector_raster::RasterOptions;
use halfvector_reference::metrics::difference;
use halfvector_reference::{Picture, Reference, RenderOptions};
use halfvector_scene::light::parse_light;
use halfvector_scene::mesh::MeshData;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, Mesh, MeshSource, Scene};

use crate::{color, number, scene};

const SIZE: u32 = 48;

/// A white material whose height is an expression of the contexts of a vertex, and which emits another one.
fn relief(height: &str, emission: &str) -> Document {
    let arguments = "p: vec3f, o: vec3f, n: vec3f, t: vec4f, uv: vec2f, v: vec3f, c: vec4f";
    let docs = r#""///", "/// Test.", "/// - p: place [context world_position]", "/// - o: the object's [context object_position]",
        "/// - n: normal [context world_normal]", "/// - t: tangent [context world_tangent]", "/// - uv: where [context uv0]",
        "/// - v: viewer [context view_dir]", "/// - c: colour [context vertex_color]", "/// - return: what it is""#;
    let function = |name: &str, ty: &str, body: &str| {
        let docs = docs.replace("\"/// Test.\"", &format!("\"/// Test.\", \"/// @node custom/{name}\""));
        format!(r#""{name}": ["/// {name}", {docs}, "fn {name}({arguments}) -> {ty} {{", "    return {body};", "}}"]"#)
    };
    let source = format!(
        r#"{{"halfvector": 1, "name": "Relief", "nodes": {{"surface": {{"node": "surface/surface", "values": {{"specular": 0}}}},
          "relief": {{"node": "custom/relief"}}, "glow": {{"node": "custom/glow"}}}},
          "links": [{{"from": "relief.out", "to": "surface.height"}}, {{"from": "glow.out", "to": "surface.emission"}}],
          "functions": {{{}, {}}}}}"#,
        function("glow", "vec3f", emission),
        function("relief", "f32", height),
    );
    halfvector_graph::file::from_json(&source).unwrap_or_else(|e| panic!("{e}\n{source}"))
}

/// A scene of one object under a lamp.
fn lit(document: Document, mesh: Mesh) -> Scene {
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let mut scene = Scene::from_material(document, Path::new(""), &sphere).expect("sound");
    scene.meshes[0] = Arc::new(mesh);
    scene.environment = EnvironmentSource::None;
    scene.background = Background::None;
    scene.lights = vec![parse_light("directional:1,2,3:3").expect("a light")];
    scene
}

fn built_in(shape: BuiltinMesh) -> Mesh {
    shape.parts()[0].mesh.clone()
}

/// Squares on x and y from -1 to 1, facing +Z.
fn grid(squares: u32) -> Mesh {
    let side = squares + 1;
    let at = |i: u32| (i % side, i / side);
    let along = |i: u32| i as f32 / squares as f32;
    let corners = (0..squares * squares).map(|i| i / squares * side + i % squares);
    let data = MeshData {
        positions: (0..side * side).map(|i| [2.0 * along(at(i).0) - 1.0, 2.0 * along(at(i).1) - 1.0, 0.0]).collect(),
        normals: Some(vec![[0.0, 0.0, 1.0]; (side * side) as usize]),
        uv0: Some((0..side * side).map(|i| [along(at(i).0), 1.0 - along(at(i).1)]).collect()),
        indices: corners.flat_map(|i| [i, i + 1, i + side + 1, i, i + side + 1, i + side]).collect(),
        ..MeshData::default()
    };
    Mesh::build(data).expect("a mesh")
}

/// The mesh with its vertices where `shape` says, and the normals that it says.
fn moved(mesh: &Mesh, shape: impl Fn([f64; 3]) -> ([f64; 3], [f64; 3])) -> Mesh {
    let mut made = mesh.clone();
    for (position, normal) in made.positions.iter_mut().zip(&mut made.normals) {
        let found = shape(position.map(f64::from));
        (*position, *normal) = (found.0.map(|x| x as f32), found.1.map(|x| x as f32));
    }
    made
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

fn rendered(scene: &Scene, samples: u64) -> Picture {
    let options = RenderOptions { width: SIZE, height: SIZE, shadows: false, ..RenderOptions::default() };
    let environment = (scene.environment == EnvironmentSource::Studio).then(studio);
    let mut reference = Reference::new(scene, environment.as_ref(), options).expect("a sound scene");
    reference.add_samples(samples, &|_| {}).expect("rendered");
    assert_eq!(reference.faults(), [""; 0]);
    reference.picture()
}

/// Root mean square difference over the mean.
fn apart(a: &Scene, b: &Scene) -> f64 {
    let [a, b] = [a, b].map(|scene| rendered(scene, 4).radiance());
    difference(&a, &b, None).rmse / (b.as_flattened().iter().sum::<f64>() / (3 * b.len()) as f64)
}

/// The same height everywhere is a larger sphere. With every transform: a height is a length in world space.
#[test]
fn a_constant_height_is_a_larger_sphere() {
    let values = [("height", number(0.25)), ("metallic", number(1.0)), ("base_color", color([0.9, 0.6, 0.3]))];
    let mut high = scene(BuiltinMesh::Sphere, &values, &[]);
    high.environment = EnvironmentSource::Studio;
    let mut large = scene(BuiltinMesh::Sphere, &values[1..], &[]);
    large.environment = EnvironmentSource::Studio;
    large.meshes[0] = Arc::new(moved(&built_in(BuiltinMesh::Sphere), |p| (p.map(|x| 1.25 * x), p)));
    let found = apart(&high, &large);
    println!("a sphere with a height of 0.25 against one of 1.25: {found:.2e}");
    assert!(found < 1e-4, "{found}");
    // A flat sphere that stands before it is none of its business, and the same mesh.
    for (scale, mirrored) in [(0.5, 1.0), (1.5, 1.0), (0.5, -1.0)] {
        let [mut a, mut b] = [high.clone(), large.clone()];
        let scaled = |x: f32| glam::Mat4::from_scale(glam::Vec3::new(mirrored * x, x, x));
        a.objects[0].world_from_object = scaled(scale);
        b.objects[0].world_from_object = scaled((scale + 0.25) / 1.25);
        for scene in [&mut a, &mut b] {
            let mut plain = scene.materials[0].clone();
            plain.document.graph.nodes.get_mut("surface").expect("the surface").values.remove("height");
            scene.materials.push(plain);
            let place = glam::Mat4::from_scale_rotation_translation(
                glam::Vec3::splat(0.2),
                glam::Quat::IDENTITY,
                glam::Vec3::new(0.3, 0.4, 2.5),
            );
            scene.add_builtin(BuiltinMesh::Sphere, 1, place);
        }
        let found = apart(&a, &b);
        println!("scaled by {scale} and {mirrored}: {found:.2e}");
        assert!(found < 1e-4, "{scale} {mirrored}: {found}");
    }
}

/// Waves by height against waves of the mesh. On the sphere the slope is less than the height's, for the surface is larger
/// where it is high.
#[test]
fn waves_by_height_are_waves_of_the_mesh() {
    let plane = grid(96);
    let wavy = |[x, y, _]: [f64; 3]| {
        let (h, slope) = (0.1 * (9.0 * x).sin(), 0.9 * (9.0 * x).cos());
        ([x, y, h], unit([-slope, 0.0, 1.0]))
    };
    let ball = built_in(BuiltinMesh::Sphere);
    let rings = |p: [f64; 3]| {
        let (h, slope) = (0.3 * (6.0 * p[1]).sin(), 1.8 * (6.0 * p[1]).cos());
        let along: [f64; 3] = std::array::from_fn(|i| f64::from(u8::from(i == 1)) - p[1] * p[i]);
        let normal = std::array::from_fn(|i| p[i] - slope / (1.0 + h) * along[i]);
        (p.map(|x| x * (1.0 + h)), unit(normal))
    };
    let flat = || relief("0.0 * p.x", "vec3f()");
    let cases = [
        ("plane", relief("0.1 * sin(9.0 * p.x)", "vec3f()"), &plane, moved(&plane, wavy), 0.01),
        ("sphere", relief("0.3 * sin(6.0 * o.y)", "vec3f()"), &ball, moved(&ball, rings), 0.02),
    ];
    for (name, document, mesh, shaped, bound) in cases {
        let by_height = lit(document, mesh.clone());
        let by_mesh = lit(flat(), shaped.clone());
        let found = apart(&by_height, &by_mesh);
        println!("{name}: {found:.4}; flat {:.4}", apart(&lit(flat(), mesh.clone()), &by_mesh));
        assert!(found < bound, "{name}: {found}");
        // The report's method keeps the old normals.
        let mut report = by_height.clone();
        report.methods.set("height_normals", "report").expect("a method");
        let old = Mesh { normals: mesh.normals.clone(), ..shaped };
        let found = apart(&report, &lit(flat(), old));
        println!("{name}, old normals: {found:.2e}; bent ones {:.4}", apart(&report, &by_mesh));
        assert!(found < 1e-3, "{name}: {found}");
    }
}

/// Brushed metal is brushed along the surface that displacement makes, whose tangents are those of a mesh that is so by itself.
#[test]
fn brushing_follows_the_displaced_surface() {
    let brushed = |height: &str| {
        let mut document = relief(height, "vec3f()");
        let surface = document.graph.nodes.get_mut("surface").expect("the surface");
        for (name, x) in [("metallic", 1.0), ("specular", 1.0), ("perceptual_roughness", 0.4), ("anisotropy", 0.9)] {
            surface.values.insert(name.into(), number(x));
        }
        document
    };
    let mesh = grid(96);
    let mut shaped = mesh.clone();
    for i in 0..mesh.positions.len() {
        let [x, y, _] = mesh.positions[i].map(f64::from);
        let (h, steep) = (0.1 * (5.0 * x + 7.0 * y).sin(), 0.1 * (5.0 * x + 7.0 * y).cos());
        let [tx, ty, _, w] = mesh.tangents[i].map(f64::from);
        let normal = unit([-5.0 * steep, -7.0 * steep, 1.0]).map(|x| x as f32);
        let [tx, ty, tz] = unit([tx, ty, (5.0 * tx + 7.0 * ty) * steep]).map(|x| x as f32);
        (shaped.positions[i][2], shaped.normals[i], shaped.tangents[i]) = (h as f32, normal, [tx, ty, tz, w as f32]);
    }
    let by_mesh = lit(brushed("0.0 * p.x"), shaped.clone());
    let found = apart(&lit(brushed("0.1 * sin(5.0 * p.x + 7.0 * p.y)"), mesh.clone()), &by_mesh);
    let old = Mesh { tangents: mesh.tangents, ..shaped };
    let old = apart(&lit(brushed("0.0 * p.x"), old), &by_mesh);
    println!("brushed waves: {found:.4}; with the tangents of the flat mesh {old:.4}");
    // A narrow highlight magnifies how the mesh's normals are interpolated between its vertices.
    assert!(found < 0.12 && old > 3.0 * found, "{found}, {old}");
}

/// Each context of a vertex, and the places that nodes see, as the shader's stages have them.
#[test]
fn vertices_are_moved_as_the_shader_moves_them() {
    let mut mesh = built_in(BuiltinMesh::Torus);
    for (color, [x, y, z]) in mesh.colors.iter_mut().zip(&mesh.positions) {
        *color = [x.abs(), y.abs(), z.abs(), 0.5];
    }
    let heights = [
        "0.2 * sin(8.0 * p.x)",
        "0.2 * sin(8.0 * o.x)",
        "0.25 * n.y",
        "0.25 * t.x * t.w",
        "0.3 * sin(6.2831853 * uv.x)",
        "0.4 * v.x",
        "0.3 * c.x",
    ];
    for height in heights {
        let mut scene = lit(relief(height, "0.5 + 0.5 * p"), mesh.clone());
        scene.lights.clear();
        scene.objects[0].world_from_object = glam::Mat4::from_scale_rotation_translation(
            glam::Vec3::new(0.9, -0.8, 0.7),
            glam::Quat::from_rotation_x(1.1),
            glam::Vec3::new(0.1, -0.1, 0.2),
        );
        let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side: 8, fold: Fold::Export };
        let drawn = halfvector_raster::draw::<f64>(&scene, None, &options, |_| {}).expect("drawn");
        let drawn: Vec<[f64; 4]> = drawn.pixels.iter().map(|pixel| pixel.map(f64::from)).collect();
        let apart = |scene: &Scene| {
            let picture = rendered(scene, 64);
            let both = picture.pixels.iter().zip(&drawn).filter(|(a, b)| a[3] == 1.0 && b[3] == 1.0);
            let (a, b): (Vec<[f64; 3]>, Vec<[f64; 3]>) =
                both.map(|(a, b)| ([a[0], a[1], a[2]], [b[0], b[1], b[2]])).unzip();
            difference(&a, &b, None).rmse
        };
        let found = apart(&scene);
        scene.materials[0].document.graph.links.retain(|link| link.to.socket != "height");
        let flat = apart(&scene);
        println!("{height}: {found:.4}; not moved {flat:.4}");
        assert!(found < 0.02 && flat > 4.0 * found, "{height}: {found}, {flat}");
    }
}

/// A height that is no length moves nothing, is told, and leaves no pixel without a number.
#[test]
fn a_height_that_is_no_number_is_told() {
    for (height, is_odd) in
        [("sqrt(uv.x - 0.5)", true), ("1.0 / (uv.x - uv.x)", true), ("1e30 * uv.x", true), ("1e12 * uv.x", false)]
    {
        for method in ["derived", "report"] {
            let mut scene = lit(relief(height, "vec3f(1.0)"), grid(8));
            scene.methods.set("height_normals", method).expect("a method");
            let options = RenderOptions { width: 16, height: 16, bounces: 1, ..RenderOptions::default() };
            let mut reference = Reference::new(&scene, None, options).expect("a sound scene");
            reference.add_samples(4, &|_| {}).expect("rendered");
            let faults = reference.faults().join("; ");
            assert_eq!(faults.contains("the height of the material `Relief`"), is_odd, "{height}: {faults}");
            assert!(!is_odd || faults.contains(" % of the vertices"), "{faults}");
            assert!(reference.picture().pixels.as_flattened().iter().all(|x| x.is_finite()), "{height}");
        }
    }
}
