//! The row above the picture: mesh, environment, display, lights, methods, comparison.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, PopupCloseBehavior};
use halfvector_graph::method::{Methods, TERMS};
use halfvector_graph::needs::ToneMap;
use halfvector_scene::{BuiltinMesh, EnvironmentSource, MeshSource};

use super::Viewport;
use crate::session::Session;

/// What the file dialog is open for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Picks {
    Mesh,
    Environment,
}

const ENVIRONMENTS: [(&str, EnvironmentSource, &str); 4] = [
    ("Studio", EnvironmentSource::Studio, "Softboxes before a grey surround"),
    ("Sky", EnvironmentSource::Sky, "A clear sky with a sun"),
    ("White", EnvironmentSource::White, "Radiance 1 from everywhere"),
    ("None", EnvironmentSource::None, "Black: punctual lights alone"),
];

impl Viewport {
    /// Draws the row.
    pub(super) fn toolbar(&mut self, ui: &mut egui::Ui, session: &Session) {
        ui.horizontal_wrapped(|ui| {
            menu(ui, "Mesh", "What wears the material", |ui| self.mesh_menu(ui));
            menu(ui, "Environment", "What surrounds it", |ui| self.environment_menu(ui));
            menu(ui, "Display", "Exposure and tone map", |ui| self.display_menu(ui));
            let lights = self.stage.lamps.len();
            let title = if lights == 0 { "Lights".to_owned() } else { format!("Lights ({lights})") };
            menu(ui, &title, "Punctual lights", |ui| self.lamp_list(ui));
            menu(ui, "Methods", "How each term of shading is computed", |ui| {
                methods_menu(ui, &mut self.stage.methods);
            });
            menu(ui, "Compare", "Two pictures side by side, and how they differ", |ui| self.compare_menu(ui, session));
            ui.toggle_value(&mut self.turntable, "Turntable").on_hover_text("Turns the view by itself");
            if ui.button("Frame").on_hover_text("Brings everything into view (F, double click)").clicked() {
                self.frame();
            }
        });
    }

    fn mesh_menu(&mut self, ui: &mut egui::Ui) {
        for shape in BuiltinMesh::ALL {
            let source = MeshSource::Builtin(shape);
            let name = capitalised(shape.name());
            if ui.selectable_label(self.stage.mesh == source, name).clicked() {
                self.set_mesh(source);
                ui.close();
            }
        }
        ui.separator();
        if let MeshSource::File(path) = &self.stage.mesh {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            ui.add_enabled(false, egui::Button::selectable(true, name));
        }
        if ui.button("File…").on_hover_text("A .glb or .gltf model; or drop one on the picture").clicked() {
            self.pick(Picks::Mesh);
            ui.close();
        }
    }

    fn environment_menu(&mut self, ui: &mut egui::Ui) {
        for (name, source, help) in ENVIRONMENTS {
            if ui.selectable_label(self.stage.environment == source, name).on_hover_text(help).clicked() {
                self.set_environment(source);
            }
        }
        if let EnvironmentSource::File(path) = &self.stage.environment {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            ui.add_enabled(false, egui::Button::selectable(true, name));
        }
        let help = "A .hdr, .exr, .hdre, .ktx2, .png or .jpg file; or drop one on the picture";
        if ui.button("File…").on_hover_text(help).clicked() {
            self.pick(Picks::Environment);
            ui.close();
        }
        ui.separator();
        let rotation = egui::Slider::new(&mut self.stage.environment_rotation, -180.0..=180.0).suffix("°");
        ui.add(rotation.text("Rotation").max_decimals(0)).on_hover_text("Counter-clockwise seen from above");
        ui.checkbox(&mut self.stage.shows_environment, "Show it behind the object");
    }

    fn display_menu(&mut self, ui: &mut egui::Ui) {
        let exposure = egui::Slider::new(&mut self.stage.exposure_stops, -6.0..=6.0).max_decimals(2);
        ui.add(exposure.text("Exposure")).on_hover_text("Brighter by factors of two");
        ui.label("Tone map");
        for map in ToneMap::ALL {
            ui.radio_value(&mut self.stage.tone_map, map, tone_map_label(map));
        }
    }

    fn pick(&mut self, what: Picks) {
        self.picks = what;
        let (name, extensions) = match what {
            Picks::Mesh => ("Models", vec!["glb", "gltf"]),
            Picks::Environment => ("Environments", vec!["hdr", "exr", "hdre", "ktx2", "png", "jpg", "jpeg"]),
        };
        self.dialog = egui_file_dialog::FileDialog::new()
            .id("viewport files")
            .add_file_filter_extensions(name, extensions)
            .default_file_filter(name);
        self.dialog.pick_file();
    }

    /// Takes the file that was picked.
    pub(super) fn take_picked(&mut self, ui: &egui::Ui) {
        self.dialog.update(ui.ctx());
        if let Some(path) = self.dialog.take_picked() {
            match self.picks {
                Picks::Mesh => self.set_mesh(MeshSource::File(path)),
                Picks::Environment => self.set_environment(EnvironmentSource::File(path)),
            }
        }
    }
}

/// A menu that stays open while things in it are set.
pub(super) fn menu(ui: &mut egui::Ui, title: &str, help: &str, add: impl FnOnce(&mut egui::Ui)) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, _) = MenuButton::new(title).config(config).ui(ui, add);
    response.on_hover_text(help);
}

/// The method of each term, with what it is and where it comes from.
pub(super) fn methods_menu(ui: &mut egui::Ui, methods: &mut Methods) {
    ui.horizontal(|ui| {
        ui.label("All:");
        if ui.button("Default").on_hover_text("The most exact that is fast").clicked() {
            *methods = Methods::default();
        }
        if ui.button("Report").on_hover_text("As the report has them that started the project").clicked() {
            *methods = Methods::report();
        }
    });
    ui.separator();
    egui::Grid::new("methods").num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
        for term in TERMS {
            let name = capitalised(&term.name.replace('_', " "));
            ui.label(name).on_hover_text(term.help);
            let chosen = methods.get(term.name);
            egui::ComboBox::from_id_salt(term.name)
                .selected_text(chosen.name)
                .width(150.0)
                .show_ui(ui, |ui| {
                    for method in term.methods {
                        let is_chosen = method.name == chosen.name;
                        let choice = ui.selectable_label(is_chosen, method.name).on_hover_text(method.source);
                        if choice.clicked() && methods.set(term.name, method.name).is_ok() {
                            ui.close();
                        }
                    }
                })
                .response
                .on_hover_text(chosen.source);
            ui.end_row();
        }
    });
}

/// The first letter as a capital.
pub(super) fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn tone_map_label(map: ToneMap) -> &'static str {
    match map {
        ToneMap::None => "None: cut off at white",
        ToneMap::Reinhard => "Reinhard",
        ToneMap::Aces => "ACES",
        ToneMap::Agx => "AgX",
        ToneMap::PbrNeutral => "PBR Neutral",
    }
}
