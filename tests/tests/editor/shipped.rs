//! The graphs of the materials that come with the program can be read: no card touches another one.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::{NodeT, Queryable};
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::Document;
use halfvector_graph::file::from_json;

use egui::accesskit::Role;

use super::hands::*;
use super::open;

// Measures of the canvas: heights of a title and of a row, and the least free space between cards.
const HEADER: f32 = 26.0;
const ROW: f32 = 21.0;
const FREE: f32 = 8.0;

fn materials() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let files = ["editor/library", "examples"].map(|folder| std::fs::read_dir(root.join(folder)).expect("a folder"));
    let files = files.into_iter().flatten().flatten().map(|file| file.path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.to_string_lossy().ends_with(".material.json")).collect();
    files.sort();
    files
}

/// The cards of the graph that is shown, in its units, by title.
fn cards(window: &Window) -> Vec<(String, egui::Rect)> {
    let labelled = |role: Role, start: &str| {
        let nodes =
            window.query_all_by_role(role).filter_map(|node| Some((node.accesskit_node().label()?, node.rect())));
        nodes.filter(|(label, _)| label.starts_with(start)).collect::<Vec<_>>()
    };
    let sockets: Vec<_> = ["Input ", "Output "].into_iter().flat_map(|start| labelled(Role::Button, start)).collect();
    let nodes = labelled(Role::ListItem, "Node ");
    let zoom = nodes.first().map_or(1.0, |(_, rect)| rect.height() / HEADER);
    let titles = nodes.into_iter().map(|(label, rect)| (label["Node ".len()..].to_owned(), rect));
    titles
        .map(|(title, header)| {
            let own = sockets.iter().filter(|(label, _)| label.ends_with(&format!(" of {title}")));
            let at_edge = |x: f32| (x - header.left()).abs() < 2.0 || (x - header.right()).abs() < 2.0;
            let own = own.map(|(_, rect)| rect.center()).filter(|at| at_edge(at.x) && at.y > header.top());
            let bottom = own.map(|at| at.y + ROW * zoom).fold(header.bottom(), f32::max);
            (title, header.with_max_y(bottom) / zoom)
        })
        .collect()
}

fn touching(window: &Window) -> Vec<String> {
    let cards = cards(window);
    let pairs = cards.iter().enumerate().flat_map(|(i, a)| cards[..i].iter().map(move |b| (a, b)));
    let touch = pairs.filter(|(a, b)| a.1.expand(FREE / 2.0).intersects(b.1.expand(FREE / 2.0)));
    touch.map(|(a, b)| format!("{} and {}", a.0, b.0)).collect()
}

#[test]
fn cards_of_what_is_shipped_stand_apart() {
    let mut window = open(Options { without_gpu: true, ..Options::default() });
    window.set_size(egui::vec2(2400.0, 1800.0));
    let mut wrong = Vec::new();
    for path in materials() {
        let text = std::fs::read_to_string(&path).expect("text");
        let Ok(document): Result<Document, _> = from_json(&text) else { continue };
        window.state_mut().act(Action::NewFrom(Arc::new(document)));
        window.run_steps(3);
        let touching = touching(&window);
        if !touching.is_empty() {
            if std::env::var_os("REARRANGE").is_some() {
                let at = empty_place(&window);
                go(&mut window, at);
                key(&mut window, egui::Modifiers::NONE, egui::Key::L);
                std::fs::write(&path, self::text(&window)).expect("written");
                window.state_mut().act(Action::Undo);
            }
            wrong.push(format!("{}: {}", path.display(), touching.join(", ")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
