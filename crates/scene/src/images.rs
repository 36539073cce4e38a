//! The pictures that materials refer to: found, decoded once each, all cores at work.
//!
//! The store holds texels as they stand in the files, but that colours of files with other profiles are brought to sRGB.
//! Decoding sRGB, and smaller levels, are the renderers' business, as one picture may be read both ways.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use halfvector_graph::document::Document;
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::Library;
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_maps::{Channels, Decoded, Image, Limits, Noted, Profile, Texels};
use rayon::prelude::*;

use crate::environment::read_limited;
use crate::gltf::{self, Asset, GltfError};
use crate::scene::SceneMaterial;

/// Largest image file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Decoded pictures by the file that they came from.
#[derive(Clone, Debug, Default)]
pub struct ImageStore {
    images: Vec<Arc<Image>>,
    by_key: HashMap<(ImageKey, ColorSpace), usize>,
    /// The files as they were when they were read last.
    stamps: HashMap<PathBuf, Option<FileStamp>>,
    notes: Vec<String>,
}

/// What tells one state of a file from another: when it was written last, and its size in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStamp {
    modified: SystemTime,
    bytes: u64,
}

impl FileStamp {
    /// The state of a file now; none of one that is not there.
    pub fn of(path: &Path) -> Option<FileStamp> {
        let metadata = std::fs::metadata(path).ok()?;
        Some(FileStamp { modified: metadata.modified().ok()?, bytes: metadata.len() })
    }
}

/// Where a picture lies: a file, or an image within a glTF file.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct ImageKey {
    path: PathBuf,
    in_gltf: Option<usize>,
}

/// Why an image was not loaded, and who wanted it.
#[derive(Debug, thiserror::Error)]
#[error("node `{node}` of the material `{material}`: {fault}")]
pub struct ImageError {
    /// The material's name.
    pub material: String,
    /// The node's label, or its id without one.
    pub node: String,
    /// Where the node stands: its id, behind those of the groups that it lies in, as `flatten` writes it.
    pub path: String,
    /// What went wrong.
    pub fault: ImageFault,
}

/// Why an image was not loaded.
#[derive(Debug, thiserror::Error)]
pub enum ImageFault {
    /// The file could not be read.
    #[error("the image {} could not be read: {reason}; relative paths start at the material's folder", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The file is no image that can be decoded.
    #[error("{file}: {source}")]
    Decode {
        /// The file, with `#N` for an image within a glTF file.
        file: String,
        /// Why.
        source: Box<halfvector_maps::DecodeError>,
    },
    /// The glTF file that holds the image was refused.
    #[error(transparent)]
    Gltf(Box<GltfError>),
}

/// A file to be read, for colours, for data or for both, and who wants it first, for messages.
struct Wanted {
    key: ImageKey,
    spaces: BTreeSet<ColorSpace>,
    material: String,
    node: String,
    path: String,
}

impl ImageStore {
    /// Loads what the materials refer to and is not here yet. Nodes that no surface reads from are passed over.
    ///
    /// # Errors
    /// When images fail, the first one of [`load_all`](Self::load_all).
    pub fn load(&mut self, materials: &[SceneMaterial]) -> Result<(), ImageError> {
        self.load_all(materials).into_iter().next().map_or(Ok(()), Err)
    }

