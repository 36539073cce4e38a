//! Geometry, transforms, lights and cameras of glTF files.

use glam::{Mat4, Vec3};
use halfvector_scene::Light;
use serde_json::json;

use crate::support::{Builder, add, errors};

#[test]
fn a_triangle_comes_through() {
    let model = Builder::triangle().load().unwrap();
    assert_eq!((model.meshes.len(), model.objects.len(), model.materials.len()), (1, 1, 1));
    let mesh = &model.meshes[0];
    assert_eq!(mesh.positions[1], [1.0, 0.0, 0.0]);
    assert_eq!(mesh.indices, [0, 1, 2]);
    assert_eq!(mesh.uv0[2], [0.0, 0.0]);
    assert!(mesh.tangents.iter().all(|t| *t == [1.0, 0.0, 0.0, 1.0]));
    assert_eq!(model.objects[0].name, "thing");
    assert_eq!(model.materials[0].document.name, "glTF default");
    assert!(model.notes.is_empty(), "{:?}", model.notes);
}

#[test]
fn tangents_of_the_file_are_kept() {
    let mut builder = Builder::triangle();
    builder.attribute("TANGENT", &[[0.0, 1.0, 0.0, -1.0]; 3]);
    let mesh = &builder.load().unwrap().meshes[0];
    assert!(mesh.tangents.iter().all(|t| *t == [0.0, 1.0, 0.0, -1.0]));
}

/// glTF 2.0, section 3.7.2.1: three or four numbers, floats or normalised, multiply the base colour.
#[test]
fn colors_of_vertices_are_read_and_multiply_the_base_color() {
    let mut builder = Builder::triangle();
    builder.attribute("COLOR_0", &[[0.25, 0.5, 0.75]; 3]);
    let model = builder.load().unwrap();
    assert_eq!(model.meshes[0].colors, [[0.25, 0.5, 0.75, 1.0]; 3]);
    let links = |model: &halfvector_scene::gltf::Model| -> Vec<String> {
        let links = &model.materials[0].document.graph.links;
        let text = |s: &halfvector_graph::document::SocketRef| format!("{}.{}", s.node, s.socket);
        links.iter().map(|link| format!("{} -> {}", text(&link.from), text(&link.to))).collect()
    };
    assert_eq!(links(&model), ["vertex_color.color -> surface.base_color"]);
    assert!(model.notes.is_empty() && errors(&model.materials[0].document).is_empty());

    let bytes: Vec<u8> = [[255_u8, 0, 51, 102]; 3].concat();
    let view = builder.view(&bytes);
    let accessor = json!({"bufferView": view, "componentType": 5121, "normalized": true, "type": "VEC4", "count": 3});
    builder.primitive()["attributes"]["COLOR_0"] = builder.accessor(accessor).into();
    let factor = json!({"baseColorFactor": [0.5, 1.0, 1.0, 1.0]});
    add(&mut builder, "materials", json!({"alphaMode": "BLEND", "pbrMetallicRoughness": factor}));
    builder.primitive()["material"] = 0.into();
    let model = builder.load().unwrap();
    assert_eq!(model.meshes[0].colors, [[1.0, 0.0, 0.2, 0.4]; 3]);
    let expected = [
        "vertex_color.color -> base_color_factor.a",
        "base_color_factor.out -> surface.base_color",
        "vertex_color.alpha -> surface.opacity",
    ];
    assert_eq!(links(&model), expected);
    assert!(errors(&model.materials[0].document).is_empty());

    // Two numbers are no colour.
    builder.attribute("COLOR_0", &[[1.0, 1.0]; 3]);
    assert!(builder.load().is_err());
}

#[test]
fn strips_and_fans_become_triangles() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    for (mode, order, expected) in [(5, [0, 1, 2, 3], [0, 1, 2, 1, 3, 2]), (6, [0, 1, 3, 2], [1, 3, 0, 3, 2, 0])] {
        let mut builder = Builder::new();
        builder.attribute("POSITION", &square);
        builder.attribute("NORMAL", &[[0.0, 0.0, 1.0]; 4]);
        builder.indices(&order);
        builder.primitive()["mode"] = mode.into();
        let mesh = &builder.load().unwrap().meshes[0];
        assert_eq!(mesh.indices, expected, "mode {mode}");
    }
    let mut points = Builder::triangle();
    points.primitive()["mode"] = 0.into();
    let model = points.load().unwrap();
    assert!(model.objects.is_empty() && model.notes[0].contains("points or lines"), "{:?}", model.notes);
}

