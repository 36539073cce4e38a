//! Height fields and frames as pictures: displaced meshes, normals from heights, parallax, scaled and turned objects, against
//! what the geometry says. Shading normals are found as a photographer would: three lights of three colours on white plaster.

use glam::{DVec2, DVec3, Mat3, Mat4, Vec3};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value};
use halfvector_maps::parallax::{parallax_occlusion, parallax_offset};
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::mesh::MeshData;
use halfvector_scene::{Background, Camera, EnvironmentSource, Light, Mesh, Object, Picture, Scene, SceneMaterial};

use crate::support::renderer;

/// Pixels in a row; the picture shows -1 to 1 in x and y, seen along -Z.
const SIZE: u32 = 400;
/// Texels in a row of the height map.
const TEXELS: u32 = 512;

/// The height field, 0..1, over texture coordinates; it repeats.
fn field([u, v]: [f64; 2]) -> f64 {
    let tau = std::f64::consts::TAU;
    0.5 + 0.4 * (2.0 * tau * u).sin() * (tau * v).cos() + 0.05 * (5.0 * tau * (u + v)).sin()
}

/// Its slopes by u and v.
fn slopes([u, v]: [f64; 2]) -> DVec2 {
    const STEP: f64 = 1e-5;
    let by = |du: f64, dv: f64| (field([u + du, v + dv]) - field([u - du, v - dv])) / (2.0 * STEP);
    DVec2::new(by(STEP, 0.0), by(0.0, STEP))
}

/// A folder that holds the field as `height.png`, of 16 bits.
fn folder_with_map() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let map = image::ImageBuffer::from_fn(TEXELS, TEXELS, |i, j| {
        let h = field([i, j].map(|k| (f64::from(k) + 0.5) / f64::from(TEXELS)));
        image::Luma([(h * 65535.0).round() as u16])
    });
    map.save(folder.path().join("height.png")).expect("the map is saved");
    folder
}

fn height_image() -> Value {
    Value::Image(ImageRef {
        file: "height.png".into(),
        color_space: ColorSpace::Linear,
        wrap_u: Default::default(),
        wrap_v: Default::default(),
        filter: Filter::Linear,
    })
}

fn link(document: &mut Document, from: (&str, &str), to: (&str, &str)) {
    document.graph.links.push(Link::new(SocketRef::new(from.0, from.1), SocketRef::new(to.0, to.1)));
}

/// A white Lambert surface.
fn plaster() -> Document {
    let mut document = Document::with_surface("plaster");
    let values = &mut document.graph.nodes.get_mut("surface").expect("the surface").values;
    values.insert("base_color".into(), Value::Vec3([1.0; 3]));
    values.insert("specular".into(), Value::Number(0.0));
    document
}

/// One object, seen along -Z from so far that perspective moves nothing by a pixel.
fn scene(mesh: Mesh, document: Document, directory: &std::path::Path, world_from_object: Mat4) -> Scene {
    let distance = 500.0;
    let mut scene = Scene {
        meshes: vec![mesh.into()],
        materials: vec![SceneMaterial { document, directory: directory.into() }],
        objects: vec![Object { name: String::new(), mesh: 0, material: 0, world_from_object }],
        camera: Camera {
            position: [0.0, 0.0, distance].into(),
            vertical_fov: 2.0 * (1.0 / distance).atan().to_degrees(),
            ..Camera::default()
        },
        environment: EnvironmentSource::None,
        background: Background::None,
        ..Scene::default()
    };
    scene.load_images().expect("the map");
    scene
}

