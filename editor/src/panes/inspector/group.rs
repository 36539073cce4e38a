//! The group that is worked on: its name, its help, and its sockets.

use eframe::egui::{self, Button, Checkbox, CollapsingHeader, ComboBox, Key, RichText, TextEdit, TextStyle};
use halfvector_graph::document::{Group, Interface};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::Default as InputDefault;
use halfvector_graph::value::{SocketType, Type};

use crate::action::{Action, Choose};
use crate::panes::inspector::input::value_from;
use crate::panes::inspector::number::{self, Style};
use crate::panes::inspector::row::{end_when_done, gives_up, named_text, row};
use crate::panes::inspector::{color, kind};
use crate::session::Session;
use crate::sockets::{Side, Socket, added};
use crate::theme;

/// The types that a socket of a group can be given.
const TYPES: [Type; 6] = [Type::F32, Type::Vec2, Type::Vec3, Type::Vec4, Type::I32, Type::Bool];

/// Draws the group.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, id: &str, group: &Group, actions: &mut Vec<Action>) {
    let interface = &group.interface;
    let set = |interface: Interface, actions: &mut Vec<Action>| {
        let edit = Edit::SetInterface { group: id.to_owned(), interface };
        actions.push(Action::drag("Describe the group", edit, format!("group {id}")));
    };
    let mut label = interface.label.clone();
    let field = TextEdit::singleline(&mut label)
        .hint_text(RichText::new(id).heading())
        .font(TextStyle::Heading)
        .desired_width(f32::INFINITY);
    let response = ui.add(field).on_hover_text("The name of the group, and of the nodes that are it");
    named_text(&response, &label, "Name of the group");
    if response.changed() {
        set(Interface { label, ..interface.clone() }, actions);
    }
    end_when_done(&response, actions);
    ui.weak(format!("Group · group/{id} · a change here is one of all its uses"));
    let mut help = interface.help.clone();
    let field =
        TextEdit::multiline(&mut help).hint_text("What it computes").desired_rows(2).desired_width(f32::INFINITY);
    let response = ui.add(field);
    named_text(&response, &help, "Help of the group");
    if response.changed() {
        set(Interface { help, ..interface.clone() }, actions);
    }
    end_when_done(&response, actions);
    if ui
        .button("Save to a file…")
        .on_hover_text("As *.group.json, with all that it needs, for other materials")
        .clicked()
    {
        actions.push(Action::Choose(Choose::SaveGroup(id.to_owned())));
    }
    ui.separator();
    for (side, title) in [(Side::Inputs, "Inputs"), (Side::Outputs, "Outputs")] {
        let names = side.names(interface);
        let header = CollapsingHeader::new(format!("{title} ({})", names.len())).id_salt(title).default_open(true);
        header.show(ui, |ui| {
            for (place, name) in names.iter().enumerate() {
                let socket = Socket { document: session.document(), group: id, side, name };
                ui.push_id(place, |ui| one(ui, interface, socket, place, names.len(), actions));
            }
            let text = format!("Add {}", side.one());
            if ui.button(&text).on_hover_text("At the end of the list").clicked() {
                actions.extend(added(session.document(), id, side).map(|edit| Action::edit(text, edit)));
            }
        });
    }
}

/// A socket: its name, its type, its place, and the default of an input.
fn one(
    ui: &mut egui::Ui,
    interface: &Interface,
    socket: Socket<'_>,
    place: usize,
    count: usize,
    actions: &mut Vec<Action>,
) {
    let what = format!("{} {}", socket.side.one(), socket.name);
    let ty = match socket.side {
        Side::Inputs => interface.inputs[place].ty,
        Side::Outputs => SocketType::Value(interface.outputs[place].ty),
    };
    ui.horizontal(|ui| {
        let (dot, _) = ui.allocate_exact_size(egui::vec2(8.0, ui.spacing().interact_size.y), egui::Sense::hover());
        ui.painter().circle_filled(dot.center(), 3.5, theme::socket_color(ty));
        name(ui, socket, &what, actions);
        kinds(ui, socket, ty, &what, actions);
        let mut button = |ui: &mut egui::Ui, text: &str, on: bool, help: &str, edit: Option<Edit>, step: String| {
            let response = ui.add_enabled(on, Button::new(text).small()).on_hover_text(help);
            let label = format!("{text} {what}");
            response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, on, &label));
            if response.clicked() {
                actions.extend(edit.map(|edit| Action::edit(step, edit)));
            }
        };
        button(ui, "Up", place > 0, "Earlier", socket.moved(false), format!("Move {what}"));
        button(ui, "Down", place + 1 < count, "Later", socket.moved(true), format!("Move {what}"));
        let help = "With the wires, values and parameters of all uses";
        button(ui, "Remove", true, help, socket.removed(), format!("Remove {what}"));
    });
    if socket.side == Side::Inputs {
        ui.indent("default", |ui| default(ui, interface, socket, place, actions));
    }
}

