//! Environment files: told apart by their first bytes, read within limits, repaired, counted.
//!
//! One module per format; each turns bytes into texels or says which field of the file is wrong. None knows a path.

mod error;
mod exr;
mod hdr;
mod hdre;
mod ktx2;
mod layout;
mod ldr;

pub use error::LoadError;
pub(crate) use hdre::mirrored_sh;
pub use layout::Layout;

use crate::cube::Cube;
use crate::equirect::Equirect;
use crate::repair::{Repairs, repair};
use error::{Fault, field};
use layout::{FACE_NAMES, cube_in_picture};

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
    /// KTX 2.0.
    Ktx2,
    /// An ordinary image: PNG, JPEG, TIFF, WebP, TGA, BMP, QOI.
    Ldr,
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Format::Hdr => "Radiance HDR",
            Format::Exr => "OpenEXR",
            Format::Hdre => "HDRE",
            Format::Ktx2 => "KTX2",
            Format::Ldr => "image",
        })
    }
}

/// The first bytes that show a format; what shows none is tried as an ordinary image.
const SIGNATURES: [(&[u8], Format); 5] = [
    (b"#?", Format::Hdr),
    (b"HDRE", Format::Hdre),
    (&[0x76, 0x2f, 0x31, 0x01], Format::Exr),
    // HDRE written with the other byte order and KTX of any version, so that the message is about that.
    (b"ERDH", Format::Hdre),
    (b"\xabKTX", Format::Ktx2),
];

/// The light of a loaded environment.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// An equirectangular map.
    Equirect(Equirect),
    /// A cube, perhaps with levels filtered by whoever wrote it.
    Levels(StoredLevels),
}

/// The cube of a file, in the crate's own face rules, with the levels that came with it.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredLevels {
    /// At least one. Level 0 is unfiltered radiance unless [`Self::lobe`] says otherwise.
    pub levels: Vec<Cube>,
    /// What the further levels are filtered with.
    pub lobe: StoredLobe,
    /// See [`CubeLevels::slope`](crate::save::CubeLevels::slope); empty when the file has none.
    pub slope: Vec<Vec<f32>>,
    /// Coefficients of [`irradiance_sh2`](crate::environment::irradiance_sh2) from the file, turned like the faces.
    pub irradiance_sh: Option<[[f32; 3]; 9]>,
}

/// What the levels of a file are filtered with.
#[derive(Clone, Debug, PartialEq)]
pub enum StoredLobe {
    /// Nothing tells: only level 0 is of use.
    Unknown,
    /// GGX for a perceptual roughness, 0..1, of each level: rising, as many as there are levels.
    Ggx(Vec<f32>),
    /// HDRE's own cosine power; six levels that the report reads at a roughness of i / 5.
    Hdre {
        /// The version that the header states.
        version: f32,
    },
}

impl StoredLevels {
    /// A cube without further levels.
    pub fn from_cube(cube: Cube) -> StoredLevels {
        StoredLevels { levels: vec![cube], lobe: StoredLobe::Unknown, slope: Vec::new(), irradiance_sh: None }
    }

    /// Whether the levels are GGX for just these values of roughness, up to what a text of a file rounds off.
    pub fn are_ggx_for(&self, roughness: &[f32]) -> bool {
        match &self.lobe {
            StoredLobe::Ggx(stored) => {
                stored.len() == roughness.len() && stored.iter().zip(roughness).all(|(a, b)| (a - b).abs() < 1e-5)
            }
            _ => false,
        }
    }
}

/// An environment, every value finite and within 0..=65504.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedEnvironment {
    /// The light.
    pub source: Source,
    /// How the file held it.
    pub layout: Layout,
    /// Whether it came from an ordinary image, whose values end at 1.
    pub low_dynamic_range: bool,
    /// What was changed to make the values so.
    pub repairs: Repairs,
    /// What the reader made of the file that its owner may not expect, one sentence each.
    pub notes: Vec<String>,
}

impl LoadedEnvironment {
    /// An environment of this light, repaired.
    pub fn new(mut source: Source, low_dynamic_range: bool) -> LoadedEnvironment {
        let mut repairs = Repairs::default();
        let mut mend = |texels: &mut [[f32; 3]]| repairs += repair(texels);
        let layout = match &mut source {
            Source::Equirect(map) => {
                mend(&mut map.pixels);
                Layout::Equirect
            }
            Source::Levels(stored) => {
                stored.levels.iter_mut().for_each(|level| mend(&mut level.texels));
                Layout::Faces
            }
        };
        LoadedEnvironment { source, layout, low_dynamic_range, repairs, notes: Vec::new() }
    }