fn draw(renderer: &Renderer, scene: &Scene) -> Picture {
    let options = RenderOptions { width: SIZE, height: SIZE, samples_per_side: 1, ..RenderOptions::default() };
    renderer.render(scene, None, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"))
}

/// The shading normals of a plaster scene, where all of `lights` (unit directions) reach it.
fn normals(renderer: &Renderer, mut scene: Scene, lights: [Vec3; 3]) -> Vec<Option<DVec3>> {
    let colors = [Vec3::X, Vec3::Y, Vec3::Z];
    scene.lights = lights
        .iter()
        .zip(colors)
        .map(|(&l, illuminance)| Light::Directional { direction_to_light: l, illuminance })
        .collect();
    let from_cosines = Mat3::from_cols(lights[0], lights[1], lights[2]).transpose().inverse();
    let normal =
        |p: &[f32; 4]| (p[3] > 0.0).then(|| (from_cosines * Vec3::new(p[0], p[1], p[2])).normalize().as_dvec3());
    draw(renderer, &scene).pixels.iter().map(normal).collect()
}

/// About the view.
fn front_lights() -> [Vec3; 3] {
    [Vec3::new(0.4, 0.0, 1.0), Vec3::new(-0.2, 0.35, 1.0), Vec3::new(-0.2, -0.35, 1.0)].map(Vec3::normalize)
}

/// The square from -1 to 1 in z = 0 in n x n squares, with the map upright on it.
fn square(n: u32) -> Mesh {
    let grid = || (0..=n).flat_map(|j| (0..=n).map(move |i| [i, j].map(|k| k as f32 / n as f32)));
    let indices = (0..n * n).flat_map(|k| {
        let a = k / n * (n + 1) + k % n;
        [a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2]
    });
    let mesh = Mesh::build(MeshData {
        positions: grid().map(|[u, v]| [2.0 * u - 1.0, 1.0 - 2.0 * v, 0.0]).collect(),
        normals: Some(vec![[0.0, 0.0, 1.0]; ((n + 1) * (n + 1)) as usize]),
        uv0: Some(grid().collect()),
        indices: indices.collect(),
        ..MeshData::default()
    });
    mesh.expect("a sound mesh")
}

/// Where the middle of a pixel lies on the square, in texture coordinates.
fn uv_of(pixel: usize) -> [f64; 2] {
    [pixel as u32 % SIZE, pixel as u32 / SIZE].map(|k| (f64::from(k) + 0.5) / f64::from(SIZE))
}

/// Mean and largest angle in degrees to the field's normals, of relief `depth` times the square's edge, away from its rim.
fn angles(found: &[Option<DVec3>], depth: f64) -> (f64, f64) {
    let (mut sum, mut max, mut count) = (0.0, 0.0_f64, 0.0);
    for (i, n) in found.iter().enumerate() {
        let uv = uv_of(i);
        if uv.iter().any(|x| (x - 0.5).abs() > 0.49) {
            continue;
        }
        let slope = slopes(uv) * depth;
        // v runs down the picture.
        let truth = DVec3::new(-slope.x, slope.y, 1.0).normalize();
        let angle = n.unwrap_or_else(|| panic!("nothing at {uv:?}")).angle_between(truth).to_degrees();
        (sum, max, count) = (sum + angle, max.max(angle), count + 1.0);
    }
    (sum / count, max)
}

/// A square moved by the field: normals derived from it are near the truth, the report's are those of the square.
#[test]
fn displaced_squares_shade_like_the_relief() {
    let Some(renderer) = renderer() else { return };
    let folder = folder_with_map();
    let depth = 0.05;
    let mut document = plaster();
    document.graph.nodes.insert("image".into(), Node::new("textures/image").with("image", height_image()));
    // The square is 2 m wide.
    let moved =
        Node::new("textures/height").with("scale", Value::Number(2.0 * depth)).with("level", Value::Number(0.5));
    document.graph.nodes.insert("moved".into(), moved);
    link(&mut document, ("image", "r"), ("moved", "value"));
    link(&mut document, ("moved", "out"), ("surface", "height"));
    let mut scene = scene(square(256), document, folder.path(), Mat4::IDENTITY);
    for (method, most, least) in [("derived", 1.0, 0.0), ("report", 15.0, 5.0)] {
        scene.methods.set("height_normals", method).expect("a method of the list");
        let (mean, max) = angles(&normals(&renderer, scene.clone(), front_lights()), f64::from(depth));
        println!("height_normals {method}: mean {mean:.3}, max {max:.3} degrees");
        assert!(mean <= most && mean >= least && (method == "report" || max < 4.0), "{method}: {mean} {max}");
    }
}

/// A sphere moved by waves of 0.3 of its radius shades like a mesh that has their shape and normals by itself: slopes lie further
/// out, or further in, than the sphere.
#[test]
fn displaced_spheres_shade_like_their_surface() {
    let Some(renderer) = renderer() else { return };
    let rings = r#"{"halfvector": 1, "name": "Rings", "nodes": {"rings": {"node": "custom/rings"},
        "surface": {"node": "surface/surface", "values": {"base_color": [1, 1, 1], "specular": 0}}},
        "links": [{"from": "rings.out", "to": "surface.height"}],
        "functions": {"rings": ["/// Rings", "///", "/// Waves.", "/// @node custom/rings", "/// - o: place [context object_position]",
        "/// - return: height", "fn rings(o: vec3f) -> f32 {", "    return 0.21 * sin(6.0 * o.y);", "}"]}}"#;
    let rings = halfvector_graph::file::from_json(rings).unwrap_or_else(|e| panic!("{e}"));
    let mesh = halfvector_scene::BuiltinMesh::Sphere.parts()[0].mesh.clone();
    let mut shaped = mesh.clone();
    for (position, normal) in shaped.positions.iter_mut().zip(&mut shaped.normals) {
        let p = DVec3::from(position.map(f64::from));
        let (h, slope) = (0.3 * (6.0 * p.y).sin(), 1.8 * (6.0 * p.y).cos());
        *position = (p * (1.0 + h)).as_vec3().to_array();
        *normal = (p - slope / (1.0 + h) * (DVec3::Y - p.y * p)).normalize().as_vec3().to_array();
    }
    let small = Mat4::from_scale(Vec3::splat(0.7));
    let nowhere = std::path::Path::new("");
    let found = normals(&renderer, scene(mesh, rings, nowhere, small), front_lights());
    let truth = normals(&renderer, scene(shaped, plaster(), nowhere, small), front_lights());
    let both = found.iter().zip(&truth).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
    let mut angles: Vec<f64> =
        both.filter(|(_, truth)| truth.z > 0.6).map(|(found, truth)| found.angle_between(truth).to_degrees()).collect();
    angles.sort_by(f64::total_cmp);
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    let most = angles[angles.len() * 99 / 100];
    println!("rings on a sphere: mean {mean:.3}, 99 % below {most:.3} degrees, {} pixels", angles.len());
    // What is left is the half pixel by which differences in a block of 2 x 2 lie aside. By steps of the sphere the mean is 4.3 degrees.
    assert!(angles.len() > 20_000 && mean < 1.2 && most < 5.0, "{mean} {most}");
}

