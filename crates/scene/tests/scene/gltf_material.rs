//! Materials of glTF files as documents.

use halfvector_graph::check::check;
use halfvector_graph::document::{AlphaMode, Document};
use halfvector_graph::library::Library;
use halfvector_graph::value::{ColorSpace, Filter, Value, Wrap};
use serde_json::{Value as Json, json};

use crate::support::{Builder, add};

fn document(material: Json, change: impl FnOnce(&mut Builder)) -> Document {
    let mut builder = Builder::triangle();
    add(&mut builder, "materials", material);
    builder.primitive()["material"] = 0.into();
    for (name, uri) in [("color", "c%20o.png"), ("packed", "packed.png"), ("bumps", "sub/bumps.png")] {
        let image = add(&mut builder, "images", json!({"uri": uri, "name": name}));
        add(&mut builder, "textures", json!({"source": image}));
    }
    change(&mut builder);
    let model = builder.load().unwrap();
    let material = &model.materials[0];
    assert_eq!(material.directory, std::path::Path::new("folder"));
    let problems = check(&material.document, Library::standard());
    assert!(problems.is_empty(), "{problems:?}");
    material.document.clone()
}

fn links(document: &Document) -> Vec<String> {
    let text = |s: &halfvector_graph::document::SocketRef| format!("{}.{}", s.node, s.socket);
    document.graph.links.iter().map(|l| format!("{} -> {}", text(&l.from), text(&l.to))).collect()
}

#[test]
fn factors_alone_make_one_node() {
    let document = document(
        json!({
            "name": "Plain",
            "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6},
            "emissiveFactor": [1.0, 0.5, 0.0],
            "alphaMode": "BLEND", "doubleSided": true,
            "extensions": {
                "KHR_materials_ior": {"ior": 1.33},
                "KHR_materials_specular": {"specularFactor": 0.7},
                "KHR_materials_emissive_strength": {"emissiveStrength": 4.0}
            }
        }),
        |_| {},
    );
    assert_eq!(document.name, "Plain");
    assert_eq!(document.graph.nodes.len(), 1);
    let values = &document.graph.nodes["surface"].values;
    assert_eq!(values["base_color"], Value::Vec3([0.1, 0.2, 0.3]));
    assert_eq!(values["opacity"], Value::Number(0.4));
    assert_eq!(values["metallic"], Value::Number(0.5));
    assert_eq!(values["perceptual_roughness"], Value::Number(0.6));
    assert_eq!(values["emission"], Value::Vec3([4.0, 2.0, 0.0]));
    assert_eq!(values["ior"], Value::Number(1.33));
    assert_eq!(values["specular"], Value::Number(0.7));
    assert_eq!(document.surface.alpha_mode, AlphaMode::Blend);
    assert!(document.surface.double_sided);
}

#[test]
fn defaults_are_gltfs() {
    let document = document(json!({}), |_| {});
    let values = &document.graph.nodes["surface"].values;
    assert_eq!(values["base_color"], Value::Vec3([1.0; 3]));
    assert_eq!((&values["metallic"], &values["perceptual_roughness"]), (&Value::Number(1.0), &Value::Number(1.0)));
    assert_eq!(values.len(), 3, "nothing that costs without need");
    assert_eq!(document.surface, Default::default());
}

