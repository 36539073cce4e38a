//! What the window has to say: the last message, which fades, and the errors of this session, which are kept.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use eframe::egui;

use crate::session::Session;
use crate::theme;

/// How long a message stays.
const STAYS: Duration = Duration::from_secs(6);
/// How long an error stays: long enough to be read twice.
const ERROR_STAYS: Duration = Duration::from_secs(20);
/// How long it takes to fade.
const FADES: Duration = Duration::from_secs(1);
/// Most errors that are kept.
const MAX_ERRORS: usize = 50;

/// The messages of a window.
#[derive(Debug, Default)]
pub(crate) struct Messages {
    last: Option<Message>,
    errors: VecDeque<String>,
}

#[derive(Debug)]
struct Message {
    text: String,
    is_error: bool,
    since: Instant,
}

impl Messages {
    /// Tells something; nothing when it is empty.
    pub(crate) fn tell(&mut self, text: String) {
        if !text.is_empty() {
            self.last = Some(Message { text, is_error: false, since: Instant::now() });
        }
    }

    /// Tells what went wrong.
    pub(crate) fn fail(&mut self, text: String) {
        self.errors.push_back(text.clone());
        if self.errors.len() > MAX_ERRORS {
            self.errors.pop_front();
        }
        self.last = Some(Message { text, is_error: true, since: Instant::now() });
    }

    /// Forgets what was told last of another material; errors stay.
    pub(crate) fn forget(&mut self) {
        self.last.take_if(|message| !message.is_error);
    }

    /// Draws the status line.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session) {
        ui.horizontal(|ui| {
            let name = session.file().and_then(|file| file.file_name()).map(|name| name.to_string_lossy().into_owned());
            let name = name.unwrap_or_else(|| "no file".to_owned());
            if session.is_unsaved() {
                ui.colored_label(theme::letters(theme::WARNING, ui.visuals()), format!("• {name}, not saved"))
                    .on_hover_text("Save with Ctrl+S");
            } else {
                ui.weak(name).on_hover_text(session.file().map(|file| file.display().to_string()).unwrap_or_default());
            }
            ui.separator();
            let count = session.graph().nodes.len();
            ui.weak(format!("{count} node{}", if count == 1 { "" } else { "s" }));
            if !self.errors.is_empty() {
                ui.separator();
                let count = self.errors.len();
                let title = format!("{count} error{}", if count == 1 { "" } else { "s" });
                ui.menu_button(egui::RichText::new(title).color(theme::letters(theme::ERROR, ui.visuals())), |ui| {
                    self.list(ui)
                })
                .response
                .on_hover_text("What went wrong in this window so far");
            }
            ui.separator();
            self.message(ui);
        });
    }

    fn list(&mut self, ui: &mut egui::Ui) {
        ui.set_min_width(360.0);
        egui::ScrollArea::vertical().max_height(240.0).show(ui, |ui| {
            for error in self.errors.iter().rev() {
                ui.add(egui::Label::new(error).wrap().selectable(true));
                ui.separator();
            }
        });
        if ui.button("Clear").clicked() {
            self.errors.clear();
            ui.close();
        }
    }

    fn message(&mut self, ui: &mut egui::Ui) {
        let Some(message) = &self.last else { return };
        let stays = if message.is_error { ERROR_STAYS } else { STAYS };
        let age = message.since.elapsed();
        let Some(left) = (stays + FADES).checked_sub(age) else {
            self.last = None;
            return;
        };
        let strength = (left.as_secs_f32() / FADES.as_secs_f32()).min(1.0);
        ui.ctx().request_repaint_after(if strength < 1.0 { Duration::from_millis(50) } else { left - FADES });
        let color =
            if message.is_error { theme::letters(theme::ERROR, ui.visuals()) } else { ui.visuals().text_color() };
        let text = egui::RichText::new(&message.text).color(color.gamma_multiply(strength));
        ui.add(egui::Label::new(text).truncate()).on_hover_text(&message.text);
    }
}
