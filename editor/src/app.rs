//! The window: its parts side by side, the menu, the keys, and who carries out what a person does.

use std::path::PathBuf;

use eframe::egui::{self, Key, KeyboardShortcut, Modifiers};
use egui_tiles::{Container, Linear, LinearDir, SimplificationOptions, TileId, Tiles, Tree, UiResponse};

use crate::action::Action;
use crate::paint::Gpu;
use crate::panes::{
    accuracy::Accuracy, canvas::Canvas, code::Code, inspector::Inspector, library::LibraryPane, problems::Problems,
    viewport::Viewport,
};
use crate::session::Session;
use crate::stage::Stage;
use crate::thumbnails::Thumbnails;
use crate::{Options, theme};

/// A part of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Pane {
    /// The graph.
    Canvas,
    /// The picture.
    Viewport,
    /// What is selected.
    Inspector,
    /// The shader.
    Code,
    /// What is wrong.
    Problems,
    /// Materials to begin with.
    Library,
    /// How exact the shader is.
    Accuracy,
}

impl Pane {
    /// The title of its tab.
    pub fn title(self) -> &'static str {
        match self {
            Pane::Canvas => "Graph",
            Pane::Viewport => "Viewport",
            Pane::Inspector => "Inspector",
            Pane::Code => "Code",
            Pane::Problems => "Problems",
            Pane::Library => "Library",
            Pane::Accuracy => "Accuracy",
        }
    }
}

/// The editor: one window with one material.
pub struct Editor {
    session: Session,
    panes: Panes,
    tree: Tree<Pane>,
    /// What the last action had to say, in the status line.
    message: String,
}

/// The state of the parts.
struct Panes {
    canvas: Canvas,
    viewport: Viewport,
    inspector: Inspector,
    code: Code,
    problems: Problems,
    library: LibraryPane,
    accuracy: Accuracy,
    thumbnails: Thumbnails,
}

const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
const REDO_TOO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);
const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);
const NEW: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::N);

impl Editor {
    /// An editor that draws itself anew through this context whenever something is ready.
    pub fn new(context: &egui::Context, options: Options) -> Editor {
        theme::install(context);
        let (session, message) = match options.document {
            None => (Session::new(), String::new()),
            Some(path) => match Session::open(&path) {
                Ok(session) => (session, String::new()),
                Err(error) => (Session::new(), error.to_string()),
            },
        };
        let gpu = Gpu::new(!options.without_gpu);
        let panes = Panes {
            canvas: Canvas::default(),
            viewport: Viewport::new(context, &gpu),
            inspector: Inspector,
            code: Code::new(context),
            problems: Problems,
            library: LibraryPane::default(),
            accuracy: Accuracy::new(context, &gpu),
            thumbnails: Thumbnails::new(context, &gpu),
        };
        Editor { session, panes, tree: start_layout(), message }
    }

    /// The open material.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// What the material is seen on.
    pub fn stage(&self) -> &Stage {
        self.panes.viewport.stage()
    }

    /// Whether all that is shown is up to date: no picture and no shader is being made.
    pub fn is_idle(&self) -> bool {
        self.panes.viewport.is_idle()
            && self.panes.code.is_idle()
            && self.panes.thumbnails.is_idle()
            && self.panes.accuracy.is_idle()
    }

    /// Carries out what a person does.
    pub fn act(&mut self, action: Action) {
        self.message = match self.try_act(action) {
            Ok(message) => message,
            Err(why) => why,
        };
    }

    fn try_act(&mut self, action: Action) -> Result<String, String> {
        let said = |verb: &str, step: Option<String>| step.map_or_else(String::new, |step| format!("{verb}: {step}"));
        match action {
            Action::Edit { name, edit, merge } => self.session.edit(name, &edit, merge).map(|()| String::new()),
            Action::EndMerge => {
                self.session.end_merge();
                Ok(String::new())
            }
            Action::Undo => Ok(said("Undone", self.session.undo()?)),
            Action::Redo => Ok(said("Done again", self.session.redo()?)),
            Action::Select(nodes) => {
                self.session.select(nodes);
                Ok(String::new())
            }
            Action::Show(node) => {
                self.session.select([node.clone()]);
                self.panes.canvas.show_node(node);
                Ok(String::new())
            }
            Action::New => {
                self.session = Session::new();
                Ok(String::new())
            }
            Action::NewFrom(document) => {
                self.session = Session::with(document);
                Ok(String::new())
            }
            Action::Open(path) => {
                self.session = Session::open(&path).map_err(|error| error.to_string())?;
                Ok(format!("Opened {}", path.display()))
            }
            Action::Save => match self.session.file() {
                Some(path) => self.save(path.to_owned()),
                None => Err("This material has no file yet".to_owned()),
            },
            Action::SaveAs(path) => self.save(path),
        }
    }

