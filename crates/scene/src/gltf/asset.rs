//! The container: JSON, buffers and the encoded images of a glTF file. Nothing is interpreted here.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use gltf::json::{self, Index, Root, buffer};

use super::uri::{self, Uri};
use super::{Fault, GltfError, Result, entry};
use crate::environment::read_limited;

/// Largest model file, and largest file or sum of buffers that it refers to, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Extensions that are understood where a file requires them.
const UNDERSTOOD: [&str; 11] = [
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A glTF file with its buffers in memory.
#[derive(Debug)]
pub struct Asset {
    path: PathBuf,
    pub(super) root: Root,
    buffers: Vec<Vec<u8>>,
    pub(super) notes: Vec<String>,
}

impl Asset {
    /// Reads a `.glb` or `.gltf` file and the buffers that it refers to.
    pub fn open(path: &Path) -> std::result::Result<Asset, GltfError> {
        let bytes =
            read_limited(path, MAX_FILE_BYTES).map_err(|reason| GltfError::Read { path: path.to_owned(), reason })?;
        Asset::from_bytes(path, &bytes)
    }

    /// Reads the bytes of a file; `path` says where relative paths start.
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> std::result::Result<Asset, GltfError> {
        read(path, bytes).map_err(|fault| fault.of(path))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The encoded bytes (PNG, JPEG, ...) of an image.
    pub fn image_bytes(&self, image: usize) -> std::result::Result<Cow<'_, [u8]>, GltfError> {
        self.image(image).map_err(|fault| fault.of(&self.path))
    }

    fn image(&self, index: usize) -> Result<Cow<'_, [u8]>> {
        let place = format!("images[{index}]");
        let image = entry(&self.root.images, "images", index, &place)?;
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) => match uri::parse(uri).map_err(|reason| Fault::new(&place, reason))? {
                Uri::Data(bytes) => Ok(bytes.into()),
                Uri::Relative { path, .. } => read_beside(&self.path, &path, &place).map(Cow::from),
            },
            (None, Some(view)) => Ok(self.view(view, &place)?.into()),
            (None, None) => Err(Fault::new(place, "it has neither uri nor bufferView")),
        }
    }

    /// The path of an image that lies in a file of its own, relative to the model.
    pub(super) fn image_file(&self, index: usize) -> Option<String> {
        match uri::parse(self.root.images.get(index)?.uri.as_deref()?) {
            Ok(Uri::Relative { path, .. }) => Some(path),
            _ => None,
        }
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, view: Index<buffer::View>, place: &str) -> Result<&[u8]> {
        let view_place = format!("bufferViews[{}]", view.value());
        let view = entry(&self.root.buffer_views, "bufferViews", view.value(), place)?;
        let buffer = entry(&self.buffers, "buffers", view.buffer.value(), &view_place)?;
        let start = view.byte_offset.unwrap_or_default().0;
        slice(buffer, start, view.byte_length.0).ok_or_else(|| {
            let length = view.byte_length.0;
            Fault::new(
                view_place,
                format!(
                    "{length} bytes from byte {start} leave the buffer of {} bytes; the file is cut off or wrong",
                    buffer.len()
                ),
            )
        })
    }
}

/// `length` bytes from `start`; `None` where there are not as many.
pub(super) fn slice(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}

fn read(path: &Path, bytes: &[u8]) -> Result<Asset> {
    let (text, binary) = if bytes.starts_with(b"glTF") { split_glb(bytes)? } else { (bytes, None) };
    let root: Root = json::deserialize::from_slice(text).map_err(|e| {
        let reason = match e.is_syntax() || e.is_eof() {
            true => format!("{e}; this is no glTF"),
            false => e.to_string(),
        };
        Fault::new("JSON", reason)
    })?;
    if !root.asset.version.starts_with("2.") {
        let reason = format!("this is glTF {}; only version 2 is read", root.asset.version.escape_default());
        return Err(Fault::new("asset.version", reason));
    }
    let unknown: Vec<_> =
        root.extensions_required.iter().filter(|e| !UNDERSTOOD.contains(&e.as_str())).map(String::as_str).collect();
    if !unknown.is_empty() {
        let reason = format!("the file requires {}, which is not read; export it without", unknown.join(", "));
        return Err(Fault::new("extensionsRequired", reason));
    }
    let mut notes = Vec::new();
    let passed_over: Vec<_> =
        root.extensions_used.iter().filter(|e| !UNDERSTOOD.contains(&e.as_str())).map(String::as_str).collect();
    if !passed_over.is_empty() {
        notes.push(format!("extensions that are not read: {}", passed_over.join(", ")));
    }
    let buffers = read_buffers(path, &root, binary, &mut notes)?;
    for image in &root.images {
        if let Some(Ok(Uri::Relative { path, leaves_folder: true })) = image.uri.as_deref().map(uri::parse) {
            notes.push(format!("the image `{path}` lies outside of the model's folder"));
        }
    }
    Ok(Asset { path: path.to_owned(), root, buffers, notes })
}

