//! The palette: all nodes that can be added, found by words or by category. It changes nothing: who opened it learns which
//! node was chosen.

pub(crate) mod search;

use std::collections::BTreeSet;

use eframe::egui::{self, Align2, Id, Key, Modifiers, Pos2, RichText, Vec2, pos2, vec2};
use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::SocketType;

use crate::theme;
use search::Entry;

/// What is chosen when a new function is wanted: the category of a document's functions, and no definition.
pub(crate) const NEW_FUNCTION: &str = "custom";
/// How many nodes are remembered as recently used.
const RECENT: usize = 8;
const SIZE: Vec2 = vec2(560.0, 380.0);
/// Height of a line of a list.
pub(crate) const ROW_HEIGHT: f32 = 22.0;

/// The palette. It remembers what was used.
#[derive(Debug, Default)]
pub(crate) struct Palette {
    open: Option<Open>,
    /// Ids of definitions, the last one used first.
    recent: Vec<String>,
    /// Categories that are unfolded.
    unfolded: BTreeSet<String>,
}

#[derive(Debug)]
struct Open {
    at: Pos2,
    /// What is offered.
    entries: Vec<Entry>,
    /// Why not everything is offered.
    filter: Option<String>,
    query: String,
    rows: Vec<Row>,
    /// The highlighted row.
    cursor: usize,
    /// Whether the highlighted row is to be scrolled into view.
    scrolls: bool,
    is_new: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Row {
    Heading(&'static str),
    Category(String),
    Entry(usize),
}

/// What became of the palette in a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// It is closed or waits.
    None,
    /// Closed without a choice.
    Closed,
    /// A definition was chosen.
    Chosen(String),
}

impl Palette {
    /// Whether it is shown.
    pub(crate) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Opens it at a point of the screen with the nodes that pass `offers`. `filter` says in words what they have in common.
    pub(crate) fn open(
        &mut self,
        at: Pos2,
        library: &Library,
        filter: Option<String>,
        offers: impl Fn(&NodeDef) -> bool,
    ) {
        let mut entries: Vec<Entry> = library.iter().filter(|def| offers(def)).map(Entry::new).collect();
        if filter.is_none() {
            let synonyms = ["wgsl", "code", "script", "expression", "custom"].map(str::to_owned).to_vec();
            let help =
                "A node of your own: a function in WGSL, which stands in the document. Its arguments are the inputs.";
            entries.push(Entry::of(NEW_FUNCTION, "New function", synonyms, help));
        }
        let mut open = Open {
            at,
            entries,
            filter,
            query: String::new(),
            rows: Vec::new(),
            cursor: 0,
            scrolls: false,
            is_new: true,
        };
        open.list(&self.recent, &self.unfolded);
        self.open = Some(open);
    }

    /// Shows it over everything else, within a rectangle.
    pub(crate) fn show(&mut self, ui: &egui::Ui, within: egui::Rect, library: &Library) -> Outcome {
        let Some(open) = &mut self.open else { return Outcome::None };
        let corner = pos2(
            open.at.x.min(within.right() - SIZE.x - 20.0).max(within.left() + 4.0),
            open.at.y.min(within.bottom() - SIZE.y - 40.0).max(within.top() + 4.0),
        );
        let mut outcome = open.keys(ui.ctx(), &self.recent, &mut self.unfolded);
        let area = egui::Area::new(Id::new("node palette")).order(egui::Order::Foreground).fixed_pos(corner);
        let shown = area.show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).inner_margin(8).show(ui, |ui| {
                ui.set_width(SIZE.x);
                open.contents(ui, library, &self.recent, &mut self.unfolded)
            })
        });
        if let Outcome::Chosen(id) = shown.inner.inner {
            outcome = Outcome::Chosen(id);
        }
        let is_elsewhere = shown.response.clicked_elsewhere() && !open.is_new;
        open.is_new = false;
        if outcome == Outcome::None && is_elsewhere {
            outcome = Outcome::Closed;
        }
        if outcome != Outcome::None {
            self.open = None;
        }
        if let Outcome::Chosen(id) = &outcome {
            self.recent.retain(|other| other != id);
            self.recent.insert(0, id.clone());
            self.recent.truncate(RECENT);
        }
        outcome
    }
}

