//! A scene as it is specialised: with the numbers of its surfaces known when a shader is made, or each a uniform.

use halfvector_graph::document::{Document, Parameter, SURFACE_NODE, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::node_def::Default as Unconnected;
use halfvector_scene::Scene;

/// The scene with every number of its materials known when a shader is made.
pub(super) fn specialised(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.materials.iter_mut().for_each(|material| material.document.parameters.clear());
    scene
}

/// The scene with every number that its surfaces take for themselves as a uniform.
pub(in crate::part) fn unspecialised(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.materials.iter_mut().for_each(|material| expose(&mut material.document));
    scene
}

/// Exposes every unlinked number of the surface nodes, beside what the document exposes.
fn expose(document: &mut Document) {
    let Some(definition) = Library::standard().get(SURFACE_NODE) else { return };
    let surfaces: Vec<String> =
        document.graph.nodes.iter().filter(|(_, node)| node.node == SURFACE_NODE).map(|(id, _)| id.clone()).collect();
    for surface in surfaces {
        for input in &definition.inputs {
            let socket = SocketRef::new(&surface, &input.name);
            let is_number = matches!(input.default, Unconnected::Value(_));
            let is_linked = document.graph.links.iter().any(|link| link.to == socket);
            let is_known = document.parameters.iter().any(|parameter| parameter.socket == socket);
            if is_number && !is_linked && !is_known {
                let name = format!("{surface}_{}", input.name);
                document.parameters.push(Parameter { name, label: None, socket, range: None });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{fragment_instructions, tests::scene};
    use super::*;

    /// Whatever a document exposes, its specialised shader is shorter, and has the lobes that the unspecialised one has, too, only
    /// where it needs them.
    #[test]
    fn specialised_shaders_are_the_shorter_ones() {
        let plain = Document::with_surface("plain");
        let mut exposed = plain.clone();
        expose(&mut exposed);
        assert!(exposed.parameters.len() > 15, "{:?}", exposed.parameters);
        let counts = [plain, exposed].map(|document| {
            let scene = scene(document);
            [specialised(&scene), unspecialised(&scene)].map(|scene| fragment_instructions(&scene).expect("a shader"))
        });
        assert_eq!(counts[0], counts[1]);
        assert!(counts[0][0] * 3 < counts[0][1], "{counts:?}");
    }

    /// Exposing again adds nothing, and linked inputs are no parameters.
    #[test]
    fn each_number_is_exposed_once() {
        let mut document = Document::with_surface("linked");
        document
            .graph
            .nodes
            .insert("hills".into(), halfvector_graph::document::Node::new("procedural/gradient_noise_2d"));
        let link = halfvector_graph::document::Link::new(
            SocketRef::new("hills", "out"),
            SocketRef::new("surface", "perceptual_roughness"),
        );
        document.graph.links.push(link);
        expose(&mut document);
        let count = document.parameters.len();
        expose(&mut document);
        assert_eq!(document.parameters.len(), count);
        assert!(document.parameters.iter().all(|parameter| parameter.socket.socket != "perceptual_roughness"));
    }
}
