//! Normal maps against the height maps beside them: a warning where green runs the other way than the material says.
//!
//! Looks at images that stand directly at a normal map's colour and at images that the surface's height is made of. What
//! is mixed or computed is passed over, as is a switch that is wired.

use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::{Document, Node};
use halfvector_graph::flatten::find;
use halfvector_graph::value::{ImageRef, Value};
use halfvector_maps::{Agreement, GreenSign, agreement};

use crate::images::{ImageStore, without_groups};
use crate::scene::SceneMaterial;

/// A warning for each normal map of the material that a height map of it contradicts. Images that `images` has not are
/// passed over.
pub fn normal_map_problems(material: &SceneMaterial, images: &ImageStore) -> Vec<Problem> {
    let document = without_groups(&material.document);
    let heights: Vec<&ImageRef> = height_images(&document);
    let normal_maps = document.graph.nodes.iter().filter(|(_, node)| node.node == "textures/normal_map");
    let mut problems = Vec::new();
    for (id, node) in normal_maps {
        let linked =
            |socket: &str| document.graph.links.iter().find(|link| link.to.node == *id && link.to.socket == socket);
        let (Some(link), None) = (linked("color"), linked("flip_y")) else { continue };
        let Some(image) = document.graph.nodes.get(&link.from.node).and_then(image_of) else { continue };
        let flips = matches!(node.values.get("flip_y"), Some(Value::Bool(true)));
        let found = heights.iter().find_map(|height| {
            let found = agreement(images.get(&material.directory, image)?, images.get(&material.directory, height)?)?;
            contradicts(&found, flips).then_some((height, found))
        });
        if let Some((height, found)) = found {
            let (group, id) = find(&material.document, id).map_or((None, id.as_str()), |(group, id, _)| (group, id));
            problems.push(Problem {
                severity: Severity::Warning,
                group: group.map(str::to_owned),
                node: Some(id.to_owned()),
                node_label: node.label.clone(),
                socket: Some("flip_y".to_owned()),
                message: message(&image.file, &height.file, &found, flips),
            });
        }
    }
    problems
}

fn contradicts(found: &Agreement, flips: bool) -> bool {
    found.maps_agree() && (found.green_sign == GreenSign::MinusY) != flips
}

fn message(normal: &str, height: &str, found: &Agreement, flips: bool) -> String {
    let (sign, kind) = match found.green_sign {
        GreenSign::MinusY => ("-Y", "DirectX"),
        _ => ("+Y", "OpenGL"),
    };
    let remedy = if flips { "set flip_y to false" } else { "set flip_y to true" };
    format!(
        "bumps will look like dents: {normal} is a {sign} ({kind}) map by the heights of {height} (green agrees with their \
         slopes by {:.2}); {remedy}",
        found.green.abs()
    )
}

/// The images that the surface's height is made of.
fn height_images(document: &Document) -> Vec<&ImageRef> {
    let is_surface = |id: &str| document.graph.nodes.get(id).is_some_and(|node| node.node.starts_with("surface/"));
    let mut open: Vec<&str> = document
        .graph
        .links
        .iter()
        .filter(|link| link.to.socket == "height" && is_surface(&link.to.node))
        .map(|link| link.from.node.as_str())
        .collect();
    let mut seen: Vec<&str> = Vec::new();
    while let Some(node) = open.pop() {
        if !seen.contains(&node) {
            seen.push(node);
            open.extend(
                document.graph.links.iter().filter(|link| link.to.node == node).map(|link| link.from.node.as_str()),
            );
        }
    }
    seen.into_iter().filter_map(|id| document.graph.nodes.get(id).and_then(image_of)).collect()
}

fn image_of(node: &Node) -> Option<&ImageRef> {
    node.values.values().find_map(|value| match value {
        Value::Image(image) => Some(image),
        _ => None,
    })
}
