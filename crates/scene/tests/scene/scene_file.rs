//! Scene files: what they say comes through, and what is wrong in them is said.

use std::f32::consts::PI;
use std::path::Path;

use glam::Vec3;
use halfvector_graph::needs::{ShaderOutput, ToneMap};
use halfvector_graph::value::Value;
use halfvector_scene::{
    Background, BuiltinMesh, Camera, EnvironmentSource, Exposure, Light, MeshSource, Scene, SceneError, load_scene,
    needs,
};

use crate::support::{Builder, add};

const MATERIAL: &str = r#"{
  "halfvector": 1,
  "name": "Plain",
  "nodes": {"surface": {"node": "surface/surface", "values": {"base_color": [1, 1, 1], "metallic": 0}}},
  "links": [],
  "parameters": [{"name": "metallic", "socket": "surface.metallic"}, {"name": "base_color", "socket": "surface.base_color"}]
}"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("plain.material.json"), MATERIAL).unwrap();
    let mut model = Builder::triangle();
    for name in ["Glass", "Steel"] {
        add(&mut model, "materials", serde_json::json!({"name": name}));
    }
    model.primitive()["material"] = 1.into();
    std::fs::write(folder.path().join("model.glb"), model.glb()).unwrap();
    folder
}

fn load_text(folder: &Path, text: &str) -> Result<Scene, SceneError> {
    let path = folder.join("test.scene.json");
    std::fs::write(&path, text).unwrap();
    load_scene(&path)
}

