//! Two pictures: side by side with a divider, or their difference as a heat map with its scale.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{self, Color32, CursorIcon, Sense};
use halfvector_graph::document::Document;
use halfvector_graph::method::Methods;
use halfvector_reference::metrics::{FlipOptions, difference, flip_ldr, magma};
use halfvector_scene::{Display, Picture, tone_map::tone_mapped};

use super::toolbar::{menu, methods_menu};
use super::{Side, Viewport};
use crate::paint::{Engine, Noise};
use crate::session::Session;
use crate::work::Worker;

/// How two pictures are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum View {
    /// Only A.
    #[default]
    Single,
    /// A left of the divider, B right of it.
    Split,
    /// How they differ.
    Difference,
}

/// What a side shows, as far as it differs from the window's settings.
#[derive(Clone, Debug, Default)]
pub(super) struct Choice {
    pub(super) engine: Engine,
    /// Methods of its own.
    pub(super) methods: Option<Methods>,
    /// A material as it was.
    pub(super) pinned: Option<Pinned>,
}

/// A material as it was at a moment.
#[derive(Clone, Debug)]
pub(super) struct Pinned {
    pub(super) document: Arc<Document>,
    pub(super) directory: PathBuf,
}

/// The comparison.
pub(super) struct Compare {
    view: View,
    choices: [Choice; 2],
    /// Share of the width left of the divider.
    divider: f32,
    is_dragged: bool,
    /// FLIP that has the brightest colour.
    scale: f64,
    worker: Option<Worker<Job, Difference>>,
    /// Of the pictures that were compared last.
    asked: Option<[u64; 2]>,
    found: Option<Difference>,
    /// The colours of the errors, for the scale that they were made with.
    texture: Option<(f64, egui::TextureHandle)>,
}

struct Job {
    pictures: [Arc<Picture>; 2],
    noise: [Option<Noise>; 2],
    display: Display,
}

impl std::fmt::Debug for Job {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Job")
    }
}

/// How two pictures differ.
struct Difference {
    size: [usize; 2],
    /// FLIP of each pixel.
    errors: Vec<f64>,
    mean: f64,
    largest: f64,
    /// Of radiance; the known noise taken off.
    rmse: f64,
    /// How much brighter A is.
    brighter: f64,
}

impl Compare {
    pub(super) fn new(context: &egui::Context) -> Compare {
        let worker = Worker::start("difference", context, |job: Job, _| Some(compared(&job)));
        Compare {
            view: View::Single,
            choices: Default::default(),
            divider: 0.5,
            is_dragged: false,
            scale: 0.2,
            worker: worker.ok(),
            asked: None,
            found: None,
            texture: None,
        }
    }

    pub(super) fn is_on(&self) -> bool {
        self.view != View::Single
    }

    pub(super) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    pub(super) fn choice(&self, side: usize) -> &Choice {
        &self.choices[side]
    }

    pub(super) fn drags_divider(&self) -> bool {
        self.is_dragged
    }

    /// Asks for the difference of two pictures of the same size, once, and takes it.
    fn poll(&mut self, sides: &[Side; 2], display: Display) {
        while let Some(found) = self.worker.as_ref().and_then(Worker::poll) {
            (self.found, self.texture) = (Some(found), None);
        }
        let [Some(a), Some(b)] = [&sides[0].shown, &sides[1].shown] else { return };
        let both = [a.serial, b.serial];
        let same_size = (a.picture.width, a.picture.height) == (b.picture.width, b.picture.height);
        if self.asked != Some(both)
            && let Some(worker) = &self.worker
        {
            self.asked = Some(both);
            let pictures = if same_size {
                [a.picture.clone(), b.picture.clone()]
            } else {
                let size = [a.picture.width.min(b.picture.width), a.picture.height.min(b.picture.height)];
                [&a.picture, &b.picture].map(|picture| resized(picture, size))
            };
            let noise = if same_size { [a.noise.clone(), b.noise.clone()] } else { [None, None] };
            worker.submit(Job { pictures, noise, display });
        }
    }
}

impl Viewport {
    /// What is compared, as the content of a menu.
    pub(super) fn compare_menu(&mut self, ui: &mut egui::Ui, session: &Session) {
        ui.set_min_width(330.0);
        let compare = &mut self.compare;
        ui.horizontal(|ui| {
            for (view, label, help) in [
                (View::Single, "Off", "One picture"),
                (View::Split, "Split", "A left of a divider, B right of it"),
                (View::Difference, "Difference", "Where and how much they differ (FLIP)"),
            ] {
                ui.selectable_value(&mut compare.view, view, label).on_hover_text(help);
            }
        });
        for (choice, name) in compare.choices.iter_mut().zip(["A", "B"]) {
            ui.separator();
            ui.push_id(name, |ui| side_menu(ui, choice, name, session, &self.stage.methods));
        }
        if ui.button("Swap A and B").clicked() {
            compare.choices.swap(0, 1);
            self.sides.swap(0, 1);
        }
    }

