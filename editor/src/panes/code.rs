//! The exported shader of the material: its text, which lines are which node's, what was left out and why. It is made on a
//! thread of its own; the old text stays until the new one is there.

pub(in crate::panes) mod highlight;
mod lines;
mod made;
mod text;

use eframe::egui::{self, Button, ComboBox};
use halfvector_codegen::target::TARGETS;
use halfvector_graph::check::node_label;
use halfvector_graph::document::NodeId;
use halfvector_graph::flatten::find;
use halfvector_graph::library::Library;
use halfvector_graph::needs::Needs;

use crate::action::{Action, Choose};
pub(crate) use crate::panes::code::made::needs_of;
use crate::panes::code::made::{Job, Made, make, plain_needs};
use crate::session::Session;
use crate::stage::Stage;
use crate::theme;
use crate::work::Worker;

/// What the scene is taken to need of the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum For {
    /// One directional light, no environment, no tone map: as `halfvector export` without a scene.
    Plain,
    /// Lights, environment, methods and tone map of the viewport.
    Viewport,
}

/// The shader's text.
#[derive(Debug)]
pub(crate) struct Code {
    worker: Option<Worker<Job, Made>>,
    target: &'static str,
    serves: For,
    /// Revision, target and needs of the job that was given last.
    asked: Option<(u64, &'static str, Needs)>,
    made: Option<Made>,
    /// Why the newest shader could not be made: the last good one stays.
    failed: Option<String>,
    /// The session that they are of.
    session: u64,
    shows_dropped: bool,
    /// The selected node when its lines were brought into view last.
    shown: Option<NodeId>,
}

impl Code {
    /// Starts the thread that makes shaders.
    pub(crate) fn new(context: &egui::Context) -> Code {
        let worker = Worker::start("code", context, |job: Job, _| Some(make(job)));
        Code {
            worker: worker.ok(),
            target: "wgsl",
            serves: For::Plain,
            asked: None,
            made: None,
            failed: None,
            session: 0,
            shows_dropped: false,
            shown: None,
        }
    }

    /// Whether no shader is being made.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// The files of the target that is shown, with the names that they have when the material is called `name`.
    pub(crate) fn files(&self, name: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
        if let Some(why) = &self.failed {
            return Err(why.clone());
        }
        match &self.made {
            _ if !self.is_idle() => Err("The shader is still being made; try again".to_owned()),
            None => Err("Open the code pane first: it makes the shader".to_owned()),
            Some(Made { result: Err(why), .. }) => Err(why.clone()),
            Some(Made { result: Ok(code), target, .. }) => code.files(target, name),
        }
    }

