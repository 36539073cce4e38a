//! The sheet of keys and the page about the program.

use eframe::egui;

use crate::app::keys::{EVERYWHERE, Hint, SHORTCUTS};

/// Groups of keys that panes take themselves.
const PANES: &[(&str, &[Hint])] = &[("Graph", GRAPH), ("Viewport", VIEWPORT), ("Functions", FUNCTIONS)];

const GRAPH: &[Hint] = &[
    Hint { keys: "Space, Tab", what: "Add a node" },
    Hint { keys: "Enter", what: "Add a node that the selected one feeds" },
    Hint { keys: "C", what: "Connect the selected node with another one, by words" },
    Hint { keys: "Drag on the ground", what: "Select with a box" },
    Hint { keys: "Middle drag, wheel", what: "Move and zoom the view" },
    Hint { keys: "Home, F, 1", what: "Show all, the selection, life size" },
    Hint { keys: "Tab, Shift+Tab", what: "Next or previous node, without the pointer on the graph" },
    Hint { keys: "Arrow keys", what: "Move the selection by the grid" },
    Hint { keys: "Ctrl+A, Ctrl+D", what: "Select all, duplicate" },
    Hint { keys: "Ctrl+C, Ctrl+X, Ctrl+V", what: "Copy, cut, paste, also between windows" },
    Hint { keys: "Delete or X, Ctrl+Delete", what: "Remove; remove and join what it was between" },
    Hint { keys: "Ctrl+G, Ctrl+Shift+G", what: "Make a group, take it apart" },
    Hint { keys: "Double click, Esc", what: "Open a group, leave it" },
    Hint { keys: "Ctrl+J", what: "Frame the selection" },
    Hint { keys: "L", what: "Arrange the nodes" },
    Hint { keys: "F2", what: "Rename the node, frame or comment" },
];

const VIEWPORT: &[Hint] = &[
    Hint { keys: "Drag", what: "Turn" },
    Hint { keys: "Right or middle drag", what: "Move" },
    Hint { keys: "Wheel or pinch", what: "Nearer or farther" },
    Hint { keys: "Double click or F", what: "As at first" },
    Hint { keys: "Arrow keys, +, -", what: "Turn, nearer, farther; with the focus on the divider: move it" },
];

const FUNCTIONS: &[Hint] = &[
    Hint { keys: "Double click on its node", what: "Write the function" },
    Hint { keys: "Tab", what: "Set in; Esc, then Tab goes on to the next control" },
];

/// Width of the column of keys.
const KEYS_WIDTH: f32 = 200.0;
/// Width of a key's row: as wide as the longest one needs.
const ROW_WIDTH: f32 = 590.0;
const GAP: f32 = 24.0;

/// Draws the sheet; whether it is to be closed.
pub(crate) fn keys(ui: &mut egui::Ui) -> bool {
    ui.heading("Keys");
    let screen = ui.ctx().content_rect();
    let wide = 2.0 * ROW_WIDTH + GAP;
    let is_wide = screen.width() > wide + 60.0;
    ui.set_width(if is_wide { wide } else { ROW_WIDTH.min(screen.width() - 60.0) });
    let height = screen.height() * 0.74;
    egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
        ui.add_space(4.0);
        if is_wide {
            ui.spacing_mut().item_spacing.x = GAP;
            ui.columns(2, |columns| {
                window(&mut columns[0]);
                list(&mut columns[0], "Everywhere", EVERYWHERE);
                PANES.iter().for_each(|(title, hints)| list(&mut columns[1], title, hints));
            });
        } else {
            window(ui);
            PANES.iter().for_each(|(title, hints)| list(ui, title, hints));
            list(ui, "Everywhere", EVERYWHERE);
        }
    });
    ui.add_space(8.0);
    ui.button("Close").clicked()
}

fn window(ui: &mut egui::Ui) {
    ui.strong("Window");
    for (place, shortcut) in SHORTCUTS.iter().enumerate() {
        let text = |keys| ui.ctx().format_shortcut(keys).replace("Questionmark", "?");
        let keys: Vec<String> = shortcut.keys.iter().map(text).collect();
        row(ui, place, &keys.join(" or "), shortcut.what);
    }
    ui.add_space(8.0);
}

fn list(ui: &mut egui::Ui, title: &str, hints: &[Hint]) {
    ui.strong(title);
    hints.iter().enumerate().for_each(|(place, hint)| row(ui, place, hint.keys, hint.what));
    ui.add_space(8.0);
}

/// The same columns in all lists; what is too long for one goes on in the next line.
fn row(ui: &mut egui::Ui, place: usize, keys: &str, what: &str) {
    let fill = if place.is_multiple_of(2) { egui::Color32::TRANSPARENT } else { ui.visuals().faint_bg_color };
    egui::Frame::new().fill(fill).inner_margin(egui::Margin::symmetric(4, 2)).show(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        ui.horizontal_top(|ui| {
            let rest = ui.available_width() - KEYS_WIDTH - 8.0;
            for (width, text) in [(KEYS_WIDTH, egui::RichText::new(keys).monospace()), (rest, what.into())] {
                ui.vertical(|ui| {
                    ui.set_width(width);
                    ui.add(egui::Label::new(text).wrap());
                });
            }
        });
    });
}

/// Draws the page; whether it is to be closed.
pub(crate) fn about(ui: &mut egui::Ui) -> bool {
    ui.heading("Halfvector");
    ui.label(format!("Version {}", env!("CARGO_PKG_VERSION")));
    ui.add_space(8.0);
    ui.label(
        "Physically based materials as node graphs, seen live, taken home as small, readable and measured shaders.",
    );
    ui.add_space(8.0);
    ui.weak(concat!("Licence: ", env!("CARGO_PKG_LICENSE")));
    ui.add_space(12.0);
    ui.button("Close").clicked()
}
