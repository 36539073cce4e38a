//! The record of an open window: which file it has open and what is not saved in it. Other windows read it to notice each
//! other; the next start reads it when the window is gone and its record is not.
//!
//! Each window has two files in the recovery folder: `NAME.lock`, locked for as long as its process lives (the system
//! unlocks it however the process ends), and `NAME.json`, replaced in one step. Nothing is put into the user's folders.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use halfvector_graph::file::{from_json, load, replace};
use serde::{Deserialize, Serialize};

use crate::files::difference::differences;

/// What a window says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Record {
    /// Id of its process, for people.
    pub(crate) process: u32,
    /// The material's name.
    pub(crate) name: String,
    /// The file that is open, absolute.
    pub(crate) file: Option<PathBuf>,
    /// Fingerprint of the text that the window knows of the file: with another one others have changed it since.
    #[serde(default)]
    pub(crate) known: Option<u64>,
    /// When this was written: seconds since 1970.
    pub(crate) written: u64,
    /// The document as text, when the file does not hold it.
    pub(crate) unsaved: Option<String>,
    /// Whether its window is gone, and another one holds it to offer it: nobody has its file open on its account.
    #[serde(default)]
    pub(crate) is_left: bool,
}

impl Record {
    /// A record of this process, written now.
    pub(crate) fn now(name: &str, file: Option<PathBuf>, known: Option<u64>, unsaved: Option<String>) -> Record {
        let written = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs();
        Record { process: std::process::id(), name: name.to_owned(), file, known, written, unsaved, is_left: false }
    }

    /// How long ago it was written, for people.
    pub(crate) fn age(&self) -> String {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let seconds = now.saturating_sub(Duration::from_secs(self.written)).as_secs();
        let count = |number: u64, unit: &str| format!("{number} {unit}{}", if number == 1 { "" } else { "s" });
        // Two that were left together are told apart by seconds.
        match seconds {
            0..60 => format!("{} ago", count(seconds, "second")),
            60..3600 => format!("{} {} ago", count(seconds / 60, "minute"), count(seconds % 60, "second")),
            3600..86_400 => format!("{} {} ago", count(seconds / 3600, "hour"), count(seconds / 60 % 60, "minute")),
            _ => format!("{} {} ago", count(seconds / 86_400, "day"), count(seconds / 3600 % 24, "hour")),
        }
    }

    /// What it holds that its file does not; all that it holds when it has none.
    fn changes(&self) -> Vec<String> {
        let unsaved = self.unsaved.as_deref().and_then(|text| from_json(text).ok());
        let Some(unsaved) = unsaved else { return Vec::new() };
        match self.file.as_deref().and_then(|file| load(file).ok()) {
            Some(saved) => differences(&saved, &unsaved),
            None => vec![format!("{} nodes", unsaved.graph.nodes.len())],
        }
    }
}

/// This window's place in the recovery folder.
#[derive(Debug)]
pub(crate) struct Desk {
    folder: PathBuf,
    name: String,
    /// Held locked.
    lock: File,
}

/// What a window that is gone has left.
#[derive(Debug)]
pub(crate) struct Lost {
    /// Its last record, with unsaved work.
    pub(crate) record: Record,
    /// What was changed in it, a line each.
    pub(crate) changes: Vec<String>,
    folder: PathBuf,
    name: String,
    /// Held locked, so that no other window offers the same.
    lock: File,
}

/// Tells windows of one process apart.
static WINDOWS: AtomicU64 = AtomicU64::new(0);

impl Desk {
    /// Takes a place in the folder, which is made if need be.
    pub(crate) fn open(folder: &Path) -> io::Result<Desk> {
        fs::create_dir_all(folder)?;
        let moment = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_nanos();
        let name = format!("{}-{}-{moment:x}", std::process::id(), WINDOWS.fetch_add(1, Ordering::Relaxed));
        let lock = OpenOptions::new().write(true).create_new(true).open(lock_path(folder, &name))?;
        lock.try_lock()?;
        Ok(Desk { folder: folder.to_owned(), name, lock })
    }

    /// Replaces this window's record.
    pub(crate) fn write(&self, record: &Record) -> io::Result<()> {
        write(&self.folder, &self.name, record)
    }

    /// The processes of other windows that have this file open.
    pub(crate) fn also_open(&self, file: &Path) -> Vec<u32> {
        let mut processes = Vec::new();
        for name in names(&self.folder).into_iter().filter(|name| *name != self.name) {
            let is_of = |record: &Record| record.file.as_deref() == Some(file) && !record.is_left;
            let Some(record) = read(&self.folder, &name).filter(is_of) else { continue };
            // Locked by its window: it is open.
            if claim(&self.folder, &name).is_none() {
                processes.push(record.process);
            }
        }
        processes.sort_unstable();
        processes
    }

    /// What windows that are gone have left, the newest first. Records without unsaved work are removed.
    pub(crate) fn lost(&self) -> Vec<Lost> {
        let mut found = Vec::new();
        for name in names(&self.folder).into_iter().filter(|name| *name != self.name) {
            let Some(lock) = claim(&self.folder, &name) else { continue };
            match read(&self.folder, &name).filter(|record| record.unsaved.is_some()) {
                Some(record) => {
                    // From now on its lock is held, though its window is gone. When that cannot be written, it is only taken for open.
                    let _ = write(&self.folder, &name, &Record { is_left: true, ..record.clone() });
                    let changes = record.changes();
                    found.push(Lost { record, changes, folder: self.folder.clone(), name, lock });
                }
                None => remove(&self.folder, &name, lock),
            }
        }
        found.sort_by(|a, b| b.record.written.cmp(&a.record.written).then_with(|| a.name.cmp(&b.name)));
        found
    }

    /// Leaves the folder without a trace.
    pub(crate) fn close(self) {
        remove(&self.folder, &self.name, self.lock);
    }
}

impl Lost {
    /// Removes it for good.
    pub(crate) fn forget(self) {
        remove(&self.folder, &self.name, self.lock);
    }
}

fn lock_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.lock"))
}

fn record_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.json"))
}

/// The names of all windows that have left a lock file, sorted.
fn names(folder: &Path) -> Vec<String> {
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        files.filter_map(|file| Some(file.file_name().to_str()?.strip_suffix(".lock")?.to_owned())).collect();
    names.sort();
    names
}

/// The lock of a window that is gone; `None` while it is open.
fn claim(folder: &Path, name: &str) -> Option<File> {
    let lock = OpenOptions::new().write(true).open(lock_path(folder, name)).ok()?;
    lock.try_lock().is_ok().then_some(lock)
}

fn read(folder: &Path, name: &str) -> Option<Record> {
    serde_json::from_slice(&fs::read(record_path(folder, name)).ok()?).ok()
}

fn write(folder: &Path, name: &str, record: &Record) -> io::Result<()> {
    replace(&record_path(folder, name), &serde_json::to_vec(record)?)
}

/// Removes the record first: a lock without record says nothing to anyone.
fn remove(folder: &Path, name: &str, lock: File) {
    // What cannot be removed is found again at the next start, and harms nobody.
    let _ = fs::remove_file(record_path(folder, name));
    drop(lock);
    let _ = fs::remove_file(lock_path(folder, name));
}
