//! The document that is worked on, its history, its file and what is selected. The only place where it changes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use halfvector_graph::check::{Problem, check};
use halfvector_graph::document::{Document, NodeId};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;

use crate::history::History;

/// One open material.
#[derive(Debug)]
pub struct Session {
    document: Arc<Document>,
    history: History,
    /// Counts every change of the document.
    revision: u64,
    /// The document as it stands in its file.
    saved: Option<Arc<Document>>,
    file: Option<PathBuf>,
    selection: BTreeSet<NodeId>,
    /// Of the revision that it holds.
    problems: Vec<Problem>,
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

    /// A session with the document of a file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn open(path: &Path) -> Result<Session, halfvector_graph::file::FileError> {
        Ok(Session::of(halfvector_graph::file::load(path)?, Some(path.to_owned())))
    }

    /// A session with a document that has no file.
    pub(crate) fn with(document: Arc<Document>) -> Session {
        Session::of_shared(document, None)
    }

    fn of(document: Document, file: Option<PathBuf>) -> Session {
        Session::of_shared(Arc::new(document), file)
    }

    fn of_shared(document: Arc<Document>, file: Option<PathBuf>) -> Session {
        Session {
            history: History::default(),
            revision: 0,
            saved: Some(document.clone()),
            file,
            selection: BTreeSet::new(),
            problems: check(&document, Library::standard()),
            document,
        }
    }

    /// The document as it is now.
    pub fn document(&self) -> &Arc<Document> {
        &self.document
    }

    /// Counts changes: what is derived from the document is stale when it differs.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The file of the document, if it has one.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
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

    /// The names of the steps that undo and redo would do.
    pub fn steps(&self) -> [Option<&str>; 2] {
        [self.history.undo_name(), self.history.redo_name()]
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
        self.selection = nodes.into_iter().filter(|id| self.document.graph.nodes.contains_key(id)).collect();
    }

    /// Writes the document to a file, which becomes its own.
    pub(crate) fn save(&mut self, path: PathBuf) -> Result<(), halfvector_graph::file::FileError> {
        halfvector_graph::file::save(&path, &self.document)?;
        self.file = Some(path);
        self.saved = Some(self.document.clone());
        Ok(())
    }

    fn changed(&mut self) {
        self.revision += 1;
        self.problems = check(&self.document, Library::standard());
        self.selection.retain(|id| self.document.graph.nodes.contains_key(id));
    }
}

impl Default for Session {
    fn default() -> Self {
        Session::new()
    }
}
