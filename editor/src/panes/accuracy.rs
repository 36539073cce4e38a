//! How exact the shader of this material is: its error against the reference, what other methods would give, and the white
//! furnace. Errors are measured in the background while the pane is seen and the material rests; the furnace when it is asked for.

use std::time::{Duration, Instant};

use eframe::egui;
use halfvector_graph::check::Severity;
use halfvector_graph::docs::capitalised;
use halfvector_graph::method::term;

use crate::accuracy::{Bench, Furnace, Job, Row, Told, What};
use crate::paint::Gpu;
use crate::panes::viewport::Viewport;
use crate::session::Session;
use crate::theme;
use crate::work::Worker;

/// How long a material rests before its errors are measured.
const REST: Duration = Duration::from_millis(1500);

/// The measurements.
pub(crate) struct Accuracy {
    worker: Option<Worker<Job, Told>>,
    /// What is being done and how far it is.
    doing: Option<(String, f32)>,
    /// Noise of the truth and its paths.
    truth: Option<(f64, u64)>,
    rows: Vec<Row>,
    furnace: Option<(Box<Furnace>, egui::TextureHandle)>,
    failed: Option<String>,
    /// What of the material is no finite number, in words.
    faults: Vec<String>,
    /// Of the document whose errors were measured, or are, or are not to be.
    measured: Option<u64>,
    /// The document that is seen, and since when.
    seen: Option<(u64, Instant)>,
    /// What was started last.
    what: What,
}

impl Accuracy {
    /// Starts the thread.
    pub(crate) fn new(context: &egui::Context, gpu: &Gpu) -> Accuracy {
        let mut bench = Bench::new(gpu);
        let worker = Worker::start_telling("accuracy", context, move |job: Job, stale, outbox| {
            bench.measure(&job, stale, outbox);
        });
        Accuracy {
            worker: worker.ok(),
            doing: None,
            truth: None,
            rows: Vec::new(),
            furnace: None,
            failed: None,
            faults: Vec::new(),
            measured: None,
            seen: None,
            what: What::Errors,
        }
    }

