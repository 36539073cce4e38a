//! The Halfvector editor: a material as a node graph, its picture, its shader and its problems in one window.
//!
//! Reading order: `action` (what a person can do), `session` (the document, its history and selection), `files` (what stands on disk), `stage` (what the
//! material is seen on), `work` and `paint` (what runs on other threads), `app` (the window), `panes` (its parts).
//!
//! The document is the only truth. Panes read it and return [`Action`]s; nobody but [`Session`] changes it. No pane waits
//! for a shader, a picture or a file. Shading, checking and drawing are the other crates' work.

mod accuracy;
mod action;
mod app;
mod colors;
mod dropped;
mod environments;
mod files;
mod functions;
mod history;
mod library;
mod paint;
mod palette;
mod panes;
mod pictures;
mod session;
mod sockets;
mod stage;
mod theme;
mod thumbnails;
mod work;
pub mod written;

use std::path::PathBuf;

pub use action::{Action, Choose};
pub use app::{Editor, Pane};
pub use eframe::egui;
pub use files::Folders;
pub use session::{START_MATERIAL, Session};
pub use stage::{Lamp, LampKind, Orbit, Stage};

/// What the editor opens with.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A `*.material.json` file; the start material when absent.
    pub document: Option<PathBuf>,
    /// Draws on the CPU, as if there were no graphics card.
    pub without_gpu: bool,
    /// Where settings and unsaved work are kept; nothing is without.
    pub folders: Folders,
}

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum EditorError {
    /// There is no screen to open a window on.
    #[error("there is no display: neither WAYLAND_DISPLAY nor DISPLAY is set")]
    NoDisplay,
    /// The window system or the GPU refused.
    #[error("the window could not be opened: {0}")]
    Window(String),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// When there is no display, or the window does not open.
pub fn run(options: Options) -> Result<(), EditorError> {
    if !has_display() {
        return Err(EditorError::NoDisplay);
    }
    let native = eframe::NativeOptions {
        viewport: eframe::egui::ViewportBuilder::default()
            .with_title("Halfvector")
            .with_app_id("halfvector")
            .with_inner_size([1440.0, 900.0])
            .with_min_inner_size([640.0, 400.0]),
        ..Default::default()
    };
    eframe::run_native(
        "halfvector",
        native,
        Box::new(move |context| Ok(Box::new(Editor::new(&context.egui_ctx, options)))),
    )
    .map_err(|error| EditorError::Window(error.to_string()))
}

/// Whether a window can be hoped for: on Unix without macOS, whether a display server is named.
fn has_display() -> bool {
    let named = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || named("WAYLAND_DISPLAY") || named("DISPLAY")
}
