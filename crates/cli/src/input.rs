//! What commands read: materials, scenes and models, told apart by their content, checked before work begins.

use std::ffi::OsStr;
use std::io::Read;
use std::path::Path;

use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::Document;
use halfvector_graph::file::MAX_BYTES;
use halfvector_graph::library::Library;
use halfvector_scene::{BuiltinMesh, MeshSource, Scene, SceneError};
use serde::de::IgnoredAny;

use crate::failure::Failure;

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `*.material.json`
    Material,
    /// `*.scene.json`
    Scene,
    /// `.glb` or `.gltf`
    Model,
}

/// The fields that tell what a document is. What stands in them is read over, and nothing of it is kept.
#[derive(serde::Deserialize)]
struct Fields {
    nodes: Option<IgnoredAny>,
    base: Option<IgnoredAny>,
    mesh: Option<IgnoredAny>,
    objects: Option<IgnoredAny>,
    model: Option<IgnoredAny>,
    camera: Option<IgnoredAny>,
    environment: Option<IgnoredAny>,
}

/// Tells what a file is: a model by its extension, documents by their fields.
pub(crate) fn kind(path: &Path) -> Result<Kind, Failure> {
    let extension = path.extension().and_then(OsStr::to_str).map(str::to_lowercase);
    if matches!(extension.as_deref(), Some("glb" | "gltf")) {
        return Ok(Kind::Model);
    }
    let bytes = read(path).map_err(|why| {
        Failure::input("the file could not be read")
            .at(path)
            .because(why)
            .try_to("a *.material.json or *.scene.json file; examples/ has some")
    })?;
    match serde_json::from_slice::<Fields>(&bytes) {
        Ok(fields) => {
            if fields.nodes.or(fields.base).is_some() {
                return Ok(Kind::Material);
            }
            let Fields { mesh, objects, model, camera, environment, .. } = fields;
            if mesh.or(objects).or(model).or(camera).or(environment).is_some() {
                return Ok(Kind::Scene);
            }
        }
        // JSON, but no object of these fields.
        Err(error) if error.is_data() => {}
        // The reader of the kind that the name promises says it better, with line and column.
        Err(error) => {
            return by_name(path).ok_or_else(|| {
                Failure::input("the file is no JSON")
                    .at(path)
                    .because(error)
                    .try_to("a *.material.json or *.scene.json file")
            });
        }
    }
    by_name(path).ok_or_else(|| {
        Failure::input("the file is neither a material nor a scene")
            .at(path)
            .because("it has neither `nodes` or `base`, as materials have, nor `mesh` or `objects`, as scenes have")
            .try_to("a *.material.json or *.scene.json file; examples/ has some")
    })
}

/// The bytes of a file that is no larger than documents may be.
fn read(path: &Path) -> Result<Vec<u8>, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() > MAX_BYTES {
        return Err(format!("it is larger than {} MiB, too large for a document", MAX_BYTES >> 20));
    }
    Ok(bytes)
}

fn by_name(path: &Path) -> Option<Kind> {
    let name = path.file_name()?.to_str()?;
    if name.ends_with(".scene.json") {
        Some(Kind::Scene)
    } else if name.ends_with(".material.json") {
        Some(Kind::Material)
    } else {
        None
    }
}

/// Reads a material document. The failure says file, place and reason.
pub(crate) fn material(path: &Path) -> Result<Document, Failure> {
    halfvector_graph::file::load(path).map_err(|error| {
        use halfvector_graph::file::FileError;
        let (why, remedy) = match &error {
            FileError::InFile { path: at, source } if at == path => {
                (source.to_string(), "correct the file there, or save it again")
            }
            FileError::Read { source, .. } => (source.to_string(), "another file name"),
            other => (other.to_string(), "correct the file"),
        };
        Failure::input("the material could not be read").at(path).because(why).try_to(remedy)
    })
}

/// The folder that a document's relative paths start from.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Reads a scene file, or a model as a scene.
pub(crate) fn load_scene(path: &Path) -> Result<Scene, Failure> {
    let scene = if kind(path)? == Kind::Model { Scene::from_model(path) } else { halfvector_scene::load_scene(path) };
    scene.map_err(|error| wrong_scene(path, &error))
}

fn wrong_scene(path: &Path, error: &SceneError) -> Failure {
    Failure::input("the scene could not be made").at(path).because(error).try_to("correct what is named above")
}

/// Reads a scene, or makes one from a material or model; `mesh` replaces what is drawn.
pub(crate) fn scene(path: &Path, mesh: Option<&MeshSource>) -> Result<Scene, Failure> {
    if kind(path)? == Kind::Material {
        let document = material(path)?;
        refuse_errors(path, &document)?;
        let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
        return Scene::from_material(document, folder(path), mesh.unwrap_or(&sphere))
            .map_err(|error| wrong_scene(path, &error));
    }
    let mut scene = load_scene(path)?;
    if let Some(mesh) = mesh {
        scene.set_mesh(mesh).map_err(|error| wrong_scene(path, &error))?;
    }
    scene.materials.iter().try_for_each(|material| refuse_errors(path, &material.document))?;
    Ok(scene)
}

/// Refuses a document with problems that no shader can be made with; all of them stand in the failure.
pub(crate) fn refuse_errors(path: &Path, document: &Document) -> Result<(), Failure> {
    let problems = halfvector_graph::check::check(document, Library::standard());
    let errors: Vec<Problem> = problems.into_iter().filter(|problem| problem.severity == Severity::Error).collect();
    if errors.is_empty() { Ok(()) } else { Err(has_errors(path, document, &errors)) }
}

/// The failure of a document that has errors.
pub(crate) fn has_errors(path: &Path, document: &Document, errors: &[Problem]) -> Failure {
    let failure = Failure::input(format!("the material `{}` has problems", document.name)).at(path);
    errors
        .iter()
        .take(MOST_SHOWN)
        .fold(failure, |failure, problem| failure.because(problem))
        .try_to("`halfvector check` lists them all")
}

/// Most problems in one failure.
const MOST_SHOWN: usize = 20;
