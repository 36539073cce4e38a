//! The window: its parts side by side, and who carries out what a person does there.
//!
//! `keys` and `menu` give the commands, `layout` places the parts, `files`, `chooser` and `questions` see to it that nothing is
//! lost, `status` tells what was done.

mod chooser;
mod files;
mod groups;
mod keys;
mod layout;
mod menu;
mod questions;
mod sheet;
mod status;

use eframe::egui;
use egui_tiles::{SimplificationOptions, TileId, Tiles, Tree, UiResponse};

use halfvector_graph::document::NodeId;

use crate::action::Action;
use crate::app::files::{Files, Next};
use crate::app::status::Messages;
use crate::paint::Gpu;
use crate::panes::{
    accuracy::Accuracy, canvas::Canvas, code::Code, cost::Cost, functions::Functions, inspector::Inspector,
    library::LibraryPane, problems::Problems, viewport::Viewport,
};
use crate::pictures::Watch;
use crate::session::Session;
use crate::stage::Stage;
use crate::thumbnails::Thumbnails;
use crate::{Options, theme, written};

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
    /// The material's own WGSL.
    Functions,
    /// What is wrong.
    Problems,
    /// Materials to begin with.
    Library,
    /// How exact the shader is.
    Accuracy,
    /// What each node costs.
    Cost,
}

impl Pane {
    /// All, in the order of the menu.
    pub const ALL: [Pane; 9] = [
        Pane::Canvas,
        Pane::Viewport,
        Pane::Inspector,
        Pane::Code,
        Pane::Functions,
        Pane::Problems,
        Pane::Library,
        Pane::Cost,
        Pane::Accuracy,
    ];

    /// The title of its tab.
    pub fn title(self) -> &'static str {
        match self {
            Pane::Canvas => "Graph",
            Pane::Viewport => "Viewport",
            Pane::Inspector => "Inspector",
            Pane::Code => "Code",
            Pane::Functions => "Functions",
            Pane::Problems => "Problems",
            Pane::Library => "Library",
            Pane::Accuracy => "Accuracy",
            Pane::Cost => "Cost",
        }
    }
}

/// The editor: one window with one material.
pub struct Editor {
    context: egui::Context,
    session: Session,
    panes: Panes,
    tree: Tree<Pane>,
    files: Files,
    messages: Messages,
    /// Whether the menu is to get the focus of the keys.
    wants_menu: bool,
}

/// The state of the parts.
struct Panes {
    canvas: Canvas,
    viewport: Viewport,
    inspector: Inspector,
    code: Code,
    functions: Functions,
    problems: Problems,
    library: LibraryPane,
    accuracy: Accuracy,
    thumbnails: Thumbnails,
    cost: Cost,
    watch: Watch,
    /// The part that is to get the focus of the keys.
    focus: Option<Pane>,
}

impl Editor {
    /// An editor that draws itself anew through this context whenever something is ready.
    pub fn new(context: &egui::Context, options: Options) -> Editor {
        theme::install(context);
        let gpu = Gpu::new(!options.without_gpu);
        let (files, session, troubles) = Files::start(context, options);
        context.set_theme(files.settings.theme);
        context.set_zoom_factor(files.settings.scale);
        let mut messages = Messages::default();
        troubles.into_iter().for_each(|trouble| messages.fail(trouble));
        let panes = Panes {
            canvas: Canvas::default(),
            viewport: Viewport::new(context, &gpu),
            inspector: Inspector::new(context),
            code: Code::new(context),
            functions: Functions::default(),
            problems: Problems::new(context),
            cost: Cost::new(context),
            library: LibraryPane::default(),
            accuracy: Accuracy::new(context, &gpu),
            thumbnails: Thumbnails::new(context, &gpu),
            watch: Watch::new(context),
            focus: None,
        };
        let tree = layout::restored(files.settings.layout.clone());
        Editor { context: context.clone(), session, panes, tree, files, messages, wants_menu: false }
    }

    /// The open material.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// What the material is seen on.
    pub fn stage(&self) -> &Stage {
        self.panes.viewport.stage()
    }

    /// Who drew the picture that is shown: the GPU's name, `CPU` or `reference`; none before the first one.
    pub fn drawn_by(&self) -> Option<&str> {
        self.panes.viewport.drawn_by()
    }

    /// What cannot be seen well in the graph as it was drawn last, in words: wires behind cards, cards on cards.
    pub fn tangles(&self) -> Vec<String> {
        self.panes.canvas.tangles()
    }

    /// Whether all that is shown is up to date: no picture and no shader is being made, and no file read or written.
    pub fn is_idle(&self) -> bool {
        self.files.is_idle()
            && self.panes.viewport.is_idle()
            && self.panes.code.is_idle()
            && self.panes.problems.is_idle()
            && self.panes.cost.is_idle()
            && self.panes.inspector.is_idle()
            && self.panes.thumbnails.is_idle()
            && self.panes.accuracy.is_idle()
    }

    /// Carries out what a person does.
    pub fn act(&mut self, action: Action) {
        match self.try_act(action) {
            Ok(message) => self.messages.tell(message),
            Err(why) => self.messages.fail(why),
        }
    }

