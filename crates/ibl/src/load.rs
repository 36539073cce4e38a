//! Environment files: told apart by their first bytes, read within limits, repaired, counted.
//!
//! One module per format; each turns bytes into texels or says which field of the file is wrong. None knows a path.

mod exr;
mod hdr;
mod hdre;
mod ldr;

use crate::cube::Cube;
use crate::equirect::Equirect;
use crate::repair::{Repairs, repair};

/// What an environment may cost at most, checked before texels are allocated. The default takes a 16384 x 8192 map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most texels of a map, or of all levels and faces of a cube.
    pub max_texels: u64,
    /// Largest width or height.
    pub max_edge: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { max_texels: 1 << 27, max_edge: 32768 }
    }
}

/// The format of an environment file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Radiance `.hdr` / `.pic`.
    Hdr,
    /// OpenEXR.
    Exr,
    /// HDRE 2.0 to 3.0.
    Hdre,
    /// An ordinary image: PNG, JPEG, TIFF, WebP, TGA, BMP.
    Ldr,
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Format::Hdr => "Radiance HDR",
            Format::Exr => "OpenEXR",
            Format::Hdre => "HDRE",
            Format::Ldr => "image",
        })
    }
}

/// The first bytes that show a format; what shows none is tried as an ordinary image.
const SIGNATURES: [(&[u8], Format); 4] = [
    (b"#?", Format::Hdr),
    (b"HDRE", Format::Hdre),
    (&[0x76, 0x2f, 0x31, 0x01], Format::Exr),
    // HDRE written with the other byte order, so that the message is about that.
    (b"ERDH", Format::Hdre),
];

/// The light of a loaded environment.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// An equirectangular map.
    Equirect(Equirect),
    /// A cube that came with levels filtered by whoever wrote it.
    Levels(StoredLevels),
}

/// The six levels of an HDRE file, in the crate's own face rules.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredLevels {
    /// Level 0 is unfiltered radiance; the further ones are filtered, not by GGX.
    pub levels: Vec<Cube>,
    /// Coefficients of [`irradiance_sh2`](crate::environment::irradiance_sh2) from the file, turned like the faces.
    pub irradiance_sh: Option<[[f32; 3]; 9]>,
    /// The version that the header states.
    pub version: f32,
}

/// An environment, every value finite and within 0..=65504.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedEnvironment {
    /// The light.
    pub source: Source,
    /// Whether it came from an ordinary image, whose values end at 1.
    pub low_dynamic_range: bool,
    /// What was changed to make the values so.
    pub repairs: Repairs,
}

impl LoadedEnvironment {
    /// An environment of this light, repaired.
    pub fn new(mut source: Source, low_dynamic_range: bool) -> LoadedEnvironment {
        let mut repairs = Repairs::default();
        let mut mend = |texels: &mut [[f32; 3]]| {
            let found = repair(texels);
            repairs.not_a_number += found.not_a_number;
            repairs.negative += found.negative;
            repairs.too_bright += found.too_bright;
        };
        match &mut source {
            Source::Equirect(map) => mend(&mut map.pixels),
            Source::Levels(stored) => stored.levels.iter_mut().for_each(|level| mend(&mut level.texels)),
        }
        LoadedEnvironment { source, low_dynamic_range, repairs }
    }
}

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
    /// Neither an environment nor an ordinary image.
    #[error("{file}: {reason}")]
    Image {
        /// The file's name, as the caller gave it.
        file: String,
        /// The reason.
        reason: halfvector_maps::DecodeError,
    },
}

/// What a reader found wrong, before the file's name is put to it.
enum Fault {
    Field(String, String),
    Truncated(String),
    TooLarge { width: u64, height: u64, limit: String },
    Image(halfvector_maps::DecodeError),
}

/// A field and what is wrong with it.
fn field(field: impl Into<String>, reason: impl Into<String>) -> Fault {
    Fault::Field(field.into(), reason.into())
}

/// Reads an environment file within the default [`Limits`].
///
/// `file_name` is for the messages only: the format is told by the first bytes.
///
/// # Errors
/// [`LoadError`] says which field of the file is wrong.
pub fn load(bytes: &[u8], file_name: &str) -> Result<LoadedEnvironment, LoadError> {
    load_within(bytes, file_name, Limits::default())
}

/// Reads an environment file within limits; see [`load`].
///
/// # Errors
/// [`LoadError`] says which field of the file is wrong.
pub fn load_within(bytes: &[u8], file_name: &str, limits: Limits) -> Result<LoadedEnvironment, LoadError> {
    let format =
        SIGNATURES.iter().find(|(start, _)| bytes.starts_with(start)).map_or(Format::Ldr, |&(_, format)| format);
    let (source, low_dynamic_range) = match format {
        Format::Hdr => hdr::read(bytes, limits).map(|map| (Source::Equirect(map), false)),
        Format::Exr => exr::read(bytes, limits).map(|map| (Source::Equirect(map), false)),
        Format::Hdre => hdre::read(bytes, limits).map(|levels| (Source::Levels(levels), false)),
        Format::Ldr => ldr::read(bytes, limits).map(|(map, low)| (Source::Equirect(map), low)),
    }
    .map_err(|fault| {
        let file = file_name.to_owned();
        match fault {
            Fault::Field(field, reason) => LoadError::Field { file, format, field, reason },
            Fault::Truncated(field) => LoadError::Truncated { file, format, field },
            Fault::TooLarge { width, height, limit } => LoadError::TooLarge { file, format, width, height, limit },
            Fault::Image(reason) => LoadError::Image { file, reason },
        }
    })?;
    Ok(LoadedEnvironment::new(source, low_dynamic_range))
}

/// Refuses sizes of 0 and beyond the limits; gives the number of texels.
fn checked_texels(width: u64, height: u64, limits: Limits) -> Result<usize, Fault> {
    if width == 0 || height == 0 {
        return Err(field("size", format!("it says {width} x {height}, which holds nothing; save the file again")));
    }
    if width > limits.max_edge || height > limits.max_edge {
        return Err(Fault::TooLarge { width, height, limit: format!("{} texels along an edge", limits.max_edge) });
    }
    let texels = width * height;
    match usize::try_from(texels) {
        Ok(count) if texels <= limits.max_texels => Ok(count),
        _ => Err(Fault::TooLarge { width, height, limit: format!("{} texels", limits.max_texels) }),
    }
}
