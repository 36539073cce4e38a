//! The thread that reads and writes files, one order after the other: none is dropped, and the window waits for none.
//!
//! Between orders it looks once a second whether the open file was changed by others and who else has it open.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use eframe::egui;
use halfvector_graph::document::Document;
use halfvector_graph::file::{
    FileError, GroupFile, Loaded, instance_to_json, load_group, replace, save_group, to_json,
};

use crate::files::record::{Desk, Lost, Record};
use crate::files::settings::Settings;
use crate::files::{Folders, leftovers};
use crate::session::Written;

/// How often the open file is looked at.
const POLL: Duration = Duration::from_secs(1);

/// What the window wants done.
#[derive(Debug)]
pub(crate) enum Order {
    /// Read a material, which then is the open one.
    Open(PathBuf),
    /// Write a material, which then is the open one.
    Save {
        /// Where to.
        path: PathBuf,
        /// What.
        what: Written,
        /// Also when others have changed the file since it was read.
        over_changes: bool,
    },
    /// No file is open any more.
    Release,
    /// A file is open whose text the window does not have: that of recovered work.
    Watch {
        /// The file.
        path: PathBuf,
        /// Of the text that the work began with; none takes what stands there now for it.
        known: Option<u64>,
    },
    /// The change of the open file that was told is known to the user.
    Accept,
    /// Replace this window's record; the document is what its file does not hold.
    Keep {
        /// The material's name.
        name: String,
        /// Its file.
        file: Option<PathBuf>,
        /// What is not saved.
        unsaved: Option<Arc<Document>>,
    },
    /// Remove what a window has left.
    Forget(Lost),
    /// Write the settings: as they were when this window last wrote or read them, and as they are.
    Remember(Box<[Settings; 2]>),
    /// Read a group.
    ReadGroup(PathBuf),
    /// Write a group.
    SaveGroup {
        /// Where to.
        path: PathBuf,
        /// What.
        group: Box<GroupFile>,
    },
    /// Write files into a folder.
    Export {
        /// The folder.
        folder: PathBuf,
        /// Names and contents.
        files: Vec<(String, Vec<u8>)>,
    },
}

/// What the window is told.
#[derive(Debug)]
pub(crate) enum Report {
    /// A material was read, or not.
    Opened(PathBuf, Result<Loaded, String>),
    /// A material was written, or not.
    Saved(PathBuf, Written, Result<(), SaveFault>),
    /// Others have changed the open file: what stands there now, or why that cannot be read.
    Changed(PathBuf, Result<Loaded, String>),
    /// The open file is not there any more.
    Gone(PathBuf),
    /// Processes of other windows that have the open file open too.
    AlsoOpen(Vec<u32>),
    /// Unsaved work of windows that are gone.
    Lost(Vec<Lost>),
    /// A group was read, or not.
    Group(PathBuf, Result<GroupFile, String>),
    /// Something was done, for the status line.
    Done(String),
    /// Something failed, for the status line.
    Failed(String),
}

/// Why a material was not written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SaveFault {
    /// Others have changed the file since it was read.
    Changed,
    /// The system refused.
    Failed(String),
}

/// The thread. Dropping it waits until all orders are done, and removes this window's record.
#[derive(Debug)]
pub(crate) struct Clerk {
    orders: Option<Sender<Order>>,
    reports: Receiver<Report>,
    /// Orders that are not done.
    open: Arc<AtomicUsize>,
    thread: Option<JoinHandle<()>>,
}

impl Clerk {
    /// Starts the thread. `open` is the file that was read already, with the text that stood there.
    pub(crate) fn start(
        context: &egui::Context,
        folders: Folders,
        open: Option<(PathBuf, Vec<u8>)>,
    ) -> std::io::Result<Clerk> {
        let (orders, theirs) = channel();
        let (sender, reports) = channel();
        let pending = Arc::new(AtomicUsize::new(1));
        let (count, context) = (pending.clone(), context.clone());
        let thread = std::thread::Builder::new().name("files".to_owned()).spawn(move || {
            let mut room = Room { folders, context, sender, desk: None, watched: None, also_open: Vec::new() };
            room.watched = open.map(|(path, bytes)| Watched::new(path, &bytes));
            room.enter();
            count.fetch_sub(1, Ordering::Release);
            room.work(&theirs, &count);
        })?;
        Ok(Clerk { orders: Some(orders), reports, open: pending, thread: Some(thread) })
    }

