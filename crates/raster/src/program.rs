//! A shader that is ready to run: both stages, and which scalar of one stage is which of the other.

use halfvector_codegen::{Shader, place_of};
use halfvector_graph::library::CAPABILITIES;
use halfvector_interp::{Entry, Program, RunError, Slot};
use naga::valid::{ValidationFlags, Validator};
use naga::{Binding, BuiltIn};

use crate::error::RasterError;

/// What a scalar of a stage's arguments or results is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// A component of the position.
    Position(usize),
    /// A component of what goes by a location.
    Location(u32, usize),
    /// Whether the front is seen.
    FrontFacing,
    /// Something that this renderer does not give.
    Other,
}

/// Both stages of a shader.
#[derive(Debug)]
pub(crate) struct Stages {
    pub(crate) vertex: Program,
    pub(crate) fragment: Program,
}

/// Compiles entry points of a text. The error says what the interpreter does not do, or naga's words.
pub(crate) fn compile<const N: usize>(wgsl: &str, stages: [&str; N]) -> Result<[Program; N], String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.message().to_owned())?;
    let info = Validator::new(ValidationFlags::all(), CAPABILITIES)
        .validate(&module)
        .map_err(|error| error.as_inner().to_string())?;
    let mut programs = Vec::with_capacity(N);
    for name in stages {
        let program = Program::compile(&module, &info, Entry::EntryPoint(name)).map_err(|error| error.to_string())?;
        let foreign = program.inputs().iter().zip(parts(program.inputs())).find(|(_, part)| *part == Part::Other);
        if let Some((slot, _)) = foreign {
            return Err(format!("the stage `{name}` reads `{}`, which is not given on the CPU", slot.name));
        }
        programs.push(program);
    }
    programs.try_into().map_err(|_| "a stage is missing".to_owned())
}

impl Stages {
    /// Compiles the shader of a material.
    pub(crate) fn of(material: &str, shader: &Shader) -> Result<Stages, RasterError> {
        compile(&shader.wgsl, ["vs_main", "fs_main"])
            .map(|[vertex, fragment]| Stages { vertex, fragment })
            .map_err(|why| RasterError::Unsupported { material: material.to_owned(), why })
    }
}

/// What the scalars of a stage are, in their order.
pub(crate) fn parts(slots: &[Slot]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::with_capacity(slots.len());
    for slot in slots {
        // The components of one vector follow each other.
        parts.push(match (&slot.binding, parts.last()) {
            (Some(Binding::BuiltIn(BuiltIn::Position { .. })), Some(Part::Position(i))) => Part::Position(i + 1),
            (Some(Binding::BuiltIn(BuiltIn::Position { .. })), _) => Part::Position(0),
            (Some(Binding::BuiltIn(BuiltIn::FrontFacing)), _) => Part::FrontFacing,
            (Some(Binding::Location { location, .. }), Some(Part::Location(before, i))) if before == location => {
                Part::Location(*location, i + 1)
            }
            (Some(Binding::Location { location, .. }), _) => Part::Location(*location, 0),
            _ => Part::Other,
        });
    }
    parts
}

/// The error of a run, with the node that it happened in where it is known.
pub(crate) fn failed(material: &str, shader: Option<&Shader>, error: &RunError) -> RasterError {
    let span = match error {
        RunError::Steps { place, .. } => place.span.clone(),
        _ => None,
    };
    let place = shader.zip(span).and_then(|(shader, span)| place_of(shader, span.start));
    let place = place.map(|place| place.to_string()).unwrap_or_default();
    RasterError::Run { material: material.to_owned(), why: format!("{place}{error}") }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use halfvector_codegen::Fold;
    use halfvector_graph::document::{Document, Link, Node, SocketRef};
    use halfvector_graph::library::Library;
    use halfvector_graph::needs::ShaderOutput;
    use halfvector_interp::Place;
    use halfvector_scene::{BuiltinMesh, MeshSource, Scene, needs};

    use super::*;

    /// A loop that takes too long is told by the file of its node.
    #[test]
    fn a_run_that_does_not_end_names_the_file_of_its_node() {
        let mut document = Document::with_surface("slow");
        document.graph.nodes.insert("noise".into(), Node::new("procedural/fbm_3d"));
        document.graph.links.push(Link::new(SocketRef::new("noise", "out"), SocketRef::new("surface", "metallic")));
        let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
        let scene = Scene::from_material(document.clone(), Path::new(""), &sphere).expect("a scene");
        let needs = needs(&scene, ShaderOutput::Radiance);
        let shader = halfvector_codegen::shader(&document, Library::standard(), &needs, Fold::Export)
            .unwrap_or_else(|error| panic!("{error}"));
        let start = shader.wgsl.find("fn node_procedural_fbm_3d").expect("the node's function");
        // The name of the function would be told anyway.
        let place = Place { function: "f".to_owned(), span: Some(start..start + 2) };
        let told = failed("slow", Some(&shader), &RunError::Steps { limit: 1, place }).to_string();
        assert!(told.contains("`slow`") && told.contains("procedural/fbm.wgsl"), "{told}");
    }
}
