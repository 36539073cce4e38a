//! The pictures that the material names, looked at off the window's thread: which cannot be read, and which normal maps run
//! the other way. They are decoded again only when the document names others or one of the files has changed. Who draws the
//! material loads its own.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::{Document, Graph, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::flatten::find;
use halfvector_graph::node_def::Default as SocketDefault;
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_scene::{ImageError, ImageStore, SceneMaterial, normal_map_problems};

use crate::action::Action;
use crate::files::relative;
use crate::session::Session;

/// What was loaded last.
#[derive(Default)]
pub(crate) struct Pictures {
    key: Option<Key>,
    images: ImageStore,
    faults: Vec<ImageError>,
}

/// What the loaded pictures depend on.
#[derive(PartialEq)]
struct Key {
    directory: PathBuf,
    /// The document with nothing but what says which pictures are read.
    named: Document,
    /// Time and size of each file.
    stamps: Vec<Option<(SystemTime, u64)>>,
}

impl Pictures {
    /// Loads what the material names, unless it is here.
    pub(crate) fn load(&mut self, material: &SceneMaterial) {
        let key = Key::of(&material.document, &material.directory);
        if self.key.as_ref() == Some(&key) {
            return;
        }
        self.images = ImageStore::default();
        self.faults = self.images.load_all(std::slice::from_ref(material));
        self.key = Some(key);
    }

    /// The pictures that could be read, or why the first one of the others could not.
    pub(crate) fn whole(&self) -> Result<&ImageStore, &ImageError> {
        self.faults.first().map_or(Ok(&self.images), Err)
    }

    /// All that is wrong with the pictures of the material that was loaded last.
    pub(crate) fn problems(&self, material: &SceneMaterial) -> Vec<Problem> {
        let unread = self.faults.iter().map(|error| unread(&material.document, error));
        unread.chain(normal_map_problems(material, &self.images)).collect()
    }
}

impl Key {
    fn of(document: &Document, directory: &Path) -> Key {
        let mut named = document.clone();
        named.parameters.clear();
        named.name.clear();
        let mut stamps = Vec::new();
        let inside = named.groups.values_mut().map(|group| &mut group.graph);
        for graph in std::iter::once(&mut named.graph).chain(inside) {
            let Graph { nodes, layout, frames, comments, .. } = graph;
            layout.clear();
            frames.clear();
            comments.clear();
            for node in nodes.values_mut() {
                node.label = None;
                node.values.retain(|_, value| matches!(value, Value::Image(_)));
                stamps.extend(node.values.values().map(|value| stamp(directory, value)));
            }
        }
        Key { directory: directory.to_owned(), named, stamps }
    }
}

/// Time and size of the file of a picture; of one within a glTF file, of that file.
fn stamp(directory: &Path, value: &Value) -> Option<(SystemTime, u64)> {
    let Value::Image(image) = value else { return None };
    let whole = std::fs::metadata(directory.join(&image.file));
    let metadata = whole.or_else(|error| match image.file.rsplit_once('#') {
        Some((file, _)) => std::fs::metadata(directory.join(file)),
        None => Err(error),
    });
    let metadata = metadata.ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

fn unread(document: &Document, error: &ImageError) -> Problem {
    let place = find(document, &error.path);
    let is_image = |(_, value): &(&String, &Value)| matches!(value, Value::Image(_));
    let socket = place.and_then(|(_, _, node)| node.values.iter().find(is_image)).map(|(socket, _)| socket.clone());
    Problem {
        severity: Severity::Error,
        group: place.and_then(|(group, ..)| group).map(str::to_owned),
        node: place.map(|(_, id, _)| id.to_owned()),
        node_label: Some(error.node.clone()),
        socket,
        message: error.fault.to_string(),
    }
}

/// The value of an input of a definition that reads a file: the path as the document writes it, all else as usual there.
pub(crate) fn value(session: &Session, definition: &str, input: &str, path: &Path) -> Value {
    let file = match session.file().and_then(Path::parent) {
        Some(folder) => relative::written(path, folder),
        None => path.to_string_lossy().into_owned(),
    };
    let input = session.library().get(definition).and_then(|def| def.inputs.iter().find(|one| one.name == input));
    let color_space = match input.map(|input| &input.default) {
        Some(SocketDefault::Image(color_space)) => *color_space,
        _ => ColorSpace::Srgb,
    };
    let (wrap_u, wrap_v, filter) = Default::default();
    Value::Image(ImageRef { file, color_space, wrap_u, wrap_v, filter })
}

/// Gives an input another picture: how it is read stays.
pub(crate) fn chosen(session: &Session, socket: &SocketRef, path: &Path) -> Action {
    let definition = session.node(&socket.node).map_or("", |node| node.node.as_str());
    let value = match (value(session, definition, &socket.socket, path), session.value(socket)) {
        (Value::Image(new), Some(Value::Image(old))) => Value::Image(ImageRef { file: new.file, ..old.clone() }),
        (value, _) => value,
    };
    Action::edit("Choose a picture", Edit::SetValue { socket: socket.clone(), value: Some(value) })
}
