//! The window on a graph of 500 nodes: the processor's time for a frame while the graph is panned, from the events to the
//! triangles. No GPU is asked; the picture and the shader are made before, on their own threads, and rest.
//!
//! 60 frames a second leave 16.7 ms; 8 ms are the goal.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use halfvector_editor::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};
use halfvector_editor::{Editor, Options};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::file::save;

const NODES: usize = 500;
const COLUMNS: usize = 25;

/// Rows of nodes of several kinds; each is fed by its neighbours to the left and above. The surface stands apart, so that the
/// picture is soon there.
fn many_nodes() -> Document {
    let kinds = [
        ("math/mix", ["a", "b"]),
        ("math/multiply_add", ["a", "b"]),
        ("math/clamp", ["x", "low"]),
        ("math/smoothstep", ["low", "x"]),
    ];
    let mut document = Document::with_surface("500 nodes");
    document.graph.layout.insert("surface".into(), [-400.0, 0.0]);
    let id = |i: usize| format!("node_{i}");
    for i in 0..NODES - 1 {
        let (column, row) = (i % COLUMNS, i / COLUMNS);
        let (definition, inputs) = kinds[(i * 7 + row) % kinds.len()];
        document.graph.nodes.insert(id(i), Node::new(definition));
        document.graph.layout.insert(id(i), [column as f32 * 230.0, row as f32 * 150.0]);
        for (from, input) in [(column.checked_sub(1).map(|_| i - 1), inputs[0]), (i.checked_sub(COLUMNS), inputs[1])] {
            if let Some(from) = from {
                document.graph.links.push(Link::new(SocketRef::new(&id(from), "out"), SocketRef::new(&id(i), input)));
            }
        }
    }
    document
}

/// A window without a screen, and the time in it.
struct Window {
    context: Context,
    editor: Editor,
    frame: u32,
}

impl Window {
    fn frame(&mut self, events: Vec<Event>) -> usize {
        self.frame += 1;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(1920.0, 1080.0))),
            time: Some(f64::from(self.frame) / 60.0),
            events,
            ..RawInput::default()
        };
        let mut output = self.context.run_ui(input, |ui| self.editor.show(ui));
        // Nothing is uploaded where there is no GPU.
        output.textures_delta.clear();
        let primitives = self.context.tessellate(output.shapes, output.pixels_per_point);
        black_box(primitives).len()
    }
}

fn pan(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder for the document");
    let path = folder.path().join("many.material.json");
    save(&path, &many_nodes()).expect("the document is written");
    let context = Context::default();
    let editor = Editor::new(&context, Options { document: Some(path), ..Options::default() });
    let mut window = Window { context, editor, frame: 0 };
    let start = Instant::now();
    while window.frame < 10 || !window.editor.is_idle() {
        window.frame(Vec::new());
        assert!(start.elapsed() < Duration::from_secs(300), "the window does not come to rest");
        std::thread::sleep(Duration::from_millis(10));
    }
    let middle = pos2(500.0, 350.0);
    let button =
        |pressed, pos| Event::PointerButton { pos, button: PointerButton::Middle, pressed, modifiers: Modifiers::NONE };
    let mut group = c.benchmark_group("editor");
    // All nodes at once; then as large as one works on them.
    for (name, zoom) in [("pan 500 nodes, all in view", None), ("pan 500 nodes, at zoom 0.6", Some(0.6_f32))] {
        if let Some(zoom) = zoom {
            // From anywhere to life size by the key, then smaller.
            window.frame(vec![Event::PointerMoved(middle)]);
            let key = |pressed| Event::Key {
                key: halfvector_editor::egui::Key::Num1,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            };
            window.frame(vec![key(true)]);
            window.frame(vec![key(false), Event::Zoom(zoom)]);
        }
        window.frame(vec![Event::PointerMoved(middle)]);
        window.frame(vec![button(true, middle)]);
        let mut turn = 0.0_f32;
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                turn += 0.05;
                let at = middle + vec2(turn.cos(), turn.sin()) * 120.0;
                window.frame(vec![Event::PointerMoved(at)])
            });
        });
        window.frame(vec![button(false, middle)]);
    }
    group.finish();
}

criterion_group!(benches, pan);
criterion_main!(benches);
