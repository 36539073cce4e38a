//! The material's own WGSL: functions that are nodes, written here. What is written stands in the document at once; while it is
//! wrong the place is marked, and pictures and shaders stay as they were.

use std::sync::Arc;

use eframe::egui::text::{CCursor, LayoutJob};
use eframe::egui::{
    self, Button, ComboBox, FontId, Galley, Key, Pos2, Rect, RichText, Stroke, TextEdit, TextFormat, TextStyle,
};
use halfvector_graph::document::{Document, Node, NodeId, function_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::custom::{CodeError, MAX_BYTES, read_function};

use crate::action::Action;
use crate::functions;
use crate::panes::code::highlight::{Language, highlight};
use crate::panes::inspector::named_text;
use crate::session::Session;
use crate::theme;

/// The pane.
#[derive(Debug, Default)]
pub(crate) struct Functions {
    /// The function that is shown.
    chosen: Option<String>,
    /// The session that it belongs to.
    session: u64,
    /// Its name while it is being changed.
    name: Option<String>,
    /// Why it could not be renamed.
    refused: Option<String>,
    /// The selected node when it was followed last.
    followed: Option<NodeId>,
    /// Whether the text is to be written in when it is drawn next.
    focuses: bool,
}

impl Functions {
    /// Shows a function when the pane is drawn next, with the cursor in its text.
    pub(crate) fn choose(&mut self, id: String) {
        (self.name, self.refused, self.focuses) = (None, None, true);
        self.chosen = Some(id);
    }

    /// How many functions are wrong.
    pub(crate) fn wrong(session: &Session) -> usize {
        session.document().functions.iter().filter(|(id, text)| read_function(id, text).is_err()).count()
    }

    /// Draws the function that is chosen.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        self.follow(session);
        let document = session.document();
        let Some(id) = self.chosen.clone() else {
            empty(ui, session, actions);
            return;
        };
        let Some(text) = document.functions.get(&id) else { return };
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
            self.bar(ui, session, &id, actions);
        });
        let wrong = read_function(&id, text).err();
        let height = if wrong.is_some() { 26.0 } else { 0.0 };
        let whole = ui.available_rect_before_wrap();
        let (above, below) = whole.split_top_bottom_at_y((whole.bottom() - height).max(whole.top()));
        ui.scope_builder(egui::UiBuilder::new().max_rect(above), |ui| {
            self.text(ui, session, &id, text, wrong.as_ref(), actions);
        });
        if let Some(wrong) = &wrong {
            ui.painter().rect_filled(below, 0.0, theme::ERROR.gamma_multiply(0.16));
            let builder = egui::UiBuilder::new().max_rect(below.shrink2(egui::vec2(10.0, 3.0)));
            ui.scope_builder(builder, |ui| {
                let said = format!("Line {}, column {}: {}", wrong.line, wrong.column, wrong.message);
                let text = RichText::new(&said).color(ui.visuals().strong_text_color());
                ui.add(egui::Label::new(text).truncate()).on_hover_text(said);
            });
        }
        ui.advance_cursor_after_rect(whole);
    }

    /// Keeps to what is there, and goes along with the node that is selected.
    fn follow(&mut self, session: &Session) {
        if self.session != session.number() {
            *self = Functions { session: session.number(), ..Functions::default() };
        }
        let mut selection = session.selection().iter();
        let only = selection.next().filter(|_| selection.next().is_none());
        if self.followed.as_ref() != only {
            self.followed = only.cloned();
            let node = only.and_then(|id| session.node(id));
            if let Some(id) = node.and_then(|node| function_of(&node.node))
                && self.chosen.as_deref() != Some(id)
            {
                (self.name, self.refused) = (None, None);
                self.chosen = Some(id.to_owned());
            }
        }
        let there = &session.document().functions;
        if self.chosen.as_ref().is_none_or(|id| !there.contains_key(id)) {
            (self.name, self.refused) = (None, None);
            self.chosen = there.keys().next().cloned();
        }
    }

    /// Which function, its name, and what can be done with it.
    fn bar(&mut self, ui: &mut egui::Ui, session: &Session, id: &str, actions: &mut Vec<Action>) {
        let document = session.document();
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("Function").id;
            let combo = ComboBox::from_id_salt("functions").selected_text(id).width(120.0);
            let mut other = None;
            let shown = combo.show_ui(ui, |ui| {
                for (one, text) in &document.functions {
                    let mark = if read_function(one, text).is_err() { "  ⚠" } else { "" };
                    if ui.selectable_label(one == id, format!("{one}{mark}")).clicked() {
                        other = Some(one.clone());
                    }
                }
            });
            shown.response.labelled_by(label);
            if let Some(other) = other {
                self.choose(other);
            }
            if ui.button("New").on_hover_text("A function of its own, and a node that is it").clicked() {
                actions.extend(added(session));
            }
            let removed = functions::removed(document, id);
            let button = ui.add_enabled(removed.is_ok(), Button::new("Remove"));
            match removed {
                Ok(edit) if button.clicked() => actions.push(Action::edit(format!("Remove function {id}"), edit)),
                Ok(_) => {}
                Err(why) => {
                    button.on_disabled_hover_text(why);
                }
            }
            ui.separator();
            self.rename(ui, document, id, actions);
            ui.separator();
            let text = match functions::uses(document, id) {
                0 => "no node yet: add one from the palette".to_owned(),
                1 => "1 node".to_owned(),
                count => format!("{count} nodes"),
            };
            ui.weak(text);
        });
        if let Some(why) = &self.refused {
            ui.colored_label(theme::letters(theme::ERROR, ui.visuals()), why);
        }
    }

    /// The field of the function's name: taken when it is left.
    fn rename(&mut self, ui: &mut egui::Ui, document: &Document, id: &str, actions: &mut Vec<Action>) {
        let mut name = self.name.clone().unwrap_or_else(|| id.to_owned());
        ui.label("Name");
        let field = TextEdit::singleline(&mut name).desired_width(120.0).font(TextStyle::Monospace);
        let response = ui.add(field).on_hover_text("Its id in files and shaders; Enter takes it");
        named_text(&response, &name, "Name of the function");
        if response.changed() {
            (self.name, self.refused) = (Some(name.clone()), None);
        }
        if response.lost_focus() {
            self.name = None;
            let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
            if is_given_up || name == id {
                return;
            }
            match functions::renamed(document, id, &name) {
                Ok(edit) => {
                    actions.push(Action::edit(format!("Rename function {id}"), edit));
                    (self.chosen, self.refused) = (Some(name), None);
                }
                Err(why) => self.refused = Some(why),
            }
        }
    }

    /// The text with its colours, the numbers of its lines, and the mark of what is wrong.
    fn text(
        &mut self,
        ui: &mut egui::Ui,
        session: &Session,
        id: &str,
        before: &str,
        wrong: Option<&CodeError>,
        actions: &mut Vec<Action>,
    ) {
        let font = TextStyle::Monospace.resolve(ui.style());
        let glyph = ui.fonts_mut(|fonts| fonts.glyph_width(&font, '0'));
        let count = before.split('\n').count();
        let gutter = glyph * (count.to_string().len().max(3) as f32 + 2.0);
        egui::ScrollArea::both().id_salt(("function", id)).auto_shrink(false).show(ui, |ui| {
            // Behind the text, and known only after it.
            let behind = ui.painter().add(egui::Shape::Noop);
            let mut text = before.to_owned();
            let mut layouter = |ui: &egui::Ui, text: &dyn egui::TextBuffer, _: f32| colored(ui, text.as_str(), &font);
            let margin = egui::Margin { left: (gutter + 10.0) as i8, right: 12, top: 6, bottom: 6 };
            let edit = TextEdit::multiline(&mut text)
                .id_salt(("function text", session.number(), id))
                .code_editor()
                .frame(egui::Frame::NONE.inner_margin(margin))
                .char_limit(MAX_BYTES)
                .desired_width(ui.available_width())
                .min_size(ui.available_size())
                .layouter(&mut layouter);
            let output = edit.show(ui);
            let response = &output.response.response;
            named_text(response, &text, &format!("WGSL of {id}"));
            let is_opened = std::mem::take(&mut self.focuses);
            if is_opened {
                response.request_focus();
            }
            numbers(ui, &output.galley, output.galley_pos, &font);
            if let Some(wrong) = wrong {
                let row = mark(ui, behind, &output.galley, output.galley_pos, response.rect, &text, wrong);
                if is_opened {
                    ui.scroll_to_rect(row.expand(20.0), None);
                }
            }
            if response.changed() && text != before {
                let is_other_line = text.matches('\n').count() != before.matches('\n').count();
                let edit = Edit::SetFunction { id: id.to_owned(), text: Some(text) };
                actions.push(Action::drag(format!("Write {id}"), edit, format!("function {id}")));
                if is_other_line {
                    // Undo goes line by line.
                    actions.push(Action::EndMerge);
                }
            }
            if response.lost_focus() {
                actions.push(Action::EndMerge);
            }
        });
    }
}

