//! Small pictures of what a node gives, and of whole materials: drawn when they are looked at, newest first, on a thread of
//! their own, and kept by what they show.
//!
//! A value is shown as a surface that glows with it, on a plane, or on a sphere when it depends on where it is seen from.

mod preview;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{self, Color32, Sense};
use halfvector_graph::document::Document;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_scene::{BuiltinMesh, Camera, EnvironmentSource, MeshSource};

use crate::environments::{Light, light};
use crate::paint::{Easel, Gpu, Shot, coded};
use crate::session::Session;
use crate::stage::{Orbit, Stage};
use crate::work::Worker;

/// Pixels along an edge of what is drawn; shown larger or smaller.
const EDGE: u32 = 96;
/// Most pictures that are kept.
const KEPT: usize = 512;

/// What a picture shows; its text tells it apart from all others.
#[derive(Clone, Debug)]
struct Subject {
    key: Arc<str>,
    document: Arc<Document>,
    directory: PathBuf,
    mesh: BuiltinMesh,
    /// A material in light, or a value that glows.
    is_lit: bool,
}

/// A picture that was made, or none where there cannot be one.
struct Made {
    key: Arc<str>,
    image: Option<egui::ColorImage>,
}

struct Kept {
    texture: Option<egui::TextureHandle>,
    used: u64,
}

/// The pictures.
pub(crate) struct Thumbnails {
    worker: Option<Worker<Vec<Subject>, Made>>,
    kept: HashMap<Arc<str>, Kept>,
    /// What nodes show, as of a revision, a state of files, a folder and a level: the text is made once.
    nodes: HashMap<(String, String), Option<Subject>>,
    shown: Option<(u64, u64, PathBuf, Vec<String>)>,
    /// Looked at since the last frame and not there, the newest last.
    wanted: Vec<Subject>,
    /// What the thread was given last.
    asked: HashSet<Arc<str>>,
    frame: u64,
}

impl Thumbnails {
    /// Starts the thread.
    pub(crate) fn new(context: &egui::Context, gpu: &Gpu) -> Thumbnails {
        let (gpu, mut studio) = (gpu.clone(), None);
        let mut easels = [Easel::default(), Easel::default(), Easel::default()];
        let worker = Worker::start_telling("thumbnails", context, move |subjects: Vec<Subject>, stale, outbox| {
            for subject in subjects {
                // An easel for each kind, so that meshes and lights stay.
                let easel = match (subject.is_lit, subject.mesh) {
                    (true, _) => &mut easels[0],
                    (false, BuiltinMesh::Plane) => &mut easels[1],
                    (false, _) => &mut easels[2],
                };
                let image = drawn(&subject, easel, &gpu, &mut studio);
                outbox.send(Made { key: subject.key, image });
                if stale.is_stale() {
                    return;
                }
            }
        });
        Thumbnails {
            worker: worker.ok(),
            kept: HashMap::new(),
            nodes: HashMap::new(),
            shown: None,
            wanted: Vec::new(),
            asked: HashSet::new(),
            frame: 0,
        }
    }

