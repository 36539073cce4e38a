//! Wires without the pointer: a list of all that the selected node can be joined with, found by words. It is offered by a key, by the
//! menus, and by a press on a socket by those who do not see it.

use std::collections::BTreeSet;

use eframe::egui::{self, Id, Key, Modifiers, Pos2, Vec2, pos2, vec2};
use halfvector_graph::check::node_label;
use halfvector_graph::document::{Graph, Link, NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::resolve::{NodeTypes, Types, resolve_types};
use halfvector_graph::value::SocketType;

use super::fit::{candidates, fits, refusal};
use super::keys::TAB;
use super::sheet::{Sheet, Side, shown};
use super::{Canvas, Desk};
use crate::palette::search::{self, Entry};
use crate::palette::{ROW_HEIGHT, line};

const SIZE: Vec2 = vec2(380.0, 12.0 * ROW_HEIGHT);
/// Most lines that are listed; words find the others.
const LISTED: usize = 200;

/// The list while it is open.
#[derive(Debug)]
pub(super) struct Connecting {
    at: Pos2,
    title: String,
    choices: Vec<Choice>,
    entries: Vec<Entry>,
    query: String,
    /// What is found, by its place among the choices.
    rows: Vec<usize>,
    cursor: usize,
    scrolls: bool,
    is_new: bool,
}

/// A wire that can be made or taken away.
#[derive(Clone, Debug, PartialEq)]
struct Choice {
    link: Link,
    is_there: bool,
    text: String,
    /// Whether the output's value becomes one of another type.
    is_converted: bool,
    /// What is said at the end of its line.
    aside: String,
    /// Of the node at the other end.
    category: String,
}

/// A link that can be made, and what is told of it.
struct Pair {
    link: Link,
    is_converted: bool,
    aside: String,
}

impl Canvas {
    /// Opens the list for the selected nodes, or for one socket.
    pub(super) fn connect(
        &mut self,
        ui: &egui::Ui,
        desk: &mut Desk<'_>,
        sheet: &Sheet,
        socket: Option<(SocketRef, Side)>,
    ) {
        let subjects = match &socket {
            Some((socket, _)) => BTreeSet::from([socket.node.clone()]),
            None => desk.session.selection().clone(),
        };
        let Some(card) = subjects.first().and_then(|id| sheet.card(id)) else {
            return self.say(ui, desk.lens.pane.center(), format!("Select a node to connect it. {TAB}"));
        };
        let corner = desk.lens.to_screen(card.rect().right_top());
        let at = corner.clamp(desk.lens.pane.min, desk.lens.pane.max) + vec2(8.0, 0.0);
        let choices = choices(desk, sheet, &subjects, socket.as_ref());
        let what = match (&socket, subjects.len()) {
            (Some((socket, _)), _) => format!("“{}” of {}", shown(&socket.socket), card.title),
            (None, 1) => card.title.clone(),
            (None, _) => "the selected nodes".to_owned(),
        };
        if choices.is_empty() {
            return self.say(ui, at, format!("There is nothing that {what} can be connected with."));
        }
        let entries = choices.iter().map(|choice| Entry::of("", &choice.text, Vec::new(), "")).collect();
        let rows = (0..choices.len().min(LISTED)).collect();
        self.connecting = Some(Connecting {
            at,
            title: format!("Connect {what}"),
            choices,
            entries,
            query: String::new(),
            rows,
            cursor: 0,
            scrolls: false,
            is_new: true,
        });
    }

    /// Shows the list and makes the wire that is chosen.
    pub(super) fn show_connecting(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) {
        let Some(mut open) = self.connecting.take() else { return };
        let within = ui.ctx().content_rect();
        let corner = pos2(
            open.at.x.min(within.right() - SIZE.x - 20.0).max(within.left() + 4.0),
            open.at.y.min(within.bottom() - SIZE.y - 90.0).max(within.top() + 4.0),
        );
        let by_key = open.keys(ui.ctx());
        let area = egui::Area::new(Id::new("graph connect")).order(egui::Order::Foreground).fixed_pos(corner);
        let drawn = area.show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).inner_margin(8).show(ui, |ui| {
                ui.set_width(SIZE.x);
                open.contents(ui)
            })
        });
        let chosen = match by_key {
            Some(None) => None,
            Some(chosen) => chosen,
            None => {
                let is_elsewhere = drawn.response.clicked_elsewhere() && !open.is_new;
                open.is_new = false;
                if drawn.inner.inner.is_none() && !is_elsewhere {
                    self.connecting = Some(open);
                    return;
                }
                drawn.inner.inner
            }
        };
        ui.memory_mut(|memory| memory.request_focus(Id::new("graph canvas")));
        let Some(choice) = chosen.map(|i| &open.choices[i]) else { return };
        let link = choice.link.clone();
        if choice.is_there {
            desk.edit(sheet, "Disconnect", vec![Edit::RemoveLink { link }]);
        } else if let Some(why) = refusal(desk.session, &link) {
            self.say(ui, open.at, why);
        } else {
            desk.edit(sheet, "Connect", vec![Edit::AddLink { link }]);
        }
    }
}