    fn try_act(&mut self, action: Action) -> Result<String, String> {
        let said = |verb: &str, step: Option<String>| step.map_or_else(String::new, |step| format!("{verb}: {step}"));
        match action {
            Action::Edit { name, edit, merge } => self.session.edit(name, &edit, merge)?,
            Action::EndMerge => self.session.end_merge(),
            Action::TakeBack => self.session.take_back()?,
            Action::Undo => return Ok(said("Undone", self.session.undo()?)),
            Action::Redo => return Ok(said("Done again", self.session.redo()?)),
            Action::Select(nodes) => self.session.select(nodes),
            Action::Enter(path) => self.session.enter(path),
            Action::Show(node) => self.bring_into_view(node),
            Action::Find { group, node } => {
                let way = group.map(|group| self.session.way_to(&group)).unwrap_or_default();
                if self.session.path() != way {
                    self.session.enter(way);
                }
                self.bring_into_view(node);
            }
            Action::EditFunction(id) => {
                self.panes.functions.choose(id);
                layout::show(&mut self.tree, Pane::Functions);
            }
            Action::New => self.ask(Next::New),
            Action::NewFrom(document) => self.ask(Next::NewFrom(document)),
            Action::Open(path) => self.ask(Next::Open(path)),
            Action::Save => self.save(false),
            Action::SaveAs(path) => self.save_as(path, false),
            Action::SaveGroup(id, path) => self.save_group(&id, &path)?,
            Action::Choose(purpose) => self.choose(purpose),
            Action::Say(text) => return Ok(text),
        }
        Ok(String::new())
    }

    fn bring_into_view(&mut self, node: NodeId) {
        self.session.select([node.clone()]);
        self.panes.canvas.show_node(node);
        layout::show(&mut self.tree, Pane::Canvas);
    }

    /// Draws the window into a `Ui` that fills it.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        self.panes.canvas.begin_frame(ui.ctx());
        self.hear();
        self.session.set_pictures(self.panes.watch.hear(&self.context, &self.session));
        self.panes.problems.hear(&self.session);
        self.session.set_notices(self.panes.problems.notices());
        let heat = self.panes.cost.hear(&self.session, self.panes.viewport.stage());
        self.session.set_heat(heat);
        self.guard_close();
        self.take_dropped();
        let mut actions = Vec::new();
        if self.files.question.is_none() && self.files.chooser.is_none() {
            let pressed = keys::pressed(ui.ctx());
            pressed.into_iter().for_each(|command| self.command(command, &mut actions));
        }
        egui::Panel::top("menu").show(ui, |ui| self.menu(ui, &mut actions));
        egui::Panel::bottom("status").show(ui, |ui| self.messages.show(ui, &self.session));
        self.show_strips(ui);
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let mut behavior = Behavior { session: &self.session, panes: &mut self.panes, actions: &mut actions };
            self.tree.ui(&mut behavior, ui);
        });
        if layout::is_on(&self.tree, Pane::Viewport) {
            self.panes.viewport.take_left(ui.ctx());
        }
        self.tell_dropped();
        self.panes.thumbnails.end_frame(ui.ctx());
        actions.into_iter().for_each(|action| self.act(action));
        if ui.input(|input| input.pointer.any_released()) {
            // Whatever was dragged is done.
            self.session.end_merge();
        }
        self.show_chooser();
        self.show_question();
        written::show(&self.context);
        self.keep_soon();
        self.remember_soon(false);
        self.set_title();
    }
}

impl eframe::App for Editor {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        self.remember_soon(true);
    }
}

/// Gives the focus to a part: the graph itself, of another one the first control.
fn take_focus(ui: &egui::Ui, pane: Pane, wanted: &mut Option<Pane>) {
    let before_first = egui::Id::new("before the first control");
    if pane == Pane::Canvas && *wanted == Some(pane) {
        *wanted = None;
        ui.memory_mut(|memory| memory.request_focus(egui::Id::new("graph canvas")));
    } else if *wanted == Some(pane) {
        // From a place before all controls the focus goes on as by Tab.
        let has_focus = ui.memory(|memory| memory.has_focus(before_first));
        ui.memory_mut(|memory| match has_focus {
            true => memory.move_focus(egui::FocusDirection::Next),
            false => memory.request_focus(before_first),
        });
        let place = egui::Rect::from_min_size(ui.max_rect().min, egui::Vec2::ZERO);
        ui.interact(place, before_first, egui::Sense::focusable_noninteractive());
        ui.ctx().request_repaint();
        if has_focus {
            *wanted = None;
        }
    }
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
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        take_focus(ui, *pane, &mut panes.focus);
        match pane {
            Pane::Canvas => panes.canvas.show(ui, session, &mut panes.thumbnails, actions),
            Pane::Viewport => panes.viewport.show(ui, session, &mut panes.thumbnails, actions),
            Pane::Inspector => panes.inspector.show(ui, session, actions),
            Pane::Code => panes.code.show(ui, session, panes.viewport.stage(), actions),
            Pane::Functions => panes.functions.show(ui, session, actions),
            Pane::Problems => panes.problems.show(ui, session, actions),
            Pane::Library => panes.library.show(ui, &mut panes.thumbnails, actions),
            Pane::Accuracy => panes.accuracy.show(ui, session, &mut panes.viewport),
            Pane::Cost => panes.cost.show(ui, session, actions),
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        let count = match pane {
            Pane::Problems => self.panes.problems.count(self.session),
            Pane::Functions => Functions::wrong(self.session),
            _ => 0,
        };
        if count > 0 { format!("{} ({count})", pane.title()).into() } else { pane.title().into() }
    }

    fn is_tab_closable(&self, _tiles: &Tiles<Pane>, _tile: TileId) -> bool {
        true
    }

    /// A closed part is put off, not removed: the menu puts it on again where it was.
    fn on_tab_close(&mut self, tiles: &mut Tiles<Pane>, tile: TileId) -> bool {
        tiles.set_visible(tile, false);
        false
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }
}