/// A material displaced by slanting waves of 0.1 in a mesh that is drawn 0.85 times as large, with a normal map of one colour or brushed metal.
fn wavy(is_moved: bool, is_brushed: bool) -> Document {
    let links = [
        is_moved.then_some(r#"{"from": "waves.out", "to": "surface.height"}"#),
        (!is_brushed).then_some(r#"{"from": "tilt.out", "to": "surface.normal"}"#),
    ];
    let surface = if is_brushed {
        r#""base_color": [1, 1, 1], "metallic": 1, "perceptual_roughness": 0.5, "anisotropy": 0.9"#
    } else {
        r#""base_color": [1, 1, 1], "specular": 0"#
    };
    let text = format!(
        r#"{{"halfvector": 1, "name": "Waves", "nodes": {{"waves": {{"node": "custom/waves"}},
        "tilt": {{"node": "textures/normal_map", "values": {{"color": [0.75, 0.65, 0.8]}}}},
        "surface": {{"node": "surface/surface", "values": {{{surface}}}}}}}, "links": [{}],
        "functions": {{"waves": ["/// Waves", "///", "/// Waves.", "/// @node custom/waves", "/// - o: place [context object_position]",
        "/// - return: height", "fn waves(o: vec3f) -> f32 {{", "    return 0.085 * sin(dot(o, vec3f(5.0, 4.0, 3.0)));", "}}"]}}}}"#,
        links.into_iter().flatten().collect::<Vec<_>>().join(", ")
    );
    halfvector_graph::file::from_json(&text).unwrap_or_else(|e| panic!("{e}"))
}