    fn save(&mut self, path: PathBuf) -> Result<String, String> {
        self.session.save(path.clone()).map_err(|error| error.to_string())?;
        Ok(format!("Saved {}", path.display()))
    }

    /// Draws the window into a `Ui` that fills it.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let mut actions = Vec::new();
        shortcuts(ui.ctx(), &mut actions);
        egui::Panel::top("menu").show(ui, |ui| self.menu(ui, &mut actions));
        egui::Panel::bottom("status").show(ui, |ui| self.status(ui));
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let mut behavior = Behavior { session: &self.session, panes: &mut self.panes, actions: &mut actions };
            self.tree.ui(&mut behavior, ui);
        });
        self.panes.thumbnails.end_frame(ui.ctx());
        actions.into_iter().for_each(|action| self.act(action));
    }

    fn menu(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                if ui.button("New").clicked() {
                    actions.push(Action::New);
                }
                if ui.button("Save").clicked() {
                    actions.push(Action::Save);
                }
            });
            ui.menu_button("Edit", |ui| {
                let [undo, redo] = self.session.steps();
                for (verb, step, action) in [("Undo", undo, Action::Undo), ("Redo", redo, Action::Redo)] {
                    let text = step.map_or_else(|| verb.to_owned(), |step| format!("{verb} {step}"));
                    if ui.add_enabled(step.is_some(), egui::Button::new(text)).clicked() {
                        actions.push(action);
                    }
                }
            });
        });
    }

    fn status(&self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            let mark = if self.session.is_unsaved() { "● " } else { "" };
            let name = &self.session.document().name;
            ui.label(format!("{mark}{name}"));
            ui.separator();
            ui.label(&self.message);
        });
    }
}

impl eframe::App for Editor {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}

/// The keys that mean the same wherever the focus is, but where text is written.
fn shortcuts(context: &egui::Context, actions: &mut Vec<Action>) {
    let writes = context.egui_wants_keyboard_input();
    context.input_mut(|input| {
        if input.consume_shortcut(&SAVE) {
            actions.push(Action::Save);
        }
        if input.consume_shortcut(&NEW) {
            actions.push(Action::New);
        }
        if !writes {
            // The longer one first: the shorter one would take it.
            if input.consume_shortcut(&REDO) || input.consume_shortcut(&REDO_TOO) {
                actions.push(Action::Redo);
            }
            if input.consume_shortcut(&UNDO) {
                actions.push(Action::Undo);
            }
        }
    });
}

/// The graph large, the picture and the inspector beside it, the rest below.
fn start_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let canvas = tiles.insert_pane(Pane::Canvas);
    let viewport = tiles.insert_pane(Pane::Viewport);
    let inspector = tiles.insert_pane(Pane::Inspector);
    let code = tiles.insert_pane(Pane::Code);
    let problems = tiles.insert_pane(Pane::Problems);
    let library = tiles.insert_pane(Pane::Library);
    let accuracy = tiles.insert_pane(Pane::Accuracy);
    let below = tiles.insert_tab_tile(vec![code, problems, library, accuracy]);
    let left = split(&mut tiles, LinearDir::Vertical, [canvas, below], 0.68);
    let right = split(&mut tiles, LinearDir::Vertical, [viewport, inspector], 0.55);
    let root = split(&mut tiles, LinearDir::Horizontal, [left, right], 0.62);
    Tree::new("panes", root, tiles)
}

fn split(tiles: &mut Tiles<Pane>, direction: LinearDir, children: [TileId; 2], first: f32) -> TileId {
    let linear = Linear::new_binary(direction, children, first);
    tiles.insert_container(Container::Linear(linear))
}

/// Draws the parts for the tiles.
struct Behavior<'a> {
    session: &'a Session,
    panes: &'a mut Panes,
    actions: &'a mut Vec<Action>,
}

impl egui_tiles::Behavior<Pane> for Behavior<'_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _tile: TileId, pane: &mut Pane) -> UiResponse {
        let Behavior { session, panes, actions } = self;
        match pane {
            Pane::Canvas => panes.canvas.show(ui, session, actions),
            Pane::Viewport => panes.viewport.show(ui, session, &mut panes.thumbnails, actions),
            Pane::Inspector => panes.inspector.show(ui, session, actions),
            Pane::Code => panes.code.show(ui, session, actions),
            Pane::Problems => panes.problems.show(ui, session, actions),
            Pane::Library => panes.library.show(ui, &mut panes.thumbnails, actions),
            Pane::Accuracy => panes.accuracy.show(ui, session, &mut panes.viewport),
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.title().into()
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }
}
