//! Paints the graph: grid, wires, cards. It changes nothing and only looks at what is in view.

use eframe::egui::epaint::text::{LayoutJob, TextFormat, TextWrapping};
use eframe::egui::{
    self, Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2,
};
use halfvector_graph::check::Severity;
use halfvector_graph::value::SocketType;

use super::sheet::{Card, Field, HEADER, MARGIN, ROW_SIZE, Row, Sheet, Side, TITLE_SIZE, number};
use super::view::{GRID, Lens};
use super::wire;
use crate::theme::{self, CanvasColors};

/// How much of a card can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Everything.
    Full,
    /// Titles and sockets.
    Titles,
    /// Blocks of colour.
    Blocks,
}

/// Whether a socket takes the wire that is drawn.
pub(super) type Takes<'a> = &'a dyn Fn(&Card, &Row) -> bool;

/// What is drawn with, and what stands out.
pub(super) struct Brush<'a> {
    pub(super) painter: &'a Painter,
    pub(super) lens: Lens,
    pub(super) colors: CanvasColors,
    pub(super) detail: Detail,
    /// While a wire is drawn: whether a socket takes it.
    pub(super) takes: Option<Takes<'a>>,
}

impl Detail {
    /// What can be read at a zoom.
    pub(super) fn of(lens: Lens) -> Detail {
        match lens.view.zoom {
            zoom if zoom >= 0.45 => Detail::Full,
            zoom if zoom >= 0.3 => Detail::Titles,
            _ => Detail::Blocks,
        }
    }
}

impl Row {
    /// Whether a wire can be drawn from or to it.
    pub(super) fn has_socket(&self) -> bool {
        self.side != Side::Fold && self.ty != SocketType::Texture
    }
}

impl Field {
    /// Whether it is changed on the card.
    pub(super) fn is_editable(&self) -> bool {
        !matches!(self, Field::None | Field::Note(_))
    }
}

/// The ground and its lines.
pub(super) fn grid(painter: &Painter, lens: Lens, colors: &CanvasColors) {
    painter.rect_filled(lens.pane, 0.0, colors.ground);
    let mut step = GRID;
    while step * lens.view.zoom < 14.0 {
        step *= 5.0;
    }
    let seen = lens.seen();
    for (step, color) in [(step, colors.grid), (step * 5.0, colors.grid_strong)] {
        let stroke = Stroke::new(1.0, color);
        let mut x = (seen.left() / step).ceil() * step;
        while x <= seen.right() {
            painter.vline(lens.to_screen(pos2(x, 0.0)).x.round() + 0.5, lens.pane.y_range(), stroke);
            x += step;
        }
        let mut y = (seen.top() / step).ceil() * step;
        while y <= seen.bottom() {
            painter.hline(lens.pane.x_range(), lens.to_screen(pos2(0.0, y)).y.round() + 0.5, stroke);
            y += step;
        }
    }
}

