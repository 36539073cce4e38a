//! A scene as one web page: the exported WGSL, meshes, textures, environment and tables in one file that draws itself with
//! WebGPU, in any folder, with no server and no network. Nothing is baked or written to disk here.
//!
//! Names that come from documents stand in the page as data and as escaped text, never as markup or script.

mod assets;
mod page;
mod textures;

use halfvector_codegen::{CodegenError, PackError};
use halfvector_ibl::BakedEnvironment;
use halfvector_scene::{PassesError, Scene};

/// Why a scene became no page.
#[derive(Debug, thiserror::Error)]
pub enum WebError {
    /// A material gave no shader.
    #[error("the material `{material}`: {source}")]
    Shader {
        /// Its name.
        material: String,
        /// Why.
        source: CodegenError,
    },
    /// An object or mesh is not sound.
    #[error(transparent)]
    Passes(#[from] PassesError),
    /// Uniforms and numbers do not fit.
    #[error(transparent)]
    Pack(#[from] PackError),
    /// An image of a material was not loaded.
    #[error("the material `{material}`: the image {file} was not loaded")]
    MissingImage {
        /// The material's name.
        material: String,
        /// The image.
        file: String,
    },
    /// An image is larger than every browser must take.
    #[error(
        "the image {file} has {width} x {height} texels; browsers take {MAX_TEXELS} along each side: make it smaller"
    )]
    ImageTooLarge {
        /// The image.
        file: String,
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The scene has an environment and none was given.
    #[error("the scene has an environment, but none was baked for it")]
    NoEnvironment,
}

/// Texels along a side that every device with WebGPU takes (its default limit).
pub const MAX_TEXELS: u32 = 8192;

/// The page, UTF-8. `environment` is the scene's environment, baked; it may be absent when the scene has none.
///
/// The same scene and environment give the same bytes. Images and cubes are compressed without loss; a page under a high dynamic
/// range environment of 512 texels has some 4 to 8 MB, one under `white` or none a few hundred KB.
///
/// # Errors
/// When a material gives no shader, or something is too large for a browser.
pub fn page(scene: &Scene, environment: Option<&BakedEnvironment>) -> Result<String, WebError> {
    Ok(page::page(&scene.name, &assets::scene(scene, environment)?))
}