impl Connecting {
    /// Moves the cursor, chooses or closes by keys: none while it goes on, none within when it is closed.
    #[expect(clippy::option_option, reason = "whether it is done, and with what")]
    fn keys(&mut self, context: &egui::Context) -> Option<Option<usize>> {
        let pressed = |key: Key| context.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) > 0 {
            return Some(None);
        }
        let last = self.rows.len().saturating_sub(1);
        let before = self.cursor;
        self.cursor = (self.cursor + pressed(Key::ArrowDown) + 10 * pressed(Key::PageDown)).min(last);
        self.cursor = self.cursor.saturating_sub(pressed(Key::ArrowUp) + 10 * pressed(Key::PageUp));
        self.scrolls |= self.cursor != before;
        // Tab would take the focus away from the text.
        pressed(Key::Tab);
        let chosen = (pressed(Key::Enter) > 0).then(|| self.rows.get(self.cursor).copied()).flatten();
        chosen.map(Some)
    }

    /// Draws it; the choice that was pressed.
    fn contents(&mut self, ui: &mut egui::Ui) -> Option<usize> {
        ui.strong(&self.title);
        let hint = "Search: a socket, a node";
        let field = egui::TextEdit::singleline(&mut self.query).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::TextEdit, true, "Search connections"));
        if !field.has_focus() {
            field.request_focus();
        }
        if field.changed() {
            self.rows = match self.query.trim() {
                "" => (0..self.choices.len()).collect(),
                query => search::find(&self.entries, query, &[], &mut search::matcher()),
            };
            self.rows.truncate(LISTED);
            self.cursor = 0;
        }
        ui.separator();
        let scrolls = std::mem::take(&mut self.scrolls);
        let mut chosen = None;
        egui::ScrollArea::vertical().max_height(SIZE.y).auto_shrink([false, true]).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            if self.rows.is_empty() {
                ui.weak("Nothing is called that.");
            }
            for (i, row) in self.rows.iter().enumerate() {
                let choice = &self.choices[*row];
                let response = line(ui, i == self.cursor, &choice.text, &choice.aside, None, &choice.category);
                if scrolls && i == self.cursor {
                    response.scroll_to_me(None);
                }
                if response.hovered() && ui.input(|input| input.pointer.delta() != Vec2::ZERO) {
                    self.cursor = i;
                }
                if response.clicked() {
                    chosen = Some(*row);
                }
            }
        });
        ui.weak("Arrow keys choose, Enter connects, Esc closes.");
        chosen
    }
}