/// A mesh that has the shape of those waves, with the normals and tangents of that shape. `curvatures`: those of the mesh along its tangent
/// and across, at a vertex; the tangent runs along one of them.
fn with_waves(mesh: &Mesh, curvatures: impl Fn(DVec3, DVec3) -> [f64; 2]) -> Mesh {
    let mut shaped = mesh.clone();
    let wave = DVec3::new(5.0, 4.0, 3.0);
    for i in 0..mesh.positions.len() {
        let [p, n] = [mesh.positions[i], mesh.normals[i]].map(|x| DVec3::from(x.map(f64::from)));
        let [x, y, z, w] = mesh.tangents[i].map(f64::from);
        let t = DVec3::new(x, y, z);
        let b = n.cross(t);
        let (height, slope) = (0.1 * wave.dot(p).sin(), 0.1 * wave.dot(p).cos() * wave);
        let [along, across] = curvatures(p, n);
        // How the moved place changes: p + h n, with dn = curvature dp.
        let new_t = t * (1.0 + height * along) + n * slope.dot(t);
        let new_b = b * (1.0 + height * across) + n * slope.dot(b);
        shaped.positions[i] = (p + height * n).as_vec3().to_array();
        shaped.normals[i] = new_t.cross(new_b).normalize().as_vec3().to_array();
        shaped.tangents[i] = new_t.normalize().as_vec3().extend(w as f32).to_array();
    }
    shaped
}

/// Normal maps and brushed lobes lie on a displaced surface that is curved as on a mesh of its shape: along the tangent that moved with it.
#[test]
fn tangents_of_curved_displaced_surfaces_are_those_of_their_shape() {
    let Some(renderer) = renderer() else { return };
    let nowhere = std::path::Path::new("");
    let sphere = halfvector_scene::BuiltinMesh::Sphere.parts()[0].mesh.clone();
    let torus = halfvector_scene::BuiltinMesh::Torus.parts()[0].mesh.clone();
    // The ring lies around Z; its tube has the radius 0.3.
    let of_torus = |p: DVec3, n: DVec3| {
        let out = DVec3::new(p.x, p.y, 0.0);
        [n.dot(out) / out.length_squared(), 1.0 / 0.3]
    };
    for (name, mesh, shaped) in
        [("sphere", &sphere, with_waves(&sphere, |_, _| [1.0; 2])), ("torus", &torus, with_waves(&torus, of_torus))]
    {
        let small = Mat4::from_scale(Vec3::splat(0.85));
        let tilted = |mesh: &Mesh, is_moved| {
            normals(&renderer, scene(mesh.clone(), wavy(is_moved, false), nowhere, small), front_lights())
        };
        let (found, truth) = (tilted(mesh, true), tilted(&shaped, false));
        let both = found.iter().zip(&truth).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
        let mut angles: Vec<f64> = both
            .filter(|(_, truth)| truth.z > 0.6)
            .map(|(found, truth)| found.angle_between(truth).to_degrees())
            .collect();
        angles.sort_by(f64::total_cmp);
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        let brushed = |mesh: &Mesh, is_moved| {
            let mut scene = scene(mesh.clone(), wavy(is_moved, true), nowhere, small);
            scene.lights = [Vec3::new(0.4, 0.5, 1.0), Vec3::new(-0.6, 0.1, 0.7)]
                .map(|l| Light::Directional { direction_to_light: l.normalize(), illuminance: Vec3::ONE })
                .to_vec();
            draw(&renderer, &scene).pixels
        };
        let (found, truth) = (brushed(mesh, true), brushed(&shaped, false));
        let (mut off, mut light) = (0.0, 0.0);
        for (a, b) in found.iter().zip(&truth).filter(|(a, b)| a[3] == 1.0 && b[3] == 1.0) {
            off += f64::from((a[0] - b[0]).abs());
            light += f64::from(b[0]);
        }
        println!(
            "{name}: tilted normals mean {mean:.3} degrees of {}; brushed off by {:.4}",
            angles.len(),
            off / light
        );
        // What is left is the half pixel of blocks of 2 x 2; the tube of the torus is bent more.
        assert!(angles.len() > 10_000 && mean < 2.2, "{name}: {mean}");
        assert!(light > 100.0 && off / light < 0.03, "{name}: {}", off / light);
    }
}

