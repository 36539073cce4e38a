//! The whole graph in a corner, with the part that is seen. A press there moves the view.

use eframe::egui::{self, Id, Pos2, Rect, Sense, Stroke, StrokeKind, pos2, vec2};

use super::draw::Brush;
use super::sheet::Sheet;
use super::view::{Lens, View};
use super::{Canvas, Desk};
use crate::theme;

const SIZE: egui::Vec2 = vec2(168.0, 112.0);

impl Canvas {
    /// Lets the pointer move the view; whether the pointer is busy here.
    pub(super) fn map(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) -> bool {
        let Some(map) = self.map_lens(desk.lens, sheet) else { return false };
        let response = ui.interact(map.pane, Id::new("graph map"), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, "Map of the graph"));
        if let Some(at) = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on()) {
            desk.lens.view.center = map.to_canvas(at);
        }
        response.contains_pointer() && self.gesture.is_idle()
    }

    pub(super) fn paint_map(&self, brush: &Brush<'_>, sheet: &Sheet, pointer: Option<Pos2>) {
        let Some(map) = self.map_lens(brush.lens, sheet) else { return };
        let colors = &brush.colors;
        // What lies under it is seen through it, but while it is used.
        let strength = if pointer.is_some_and(|at| map.pane.contains(at)) { 1.0 } else { 0.5 };
        brush.painter.rect(
            map.pane,
            4.0,
            colors.card.gamma_multiply(0.9 * strength),
            Stroke::new(1.0, colors.line),
            StrokeKind::Inside,
        );
        let painter = brush.painter.with_clip_rect(map.pane.shrink(2.0));
        for note in &sheet.notes {
            let rect = map.rect_to_screen(note.shown);
            painter.rect_stroke(rect, 1.0, Stroke::new(1.0, colors.line), StrokeKind::Inside);
        }
        for card in &sheet.cards {
            let color = if card.is_selected { theme::ACCENT } else { theme::category_color(card.category()) };
            painter.rect_filled(map.rect_to_screen(card.rect()), 1.0, color.gamma_multiply(strength));
        }
        let seen = map.rect_to_screen(brush.lens.seen());
        painter.rect_stroke(seen, 1.0, Stroke::new(1.0, colors.weak), StrokeKind::Inside);
    }

    /// None while all is in view, or the pane is too small, or nobody wants it.
    fn map_lens(&self, lens: Lens, sheet: &Sheet) -> Option<Lens> {
        let all = sheet.whole()?;
        let is_needed =
            !lens.seen().contains_rect(all) && lens.pane.width() > 3.0 * SIZE.x && lens.pane.height() > 2.5 * SIZE.y;
        (is_needed && !self.hides_map).then(|| {
            let corner = lens.pane.max - vec2(8.0, 8.0);
            let pane = Rect::from_min_max(pos2(corner.x - SIZE.x, corner.y - SIZE.y), corner);
            let all = all.union(lens.seen().intersect(all.expand(400.0)));
            let zoom = ((SIZE - vec2(8.0, 8.0)) / all.size().max(vec2(1.0, 1.0))).min_elem();
            Lens { pane, view: View { center: all.center(), zoom } }
        })
    }
}