    /// Draws the text.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, stage: &Stage, actions: &mut Vec<Action>) {
        self.ask(session, stage);
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
            self.bar(ui, actions);
        });
        let selected = self.newly_selected(session);
        if let Some(why) = &self.failed {
            let frame =
                egui::Frame::new().fill(theme::ERROR.gamma_multiply(0.16)).inner_margin(egui::Margin::symmetric(8, 3));
            frame.show(ui, |ui| {
                ui.set_min_width(ui.available_width());
                let text = format!("As it was before: {}", why.lines().next().unwrap_or_default());
                ui.add(egui::Label::new(text).truncate()).on_hover_text(why);
            });
        }
        match &self.made {
            Some(Made { result: Ok(code), .. }) => {
                if self.shows_dropped {
                    dropped(ui, code);
                }
                text::show(ui, session, code, selected.as_ref(), actions);
            }
            Some(Made { result: Err(why), .. }) => {
                egui::Frame::new().inner_margin(8).show(ui, |ui| ui.label(why));
            }
            None => {
                ui.spinner();
            }
        }
    }

    fn ask(&mut self, session: &Session, stage: &Stage) {
        if self.session != session.number() {
            (self.session, self.made, self.failed) = (session.number(), None, None);
        }
        let Some(worker) = &self.worker else { return };
        let needs = match self.serves {
            For::Plain => plain_needs(),
            For::Viewport => needs_of(stage),
        };
        let wanted = (session.revision(), self.target, needs);
        if self.asked.as_ref() != Some(&wanted) {
            let document = session.document().clone();
            worker.submit(Job { document, target: wanted.1, needs: wanted.2.clone() });
            self.asked = Some(wanted);
        }
        while let Some(made) = worker.poll() {
            let is_kept = self.made.as_ref().is_some_and(|old| old.target == made.target && old.result.is_ok());
            match &made.result {
                Err(why) if is_kept => self.failed = Some(why.clone()),
                _ => (self.failed, self.made) = (None, Some(made)),
            }
        }
    }

    /// The node that was selected since the last frame, elsewhere.
    fn newly_selected(&mut self, session: &Session) -> Option<NodeId> {
        let mut selection = session.selection().iter();
        let only = selection.next().filter(|_| selection.next().is_none()).cloned();
        if only == self.shown {
            return None;
        }
        self.shown.clone_from(&only);
        only
    }

    fn bar(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("Target").id;
            let combo = ComboBox::from_id_salt("target").selected_text(self.target).width(80.0);
            combo
                .show_ui(ui, |ui| {
                    for target in TARGETS {
                        ui.selectable_value(&mut self.target, target.name, target.name).on_hover_text(target.help);
                    }
                })
                .response
                .labelled_by(label);
            let label = ui.label("for").id;
            let choices = [
                (For::Plain, "one light", "One directional light, no environment, no tone map"),
                (For::Viewport, "the viewport", "Lights, environment, methods and tone map as the viewport has them"),
            ];
            let text = choices.iter().find(|(choice, ..)| *choice == self.serves).map_or("", |(_, text, _)| text);
            let combo = ComboBox::from_id_salt("needs").selected_text(text).width(100.0);
            combo
                .show_ui(ui, |ui| {
                    for (choice, text, hint) in choices {
                        ui.selectable_value(&mut self.serves, choice, text).on_hover_text(hint);
                    }
                })
                .response
                .labelled_by(label);
            ui.separator();
            let code = self.made.as_ref().and_then(|made| made.result.as_ref().ok());
            let text = code.filter(|code| !code.text.is_empty());
            if ui.add_enabled(text.is_some(), Button::new("Copy")).on_hover_text("Copy the whole text").clicked()
                && let Some(code) = text
            {
                ui.ctx().copy_text(code.text.to_string());
                actions.push(Action::Say("Copied the shader".to_owned()));
            }
            let button = Button::new("Export…");
            if ui
                .add_enabled(code.is_some(), button)
                .on_hover_text("Write all files of this target to a folder")
                .clicked()
            {
                actions.push(Action::Choose(Choose::ExportFolder));
            }
            if let Some(code) = code {
                let count = code.shader.dropped.len();
                crate::panes::toggle(ui, &mut self.shows_dropped, format!("Left out ({count})"))
                    .on_hover_text("What this shader does without, and why");
                let size = format!("{} lines · {:.1} kB", code.lines.len(), code.bytes as f64 / 1e3);
                ui.add(egui::Label::new(egui::RichText::new(size).weak()).truncate());
            }
        });
    }
}

fn dropped(ui: &mut egui::Ui, code: &made::Ready) {
    let frame = egui::Frame::new().fill(ui.visuals().faint_bg_color).inner_margin(8);
    egui::Panel::right("dropped").frame(frame).default_size(260.0).show(ui, |ui| {
        ui.strong("Left out");
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if code.shader.dropped.is_empty() {
                ui.weak("Nothing");
            }
            for one in &code.shader.dropped {
                ui.label(&one.what);
                ui.weak(&one.why);
                ui.add_space(4.0);
            }
        });
    });
}

/// A node that a shader calls by a path through groups, for people.
pub(crate) fn path_label(session: &Session, path: &str) -> String {
    let document = session.document();
    let library = Library::standard().of(document);
    let mut label = String::new();
    for (end, _) in path.match_indices('/').chain([(path.len(), "")]) {
        if let Some((group, node, _)) = find(document, &path[..end])
            && let Some(graph) = document.graph_of(group)
        {
            let between = if label.is_empty() { "" } else { " / " };
            label = format!("{label}{between}{}", node_label(graph, &library, node));
        }
    }
    if label.is_empty() { path.to_owned() } else { label }
}

/// Where a line comes from, for people.
fn origin_text(session: &Session, origin: Option<&halfvector_codegen::Origin>) -> String {
    match origin {
        Some(halfvector_codegen::Origin::Node(id)) => {
            format!("{}: click to show the node", path_label(session, id))
        }
        Some(halfvector_codegen::Origin::Library(file)) => format!("shaders/{file}"),
        Some(halfvector_codegen::Origin::Frame(part)) => part.help().to_owned(),
        None => String::new(),
    }
}