    /// Draws what is to be seen.
    pub(super) fn paint_sides(&mut self, ui: &egui::Ui, rect: egui::Rect) {
        let draw = |side: &Side, clip: egui::Rect| {
            if let Some(texture) = &side.texture {
                let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
                ui.painter().with_clip_rect(clip).image(texture.id(), rect, whole, Color32::WHITE);
            }
        };
        match self.compare.view {
            View::Single => draw(&self.sides[0], rect),
            View::Split => {
                let x = rect.left() + self.compare.divider * rect.width();
                draw(&self.sides[0], rect.with_max_x(x));
                draw(&self.sides[1], rect.with_min_x(x));
                self.paint_divider(ui, rect, x);
                self.captions(ui, rect);
            }
            View::Difference => {
                self.paint_difference(ui, rect);
            }
        }
        if self.compare.view != View::Single {
            self.compare.poll(&self.sides, self.stage.display());
        }
    }

    fn paint_divider(&mut self, ui: &egui::Ui, rect: egui::Rect, x: f32) {
        let area = egui::Rect::from_x_y_ranges(x - 5.0..=x + 5.0, rect.y_range());
        let response = ui.interact(area, ui.id().with("divider"), Sense::drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ResizeHandle, true, "Divider of A and B"));
        self.compare.is_dragged = response.dragged();
        if let (true, Some(pointer)) = (response.dragged(), response.interact_pointer_pos()) {
            self.compare.divider = ((pointer.x - rect.left()) / rect.width().max(1.0)).clamp(0.0, 1.0);
        }
        if response.has_focus() {
            let filter = egui::EventFilter { horizontal_arrows: true, ..egui::EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
            let steps = |key| ui.input(|input| input.num_presses(key)) as f32;
            let way = steps(egui::Key::ArrowRight) - steps(egui::Key::ArrowLeft);
            self.compare.divider = (self.compare.divider + 0.02 * way).clamp(0.0, 1.0);
        }
        let is_held = response.hovered() || response.dragged() || response.has_focus();
        let color = if is_held { crate::theme::ACCENT } else { Color32::from_gray(200) };
        let painter = ui.painter().with_clip_rect(rect);
        painter.vline(x, rect.y_range(), egui::Stroke::new(1.5, color));
        painter.circle(egui::pos2(x, rect.center().y), 6.0, color, egui::Stroke::new(1.0, Color32::from_gray(30)));
        response.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_text("Drag to show more of one side");
    }

    fn captions(&self, ui: &egui::Ui, rect: egui::Rect) {
        let places = [
            (rect.left_bottom() + egui::vec2(8.0, -6.0), egui::Align2::LEFT_BOTTOM, "A"),
            (rect.right_bottom() + egui::vec2(-8.0, -6.0), egui::Align2::RIGHT_BOTTOM, "B"),
        ];
        for ((side, choice), (place, align, name)) in self.sides.iter().zip(&self.compare.choices).zip(places) {
            let mut text = format!("{name}: {}", choice.engine.label());
            if choice.methods.is_some() {
                text += ", own methods";
            }
            if choice.pinned.is_some() {
                text += ", pinned";
            }
            if let Some(shown) = &side.shown {
                match &shown.noise {
                    Some(noise) => text += &format!(" · {}", noise.words()),
                    None => text += &format!(" · {:.0} ms", shown.milliseconds),
                }
            }
            caption(ui, place, align, text);
        }
    }

    fn paint_difference(&mut self, ui: &egui::Ui, rect: egui::Rect) {
        let compare = &mut self.compare;
        let Some(found) = &compare.found else {
            let place = rect.left_bottom() + egui::vec2(10.0, -8.0);
            caption(ui, place, egui::Align2::LEFT_BOTTOM, "Comparing …".to_owned());
            return;
        };
        let scale = compare.scale;
        if compare.texture.as_ref().is_none_or(|(made_for, _)| *made_for != scale) {
            let colors = found.errors.iter().map(|error| {
                let [r, g, b] = magma(error / scale);
                Color32::from_rgb(r, g, b)
            });
            let image = egui::ColorImage::new(found.size, colors.collect());
            let texture = ui.ctx().load_texture("difference", image, egui::TextureOptions::NEAREST);
            compare.texture = Some((scale, texture));
        }
        if let Some((_, texture)) = &compare.texture {
            let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
        }
        let bar = egui::Rect::from_min_size(rect.left_bottom() + egui::vec2(10.0, -44.0), egui::vec2(180.0, 10.0));
        let painter = ui.painter().with_clip_rect(rect);
        let steps = 60;
        for step in 0..steps {
            let [r, g, b] = magma(f64::from(step) / f64::from(steps - 1));
            let left = bar.left() + bar.width() * step as f32 / steps as f32;
            let cell = egui::Rect::from_min_size(
                egui::pos2(left, bar.top()),
                egui::vec2(bar.width() / steps as f32 + 0.5, 10.0),
            );
            painter.rect_filled(cell, 0.0, Color32::from_rgb(r, g, b));
        }
        caption(ui, bar.left_top() + egui::vec2(0.0, -3.0), egui::Align2::LEFT_BOTTOM, "0".to_owned());
        caption(ui, bar.right_top() + egui::vec2(0.0, -3.0), egui::Align2::RIGHT_BOTTOM, format!("FLIP {scale}"));
        let figures = format!(
            "FLIP mean {:.4}, largest {:.3} · rmse {:.4} · A is {:.2} % {}",
            found.mean,
            found.largest,
            found.rmse,
            100.0 * found.brighter.abs(),
            if found.brighter < 0.0 { "darker" } else { "brighter" }
        );
        caption(ui, rect.left_bottom() + egui::vec2(10.0, -8.0), egui::Align2::LEFT_BOTTOM, figures.clone());
        let response = ui.interact(bar.expand(4.0), ui.id().with("scale"), Sense::click());
        let label = format!("Scale of the difference, {figures}");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &label));
        if response.on_hover_text("The error that has the brightest colour: click for the next one").clicked() {
            const SCALES: [f64; 5] = [0.02, 0.05, 0.2, 0.5, 1.0];
            let next = SCALES.iter().position(|known| *known == scale).map_or(0, |place| place + 1);
            compare.scale = SCALES[next % SCALES.len()];
        }
    }
}

