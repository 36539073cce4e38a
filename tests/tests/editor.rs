//! The editor without a window: clicks, drags and keys go in, documents and pictures come out.

mod canvas;
mod cards;
mod clipboard;
mod code;
mod connecting;
mod files;
mod frames;
mod functions;
mod group_files;
mod groups;
mod hands;
mod inspector;
mod keyboard;
mod library;
mod lying_over;
mod measures;
mod opening;
mod palette;
mod recovery;
mod shipped;
mod snapshots;
mod story;
mod undo;
mod viewport;
mod written;

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
    // A frame may ask for work, and only a frame after the work's end takes what it made, which may ask for more.
    let mut idle_frames = 0;
    while idle_frames < 4 {
        harness.step();
        idle_frames = if harness.state().is_idle() { idle_frames + 1 } else { 0 };
        assert!(start.elapsed() < Duration::from_secs(120), "the editor does not come to rest");
        if idle_frames == 0 {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}