/// The node that makes a normal map of a height map, through the normal map node.
#[test]
fn normals_from_heights_are_the_relief() {
    let Some(renderer) = renderer() else { return };
    let folder = folder_with_map();
    let depth = 0.05;
    let mut document = plaster();
    let made = Node::new("textures/height_normal").with("image", height_image()).with("depth", Value::Number(depth));
    document.graph.nodes.insert("made".into(), made);
    document.graph.nodes.insert("map".into(), Node::new("textures/normal_map"));
    link(&mut document, ("made", "out"), ("map", "color"));
    link(&mut document, ("map", "out"), ("surface", "normal"));
    let scene = scene(square(1), document, folder.path(), Mat4::IDENTITY);
    let (mean, max) = angles(&normals(&renderer, scene, front_lights()), f64::from(depth));
    println!("textures/height_normal: mean {mean:.3}, max {max:.3} degrees");
    assert!(mean < 0.3 && max < 3.0, "{mean} {max}");
}

/// Texels (128, 128, 255) of maps that are centred on 128 are straight up, alone and through every blend. The map is one
/// texel, row "1x1 mip" of the catalogue.
#[test]
fn neutral_snorm_texels_are_flat_through_blends() {
    let Some(renderer) = renderer() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let flat = image::RgbImage::from_pixel(1, 1, image::Rgb([128, 128, 255]));
    flat.save(folder.path().join("height.png")).expect("the map is saved");
    let blends = ["", "_rnm", "_whiteout", "_udn", "_linear"].map(|kind| format!("textures/normal_blend{kind}"));
    for between in [None].into_iter().chain(blends.iter().map(Some)) {
        let mut document = plaster();
        document.graph.nodes.insert("image".into(), Node::new("textures/image").with("image", height_image()));
        document.graph.nodes.insert("map".into(), Node::new("textures/normal_map"));
        if let Some(blend) = between {
            document.graph.nodes.insert("both".into(), Node::new(blend.as_str()));
            link(&mut document, ("image", "color"), ("both", "base"));
            link(&mut document, ("image", "color"), ("both", "detail"));
            link(&mut document, ("both", "out"), ("map", "color"));
        } else {
            link(&mut document, ("image", "color"), ("map", "color"));
        }
        link(&mut document, ("map", "out"), ("surface", "normal"));
        let mut scene = scene(square(1), document, folder.path(), Mat4::IDENTITY);
        for (method, leans) in [("snorm", false), ("unorm", true)] {
            scene.methods.set("normal_decode", method).expect("a method of the list");
            let found = normals(&renderer, scene.clone(), front_lights())[(SIZE * SIZE / 2 + SIZE / 2) as usize];
            let angle = found.expect("the square is in the middle").angle_between(DVec3::Z).to_degrees();
            assert!(if leans { angle > 0.2 } else { angle < 0.02 }, "{method}, {between:?}: {angle} degrees");
        }
    }
}

/// A sheet with a normal map seen from behind: the relief's other side, every bump a dent.
#[test]
fn the_back_of_a_mapped_sheet_is_its_other_side() {
    let Some(renderer) = renderer() else { return };
    let folder = folder_with_map();
    let depth = 0.05;
    let mut document = plaster();
    document.surface.double_sided = true;
    let made = Node::new("textures/height_normal").with("image", height_image()).with("depth", Value::Number(depth));
    document.graph.nodes.insert("made".into(), made);
    document.graph.nodes.insert("map".into(), Node::new("textures/normal_map"));
    link(&mut document, ("made", "out"), ("map", "color"));
    link(&mut document, ("map", "out"), ("surface", "normal"));
    let turned = Mat4::from_rotation_y(std::f32::consts::PI);
    let found = normals(&renderer, scene(square(1), document, folder.path(), turned), front_lights());
    // The pixel on the left shows the right of the sheet, whose normal is turned about Y and then over.
    let as_front: Vec<_> = (0..found.len())
        .map(|i| {
            let [column, row] = [i % SIZE as usize, i / SIZE as usize];
            let seen = found[row * SIZE as usize + SIZE as usize - 1 - column]?;
            Some(-DVec3::new(-seen.x, seen.y, -seen.z))
        })
        .collect();
    let (mean, max) = angles(&as_front, f64::from(depth));
    println!("from behind: mean {mean:.3}, max {max:.3} degrees");
    assert!(mean < 0.3 && max < 3.0, "{mean} {max}");
}

