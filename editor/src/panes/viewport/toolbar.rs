//! The row above the picture: mesh, environment, display, lights, methods, comparison.

use eframe::egui::containers::menu::{MenuButton, MenuConfig, SubMenuButton, is_in_menu};
use eframe::egui::{self, PopupCloseBehavior};
use halfvector_graph::docs::capitalised;
use halfvector_graph::method::{Methods, TERMS};
use halfvector_graph::needs::ToneMap;
use halfvector_scene::{BuiltinMesh, EnvironmentSource, MeshSource};

use super::Viewport;
use crate::panes::toggle;
use crate::session::Session;
use crate::written::{self, Kind};

/// What the file dialog is open for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Picks {
    Mesh,
    Environment,
}

/// A button or menu of the row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tool {
    Mesh,
    Environment,
    Display,
    Lights,
    Methods,
    Compare,
    Turntable,
    Frame,
}

impl Tool {
    /// In the order shown.
    const ALL: [Tool; 8] = [
        Tool::Mesh,
        Tool::Environment,
        Tool::Display,
        Tool::Lights,
        Tool::Methods,
        Tool::Compare,
        Tool::Turntable,
        Tool::Frame,
    ];
    /// In the order in which they go into the menu at the end.
    const FIRST_TO_GO: [Tool; 8] = [
        Tool::Turntable,
        Tool::Methods,
        Tool::Display,
        Tool::Compare,
        Tool::Lights,
        Tool::Environment,
        Tool::Frame,
        Tool::Mesh,
    ];
}

/// The menu at the end of a row that is too short.
const MORE: &str = "»";

const ENVIRONMENTS: [(&str, EnvironmentSource, &str); 4] = [
    ("Studio", EnvironmentSource::Studio, "Softboxes before a grey surround"),
    ("Sky", EnvironmentSource::Sky, "A clear sky with a sun"),
    ("White", EnvironmentSource::White, "Radiance 1 from everywhere"),
    ("None", EnvironmentSource::None, "Black: punctual lights alone"),
];