/// Engine, methods and material of a side.
fn side_menu(ui: &mut egui::Ui, choice: &mut Choice, name: &str, session: &Session, methods: &Methods) {
    ui.horizontal(|ui| {
        ui.strong(name);
        for engine in Engine::ALL {
            ui.selectable_value(&mut choice.engine, engine, engine.label()).on_hover_text(engine.help());
        }
    });
    ui.horizontal(|ui| {
        let mut has_own = choice.methods.is_some();
        if ui.checkbox(&mut has_own, "Own methods").on_hover_text("Others than the view's").changed() {
            choice.methods = has_own.then(|| methods.clone());
        }
        if let Some(own) = &mut choice.methods {
            menu(ui, "Choose", "Its methods", |ui| methods_menu(ui, own));
        }
        let mut is_pinned = choice.pinned.is_some();
        let pin = ui.checkbox(&mut is_pinned, "Pin the material").on_hover_text("Keeps it as it is now");
        if pin.changed() {
            let now = || Pinned { document: session.document().clone(), directory: session.directory() };
            choice.pinned = is_pinned.then(now);
        }
    });
}

fn caption(ui: &egui::Ui, place: egui::Pos2, align: egui::Align2, text: String) {
    let font = egui::FontId::proportional(11.0);
    let galley = ui.painter().layout_no_wrap(text, font, Color32::from_gray(235));
    let rect = align.anchor_size(place, galley.size());
    ui.painter().rect_filled(rect.expand2(egui::vec2(4.0, 1.0)), 3.0, Color32::from_black_alpha(150));
    ui.painter().galley(rect.min, galley, Color32::WHITE);
}

/// The picture at another size, each pixel the nearest one.
fn resized(picture: &Picture, [width, height]: [u32; 2]) -> Arc<Picture> {
    let mut smaller = Picture::clear(width, height);
    for y in 0..height {
        let row = u64::from(y) * u64::from(picture.height) / u64::from(height.max(1));
        for x in 0..width {
            let column = u64::from(x) * u64::from(picture.width) / u64::from(width.max(1));
            let from = row * u64::from(picture.width) + column;
            smaller.pixels[(y * width + x) as usize] = picture.pixels[from as usize];
        }
    }
    Arc::new(smaller)
}

fn compared(job: &Job) -> Difference {
    let [a, b] = &job.pictures;
    let radiance = |picture: &Picture| -> Vec<[f64; 3]> {
        picture.pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect()
    };
    let shown = |picture: &[[f64; 3]]| -> Vec<[f64; 3]> {
        let light = |c: [f64; 3]| match job.display {
            Display::ToneMapped { exposure, tone_map } => tone_mapped(tone_map, c.map(|c| c * f64::from(exposure))),
            Display::AsIs => c,
        };
        picture.iter().map(|&pixel| light(pixel)).collect()
    };
    let [of_a, of_b] = [radiance(a), radiance(b)];
    let errors = flip_ldr(&shown(&of_b), &shown(&of_a), b.width as usize, FlipOptions::default());
    // Of a single path the noise is not known: nothing is taken off then.
    let noise: Option<Vec<[f64; 3]>> =
        match job.noise.each_ref().map(|noise| noise.as_ref().map(|n| n.of_pixels.as_ref())) {
            [None, None] | [Some(None), _] | [_, Some(None)] => None,
            [Some(Some(one)), None] | [None, Some(Some(one))] => Some(one.to_vec()),
            [Some(Some(a)), Some(Some(b))] => {
                let both = a.iter().zip(b.iter());
                Some(both.map(|(a, b)| std::array::from_fn(|i| a[i].hypot(b[i]))).collect())
            }
        };
    let plain = difference(&of_a, &of_b, noise.as_deref());
    let count = errors.len().max(1) as f64;
    Difference {
        size: [b.width as usize, b.height as usize],
        mean: errors.iter().sum::<f64>() / count,
        largest: errors.iter().copied().fold(0.0, f64::max),
        rmse: plain.rmse,
        brighter: plain.mean_relative,
        errors,
    }
}
