//! Which environment surrounds a scene, and what is seen behind the objects. Baking it is not done here.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use halfvector_ibl::LoadedEnvironment;

/// Largest environment file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Which environment.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum EnvironmentSource {
    /// Radiance 1 from everywhere.
    White,
    /// Softboxes before a grey surround.
    Studio,
    /// A clear sky with a sun.
    Sky,
    /// An `.hdr`, `.exr` or `.hdre` file, or an ordinary image.
    File(PathBuf),
    /// Black.
    None,
}

impl EnvironmentSource {
    /// `white`, `studio`, `sky`, `none`, or the path of a file relative to `directory`.
    pub fn parse(text: &str, directory: &Path) -> EnvironmentSource {
        match text {
            "white" => EnvironmentSource::White,
            "studio" => EnvironmentSource::Studio,
            "sky" => EnvironmentSource::Sky,
            "none" => EnvironmentSource::None,
            file => EnvironmentSource::File(directory.join(file)),
        }
    }

    /// The light itself, for baking; `None` when there is no environment.
    pub fn load(&self) -> Result<Option<LoadedEnvironment>, EnvironmentError> {
        match self {
            EnvironmentSource::White => Ok(Some(halfvector_ibl::white())),
            EnvironmentSource::Studio => Ok(Some(halfvector_ibl::studio())),
            EnvironmentSource::Sky => Ok(Some(halfvector_ibl::sky())),
            EnvironmentSource::None => Ok(None),
            EnvironmentSource::File(path) => {
                let bytes = read_limited(path, MAX_FILE_BYTES)
                    .map_err(|reason| EnvironmentError::Read { path: path.clone(), reason })?;
                halfvector_ibl::load(&bytes, &path.display().to_string()).map(Some).map_err(EnvironmentError::Content)
            }
        }
    }
}

/// Why an environment was not read.
#[derive(Debug, thiserror::Error)]
pub enum EnvironmentError {
    /// The file could not be read.
    #[error("the environment {} could not be read: {reason}; name a file, or one of white, studio, sky, none", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Its content was refused.
    #[error(transparent)]
    Content(halfvector_ibl::LoadError),
}

/// What is seen where no object is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Background {
    /// The environment itself; nothing when there is none.
    #[default]
    Environment,
    /// Nothing: alpha 0.
    None,
    /// This radiance, linear Rec. 709.
    Color([f32; 3]),
}

/// The bytes of a file that has no more than `limit`.
pub(crate) fn read_limited(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!("it is larger than {} MiB", limit >> 20));
    }
    Ok(bytes)
}