/// A new function with a node of it, in one step, and its text to write.
pub(crate) fn added(session: &Session) -> [Action; 3] {
    let (id, function) = functions::new(session.document());
    let node = session.graph().free_id(&id);
    let add = Edit::AddNode { id: node.clone(), node: Node::new(&format!("custom/{id}")) };
    let edit = Edit::Many(vec![function, session.here(add)]);
    [Action::edit("New function", edit), Action::Select(vec![node]), Action::EditFunction(id)]
}

/// What is said when the material has no functions.
fn empty(ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
    ui.vertical_centered(|ui| {
        ui.add_space((ui.available_height() * 0.5 - 50.0).max(8.0));
        ui.label(RichText::new("Nodes of your own, in WGSL").strong());
        ui.weak("A function's arguments become the inputs of a node, what it returns its outputs.");
        ui.add_space(6.0);
        if ui.button("New function").clicked() {
            actions.extend(added(session));
        }
    });
}

/// A text with its colours, unwrapped.
fn colored(ui: &egui::Ui, text: &str, font: &FontId) -> Arc<Galley> {
    let visuals = ui.visuals();
    let (plain, colors) = (visuals.text_color(), theme::code_colors(visuals.dark_mode));
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    let mut at = 0;
    for span in highlight(text, Language::Wgsl) {
        job.append(&text[at..span.bytes.start], 0.0, TextFormat::simple(font.clone(), plain));
        let color = colors[span.kind as usize];
        job.append(&text[span.bytes.clone()], 0.0, TextFormat::simple(font.clone(), color));
        at = span.bytes.end;
    }
    job.append(&text[at..], 0.0, TextFormat::simple(font.clone(), plain));
    ui.fonts_mut(|fonts| fonts.layout_job(job))
}

