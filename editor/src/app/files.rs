//! Files as the window sees them: what is asked before something is lost, what the thread of `files::clerk` tells, and the
//! record that is kept for a crash.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui;
use halfvector_graph::document::Document;
use halfvector_graph::file::Loaded;

use crate::Options;
use crate::action::Choose;
use crate::app::Editor;
use crate::app::chooser::Chooser;
use crate::app::questions::Question;
use crate::dropped::{self, Kind};
use crate::files::clerk::{Clerk, Order, Report, SaveFault, read};
use crate::files::record::Lost;
use crate::files::settings::Settings;
use crate::session::{Session, Written};

/// How long after a change it is kept for a crash.
const KEEP_AFTER: Duration = Duration::from_millis(1000);
/// How often it is looked whether settings have changed.
const REMEMBER_AFTER: Duration = Duration::from_secs(3);

/// What is done once nothing can be lost any more.
#[derive(Debug)]
pub(crate) enum Next {
    /// A new document.
    New,
    /// A new document that begins as this.
    NewFrom(Arc<Document>),
    /// The document of a file.
    Open(PathBuf),
    /// What a window that is gone has left.
    Recover(Box<Lost>),
    /// The window is closed.
    Close,
}

/// The window's files.
pub(crate) struct Files {
    clerk: Option<Clerk>,
    pub(crate) settings: Settings,
    /// The settings that were given to the thread last, and when.
    remembered: (Settings, Instant),
    pub(crate) chooser: Option<Chooser>,
    pub(crate) question: Option<Question>,
    /// What waits for a save.
    after_save: Option<Next>,
    /// The state that the record on disk is of: revision, file and whether it is unsaved.
    kept: Option<(u64, Option<PathBuf>, bool)>,
    /// When the document was first seen to differ from the record.
    differs_since: Option<Instant>,
    /// What others have made of the open file.
    pub(crate) outside: Option<Outside>,
    /// Processes that have the file open too.
    pub(crate) also_open: Vec<u32>,
    /// Unsaved work of windows that are gone.
    pub(crate) lost: Vec<Lost>,
    /// Whether the open work was left by another window, and its file may have been saved since.
    pub(crate) is_recovered: bool,
    /// Whether the window may close.
    closes: bool,
    title: String,
}

/// A change of the open file by others.
#[derive(Debug)]
pub(crate) struct Outside {
    /// What stands there now, or why that cannot be read.
    pub(crate) read: Result<Loaded, String>,
    /// Whether the differences are shown.
    pub(crate) is_shown: bool,
}

impl Files {
    /// Starts the thread and reads what the editor opens with: the session, and what went wrong. A file that is there and cannot be
    /// read is asked about, and the session has no file: nothing writes over it unasked.
    pub(crate) fn start(context: &egui::Context, options: Options) -> (Files, Session, Vec<String>) {
        let mut troubles = Vec::new();
        let (settings, trouble) = options.folders.settings.as_deref().map_or_else(Default::default, Settings::load);
        troubles.extend(trouble);
        let mut session = Session::new();
        let (mut open, mut question) = (None, None);
        if let Some(path) = options.document {
            match read(&path) {
                Ok(read) => {
                    let path = absolute(&path);
                    open = Some((path.clone(), read.bytes.clone()));
                    session = Session::read(read, path);
                }
                Err(why) if path.exists() => question = Some(Question::Broken(absolute(&path), why)),
                Err(why) => troubles.push(why),
            }
        }
        let opened = open.as_ref().map(|(path, _)| path.clone());
        let clerk = Clerk::start(context, options.folders, open);
        if let Err(error) = &clerk {
            troubles.push(format!("files cannot be opened or saved: {error}"));
        }
        let mut files = Files {
            clerk: clerk.ok(),
            remembered: (settings.clone(), Instant::now()),
            settings,
            chooser: None,
            question,
            after_save: None,
            kept: None,
            differs_since: None,
            outside: None,
            also_open: Vec::new(),
            lost: Vec::new(),
            is_recovered: false,
            closes: false,
            title: String::new(),
        };
        if let Some(path) = opened {
            files.settings.remember(&path);
        }
        (files, session, troubles)
    }

    /// Whether no file is being read or written.
    pub(crate) fn is_idle(&self) -> bool {
        self.clerk.as_ref().is_none_or(|clerk| !clerk.is_busy())
    }

    pub(crate) fn order(&self, order: Order) {
        if let Some(clerk) = &self.clerk {
            clerk.order(order);
        }
    }
}

impl Editor {
    /// Does it now, or after asking when something would be lost.
    pub(crate) fn ask(&mut self, next: Next) {
        if self.session.is_unsaved() {
            self.files.question = Some(Question::Unsaved(next));
        } else {
            self.go(next);
        }
    }