    /// Loads as [`load`](Self::load) does, and returns why each image that fails does: first the glTF files that cannot be
    /// opened, then the images, both in order of materials and node ids. The others are here then.
    pub fn load_all(&mut self, materials: &[SceneMaterial]) -> Vec<ImageError> {
        let mut places: HashMap<ImageKey, usize> = HashMap::new();
        let mut wanted: Vec<Wanted> = Vec::new();
        for material in materials {
            let flat = without_groups(&material.document);
            for (node, label, image) in images_of(&flat) {
                let key = ImageKey::new(&material.directory, image);
                if self.by_key.contains_key(&(key.clone(), image.color_space)) {
                    continue;
                }
                let place = *places.entry(key.clone()).or_insert_with(|| {
                    wanted.push(Wanted {
                        key,
                        spaces: BTreeSet::new(),
                        material: material.document.name.clone(),
                        node: label.unwrap_or(node).to_owned(),
                        path: node.to_owned(),
                    });
                    wanted.len() - 1
                });
                wanted[place].spaces.insert(image.color_space);
            }
        }
        // Before they are read: what is written meanwhile is a change.
        for want in &wanted {
            self.stamps.insert(want.key.path.clone(), FileStamp::of(&want.key.path));
        }
        let mut faults = Vec::new();
        let mut assets: BTreeMap<&Path, Option<Asset>> = BTreeMap::new();
        for want in wanted.iter().filter(|want| want.key.in_gltf.is_some()) {
            let path = want.key.path.as_path();
            assets.entry(path).or_insert_with(|| {
                let opened = Asset::open(path).map_err(|error| want.failed(ImageFault::Gltf(error.into())));
                opened.map_err(|error| faults.push(error)).ok()
            });
        }
        let read: Vec<Result<Vec<Read>, ImageError>> = wanted.par_iter().map(|want| read(want, &assets)).collect();
        let mut files_by_note: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (want, read) in wanted.iter().zip(read) {
            for Read { spaces, noted } in read.unwrap_or_else(|error| {
                faults.push(error);
                Vec::new()
            }) {
                for note in noted.notes {
                    files_by_note.entry(note).or_default().push(want.file());
                }
                for space in spaces {
                    self.by_key.insert((want.key.clone(), space), self.images.len());
                }
                self.images.push(Arc::new(noted.image));
            }
        }
        // Models come with many textures of one kind: each note is told once.
        self.notes.extend(files_by_note.iter().map(|(note, files)| match files.as_slice() {
            [file] => format!("{file}: {note}"),
            [file, others @ ..] => format!("{file} and {} more: {note}", others.len()),
            [] => note.clone(),
        }));
        faults
    }

    /// Loads as [`load_all`](Self::load_all) does; a checker of magenta and black stands in for each image that fails, so that
    /// the rest of the material is to be seen.
    pub fn load_or_stand_in(&mut self, materials: &[SceneMaterial]) -> Vec<ImageError> {
        let faults = self.load_all(materials);
        if faults.is_empty() {
            return faults;
        }
        let mut stand_in = None;
        for material in materials {
            let flat = without_groups(&material.document);
            for (_, _, image) in images_of(&flat) {
                let key = (ImageKey::new(&material.directory, image), image.color_space);
                self.by_key.entry(key).or_insert_with(|| {
                    *stand_in.get_or_insert_with(|| {
                        self.images.push(Arc::new(checker()));
                        self.images.len() - 1
                    })
                });
            }
        }
        faults
    }

    /// Forgets the images whose files are not as they were when they were read, so that they are read anew. Indices change.
    pub fn forget_changed(&mut self) {
        let ImageStore { images, by_key, stamps, .. } = self;
        let before = stamps.len();
        stamps.retain(|path, stamp| FileStamp::of(path) == *stamp);
        if stamps.len() == before {
            return;
        }
        by_key.retain(|(key, _), _| stamps.contains_key(&key.path));
        let old = std::mem::take(images);
        let mut moved: BTreeMap<usize, usize> = BTreeMap::new();
        for index in by_key.values_mut() {
            *index = *moved.entry(*index).or_insert_with(|| {
                images.push(old[*index].clone());
                images.len() - 1
            });
        }
    }

    /// The index of the picture that a document in `directory` means. Whether it is read as sRGB or linear makes a
    /// difference only for files whose profile is neither.
    pub fn index(&self, directory: &Path, image: &ImageRef) -> Option<usize> {
        self.by_key.get(&(ImageKey::new(directory, image), image.color_space)).copied()
    }

    /// The picture that a document in `directory` means.
    pub fn get(&self, directory: &Path, image: &ImageRef) -> Option<&Image> {
        self.index(directory, image).map(|index| &*self.images[index])
    }

    /// All pictures, in the order of their indices. The same `Arc` is the same picture.
    pub fn images(&self) -> &[Arc<Image>] {
        &self.images
    }

    /// What the user should know of how files were read: which profiles were applied, and which were not.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// An image, and the ways to read it that it serves.
struct Read {
    spaces: Vec<ColorSpace>,
    noted: Noted,
}

impl Wanted {
    fn failed(&self, fault: ImageFault) -> ImageError {
        ImageError { material: self.material.clone(), node: self.node.clone(), path: self.path.clone(), fault }
    }

