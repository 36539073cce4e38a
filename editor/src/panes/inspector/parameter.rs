//! A parameter of the material: its name in shaders, its label, its range.

use eframe::egui::{self, DragValue, TextEdit};
use halfvector_graph::document::{Parameter, is_name};
use halfvector_graph::edit::Edit;

use crate::action::Action;
use crate::panes::inspector::row::{end_when_done, gives_up, named_text};
use crate::session::Session;
use crate::theme;
use crate::written::{self, Kind};

/// Draws the fields of the parameter at a place of the document's list.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, place: usize, actions: &mut Vec<Action>) {
    let Some(parameter) = session.document().parameters.get(place) else { return };
    let key = format!("parameter {place}");
    let mut set = |parameter: Parameter, actions: &mut Vec<Action>| {
        let edit = Edit::SetParameter { place, parameter };
        actions.push(Action::drag("Change a parameter", edit, key.clone()));
    };
    ui.horizontal(|ui| {
        name(ui, session, parameter, &mut set, actions);
        let mut label = parameter.label.clone().unwrap_or_default();
        let field = TextEdit::singleline(&mut label).hint_text("label").desired_width(ui.available_width() - 8.0);
        let response = ui.add(field).on_hover_text("For people; the name when empty");
        named_text(&response, &label, "label of the parameter");
        if response.changed() {
            let label = Some(label).filter(|label| !label.is_empty());
            set(Parameter { label, ..parameter.clone() }, actions);
        }
        end_when_done(&response, actions);
    });
    ui.horizontal(|ui| {
        let mut has_range = parameter.range.is_some();
        if ui.checkbox(&mut has_range, "range").on_hover_text("Other than the input's own").changed() {
            let range = has_range.then_some([0.0, 1.0]);
            set(Parameter { range, ..parameter.clone() }, actions);
            actions.push(Action::EndMerge);
        }
        if let Some([mut low, mut high]) = parameter.range {
            let bound = |ui: &mut egui::Ui, bound: &mut f32, hint: &str| {
                let place = |ui: &mut egui::Ui, drag: DragValue<'_>| ui.add(drag.speed(0.01)).on_hover_text(hint);
                written::drag(ui, bound, Kind::default(), place)
            };
            let first = bound(ui, &mut low, "From");
            ui.label("to");
            let second = bound(ui, &mut high, "To");
            let both = first | second;
            if !gives_up(&both, actions) && both.response.changed() {
                set(Parameter { range: Some([low, high]), ..parameter.clone() }, actions);
            }
            end_when_done(&both.response, actions);
        }
        if ui.small_button("Stop exposing").clicked() {
            actions.push(Action::edit("Stop exposing", Edit::RemoveParameter { place }));
        }
    });
}

/// The field of the name. What is written is kept until it is a free name, and told why it is not yet.
fn name(
    ui: &mut egui::Ui,
    session: &Session,
    parameter: &Parameter,
    set: &mut impl FnMut(Parameter, &mut Vec<Action>),
    actions: &mut Vec<Action>,
) {
    let id = ui.id().with("name");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| parameter.name.clone());
    let taken = text != parameter.name && session.document().parameter(&text).is_some();
    let fits = is_name(&text) && !taken;
    let field = TextEdit::singleline(&mut text)
        .desired_width((ui.available_width() * 0.45 - 8.0).max(80.0))
        .font(egui::TextStyle::Monospace);
    let field = if fits { field } else { field.text_color(theme::letters(theme::ERROR, ui.visuals())) };
    let response = ui.add(field).on_hover_text(match (fits, taken) {
        (true, _) => "Name in shaders and on the command line",
        (_, true) => "Another parameter has this name",
        _ => "Letters, digits and _, first a letter",
    });
    named_text(&response, &text, "name of the parameter");
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    let fits = is_name(&text) && session.document().parameter(&text).is_none();
    if response.lost_focus()
        && text != parameter.name
        && !fits
        && !ui.input(|input| input.key_pressed(egui::Key::Escape))
    {
        let why = match is_name(&text) {
            true => "is another parameter's name",
            false => "is no name: it needs letters, digits and _, first a letter",
        };
        written::tell(ui.ctx(), response.rect, format!("“{text}” {why}; it stays {}.", parameter.name));
    }
    if response.changed() && fits {
        set(Parameter { name: text, ..parameter.clone() }, actions);
    }
    end_when_done(&response, actions);
}