impl Open {
    /// Makes the rows anew.
    fn list(&mut self, recent: &[String], unfolded: &BTreeSet<String>) {
        self.rows.clear();
        self.cursor = 0;
        if !self.query.trim().is_empty() {
            let found = search::find(&self.entries, &self.query, recent, &mut search::matcher());
            self.rows.extend(found.into_iter().map(Row::Entry));
            return;
        }
        let recent: Vec<usize> =
            recent.iter().filter_map(|id| self.entries.iter().position(|entry| entry.id == *id)).collect();
        if !recent.is_empty() {
            self.rows.push(Row::Heading("Recently used"));
            self.rows.extend(recent.into_iter().map(Row::Entry));
            self.rows.push(Row::Heading("All nodes"));
            self.cursor = 1;
        }
        let categories: BTreeSet<&str> = self.entries.iter().map(|entry| entry.category.as_str()).collect();
        for category in categories {
            self.rows.push(Row::Category(category.to_owned()));
            if unfolded.contains(category) {
                let inside = self.entries.iter().enumerate().filter(|(_, entry)| entry.category == category);
                let mut inside: Vec<usize> = inside.map(|(i, _)| i).collect();
                inside.sort_by_key(|&i| self.entries[i].label.to_lowercase());
                self.rows.extend(inside.into_iter().map(Row::Entry));
            }
        }
    }

    /// Moves the cursor, folds, chooses and closes by keys. Done before the text field sees them.
    fn keys(&mut self, context: &egui::Context, recent: &[String], unfolded: &mut BTreeSet<String>) -> Outcome {
        let pressed = |key: Key| context.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) > 0 {
            return Outcome::Closed;
        }
        for _ in 0..pressed(Key::ArrowDown) {
            self.step(1);
        }
        for _ in 0..pressed(Key::ArrowUp) {
            self.step(-1);
        }
        for _ in 0..pressed(Key::PageDown) {
            (0..10).for_each(|_| self.step(1));
        }
        for _ in 0..pressed(Key::PageUp) {
            (0..10).for_each(|_| self.step(-1));
        }
        let folds = self.query.is_empty().then(|| [pressed(Key::ArrowRight) > 0, pressed(Key::ArrowLeft) > 0]);
        let enters = pressed(Key::Enter) > 0;
        // Tab would take the focus away from the text.
        pressed(Key::Tab);
        match self.rows.get(self.cursor).cloned() {
            Some(Row::Entry(i)) if enters => return Outcome::Chosen(self.entries[i].id.clone()),
            Some(Row::Category(category)) => {
                let is_unfolded = unfolded.contains(&category);
                let [right, left] = folds.unwrap_or_default();
                if enters || (right && !is_unfolded) || (left && is_unfolded) {
                    self.fold(&category, recent, unfolded);
                }
            }
            _ => {}
        }
        Outcome::None
    }

    fn fold(&mut self, category: &str, recent: &[String], unfolded: &mut BTreeSet<String>) {
        if !unfolded.remove(category) {
            unfolded.insert(category.to_owned());
        }
        self.list(recent, unfolded);
        self.cursor = self.rows.iter().position(|row| *row == Row::Category(category.to_owned())).unwrap_or(0);
        self.scrolls = true;
    }

    fn step(&mut self, by: isize) {
        let mut at = self.cursor as isize;
        loop {
            at += by;
            match usize::try_from(at).ok().and_then(|at| self.rows.get(at)) {
                None => return,
                Some(Row::Heading(_)) => {}
                Some(_) => break,
            }
        }
        self.cursor = at as usize;
        self.scrolls = true;
    }

    fn contents(
        &mut self,
        ui: &mut egui::Ui,
        library: &Library,
        recent: &[String],
        unfolded: &mut BTreeSet<String>,
    ) -> Outcome {
        let hint = "Search nodes: name, synonym, what it does";
        let field = egui::TextEdit::singleline(&mut self.query).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::TextEdit, true, "Search nodes"));
        if !field.has_focus() {
            field.request_focus();
        }
        if field.changed() {
            self.list(recent, unfolded);
        }
        if let Some(filter) = &self.filter {
            ui.weak(filter);
        }
        ui.separator();
        let mut outcome = Outcome::None;
        ui.horizontal_top(|ui| {
            let down = egui::Layout::top_down(egui::Align::Min);
            let half = vec2(SIZE.x * 0.46, SIZE.y);
            ui.allocate_ui_with_layout(half, down, |ui| {
                ui.set_width(half.x);
                outcome = self.rows(ui, recent, unfolded);
            });
            ui.separator();
            let rest = vec2(ui.available_width(), SIZE.y);
            ui.allocate_ui_with_layout(rest, down, |ui| {
                ui.set_width(rest.x);
                self.help(ui, library);
            });
        });
        outcome
    }

    fn rows(&mut self, ui: &mut egui::Ui, recent: &[String], unfolded: &mut BTreeSet<String>) -> Outcome {
        let mut outcome = Outcome::None;
        let mut folded = None;
        let scrolls = std::mem::take(&mut self.scrolls);
        egui::ScrollArea::vertical().id_salt("found").max_height(SIZE.y).auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            if self.rows.is_empty() {
                ui.weak("No node is called that.");
            }
            for (i, row) in self.rows.iter().enumerate() {
                let response = match row {
                    Row::Heading(text) => {
                        ui.add_space(2.0);
                        ui.label(RichText::new(*text).weak().small());
                        continue;
                    }
                    Row::Category(category) => {
                        let count = self.entries.iter().filter(|entry| entry.category == *category).count();
                        line(
                            ui,
                            i == self.cursor,
                            category,
                            &count.to_string(),
                            Some(unfolded.contains(category)),
                            category,
                        )
                    }
                    Row::Entry(entry) => {
                        let entry = &self.entries[*entry];
                        let aside = if self.query.is_empty() { "" } else { &entry.category };
                        line(ui, i == self.cursor, &entry.label, aside, None, &entry.category)
                    }
                };
                if scrolls && i == self.cursor {
                    response.scroll_to_me(None);
                }
                // The mouse takes the cursor along only when it moves, so that it does not fight with the keys.
                if response.hovered() && ui.input(|input| input.pointer.delta() != Vec2::ZERO) {
                    self.cursor = i;
                }
                if response.clicked() {
                    match row {
                        Row::Entry(entry) => outcome = Outcome::Chosen(self.entries[*entry].id.clone()),
                        Row::Category(category) => folded = Some(category.clone()),
                        Row::Heading(_) => {}
                    }
                }
            }
        });
        if let Some(category) = folded {
            self.fold(&category, recent, unfolded);
        }
        outcome
    }

    /// What the highlighted node does.
    fn help(&self, ui: &mut egui::Ui, library: &Library) {
        egui::ScrollArea::vertical().id_salt("help").max_height(SIZE.y).auto_shrink(false).show(ui, |ui| {
            let entry = match self.rows.get(self.cursor) {
                Some(Row::Entry(entry)) => &self.entries[*entry],
                Some(Row::Category(category)) => {
                    ui.strong(category);
                    ui.weak("Enter or the arrow keys unfold it.");
                    return;
                }
                _ => return,
            };
            ui.label(RichText::new(&entry.label).strong().size(15.0));
            ui.label(RichText::new(&entry.id).weak().monospace().small());
            ui.add_space(4.0);
            ui.add(egui::Label::new(&entry.help).wrap());
            ui.add_space(6.0);
            let Some(def) = library.get(&entry.id) else { return };
            let inputs = def.inputs.iter().map(|input| (&input.name, input.ty, &input.help));
            let outputs = def.outputs.iter().map(|output| (&output.name, output.ty, &output.help));
            for (name, ty, help) in inputs {
                socket(ui, name, ty, help);
            }
            ui.add_space(2.0);
            ui.label(RichText::new("Gives").weak().small());
            for (name, ty, help) in outputs {
                socket(ui, name, ty, help);
            }
            if !entry.synonyms.is_empty() {
                ui.add_space(4.0);
                ui.weak(format!("Also: {}", entry.synonyms.join(", ")));
            }
        });
    }
}

