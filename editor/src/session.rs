//! The document that is worked on, its history, its file and what is selected. The only place where it changes.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use halfvector_graph::check::{Problem, check};
use halfvector_graph::document::{Document, Graph, Link, Node, NodeId, SocketRef, group_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::{Instance, Loaded};
use halfvector_graph::library::Library;
use halfvector_graph::library::custom::read_function;
use halfvector_graph::value::Value;

use crate::files::relative::moved as moved_value;
use crate::history::History;

/// One open material.
#[derive(Debug)]
pub struct Session {
    /// Tells sessions apart.
    number: u64,
    /// The groups that were entered, the outermost first.
    path: Vec<String>,
    document: Arc<Document>,
    history: History,
    /// Another number after every change of the document, and in every session.
    revision: u64,
    /// The document as it stands in its file.
    saved: Option<Arc<Document>>,
    file: Option<PathBuf>,
    /// What the file is written as when it is an instance.
    base: Option<Base>,
    selection: BTreeSet<NodeId>,
    /// Of the revision that it holds.
    problems: Vec<Problem>,
    /// What is wrong with the pictures that the document names, as far as they were looked at.
    notices: Arc<Vec<Problem>>,
    /// Another number after a file of a picture has changed.
    pictures: u64,
    /// How costly nodes are; empty while the graph is not coloured by it.
    heat: BTreeMap<NodeId, f32>,
    /// Of the graph that is worked on.
    library: Library,
    /// The last text of each function that was sound: while it is wrong its nodes keep their sockets.
    sound: BTreeMap<String, String>,
    /// The document with those texts, while any function is wrong.
    as_it_was: Option<Arc<Document>>,
}

/// What the file of an instance says, and the document that it stands for.
#[derive(Debug)]
struct Base {
    instance: Instance,
    document: Arc<Document>,
    /// Whether the document of the session can still be written as an instance.
    is_enough: bool,
}

/// A document as it goes into a file.
#[derive(Clone, Debug)]
pub(crate) struct Written {
    pub(crate) document: Arc<Document>,
    /// The instance that stands for it, where the file is one.
    pub(crate) instance: Option<Instance>,
}

/// The material that a new document holds, as the text of its file.
pub const START_MATERIAL: &str = include_str!("start.material.json");

impl Session {
    /// A session with the start material and no file.
    pub fn new() -> Session {
        let document =
            halfvector_graph::file::from_json(START_MATERIAL).unwrap_or_else(|_| Document::with_surface("Material"));
        Session::of(document, None)
    }

    /// A session with a document that no file holds, but that belongs into one.
    pub(crate) fn recovered(document: Document, file: Option<PathBuf>) -> Session {
        Session { saved: None, ..Session::of(document, file) }
    }

    /// A session with a document as it was read from a file.
    pub(crate) fn read(read: Loaded, file: PathBuf) -> Session {
        let mut session = Session::of(read.document, Some(file));
        session.set_base(read.instance, session.document.clone());
        session
    }

    /// The file of recovered work holds this: when that is an instance, the work is one.
    pub(crate) fn was(&mut self, read: Loaded) {
        self.set_base(read.instance, Arc::new(read.document));
    }

    fn set_base(&mut self, instance: Option<Instance>, document: Arc<Document>) {
        self.base = instance.map(|instance| {
            let is_enough = instance.changed(&document, &self.document).is_some();
            Base { instance, document, is_enough }
        });
    }

    /// A session with a document that has no file.
    pub(crate) fn with(document: Arc<Document>) -> Session {
        Session::of_shared(document, None)
    }

    /// A session with a document as it stands in its file, if it has one.
    pub(crate) fn of(document: Document, file: Option<PathBuf>) -> Session {
        Session::of_shared(Arc::new(document), file)
    }

    fn of_shared(document: Arc<Document>, file: Option<PathBuf>) -> Session {
        static NUMBERS: AtomicU64 = AtomicU64::new(0);
        let mut session = Session {
            number: NUMBERS.fetch_add(1, Ordering::Relaxed),
            path: Vec::new(),
            history: History::default(),
            revision: next_revision(),
            saved: Some(document.clone()),
            file,
            base: None,
            selection: BTreeSet::new(),
            heat: BTreeMap::new(),
            notices: Arc::default(),
            pictures: 0,
            problems: check(&document, Library::standard()),
            library: Library::standard().clone(),
            sound: BTreeMap::new(),
            as_it_was: None,
            document,
        };
        session.keep_what_is_there();
        session
    }

    /// The document as it is now.
    pub fn document(&self) -> &Arc<Document> {
        &self.document
    }

    /// The document with each function that is wrong as it was when it was right last: what is still to be seen of it.
    pub(crate) fn sound_document(&self) -> &Arc<Document> {
        self.as_it_was.as_ref().unwrap_or(&self.document)
    }

    /// Names this state of the document: what is derived from it is stale when this differs.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Tells this session from all others: with another number another document was opened.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The groups that were entered, the outermost first; empty at the top level.
    pub fn path(&self) -> &[String] {
        &self.path
    }

    /// The group whose inside is worked on; none at the top level.
    pub fn group(&self) -> Option<&str> {
        self.path.last().map(String::as_str)
    }

    /// The graph that is worked on: the document's own, or the inside of the group that was entered.
    pub fn graph(&self) -> &Graph {
        self.document.graph_of(self.group()).unwrap_or(&self.document.graph)
    }

    /// The nodes that this graph can be made of: the shipped ones, and those that the document brings along.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// An edit of this graph as an edit of the document.
    pub fn here(&self, edit: Edit) -> Edit {
        match self.group() {
            Some(group) => Edit::In { group: group.to_owned(), edit: Box::new(edit) },
            None => edit,
        }
    }

    /// A node.
    pub fn node(&self, id: &str) -> Option<&Node> {
        self.graph().nodes.get(id)
    }

    /// All links.
    pub fn links(&self) -> &[Link] {
        &self.graph().links
    }

    /// What feeds an input.
    pub fn incoming(&self, input: &SocketRef) -> Option<&SocketRef> {
        self.graph().incoming(input)
    }

    /// The value that is set on an input.
    pub fn value(&self, input: &SocketRef) -> Option<&Value> {
        self.graph().value(input)
    }

    /// Whether some node names a picture.
    pub(crate) fn names_pictures(&self) -> bool {
        names_pictures(&self.document)
    }

    /// The file of the document, if it has one.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// The file that this one is an instance of, as it is written there; none of a material of its own.
    pub fn base(&self) -> Option<&str> {
        self.base.as_ref().map(|base| base.instance.base.as_str())
    }

    /// Whether the file can hold the document: an instance holds parameters' values and a name.
    pub fn fits_its_file(&self) -> bool {
        self.base.as_ref().is_none_or(|base| base.is_enough)
    }

    /// The folder that relative paths of the document start from.
    pub fn directory(&self) -> PathBuf {
        self.file.as_deref().and_then(Path::parent).map(Path::to_owned).unwrap_or_default()
    }

    /// Whether there is something that is not in the file.
    pub fn is_unsaved(&self) -> bool {
        self.saved.as_ref().is_none_or(|saved| !Arc::ptr_eq(saved, &self.document) && **saved != *self.document)
    }

    /// The selected nodes.
    pub fn selection(&self) -> &BTreeSet<NodeId> {
        &self.selection
    }

    /// All problems of the document.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// The problems of the document and of its pictures.
    pub(crate) fn all_problems(&self) -> impl Iterator<Item = &Problem> {
        self.problems.iter().chain(self.notices.iter())
    }

    /// What is wrong with its pictures besides; the same `Arc` while it stays the same.
    pub(crate) fn notices(&self) -> &Arc<Vec<Problem>> {
        &self.notices
    }

    /// Says what is wrong with the pictures.
    pub(crate) fn set_notices(&mut self, notices: &Arc<Vec<Problem>>) {
        if !Arc::ptr_eq(&self.notices, notices) {
            self.notices = notices.clone();
        }
    }

    /// Names the state of the files of the pictures: what is drawn with them is stale when this differs.
    pub(crate) fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Says that files of pictures have changed.
    pub(crate) fn set_pictures(&mut self, number: u64) {
        self.pictures = number;
    }

    /// How costly each node is compared with the costliest, 0 to 1; empty while the graph is not to be coloured by it.
    pub fn heat(&self) -> &BTreeMap<NodeId, f32> {
        &self.heat
    }

    /// Says how costly nodes are.
    pub(crate) fn set_heat(&mut self, heat: BTreeMap<NodeId, f32>) {
        self.heat = heat;
    }

    /// The names of the steps that undo and redo would do.
    pub fn steps(&self) -> [Option<&str>; 2] {
        [self.history.undo_name(), self.history.redo_name()]
    }

    /// Of how many edits the last step of undo is made: 0 when there is none.
    pub fn parts_of_undo(&self) -> usize {
        self.history.parts_of_undo()
    }

    /// Changes the document. An edit that cannot be made changes nothing and says why.
    pub(crate) fn edit(&mut self, name: String, edit: &Edit, merge: Option<String>) -> Result<(), String> {
        let document = Arc::make_mut(&mut self.document);
        self.history.make(document, name, edit, merge).map_err(|error| error.to_string())?;
        self.changed();
        Ok(())
    }

    /// Ends a row of merged edits.
    pub(crate) fn end_merge(&mut self) {
        self.history.end_merge();
    }

    /// Takes the last step back as if it had never been.
    pub(crate) fn take_back(&mut self) -> Result<(), String> {
        let done = self.history.take_back(Arc::make_mut(&mut self.document)).map_err(|error| error.to_string());
        self.changed();
        done
    }

    /// Takes the last step back and returns its name.
    pub(crate) fn undo(&mut self) -> Result<Option<String>, String> {
        let done = self.history.undo(Arc::make_mut(&mut self.document)).map_err(|error| error.to_string());
        self.changed();
        done
    }

    /// Does the last step that was taken back again and returns its name.
    pub(crate) fn redo(&mut self) -> Result<Option<String>, String> {
        let done = self.history.redo(Arc::make_mut(&mut self.document)).map_err(|error| error.to_string());
        self.changed();
        done
    }

    /// Replaces the selection; ids of no node are passed over.
    pub(crate) fn select(&mut self, nodes: impl IntoIterator<Item = NodeId>) {
        let nodes: BTreeSet<NodeId> = nodes.into_iter().filter(|id| self.graph().nodes.contains_key(id)).collect();
        self.selection = nodes;
    }

    /// Goes into groups, the outermost first, or out of them.
    pub(crate) fn enter(&mut self, path: Vec<String>) {
        self.path = path;
        self.selection.clear();
        self.keep_what_is_there();
    }

    /// Leaves groups that are gone, and forgets selected nodes that are.
    fn keep_what_is_there(&mut self) {
        let there = self.path.iter().take_while(|group| self.document.groups.contains_key(*group)).count();
        if there < self.path.len() {
            self.path.truncate(there);
            self.selection.clear();
        }
        let mut selection = std::mem::take(&mut self.selection);
        selection.retain(|id| self.graph().nodes.contains_key(id));
        self.selection = selection;
        let library = self.library_of_document();
        self.library = match self.group().and_then(|group| self.document.groups.get(group)) {
            Some(group) => library.inside(group),
            None => library,
        };
    }

    /// The shipped nodes and the document's own. A function that is wrong at the moment stays the node that it was.
    fn library_of_document(&mut self) -> Library {
        let mut wrong = false;
        for (id, text) in &self.document.functions {
            if read_function(id, text).is_ok() {
                if self.sound.get(id) != Some(text) {
                    self.sound.insert(id.clone(), text.clone());
                }
            } else {
                wrong = true;
            }
        }
        if !wrong {
            self.as_it_was = None;
            return Library::standard().of(&self.document);
        }
        let as_it_was = Arc::make_mut(self.as_it_was.insert(self.document.clone()));
        for (id, text) in &mut as_it_was.functions {
            if let Some(sound) = self.sound.get(id) {
                text.clone_from(sound);
            }
        }
        Library::standard().of(as_it_was)
    }

    /// The groups to enter for the inside of a group, the outermost first: the shortest way from the top level, or the group
    /// alone when nothing uses it.
    pub(crate) fn way_to(&self, group: &str) -> Vec<String> {
        let mut ways: Vec<Vec<String>> = vec![Vec::new()];
        let mut seen = BTreeSet::new();
        let mut next = 0;
        while let Some(way) = ways.get(next).cloned() {
            next += 1;
            let Some(graph) = self.document.graph_of(way.last().map(String::as_str)) else { continue };
            for inner in graph.nodes.values().filter_map(|node| group_of(&node.node)) {
                let mut further = way.clone();
                further.push(inner.to_owned());
                if inner == group {
                    return further;
                }
                if seen.insert(inner.to_owned()) {
                    ways.push(further);
                }
            }
        }
        vec![group.to_owned()]
    }

    /// A document was written to a file, which is this session's from now on. Image paths start at its folder.
    pub(crate) fn saved(&mut self, path: PathBuf, Written { document, instance }: Written) {
        let (from, to) = (self.directory(), path.parent().map(Path::to_owned).unwrap_or_default());
        self.file = Some(path);
        if let Some(moved) = with_images_moved(&self.document, &from, &to) {
            self.document = Arc::new(moved);
            self.history.for_each_value(&mut |value| {
                if let Some(moved) = moved_value(value, &from, &to) {
                    *value = moved;
                }
            });
            self.changed();
        }
        self.set_base(instance, document.clone());
        self.saved = Some(document);
    }

    /// The document as it is to stand in a file: image paths mean the same files from there, and an instance stays one. `None`
    /// when it is an instance that cannot hold what was changed.
    pub(crate) fn written(&self, path: &Path) -> Option<Written> {
        if let (Some(base), true) = (&self.base, self.file() == Some(path)) {
            let instance = base.instance.changed(&base.document, &self.document)?;
            return Some(Written { document: self.document.clone(), instance: Some(instance) });
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let moved = with_images_moved(&self.document, &self.directory(), folder);
        Some(Written { document: moved.map_or_else(|| self.document.clone(), Arc::new), instance: None })
    }

    /// The file holds something else than what was read or written last.
    pub(crate) fn lost_its_file(&mut self) {
        self.saved = None;
    }

    fn changed(&mut self) {
        self.revision = next_revision();
        self.problems = check(&self.document, Library::standard());
        if let Some(base) = &mut self.base {
            base.is_enough = base.instance.changed(&base.document, &self.document).is_some();
        }
        self.keep_what_is_there();
    }
}

/// The document with its image paths as they are written in another folder; `None` when all stay.
pub(crate) fn with_images_moved(document: &Document, from: &Path, to: &Path) -> Option<Document> {
    let values = graphs(document).flat_map(|graph| graph.nodes.values()).flat_map(|node| node.values.values());
    if values.filter_map(|value| moved_value(value, from, to)).count() == 0 {
        return None;
    }
    let mut moved = document.clone();
    let inside = moved.groups.values_mut().map(|group| &mut group.graph);
    for node in std::iter::once(&mut moved.graph).chain(inside).flat_map(|graph| graph.nodes.values_mut()) {
        for value in node.values.values_mut() {
            if let Some(moved) = moved_value(value, from, to) {
                *value = moved;
            }
        }
    }
    Some(moved)
}

/// Whether some node of a document names a picture.
pub(crate) fn names_pictures(document: &Document) -> bool {
    let mut values = graphs(document).flat_map(|graph| graph.nodes.values()).flat_map(|node| node.values.values());
    values.any(|value| matches!(value, Value::Image(_)))
}

/// All graphs of a document: its own and those of its groups.
fn graphs(document: &Document) -> impl Iterator<Item = &Graph> {
    std::iter::once(&document.graph).chain(document.groups.values().map(|group| &group.graph))
}

fn next_revision() -> u64 {
    static REVISIONS: AtomicU64 = AtomicU64::new(0);
    REVISIONS.fetch_add(1, Ordering::Relaxed)
}

impl Default for Session {
    fn default() -> Self {
        Session::new()
    }
}