    /// The file, with `#N` for an image within a glTF file.
    fn file(&self) -> String {
        let path = self.key.path.display();
        self.key.in_gltf.map_or_else(|| path.to_string(), |number| format!("{path}#{number}"))
    }
}

fn read(want: &Wanted, assets: &BTreeMap<&Path, Option<Asset>>) -> Result<Vec<Read>, ImageError> {
    let failed = |source: halfvector_maps::DecodeError| {
        want.failed(ImageFault::Decode { file: want.file(), source: source.into() })
    };
    let decoded = |bytes: &[u8]| halfvector_maps::decode(bytes, Limits::default()).map_err(failed);
    let path = &want.key.path;
    let decoded = match (want.key.in_gltf, assets.get(path.as_path())) {
        // That the file could not be opened is told already.
        (Some(_), Some(None)) => return Ok(Vec::new()),
        (Some(number), Some(Some(asset))) => {
            let bytes = asset.image_bytes(number).map_err(|error| want.failed(ImageFault::Gltf(error.into())))?;
            decoded(&bytes)?
        }
        _ => {
            let bytes = read_limited(path, MAX_FILE_BYTES)
                .map_err(|reason| want.failed(ImageFault::Read { path: path.clone(), reason }))?;
            decoded(&bytes)?
        }
    };
    as_wanted(decoded, &want.spaces).map_err(failed)
}

/// One image for all ways to read it where the file's profile makes no difference, else one for each.
fn as_wanted(decoded: Decoded, spaces: &BTreeSet<ColorSpace>) -> Result<Vec<Read>, halfvector_maps::DecodeError> {
    let all: Vec<ColorSpace> = spaces.iter().copied().collect();
    let of = |space: ColorSpace, decoded: Decoded| match space {
        ColorSpace::Srgb => decoded.into_color(),
        ColorSpace::Linear => Ok(decoded.into_data()),
    };
    match all.as_slice() {
        [space] => Ok(vec![Read { noted: of(*space, decoded)?, spaces: all }]),
        _ if decoded.profile().is_none_or(Profile::is_srgb) => {
            Ok(vec![Read { noted: decoded.into_data(), spaces: all }])
        }
        spaces => {
            let reads =
                spaces.iter().map(|&space| Ok(Read { noted: of(space, decoded.clone())?, spaces: vec![space] }));
            reads.collect()
        }
    }
}

/// Eight fields of magenta and black along each side, which no picture has by chance.
fn checker() -> Image {
    const FIELD: u32 = 16;
    const SIDE: u32 = 8 * FIELD;
    let texel = |place: u32| {
        let is_bright = (place % SIDE / FIELD + place / SIDE / FIELD).is_multiple_of(2);
        if is_bright { [255, 0, 255, 255] } else { [0, 0, 0, 255] }
    };
    let texels = Texels::U8((0..SIDE * SIDE).map(texel).collect());
    Image::new(SIDE, SIDE, Channels::Rgb, texels).expect("as many texels as its size says")
}

impl ImageKey {
    fn new(directory: &Path, image: &ImageRef) -> ImageKey {
        let (file, in_gltf) = match image.file.rsplit_once('#') {
            Some((file, number)) if gltf::has_gltf_extension(file) => match number.parse() {
                Ok(number) => (file, Some(number)),
                Err(_) => (image.file.as_str(), None),
            },
            _ => (image.file.as_str(), None),
        };
        ImageKey { path: without_detours(&directory.join(file)), in_gltf }
    }
}

/// The path without `.` and without `folder/..`, unless `folder` is a link, which leads elsewhere.
fn without_detours(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(result.components().next_back(), Some(Component::Normal(_))) && !is_link(&result) =>
            {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}

fn is_link(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|data| data.is_symlink())
}

/// A document with its groups taken apart, as far as they can be: what is wrong with them is for the document's check.
pub(crate) fn without_groups(document: &Document) -> Cow<'_, Document> {
    flatten(document, Library::standard()).map_or(Cow::Borrowed(document), |flat| flat.document)
}

/// (node id, label, image) of every image value on a node that a surface reads from, in order of ids and sockets.
fn images_of(document: &Document) -> Vec<(&str, Option<&str>, &ImageRef)> {
    let mut feeds: HashMap<&str, Vec<&str>> = HashMap::new();
    for link in &document.graph.links {
        feeds.entry(&link.to.node).or_default().push(&link.from.node);
    }
    let mut open: Vec<&str> = document
        .graph
        .nodes
        .iter()
        .filter(|(_, n)| n.node.starts_with("surface/"))
        .map(|(id, _)| id.as_str())
        .collect();
    let mut live: BTreeSet<&str> = open.iter().copied().collect();
    while let Some(node) = open.pop() {
        for &source in feeds.get(node).into_iter().flatten() {
            if live.insert(source) {
                open.push(source);
            }
        }
    }
    let nodes = live.into_iter().filter_map(|id| document.graph.nodes.get(id).map(|node| (id, node)));
    nodes
        .flat_map(|(id, node)| {
            node.values.values().filter_map(move |value| match value {
                Value::Image(image) => Some((id, node.label.as_deref(), image)),
                _ => None,
            })
        })
        .collect()
}