#[test]
fn maps_are_wired_with_their_channels() {
    let document = document(
        json!({
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1},
                "baseColorFactor": [1, 1, 1, 1], "roughnessFactor": 0.5
            },
            "normalTexture": {"index": 2, "scale": 0.8},
            "occlusionTexture": {"index": 1, "strength": 0.25},
            "emissiveTexture": {"index": 0}, "emissiveFactor": [2, 2, 2]
        }),
        |_| {},
    );
    assert_eq!(
        links(&document),
        [
            "base_color_map.color -> surface.base_color",
            "metallic_roughness_map.b -> surface.metallic",
            "metallic_roughness_map.g -> roughness_factor.a",
            "roughness_factor.out -> surface.perceptual_roughness",
            "normal_map.color -> normal.color",
            "normal.out -> surface.normal",
            "metallic_roughness_map.r -> occlusion.b",
            "occlusion.out -> surface.occlusion",
            "base_color_map.color -> emission_factor.a",
            "emission_factor.out -> surface.emission",
        ]
    );
    let image = |node: &str| match &document.graph.nodes[node].values["image"] {
        Value::Image(image) => image.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(image("base_color_map").file, "c o.png");
    assert_eq!(image("base_color_map").color_space, ColorSpace::Srgb);
    assert_eq!(image("metallic_roughness_map").color_space, ColorSpace::Linear);
    assert_eq!(
        (image("normal_map").file.as_str(), image("normal_map").color_space),
        ("sub/bumps.png", ColorSpace::Linear)
    );
    assert_eq!(document.graph.nodes["normal"].values["strength"], Value::Number(0.8));
    assert_eq!(document.graph.nodes["occlusion"].values["t"], Value::Number(0.25));
    assert_eq!(document.graph.nodes["normal_map"].label.as_deref(), Some("bumps"));
}

#[test]
fn alpha_is_read_only_where_it_does_something() {
    let material = |mode: &str| {
        json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5]},
               "alphaMode": mode, "alphaCutoff": 0.3})
    };
    let opaque = document(material("OPAQUE"), |_| {});
    assert!(!links(&opaque).iter().any(|l| l.contains("alpha")));
    let mask = document(material("MASK"), |_| {});
    assert!(links(&mask).contains(&"base_color_map.alpha -> opacity_factor.a".to_owned()));
    assert_eq!((mask.surface.alpha_mode, mask.surface.alpha_cutoff), (AlphaMode::Mask, 0.3));
}

#[test]
fn samplers_sets_and_transforms_are_kept() {
    let transform = json!({"KHR_texture_transform": {
        "offset": [0.25, 0.5], "rotation": std::f32::consts::FRAC_PI_2, "scale": [2, 3], "texCoord": 1}});
    let document = document(
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 3, "extensions": transform}},
            "normalTexture": {"index": 2, "texCoord": 1},
            "occlusionTexture": {"index": 1, "extensions": {"KHR_texture_transform": {"scale": [4, 4]}}}
        }),
        |builder| {
            let sampler = json!({"wrapS": 33071, "wrapT": 33648, "magFilter": 9728});
            add(builder, "samplers", sampler);
            add(builder, "textures", json!({"source": 0, "sampler": 0}));
        },
    );
    let Value::Image(image) = &document.graph.nodes["base_color_map"].values["image"] else { panic!("an image") };
    assert_eq!((image.wrap_u, image.wrap_v, image.filter), (Wrap::Clamp, Wrap::Mirror, Filter::Nearest));
    let moved = &document.graph.nodes["base_color_map_transform"];
    assert_eq!(moved.node, "coordinates/uv_transform");
    assert_eq!(moved.values["offset"], Value::Vec2([0.25, 0.5]));
    assert_eq!(moved.values["rotation"], Value::Number(90.0));
    assert_eq!(moved.values["scale"], Value::Vec2([2.0, 3.0]));
    let links = links(&document);
    for link in [
        "base_color_map_uv1.out -> base_color_map_transform.uv",
        "base_color_map_transform.out -> base_color_map.uv",
        "normal_map_uv1.out -> normal_map.uv",
        "occlusion_map_transform.out -> occlusion_map.uv",
    ] {
        assert!(links.contains(&link.to_owned()), "{link} is not among {links:?}");
    }
}

#[test]
fn images_within_the_file_have_numbers() {
    let document = document(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 3}}}), |builder| {
        let view = builder.view(b"not read yet");
        let image = add(builder, "images", json!({"bufferView": view, "mimeType": "image/png"}));
        add(builder, "textures", json!({"source": image}));
    });
    let Value::Image(image) = &document.graph.nodes["base_color_map"].values["image"] else { panic!("an image") };
    assert_eq!(image.file, "model.glb#3");
}