    /// Gives an order.
    pub(crate) fn order(&self, order: Order) {
        if let Some(orders) = &self.orders {
            self.open.fetch_add(1, Ordering::Relaxed);
            if orders.send(order).is_err() {
                self.open.fetch_sub(1, Ordering::Relaxed);
            }
        }
    }

    /// The next thing that is told.
    pub(crate) fn poll(&self) -> Option<Report> {
        self.reports.try_recv().ok()
    }

    /// Whether an order is not done.
    pub(crate) fn is_busy(&self) -> bool {
        self.open.load(Ordering::Acquire) > 0
    }
}

impl Drop for Clerk {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            // A thread that has died has nothing left to do.
            let _ = thread.join();
        }
    }
}

/// A material with what is known of its file.
pub(crate) fn read(path: &Path) -> Result<Loaded, String> {
    halfvector_graph::file::load_whole(path).map_err(|error| error.to_string())
}

/// The open file as it was seen.
#[derive(Debug)]
struct Watched {
    path: PathBuf,
    /// By which other windows know it.
    real: PathBuf,
    /// Of the text that the window has.
    known: u64,
    /// Of the text that was seen last.
    seen: u64,
    /// Time and size of the file when it was seen last.
    stamp: Option<(SystemTime, u64)>,
    /// How often in a row it was not there: a program that writes it anew may delete it for a moment.
    misses: u32,
}

impl Watched {
    fn new(path: PathBuf, bytes: &[u8]) -> Watched {
        let hash = hash(bytes);
        Watched { stamp: stamp(&path), real: real(&path), path, known: hash, seen: hash, misses: 0 }
    }

    /// A file that is looked at as soon as there is time: it may have been changed since.
    fn since(path: PathBuf, known: Option<u64>) -> Watched {
        let known = known.or_else(|| std::fs::read(&path).ok().map(|bytes| hash(&bytes))).unwrap_or_default();
        Watched { stamp: None, real: real(&path), path, known, seen: known, misses: 0 }
    }
}

/// The one name that a file has.
fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// What the thread has.
struct Room {
    folders: Folders,
    context: egui::Context,
    sender: Sender<Report>,
    desk: Option<Desk>,
    watched: Option<Watched>,
    also_open: Vec<u32>,
}

impl Room {
    fn enter(&mut self) {
        let Some(folder) = &self.folders.recovery else { return };
        match Desk::open(folder) {
            Ok(desk) => {
                let lost = desk.lost();
                self.desk = Some(desk);
                if !lost.is_empty() {
                    self.tell(Report::Lost(lost));
                }
            }
            Err(error) => {
                let folder = folder.display();
                self.tell(Report::Failed(format!("unsaved work is not kept for a crash: {folder}: {error}")));
            }
        }
    }