    /// Whether nothing is being drawn.
    pub(crate) fn is_idle(&self) -> bool {
        self.wanted.is_empty() && self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// Once a frame, after everything was shown: takes what is done and asks for what was looked at.
    pub(crate) fn end_frame(&mut self, context: &egui::Context) {
        self.frame += 1;
        while let Some(made) = self.worker.as_ref().and_then(Worker::poll) {
            let load = |image| context.load_texture(&*made.key, image, egui::TextureOptions::LINEAR);
            let texture = made.image.map(load);
            self.asked.remove(&made.key);
            self.kept.insert(made.key, Kept { texture, used: self.frame });
            // What waited for it is drawn in another frame.
            context.request_repaint();
        }
        if self.kept.len() > KEPT {
            let frame = self.frame;
            self.kept.retain(|_, kept| kept.used + 600 > frame);
        }
        let mut wanted = std::mem::take(&mut self.wanted);
        wanted.retain(|subject| !self.kept.contains_key(&subject.key));
        if wanted.iter().any(|subject| !self.asked.contains(&subject.key))
            && let Some(worker) = &self.worker
        {
            wanted.reverse();
            self.asked = wanted.iter().map(|subject| subject.key.clone()).collect();
            worker.submit(wanted);
        }
    }

    /// Shows what an output of a node of the open material gives, as a square of `size` points. An output without a
    /// picture, a texture's or an unknown one's, leaves an empty square.
    pub(crate) fn show(
        &mut self,
        ui: &mut egui::Ui,
        session: &Session,
        node: &str,
        output: &str,
        size: f32,
    ) -> egui::Response {
        let now = (session.revision(), session.pictures(), session.directory(), session.path().to_vec());
        if self.shown.as_ref() != Some(&now) {
            self.nodes.clear();
            self.shown = Some(now);
        }
        let key = (node.to_owned(), output.to_owned());
        let subject = self.nodes.entry(key).or_insert_with(|| preview::preview(session, node, output)).clone();
        let (rect, response) = ui.allocate_exact_size(egui::Vec2::splat(size), Sense::hover());
        self.paint(ui, rect, subject);
        let label = format!("{output} of {node}");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, &label));
        response
    }

    /// Paints a whole material on a sphere in the studio's light.
    pub(crate) fn paint_material(
        &mut self,
        ui: &egui::Ui,
        rect: egui::Rect,
        key: &str,
        document: &Arc<Document>,
        directory: &std::path::Path,
    ) {
        let subject = Subject {
            key: format!("material {key}").into(),
            document: document.clone(),
            directory: directory.to_owned(),
            mesh: BuiltinMesh::Sphere,
            is_lit: true,
        };
        self.paint(ui, rect, Some(subject));
    }

    fn paint(&mut self, ui: &egui::Ui, rect: egui::Rect, subject: Option<Subject>) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let rounding = 4.0;
        ui.painter().rect_filled(rect, rounding, ui.visuals().extreme_bg_color);
        let Some(subject) = subject else { return };
        match self.kept.get_mut(&subject.key) {
            Some(kept) => {
                kept.used = self.frame;
                if let Some(texture) = &kept.texture {
                    let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
                    let shape = egui::epaint::RectShape::filled(rect, rounding, Color32::WHITE)
                        .with_texture(texture.id(), whole);
                    ui.painter().add(shape);
                }
            }
            None => self.wanted.push(subject),
        }
    }
}

/// A picture of a subject; none when it has problems.
fn drawn(subject: &Subject, easel: &mut Easel, gpu: &Gpu, studio: &mut Option<Arc<Light>>) -> Option<egui::ColorImage> {
    let vertical_fov = match (subject.is_lit, subject.mesh) {
        // The plane fills the picture, the sphere nearly.
        (false, BuiltinMesh::Plane) => 2.0 * 0.2f32.atan().to_degrees(),
        _ => 24.0,
    };
    let camera = Camera { vertical_fov, ..Camera::default() };
    let stage = Stage {
        mesh: MeshSource::Builtin(subject.mesh),
        environment: if subject.is_lit { EnvironmentSource::Studio } else { EnvironmentSource::None },
        tone_map: if subject.is_lit { ToneMap::PbrNeutral } else { ToneMap::None },
        orbit: Orbit::of(&camera),
        ..Stage::default()
    };
    if subject.is_lit && studio.is_none() {
        *studio = light(&EnvironmentSource::Studio, &Methods::default()).ok();
    }
    let size = [EDGE; 2];
    let shot = Shot {
        document: subject.document.clone(),
        directory: subject.directory.clone(),
        light: studio.clone().filter(|_| subject.is_lit),
        stage,
        size,
        is_moving: false,
    };
    easel.set(&shot).ok()?;
    let on_gpu = gpu.renderer().and_then(|device| match easel.draw_on(&device, size, 2, |_| true) {
        Ok(picture) => picture,
        Err(error) => {
            if error.is_of_device() {
                easel.leave_device();
                gpu.lose(error.to_string());
            }
            None
        }
    });
    let picture = match on_gpu {
        Some(picture) => picture,
        None => easel.draw(size, 1, |_| true).ok()??,
    };
    Some(coded(&picture, shot.stage.display()))
}
