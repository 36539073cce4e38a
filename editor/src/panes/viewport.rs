//! The picture of the material, drawn live: orbit, pan, zoom. Drawing and baking happen on other threads; the old picture
//! stays until the new one is there.

use std::sync::Arc;

use eframe::egui::{self, Color32, PointerButton, Sense};
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake_with_progress};
use halfvector_scene::{Display, EnvironmentSource, Picture};

use crate::action::Action;
use crate::paint::{Drawn, Painter, Shot, start};
use crate::session::Session;
use crate::stage::Stage;
use crate::work::Worker;

/// The picture and what it shows the material on.
pub(crate) struct Viewport {
    stage: Stage,
    painter: Option<Painter>,
    baker: Option<Worker<EnvironmentSource, Baked>>,
    /// The environment that is being baked or was last.
    baking: Option<EnvironmentSource>,
    environment: Option<Arc<BakedEnvironment>>,
    /// What was given to the painter last.
    asked: Option<Asked>,
    texture: Option<egui::TextureHandle>,
    drawn: Option<Drawn>,
}

/// What a picture depends on.
#[derive(Clone, Debug, PartialEq)]
struct Asked {
    revision: u64,
    stage: Stage,
    size: [u32; 2],
    baked: bool,
}

/// An environment that was baked, or why it was not.
struct Baked {
    source: EnvironmentSource,
    result: Result<Option<BakedEnvironment>, String>,
}

impl Viewport {
    /// Starts the threads that draw and bake.
    pub(crate) fn new(context: &egui::Context) -> Viewport {
        let baker = Worker::start("baker", context, |source: EnvironmentSource, _| {
            let options = BakeOptions::default();
            let result = source
                .load()
                .map(|loaded| loaded.map(|loaded| bake_with_progress(&loaded, &options, &mut |_| {})))
                .map_err(|error| error.to_string());
            Some(Baked { source, result })
        });
        Viewport {
            stage: Stage::default(),
            painter: start(context).ok(),
            baker: baker.ok(),
            baking: None,
            environment: None,
            asked: None,
            texture: None,
            drawn: None,
        }
    }

    /// What the material is seen on.
    pub(crate) fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Whether no picture is being made.
    pub(crate) fn is_idle(&self) -> bool {
        self.painter.as_ref().is_none_or(|painter| !painter.is_busy())
            && self.baker.as_ref().is_none_or(|baker| !baker.is_busy())
    }

    /// Draws the picture and takes drags of the pointer.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, _actions: &mut Vec<Action>) {
        self.bake();
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        self.turn(ui, &response);
        let scale = ui.ctx().pixels_per_point();
        let size = [rect.width(), rect.height()].map(|length| ((length * scale) as u32).clamp(1, 4096));
        let asked =
            Asked { revision: session.revision(), stage: self.stage.clone(), size, baked: self.environment.is_some() };
        if self.asked.as_ref() != Some(&asked)
            && let Some(painter) = &self.painter
        {
            painter.submit(Shot {
                document: session.document().clone(),
                directory: session.directory(),
                stage: self.stage.clone(),
                environment: self.environment.clone(),
                size,
                samples_per_side: 2,
            });
            self.asked = Some(asked);
        }
        while let Some(drawn) = self.painter.as_ref().and_then(Painter::poll) {
            if let Ok(picture) = &drawn.picture {
                let image = color_image(picture, &self.stage);
                match &mut self.texture {
                    Some(texture) => texture.set(image, egui::TextureOptions::LINEAR),
                    None => {
                        self.texture = Some(ui.ctx().load_texture("viewport", image, egui::TextureOptions::LINEAR));
                    }
                }
            }
            self.drawn = Some(drawn);
        }
        ui.painter().rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
        if let Some(texture) = &self.texture {
            let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
        }
        let text = match &self.drawn {
            Some(Drawn { picture: Err(why), .. }) => why.clone(),
            Some(drawn) => format!("{} · {:.0} ms", drawn.by, drawn.took.as_secs_f64() * 1e3),
            None => String::new(),
        };
        let corner = rect.left_bottom() + egui::vec2(8.0, -6.0);
        ui.painter().text(corner, egui::Align2::LEFT_BOTTOM, text, egui::FontId::proportional(11.0), Color32::GRAY);
    }

    /// Asks for the environment's bake when it is another one, and takes what is done.
    fn bake(&mut self) {
        let Some(baker) = &self.baker else { return };
        if self.baking.as_ref() != Some(&self.stage.environment) {
            self.baking = Some(self.stage.environment.clone());
            baker.submit(self.stage.environment.clone());
        }
        while let Some(baked) = baker.poll() {
            if baked.source == self.stage.environment
                && let Ok(environment) = baked.result
            {
                self.environment = environment.map(Arc::new);
            }
        }
    }

    fn turn(&mut self, ui: &egui::Ui, response: &egui::Response) {
        let orbit = &mut self.stage.orbit;
        let drag = response.drag_delta() / response.rect.height().max(1.0);
        if response.dragged_by(PointerButton::Primary) {
            *orbit = orbit.turned(-drag.x * 4.0, drag.y * 4.0);
        } else if response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary) {
            *orbit = orbit.panned(-drag.x, drag.y);
        }
        if response.hovered() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            *orbit = orbit.zoomed((scroll * 0.004).exp() * pinch);
        }
        if response.double_clicked() {
            *orbit = Stage::default().orbit;
        }
    }
}

fn color_image(picture: &Picture, stage: &Stage) -> egui::ColorImage {
    let display = Display::ToneMapped { exposure: stage.exposure_stops.exp2(), tone_map: stage.tone_map };
    let pixels = picture.pixels.iter().map(|&pixel| {
        let [r, g, b, a] = display.codes(pixel);
        Color32::from_rgba_unmultiplied(r, g, b, a)
    });
    egui::ColorImage::new([picture.width as usize, picture.height as usize], pixels.collect())
}