fn with_sphere(rest: &str) -> String {
    format!(r#"{{"halfvector": 1, "objects": [{{"mesh": "sphere", "material": "plain.material.json"}}]{rest}}}"#)
}

#[test]
fn the_least_scene_has_the_defaults_of_a_bare_material() {
    let folder = folder();
    let scene = load_text(folder.path(), &with_sphere("")).unwrap();
    assert_eq!(scene.camera, Camera::default());
    assert_eq!(scene.environment, EnvironmentSource::Studio);
    assert_eq!((scene.lights.len(), scene.objects.len(), scene.materials.len()), (0, 1, 1));
    assert_eq!(
        (scene.background, scene.exposure, scene.tone_map),
        (Background::Environment, Exposure::Stops(0.0), ToneMap::PbrNeutral)
    );
    let needs = needs(&scene, ShaderOutput::Radiance);
    assert_eq!((needs.directional_lights, needs.point_lights, needs.spot_lights), (0, 0, 0));
    assert!(!needs.environment.unwrap().rotated);
    assert_eq!(scene.materials[0].directory, folder.path());
}

#[test]
fn everything_that_is_said_comes_through() {
    let folder = folder();
    let scene = load_text(
        folder.path(),
        r#"{
          "halfvector": 1,
          "name": "All",
          "objects": [
            {"mesh": "shaderball", "name": "ball",
             "material": {"file": "plain.material.json", "set": {"metallic": 1, "base_color": [0.1, 0.2, 0.3]}},
             "materials": {"stand": "plain.material.json"},
             "transform": {"translation": [1, 0, 0], "rotation_deg": [90, 90, 0], "scale": 2}},
            {"mesh": "model.glb", "materials": {"Steel": "plain.material.json"}, "transform": {"scale": [-1, 1, 1]}}
          ],
          "camera": {"position": [1, 2, 3], "target": [0, 1, 0], "up": [0, 0, 1], "vertical_fov_deg": 45},
          "lights": [
            {"type": "directional", "direction_to_light": [0, 2, 0], "illuminance_lx": 3, "color": [1, 0.5, 0]},
            {"type": "point", "position": [0, 1, 0], "power_lm": 100},
            {"type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0], "power_w": 1, "inner_deg": 0, "outer_deg": 60}
          ],
          "environment": {"source": "maps/room.hdr", "rotation_deg": 90},
          "background": [0.1, 0.2, 0.3],
          "exposure": {"ev100": 2},
          "tone_map": "agx",
          "preset": "report",
          "methods": {"normal": "tbn"}
        }"#,
    )
    .unwrap();
    assert_eq!(scene.name, "All");
    let names: Vec<_> = scene.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["ball.ball", "ball.core", "ball.stand", "thing"]);
    let material = |object: usize| &scene.materials[scene.objects[object].material].document;
    assert_eq!(material(0).graph.nodes["surface"].values["metallic"], Value::Number(1.0));
    assert_eq!(material(0).graph.nodes["surface"].values["base_color"], Value::Vec3([0.1, 0.2, 0.3]));
    assert_eq!(material(1).name, "Neutral grey");
    assert_eq!(
        (material(2).name.as_str(), &material(2).graph.nodes["surface"].values["metallic"]),
        ("Plain", &Value::Number(0.0))
    );
    assert_eq!(material(3).name, "Plain", "Steel is replaced");
    // About Y first: X goes to -Z, and about X then to +Y.
    let moved = scene.objects[0].world_from_object.transform_point3(Vec3::X);
    assert!((moved - Vec3::new(1.0, 2.0, 0.0)).length() < 1e-5, "{moved}");
    assert_eq!(scene.objects[3].handedness(), -1.0);
    assert_eq!(scene.camera.position, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(scene.camera.vertical_fov, 45.0);
    let [
        Light::Directional { direction_to_light, illuminance },
        Light::Point { intensity: point, .. },
        Light::Spot { intensity: spot, .. },
    ] = scene.lights[..]
    else {
        panic!("{:?}", scene.lights);
    };
    assert_eq!((direction_to_light, illuminance), (Vec3::Y, Vec3::new(3.0, 1.5, 0.0)));
    assert!((point.x - 100.0 / (4.0 * PI)).abs() < 1e-5);
    // A cone from the axis to 60 degrees: 2 pi (1 - 1/2) / 3.
    assert!((spot.x - 683.0 / (PI / 3.0)).abs() < 1e-2, "{spot}");
    assert_eq!(scene.environment, EnvironmentSource::File(folder.path().join("maps/room.hdr")));
    assert_eq!(scene.environment_rotation, 90.0);
    assert_eq!(scene.background, Background::Color([0.1, 0.2, 0.3]));
    assert!((scene.exposure.factor() - 1.0 / 4.8).abs() < 1e-6);
    assert_eq!(scene.tone_map, ToneMap::Agx);
    let needs = needs(&scene, ShaderOutput::Display(scene.tone_map));
    assert_eq!((needs.directional_lights, needs.point_lights, needs.spot_lights), (1, 1, 1));
    assert!(needs.environment.unwrap().rotated);
}

#[test]
fn a_model_is_framed_unless_a_camera_is_given() {
    let folder = folder();
    let scene =
        load_text(folder.path(), r#"{"halfvector": 1, "objects": [{"mesh": "model.glb"}], "environment": "none"}"#)
            .unwrap();
    assert_eq!(scene.camera, Camera::framing(scene.bounds().unwrap()));
    assert_eq!(needs(&scene, ShaderOutput::Radiance).environment, None);
    let names: Vec<_> = scene.materials.iter().map(|m| m.document.name.as_str()).collect();
    assert_eq!(names, ["Glass", "Steel"]);
    let by_number = load_text(
        folder.path(),
        r##"{"halfvector": 1, "objects": [{"mesh": "model.glb", "materials": {"#1": "plain.material.json"}}]}"##,
    )
    .unwrap();
    assert_eq!(by_number.materials[1].document.name, "Plain");
}

#[test]
fn wrong_scenes_say_what_is_wrong_and_where() {
    let folder = folder();
    let cases = [
        ("", "line 1, column 0"),
        ("{", "line 1, column 1"),
        ("[]", "line 1"),
        (r#"{"objects": []}"#, "a scene begins with \"halfvector\": 1"),
        (r#"{"halfvector": "1", "objects": []}"#, "a scene begins with"),
        (r#"{"halfvector": 2, "objects": [], "new": 1}"#, "newer program (version 2)"),
        (r#"{"halfvector": 1, "objects": []}"#, "objects: there is nothing to see"),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "ball"}]}"#,
            "objects[0].mesh: there is no mesh `ball`; choose sphere",
        ),
        (r#"{"halfvector": 1, "objects": [{"mesh": "gone.glb"}]}"#, "gone.glb could not be read"),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "material": "gone.json"}]}"#,
            "gone.json could not be read",
        ),
        (r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "material": 3}]}"#, "a material is a path, or"),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "materials": {"lid": "plain.material.json"}}]}"#,
            "objects[0].materials.lid: the sphere has the parts sphere",
        ),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "model.glb", "materials": {"Wood": "plain.material.json"}}]}"#,
            "the model has the materials #0 Glass, #1 Steel",
        ),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "material": {"file": "plain.material.json", "set": {"gloss": 1}}}]}"#,
            "objects[0].material.set: the material `Plain` has no parameter `gloss`; it offers metallic, base_color",
        ),
        (
            r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "transform": {"matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1], "scale": 2}}]}"#,
            "a matrix stands alone",
        ),
        (&with_sphere(r#", "colour": 1"#), "unknown field `colour`"),
        (&with_sphere(r#", "camera": {"position": [0, 0, 0]}"#), "camera: position and target are the same point"),
        (&with_sphere(r#", "camera": {"position": [0, 0, 1], "vertical_fov_deg": 190}"#), "190 degrees"),
        (&with_sphere(r#", "lights": [{"type": "sun"}]"#), "unknown variant `sun`"),
        (
            &with_sphere(r#", "lights": [{"type": "point", "position": [0, 0, 0]}]"#),
            "lights[0]: how strong is the light? Give one of intensity_cd, power_lm, power_w",
        ),
        (
            &with_sphere(r#", "lights": [{"type": "point", "position": [0, 0, 0], "power_lm": 1, "power_w": 1}]"#),
            "give only one of",
        ),
        (&with_sphere(r#", "lights": [{"type": "point", "position": [0, 0, 0], "power_lm": -1}]"#), "not negative"),
        (
            &with_sphere(
                r#", "lights": [{"type": "directional", "direction_to_light": [0, 0, 0], "illuminance_lx": 1}]"#,
            ),
            "no length",
        ),
        (&with_sphere(r#", "background": "black""#), "`black` is none of env, none"),
        (&with_sphere(r#", "tone_map": "filmic""#), "there is no tone map `filmic`; choose one of none, reinhard"),
        (&with_sphere(r#", "exposure": {"ev": 1}"#), "unknown variant `ev`"),
        (&with_sphere(r#", "preset": "best""#), "`best` is none of default, report"),
        (&with_sphere(r#", "methods": {"normal": "magic"}"#), "the term `normal` has no method `magic`"),
        (&with_sphere(r#", "environment": 3"#), "an environment is white, studio"),
    ];
    for (text, reason) in cases {
        let error = load_text(folder.path(), text).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(reason), "instead of `{reason}`: {error}");
        let elsewhere = error.contains("could not be read");
        assert!(elsewhere || error.contains("test.scene.json"), "{error} names the file");
    }
    let gone = load_scene(&folder.path().join("gone.scene.json")).unwrap_err().to_string();
    assert!(gone.contains("gone.scene.json could not be read"), "{gone}");
}

#[test]
fn images_are_found_shared_and_missed_by_name() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("maps")).unwrap();
    let picture = image::GrayImage::from_pixel(3, 2, image::Luma([7]));
    picture.save(folder.path().join("maps/a.png")).unwrap();
    let material = |file: &str, other: &str| {
        format!(
            r#"{{"halfvector": 1, "name": "Mapped", "nodes": {{
            "first": {{"node": "textures/image", "label": "First map", "values": {{"image": {{"file": "{file}", "color_space": "srgb"}}}}}},
            "second": {{"node": "textures/image", "values": {{"image": {{"file": "{other}", "color_space": "linear"}}}}}},
            "unused": {{"node": "textures/image", "values": {{"image": {{"file": "gone.png", "color_space": "linear"}}}}}},
            "surface": {{"node": "surface/surface"}}}},
            "links": [{{"from": "first.color", "to": "surface.base_color"}}, {{"from": "second.r", "to": "surface.metallic"}}]}}"#
        )
    };
    let path = folder.path().join("plain.material.json");
    std::fs::write(&path, material("maps/a.png", "./maps/../maps/a.png")).unwrap();
    let scene = load_text(folder.path(), &with_sphere("")).unwrap();
    assert_eq!(scene.images.images().len(), 1, "the same file twice is one picture");
    let Value::Image(reference) = &scene.materials[0].document.graph.nodes["second"].values["image"] else {
        panic!("an image")
    };
    let found = scene.images.get(&scene.materials[0].directory, reference).unwrap();
    assert_eq!((found.width(), found.height()), (3, 2));
    assert_eq!(scene.images.get(Path::new("/elsewhere"), reference), None);

    std::fs::write(&path, material("maps/none.png", "maps/a.png")).unwrap();
    let error = load_text(folder.path(), &with_sphere("")).unwrap_err().to_string();
    assert!(
        error.contains("node `First map` of the material `Mapped`") && error.contains("none.png could not be read"),
        "{error}"
    );

    std::fs::write(&path, material("maps/a.png", "plain.material.json")).unwrap();
    let error = load_text(folder.path(), &with_sphere("")).unwrap_err().to_string();
    assert!(
        error.contains("node `second` of the material `Mapped`") && error.contains("plain.material.json"),
        "{error}"
    );

    std::fs::write(&path, material("maps/a.png", "model.glb#0")).unwrap();
    let error = load_text(folder.path(), &with_sphere("")).unwrap_err().to_string();
    assert!(error.contains("images[0]") && error.contains("model.glb"), "{error}");
}

#[test]
fn a_bare_material_is_seen_on_any_mesh() {
    let folder = folder();
    let document = halfvector_graph::file::from_json(MATERIAL).unwrap();
    let scene = |mesh: &str| {
        let mesh = MeshSource::parse(mesh, folder.path()).unwrap();
        Scene::from_material(document.clone(), folder.path(), &mesh).unwrap()
    };
    let sphere = scene("sphere");
    assert_eq!((sphere.camera, sphere.objects.len(), sphere.materials.len()), (Camera::default(), 1, 1));
    assert_eq!(sphere.environment, EnvironmentSource::Studio);
    assert!(sphere.lights.is_empty());
    assert_eq!(sphere.bounds().unwrap().radius(), 3f32.sqrt());
    // The default camera has every shape in view.
    let slope = (0.5 * Camera::default().vertical_fov).to_radians().tan();
    for shape in BuiltinMesh::ALL {
        for object in scene(shape.name()).objects {
            let mesh = &shape.parts().into_iter().find(|p| p.name == object.name).unwrap().mesh;
            for position in &mesh.positions {
                let p = object.world_from_object.transform_point3(Vec3::from(*position));
                assert!(p.x.abs().max(p.y.abs()) < (5.0 - p.z) * slope, "{shape:?} leaves the picture at {p}");
            }
        }
    }
    // All of a model wears the material, and the camera frames it.
    let mut model = scene("model.glb");
    assert_eq!((model.materials.len(), model.objects[0].material), (1, 0));
    assert_eq!(model.camera, Camera::framing(model.bounds().unwrap()));
    // Another mesh takes the first one's place.
    model.set_mesh(&MeshSource::Builtin(BuiltinMesh::Shaderball)).unwrap();
    model.set_mesh(&MeshSource::Builtin(BuiltinMesh::Shaderball)).unwrap();
    let names: Vec<_> = model.materials.iter().map(|m| m.document.name.as_str()).collect();
    assert_eq!(names, ["Plain", "Neutral grey"]);
    assert_eq!((model.meshes.len(), model.camera), (3, Camera::default()));
    assert!(MeshSource::parse("ball", folder.path()).unwrap_err().contains("shaderball, or a .glb"));
}
