//! Levels of a cube as the bytes of a file: KTX2 for engines, HDRE, EXR strips to look at and to edit.
//!
//! The same levels give the same bytes. It writes no file: paths are the caller's.

mod exr;
mod hdre;
mod ktx2;

pub use exr::exr;
pub use hdre::{HDRE_LEVELS, hdre, hdre_face};
pub use ktx2::{TexelFormat, ktx2};

use crate::cube::Cube;

/// What the levels of a file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CubeContent {
    /// Radiance, each level prefiltered with GGX for its roughness.
    Radiance,
    /// Diffuse irradiance over pi.
    IrradianceOverPi,
}

impl CubeContent {
    /// The words that stand in files.
    pub fn name(self) -> &'static str {
        match self {
            CubeContent::Radiance => "GGX-prefiltered radiance",
            CubeContent::IrradianceOverPi => "irradiance over pi",
        }
    }
}

/// Levels of a cube and what they are.
#[derive(Clone, Copy, Debug)]
pub struct CubeLevels<'a> {
    /// Each with half of the texels of the one before along an edge, rounded down, at least 1 (see [`hdre`] for its own
    /// rule).
    pub levels: &'a [Cube],
    /// The perceptual roughness, 0..1, of each level; as many as there are levels for radiance, none for irradiance.
    pub roughness: &'a [f32],
    /// For each level and texel, how log2(red + green + blue) changes from level to level, as a derivative; empty when it
    /// is not known. It is stored as alpha where a format has one, and alpha is 1 else.
    pub slope: &'a [Vec<f32>],
    /// What the texels are.
    pub content: CubeContent,
}

impl<'a> CubeLevels<'a> {
    /// Radiance prefiltered for these values of roughness, one for each level.
    pub fn radiance(levels: &'a [Cube], roughness: &'a [f32]) -> CubeLevels<'a> {
        CubeLevels { levels, roughness, slope: &[], content: CubeContent::Radiance }
    }

    /// Diffuse irradiance over pi.
    pub fn irradiance_over_pi(cube: &'a Cube) -> CubeLevels<'a> {
        CubeLevels {
            levels: std::slice::from_ref(cube),
            roughness: &[],
            slope: &[],
            content: CubeContent::IrradianceOverPi,
        }
    }
}

/// Why levels cannot be written in a format.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// There is no level, or a level has another size than the format has there.
    #[error("level {level} of the cube has {found} texels along an edge, and the format needs {needed}")]
    Size {
        /// Which level.
        level: usize,
        /// Its texels along an edge; 0 when there is no such level.
        found: usize,
        /// What the format needs.
        needed: usize,
    },
    /// There are more levels than halvings of the size, or another number than the format has.
    #[error("{found} levels, and the format takes {needed} of this size")]
    Levels {
        /// How many there are.
        found: usize,
        /// How many the format takes, in words.
        needed: String,
    },
    /// The encoder of the format refused.
    #[error("the picture could not be coded: {0}")]
    Encoder(String),
}

/// The levels below each other, each as a strip of its faces +X -X +Y -Y +Z -Z, as one picture: width, height and texels
/// row by row. What no level covers is black.
pub fn strip(levels: &[Cube]) -> (usize, usize, Vec<[f32; 3]>) {
    let width = 6 * levels.iter().map(|level| level.size).max().unwrap_or(0);
    let height = levels.iter().map(|level| level.size).sum();
    let mut texels = vec![[0.0; 3]; width * height];
    let mut top = 0;
    for level in levels {
        for (k, row) in level.texels.chunks_exact(level.size).enumerate() {
            let (face, j) = (k / level.size, k % level.size);
            let start = (top + j) * width + face * level.size;
            texels[start..start + level.size].copy_from_slice(row);
        }
        top += level.size;
    }
    (width, height, texels)
}

/// The number of texels along an edge of level 0.
fn face_size(levels: &[Cube]) -> Result<usize, SaveError> {
    match levels.first() {
        Some(level) if level.size > 0 => Ok(level.size),
        _ => Err(SaveError::Size { level: 0, found: 0, needed: 1 }),
    }
}
