//! Draws a scene with wgpu: device, textures, pipelines by reflection, tiles, read-back.
//!
//! It knows no node and no file: shaders come from the code generator with a list of what they read, scenes come loaded,
//! environments baked. It opens no window.

mod background;
mod bake;
mod cache;
mod device;
mod draws;
mod error;
pub mod function;
mod kept;
mod mesh;
mod program;
mod renderer;
mod stopwatch;
mod target;
mod texture;

pub use cache::{Cache, Made};
pub use error::RenderError;
pub use renderer::{RenderOptions, Renderer};
