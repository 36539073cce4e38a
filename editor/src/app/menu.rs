//! The menu: all that the window does, with its keys.

use std::path::Path;

use eframe::egui;

use crate::action::{Action, Choose};
use crate::app::keys::{self, Command};
use crate::app::questions::Question;
use crate::app::{Editor, Pane, layout};
use crate::panes::canvas::Verb;
use crate::panes::functions;

/// Sizes of everything that the menu offers.
const SCALES: [f32; 7] = [0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0];

impl Editor {
    /// Draws the menu.
    pub(crate) fn menu(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        egui::MenuBar::new().ui(ui, |ui| {
            let file = ui.menu_button("File", |ui| self.file_menu(ui, actions)).response;
            if std::mem::take(&mut self.wants_menu) {
                file.request_focus();
            }
            ui.menu_button("Edit", |ui| self.edit_menu(ui, actions));
            ui.menu_button("View", |ui| self.view_menu(ui));
            ui.menu_button("Help", |ui| {
                if entry(ui, "Keys", Command::Help).clicked() {
                    self.files.question = Some(Question::Keys);
                }
                if ui.button("About Halfvector").clicked() {
                    self.files.question = Some(Question::About);
                }
            });
        });
    }

    fn file_menu(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        ui.set_min_width(200.0);
        if entry(ui, "New", Command::New).clicked() {
            actions.push(Action::New);
        }
        if ui.button("New from the library…").on_hover_text("Materials and templates to begin with").clicked() {
            layout::show(&mut self.tree, Pane::Library);
        }
        if entry(ui, "Open…", Command::Open).clicked() {
            actions.push(Action::Choose(Choose::Open));
        }
        ui.add_enabled_ui(!self.files.settings.recent.is_empty(), |ui| {
            ui.menu_button("Open recent", |ui| {
                for path in &self.files.settings.recent {
                    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
                    if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                        actions.push(Action::Open(path.clone()));
                    }
                }
                ui.separator();
                if ui.button("Clear this list").clicked() {
                    self.files.settings.recent.clear();
                }
            });
        });
        if !self.files.lost.is_empty()
            && ui.button("Recover unsaved work…").on_hover_text("What windows that ended have left").clicked()
        {
            self.files.question = Some(Question::Lost);
        }
        ui.separator();
        if entry(ui, "Save", Command::Save).clicked() {
            actions.push(Action::Save);
        }
        if entry(ui, "Save as…", Command::SaveAs).clicked() {
            actions.push(Action::Choose(Choose::SaveAs));
        }
        if ui.button("Export the shader…").on_hover_text("All files of the target that the code pane shows").clicked()
        {
            actions.push(Action::Choose(Choose::ExportFolder));
        }
        let help = "A node of a *.group.json file, with all that the group needs";
        if ui.button("Add a group…").on_hover_text(help).clicked() {
            actions.push(Action::Choose(Choose::Group));
        }
        ui.separator();
        if entry(ui, "Close", Command::Close).clicked() {
            self.ask(super::files::Next::Close);
        }
    }

    fn edit_menu(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        ui.set_min_width(200.0);
        let [undo, redo] = self.session.steps();
        let entries = [("Undo", undo, Command::Undo, Action::Undo), ("Redo", redo, Command::Redo, Action::Redo)];
        for (verb, step, command, action) in entries {
            let text = step.map_or_else(|| verb.to_owned(), |step| format!("{verb} {step}"));
            let button = egui::Button::new(text).shortcut_text(keys::text(ui.ctx(), command));
            if ui.add_enabled(step.is_some(), button).clicked() {
                actions.push(action);
            }
        }
        ui.separator();
        let has_selected = !self.session.selection().is_empty();
        let has_chosen = has_selected || self.panes.canvas.has_picked();
        for (verb, name, key) in Verb::ALL {
            let button = egui::Button::new(name).shortcut_text(key);
            let is_for_it = match verb {
                Verb::Paste | Verb::Frame | Verb::Comment => true,
                Verb::Connect | Verb::DeleteAndHeal => has_selected,
                _ => has_chosen,
            };
            if ui.add_enabled(is_for_it, button).clicked() {
                layout::show(&mut self.tree, Pane::Canvas);
                self.panes.canvas.ask(verb);
            }
        }
        ui.separator();
        if ui.button("Select all").clicked() {
            layout::show(&mut self.tree, Pane::Canvas);
            self.panes.canvas.ask(Verb::SelectAll);
        }
        if ui.add_enabled(has_chosen, egui::Button::new("Select nothing")).clicked() {
            self.panes.canvas.pick_nothing();
            actions.push(Action::Select(Vec::new()));
        }
        ui.separator();
        if ui.button("New function").on_hover_text("A node of your own, in WGSL").clicked() {
            actions.extend(functions::added(&self.session));
        }
    }

    fn view_menu(&mut self, ui: &mut egui::Ui) {
        ui.set_min_width(180.0);
        for pane in Pane::ALL {
            let mut on = layout::is_on(&self.tree, pane);
            if ui.checkbox(&mut on, pane.title()).changed() {
                layout::set_on(&mut self.tree, pane, on);
            }
        }
        if ui.button("Reset layout").on_hover_text("All parts where they were at first").clicked() {
            self.tree = layout::start();
        }
        ui.separator();
        let mut on_cpu = self.panes.viewport.draws_on_cpu();
        let help = "Gives the graphics card back to other programs; slower, the same pictures";
        if ui.checkbox(&mut on_cpu, "Draw on the CPU").on_hover_text(help).changed() {
            self.panes.viewport.draw_on_cpu(on_cpu);
        }
        ui.menu_button("Theme", |ui| {
            let themes = [
                ("As the system", egui::ThemePreference::System),
                ("Dark", egui::ThemePreference::Dark),
                ("Light", egui::ThemePreference::Light),
            ];
            for (text, theme) in themes {
                if ui.radio_value(&mut self.files.settings.theme, theme, text).clicked() {
                    ui.ctx().set_theme(theme);
                }
            }
        });
        ui.menu_button("Size", |ui| {
            let mut scale = ui.ctx().zoom_factor();
            for choice in SCALES {
                if ui.radio_value(&mut scale, choice, format!("{:.0} %", choice * 100.0)).clicked() {
                    ui.ctx().set_zoom_factor(choice);
                }
            }
        });
    }

    /// What a command of a key does.
    pub(crate) fn command(&mut self, command: Command, actions: &mut Vec<Action>) {
        match command {
            Command::New => actions.push(Action::New),
            Command::Open => actions.push(Action::Choose(Choose::Open)),
            Command::Save => actions.push(Action::Save),
            Command::SaveAs => actions.push(Action::Choose(Choose::SaveAs)),
            Command::Close => self.ask(super::files::Next::Close),
            Command::Undo => actions.push(Action::Undo),
            Command::Redo => actions.push(Action::Redo),
            Command::Help => self.files.question = Some(Question::Keys),
            Command::Pane(pane) => {
                layout::show(&mut self.tree, pane);
                self.panes.focus = Some(pane);
            }
            Command::Menu => self.wants_menu = true,
        }
    }

    /// Writes the shader that the code pane shows into a folder.
    pub(crate) fn export_to(&mut self, folder: std::path::PathBuf) {
        let name = self.session.file().and_then(Path::file_name).and_then(|name| name.to_str());
        let name = name.map_or("material", |name| name.split('.').next().unwrap_or(name)).to_owned();
        match self.panes.code.files(&name) {
            Ok(files) => self.files.order(crate::files::clerk::Order::Export { folder, files }),
            Err(why) => self.messages.fail(why),
        }
    }
}

fn entry(ui: &mut egui::Ui, text: &str, command: Command) -> egui::Response {
    let keys = keys::text(ui.ctx(), command);
    ui.add(egui::Button::new(text).shortcut_text(keys))
}
