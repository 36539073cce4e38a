//! `*.material.json` and `*.group.json`: reading and writing documents as text, and files replaced in one step.
//!
//! The writer's order is fixed and each node and link has a line, so that a change in the editor is a small diff. What this
//! version does not know (fields, and whole nodes, links or values of a newer version) stays in the document's `unknown` maps and is
//! written again. Whether a document makes sense is told by `check`, not here.

mod instance;
mod read;
mod write;

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crate::document::{Document, Group};

pub use instance::{Instance, InstanceError, MAX_INSTANCE_DEPTH};
pub use read::{from_json, group_from_json};
pub use write::{group_to_json, instance_to_json, to_json};

/// Largest text that is read, in bytes.
pub const MAX_BYTES: usize = 32 << 20;

/// Why a document was not read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The text is larger than [`MAX_BYTES`].
    #[error("the document is larger than {} MiB; is this a material?", MAX_BYTES >> 20)]
    TooLarge,
    /// The bytes are not UTF-8.
    #[error("line {line}: the bytes are no UTF-8 text; save the file as UTF-8")]
    NotText {
        /// From 1.
        line: usize,
    },
    /// The text is not JSON.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// From 1.
        line: usize,
        /// In characters, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// The text is JSON, but no material.
    #[error("line {line}, column {column}, at {place}: {message}")]
    Shape {
        /// From 1.
        line: usize,
        /// In characters, from 1.
        column: usize,
        /// The field, such as `nodes.rust.values.scale`.
        place: String,
        /// What is wrong and what to write instead.
        message: String,
    },
    /// The file is an instance of another material, and could not be made.
    #[error(transparent)]
    Instance(#[from] InstanceError),
    /// The file could not be read.
    #[error("{} could not be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file could not be written; what was there before is untouched.
    #[error("{} could not be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file's text was refused.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// Where and why.
        source: Box<FileError>,
    },
}

/// A group with the groups that it holds: what a `*.group.json` has.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupFile {
    /// Id of the group that it is about.
    pub group: String,
    /// That group and those that it needs, by id.
    pub groups: BTreeMap<String, Group>,
    /// The functions that they need, by id.
    pub functions: BTreeMap<String, String>,
}

/// A document with what is known of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The document; of an instance the one that it stands for.
    pub document: Document,
    /// What stood in the file: an editor tells by it whether others have changed the file since.
    pub bytes: Vec<u8>,
    /// What the file says when it is an instance: writing the document there would make a material of its own of it.
    pub instance: Option<Instance>,
}

/// Reads a document from a file. A file with the field `base` is an instance: another material, named from this file's folder,
/// with the parameters under `set` changed.
pub fn load(path: &Path) -> Result<Document, FileError> {
    load_whole(path).map(|loaded| loaded.document)
}

/// Reads a document as [`load`] does, with what is known of its file.
pub fn load_whole(path: &Path) -> Result<Loaded, FileError> {
    instance::load(path)
}

/// Reads a group from a file.
pub fn load_group(path: &Path) -> Result<GroupFile, FileError> {
    load_as(path, group_from_json).map(|(group, _)| group)
}

fn load_as<T>(path: &Path, read: impl FnOnce(&str) -> Result<T, FileError>) -> Result<(T, Vec<u8>), FileError> {
    let in_file = |source| FileError::InFile { path: path.into(), source: Box::new(source) };
    let read_error = |source| FileError::Read { path: path.into(), source };
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(read_error)?;
    file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(read_error)?;
    if bytes.len() > MAX_BYTES {
        return Err(in_file(FileError::TooLarge));
    }
    let text = std::str::from_utf8(&bytes).map_err(|e| {
        let line = bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count() + 1;
        in_file(FileError::NotText { line })
    })?;
    let what = read(text).map_err(in_file)?;
    Ok((what, bytes))
}

/// Writes a document to a file; the old file stays whole until the new one stands.
pub fn save(path: &Path, document: &Document) -> Result<(), FileError> {
    replace(path, to_json(document).as_bytes()).map_err(|source| FileError::Write { path: path.into(), source })
}

/// Writes a group to a file, as [`save`] does a document.
pub fn save_group(path: &Path, group: &GroupFile) -> Result<(), FileError> {
    replace(path, group_to_json(group).as_bytes()).map_err(|source| FileError::Write { path: path.into(), source })
}

/// Writes a file whole or not at all: into a temporary file of the same folder, which then takes the name. A link is
/// followed, so that the file it points to is replaced. What is there and is no file, such as a device or a pipe, keeps its
/// name and is written to.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace_all(&[(path, bytes)]).map_err(|(_, error)| error)
}

/// Writes files that belong together, each as [`replace`] does, and none takes its name before all are written: where one
/// has no room, nothing has changed.
///
/// # Errors
/// The place in `files` of the one that failed, and why.
pub fn replace_all(files: &[(&Path, &[u8])]) -> Result<(), (usize, io::Error)> {
    let (mut staged, mut streams) = (Vec::new(), Vec::new());
    for (k, &(path, bytes)) in files.iter().enumerate() {
        if fs::metadata(path).is_ok_and(|old| !old.is_file()) {
            streams.push((k, path, bytes));
        } else {
            staged.push((k, Staged::new(path, bytes).map_err(|error| (k, error))?));
        }
    }
    for (k, path, bytes) in streams {
        let written = fs::OpenOptions::new().write(true).open(path).and_then(|mut stream| stream.write_all(bytes));
        written.map_err(|error| (k, error))?;
    }
    for (k, file) in staged {
        file.take_name().map_err(|error| (k, error))?;
    }
    Ok(())
}

/// A written temporary file, removed if it does not take its name.
struct Staged {
    temporary: PathBuf,
    target: PathBuf,
}

impl Staged {
    fn new(path: &Path, bytes: &[u8]) -> io::Result<Staged> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.into());
        let name =
            target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"))?;
        let (temporary, mut file) = create_beside(&target, name)?;
        let staged = Staged { temporary, target };
        file.write_all(bytes)?;
        file.sync_all()?;
        drop(file);
        if let Ok(old) = fs::metadata(&staged.target) {
            fs::set_permissions(&staged.temporary, old.permissions())?;
        }
        Ok(staged)
    }

    fn take_name(self) -> io::Result<()> {
        fs::rename(&self.temporary, &self.target)
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        // Gone when it has taken its name; otherwise the first error is the one to report.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// A new, empty file beside `target`.
fn create_beside(target: &Path, name: &std::ffi::OsStr) -> io::Result<(PathBuf, fs::File)> {
    let process = std::process::id();
    let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
    for attempt in 0..100 {
        let mut temporary = std::ffi::OsString::from(".");
        temporary.push(name);
        temporary.push(format!(".{process}-{attempt}.tmp"));
        let path = target.with_file_name(temporary);
        match fs::OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((path, file)),
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => last = e,
            Err(e) => return Err(e),
        }
    }
    Err(last)
}
