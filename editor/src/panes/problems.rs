//! All problems of the material: what its document says, pictures that cannot be read, normal maps that run the other way, and
//! on demand where f32 computes something else than exact arithmetic. A click shows the node.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{self, Button, TextEdit};
use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::Document;
use halfvector_reference::{Edge, Finding, Precision, Stability, stability};
use halfvector_scene::{Scene, SceneMaterial};

use crate::action::{Action, found};
use crate::functions;
use crate::panes::inspector::named_text;
use crate::panes::toggle;
use crate::pictures::Pictures;
use crate::session::Session;
use crate::theme;
use crate::work::Worker;

/// What is to be looked at off the window's thread.
#[derive(Debug)]
struct Job {
    document: Arc<Document>,
    directory: PathBuf,
    revision: u64,
    /// The state of the files of its pictures.
    pictures: u64,
    /// Whether f32 is compared with f64.
    stability: bool,
}

/// What was found.
#[derive(Debug)]
struct Found {
    revision: u64,
    pictures: u64,
    problems: Vec<Problem>,
    stability: Option<Result<Stability, String>>,
}

/// The list of problems.
#[derive(Debug)]
pub(crate) struct Problems {
    worker: Option<Worker<Job, Found>>,
    /// The revision whose pictures were looked at, or are, and the state of their files.
    asked: Option<(u64, u64)>,
    notices: Arc<Vec<Problem>>,
    /// Of the revision that it holds.
    stability: Option<(u64, Result<Stability, String>)>,
    filter: String,
    errors: bool,
    warnings: bool,
}

impl Problems {
    /// Starts the thread that looks at pictures and at precision.
    pub(crate) fn new(context: &egui::Context) -> Problems {
        let mut pictures = Pictures::default();
        let worker = Worker::start("problems", context, move |job: Job, _| Some(look(&job, &mut pictures)));
        Problems {
            worker: worker.ok(),
            asked: None,
            notices: Arc::default(),
            stability: None,
            filter: String::new(),
            errors: true,
            warnings: true,
        }
    }

    /// Whether nothing is being looked at.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// What was found in the pictures that the material names.
    pub(crate) fn notices(&self) -> &Arc<Vec<Problem>> {
        &self.notices
    }

    /// How many problems there are.
    pub(crate) fn count(&self, session: &Session) -> usize {
        let unstable = self.stability.as_ref().and_then(|(_, found)| found.as_ref().ok());
        session.all_problems().count() + unstable.map_or(0, |found| found.unstable.len())
    }

    /// Takes what was found, and has the pictures looked at after a change.
    pub(crate) fn hear(&mut self, session: &Session) {
        while let Some(found) = self.worker.as_ref().and_then(Worker::poll) {
            if self.asked == Some((found.revision, found.pictures)) && *self.notices != found.problems {
                self.notices = Arc::new(found.problems);
            }
            if let Some(stability) = found.stability {
                self.stability = Some((found.revision, stability));
            }
        }
        let now = (session.revision(), session.pictures());
        if self.asked != Some(now) {
            self.asked = Some(now);
            if session.names_pictures() {
                self.submit(session, false);
            } else {
                self.notices = Arc::default();
            }
        }
    }

    fn submit(&self, session: &Session, stability: bool) {
        if let Some(worker) = &self.worker {
            let (document, directory) = (session.document().clone(), session.directory());
            let (revision, pictures) = (session.revision(), session.pictures());
            worker.submit(Job { document, directory, revision, pictures, stability });
        }
    }

    /// Draws the list.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            self.bar(ui, session);
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                let all: Vec<&Problem> = session.all_problems().collect();
                let shown: Vec<&&Problem> = all.iter().filter(|problem| self.passes(problem)).collect();
                if all.is_empty() {
                    ui.colored_label(theme::letters(theme::GOOD, ui.visuals()), "No problems");
                } else if shown.is_empty() {
                    ui.weak(format!("None of {} problems passes the filter", all.len()));
                }
                for problem in shown {
                    row(ui, session, problem, actions);
                }
                self.precision(ui, session, actions);
            });
        });
    }

    fn bar(&mut self, ui: &mut egui::Ui, session: &Session) {
        ui.horizontal(|ui| {
            toggle(ui, &mut self.errors, "Errors").on_hover_text("What keeps the material from being drawn");
            toggle(ui, &mut self.warnings, "Warnings").on_hover_text("What may not be meant");
            let field = TextEdit::singleline(&mut self.filter).hint_text("Filter").desired_width(140.0);
            let response = ui.add(field).on_hover_text("Only problems with these words");
            named_text(&response, &self.filter, "Filter problems");
            ui.separator();
            let sound = !session.problems().iter().any(|problem| problem.severity == Severity::Error);
            let busy = !self.is_idle();
            let hint = "Run every node in f32 and in f64 over the points it may meet, and list what f32 gets wrong";
            let button = ui.add_enabled(sound && !busy, Button::new("Check stability")).on_hover_text(hint);
            if button.on_disabled_hover_text("Mend the errors first").clicked() {
                self.submit(session, true);
            }
            if busy {
                ui.spinner();
            }
        });
        ui.add_space(2.0);
    }

    fn passes(&self, problem: &Problem) -> bool {
        let shown = match problem.severity {
            Severity::Error => self.errors,
            Severity::Warning => self.warnings,
        };
        let text = problem.to_string().to_lowercase();
        shown && self.filter.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }

    /// What the check of stability has found.
    fn precision(&self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        let Some((revision, found)) = &self.stability else { return };
        ui.add_space(6.0);
        ui.separator();
        ui.horizontal(|ui| {
            ui.strong("Stability");
            if *revision != session.revision() {
                ui.weak("of an older state; check again");
            }
        });
        match found {
            Err(why) => {
                ui.colored_label(theme::letters(theme::ERROR, ui.visuals()), why);
            }
            Ok(found) => {
                if found.unstable.is_empty() {
                    ui.colored_label(
                        theme::letters(theme::GOOD, ui.visuals()),
                        "f32 computes what exact arithmetic does, everywhere that was tried",
                    );
                }
                found.unstable.iter().for_each(|finding| unstable(ui, session, finding, actions));
                found.edges.iter().for_each(|jump| edge(ui, session, jump, actions));
            }
        }
    }
}

