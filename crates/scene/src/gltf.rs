//! glTF 2.0 files (Khronos 2021): `.glb` and `.gltf` become meshes, material documents, objects, lights and a camera.
//!
//! The JSON is read into the types of the `gltf` crate; containers, buffers and accessors are read here, with limits, so
//! that a hostile file is refused and never a panic. Skins, morph targets and animations are passed over with
//! a note.

mod accessor;
mod asset;
mod material;
mod model;
mod uri;

use std::path::{Path, PathBuf};

pub use asset::{Asset, MAX_FILE_BYTES};
pub use model::{Model, from_asset, load};

/// Why a glTF file was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GltfError {
    /// A file could not be read.
    #[error("the model {} could not be read: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The content is wrong.
    #[error("the model {}: {place}: {reason}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// The part of the file, such as `accessors[3]`.
        place: String,
        /// What is wrong, and what to do.
        reason: String,
    },
}

/// What is wrong and where, before the file's name is known.
type Result<T> = std::result::Result<T, Fault>;

/// A [`GltfError::Content`] without its file.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fault {
    place: String,
    reason: String,
}

impl Fault {
    fn new(place: impl Into<String>, reason: impl Into<String>) -> Fault {
        Fault { place: place.into(), reason: reason.into() }
    }

    fn of(self, path: &Path) -> GltfError {
        GltfError::Content { path: path.to_owned(), place: self.place, reason: self.reason }
    }
}

/// The entry of a list that an index of the file names.
fn entry<'a, T>(list: &'a [T], name: &str, index: usize, place: &str) -> Result<&'a T> {
    list.get(index).ok_or_else(|| {
        Fault::new(place, format!("it refers to {name}[{index}], and the file has {} of them", list.len()))
    })
}

/// Whether a name ends like that of a glTF file.
pub(crate) fn has_gltf_extension(name: &str) -> bool {
    let extension = Path::new(name).extension().and_then(|e| e.to_str()).unwrap_or_default();
    extension.eq_ignore_ascii_case("glb") || extension.eq_ignore_ascii_case("gltf")
}
