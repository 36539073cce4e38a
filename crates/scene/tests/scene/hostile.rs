//! Broken and hostile glTF files: an error that names the file and the place, never a panic.

use proptest::prelude::*;
use serde_json::{Value, json};

use crate::support::{Builder, add, load};

/// A file that uses most of what is read.
fn rich() -> Builder {
    let mut builder = Builder::triangle();
    builder.indices(&[0, 1, 2]);
    builder.attribute("TANGENT", &[[1.0, 0.0, 0.0, 1.0]; 3]);
    let places = builder.view(&[2, 0, 0, 0]);
    let values = builder.view(&[0; 12]);
    builder.json["accessors"][0]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": places, "componentType": 5121}, "values": {"bufferView": values}});
    let picture = builder.view(b"\x89PNG\r\n\x1a\nnothing more");
    add(&mut builder, "images", json!({"bufferView": picture, "mimeType": "image/png"}));
    add(&mut builder, "images", json!({"uri": "data:image/png;base64,iVBORw0KGgo="}));
    add(&mut builder, "samplers", json!({"wrapS": 33071}));
    add(&mut builder, "textures", json!({"source": 0, "sampler": 0}));
    add(&mut builder, "textures", json!({"source": 1}));
    add(
        &mut builder,
        "materials",
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1, "texCoord": 0}},
            "normalTexture": {"index": 1, "scale": 2}, "alphaMode": "MASK", "alphaCutoff": 0.25
        }),
    );
    builder.primitive()["material"] = 0.into();
    builder.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]);
    builder.json["extensions"] =
        json!({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}});
    builder.json["nodes"] = json!([
        {"children": [1, 2], "rotation": [0, 0, 0, 1]},
        {"mesh": 0, "scale": [1, -1, 1]},
        {"camera": 0, "translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}
    ]);
    builder
}

fn refused(builder: &Builder, reason: &str) {
    let message = builder.load().unwrap_err().to_string();
    assert!(message.contains(reason) && message.contains("model.glb"), "instead of `{reason}`: {message}");
}

#[test]
fn the_rich_file_is_sound() {
    let model = rich().load().unwrap();
    assert_eq!((model.objects.len(), model.lights.len(), model.materials.len()), (1, 1, 1));
    assert!(model.camera.is_some());
}