    /// Does it, whatever is lost.
    pub(crate) fn go(&mut self, next: Next) {
        match next {
            Next::New => {
                self.replace_session(Session::new());
                self.files.order(Order::Release);
            }
            Next::NewFrom(document) => {
                self.replace_session(Session::with(document));
                self.files.order(Order::Release);
            }
            Next::Open(path) => self.files.order(Order::Open(path)),
            Next::Recover(lost) => self.recover(*lost),
            Next::Close => {
                self.files.closes = true;
                self.context.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        }
    }

    /// Saves, then does it.
    pub(crate) fn save_then(&mut self, next: Next) {
        self.files.after_save = Some(next);
        self.save(false);
    }

    /// Writes the document to its file, or asks for one.
    pub(crate) fn save(&mut self, over_changes: bool) {
        match self.session.file() {
            Some(path) => self.save_as(path.to_owned(), over_changes),
            None => self.choose(Choose::SaveAs),
        }
    }

    /// Writes the document to a file, which becomes its own when that is done.
    pub(crate) fn save_as(&mut self, path: PathBuf, over_changes: bool) {
        let path = absolute(&path);
        match self.session.written(&path) {
            Some(what) => self.files.order(Order::Save { path, what, over_changes }),
            None => {
                self.files.after_save = None;
                self.messages.fail(
                    "an instance holds values of its base's parameters and a name, and more was changed: save it as a material \
                     of its own, under another name, or undo the rest"
                        .to_owned(),
                );
            }
        }
    }

    fn replace_session(&mut self, session: Session) {
        self.session = session;
        self.messages.forget();
        self.files.outside = None;
        self.files.is_recovered = false;
        self.files.also_open.clear();
    }

    fn recover(&mut self, lost: Lost) {
        let text = lost.record.unsaved.as_deref().unwrap_or_default();
        match halfvector_graph::file::from_json(text) {
            Ok(document) => {
                let file = lost.record.file.clone();
                self.files.order(match file.clone() {
                    Some(path) => Order::Watch { path, known: lost.record.known },
                    None => Order::Release,
                });
                let mut session = Session::recovered(document, file);
                if let Some(Ok(read)) = session.file().map(read) {
                    session.was(read);
                }
                self.replace_session(session);
                self.files.is_recovered = true;
                // First the record of this window, then the old one goes: at no time is there none.
                self.keep();
                self.files.order(Order::Forget(lost));
                self.messages.tell("Recovered; save it to keep it".to_owned());
            }
            Err(error) => self.messages.fail(format!("what was left cannot be read: {error}")),
        }
    }

    /// Takes what the thread tells.
    pub(crate) fn hear(&mut self) {
        while let Some(report) = self.files.clerk.as_ref().and_then(Clerk::poll) {
            match report {
                Report::Opened(path, Ok(read)) => {
                    let path = absolute(&path);
                    self.files.settings.remember(&path);
                    self.replace_session(Session::read(read, path.clone()));
                    self.messages.tell(format!("Opened {}", path.display()));
                }
                Report::Opened(path, Err(why)) => {
                    self.files.settings.recent.retain(|recent| *recent != path || path.exists());
                    // Somebody tries again what could not be read before.
                    if self.session.file().is_none() && path.exists() {
                        self.files.question.get_or_insert(Question::Broken(path, why.clone()));
                    }
                    self.messages.fail(why);
                }
                Report::Saved(path, what, Ok(())) => self.was_saved(path, what),
                Report::Saved(path, _, Err(SaveFault::Changed)) => {
                    self.files.question = Some(Question::Overwrite(path));
                }
                Report::Saved(_, _, Err(SaveFault::Failed(why))) => {
                    self.files.after_save = None;
                    self.messages.fail(why);
                }
                Report::Changed(path, read) => {
                    if self.session.file() == Some(path.as_path()) {
                        self.files.outside = Some(Outside { read, is_shown: false });
                    }
                }
                Report::Gone(path) => {
                    if self.session.file() == Some(path.as_path()) {
                        self.session.lost_its_file();
                        let path = path.display();
                        self.messages.fail(format!(
                            "{path} is gone: another program deleted or renamed it; saving writes it anew"
                        ));
                    }
                }
                Report::AlsoOpen(processes) => self.files.also_open = processes,
                Report::Lost(lost) => {
                    self.files.lost.extend(lost);
                    self.files.question.get_or_insert(Question::Lost);
                }
                Report::Group(path, read) => self.add_group(&path, read),
                Report::Done(text) => self.messages.tell(text),
                Report::Failed(why) => self.messages.fail(why),
            }
        }
    }

    fn was_saved(&mut self, path: PathBuf, what: Written) {
        self.messages.tell(format!("Saved {}", path.display()));
        self.files.settings.remember(&path);
        self.files.outside = None;
        self.session.saved(path, what);
        self.files.is_recovered = false;
        if let Some(next) = self.files.after_save.take() {
            // More may have been changed while it was written.
            self.ask(next);
        }
    }

    /// Takes what others have made of the file.
    pub(crate) fn reload(&mut self) {
        if let Some(Outside { read: Ok(read), .. }) = self.files.outside.take()
            && let Some(file) = self.session.file().map(Path::to_owned)
        {
            self.files.order(Order::Accept);
            self.replace_session(Session::read(read, file));
            self.messages.tell("Reloaded".to_owned());
        }
    }

    /// Stays with what is here; saving then writes over what others have made.
    pub(crate) fn keep_mine(&mut self) {
        self.files.outside = None;
        self.files.order(Order::Accept);
        self.session.lost_its_file();
    }

    /// A question was answered with no: what waited for it is forgotten.
    pub(crate) fn cancel(&mut self) {
        self.files.question = None;
        self.files.after_save = None;
    }

    /// Brings the record of this window up to date, soon after a change.
    pub(crate) fn keep_soon(&mut self) {
        let unsaved = self.session.is_unsaved();
        let same = |kept: &(u64, Option<PathBuf>, bool)| {
            (!unsaved || kept.0 == self.session.revision())
                && kept.1.as_deref() == self.session.file()
                && kept.2 == unsaved
        };
        if self.files.kept.as_ref().is_some_and(same) {
            self.files.differs_since = None;
            return;
        }
        // What is saved needs no waiting: other windows are to notice it.
        let since = *self.files.differs_since.get_or_insert_with(Instant::now);
        let left = if unsaved { KEEP_AFTER.saturating_sub(since.elapsed()) } else { Duration::ZERO };
        if left.is_zero() {
            self.keep();
        } else {
            self.context.request_repaint_after(left);
        }
    }

    fn keep(&mut self) {
        let (document, file) = (self.session.document(), self.session.file().map(Path::to_owned));
        let unsaved = self.session.is_unsaved();
        self.files.order(Order::Keep {
            name: document.name.clone(),
            file: file.clone(),
            unsaved: unsaved.then(|| document.clone()),
        });
        self.files.kept = Some((self.session.revision(), file, unsaved));
        self.files.differs_since = None;
    }

    /// Has the settings written when they have changed. `at_once` without waiting for more changes.
    pub(crate) fn remember_soon(&mut self, at_once: bool) {
        if !at_once && self.files.remembered.1.elapsed() < REMEMBER_AFTER {
            return;
        }
        self.files.settings.layout = Some(self.tree.clone());
        self.files.settings.scale = self.context.zoom_factor();
        self.files.remembered.1 = Instant::now();
        if self.files.remembered.0 != self.files.settings {
            let settings = self.files.settings.clone();
            let before = std::mem::replace(&mut self.files.remembered.0, settings.clone());
            self.files.order(Order::Remember(Box::new([before, settings])));
        }
    }

    /// Holds the window when it is closed with unsaved work.
    pub(crate) fn guard_close(&mut self) {
        let wants_to_close = self.context.input(|input| input.viewport().close_requested());
        if wants_to_close && !self.files.closes && self.session.is_unsaved() {
            self.context.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.files.question = Some(Question::Unsaved(Next::Close));
        }
    }

    /// Opens a material that was dropped on the window, and adds a node of each group. Models, environments and pictures belong to the panes.
    pub(crate) fn take_dropped(&mut self) {
        if let Some(path) = dropped::take(&self.context, |kind| kind == Kind::Material).into_iter().next() {
            self.ask(Next::Open(path));
        }
        for path in dropped::take(&self.context, |kind| kind == Kind::Group) {
            self.files.order(Order::ReadGroup(path));
        }
    }

    /// Tells of what was dropped and of no use to any part.
    pub(crate) fn tell_dropped(&mut self) {
        if let Some(why) = dropped::left(&self.context) {
            self.messages.fail(why);
        }
    }

    /// Keeps the window's title up to date.
    pub(crate) fn set_title(&mut self) {
        let mark = if self.session.is_unsaved() { "● " } else { "" };
        let name = self.session.file().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        let title = match name {
            Some(name) => format!("{mark}{name} - Halfvector"),
            None => format!("{mark}{} - Halfvector", self.session.document().name),
        };
        if title != self.files.title {
            self.files.title.clone_from(&title);
            self.context.send_viewport_cmd(egui::ViewportCommand::Title(title));
        }
    }
}

pub(super) fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
