//! The exported shader of the material. It is made on a thread of its own; the old text stays until the new one is there.

use std::sync::Arc;

use eframe::egui;
use halfvector_codegen::target::{TARGETS, export, target};
use halfvector_codegen::{Fold, shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput};

use crate::action::Action;
use crate::session::Session;
use crate::work::Worker;

/// A shader that is wanted.
#[derive(Clone, Debug)]
struct Job {
    document: Arc<Document>,
    target: &'static str,
}

/// A shader, or why there is none.
#[derive(Debug)]
struct Made {
    text: Result<String, String>,
}

/// The shader's text.
#[derive(Debug)]
pub(crate) struct Code {
    worker: Option<Worker<Job, Made>>,
    target: &'static str,
    /// Revision and target of the job that was given last.
    asked: Option<(u64, &'static str)>,
    made: Option<Made>,
}

impl Code {
    /// Starts the thread that makes shaders.
    pub(crate) fn new(context: &egui::Context) -> Code {
        let worker = Worker::start("code", context, |job: Job, _| Some(Made { text: make(&job) }));
        Code { worker: worker.ok(), target: "wgsl", asked: None, made: None }
    }

    /// Whether no shader is being made.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// Draws the text.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, _actions: &mut Vec<Action>) {
        let Some(worker) = &self.worker else { return };
        let wanted = (session.revision(), self.target);
        if self.asked != Some(wanted) {
            self.asked = Some(wanted);
            worker.submit(Job { document: session.document().clone(), target: self.target });
        }
        while let Some(made) = worker.poll() {
            self.made = Some(made);
        }
        ui.horizontal(|ui| {
            for target in TARGETS {
                ui.selectable_value(&mut self.target, target.name, target.name);
            }
            let text = self.made.as_ref().and_then(|made| made.text.as_ref().ok());
            if ui.add_enabled(text.is_some(), egui::Button::new("Copy")).clicked()
                && let Some(text) = text
            {
                ui.ctx().copy_text(text.clone());
            }
        });
        match &self.made {
            Some(Made { text: Ok(text) }) => {
                egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
                    ui.add(egui::Label::new(egui::RichText::new(text).monospace()).extend());
                });
            }
            Some(Made { text: Err(why) }) => {
                ui.label(why);
            }
            None => {
                ui.spinner();
            }
        }
    }
}

fn make(job: &Job) -> Result<String, String> {
    let needs = Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    let shader = shader(&job.document, Library::standard(), &needs, Fold::Export).map_err(|error| error.to_string())?;
    let target = target(job.target).ok_or_else(|| format!("there is no target {}", job.target))?;
    let files = export(&shader, target, "material").map_err(|error| error.to_string())?;
    let texts = files.iter().filter(|file| !file.name.ends_with(".json"));
    Ok(texts.map(|file| String::from_utf8_lossy(&file.bytes)).collect::<Vec<_>>().join("\n"))
}