/// A row of the list. `fold` says whether a category is unfolded.
pub(crate) fn line(
    ui: &mut egui::Ui,
    is_cursor: bool,
    text: &str,
    aside: &str,
    fold: Option<bool>,
    category: &str,
) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::SelectableLabel, true, is_cursor, text));
    if ui.is_rect_visible(rect) {
        let visuals = ui.visuals();
        if is_cursor {
            ui.painter().rect_filled(rect, 3.0, visuals.selection.bg_fill);
        }
        let color = if is_cursor { visuals.strong_text_color() } else { visuals.text_color() };
        let font = egui::FontId::proportional(13.0);
        let mut left = rect.left() + 6.0;
        match fold {
            Some(is_unfolded) => {
                let center = pos2(left + 4.0, rect.center().y);
                let corners = if is_unfolded {
                    [(-4.0, -2.0), (4.0, -2.0), (0.0, 3.0)]
                } else {
                    [(-2.0, -4.0), (3.0, 0.0), (-2.0, 4.0)]
                };
                let points = corners.iter().map(|(x, y)| center + vec2(*x, *y)).collect();
                ui.painter().add(egui::Shape::convex_polygon(points, color, egui::Stroke::NONE));
                left += 14.0;
            }
            None => {
                let bar = egui::Rect::from_center_size(pos2(left + 2.0, rect.center().y), vec2(3.0, 12.0));
                ui.painter().rect_filled(bar, 1.5, theme::category_color(category));
                left += 10.0;
            }
        }
        ui.painter().text(pos2(left, rect.center().y), Align2::LEFT_CENTER, text, font.clone(), color);
        let right = rect.right_center() - vec2(8.0, 0.0);
        ui.painter().text(
            right,
            Align2::RIGHT_CENTER,
            aside,
            egui::FontId::proportional(11.0),
            visuals.weak_text_color(),
        );
    }
    response
}

fn socket(ui: &mut egui::Ui, name: &str, ty: SocketType, help: &str) {
    ui.horizontal_wrapped(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(8.0, 12.0), egui::Sense::hover());
        ui.painter().circle_filled(rect.center(), 3.5, theme::socket_color(ty));
        ui.label(RichText::new(name.replace('_', " ")).small().strong());
        ui.label(RichText::new(help).small().weak());
    });
}