/// The field of the name, taken when it is left; told why not when it cannot be.
fn name(ui: &mut egui::Ui, socket: Socket<'_>, what: &str, actions: &mut Vec<Action>) {
    let id = ui.id().with("name");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| socket.name.to_owned());
    let refused = if text == socket.name { None } else { socket.renamed(&text).err() };
    let field = TextEdit::singleline(&mut text).font(TextStyle::Monospace).desired_width(96.0);
    let field = if refused.is_some() { field.text_color(theme::letters(theme::ERROR, ui.visuals())) } else { field };
    let help = refused.unwrap_or_else(|| "Its name in links and shaders; Enter takes it".to_owned());
    let response = ui.add(field).on_hover_text(help);
    named_text(&response, &text, &format!("Name of {what}"));
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    if response.lost_focus() && text != socket.name && !ui.input(|input| input.key_pressed(Key::Escape)) {
        actions.push(match socket.renamed(&text) {
            Ok(edit) => Action::edit(format!("Rename {what}"), edit),
            Err(why) => Action::Say(why),
        });
    }
}

/// The choice of the type. A picture stays one.
fn kinds(ui: &mut egui::Ui, socket: Socket<'_>, ty: SocketType, what: &str, actions: &mut Vec<Action>) {
    let SocketType::Value(now) = ty else {
        ui.weak("a picture");
        return;
    };
    let combo = ComboBox::from_id_salt("type").selected_text(kind::name(now)).width(112.0);
    let shown = combo.show_ui(ui, |ui| {
        for ty in TYPES {
            if ui.selectable_label(ty == now, kind::name(ty)).clicked() && ty != now {
                actions.extend(socket.with_type(ty).map(|edit| Action::edit(format!("Type of {what}"), edit)));
            }
        }
    });
    let label = format!("Type of {what}");
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ComboBox, true, &label));
}

/// What an input reads when nothing is connected.
fn default(ui: &mut egui::Ui, interface: &Interface, socket: Socket<'_>, place: usize, actions: &mut Vec<Action>) {
    let input = &interface.inputs[place];
    let (InputDefault::Value(value), SocketType::Value(ty)) = (&input.default, input.ty) else { return };
    let Some(mut parts) = value.components_as(ty) else { return };
    let style = Style { range: input.range, unit: &input.unit, is_whole: ty == Type::I32 };
    let hint = "What it reads when nothing is connected or set";
    let answer = row(
        ui,
        RichText::new("default"),
        hint,
        None,
        |ui, label| match (ty, parts.as_mut_slice()) {
            (Type::Bool, [part]) => {
                let mut on = *part != 0.0;
                let response = ui.add(Checkbox::without_text(&mut on)).labelled_by(label);
                *part = f32::from(u8::from(on));
                response.into()
            }
            (_, [part]) => number::number(ui, part, style, label),
            (_, parts) if input.unit == "color" => color::color(ui, parts, label).into(),
            (_, parts) => number::vector(ui, parts, style, label),
        },
        None,
    );
    if !gives_up(&answer, actions)
        && answer.response.changed()
        && let Some(edit) = value_from(ty, &parts).and_then(|value| socket.with_default(value))
    {
        let key = format!("default of {} {}", socket.group, socket.name);
        actions.push(Action::drag(format!("Default of {}", socket.name), edit, key));
    }
    end_when_done(&answer.response, actions);
}