#[test]
fn tangents_follow_the_normal_maps_coordinates() {
    let mut builder = Builder::triangle();
    builder.attribute("TEXCOORD_1", &[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
    add(&mut builder, "images", json!({"uri": "bumps.png"}));
    add(&mut builder, "textures", json!({"source": 0}));
    add(&mut builder, "materials", json!({"normalTexture": {"index": 0, "texCoord": 1}}));
    builder.primitive()["material"] = 0.into();
    let mesh = &builder.load().unwrap().meshes[0];
    assert!(mesh.tangents.iter().all(|t| (t[1] - 1.0).abs() < 1e-6), "{:?}", mesh.tangents);
}

/// The values and links of every lobe, each factor and texture by its own number.
#[test]
fn lobes_are_the_extensions() {
    let lobes = document(
        json!({
            "extensions": {
                "KHR_materials_clearcoat": {
                    "clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.2, "clearcoatRoughnessTexture": {"index": 1},
                    "clearcoatNormalTexture": {"index": 2, "scale": 0.5}},
                "KHR_materials_sheen": {"sheenColorFactor": [0.3, 0.2, 0.1], "sheenRoughnessFactor": 0.6},
                "KHR_materials_transmission": {"transmissionFactor": 0.9},
                "KHR_materials_anisotropy": {"anisotropyStrength": 0.7, "anisotropyRotation": 1.5},
                "KHR_materials_iridescence": {"iridescenceFactor": 1.0, "iridescenceThicknessMaximum": 550}
            }
        }),
        |_| {},
    );
    let values = &lobes.graph.nodes["surface"].values;
    for (socket, value) in [
        ("coat_weight", 0.8),
        ("sheen_roughness", 0.6),
        ("transmission_weight", 0.9),
        ("anisotropy", 0.7),
        ("anisotropy_rotation", 1.5),
        ("thin_film_weight", 1.0),
        ("thin_film_ior", 1.3),
        ("thin_film_thickness", 0.55),
    ] {
        assert_eq!(values[socket], Value::Number(value), "{socket}");
    }
    assert_eq!(values["sheen_color"], Value::Vec3([0.3, 0.2, 0.1]));
    assert!(lobes.surface.thin_walled, "no volume: a sheet");
    let links = links(&lobes);
    for link in [
        "coat_roughness_map.g -> coat_roughness_factor.a",
        "coat_roughness_factor.out -> surface.coat_roughness",
        "coat_normal_map.color -> coat_normal.color",
        "coat_normal.out -> surface.coat_normal",
    ] {
        assert!(links.contains(&link.to_owned()), "{link} is not among {links:?}");
    }
}

#[test]
fn directions_and_thicknesses_come_from_textures() {
    let brushed = document(
        json!({"extensions": {
            "KHR_materials_anisotropy": {
                "anisotropyStrength": 0.7, "anisotropyRotation": 0.5, "anisotropyTexture": {"index": 1}},
            "KHR_materials_iridescence": {"iridescenceFactor": 1.0, "iridescenceThicknessTexture": {"index": 0}},
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_volume": {"thicknessFactor": 2.0}
        }}),
        |_| {},
    );
    assert!(!brushed.surface.thin_walled, "a volume: a body");
    let links = links(&brushed);
    for link in [
        "anisotropy_map.b -> anisotropy_factor.a",
        "anisotropy_map.r -> anisotropy_x.a",
        "anisotropy_angle.out -> anisotropy_turned.a",
        "anisotropy_turned.out -> surface.anisotropy_rotation",
        "film_thickness_map.g -> film_thickness.t",
    ] {
        assert!(links.contains(&link.to_owned()), "{link} is not among {links:?}");
    }
}

#[test]
fn what_is_not_read_is_noted_and_what_is_wrong_is_named() {
    let load = |extensions: Json| {
        let mut builder = Builder::triangle();
        add(&mut builder, "materials", json!({"name": "Jelly", "extensions": extensions}));
        builder.primitive()["material"] = 0.into();
        builder.load()
    };
    let model = load(json!({"KHR_materials_volume": {"thicknessFactor": 1.0}})).unwrap();
    assert!(model.notes.iter().any(|note| note.contains("Jelly") && note.contains("KHR_materials_volume")));
    let error = load(json!({"KHR_materials_clearcoat": {"clearcoatFactor": "much"}})).unwrap_err().to_string();
    assert!(error.contains("materials[0]") && error.contains("clearcoatFactor"), "{error}");
}
