//! What the pointer is doing on the canvas, painted: the box that selects, lines of alignment, a wire on its way and why it does not fit.

use eframe::egui::{self, Pos2, Rect, Stroke, StrokeKind};
use halfvector_graph::document::SocketRef;

use super::draw::{self, Brush};
use super::fit::{Loose, refusal};
use super::gesture::{Gesture, Target, target};
use super::sheet::{Sheet, Side};
use super::{Canvas, Desk};
use crate::theme;

impl Canvas {
    /// Paints what the pointer is doing.
    pub(super) fn paint_gesture(
        &mut self,
        ui: &egui::Ui,
        brush: &Brush<'_>,
        desk: &Desk<'_>,
        sheet: &Sheet,
        pointer: Option<Pos2>,
    ) {
        let Some(at) = pointer else { return };
        let lens = brush.lens;
        match &mut self.gesture {
            Gesture::Box { from, .. } => {
                let rect = Rect::from_two_pos(lens.to_screen(*from), at);
                let fill = theme::ACCENT.gamma_multiply(0.12);
                brush.painter.rect(rect, 2.0, fill, Stroke::new(1.0, theme::ACCENT), StrokeKind::Inside);
            }
            Gesture::Move { snapped, .. } => {
                for line in &snapped.lines {
                    brush.painter.line_segment(line.map(|end| lens.to_screen(end)), Stroke::new(1.0, theme::ACCENT));
                }
            }
            Gesture::Wire { loose, asked, .. } => {
                let socket = loose.socket().clone();
                let side = if matches!(loose, Loose::Output(..)) { Side::Output } else { Side::Input };
                let Some(fixed) = sheet.find(&socket, side).map(|place| lens.to_screen(sheet.socket(place))) else {
                    return;
                };
                let mut color = theme::socket_color(loose.ty());
                let mut end = at;
                if let Target::Socket(card, row) = target(sheet, desk, at, loose) {
                    let link = loose.link(SocketRef::new(&sheet.cards[card].id, &sheet.cards[card].rows[row].name));
                    if asked.as_ref().is_none_or(|(other, _)| *other != link) {
                        let why = refusal(desk.session, &link);
                        *asked = Some((link, why));
                    }
                    end = lens.to_screen(sheet.socket((card, row)));
                    if let Some((_, Some(why))) = asked {
                        color = theme::ERROR;
                        draw::words(brush.painter, at, why, color, &brush.colors);
                        super::announce::words(ui, why);
                    }
                    brush.ring(end, color);
                }
                match side {
                    Side::Output => brush.loose_wire(fixed, end, color),
                    _ => brush.loose_wire(end, fixed, color),
                }
            }
            Gesture::Idle | Gesture::Pan | Gesture::Resize { .. } | Gesture::Number { .. } => {}
        }
    }
}