    /// Whether nothing is being measured.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// Draws what is known.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, viewport: &mut Viewport) {
        self.poll(ui);
        self.follow(ui, session, viewport);
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                let is_busy = !self.is_idle();
                let mut start = None;
                ui.add_enabled_ui(!is_busy, |ui| {
                    let help = "Compares a small picture with the reference, as it is and with other methods";
                    if ui.button("Measure errors").on_hover_text(help).clicked() {
                        start = Some(What::Errors);
                    }
                    let help =
                        "Radiance 1 from everywhere: a white surface must vanish, nothing may be brighter than 1";
                    if ui.button("Furnace test").on_hover_text(help).clicked() {
                        start = Some(What::Furnace);
                    }
                });
                if is_busy && ui.button("Stop").clicked() {
                    self.worker.iter().for_each(Worker::cancel);
                    self.doing = None;
                }
                if let Some(what) = start {
                    self.start(what, ui, session, viewport);
                }
                if !self.rows.is_empty() && self.measured != Some(session.revision()) {
                    ui.colored_label(
                        theme::letters(theme::WARNING, ui.visuals()),
                        "The material has changed since it was measured.",
                    );
                }
            });
            if let Some((doing, done)) = &self.doing {
                ui.add(egui::ProgressBar::new(*done).text(doing.as_str()).desired_width(260.0));
            }
            if let Some(why) = &self.failed {
                ui.colored_label(theme::letters(theme::ERROR, ui.visuals()), why);
            }
            for fault in &self.faults {
                ui.colored_label(theme::letters(theme::WARNING, ui.visuals()), capitalised(fault));
            }
            egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
                ui.horizontal_top(|ui| {
                    ui.vertical(|ui| self.table(ui));
                    ui.add_space(16.0);
                    ui.vertical(|ui| self.furnace_card(ui));
                });
            });
        });
    }

    /// Measures the errors of what has come to rest, unless a person stopped that. What runs for an older state is ended.
    fn follow(&mut self, ui: &egui::Ui, session: &Session, viewport: &mut Viewport) {
        let revision = session.revision();
        let since = match self.seen {
            Some((seen, since)) if seen == revision => since,
            _ => {
                self.seen = Some((revision, Instant::now()));
                if !self.is_idle() && self.what == What::Errors {
                    self.worker.iter().for_each(Worker::cancel);
                    self.doing = None;
                }
                Instant::now()
            }
        };
        let is_sound = !session.problems().iter().any(|problem| problem.severity == Severity::Error);
        if self.measured == Some(revision) || !is_sound {
            return;
        }
        let left = REST.saturating_sub(since.elapsed());
        if left.is_zero() && self.is_idle() && viewport.is_idle() {
            self.start(What::Errors, ui, session, viewport);
        } else {
            ui.ctx().request_repaint_after(left.max(Duration::from_millis(100)));
        }
    }

    fn start(&mut self, what: What, ui: &egui::Ui, session: &Session, viewport: &mut Viewport) {
        // What an older one has told last is not of this one.
        self.poll(ui);
        let Some(worker) = &self.worker else { return };
        self.failed = None;
        self.what = what;
        match what {
            What::Errors => {
                (self.rows, self.truth, self.faults) = (Vec::new(), None, Vec::new());
                self.measured = Some(session.revision());
            }
            What::Furnace => self.furnace = None,
        }
        self.doing = Some(("Starting".to_owned(), 0.0));
        worker.submit(Job {
            document: session.document().clone(),
            directory: session.directory(),
            stage: viewport.stage().clone(),
            light: viewport.light(),
            what,
        });
    }

    fn poll(&mut self, ui: &egui::Ui) {
        while let Some(told) = self.worker.as_ref().and_then(Worker::poll) {
            match told {
                Told::Progress(doing, done) => self.doing = Some((doing, done)),
                Told::Truth(noise, samples) => self.truth = Some((noise, samples)),
                Told::Faults(faults) => self.faults = faults,
                Told::Row(row) => self.rows.push(row),
                Told::Furnace(furnace) => {
                    let options = egui::TextureOptions::LINEAR;
                    let texture = ui.ctx().load_texture("furnace", furnace.image.clone(), options);
                    self.furnace = Some((furnace, texture));
                }
                Told::Failed(why) => (self.failed, self.doing) = (Some(why), None),
                Told::Done => self.doing = None,
            }
        }
    }

    fn table(&self, ui: &mut egui::Ui) {
        let Some(first) = self.rows.first() else {
            // Beside it nothing else has room.
            if self.failed.is_none() && self.doing.is_none() && self.furnace.is_none() {
                ui.weak(
                    "Not measured yet. Measuring draws this material with the viewport's methods and with each other one, and \
                     compares the pictures with a path-traced reference. The furnace test draws it in even light: what is \
                     darker or brighter than the light loses energy, or makes it.",
                );
            }
            return;
        };
        if let Some((noise, samples)) = self.truth {
            let text = format!("Against {samples} paths for each pixel, noise ±{:.2} % of the light", 100.0 * noise);
            ui.weak(text);
        }
        egui::Grid::new("errors").num_columns(5).striped(true).spacing([16.0, 4.0]).show(ui, |ui| {
            for (title, help) in [
                ("Term", "The term whose method is swapped"),
                ("Method", "What is in its place"),
                ("FLIP", "How different it looks, 0 to 1, mean of the picture"),
                ("rmse", "Root of the mean squared difference of radiance, noise taken off"),
                ("Brighter", "How much brighter than the truth"),
            ] {
                ui.strong(title).on_hover_text(help);
            }
            ui.end_row();
            for row in &self.rows {
                ui.label(row.term.unwrap_or("all"));
                let source = row.term.and_then(term).and_then(|term| {
                    term.methods.iter().find(|method| method.name == row.method).map(|method| method.source)
                });
                let label = ui.label(row.method);
                if let Some(source) = source {
                    label.on_hover_text(source);
                }
                // What makes the picture visibly better or worse than it is.
                let color = match row.flip - first.flip {
                    change if change < -0.0005 => theme::letters(theme::GOOD, ui.visuals()),
                    change if change > 0.0005 => theme::letters(theme::WARNING, ui.visuals()),
                    _ => ui.visuals().text_color(),
                };
                for text in [
                    format!("{:.4}", row.flip),
                    format!("{:.4}", row.rmse),
                    format!("{:>+8.2} %", 100.0 * row.brighter),
                ] {
                    ui.label(egui::RichText::new(text).monospace().color(color));
                }
                ui.end_row();
            }
        });
    }

    fn furnace_card(&self, ui: &mut egui::Ui) {
        let Some((furnace, texture)) = &self.furnace else { return };
        ui.strong("White furnace");
        ui.horizontal_top(|ui| {
            let picture = egui::Image::new((texture.id(), egui::Vec2::splat(112.0)));
            ui.add(picture.alt_text("The material in the white furnace"));
            ui.vertical(|ui| {
                let [least, mean, most] = furnace.reflected;
                for (name, value) in [("Least", least), ("Mean", mean), ("Most", most)] {
                    let color = if value > 1.005 {
                        theme::letters(theme::ERROR, ui.visuals())
                    } else {
                        ui.visuals().text_color()
                    };
                    ui.label(egui::RichText::new(format!("{name:<6}{value:.4}")).monospace().color(color));
                }
            });
        });
        if furnace.by_roughness.len() > 1 {
            ui.weak("Mean over the roughness");
            plot(ui, &furnace.by_roughness);
        }
    }
}

/// A line through points in 0..1, with 1 marked.
fn plot(ui: &mut egui::Ui, points: &[[f64; 2]]) {
    let (rect, response) = ui.allocate_exact_size(egui::vec2(220.0, 90.0), egui::Sense::hover());
    let top = points.iter().map(|point| point[1]).fold(1.0, f64::max) * 1.05;
    let place = |[x, y]: [f64; 2]| {
        egui::pos2(rect.left() + rect.width() * x as f32, rect.bottom() - rect.height() * (y / top) as f32)
    };
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    let faint = ui.visuals().weak_text_color();
    painter.hline(rect.x_range(), place([0.0, 1.0]).y, egui::Stroke::new(1.0, faint));
    let font = egui::FontId::proportional(10.0);
    painter.text(place([0.0, 1.0]) + egui::vec2(3.0, 1.0), egui::Align2::LEFT_TOP, "1", font, faint);
    let line = points.iter().map(|&point| place(point)).collect();
    painter.add(egui::Shape::line(line, egui::Stroke::new(1.5, theme::ACCENT)));
    let text: Vec<String> =
        points.iter().map(|[roughness, mean]| format!("roughness {roughness:.2}: {mean:.4}")).collect();
    response.on_hover_text(text.join("\n"));
}