impl Brush<'_> {
    /// All wires that are in view.
    pub(super) fn wires(&self, sheet: &Sheet, hovered: Option<usize>, is_hidden: impl Fn(usize) -> bool) {
        let mut points = Vec::new();
        let zoom = self.lens.view.zoom;
        for (i, shown) in sheet.wires.iter().enumerate().filter(|(i, _)| !is_hidden(*i)) {
            let (from, to) = (sheet.socket(shown.from), sheet.socket(shown.to));
            let (from, to) = (self.lens.to_screen(from), self.lens.to_screen(to));
            if !wire::bounds(from, to, zoom).intersects(self.lens.pane) {
                continue;
            }
            let is_near = sheet.cards[shown.from.0].is_selected || sheet.cards[shown.to.0].is_selected;
            let width = if hovered == Some(i) {
                3.5
            } else if is_near {
                2.6
            } else {
                1.9
            };
            let color = theme::socket_color(shown.ty);
            let color = if hovered == Some(i) || is_near { color } else { color.gamma_multiply(0.8) };
            wire::curve(from, to, zoom, &mut points);
            let stroke = Stroke::new(width * zoom.clamp(0.5, 1.2), color);
            self.painter.add(Shape::line(points.clone(), stroke));
        }
    }

    /// A wire that follows the pointer.
    pub(super) fn loose_wire(&self, from: Pos2, to: Pos2, color: Color32) {
        let mut points = Vec::new();
        wire::curve(from, to, self.lens.view.zoom, &mut points);
        self.painter.add(Shape::line(points, Stroke::new(2.6, color)));
    }

    /// A node.
    pub(super) fn card(&self, card: &Card, is_hovered: bool) {
        let rect = self.lens.rect_to_screen(card.rect());
        let zoom = self.lens.view.zoom;
        let radius = CornerRadius::same((6.0 * zoom).round() as u8);
        let header_color = card.heat.map_or_else(|| theme::category_color(card.category()), theme::heat);
        let line = if card.is_selected {
            Stroke::new(2.0, theme::ACCENT)
        } else if card.problems.first().is_some_and(|(severity, _)| *severity == Severity::Error) {
            Stroke::new(1.5, theme::ERROR)
        } else {
            Stroke::new(1.0, if is_hovered { self.colors.line_strong } else { self.colors.line })
        };
        if card.is_reroute() {
            let ty = card.rows.first().map_or(SocketType::Generic, |row| row.ty);
            let fill = theme::socket_color(ty).lerp_to_gamma(self.colors.card, 0.55);
            self.painter.rect(rect, rect.height() / 2.0, fill, line, StrokeKind::Inside);
            card.rows.iter().for_each(|row| self.row(card, row, rect));
            return;
        }
        if self.detail == Detail::Blocks {
            self.painter.rect(rect, radius, header_color, line, StrokeKind::Middle);
            self.name_from_afar(card, rect);
            return;
        }
        if self.detail == Detail::Full {
            let shadow = rect.translate(vec2(0.0, 2.0 * zoom)).expand(1.5 * zoom);
            self.painter.rect_filled(shadow, radius, self.colors.shadow);
        }
        let mark = !card.problems.is_empty();
        if self.detail == Detail::Full {
            self.painter.rect(rect, radius, self.colors.card, line, StrokeKind::Outside);
            let header = Rect::from_min_size(rect.min, vec2(rect.width(), HEADER * zoom));
            let top = CornerRadius { sw: 0, se: 0, ..radius };
            self.painter.rect_filled(header, top, header_color);
            let room = header.width() - (MARGIN * 2.0 + if mark { 36.0 } else { 18.0 }) * zoom;
            let at = pos2(header.left() + MARGIN * zoom, header.center().y);
            self.text(at, Align2::LEFT_CENTER, &card.title, TITLE_SIZE, self.colors.title, room);
        } else {
            self.painter.rect(rect, radius, header_color, line, StrokeKind::Outside);
            self.name_from_afar(card, rect);
        }
        if card.has_picture() && self.detail == Detail::Full {
            let center = self.lens.to_screen(card.toggle());
            let color = self.colors.title.gamma_multiply(if card.picture().is_some() { 0.9 } else { 0.45 });
            self.painter.circle_stroke(center, 4.6 * zoom, Stroke::new(1.4 * zoom, color));
            if card.picture().is_some() {
                self.painter.circle_filled(center, 2.4 * zoom, color);
            }
        }
        if let Some((severity, _)) = card.problems.first() {
            self.mark(self.lens.to_screen(card.mark()), *severity);
        }
        for row in &card.rows {
            self.row(card, row, rect);
        }
    }

    /// The name on the whole card, as large as there is room for it, no smaller than it can be read. Words are not taken apart: a name
    /// that has no room at all ends in dots.
    fn name_from_afar(&self, card: &Card, rect: Rect) {
        let body = rect.shrink2(vec2(4.0, 1.0));
        if body.width() < 16.0 || body.height() < 7.0 {
            return;
        }
        let laid = |text: &str, size: f32, wrap: TextWrapping| {
            let format = TextFormat::simple(FontId::proportional(size), self.colors.title);
            let mut job = LayoutJob::single_section(text.to_owned(), format);
            job.wrap = wrap;
            self.painter.layout_job(job)
        };
        let longest = card.title.split_whitespace().map(|word| word.chars().count()).max().unwrap_or(0) as f32;
        let all = card.title.chars().count() as f32;
        let whole = |size: f32| {
            // What certainly has no room is not laid out: there may be hundreds of cards.
            let width = size * 0.56;
            let lines = (all * width * 0.85 / body.width()).ceil();
            if longest * width > body.width() || lines * size > body.height() {
                return None;
            }
            let galley = laid(&card.title, size, TextWrapping::wrap_at_width(body.width()));
            (galley.size().y <= body.height()).then_some(galley)
        };
        let galley = [11.0, 9.5, 8.0, 7.0].into_iter().find_map(whole);
        let galley = galley.unwrap_or_else(|| laid(&card.title, 7.0, TextWrapping::truncate_at_width(body.width())));
        let at = pos2(body.left(), body.center().y - galley.size().y / 2.0);
        self.painter.with_clip_rect(rect.intersect(self.painter.clip_rect())).galley(at, galley, self.colors.title);
    }

    fn row(&self, card: &Card, row: &Row, rect: Rect) {
        let zoom = self.lens.view.zoom;
        let y = rect.top() + row.y * zoom;
        let is_dim = self.takes.is_some_and(|takes| !takes(card, row));
        let fade = |color: Color32| if is_dim { color.gamma_multiply(0.3) } else { color };
        if self.detail == Detail::Full && row.y > HEADER {
            let margin = MARGIN * zoom;
            let field = card.field(row).map(|field| self.lens.rect_to_screen(field));
            let room = field.map_or(rect.right() - margin, |field| field.left() - 4.0) - rect.left() - margin;
            let color = fade(if row.side == Side::Fold { self.colors.weak } else { self.colors.text });
            match row.side {
                Side::Output => {
                    self.text(pos2(rect.right() - margin, y), Align2::RIGHT_CENTER, &row.label, ROW_SIZE, color, room);
                }
                Side::Input | Side::Fold => {
                    self.text(pos2(rect.left() + margin, y), Align2::LEFT_CENTER, &row.label, ROW_SIZE, color, room);
                }
            }
            if let Some(field) = field {
                self.field(field, &row.field, is_dim);
            }
        }
        if row.has_socket() {
            let x = if row.side == Side::Output { rect.right() } else { rect.left() };
            self.socket(pos2(x, y), row.ty, row.is_wired, is_dim);
        }
    }

    fn socket(&self, center: Pos2, ty: SocketType, is_wired: bool, is_dim: bool) {
        let radius = (4.8 * self.lens.view.zoom).max(2.0);
        let color = theme::socket_color(ty);
        let color = if is_dim { color.lerp_to_gamma(self.colors.card, 0.7) } else { color };
        if ty == SocketType::Surface {
            let side = radius * 1.8;
            let square = Rect::from_center_size(center, Vec2::splat(side));
            self.painter.rect(
                square,
                1.0,
                if is_wired { color } else { self.colors.ground },
                (1.6, color),
                StrokeKind::Inside,
            );
        } else if is_wired || self.detail != Detail::Full {
            self.painter.circle_filled(center, radius, color);
        } else {
            self.painter.circle(center, radius - 0.8, self.colors.ground, Stroke::new(1.6, color));
        }
    }

    /// A socket that the pointer means.
    pub(super) fn ring(&self, center: Pos2, color: Color32) {
        self.painter.circle_stroke(center, (8.0 * self.lens.view.zoom).max(5.0), Stroke::new(2.0, color));
    }

    fn mark(&self, center: Pos2, severity: Severity) {
        let color = match severity {
            Severity::Error => theme::ERROR,
            Severity::Warning => theme::WARNING,
        };
        let zoom = self.lens.view.zoom;
        self.painter.circle_filled(center, 6.5 * zoom, color);
        self.text(center, Align2::CENTER_CENTER, "!", 11.0, Color32::from_gray(20), f32::INFINITY);
    }

    fn field(&self, rect: Rect, field: &Field, is_dim: bool) {
        let zoom = self.lens.view.zoom;
        let fade = |color: Color32| if is_dim { color.gamma_multiply(0.4) } else { color };
        let radius = 3.0 * zoom;
        match field {
            Field::None => {}
            Field::Number { value, range, unit, .. } => {
                self.painter.rect_filled(rect, radius, fade(self.colors.field));
                if let Some([low, high]) = range.filter(|[low, high]| low.is_finite() && high.is_finite() && high > low)
                {
                    let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
                    let filled = Rect::from_min_size(rect.min, vec2(rect.width() * part, rect.height()));
                    self.painter.rect_filled(filled, radius, fade(self.colors.filled));
                }
                let text = if unit.is_empty() { number(*value) } else { format!("{} {unit}", number(*value)) };
                let at = rect.right_center() - vec2(5.0 * zoom, 0.0);
                self.text(
                    at,
                    Align2::RIGHT_CENTER,
                    &text,
                    ROW_SIZE - 0.5,
                    fade(self.colors.text),
                    rect.width() - 8.0 * zoom,
                );
            }
            Field::Color(color) => {
                let fill = fade(super::fields::on_screen(*color));
                self.painter.rect(rect.shrink(1.0), radius, fill, (1.0, self.colors.line_strong), StrokeKind::Inside);
            }
            Field::Switch(on) => {
                let fill = if *on { theme::ACCENT } else { self.colors.field };
                let rect = rect.shrink(1.0);
                self.painter.rect(rect, radius, fade(fill), (1.0, self.colors.line_strong), StrokeKind::Inside);
                if *on {
                    let at = |x: f32, y: f32| rect.min + rect.size() * vec2(x, y);
                    let stroke = Stroke::new(1.8 * zoom, Color32::WHITE);
                    self.painter.add(Shape::line(vec![at(0.25, 0.52), at(0.43, 0.7), at(0.77, 0.3)], stroke));
                }
            }
            Field::Vector(_) => {
                let text = field.text();
                self.painter.rect_filled(rect, radius, fade(self.colors.field));
                let at = rect.right_center() - vec2(5.0 * zoom, 0.0);
                self.text(
                    at,
                    Align2::RIGHT_CENTER,
                    &text,
                    ROW_SIZE - 0.5,
                    fade(self.colors.text),
                    rect.width() - 8.0 * zoom,
                );
            }
            Field::Note(text) => {
                self.text(
                    rect.right_center(),
                    Align2::RIGHT_CENTER,
                    text,
                    ROW_SIZE - 1.0,
                    fade(self.colors.weak),
                    rect.width() + 12.0,
                );
            }
        }
    }

    /// Text in one line, cut with an ellipsis where there is no room. Letters keep to half points, so that zooming does not
    /// fill the font's texture with every size there is.
    pub(super) fn text(&self, at: Pos2, anchor: Align2, text: &str, size: f32, color: Color32, room: f32) {
        let size = (size * self.lens.view.zoom * 2.0).round() / 2.0;
        if size < 4.0 || room < size {
            return;
        }
        let mut job = LayoutJob::single_section(text.to_owned(), TextFormat::simple(FontId::proportional(size), color));
        job.wrap = TextWrapping::truncate_at_width(room + 1.0);
        let galley = self.painter.layout_job(job);
        let rect = anchor.anchor_size(at, galley.size());
        self.painter.galley(rect.min, galley, color);
    }
}

impl Card {
    /// Where the mark of a problem is.
    pub(super) fn mark(&self) -> Pos2 {
        let rect = self.rect();
        pos2(rect.right() - 36.0, rect.top() + HEADER / 2.0)
    }
}

/// A box with words at the pointer.
pub(super) fn words(painter: &egui::Painter, at: Pos2, text: &str, color: Color32, colors: &CanvasColors) {
    let galley = painter.layout(text.to_owned(), FontId::proportional(12.5), colors.text, 320.0);
    let mut rect = Rect::from_min_size(at + vec2(14.0, 14.0), galley.size()).expand2(vec2(8.0, 5.0));
    let limit = painter.clip_rect();
    rect = rect.translate(vec2((limit.right() - rect.right()).min(0.0), (limit.bottom() - rect.bottom()).min(0.0)));
    painter.rect(rect, 4.0, colors.card, Stroke::new(1.2, color), StrokeKind::Inside);
    painter.galley(rect.min + vec2(8.0, 5.0), galley, colors.text);
}
