//! An image slot: the picture, its file, and how it is read.

use std::path::PathBuf;

use eframe::egui::{self, ComboBox, RichText, Sense};
use halfvector_graph::document::SocketRef;
use halfvector_graph::edit::Edit;
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

use crate::action::{Action, Choose};
use crate::dropped::{Kind, no_picture, take};
use crate::panes::inspector::channel;
use crate::panes::inspector::input::{self, Slot};
use crate::panes::inspector::row::{in_words, row};
use crate::panes::inspector::thumbnail::{Thumbnail, Thumbnails};
use crate::pictures;
use crate::session::Session;
use crate::theme;
use crate::written;

/// Side of the thumbnail.
const SIDE: f32 = 64.0;

/// Draws the slot.
pub(crate) fn show(
    ui: &mut egui::Ui,
    session: &Session,
    slot: &Slot<'_>,
    thumbnails: &mut Thumbnails,
    actions: &mut Vec<Action>,
) {
    let socket = SocketRef::new(slot.node, &slot.input.name);
    let image = match session.value(&socket) {
        Some(Value::Image(image)) => Some(image),
        _ => None,
    };
    let top = ui.cursor().top();
    let mut chosen = Vec::new();
    let mut menu = |ui: &mut egui::Ui| input::menu(ui, session, slot, &socket, None, &mut chosen);
    let name = RichText::new(in_words(&slot.input.name));
    let dot = Some(theme::socket_color(slot.ty));
    row(
        ui,
        name,
        &slot.input.help,
        dot,
        |ui, label| {
            let text = image.map_or("Choose a picture…", |image| image.file.as_str());
            let width = ui.available_width();
            let button = egui::Button::new(text).truncate().min_size(egui::vec2(width, 0.0));
            let response = ui.add(button).labelled_by(label);
            if response.on_hover_text("Choose another file").clicked() {
                actions.push(Action::Choose(Choose::Image(socket.clone())));
            }
        },
        Some(&mut menu),
    );
    actions.extend(chosen);
    if let Some(image) = image {
        ui.indent("image", |ui| {
            ui.horizontal(|ui| {
                let path = session.directory().join(&image.file);
                picture(ui, path, thumbnails);
                ui.vertical(|ui| {
                    reading(ui, &socket, image, actions);
                    if let Some(def) = session.node(slot.node).and_then(|node| session.library().get(&node.node)) {
                        channel::channel(ui, session, slot.node, def, actions);
                    }
                    channel::sign(ui, session, slot.node, actions);
                });
            });
        });
    }
    let place = egui::Rect::from_x_y_ranges(ui.max_rect().x_range(), top..=ui.cursor().top());
    if ui.rect_contains_pointer(place) {
        if let Some(path) = take(ui.ctx(), |kind| kind == Kind::Picture).first() {
            actions.push(pictures::chosen(session, &socket, path));
        } else if let Some(path) = take(ui.ctx(), |kind| kind == Kind::Radiance).first() {
            written::tell(ui.ctx(), place, no_picture(path));
        }
    }
}

fn picture(ui: &mut egui::Ui, path: PathBuf, thumbnails: &mut Thumbnails) {
    let (rect, response) = ui.allocate_exact_size(egui::vec2(SIDE, SIDE), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "Thumbnail"));
    ui.painter().rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    // An image of a glTF file has no file of its own.
    if path.to_string_lossy().contains('#') {
        ui.painter().text(
            rect.center(),
            egui::Align2::CENTER_CENTER,
            "glTF",
            egui::FontId::default(),
            ui.visuals().weak_text_color(),
        );
        return;
    }
    let hint = match thumbnails.get(&path) {
        Thumbnail::Waiting => "Being read".to_owned(),
        Thumbnail::Failed(why) => {
            ui.painter().text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                "?",
                egui::FontId::proportional(24.0),
                theme::ERROR,
            );
            why.clone()
        }
        Thumbnail::Ready(texture, what) => {
            let size = texture.size_vec2();
            let scale = SIDE / size.max_elem().max(1.0);
            let inner = egui::Rect::from_center_size(rect.center(), size * scale);
            let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture.id(), inner, whole, egui::Color32::WHITE);
            what.clone()
        }
    };
    if response.on_hover_text(format!("{hint}\n{}\nClick to read it again", path.display())).clicked() {
        thumbnails.forget(&path);
    }
}

/// How the picture is read.
fn reading(ui: &mut egui::Ui, socket: &SocketRef, image: &ImageRef, actions: &mut Vec<Action>) {
    let mut now = image.clone();
    let spaces = [(ColorSpace::Srgb, "sRGB colours"), (ColorSpace::Linear, "plain numbers")];
    let hint = "Colours are decoded from sRGB; data such as normals and roughness are not";
    setting(ui, "coded as", hint, |ui, label| choice(ui, label, "coded as", &mut now.color_space, &spaces));
    let wraps = [(Wrap::Repeat, "repeat"), (Wrap::Clamp, "clamp"), (Wrap::Mirror, "mirror")];
    let hint = "What lies left and right of it";
    setting(ui, "u", hint, |ui, label| choice(ui, label, "u", &mut now.wrap_u, &wraps));
    let hint = "What lies above and below it";
    setting(ui, "v", hint, |ui, label| choice(ui, label, "v", &mut now.wrap_v, &wraps));
    let filters = [(Filter::Linear, "smooth"), (Filter::Nearest, "nearest")];
    let hint = "How it is read between its texels";
    setting(ui, "filter", hint, |ui, label| choice(ui, label, "filter", &mut now.filter, &filters));
    if now != *image {
        let edit = Edit::SetValue { socket: socket.clone(), value: Some(Value::Image(now)) };
        actions.push(Action::edit("Read the picture otherwise", edit));
    }
}

/// A row of how a picture is used.
pub(super) fn setting(ui: &mut egui::Ui, name: &str, hint: &str, add: impl FnOnce(&mut egui::Ui, egui::Id)) {
    row(ui, RichText::new(name), hint, None, add, None);
}

fn choice<T: PartialEq + Copy>(ui: &mut egui::Ui, label: egui::Id, name: &str, value: &mut T, all: &[(T, &str)]) {
    let text = all.iter().find(|(one, _)| one == value).map_or("", |(_, text)| text);
    let width = ui.available_width() - 8.0;
    let combo = ComboBox::from_id_salt(name).width(width).selected_text(text).show_ui(ui, |ui| {
        for (one, text) in all {
            ui.selectable_value(value, *one, *text);
        }
    });
    combo.response.labelled_by(label);
}