/// Rows "non-uniform scale" and "singular scale" of the catalogue, and mirrors: normals of scaled objects.
#[test]
fn scaled_objects_keep_their_normals() {
    let Some(renderer) = renderer() else { return };
    let up_lights =
        [Vec3::new(0.5, 0.8, 0.5), Vec3::new(-0.5, 0.8, 0.5), Vec3::new(0.0, 0.5, 0.9)].map(Vec3::normalize);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (scale, normal, lights, want) in [
        ([1.0, 1.0, 10.0], [0.0, half, half], up_lights, DVec3::new(0.0, 10.0, 1.0)),
        ([1.0, 1.0, 0.0], [0.0, half, half], front_lights(), DVec3::Z),
        ([-1.0, 1.0, 1.0], [0.3, 0.0, 0.9], front_lights(), DVec3::new(-0.3, 0.0, 0.9)),
        ([-2.0, -1.0, -3.0], [0.3, 0.1, -0.9], front_lights(), DVec3::new(-0.15, -0.1, 0.3)),
    ] {
        let mut mesh = square(1);
        mesh.normals.fill(Vec3::from(normal).normalize().to_array());
        let mut document = plaster();
        document.surface.double_sided = false;
        if scale[2] < 0.0 {
            // Faces -Z before it is mirrored.
            mesh.indices.chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
        }
        let scene = scene(mesh, document, std::path::Path::new(""), Mat4::from_scale(scale.into()));
        let found = normals(&renderer, scene, lights)[(SIZE * SIZE / 2 + SIZE / 2) as usize];
        let found = found.unwrap_or_else(|| panic!("nothing is seen at scale {scale:?}"));
        assert!(found.angle_between(want).to_degrees() < 0.05, "{scale:?}: {found}, not {want}");
    }
}

/// A tilted square with a relief below it: the texture coordinates that a pixel shows are where its line of sight meets the
/// field, as the Rust twin finds them, which its own tests hold against traced lines.
#[test]
fn parallax_on_the_gpu_is_the_twin() {
    let Some(renderer) = renderer() else { return };
    let folder = folder_with_map();
    let depth = 0.1;
    let mut document = Document::with_surface("uv");
    let values = &mut document.graph.nodes.get_mut("surface").expect("the surface").values;
    values.insert("base_color".into(), Value::Vec3([0.0; 3]));
    values.insert("specular".into(), Value::Number(0.0));
    let parallax = Node::new("textures/parallax").with("image", height_image()).with("depth", Value::Number(depth));
    document.graph.nodes.insert("parallax".into(), parallax);
    document.graph.nodes.insert("apart".into(), Node::new("vector/separate2"));
    document.graph.nodes.insert("together".into(), Node::new("vector/combine3"));
    link(&mut document, ("parallax", "out"), ("apart", "v"));
    link(&mut document, ("apart", "x"), ("together", "x"));
    link(&mut document, ("apart", "y"), ("together", "y"));
    link(&mut document, ("together", "out"), ("surface", "emission"));
    for degrees in [30.0_f64, 60.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let tilt = Mat4::from_rotation_y(degrees.to_radians() as f32);
        let picture = draw(&renderer, &scene(square(1), document.clone(), folder.path(), tilt));
        let (normal, tangent) = ([sin, 0.0, cos], [cos, 0.0, -sin, 1.0]);
        let offset = parallax_offset([0.0, 0.0, 1.0], normal, tangent, f64::from(depth));
        let (mut sum, mut close, mut count) = (0.0, 0.0, 0.0);
        for (i, p) in picture.pixels.iter().enumerate() {
            let [u, v] = uv_of(i);
            let u = (u - 0.5) / cos + 0.5;
            // Coordinates below 0 are no light.
            if (u - 0.5).abs() > 0.45 || p[3] == 0.0 {
                continue;
            }
            let [want_u, want_v] = parallax_occlusion(field, [u, v], offset);
            if want_u < 0.01 || want_v < 0.01 {
                continue;
            }
            let off = (f64::from(p[0]) - want_u).hypot(f64::from(p[1]) - want_v);
            sum += off;
            close += f64::from(u8::from(off < 1.0 / 256.0));
            count += 1.0;
        }
        println!(
            "parallax at {degrees} degrees: mean {:.5}, within 1/256 {:.3}, {count} pixels",
            sum / count,
            close / count
        );
        assert!(
            count > 4e4 && sum / count < 2e-3 && close / count > 0.98,
            "{degrees}: {} {}",
            sum / count,
            close / count
        );
    }
}
