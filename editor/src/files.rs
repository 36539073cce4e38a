//! What the editor reads and writes: materials, the record of what is not saved yet, settings. All of it on one thread, in
//! the order asked for (`clerk`). The window's side of it, with its questions, is `app::files`.

pub(crate) mod clerk;
pub(crate) mod difference;
mod folders;
mod leftovers;
pub(crate) mod record;
pub(crate) mod relative;
pub(crate) mod settings;

pub use folders::Folders;
