//! Why a file did not become an environment, in the user's words.

use super::Format;

/// Why a file did not become an environment.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A field holds what it must not, or contradicts another or the file's length.
    #[error("{file}: {format} file, {field}: {reason}")]
    Field {
        /// The file's name, as the caller gave it.
        file: String,
        /// The format.
        format: Format,
        /// The field, in the format's own words.
        field: String,
        /// What is wrong with it and what to do.
        reason: String,
    },
    /// The file ends before what its header promises.
    #[error("{file}: {format} file ends within {field}; copy or download it again")]
    Truncated {
        /// The file's name, as the caller gave it.
        file: String,
        /// The format.
        format: Format,
        /// What was being read.
        field: String,
    },
    /// Larger than the limits allow; nothing was allocated for it.
    #[error("{file}: {format} file, size: {width} x {height} is more than the limit of {limit}; make it smaller")]
    TooLarge {
        /// The file's name, as the caller gave it.
        file: String,
        /// The format.
        format: Format,
        /// The width that the header states.
        width: u64,
        /// The height that the header states.
        height: u64,
        /// The limit, in words.
        limit: String,
    },
    /// An ordinary image that is damaged, too large or of an unusual kind.
    #[error("{file}: {reason}")]
    Image {
        /// The file's name, as the caller gave it.
        file: String,
        /// The reason.
        reason: halfvector_maps::DecodeError,
    },
    /// The bytes start like no format that is read here.
    #[error(
        "{file}: not an environment that can be read here: it starts like no Radiance .hdr, OpenEXR, HDRE, KTX2, PNG, JPEG, \
         TIFF, WebP, TGA, BMP or QOI file; convert it to one of these"
    )]
    UnknownFormat {
        /// The file's name, as the caller gave it.
        file: String,
    },
    /// There are no bytes.
    #[error("{file}: the file is empty; copy or download it again")]
    Empty {
        /// The file's name, as the caller gave it.
        file: String,
    },
    /// One of six faces does not fit the others.
    #[error("{file}: as the face {face} of a cube: {reason}")]
    Face {
        /// The file's name, as the caller gave it.
        file: String,
        /// Which face: +X, -X, +Y, -Y, +Z or -Z.
        face: &'static str,
        /// What is wrong with it and what to do.
        reason: String,
    },
}

/// What a reader found wrong, before the file's name is put to it.
pub(super) enum Fault {
    Field(String, String),
    Truncated(String),
    TooLarge { width: u64, height: u64, limit: String },
    Image(halfvector_maps::DecodeError),
}

/// A field and what is wrong with it.
pub(super) fn field(field: impl Into<String>, reason: impl Into<String>) -> Fault {
    Fault::Field(field.into(), reason.into())
}

impl Fault {
    /// With the file's name and format.
    pub(super) fn named(self, file_name: &str, format: Format) -> LoadError {
        let file = file_name.to_owned();
        match self {
            Fault::Field(field, reason) => LoadError::Field { file, format, field, reason },
            Fault::Truncated(field) => LoadError::Truncated { file, format, field },
            Fault::TooLarge { width, height, limit } => LoadError::TooLarge { file, format, width, height, limit },
            Fault::Image(halfvector_maps::DecodeError::UnknownFormat) => LoadError::UnknownFormat { file },
            Fault::Image(reason) => LoadError::Image { file, reason },
        }
    }
}
