//! The pictures that the material names, looked at off the window's thread: which cannot be read, and which normal maps run
//! the other way. They are decoded again only when the document names others or one of the files has changed, which is looked
//! for once a second. Who draws the material loads its own.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui;
use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::{Document, Graph, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::flatten::find;
use halfvector_graph::node_def::Default as SocketDefault;
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_scene::{FileStamp, ImageError, ImageStore, SceneMaterial, normal_map_problems};

use crate::action::Action;
use crate::files::relative;
use crate::session::Session;
use crate::work::Worker;

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
    stamps: Vec<Option<FileStamp>>,
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

/// The state of the file of a picture; of one within a glTF file, of that file.
fn stamp(directory: &Path, value: &Value) -> Option<FileStamp> {
    let Value::Image(image) = value else { return None };
    FileStamp::of(&directory.join(&image.file)).or_else(|| {
        let (file, _) = image.file.rsplit_once('#')?;
        FileStamp::of(&directory.join(file))
    })
}

/// How often it is looked whether files of pictures have changed.
const EVERY: Duration = Duration::from_secs(1);

/// Sees when others change the pictures that the material names.
pub(crate) struct Watch {
    worker: Option<Worker<(Arc<Document>, PathBuf), u64>>,
    looked: Option<Instant>,
    number: u64,
}

impl Watch {
    /// Starts the thread that looks.
    pub(crate) fn new(context: &egui::Context) -> Watch {
        let mut known = BTreeMap::new();
        let mut number = 0;
        let worker = Worker::start("picture files", context, move |job: (Arc<Document>, PathBuf), _| {
            number += u64::from(has_changed(&mut known, &job.0, &job.1));
            Some(number)
        });
        Watch { worker: worker.ok(), looked: None, number: 0 }
    }

    /// Names the state of the files: another number when one of them has changed. Looks again when it is time.
    pub(crate) fn hear(&mut self, context: &egui::Context, session: &Session) -> u64 {
        while let Some(number) = self.worker.as_ref().and_then(Worker::poll) {
            self.number = number;
        }
        if !session.names_pictures() {
            return self.number;
        }
        let waits = self.looked.map_or(Duration::ZERO, |looked| EVERY.saturating_sub(looked.elapsed()));
        if waits.is_zero() {
            self.looked = Some(Instant::now());
            if let Some(worker) = self.worker.as_ref().filter(|worker| !worker.is_busy()) {
                worker.submit((session.document().clone(), session.directory()));
            }
        }
        context.request_repaint_after(if waits.is_zero() { EVERY } else { waits });
        self.number
    }
}

/// Whether one of the files that were seen before is another one now, or gone, or there.
fn has_changed(known: &mut BTreeMap<PathBuf, Option<FileStamp>>, document: &Document, directory: &Path) -> bool {
    let inside = document.groups.values().map(|group| &group.graph);
    let nodes = std::iter::once(&document.graph).chain(inside).flat_map(|graph| graph.nodes.values());
    let mut changed = false;
    for value in nodes.flat_map(|node| node.values.values()) {
        if let Value::Image(image) = value {
            let now = stamp(directory, value);
            let before = known.insert(directory.join(&image.file), now);
            changed |= before.is_some_and(|before| before != now);
        }
    }
    changed
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