#[test]
fn absent_normals_are_flat() {
    let mut builder = Builder::new();
    builder.attribute("POSITION", &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]]);
    builder.indices(&[0, 1, 2, 0, 3, 1]);
    let mesh = &builder.load().unwrap().meshes[0];
    assert_eq!(mesh.positions.len(), 6);
    assert_eq!(mesh.normals[..3], [[0.0, 1.0, 0.0]; 3]);
    assert_eq!(mesh.normals[3..], [[0.0, 0.0, -1.0]; 3]);
}

#[test]
fn numbers_of_every_kind_are_read() {
    // Strided, normalised, of 8 and 16 bits, signed and unsigned.
    let mut builder = Builder::new();
    builder.attribute("POSITION", &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let view = builder.view(&[0, 0, 127, 9, 0, 129, 0, 9, 128, 0, 0, 9]);
    builder.json["bufferViews"][view]["byteStride"] = 4.into();
    let normals = builder
        .accessor(json!({"bufferView": view, "componentType": 5120, "type": "VEC3", "count": 3, "normalized": true}));
    builder.primitive()["attributes"]["NORMAL"] = normals.into();
    let view = builder.view(&[0, 0, 255, 255, 0, 128, 0, 0, 51, 51, 0, 0]);
    let uvs = builder
        .accessor(json!({"bufferView": view, "componentType": 5123, "type": "VEC2", "count": 3, "normalized": true}));
    builder.primitive()["attributes"]["TEXCOORD_0"] = uvs.into();
    let view = builder.view(&[2, 1, 0]);
    let indices = builder.accessor(json!({"bufferView": view, "componentType": 5121, "type": "SCALAR", "count": 3}));
    builder.primitive()["indices"] = indices.into();
    let mesh = &builder.load().unwrap().meshes[0];
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]]);
    assert_eq!(mesh.uv0, [[0.0, 1.0], [32768.0 / 65535.0, 0.0], [13107.0 / 65535.0, 0.0]]);
    assert_eq!(mesh.indices, [2, 1, 0]);
}

#[test]
fn whole_numbers_stay_whole_without_normalisation() {
    let mut builder = Builder::new();
    builder.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let numbers: Vec<u8> = [0i16, 0, 0, 0, 300, 0, 0, 0, 0, -7, 0, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = builder.view(&numbers);
    builder.json["bufferViews"][view]["byteStride"] = 8.into();
    let positions = builder.accessor(json!({"bufferView": view, "componentType": 5122, "type": "VEC3", "count": 3}));
    builder.primitive()["attributes"]["POSITION"] = positions.into();
    let mesh = &builder.load().unwrap().meshes[0];
    assert_eq!(mesh.positions, [[0.0; 3], [300.0, 0.0, 0.0], [0.0, -7.0, 0.0]]);
}

#[test]
fn sparse_accessors_change_single_elements() {
    let mut builder = Builder::triangle();
    let places = builder.view(&[2]);
    let values: Vec<u8> = [5.0f32, 6.0, 7.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let values = builder.view(&values);
    let sparse =
        json!({"count": 1, "indices": {"bufferView": places, "componentType": 5121}, "values": {"bufferView": values}});
    builder.json["accessors"][0]["sparse"] = sparse;
    let mesh = &builder.load().unwrap().meshes[0];
    assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [5.0, 6.0, 7.0]]);
    // Without a buffer view the others are zero.
    builder.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let mesh = &builder.load().unwrap().meshes[0];
    assert_eq!(mesh.positions, [[0.0; 3], [0.0; 3], [5.0, 6.0, 7.0]]);
    builder.json["accessors"][0]["count"] = 2.into();
    let message = builder.load().unwrap_err().to_string();
    assert!(message.contains("the sparse index 2 is not below 2"), "{message}");
}