/// All wires between the subjects and others that can be made, without conversion first, of these the nearest; then
/// those that are there. Of several subjects only those among them.
fn choices(
    desk: &Desk<'_>,
    sheet: &Sheet,
    subjects: &BTreeSet<NodeId>,
    socket: Option<&(SocketRef, Side)>,
) -> Vec<Choice> {
    let (graph, types) = (desk.graph, resolve_types(desk.graph, desk.library));
    let is_meant = |node: &str, name: &str, side: Side| {
        socket.is_none_or(|(socket, meant)| *meant == side && socket.node == node && socket.socket == name)
    };
    let label = |id: &str| node_label(graph, desk.library, id);
    let among = subjects.len() > 1;
    let mut found: Vec<(bool, f32, Choice)> = Vec::new();
    for subject in subjects {
        let (feeds, fed) = (reached(graph, subject, false), reached(graph, subject, true));
        for other in graph.nodes.keys().filter(|id| *id != subject && (!among || subjects.contains(*id))) {
            let way = match (sheet.card(subject), sheet.card(other)) {
                (Some(a), Some(b)) => a.rect().center().distance(b.rect().center()),
                _ => f32::INFINITY,
            };
            let mut add = |Pair { link, is_converted, aside }: Pair, text: String| {
                let is_there = graph.links.contains(&link);
                let category = sheet.card(other).map_or("", super::Card::category).to_owned();
                found.push((is_there, way, Choice { link, is_there, text, is_converted, aside, category }));
            };
            // Nothing may come to feed itself.
            if !feeds.contains(other.as_str()) {
                for pair in pairs(graph, &types, subject, other, |name| is_meant(subject, name, Side::Output)) {
                    let own = output_name(&types, &pair.link.from).map_or_else(String::new, |name| format!("{name}: "));
                    let text = format!("{own}to {} of {}", shown(&pair.link.to.socket), label(other));
                    add(pair, text);
                }
            }
            // Among the subjects the other one's outputs have their turn.
            if !among && !fed.contains(other.as_str()) {
                for pair in pairs(graph, &types, other, subject, |_| true) {
                    if is_meant(subject, &pair.link.to.socket, Side::Input) {
                        let theirs =
                            output_name(&types, &pair.link.from).map_or_else(String::new, |name| format!("{name} of "));
                        let text = format!("{}: from {theirs}{}", shown(&pair.link.to.socket), label(other));
                        add(pair, text);
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0).then(a.2.is_converted.cmp(&b.2.is_converted)).then(a.1.total_cmp(&b.1)));
    let worded = |(is_there, _, choice): (bool, f32, Choice)| match is_there {
        true => Choice { text: format!("{} (take away)", choice.text), aside: "connected".to_owned(), ..choice },
        false => choice,
    };
    found.into_iter().map(worded).collect()
}

/// The links that can be made from a node to another one, with what they would replace.
fn pairs(graph: &Graph, types: &Types<'_>, from: &str, to: &str, is_meant: impl Fn(&str) -> bool) -> Vec<Pair> {
    let (Some(giver), Some(taker)) = (types.get(from), types.get(to)) else { return Vec::new() };
    let mut pairs = Vec::new();
    for output in giver.def.outputs.iter().filter(|output| is_meant(&output.name)) {
        for input in &taker.def.inputs {
            let Some(is_converted) = goes(giver, output.ty, taker, input.ty) else { continue };
            let link = Link::new(SocketRef::new(from, &output.name), SocketRef::new(to, &input.name));
            let aside = if graph.incoming(&link.to).is_some() { "replaces a wire" } else { "" };
            pairs.push(Pair { link, is_converted, aside: aside.to_owned() });
        }
    }
    pairs
}

/// Whether a value is converted on the way to an input; none when it cannot go there.
fn goes(giver: &NodeTypes<'_>, given: SocketType, taker: &NodeTypes<'_>, wanted: SocketType) -> Option<bool> {
    let given = giver.resolved(given);
    let wanted = candidates(taker.resolved(wanted), wanted == SocketType::Generic, &taker.def.generic);
    let fits = wanted.iter().any(|wanted| fits(given, *wanted));
    fits.then(|| !wanted.contains(&given))
}

/// The name of an output; none of the only one, as its node says it all.
fn output_name(types: &Types<'_>, socket: &SocketRef) -> Option<String> {
    let outputs = types.get(&socket.node).map_or(0, |types| types.def.outputs.len());
    (outputs > 1).then(|| shown(&socket.socket))
}

/// The nodes that feed a node, or that it feeds (`onward`), over any number of others.
fn reached<'g>(graph: &'g Graph, node: &'g str, onward: bool) -> BTreeSet<&'g str> {
    let mut seen = BTreeSet::new();
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        for link in &graph.links {
            let (near, far) = if onward { (&link.from, &link.to) } else { (&link.to, &link.from) };
            if near.node == node && seen.insert(far.node.as_str()) {
                open.push(&far.node);
            }
        }
    }
    seen
}
