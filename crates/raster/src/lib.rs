//! Draws a scene on the CPU with the whole shader: the vertex and fragment stages that codegen writes run in
//! `halfvector_interp`, and what a GPU does between and after them (clipping, coverage, interpolation, depth, blending) is
//! done here by the same rules. No GPU, no window, no file.
//!
//! The same picture as a GPU's, but for rounding: the same samples on the same grid, the top-left rule on corners that are
//! snapped to 1/256 of a sample, derivatives from blocks of two by two samples, trilinear textures. Pictures are drawn in
//! tiles on all cores; the bytes do not depend on how many there are.
//!
//! The weights of texels are f32, as a software GPU has them where it reads floats. Cards round them to 256ths, and a software GPU reads
//! pictures of 8 bits of more than 2048 x 2048 texels in 8 bits: where a slope is taken of a magnified picture (a normal map on polished metal),
//! theirs may be some codes off.
//!
//! It runs in f32, as a device computes, or in f64: the same picture with nearly exact arithmetic.

mod bind;
mod error;
mod geometry;
mod picture;
mod program;
mod shade;
mod sky;
mod texture;
mod tile;

pub use error::RasterError;
pub use picture::{RasterOptions, draw, draw_while};
pub use texture::{image as texture, sampler};