    /// Of a picture: one map, or the cube that its shape shows.
    fn from_picture(picture: Picture) -> LoadedEnvironment {
        let mut environment = match cube_in_picture(&picture.map) {
            Some((cube, layout)) => LoadedEnvironment {
                layout,
                ..LoadedEnvironment::new(Source::Levels(StoredLevels::from_cube(cube)), picture.low_dynamic_range)
            },
            None => LoadedEnvironment::new(Source::Equirect(picture.map), picture.low_dynamic_range),
        };
        environment.notes = picture.notes;
        if let Source::Equirect(map) = &environment.source
            && map.width != 2 * map.height
            && map.width * map.height > 1
        {
            environment.notes.push(format!(
                "{} x {} is the shape neither of an equirectangular map (2 x 1) nor of a cross (4 x 3, 3 x 4) or strip \
                 (6 x 1, 1 x 6) of cube faces; it is taken as an equirectangular map",
                map.width, map.height
            ));
        }
        environment
    }
}

/// The texels of a file that holds a picture, before it is known what the picture shows.
struct Picture {
    map: Equirect,
    low_dynamic_range: bool,
    notes: Vec<String>,
}

/// What a reader makes of the bytes.
enum Content {
    Picture(Picture),
    Levels(StoredLevels, Vec<String>),
}

/// Reads an environment file within the default [`Limits`].
///
/// `file_name` is for the messages only: the format is told by the first bytes. Whether a picture is one map of all
/// directions or a cross or strip of cube faces is told by its shape: [`Layout`].
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
    Ok(match content(bytes, file_name, limits)? {
        Content::Picture(picture) => LoadedEnvironment::from_picture(picture),
        Content::Levels(stored, notes) => {
            LoadedEnvironment { notes, ..LoadedEnvironment::new(Source::Levels(stored), false) }
        }
    })
}

fn content(bytes: &[u8], file_name: &str, limits: Limits) -> Result<Content, LoadError> {
    if bytes.is_empty() {
        return Err(LoadError::Empty { file: file_name.to_owned() });
    }
    let format =
        SIGNATURES.iter().find(|(start, _)| bytes.starts_with(start)).map_or(Format::Ldr, |&(_, format)| format);
    match format {
        Format::Hdr => hdr::read(bytes, limits).map(Content::Picture),
        Format::Exr => exr::read(bytes, limits),
        Format::Hdre => hdre::read(bytes, limits).map(|stored| Content::Levels(stored, Vec::new())),
        Format::Ktx2 => ktx2::read(bytes, limits),
        Format::Ldr => ldr::read(bytes, limits).map(Content::Picture),
    }
    .map_err(|fault| fault.named(file_name, format))
}

/// Reads six files, each with its name, as the faces +X -X +Y -Y +Z -Z of a cube, by the GPU's own face rules.
///
/// # Errors
/// As [`load`]; and when one is not square, of another size than the first, or holds more than a picture.
pub fn load_faces(files: [(&[u8], &str); 6]) -> Result<LoadedEnvironment, LoadError> {
    let mut texels = Vec::new();
    let (mut size, mut low_dynamic_range, mut notes) = (0, true, Vec::new());
    for ((bytes, file), face) in files.into_iter().zip(FACE_NAMES) {
        let wrong = |reason: String| Err(LoadError::Face { file: file.to_owned(), face, reason });
        let picture = match content(bytes, file, Limits::default())? {
            Content::Picture(picture) => picture,
            Content::Levels(..) => return wrong("the file holds a whole cube; name it alone".to_owned()),
        };
        let (width, height) = (picture.map.width, picture.map.height);
        if width != height {
            return wrong(format!("a face must be square, and this is {width} x {height}"));
        }
        if size != 0 && width != size {
            return wrong(format!("it is {width} x {width} and the face {} is {size} x {size}", FACE_NAMES[0]));
        }
        size = width;
        low_dynamic_range &= picture.low_dynamic_range;
        notes.extend(picture.notes.into_iter().map(|note| format!("{file}: {note}")));
        texels.extend(picture.map.pixels);
    }
    let source = Source::Levels(StoredLevels::from_cube(Cube { size, texels }));
    Ok(LoadedEnvironment { notes, ..LoadedEnvironment::new(source, low_dynamic_range) })
}

/// Numbers between commas, 0..1, not falling, one for each level.
fn roughness_list(text: &str, levels: usize) -> Result<Vec<f32>, String> {
    let numbers: Vec<f32> =
        text.split(',').map(|word| word.trim().parse().ok()).collect::<Option<_>>().unwrap_or_default();
    if numbers.len() != levels {
        return Err(format!("\"{text}\" is not {levels} numbers between commas, one for each level"));
    }
    if !numbers.iter().all(|r| (0.0..=1.0).contains(r)) || !numbers.is_sorted() {
        return Err(format!("\"{text}\" does not rise from 0 to 1"));
    }
    Ok(numbers)
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
