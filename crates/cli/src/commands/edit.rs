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
    // What is there and cannot be read is told in the window, which does not write over it; without a window here.
    let mut broken = args.document.as_deref().and_then(|path| crate::input::material(path).err());
    let is_there = args.document.as_deref().is_some_and(std::path::Path::exists);
    if let Some(failure) = broken.take_if(|_| !is_there) {
        return Err(failure);
    }
    match halfvector_editor::run(Options {
        document: args.document.clone(),
        folders: Folders::of_user(),
        ..Options::default()
    }) {
        Ok(()) => Ok(0),
        Err(error) => Err(broken.unwrap_or_else(|| {
            Failure::input("the editor did not open")
                .because(error)
                .try_to("`halfvector render` and `halfvector export`, which need no window")
        })),
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
