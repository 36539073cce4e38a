//! Which environment surrounds a scene, and what is seen behind the objects. Baking it is not done here.
//!
//! An environment may be six files, one for each face of a cube: a folder of them, or a name with `%s` where they differ.

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
    /// An `.hdr`, `.exr`, `.hdre` or `.ktx2` file, or an ordinary image; a folder of six faces; or a path whose file name
    /// has `%s` in place of the name of a face: see [`FACE_NAMES`].
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
            EnvironmentSource::File(path) => match face_files(path)? {
                Some(faces) => load_six(&faces).map(Some),
                None => {
                    let bytes = read(path)?;
                    halfvector_ibl::load(&bytes, &path.display().to_string())
                        .map(Some)
                        .map_err(EnvironmentError::Content)
                }
            },
        }
    }
}

/// How the files of the faces +X -X +Y -Y +Z -Z are named: either all the one way or all the other.
pub const FACE_NAMES: [[&str; 6]; 2] =
    [["px", "nx", "py", "ny", "pz", "nz"], ["posx", "negx", "posy", "negy", "posz", "negz"]];

/// What stands for the name of a face in a path.
const PATTERN: &str = "%s";

/// The six files that a path means; `None` when it is one file.
fn face_files(path: &Path) -> Result<Option<[PathBuf; 6]>, EnvironmentError> {
    let faces = |reason: String| EnvironmentError::Faces { path: path.to_owned(), reason };
    if path.is_dir() {
        let unreadable =
            |error: std::io::Error| EnvironmentError::Read { path: path.to_owned(), reason: error.to_string() };
        let mut files = Vec::new();
        for entry in std::fs::read_dir(path).map_err(unreadable)? {
            files.push(entry.map_err(unreadable)?.path());
        }
        files.sort();
        let found = FACE_NAMES.iter().find_map(|names| faces_among(&files, names));
        return found.map(Some).ok_or_else(|| faces("the folder has not just one file for each".to_owned()));
    }
    let Some(name) = path.file_name().and_then(|name| name.to_str()).filter(|name| name.contains(PATTERN)) else {
        return Ok(None);
    };
    // A file may really be called so.
    if path.is_file() {
        return Ok(None);
    }
    let named = |names: &[&str; 6]| names.map(|face| path.with_file_name(name.replace(PATTERN, face)));
    let sets = FACE_NAMES.each_ref().map(named);
    // The set of which the most is there: what lacks of it is told.
    let missing = |set: &[PathBuf; 6]| set.iter().filter(|file| !file.is_file()).count();
    let Some(best) = sets.into_iter().min_by_key(missing) else { return Ok(None) };
    match best.iter().find(|file| !file.is_file()) {
        Some(file) => Err(faces(format!("there is no file {}", file.display()))),
        None => Ok(Some(best)),
    }
}

/// The one file for each name: the last word of its name without the extension, in capitals or not.
fn faces_among(files: &[PathBuf], names: &[&str; 6]) -> Option<[PathBuf; 6]> {
    let is_face = |file: &Path, face: &str| {
        let stem = file.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
        stem.strip_suffix(face).is_some_and(|before| !before.ends_with(char::is_alphanumeric))
    };
    let mut found = Vec::new();
    for face in names {
        let mut matching = files.iter().filter(|file| is_face(file, face));
        found.extend(matching.next().cloned());
        if matching.next().is_some() {
            return None;
        }
    }
    found.try_into().ok()
}

fn load_six(files: &[PathBuf; 6]) -> Result<LoadedEnvironment, EnvironmentError> {
    let bytes = files.iter().map(|file| read(file)).collect::<Result<Vec<_>, _>>()?;
    let names = files.each_ref().map(|file| file.display().to_string());
    halfvector_ibl::load_faces(std::array::from_fn(|i| (bytes[i].as_slice(), names[i].as_str())))
        .map_err(EnvironmentError::Content)
}