/// The numbers of the lines that are seen.
fn numbers(ui: &egui::Ui, galley: &Galley, at: Pos2, font: &FontId) {
    let color = ui.visuals().weak_text_color().gamma_multiply(0.7);
    let right = at.x - 12.0;
    let seen = ui.clip_rect();
    for (row, place) in galley.rows.iter().enumerate() {
        let y = at.y + place.pos.y + place.size.y / 2.0;
        if seen.y_range().expand(20.0).contains(y) {
            ui.painter().text(Pos2::new(right, y), egui::Align2::RIGHT_CENTER, row + 1, font.clone(), color);
        }
    }
    let line = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().vline(at.x - 6.0, seen.y_range(), Stroke::new(1.0, line.color.gamma_multiply(0.6)));
}

/// Marks the line that is wrong, the place in it, and says behind it what is wrong. Returns where the line is.
fn mark(
    ui: &egui::Ui,
    behind: egui::layers::ShapeIdx,
    galley: &Galley,
    at: Pos2,
    whole: Rect,
    text: &str,
    wrong: &CodeError,
) -> Rect {
    let before: usize = text.split_inclusive('\n').take(wrong.line - 1).map(|line| line.chars().count()).sum();
    let line = text.split('\n').nth(wrong.line - 1).unwrap_or_default();
    let length = line.chars().count();
    let place = |column: usize| galley.pos_from_cursor(CCursor::new(before + column.min(length)));
    let (start, end) = (place(wrong.column - 1), place(length));
    let row = Rect::from_x_y_ranges(
        whole.x_range(),
        egui::Rangef::new(at.y + start.top() - 1.0, at.y + start.bottom() + 1.0),
    );
    ui.painter().set(behind, egui::Shape::rect_filled(row, 0.0, theme::ERROR.gamma_multiply(0.14)));
    // A caret below the place, as wide as the word that stands there.
    let word = line.chars().skip(wrong.column - 1).take_while(|c| c.is_alphanumeric() || *c == '_').count().max(1);
    let (left, right) = (at.x + start.left(), at.x + place(wrong.column - 1 + word).left());
    let y = at.y + start.bottom();
    ui.painter().hline(left..=right.max(left + 7.0), y, Stroke::new(2.0, theme::ERROR));
    let said = Pos2::new(at.x + end.left() + 18.0, row.center().y);
    let font = FontId::proportional(12.0);
    ui.painter().text(
        said,
        egui::Align2::LEFT_CENTER,
        &wrong.message,
        font,
        theme::letters(theme::ERROR, ui.visuals()),
    );
    row
}
