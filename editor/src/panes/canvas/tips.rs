//! What the pointer rests on, in words.

use eframe::egui::{Response, RichText, Ui};
use halfvector_graph::value::SocketType;

use super::hit::Hit;
use super::sheet::{Sheet, Side};
use super::view::Lens;
use crate::theme;

/// Shows the help of what lies under the pointer.
pub(super) fn show(response: &Response, sheet: &Sheet, lens: Lens, hovered: Hit) {
    let Some(at) = response.hover_pos() else { return };
    match hovered {
        Hit::Socket(card, row) | Hit::Field(card, row) => {
            let row = &sheet.cards[card].rows[row];
            response.clone().on_hover_ui_at_pointer(|ui| {
                ui.horizontal(|ui| {
                    ui.strong(&row.label);
                    ui.colored_label(theme::socket_color(row.ty), type_name(row.ty));
                });
                words(ui, &row.help);
                match (hovered, row.side) {
                    (Hit::Field(..), _) => weak(ui, "Drag to change, click to write."),
                    (_, Side::Output) => weak(ui, "Drag a wire from here."),
                    _ if row.is_wired => weak(ui, "Drag to take the wire elsewhere."),
                    _ => weak(ui, "Drag a wire to what feeds it."),
                }
            });
        }
        Hit::Card(card) => {
            let card = &sheet.cards[card];
            let point = lens.to_canvas(at);
            if !card.problems.is_empty() && card.mark().distance(point) < 9.0 {
                response.clone().on_hover_ui_at_pointer(|ui| {
                    card.problems.iter().for_each(|(_, text)| words(ui, text));
                });
            } else if point.y < card.rect().top() + super::sheet::HEADER {
                response.clone().on_hover_ui_at_pointer(|ui| {
                    ui.strong(&card.title);
                    words(ui, card.help.split("\n\n").next().unwrap_or_default());
                    weak(ui, &card.definition);
                });
            }
        }
        Hit::Fold(_) => {
            response.clone().on_hover_text_at_pointer("Shows or hides the inputs that are not used.");
        }
        Hit::Toggle(_) => {
            response.clone().on_hover_text_at_pointer("Shows a picture of what the node gives.");
        }
        Hit::Empty | Hit::Wire(_) | Hit::Note(..) => {}
    }
}

/// A type as people say it.
fn type_name(ty: SocketType) -> &'static str {
    match ty {
        SocketType::Value(ty) => ty.wgsl(),
        SocketType::Generic => "any",
        SocketType::Texture => "picture",
        SocketType::Surface => "surface",
    }
}

fn words(ui: &mut Ui, text: &str) {
    if !text.is_empty() {
        ui.set_max_width(320.0);
        ui.label(text);
    }
}

fn weak(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).weak().small());
}
