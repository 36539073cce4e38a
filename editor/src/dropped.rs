//! Files that are dropped on the window: what they can be, and who takes them. A part of the window takes what it has a use
//! for; what nobody has taken at the end of a frame is told.

use std::path::{Path, PathBuf};

use eframe::egui;

/// What a file can be, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Material,
    Group,
    Model,
    /// For nothing else.
    Environment,
    /// An environment; over an input that takes a picture it is told that it is none.
    Radiance,
    /// An environment over the viewport, a node over the graph, a value over an input that takes one.
    Picture,
}

/// None for a file that nothing here can use.
fn kind(path: &Path) -> Option<Kind> {
    if path.to_str().is_some_and(|name| name.ends_with(".material.json")) {
        return Some(Kind::Material);
    }
    if path.to_str().is_some_and(|name| name.ends_with(".group.json")) {
        return Some(Kind::Group);
    }
    match path.extension()?.to_str()?.to_lowercase().as_str() {
        "glb" | "gltf" => Some(Kind::Model),
        "hdre" | "ktx2" => Some(Kind::Environment),
        "hdr" | "exr" => Some(Kind::Radiance),
        "png" | "jpg" | "jpeg" | "tif" | "tiff" | "webp" | "tga" | "bmp" => Some(Kind::Picture),
        _ => None,
    }
}

/// Why an environment is not taken for a picture, and what to do.
pub(crate) fn no_picture(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    format!(
        "{name} is an environment: .hdr and .exr files are not read as pictures of a material. Drop it on the viewport to light \
         the scene, or convert it to PNG or TIFF."
    )
}

/// Takes the dropped files of the kinds that are wanted.
pub(crate) fn take(context: &egui::Context, wants: impl Fn(Kind) -> bool) -> Vec<PathBuf> {
    context.input_mut(|input| {
        let files = &mut input.raw.dropped_files;
        let taken = files.iter().filter(|file| kind(file.path()).is_some_and(&wants));
        let taken = taken.map(|file| file.path().to_owned()).collect();
        files.retain(|file| !kind(file.path()).is_some_and(&wants));
        taken
    })
}

/// What is said of a file that nobody has taken; none when there is no such file.
pub(crate) fn left(context: &egui::Context) -> Option<String> {
    let path = context.input_mut(|input| std::mem::take(&mut input.raw.dropped_files)).first()?.path().to_owned();
    let what = match kind(&path) {
        Some(Kind::Picture) => {
            "a picture is dropped on the graph for a node, on an input that takes one, or on the viewport as environment"
        }
        Some(_) => "it is for the viewport, which is not shown",
        None => {
            "it is nothing to drop here: materials are *.material.json, groups *.group.json, models .glb and .gltf, environments .hdr, .exr, .hdre, \
             .ktx2, pictures .png, .jpg, .tif, .webp, .tga and .bmp"
        }
    };
    Some(format!("{}: {what}", path.display()))
}
