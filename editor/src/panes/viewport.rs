//! The picture of the material, drawn live: orbit, pan, zoom, lights that are dragged, files that are dropped, two sides that
//! are compared. Drawing, loading and baking happen on other threads; the old picture stays until the new one is there.

mod compare;
pub(crate) mod dropped;
mod lamps;
mod overlays;
mod toolbar;

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{self, PointerButton, Sense};
use halfvector_graph::document::Document;
use halfvector_scene::mesh::Bounds;
use halfvector_scene::{EnvironmentSource, MeshSource, Picture};

use self::compare::Compare;
use crate::action::Action;
use crate::environments::{Environments, Light};
use crate::library::LibraryMaterial;
use crate::paint::{Drawn, Engine, Fault, Gpu, Noise, Painter, Request, Shot, start};
use crate::session::Session;
use crate::stage::{Orbit, Stage};
use crate::thumbnails::Thumbnails;
use crate::work::Worker;

/// The picture and what it shows the material on.
pub(crate) struct Viewport {
    stage: Stage,
    gpu: Gpu,
    /// In the order of [`Engine::ALL`].
    painters: [Option<Painter>; 3],
    environments: Environments,
    sides: [Side; 2],
    compare: Compare,
    /// Numbers wishes.
    next_key: u64,
    /// Numbers pictures.
    next_serial: u64,
    /// Turns the camera by itself.
    turntable: bool,
    /// What a person should know, until it is closed.
    banner: Option<String>,
    /// What could be drawn and baked last.
    good: (MeshSource, EnvironmentSource),
    /// A model that has just come and is brought into view when it is there.
    frames: bool,
    bounds: Option<Bounds>,
    dialog: egui_file_dialog::FileDialog,
    picks: toolbar::Picks,
    selected_lamp: Option<usize>,
}

/// One picture of the window.
#[derive(Default)]
struct Side {
    wish: Option<Wish>,
    key: u64,
    shown: Option<Shown>,
    fault: Option<Fault>,
    texture: Option<egui::TextureHandle>,
}

/// What was drawn last.
struct Shown {
    key: u64,
    /// Tells it from all others, finer ones of the same wish too.
    serial: u64,
    picture: Arc<Picture>,
    by: String,
    milliseconds: f64,
    /// Whether a program was compiled for it.
    is_compiled: bool,
    noise: Option<Noise>,
    is_final: bool,
}

/// What a picture depends on.
struct Wish {
    engine: Engine,
    document: Arc<Document>,
    directory: PathBuf,
    /// The state of the files of its pictures.
    pictures: u64,
    stage: Stage,
    light: Option<Arc<Light>>,
    size: [u32; 2],
    is_moving: bool,
}

impl Wish {
    /// Whether it is the same picture, coarse or fine.
    fn is_same(&self, other: &Wish) -> bool {
        self.engine == other.engine
            && Arc::ptr_eq(&self.document, &other.document)
            && self.directory == other.directory
            && self.pictures == other.pictures
            && self.stage == other.stage
            && self.light.as_ref().map(Arc::as_ptr) == other.light.as_ref().map(Arc::as_ptr)
            && self.size == other.size
    }
}

impl Viewport {
    /// Starts the threads that draw and bake.
    pub(crate) fn new(context: &egui::Context, gpu: &Gpu) -> Viewport {
        let stage = Stage::default();
        Viewport {
            painters: Engine::ALL.map(|engine| start(engine, context, gpu).ok()),
            gpu: gpu.clone(),
            environments: Environments::new(context),
            sides: Default::default(),
            compare: Compare::new(context),
            next_key: 0,
            next_serial: 0,
            turntable: false,
            banner: None,
            good: (stage.mesh.clone(), stage.environment.clone()),
            frames: false,
            bounds: None,
            dialog: egui_file_dialog::FileDialog::new(),
            picks: toolbar::Picks::Mesh,
            selected_lamp: None,
            stage,
        }
    }

    /// Whether no picture is being made and none is asked for.
    pub(crate) fn is_idle(&self) -> bool {
        self.painters.iter().flatten().all(|painter| !painter.is_busy())
            && self.environments.is_idle()
            && self.compare.is_idle()
    }

    /// What the material is seen on.
    pub(crate) fn stage(&self) -> &Stage {
        &self.stage
    }

    /// The light that the stage's environment gives, when it is baked.
    pub(crate) fn light(&mut self) -> Option<Arc<Light>> {
        self.environments.get(&self.stage.environment, &self.stage.methods).ok().flatten()
    }

    /// Who drew the picture that is shown, for people.
    pub(crate) fn drawn_by(&self) -> Option<&str> {
        self.sides[0].shown.as_ref().map(|shown| shown.by.as_str())
    }

    /// Whether the CPU draws, chosen or for want of a GPU.
    pub(crate) fn draws_on_cpu(&self) -> bool {
        self.gpu.trouble().is_some()
    }

