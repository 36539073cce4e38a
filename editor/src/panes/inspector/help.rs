//! The help of a node: paragraphs, equations, `code`. As much Markdown as doc comments of nodes have.

use eframe::egui::{self, FontFamily, FontId, TextFormat, TextStyle, text::LayoutJob};

/// Draws a help text.
pub(crate) fn show(ui: &mut egui::Ui, help: &str) {
    let mut paragraph = String::new();
    let mut block: Option<Vec<&str>> = None;
    for line in help.lines() {
        match (&mut block, line.trim_start().starts_with("```")) {
            (Some(lines), true) => {
                equation(ui, lines);
                block = None;
            }
            (Some(lines), false) => lines.push(line),
            (None, true) => {
                flush(ui, &mut paragraph);
                block = Some(Vec::new());
            }
            (None, false) if line.trim().is_empty() => flush(ui, &mut paragraph),
            (None, false) => {
                // Lines that are set in belong to an equation even without a fence.
                if line.starts_with("  ") {
                    flush(ui, &mut paragraph);
                    equation(ui, &[line]);
                } else {
                    paragraph.push_str(line.trim());
                    paragraph.push(' ');
                }
            }
        }
    }
    flush(ui, &mut paragraph);
    if let Some(lines) = block {
        equation(ui, &lines);
    }
}

fn flush(ui: &mut egui::Ui, paragraph: &mut String) {
    let text = std::mem::take(paragraph);
    if !text.trim().is_empty() {
        ui.add(egui::Label::new(words(ui, text.trim())).wrap());
        ui.add_space(2.0);
    }
}

/// A paragraph with its `code` in another face.
fn words(ui: &egui::Ui, text: &str) -> LayoutJob {
    let body = TextStyle::Body.resolve(ui.style());
    let visuals = ui.visuals();
    let plain = TextFormat::simple(body.clone(), visuals.text_color());
    let code = TextFormat {
        background: visuals.code_bg_color,
        ..TextFormat::simple(FontId::new(body.size, FontFamily::Monospace), visuals.text_color())
    };
    let mut job = LayoutJob::default();
    for (place, part) in text.split('`').enumerate() {
        job.append(part, 0.0, if place % 2 == 1 { code.clone() } else { plain.clone() });
    }
    job
}

fn equation(ui: &mut egui::Ui, lines: &[&str]) {
    let indent =
        lines.iter().filter(|line| !line.trim().is_empty()).map(|line| line.len() - line.trim_start().len()).min();
    let cut = |line: &&str| line.get(indent.unwrap_or(0)..).unwrap_or_default().to_owned();
    let text = lines.iter().map(cut).collect::<Vec<_>>().join("\n");
    egui::Frame::new().fill(ui.visuals().code_bg_color).corner_radius(4).inner_margin(6).show(ui, |ui| {
        egui::ScrollArea::horizontal().id_salt(&text).auto_shrink([false, true]).show(ui, |ui| {
            ui.add(egui::Label::new(egui::RichText::new(text.as_str()).monospace()).extend());
        });
    });
    ui.add_space(2.0);
}
