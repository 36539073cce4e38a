//! `halfvector edit`: the window.

use std::path::PathBuf;

use halfvector_editor::{EditorError, Folders, Options};

use crate::commands::first_light;
use crate::failure::Failure;
use crate::output::note;

/// Opens the editor.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:
  halfvector edit examples/car-paint.material.json")]
pub(crate) struct EditArgs {
    /// A material (*.material.json); a new one when absent
    #[arg(value_name = "DOC")]
    document: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(args: &EditArgs) -> Result<u8, Failure> {
    if let Some(path) = &args.document {
        crate::input::material(path)?;
    }
    match halfvector_editor::run(Options {
        document: args.document.clone(),
        folders: Folders::of_user(),
        ..Options::default()
    }) {
        Ok(()) => Ok(0),
        Err(error) => Err(Failure::input("the editor did not open")
            .because(error)
            .try_to("`halfvector render` and `halfvector export`, which need no window")),
    }
}

/// Opens the editor with the start material; where there is no display, draws that instead.
pub(crate) fn run_or_draw() -> Result<u8, Failure> {
    match halfvector_editor::run(Options { folders: Folders::of_user(), ..Options::default() }) {
        Ok(()) => Ok(0),
        Err(error @ (EditorError::NoDisplay | EditorError::Window(_))) => {
            note(format_args!(
                "note: {error}. The start material is drawn to out/ instead; `halfvector --help` lists the commands."
            ));
            first_light::run()
        }
    }
}
