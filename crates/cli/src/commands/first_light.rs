//! `halfvector` where no window can be opened: the embedded example as a picture and as a shader, so that a first run shows
//! something.

use std::path::Path;

use halfvector_codegen::Fold;
use halfvector_codegen::target::{export, target};
use halfvector_graph::library::Library;
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

use crate::backend::Runner;
use crate::commands::{export::plain_needs, render::draw};
use crate::failure::Failure;
use crate::output::{note, write_files};
use crate::picture_file::{PictureFile, PictureFormat};

/// Where the results go.
const FOLDER: &str = "out";

/// Draws it.
pub(crate) fn run() -> Result<u8, Failure> {
    let broken = |why: String| Failure::input("the embedded example is broken").because(why);
    let document = halfvector_graph::file::from_json(halfvector_editor::START_MATERIAL)
        .map_err(|error| broken(error.to_string()))?;
    let folder = Path::new(FOLDER);
    let shader = halfvector_codegen::shader(&document, Library::standard(), &plain_needs(), Fold::Export)
        .map_err(|error| broken(error.to_string()))?;
    let wgsl = target("wgsl").ok_or_else(|| broken("there is no target wgsl".to_owned()))?;
    let files = export(&shader, wgsl, "example").map_err(|error| broken(error.to_string()))?;
    let paths: Vec<_> = files.iter().map(|file| folder.join(&file.name)).collect();
    let together: Vec<_> = paths.iter().zip(&files).map(|(path, file)| (path.as_path(), &file.bytes[..])).collect();
    write_files(&together)?;
    paths.iter().for_each(|path| note(path.display()));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, Path::new(""), &sphere).map_err(|error| broken(error.to_string()))?;
    draw(
        &scene,
        [512, 512],
        4,
        Runner::Auto,
        &PictureFile { path: folder.join("example.png"), format: PictureFormat::Png },
    )?;
    Ok(0)
}