#[test]
fn wrong_files_say_what_is_wrong() {
    type Change = fn(&mut Value);
    let cases: &[(Change, &str)] = &[
        (|j| j["asset"]["version"] = "1.0".into(), "this is glTF 1.0"),
        (|j| j["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), "requires KHR_draco_mesh_compression"),
        (|j| j["scene"] = 7.into(), "it refers to scenes[7], and the file has 1"),
        (|j| j["nodes"][1]["mesh"] = 3.into(), "nodes[1]: it refers to meshes[3]"),
        (|j| j["nodes"][1]["children"] = json!([0]), "nodes[0]: the node has two parents or is its own ancestor"),
        (|j| j["nodes"][0]["children"] = json!([1, 1]), "two parents"),
        (|j| j["nodes"][0]["children"] = json!([9]), "nodes[0]: it refers to nodes[9]"),
        (|j| j["nodes"][1]["scale"] = json!([1e300, 1, 1]), "nodes[1]: the transform is not finite"),
        (|j| j["meshes"][0]["primitives"][0]["attributes"] = json!({}), "meshes[0].primitives[0]: it has no POSITION"),
        (|j| j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99.into(), "it refers to accessors[99]"),
        (|j| j["meshes"][0]["primitives"][0]["material"] = 5.into(), "it refers to materials[5]"),
        (|j| j["meshes"][0]["primitives"][0]["mode"] = 9.into(), "the mode is none of glTF's"),
        (|j| j["accessors"][0]["count"] = 4.into(), "4 elements do not fit"),
        (|j| j["accessors"][0]["count"] = u64::MAX.into(), "elements are more than"),
        (|j| j["accessors"][1]["count"] = 2.into(), "3 positions but 2 normals"),
        (|j| j["accessors"][0]["type"] = "VEC2".into(), "should have 3 components"),
        (|j| j["accessors"][0]["type"] = "MAT3".into(), "should have 3 components"),
        (|j| j["accessors"][0]["componentType"] = 5124.into(), "the componentType is none of glTF's"),
        (|j| j["accessors"][0]["componentType"] = 5125.into(), "which no vertex has"),
        (|j| j["accessors"][0]["byteOffset"] = u64::MAX.into(), "do not fit"),
        (|j| j["accessors"][3]["componentType"] = 5126.into(), "of indices must be"),
        (|j| j["bufferViews"][0]["byteStride"] = 4.into(), "the byteStride 4 is less than an element's 12 bytes"),
        (|j| j["bufferViews"][0]["byteOffset"] = u64::MAX.into(), "leave the buffer"),
        (|j| j["bufferViews"][0]["buffer"] = 2.into(), "bufferViews[0]: it refers to buffers[2]"),
        (|j| j["buffers"][0]["uri"] = "https://example.com/x.bin".into(), "buffers[0]: the URI begins with `https:`"),
        (|j| j["buffers"][0]["uri"] = "/etc/hostname".into(), "is absolute"),
        (|j| j["buffers"][0]["uri"] = "gone.bin".into(), "folder/gone.bin could not be read"),
        (|j| j["buffers"][0]["uri"] = "data:;base64,AAAA".into(), "and has 3: it is cut off"),
        (|j| j["materials"][0]["alphaMode"] = "GLASS".into(), "materials[0]: alphaMode"),
        (|j| j["materials"][0]["emissiveFactor"] = json!([1e300, 0, 0]), "materials[0]: emissiveFactor is not finite"),
        (|j| j["materials"][0]["normalTexture"]["index"] = 8.into(), "materials[0]: it refers to textures[8]"),
        (|j| j["textures"][0]["source"] = 4.into(), "textures[0]: it refers to images[4]"),
        (|j| j["textures"][0]["sampler"] = 4.into(), "textures[0]: it refers to samplers[4]"),
        (
            |j| j["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = (-1).into(),
            "lights[0]: colour times intensity",
        ),
        (
            |j| j["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["outerConeAngle"] = 3.into(),
            "the cone is 0 to 3",
        ),
        (|j| j["extensions"] = Value::Null, "nodes[2]: it refers to lights[0]"),
        (|j| j["meshes"] = "many".into(), "JSON: invalid type"),
    ];
    for (change, reason) in cases {
        let mut builder = rich();
        change(&mut builder.json);
        refused(&builder, reason);
    }
}

#[test]
fn wrong_containers_say_what_is_wrong() {
    let glb = rich().glb();
    for (bytes, reason) in [
        (&b""[..], "this is no glTF"),
        (b"{", "this is no glTF"),
        (b"{}", "missing field `asset`"),
        (b"glTF", "cut off"),
        (&glb[..glb.len() - 1], "the header promises"),
        (&glb[..100], "the header promises"),
        (b"\xff\xd8\xff\xe0 a picture", "this is no glTF"),
    ] {
        let message = load(bytes).unwrap_err().to_string();
        assert!(message.contains(reason) && message.contains("model.glb"), "instead of `{reason}`: {message}");
    }
    let mut old = glb.clone();
    old[4] = 1;
    assert!(load(&old).unwrap_err().to_string().contains("this is GLB 1"));
    let mut binary_first = glb.clone();
    binary_first[16..20].copy_from_slice(b"BIN\0");
    assert!(load(&binary_first).unwrap_err().to_string().contains("the first chunk is not JSON"));
}

#[test]
fn deep_and_wide_files_are_served() {
    // A chain of nodes much deeper than any stack of calls, and JSON nested deeper than is read.
    let mut builder = Builder::triangle();
    let depth = 200_000;
    let mut nodes: Vec<Value> = (1..depth).map(|i| json!({"children": [i]})).collect();
    nodes.push(json!({"mesh": 0}));
    builder.json["nodes"] = nodes.into();
    assert_eq!(builder.load().unwrap().objects.len(), 1);
    let nested =
        format!("{{\"asset\": {{\"version\": \"2.0\"}}, \"extras\": {}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let _refused_or_not = load(nested.as_bytes());
    // Zeros out of nothing, and the same vertices again and again.
    let mut zeros = Builder::triangle();
    zeros.json["accessors"][0]["count"] = 60_000_000.into();
    let accessor = zeros.json["accessors"][0].as_object_mut().unwrap();
    accessor.remove("bufferView");
    accessor.insert(
        "sparse".into(),
        json!({"count": 1, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0}}),
    );
    refused(&zeros, "without a bufferView are more than");
    let mut many = Builder::triangle();
    many.json["accessors"][0]["count"] = 40_000_000.into();
    let primitive = many.primitive().clone();
    many.json["meshes"][0]["primitives"] = vec![primitive; 2].into();
    refused(&many, "the model has more than");
}

/// Visits every number of the JSON; `at` counts down to the one that is replaced.
fn replace_number(value: &mut Value, at: &mut usize, with: &Value) -> bool {
    match value {
        Value::Number(_) if *at == 0 => {
            *value = with.clone();
            true
        }
        Value::Number(_) => {
            *at -= 1;
            false
        }
        Value::Array(list) => list.iter_mut().any(|v| replace_number(v, at, with)),
        Value::Object(map) => map.values_mut().any(|v| replace_number(v, at, with)),
        _ => false,
    }
}

fn never_panics(bytes: &[u8]) {
    match load(bytes) {
        Ok(model) => {
            for mesh in &model.meshes {
                assert!(mesh.indices.iter().all(|&i| (i as usize) < mesh.positions.len()));
                assert!(mesh.tangents.iter().flatten().chain(mesh.normals.iter().flatten()).all(|x| x.is_finite()));
            }
        }
        Err(error) => assert!(error.to_string().contains("model.glb")),
    }
}

#[test]
fn any_cut_is_an_error() {
    let glb = rich().glb();
    for length in 0..glb.len() {
        load(&glb[..length]).unwrap_err();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_never_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut glb = rich().glb();
        for (at, byte) in changes {
            let at = at.index(glb.len());
            glb[at] = byte;
        }
        never_panics(&glb);
    }

    #[test]
    fn changed_numbers_never_panic(
        at in 0usize..120,
        number in prop_oneof![
            any::<i64>().prop_map(Value::from), any::<u64>().prop_map(Value::from), (0u64..300).prop_map(Value::from),
            any::<f64>().prop_map(Value::from), Just(json!(5126)), Just(json!(4294967295u64)), Just(json!(1e300)),
        ],
    ) {
        let mut builder = rich();
        replace_number(&mut builder.json, &mut at.clone(), &number);
        never_panics(&builder.glb());
    }
}
