//! The editor without a window: clicks, drags and keys go in, documents and pictures come out.

mod canvas;
mod code;
mod files;
mod functions;
mod groups;
mod hands;
mod inspector;
mod library;
mod measures;
mod opening;
mod palette;
mod snapshots;
mod story;
mod undo;
mod viewport;

use std::time::{Duration, Instant};

use egui_kittest::Harness;
use halfvector_editor::{Editor, Options};

/// An editor of a window's usual size.
fn open(options: Options) -> Harness<'static, Editor> {
    Harness::builder().with_size([1440.0, 900.0]).build_eframe(|context| Editor::new(&context.egui_ctx, options))
}

/// Draws frames until the threads of the editor have nothing to do and what they made is shown.
fn settle(harness: &mut Harness<'_, Editor>) {
    let start = Instant::now();
    loop {
        harness.step();
        if harness.state().is_idle() {
            // What came in with the last frame may ask for more.
            harness.step();
            harness.step();
            if harness.state().is_idle() {
                return;
            }
        }
        assert!(start.elapsed() < Duration::from_secs(120), "the editor does not come to rest");
        std::thread::sleep(Duration::from_millis(5));
    }
}
