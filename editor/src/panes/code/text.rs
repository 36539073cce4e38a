//! Draws the text of a shader: only the lines that are seen, each with its number and the mark of its node.

use eframe::egui::text::LayoutJob;
use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, Sense, Stroke, TextFormat, TextStyle};
use halfvector_codegen::Origin;
use halfvector_graph::document::NodeId;
use halfvector_graph::flatten::find;

use crate::action::{Action, found};
use crate::panes::code::highlight::Span;
use crate::panes::code::lines::Line;
use crate::panes::code::made::Ready;
use crate::panes::code::origin_text;
use crate::session::Session;
use crate::theme;

/// Draws the text; brings the lines of a node into view.
pub(super) fn show(
    ui: &mut egui::Ui,
    session: &Session,
    code: &Ready,
    wanted: Option<&NodeId>,
    actions: &mut Vec<Action>,
) {
    if let Some(note) = &code.note {
        egui::Frame::new().inner_margin(8).show(ui, |ui| ui.label(note));
        return;
    }
    let font = TextStyle::Monospace.resolve(ui.style());
    let (glyph, height) = ui.fonts_mut(|fonts| (fonts.glyph_width(&font, '0'), fonts.row_height(&font)));
    let height = height + 2.0;
    let digits = code.lines.len().to_string().len().max(3) as f32;
    let gutter = glyph * (digits + 2.0) + 6.0;
    let longest = code.lines.iter().map(|line| line.bytes.len()).max().unwrap_or(0) as f32;
    let width = gutter + glyph * (longest + 2.0);
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut area = egui::ScrollArea::both().auto_shrink(false);
    let is_wanted =
        |line: &Line| matches!(&line.origin, Some(Origin::Node(id)) if wanted.is_some() && is_selected(session, id));
    // Where the node is computed; the declaration of its parameter, which stands above, where it is nothing else.
    let computes = |line: &Line| is_wanted(line) && code.text[line.bytes.clone()].contains('=');
    let first = || code.lines.iter().position(computes).or_else(|| code.lines.iter().position(is_wanted));
    if let Some(first) = wanted.and_then(|_| first()) {
        area = area.vertical_scroll_offset((first as f32 - 3.0).max(0.0) * height);
    }
    area.show_rows(ui, height, code.lines.len(), |ui, rows| {
        let width = width.max(ui.available_width());
        for row in rows {
            let (rect, response) = ui.allocate_exact_size(egui::vec2(width, height), Sense::click());
            let line = &code.lines[row];
            draw(ui, session, code, row, rect, gutter, &font, &response);
            response
                .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Label, true, format!("Line {}", row + 1)));
            let response = response.on_hover_ui_at_pointer(|ui| {
                ui.label(origin_text(session, line.origin.as_ref()));
            });
            if let (true, Some(Origin::Node(id))) = (response.clicked(), &line.origin) {
                actions.extend(found(session.document(), id));
            }
        }
    });
}

fn draw(
    ui: &egui::Ui,
    session: &Session,
    code: &Ready,
    row: usize,
    rect: Rect,
    gutter: f32,
    font: &FontId,
    response: &egui::Response,
) {
    let line = &code.lines[row];
    let visuals = ui.visuals();
    let painter = ui.painter();
    if let Some(Origin::Node(id)) = &line.origin {
        if is_selected(session, id) {
            painter.rect_filled(rect, 0.0, theme::ACCENT.gamma_multiply(0.2));
        } else if response.hovered() {
            painter.rect_filled(rect, 0.0, visuals.faint_bg_color);
        }
        let bar = Stroke::new(2.0, theme::ACCENT.gamma_multiply(0.7));
        painter.vline(rect.left() + gutter - 4.0, rect.y_range(), bar);
    }
    let number = Pos2::new(rect.left() + gutter - 10.0, rect.center().y);
    painter.text(number, Align2::RIGHT_CENTER, row + 1, font.clone(), visuals.weak_text_color().gamma_multiply(0.7));
    let job = layout(code, line, font, visuals);
    let galley = painter.layout_job(job);
    painter.galley(Pos2::new(rect.left() + gutter + 2.0, rect.top() + 1.0), galley, visuals.text_color());
}

/// Whether a node that the shader calls by a path is selected on the level that is worked on.
fn is_selected(session: &Session, path: &str) -> bool {
    find(session.document(), path)
        .is_some_and(|(group, node, _)| group == session.group() && session.selection().contains(node))
}

/// One line with its colours.
fn layout(code: &Ready, line: &Line, font: &FontId, visuals: &egui::Visuals) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    let mut push = |bytes: std::ops::Range<usize>, color: Color32| {
        if let Some(text) = code.text.get(bytes).filter(|text| !text.is_empty()) {
            job.append(text, 0.0, TextFormat::simple(font.clone(), color));
        }
    };
    let (plain, colors) = (visuals.text_color(), theme::code_colors(visuals.dark_mode));
    let first = code.spans.partition_point(|span| span.bytes.end <= line.bytes.start);
    let mut at = line.bytes.start;
    for Span { bytes, kind } in code.spans[first..].iter().take_while(|span| span.bytes.start < line.bytes.end) {
        // A comment may begin on a line before and end on one behind.
        let (start, end) = (bytes.start.max(line.bytes.start), bytes.end.min(line.bytes.end));
        push(at..start, plain);
        push(start..end, colors[*kind as usize]);
        at = end;
    }
    push(at..line.bytes.end, plain);
    job
}