/// JSON and binary chunk of a `.glb`.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>)> {
    let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let cut_off = |at: usize| {
        Fault::new(format!("byte {at}"), format!("the file is cut off: it has {} bytes and should go on", bytes.len()))
    };
    let version = word(4).ok_or_else(|| cut_off(4))?;
    if version != 2 {
        return Err(Fault::new("header", format!("this is GLB {version}; only version 2 is read")));
    }
    let length = word(8).ok_or_else(|| cut_off(8))? as usize;
    if length > bytes.len() {
        let reason = format!("the header promises {length} bytes, and the file has {}: it is cut off", bytes.len());
        return Err(Fault::new("header", reason));
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    while at < length && chunks.len() < 2 {
        let (size, kind) = word(at).zip(word(at + 4)).ok_or_else(|| cut_off(at))?;
        let start = at + 8;
        let end = start.checked_add(size as usize).filter(|&end| end <= length).ok_or_else(|| cut_off(start))?;
        chunks.push((kind, &bytes[start..end]));
        at = end;
    }
    const JSON: u32 = u32::from_le_bytes(*b"JSON");
    const BIN: u32 = u32::from_le_bytes(*b"BIN\0");
    match chunks[..] {
        [(JSON, text)] => Ok((text, None)),
        [(JSON, text), (BIN, binary)] => Ok((text, Some(binary))),
        [(JSON, text), _] => Ok((text, None)),
        _ => Err(Fault::new("header", "the first chunk is not JSON")),
    }
}

fn read_buffers(path: &Path, root: &Root, binary: Option<&[u8]>, notes: &mut Vec<String>) -> Result<Vec<Vec<u8>>> {
    let mut total = 0u64;
    let mut buffers = Vec::new();
    for (index, buffer) in root.buffers.iter().enumerate() {
        let place = format!("buffers[{index}]");
        total = total.saturating_add(buffer.byte_length.0);
        if total > MAX_FILE_BYTES {
            return Err(Fault::new(
                place,
                format!("the buffers are larger than {} MiB together", MAX_FILE_BYTES >> 20),
            ));
        }
        let mut bytes = match (&buffer.uri, binary) {
            (Some(uri), _) => match uri::parse(uri).map_err(|reason| Fault::new(&place, reason))? {
                Uri::Data(bytes) => bytes,
                Uri::Relative { path: file, leaves_folder } => {
                    if leaves_folder {
                        notes.push(format!("the buffer `{file}` lies outside of the model's folder"));
                    }
                    read_beside(path, &file, &place)?
                }
            },
            (None, Some(binary)) if index == 0 => binary.to_vec(),
            (None, _) => return Err(Fault::new(place, "it has no uri, and there is no binary chunk for it")),
        };
        if (bytes.len() as u64) < buffer.byte_length.0 {
            let (promised, there) = (buffer.byte_length.0, bytes.len());
            return Err(Fault::new(place, format!("it promises {promised} bytes and has {there}: it is cut off")));
        }
        bytes.truncate(buffer.byte_length.0 as usize);
        buffers.push(bytes);
    }
    Ok(buffers)
}

fn read_beside(model: &Path, file: &str, place: &str) -> Result<Vec<u8>> {
    let path = model.parent().unwrap_or(Path::new("")).join(file);
    read_limited(&path, MAX_FILE_BYTES)
        .map_err(|reason| Fault::new(place, format!("{} could not be read: {reason}", path.display())))
}