fn read(path: &Path) -> Result<Vec<u8>, EnvironmentError> {
    read_limited(path, MAX_FILE_BYTES).map_err(|reason| EnvironmentError::Read { path: path.to_owned(), reason })
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
    /// A folder or pattern does not name six faces.
    #[error(
        "the environment {} is no set of six faces: {reason}; end their names with px nx py ny pz nz or posx negx posy \
         negy posz negz", path.display()
    )]
    Faces {
        /// The folder or pattern.
        path: PathBuf,
        /// What is missing.
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

/// The bytes of a file that has no more than `limit`. What is named beside the project, `../shared/data/...`, and is not there
/// is looked for in the folder that the variable `HALFVECTOR_DATA` names.
pub(crate) fn read_limited(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let data = std::env::var_os("HALFVECTOR_DATA").map(PathBuf::from);
    let there = elsewhere(path, data.as_deref()).filter(|_| !path.exists());
    let file = File::open(there.as_deref().unwrap_or(path)).map_err(|error| match within_data(path) {
        Some(_) => format!("{error}; the folder shared/data may be elsewhere: HALFVECTOR_DATA names it"),
        None => error.to_string(),
    })?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!("it is larger than {} MiB", limit >> 20));
    }
    Ok(bytes)
}

/// What a path names within the last `shared/data` of it.
fn within_data(path: &Path) -> Option<PathBuf> {
    let parts: Vec<_> = path.components().collect();
    let at = parts.windows(2).rposition(|pair| pair[0].as_os_str() == "shared" && pair[1].as_os_str() == "data")?;
    let rest: PathBuf = parts[at + 2..].iter().collect();
    (!rest.as_os_str().is_empty()).then_some(rest)
}

/// The same in the folder of data.
fn elsewhere(path: &Path, data: Option<&Path>) -> Option<PathBuf> {
    Some(data?.join(within_data(path)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_beside_the_project_may_be_elsewhere() {
        let data = Some(Path::new("/data"));
        let helmet = Path::new("examples/../../shared/data/models/a.gltf");
        assert_eq!(elsewhere(helmet, data), Some(PathBuf::from("/data/models/a.gltf")));
        assert_eq!(elsewhere(helmet, None), None);
        for other in ["a.gltf", "shared/a.gltf", "data/shared/a.gltf", "../shared/data"] {
            assert_eq!(elsewhere(Path::new(other), data), None, "{other}");
        }
        let folder = tempfile::tempdir().expect("a folder");
        let absent = read_limited(&folder.path().join("shared/data/no-such.png"), 1).expect_err("no file");
        assert!(absent.contains("HALFVECTOR_DATA"), "{absent}");
        let absent = read_limited(&folder.path().join("no-such.png"), 1).expect_err("no file");
        assert!(!absent.contains("HALFVECTOR_DATA"), "{absent}");
    }

    #[test]
    fn six_faces_by_folder_and_by_pattern() {
        let folder = tempfile::tempdir().expect("a folder");
        let source = |name: &str| EnvironmentSource::parse(name, folder.path());
        let error = |name: &str| source(name).load().map(|_| ()).expect_err("incomplete").to_string();
        for (k, face) in FACE_NAMES[1].into_iter().enumerate() {
            assert!(error("").contains("six faces"));
            // As long as there is none, either way of naming may be meant.
            let lacking = if k == 0 { FACE_NAMES[0][0] } else { face };
            let said = error("room_%s.hdr");
            assert!(said.contains(&format!("room_{lacking}.hdr")), "{said}");
            let file = [b"#?RADIANCE\n\n-Y 1 +X 1\n".as_slice(), &[k as u8 + 1, 0, 0, 136]].concat();
            std::fs::write(folder.path().join(format!("room_{face}.hdr")), file).expect("written");
        }
        std::fs::write(folder.path().join("readme.txt"), "six faces").expect("written");
        for name in ["", "room_%s.hdr"] {
            let loaded = source(name).load().expect("six faces").expect("an environment");
            let halfvector_ibl::Source::Levels(stored) = loaded.source else { panic!("a cube was expected") };
            let reds: Vec<f32> = stored.levels[0].texels.iter().map(|texel| texel[0]).collect();
            assert_eq!(reds, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        }
        std::fs::write(folder.path().join("other_posx.hdr"), "").expect("written");
        assert!(error("").contains("just one file"));
    }
}