    fn work(&mut self, orders: &Receiver<Order>, open: &AtomicUsize) {
        loop {
            match orders.recv_timeout(POLL) {
                Ok(order) => {
                    self.carry_out(order);
                    open.fetch_sub(1, Ordering::Release);
                    self.context.request_repaint();
                }
                Err(RecvTimeoutError::Timeout) => self.look(),
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        if let Some(desk) = self.desk.take() {
            desk.close();
        }
    }

    fn tell(&self, report: Report) {
        // Without a window there is nobody to tell.
        let _ = self.sender.send(report);
        self.context.request_repaint();
    }

    fn carry_out(&mut self, order: Order) {
        match order {
            Order::Open(path) => {
                let report = match read(&path) {
                    Ok(read) => {
                        self.watched = Some(Watched::new(path.clone(), &read.bytes));
                        Report::Opened(path, Ok(read))
                    }
                    Err(why) => Report::Opened(path, Err(why)),
                };
                self.tell(report);
            }
            Order::Save { path, what, over_changes } => {
                let saved = self.save(&path, &what, over_changes);
                self.tell(Report::Saved(path, what, saved));
            }
            Order::Release => self.watched = None,
            Order::Watch { path, known } => self.watched = Some(Watched::since(path, known)),
            Order::Accept => {
                if let Some(watched) = &mut self.watched {
                    watched.known = watched.seen;
                }
            }
            Order::Keep { name, file, unsaved } => self.keep(&name, file, unsaved.as_deref()),
            Order::Forget(lost) => lost.forget(),
            Order::Remember(settings) => {
                let Some(folder) = &self.folders.settings else { return };
                let [before, now] = *settings;
                if let Err(error) = now.save_since(&before, folder) {
                    self.tell(Report::Failed(format!("settings could not be kept in {}: {error}", folder.display())));
                }
            }
            Order::ReadGroup(path) => {
                let read = load_group(&path).map_err(|error| error.to_string());
                self.tell(Report::Group(path, read));
            }
            Order::SaveGroup { path, group } => self.tell(match save_group(&path, &group) {
                Ok(()) => Report::Done(format!("Saved the group {}", path.display())),
                Err(error) => Report::Failed(error.to_string()),
            }),
            Order::Export { folder, files } => self.tell(export(&folder, &files)),
        }
    }

    fn save(&mut self, path: &Path, what: &Written, over_changes: bool) -> Result<(), SaveFault> {
        if let Some(watched) = self.watched.as_ref().filter(|watched| watched.path == path && !over_changes)
            && let Ok(bytes) = std::fs::read(path)
            && hash(&bytes) != watched.known
        {
            return Err(SaveFault::Changed);
        }
        let text = what.instance.as_ref().map_or_else(|| to_json(&what.document), instance_to_json);
        let failed = |source| SaveFault::Failed(FileError::Write { path: path.into(), source }.to_string());
        replace(path, text.as_bytes()).map_err(failed)?;
        self.watched = Some(Watched::new(path.to_owned(), text.as_bytes()));
        leftovers::clear(path);
        Ok(())
    }

    fn keep(&self, name: &str, file: Option<PathBuf>, unsaved: Option<&Document>) {
        let Some(desk) = &self.desk else { return };
        let file = file.as_deref().map(real);
        let known = self.watched.as_ref().filter(|watched| file.as_ref() == Some(&watched.real));
        let known = known.map(|watched| watched.known);
        let record = Record::now(name, file, known, unsaved.map(halfvector_graph::file::to_json));
        if let Err(error) = desk.write(&record) {
            self.tell(Report::Failed(format!("unsaved work could not be kept for a crash: {error}")));
        }
    }

    /// Looks at the open file and at the other windows.
    fn look(&mut self) {
        let Some(watched) = &mut self.watched else { return };
        let stamp = stamp(&watched.path);
        watched.misses = if stamp.is_none() && watched.stamp.is_some() { watched.misses + 1 } else { 0 };
        if watched.misses > 1 {
            (watched.stamp, watched.misses) = (None, 0);
            let path = watched.path.clone();
            self.tell(Report::Gone(path));
        } else if stamp.is_some() && stamp != watched.stamp {
            watched.stamp = stamp;
            if let Ok(bytes) = std::fs::read(&watched.path) {
                let now = hash(&bytes);
                if now != watched.seen {
                    watched.seen = now;
                    let changed = now != watched.known;
                    let path = watched.path.clone();
                    if changed {
                        self.tell(Report::Changed(path.clone(), read(&path)));
                    }
                }
            }
        }
        if let (Some(desk), Some(watched)) = (&self.desk, &self.watched) {
            let also_open = desk.also_open(&watched.real);
            if also_open != self.also_open {
                self.also_open.clone_from(&also_open);
                self.tell(Report::AlsoOpen(also_open));
            }
        }
    }
}

fn export(folder: &Path, files: &[(String, Vec<u8>)]) -> Report {
    for (name, bytes) in files {
        let path = folder.join(name);
        if let Err(error) = halfvector_graph::file::replace(&path, bytes) {
            return Report::Failed(format!("{} could not be written: {error}", path.display()));
        }
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    Report::Done(format!("Exported {} to {}", names.join(", "), folder.display()))
}