    /// Lets the CPU draw in place of the GPU, or tries the GPU again.
    pub(crate) fn draw_on_cpu(&mut self, on_cpu: bool) {
        if on_cpu {
            self.gpu.leave("as it was chosen in the menu View".to_owned());
        } else {
            self.gpu.retry();
            self.sides.iter_mut().for_each(|side| side.wish = None);
        }
    }

    /// Draws the picture and takes drags of the pointer.
    pub(crate) fn show(
        &mut self,
        ui: &mut egui::Ui,
        session: &Session,
        thumbnails: &mut Thumbnails,
        actions: &mut Vec<Action>,
    ) {
        self.take_picked(ui);
        egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 4)).show(ui, |ui| self.toolbar(ui, session));
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "Picture of the material"));
        self.take_dropped(ui, &response, actions);
        self.turn(ui, &response);
        self.poll(ui);
        self.ask(ui, session, rect);
        ui.painter().rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
        self.paint_sides(ui, rect);
        self.lamp_handles(ui, rect);
        self.overlays(ui, rect);
        overlays::selected(ui, rect, session, thumbnails);
    }

    /// Takes what the threads have done.
    fn poll(&mut self, ui: &egui::Ui) {
        if let Some((source, why)) = self.environments.poll()
            && source == self.stage.environment
        {
            self.banner = Some(format!("The environment stays as it was: {why}"));
            self.stage.environment = self.good.1.clone();
        }
        for engine in 0..self.painters.len() {
            while let Some(drawn) = self.painters[engine].as_ref().and_then(Worker::poll) {
                self.take(ui, drawn);
            }
        }
    }

    fn take(&mut self, ui: &egui::Ui, drawn: Drawn) {
        let Some(side) = self.sides.get_mut(drawn.side) else { return };
        // A wish of another engine may have been answered late.
        if side.shown.as_ref().is_some_and(|shown| shown.key > drawn.key) {
            return;
        }
        let painting = match drawn.result {
            Ok(painting) => painting,
            Err(fault) => {
                if drawn.key != side.key {
                    return;
                }
                if let Fault::Mesh(why) = &fault
                    && self.stage.mesh != self.good.0
                {
                    self.banner = Some(format!("The model stays as it was: {why}"));
                    self.stage.mesh = self.good.0.clone();
                    self.frames = false;
                } else {
                    side.fault = Some(fault);
                }
                return;
            }
        };
        side.fault = None;
        match &mut side.texture {
            Some(texture) => texture.set(painting.image, egui::TextureOptions::LINEAR),
            None => {
                let name = format!("viewport {}", drawn.side);
                let texture = ui.ctx().load_texture(name, painting.image, egui::TextureOptions::LINEAR);
                side.texture = Some(texture);
            }
        }
        self.next_serial += 1;
        side.shown = Some(Shown {
            key: drawn.key,
            serial: self.next_serial,
            picture: painting.picture,
            by: drawn.by,
            milliseconds: drawn.took.as_secs_f64() * 1e3,
            is_compiled: painting.compiled > 0,
            noise: painting.noise,
            is_final: drawn.is_final,
        });
        if drawn.side == 0 {
            self.bounds = painting.bounds;
            if let Some(wish) = &side.wish
                && drawn.key == side.key
            {
                self.good.0 = wish.stage.mesh.clone();
                if std::mem::take(&mut self.frames)
                    && let Some(bounds) = self.bounds
                {
                    self.stage.orbit = self.stage.orbit.framing(bounds);
                }
            }
        }
    }

    /// Asks the painters for what is not drawn yet.
    fn ask(&mut self, ui: &egui::Ui, session: &Session, rect: egui::Rect) {
        let scale = ui.ctx().pixels_per_point();
        let size = [rect.width(), rect.height()].map(|length| ((length * scale) as u32).clamp(1, 4096));
        let is_moving = self.turntable || ui.input(|input| input.pointer.any_down());
        let count = if self.compare.is_on() { 2 } else { 1 };
        let mut has_new = [false; 3];
        for number in 0..count {
            let mut stage = self.stage.clone();
            stage.orbit = stage.orbit.within(rect.aspect_ratio());
            let choice = self.compare.choice(number);
            if let Some(methods) = &choice.methods {
                stage.methods = methods.clone();
            }
            let light = match self.environments.get(&stage.environment, &stage.methods) {
                Ok(light) => {
                    self.good.1 = stage.environment.clone();
                    light
                }
                // Until it is baked the old one lights it.
                Err(()) => match &self.sides[number].wish {
                    Some(wish) => wish.light.clone(),
                    None => continue,
                },
            };
            let (document, directory) = match &choice.pinned {
                Some(pinned) => (pinned.document.clone(), pinned.directory.clone()),
                None => (session.document().clone(), session.directory()),
            };
            let pictures = session.pictures();
            let wish = Wish { engine: choice.engine, document, directory, pictures, stage, light, size, is_moving };
            let side = &mut self.sides[number];
            // While something moves elsewhere the picture stays as it is; when it ends, a coarse one is refined.
            let is_drawn =
                side.wish.as_ref().is_some_and(|before| before.is_same(&wish) && (wish.is_moving || !before.is_moving));
            if !is_drawn {
                self.next_key += 1;
                side.key = self.next_key;
                has_new[wish.engine as usize] = true;
                side.wish = Some(wish);
            }
        }
        for (number, engine) in Engine::ALL.into_iter().enumerate() {
            let Some(painter) = &self.painters[number] else { continue };
            let of_engine = |side: &&Side| side.wish.as_ref().is_some_and(|wish| wish.engine == engine);
            let used = self.sides[..count].iter().any(|side| of_engine(&side));
            if !used && painter.is_busy() {
                painter.cancel();
            }
            if !has_new[number] {
                continue;
            }
            // What runs becomes stale: what it was to draw for the other side is asked again.
            let is_open =
                |side: &Side| side.shown.as_ref().is_none_or(|shown| shown.key != side.key || !shown.is_final);
            let requests = self.sides[..count].iter().enumerate().filter(|(_, side)| of_engine(side) && is_open(side));
            let requests = requests.filter_map(|(number, side)| Some(request(number, side.key, side.wish.as_ref()?)));
            painter.submit(requests.collect());
        }
    }

    fn turn(&mut self, ui: &egui::Ui, response: &egui::Response) {
        let orbit = &mut self.stage.orbit;
        let drag = response.drag_delta() / response.rect.height().max(1.0);
        let shift = ui.input(|input| input.modifiers.shift);
        let left = response.dragged_by(PointerButton::Primary);
        let others = response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary);
        if self.compare.drags_divider() {
            // The divider moves instead.
        } else if others || (left && shift) {
            let seen = orbit.within(response.rect.aspect_ratio());
            orbit.target = seen.panned(-drag.x, drag.y).target;
        } else if left {
            *orbit = orbit.turned(-drag.x * 4.0, drag.y * 4.0);
        }
        if response.contains_pointer() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            if scroll != 0.0 || pinch != 1.0 {
                *orbit = orbit.zoomed((scroll * 0.004).exp() * pinch);
            }
        }
        if response.double_clicked() {
            self.frame();
        }
        if response.clicked() {
            response.request_focus();
            self.selected_lamp = None;
        }
        if response.has_focus() {
            self.turn_by_keys(ui);
        }
        if self.turntable {
            let seconds = ui.input(|input| input.stable_dt).min(0.1);
            self.stage.orbit = self.stage.orbit.turned(0.5 * seconds, 0.0);
            ui.ctx().request_repaint();
        }
    }

    /// Arrows turn, + and - zoom, F frames.
    fn turn_by_keys(&mut self, ui: &egui::Ui) {
        let pressed = |key| ui.input(|input| input.key_pressed(key));
        let step = |more, less| f32::from(u8::from(pressed(more))) - f32::from(u8::from(pressed(less)));
        let (yaw, pitch) =
            (step(egui::Key::ArrowLeft, egui::Key::ArrowRight), step(egui::Key::ArrowUp, egui::Key::ArrowDown));
        let zoom = step(egui::Key::Plus, egui::Key::Minus) + step(egui::Key::Equals, egui::Key::Minus);
        self.stage.orbit = self.stage.orbit.turned(0.1 * yaw, 0.1 * pitch).zoomed((0.1 * zoom).exp());
        if pressed(egui::Key::F) {
            self.frame();
        }
    }

    /// Brings everything into view: built-in shapes as the command line shows them.
    fn frame(&mut self) {
        self.stage.orbit = match (&self.stage.mesh, self.bounds) {
            (MeshSource::File(_), Some(bounds)) => self.stage.orbit.framing(bounds),
            _ => Stage::default().orbit,
        };
    }

    /// Replaces the mesh; a model is framed when it is there.
    fn set_mesh(&mut self, mesh: MeshSource) {
        self.frames = matches!(mesh, MeshSource::File(_));
        if !self.frames {
            self.stage.orbit =
                Orbit { yaw: self.stage.orbit.yaw, pitch: self.stage.orbit.pitch, ..Stage::default().orbit };
        }
        self.stage.mesh = mesh;
    }

    fn set_environment(&mut self, environment: EnvironmentSource) {
        self.environments.forgive();
        self.stage.environment = environment;
    }

    /// Replaces the material by one of the library.
    fn wear(material: &LibraryMaterial, actions: &mut Vec<Action>) {
        actions.push(Action::NewFrom(material.document.clone()));
    }
}

fn request(side: usize, key: u64, wish: &Wish) -> Request {
    let Wish { size, is_moving, .. } = *wish;
    let (document, directory) = (wish.document.clone(), wish.directory.clone());
    let (stage, light) = (wish.stage.clone(), wish.light.clone());
    Request { side, key, shot: Shot { document, directory, stage, light, size, is_moving } }
}