#[test]
fn transforms_go_down_the_tree() {
    let mut builder = Builder::triangle();
    // Quarter turn about Z, mirrored and unevenly scaled below it.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    builder.json["nodes"] = json!([
        {"children": [1, 2], "rotation": [0.0, 0.0, half, half], "translation": [10.0, 0.0, 0.0]},
        {"mesh": 0, "scale": [-2.0, 3.0, 0.5], "name": "mirrored"},
        {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,4,1]}
    ]);
    let model = builder.load().unwrap();
    assert_eq!((model.meshes.len(), model.objects.len()), (1, 2), "both objects share the mesh");
    let mirrored = &model.objects[0];
    let point = mirrored.world_from_object.transform_point3(Vec3::new(1.0, 1.0, 1.0));
    assert!((point - Vec3::new(7.0, -2.0, 0.5)).length() < 1e-5, "{point}");
    assert_eq!((mirrored.handedness(), model.objects[1].handedness()), (-1.0, 1.0));
    // Normals leave the mirrored and squeezed surface at right angles, outwards.
    let normal = (mirrored.normal_from_object() * Vec3::new(1.0, 1.0, 1.0)).normalize();
    for direction in [Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, -1.0)] {
        let along = mirrored.world_from_object.transform_vector3(direction);
        assert!(normal.dot(along).abs() < 1e-5);
    }
    assert!(normal.dot(mirrored.world_from_object.transform_vector3(Vec3::ONE)) > 0.0);
    let far = model.objects[1].world_from_object.transform_point3(Vec3::ZERO);
    assert!((far - Vec3::new(10.0, 0.0, 4.0)).length() < 1e-5);
}

#[test]
fn a_file_without_scenes_shows_its_roots() {
    let mut builder = Builder::triangle();
    builder.json.as_object_mut().unwrap().remove("scene");
    builder.json.as_object_mut().unwrap().remove("scenes");
    builder.json["nodes"] = json!([{"mesh": 0}, {"children": [0], "scale": [2, 2, 2]}]);
    let model = builder.load().unwrap();
    assert_eq!(model.objects.len(), 1);
    assert_eq!(model.objects[0].world_from_object, Mat4::from_scale(Vec3::splat(2.0)));
}

#[test]
fn lights_shine_along_minus_z_of_their_node() {
    let mut builder = Builder::triangle();
    builder.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    builder.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 3.0, "color": [1.0, 0.5, 0.0]},
        {"type": "point", "intensity": 20.0, "range": 5.0},
        {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}
    ]}});
    let half = std::f32::consts::FRAC_1_SQRT_2;
    builder.json["nodes"] = json!([
        {"children": [1, 2, 3], "scale": [2, 2, 2]},
        {"rotation": [-half, 0, 0, half], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}}
    ]);
    let model = builder.load().unwrap();
    let [
        Light::Directional { direction_to_light, illuminance },
        Light::Point { position, intensity },
        Light::Spot { direction, inner_angle, outer_angle, .. },
    ] = model.lights[..]
    else {
        panic!("three lights: {:?}", model.lights);
    };
    assert!((direction_to_light - Vec3::Y).length() < 1e-6, "{direction_to_light}");
    assert_eq!(illuminance, Vec3::new(3.0, 1.5, 0.0));
    assert_eq!((position, intensity), (Vec3::new(0.0, 6.0, 0.0), Vec3::splat(20.0)));
    assert_eq!((direction, inner_angle, outer_angle), (Vec3::NEG_Z, 0.1, 0.5));
    assert!(model.notes.iter().any(|n| n.contains("range")), "{:?}", model.notes);
}

#[test]
fn the_models_camera_is_taken() {
    let mut builder = Builder::triangle();
    builder.json["cameras"] = json!([
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 10, "znear": 0.1}},
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}
    ]);
    builder.json["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    builder.json["nodes"] = json!([{"mesh": 0}, {"camera": 0}, {"camera": 1, "translation": [0.5, 0.5, 8.0]}]);
    let camera = builder.load().unwrap().camera.unwrap();
    assert_eq!(camera.position, Vec3::new(0.5, 0.5, 8.0));
    assert!((camera.target - Vec3::new(0.5, 0.5, 0.0)).length() < 1e-5);
    assert!((camera.vertical_fov.to_radians() - 0.5).abs() < 1e-6);
}

#[test]
fn what_is_passed_over_is_noted() {
    let mut builder = Builder::triangle();
    builder.attribute("COLOR_1", &[[1.0, 0.0, 0.0]; 3]);
    builder.attribute("_TEMPERATURE", &[[1.0]; 3]);
    builder.json["extensionsUsed"] = json!(["KHR_materials_dispersion"]);
    add(&mut builder, "skins", json!({"joints": [0]}));
    let notes = builder.load().unwrap().notes.join("; ");
    assert!(
        notes.contains("vertex colours beyond the first, skins") && notes.contains("KHR_materials_dispersion"),
        "{notes}"
    );
}