fn look(job: &Job, pictures: &mut Pictures) -> Found {
    let material = SceneMaterial { document: (*job.document).clone(), directory: job.directory.clone() };
    pictures.load(&material);
    let problems = pictures.problems(&material);
    let found = job.stability.then(|| {
        let images = pictures.whole().map_err(ToString::to_string)?.clone();
        let scene = Scene { materials: vec![material], images, ..Scene::default() };
        stability(&scene, 0, Precision::Single).map_err(|error| error.to_string())
    });
    Found { revision: job.revision, pictures: job.pictures, problems, stability: found }
}

fn row(ui: &mut egui::Ui, session: &Session, problem: &Problem, actions: &mut Vec<Action>) {
    let (mark, color) = match problem.severity {
        Severity::Error => ("•", theme::ERROR),
        Severity::Warning => ("⚠", theme::WARNING),
    };
    ui.horizontal_wrapped(|ui| {
        ui.colored_label(theme::letters(color, ui.visuals()), mark);
        if let Some(node) = &problem.node {
            let label = problem.node_label.as_deref().unwrap_or(node);
            if ui.link(label).on_hover_text("Show the node").clicked() {
                actions.push(Action::Find { group: problem.group.clone(), node: node.clone() });
            }
        }
        if let Some(function) = functions::of_problem(session.document(), problem)
            && ui.link(function).on_hover_text("Show its code").clicked()
        {
            actions.push(Action::EditFunction(function.to_owned()));
        }
        if let Some(socket) = &problem.socket {
            ui.weak(socket);
        }
        ui.label(&problem.message);
    });
}

fn unstable(ui: &mut egui::Ui, session: &Session, finding: &Finding, actions: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        ui.colored_label(theme::letters(theme::WARNING, ui.visuals()), "⚠");
        output(ui, session, (&finding.node, &finding.label, &finding.output), actions);
        let (narrow, exact) = (number(finding.narrow), number(finding.exact));
        ui.label(format!("f32 is wrong: {narrow} instead of {exact}{}", place(&finding.input)));
        for (count, what) in [
            (finding.nan, "no number"),
            (finding.infinite, "infinite"),
            (finding.underflows, "below f32's range"),
            (finding.beyond_f16, "beyond f16's range"),
        ] {
            if count > 0 {
                ui.weak(format!("{what} at {count} points"));
            }
        }
        match finding.behind.len() {
            0 => {}
            1 => drop(ui.weak("a node behind it is wrong as well")),
            count => drop(ui.weak(format!("{count} nodes behind it are wrong as well"))),
        }
    });
}

fn edge(ui: &mut egui::Ui, session: &Session, edge: &Edge, actions: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        ui.weak("•");
        output(ui, session, (&edge.node, &edge.label, &edge.output), actions);
        ui.label(format!("jumps from {} to {}{}", number(edge.from), number(edge.to), place(&edge.input)));
    });
}

/// The node, to be shown by a click, and its output.
fn output(ui: &mut egui::Ui, session: &Session, (node, label, output): (&str, &str, &str), actions: &mut Vec<Action>) {
    if ui.link(label).on_hover_text("Show the node").clicked() {
        actions.extend(found(session.document(), node));
    }
    ui.weak(output);
}

/// A value with six digits behind the point, or as a power of ten where these would not show it.
fn number(x: f64) -> String {
    if x == 0.0 || (1e-4..1e7).contains(&x.abs()) || !x.is_finite() { format!("{x:.6}") } else { format!("{x:.6e}") }
}

/// Where that is.
fn place(input: &[(String, f64)]) -> String {
    let place: Vec<String> = input.iter().map(|(name, x)| format!("{name} = {}", number(*x))).collect();
    if place.is_empty() { String::new() } else { format!(" at {}", place.join(", ")) }
}
