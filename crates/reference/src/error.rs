//! What can go wrong, in the user's words.

/// Why a scene is not rendered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReferenceError {
    /// A material is no shader, or one that the interpreter does not run.
    #[error("the material `{material}` cannot be evaluated: {why}")]
    Material {
        /// Its name.
        material: String,
        /// Why.
        why: String,
    },
    /// A picture that a material reads was not loaded.
    #[error("the material `{material}` reads {file}, which is not loaded")]
    MissingImage {
        /// Its name.
        material: String,
        /// The file.
        file: String,
    },
    /// An object without its mesh or material.
    #[error("object {object} wants {what} {index}, but there are only {count}")]
    Missing {
        /// Number of the object.
        object: usize,
        /// "mesh" or "material".
        what: &'static str,
        /// What it wants.
        index: usize,
        /// What there is.
        count: usize,
    },
    /// A size of 0, or too large.
    #[error(
        "a picture of {width} x {height} cannot be rendered; the reference takes at most 2^25 pixels, such as 8192 x 4096"
    )]
    PictureSize {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A method that the reference has no truth for.
    #[error("the reference has no {term}={method}: {remedy}")]
    Method {
        /// The term of shading.
        term: &'static str,
        /// The method.
        method: &'static str,
        /// What to choose instead.
        remedy: &'static str,
    },
}
