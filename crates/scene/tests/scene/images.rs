//! Images of materials: what is told about profiles, and normal maps that contradict their height map.

use std::path::Path;

use halfvector_graph::check::Severity;
use halfvector_scene::{ImageStore, SceneMaterial, normal_map_problems};
use image::{GrayImage, Luma, Rgb, RgbImage};
use tempfile::tempdir;

fn material(folder: &Path, nodes: &str, links: &str) -> SceneMaterial {
    let path = folder.join("test.material.json");
    let text = format!(
        r#"{{"halfvector": 1, "name": "Test", "nodes": {{{nodes}, "surface": {{"node": "surface/surface"}}}}, "links": [{links}]}}"#
    );
    std::fs::write(&path, text).unwrap();
    SceneMaterial { document: halfvector_graph::file::load(&path).unwrap(), directory: folder.to_owned() }
}

fn image_node(id: &str, file: &str, color_space: &str) -> String {
    format!(
        r#""{id}": {{"node": "textures/image", "values": {{"image": {{"file": "{file}", "color_space": "{color_space}"}}}}}}"#
    )
}

/// A linear PNG (gAMA 1) read as colour is brought to sRGB, read as data it is not; both are told, and are two images.
#[test]
fn profiles_are_applied_or_told() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("linear.png");
    GrayImage::from_pixel(2, 2, Luma([55])).save(&path).unwrap();
    let plain = std::fs::read(&path).unwrap();
    let gamma = [&[0, 0, 0, 4][..], b"gAMA", &100_000_u32.to_be_bytes(), &[0x31, 0xe8, 0x96, 0x5f]].concat();
    std::fs::write(&path, [&plain[..33], &gamma, &plain[33..]].concat()).unwrap();
    let nodes = [image_node("color", "linear.png", "srgb"), image_node("data", "linear.png", "linear")].join(",");
    let links = r#"{"from": "color.color", "to": "surface.base_color"}, {"from": "data.r", "to": "surface.metallic"}"#;
    let material = material(folder.path(), &nodes, links);
    let mut images = ImageStore::default();
    images.load(std::slice::from_ref(&material)).unwrap();
    let value = |node: &str| {
        let halfvector_graph::value::Value::Image(image) = &material.document.graph.nodes[node].values["image"] else {
            panic!("an image")
        };
        (images.get(folder.path(), image).unwrap().texel(0, 0)[0] * 255.0).round()
    };
    assert_eq!((images.images().len(), value("color"), value("data")), (2, 128.0, 55.0));
    let notes = images.notes().join("\n");
    assert!(notes.contains("linear.png: converted to sRGB from gAMA 1.00000"), "{notes}");
    assert!(notes.contains("gAMA 1.00000 is not applied, as the values are data"), "{notes}");
}

/// A -Y map beside its height map: a warning, with the way out; none where the switch is set, and none for a +Y map.
#[test]
fn a_wrong_green_is_warned_of() {
    let folder = tempdir().unwrap();
    let height = |x: u32, y: u32| (f64::from(x) * 0.4).sin() * (f64::from(y) * 0.3).cos();
    GrayImage::from_fn(64, 64, |x, y| Luma([(127.5 + 127.0 * height(x, y)) as u8]))
        .save(folder.path().join("height.png"))
        .unwrap();
    for (file, green) in [("plus.png", 1.0), ("minus.png", -1.0)] {
        RgbImage::from_fn(64, 64, |x, y| {
            let dx = height(x + 1, y) - height(x.max(1) - 1, y);
            let dy = height(x, y + 1) - height(x, y.max(1) - 1);
            let n = [-dx, green * dy, 1.0];
            let length = n.iter().map(|t| t * t).sum::<f64>().sqrt();
            Rgb(n.map(|t| ((0.5 * t / length + 0.5) * 255.0).round() as u8))
        })
        .save(folder.path().join(file))
        .unwrap();
    }
    for (file, flip_y, want) in [
        ("plus.png", false, None),
        ("plus.png", true, Some("plus.png is a +Y (OpenGL) map")),
        ("minus.png", false, Some("minus.png is a -Y (DirectX) map")),
        ("minus.png", true, None),
    ] {
        let nodes = [
            image_node("map", file, "linear"),
            image_node("field", "height.png", "linear"),
            format!(
                r#""bumps": {{"node": "textures/normal_map", "label": "Bumps", "values": {{"flip_y": {flip_y}}}}}"#
            ),
            r#""height": {"node": "textures/height"}"#.to_owned(),
        ]
        .join(",");
        let links = r#"{"from": "map.color", "to": "bumps.color"}, {"from": "bumps.out", "to": "surface.normal"},
            {"from": "field.r", "to": "height.value"}, {"from": "height.out", "to": "surface.height"}"#;
        let material = material(folder.path(), &nodes, links);
        let mut images = ImageStore::default();
        images.load(std::slice::from_ref(&material)).unwrap();
        let problems = normal_map_problems(&material, &images);
        match want {
            None => assert!(problems.is_empty(), "{file} {flip_y}: {problems:?}"),
            Some(words) => {
                let [problem] = problems.as_slice() else { panic!("{file} {flip_y}: {problems:?}") };
                assert_eq!((problem.severity, problem.node_label.as_deref()), (Severity::Warning, Some("Bumps")));
                let remedy = format!("set flip_y to {}", !flip_y);
                assert!(problem.message.contains(words) && problem.message.contains(&remedy), "{}", problem.message);
            }
        }
    }
}

/// A checker stands in for what cannot be read, until the file is there; what has not changed stays the same picture.
#[test]
fn a_checker_stands_in_until_the_file_comes() {
    let folder = tempdir().unwrap();
    GrayImage::from_pixel(2, 2, Luma([80])).save(folder.path().join("here.png")).unwrap();
    let nodes = [image_node("gone", "gone.png", "srgb"), image_node("here", "here.png", "linear")].join(",");
    let links = r#"{"from": "gone.color", "to": "surface.base_color"}, {"from": "here.r", "to": "surface.metallic"}"#;
    let material = material(folder.path(), &nodes, links);
    let mut images = ImageStore::default();
    let get = |images: &ImageStore, node: &str| {
        let halfvector_graph::value::Value::Image(image) = &material.document.graph.nodes[node].values["image"] else {
            panic!("an image")
        };
        images.images()[images.index(folder.path(), image).unwrap()].clone()
    };
    let load = |images: &mut ImageStore| {
        images.forget_changed();
        images.load_or_stand_in(std::slice::from_ref(&material)).len()
    };
    assert_eq!(load(&mut images), 1);
    let (checker, here) = (get(&images, "gone"), get(&images, "here"));
    assert_eq!(checker.texel(0, 0), [1.0, 0.0, 1.0, 1.0]);
    assert_eq!(checker.texel(checker.width() - 1, 0), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(load(&mut images), 0, "told twice");
    GrayImage::from_pixel(2, 2, Luma([255])).save(folder.path().join("gone.png")).unwrap();
    assert_eq!(load(&mut images), 0);
    assert_eq!(get(&images, "gone").texel(0, 0), [1.0; 4]);
    assert!(std::sync::Arc::ptr_eq(&get(&images, "here"), &here));
    assert_eq!(images.images().len(), 2);
    std::fs::remove_file(folder.path().join("gone.png")).unwrap();
    assert_eq!(load(&mut images), 1);
    assert_eq!(get(&images, "gone").texel(0, 0), [1.0, 0.0, 1.0, 1.0]);
}
