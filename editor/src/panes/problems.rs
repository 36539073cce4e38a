//! All problems of the document; a click shows the node. The checking is `graph::check`.

use eframe::egui;
use halfvector_graph::check::Severity;

use crate::action::Action;
use crate::session::Session;
use crate::theme;

/// The list of problems.
#[derive(Debug, Default)]
pub(crate) struct Problems;

impl Problems {
    /// Draws the list.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            if session.problems().is_empty() {
                ui.colored_label(theme::GOOD, "No problems");
                return;
            }
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                for problem in session.problems() {
                    let (mark, color) = match problem.severity {
                        Severity::Error => ("●", theme::ERROR),
                        Severity::Warning => ("▲", theme::WARNING),
                    };
                    ui.horizontal_wrapped(|ui| {
                        ui.colored_label(color, mark);
                        if let Some(node) = &problem.node {
                            let label = problem.node_label.as_deref().unwrap_or(node);
                            if ui.link(label).on_hover_text("Show the node").clicked() {
                                actions.push(Action::Show(node.clone()));
                            }
                        }
                        if let Some(socket) = &problem.socket {
                            ui.weak(socket);
                        }
                        ui.label(&problem.message);
                    });
                }
            });
        });
    }
}