impl Viewport {
    /// Draws the row. Tools that have no room in it are in a menu at its end.
    pub(super) fn toolbar(&mut self, ui: &mut egui::Ui, session: &Session) {
        let font = egui::TextStyle::Button.resolve(ui.style());
        let gap = ui.spacing().item_spacing.x;
        let padding = 2.0 * ui.spacing().button_padding.x;
        let room = ui.available_width() + gap;
        let width_of = |text: String| {
            let galley = ui.painter().layout_no_wrap(text, font.clone(), egui::Color32::WHITE);
            galley.size().x.ceil() + padding + gap
        };
        let widths = Tool::ALL.map(|tool| width_of(self.title(tool)));
        let more = width_of(MORE.to_owned());
        let mut is_shown = [true; Tool::ALL.len()];
        for tool in Tool::FIRST_TO_GO {
            let taken = |is_shown: &[bool]| -> f32 {
                let shown = widths.iter().zip(is_shown).filter(|(_, is_shown)| **is_shown).map(|(width, _)| width);
                shown.sum::<f32>() + if is_shown.contains(&false) { more } else { 0.0 }
            };
            if taken(&is_shown) <= room {
                break;
            }
            is_shown[tool as usize] = false;
        }
        ui.horizontal(|ui| {
            for tool in Tool::ALL.into_iter().filter(|tool| is_shown[*tool as usize]) {
                self.tool(ui, session, tool);
            }
            if is_shown.contains(&false) {
                let response = menu(ui, MORE, "Tools that have no room here", |ui| {
                    ui.set_min_width(130.0);
                    for tool in Tool::ALL.into_iter().filter(|tool| !is_shown[*tool as usize]) {
                        self.tool(ui, session, tool);
                    }
                });
                response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, "More tools"));
            }
        });
    }

    fn title(&self, tool: Tool) -> String {
        match (tool, self.stage.lamps.len()) {
            (Tool::Lights, lights) if lights > 0 => format!("Lights ({lights})"),
            _ => format!("{tool:?}"),
        }
    }

    fn tool(&mut self, ui: &mut egui::Ui, session: &Session, tool: Tool) {
        let title = self.title(tool);
        let shown = match tool {
            Tool::Mesh => menu(ui, &title, "What wears the material", |ui| self.mesh_menu(ui)),
            Tool::Environment => menu(ui, &title, "What surrounds it", |ui| self.environment_menu(ui)),
            Tool::Display => menu(ui, &title, "Exposure and tone map", |ui| self.display_menu(ui)),
            Tool::Lights => menu(ui, &title, "Punctual lights", |ui| self.lamp_list(ui)),
            Tool::Methods => menu(ui, &title, "How each term of shading is computed", |ui| {
                methods_menu(ui, &mut self.stage.methods);
            }),
            Tool::Compare => menu(ui, &title, "Two pictures side by side, and how they differ", |ui| {
                self.compare_menu(ui, session);
            }),
            Tool::Turntable => toggle(ui, &mut self.turntable, title).on_hover_text("Turns the view by itself"),
            Tool::Frame => ui.button(title).on_hover_text("Brings everything into view (F, double click)"),
        };
        if tool == Tool::Frame && shown.clicked() {
            self.frame();
        }
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
        let kind = Kind { unit: "°", ..Kind::default() };
        let hint = "Counter-clockwise seen from above";
        slider(ui, ["Rotation", hint], &mut self.stage.environment_rotation, -180.0..=180.0, kind, 0);
        ui.checkbox(&mut self.stage.shows_environment, "Show it behind the object");
    }

    fn display_menu(&mut self, ui: &mut egui::Ui) {
        let hint = "Brighter by factors of two";
        slider(ui, ["Exposure", hint], &mut self.stage.exposure_stops, -6.0..=6.0, Kind::default(), 2);
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

/// A menu that stays open while things in it are set. In a menu it opens at the side.
pub(super) fn menu(ui: &mut egui::Ui, title: &str, help: &str, add: impl FnOnce(&mut egui::Ui)) -> egui::Response {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let response = if is_in_menu(ui) {
        SubMenuButton::new(title).config(config).ui(ui, add).0
    } else {
        MenuButton::new(title).config(config).ui(ui, add).0
    };
    response.on_hover_text(help)
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
            ui.label(term_label(term.name)).on_hover_text(term.help);
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

/// A term as people call it.
fn term_label(name: &str) -> String {
    match name {
        "dfg" => "DFG".to_owned(),
        "specular_aa" => "Specular anti-aliasing".to_owned(),
        "env_decode" => "Environment decoding".to_owned(),
        "encode" => "Encoding".to_owned(),
        "normal" => "Normal maps".to_owned(),
        "normal_decode" => "Normal decoding".to_owned(),
        "d" => "Distribution D".to_owned(),
        "v" => "Visibility V".to_owned(),
        name => capitalised(&name.replace('_', " ")),
    }
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

/// A name, a slider and its value, which can be written.
fn slider(
    ui: &mut egui::Ui,
    [name, hint]: [&str; 2],
    value: &mut f32,
    range: std::ops::RangeInclusive<f32>,
    kind: Kind<'_>,
    digits: usize,
) {
    ui.horizontal(|ui| {
        let label = ui.label(name).on_hover_text(hint).id;
        let bar = egui::Slider::new(value, range.clone()).show_value(false);
        ui.add(bar).labelled_by(label).on_hover_text(hint);
        let speed = (range.end() - range.start()) / 300.0;
        let place = |ui: &mut egui::Ui, drag: egui::DragValue<'_>| {
            ui.add(drag.range(range).max_decimals(digits).speed(speed)).labelled_by(label)
        };
        written::drag(ui, value, kind, place);
    });
}
