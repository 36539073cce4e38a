//! Texture maps: bytes become values, and values become frames.
//!
//! * [`decode()`] reads PNG, JPEG, TIFF, WebP, TGA and BMP within [`Limits`] into an [`Image`] of 8-bit, 16-bit or float
//!   RGBA; [`mip_chain()`] averages it in linear light down to one texel.
//! * [`color`] is the sRGB transfer function and its like; [`normal`] and [`height`] are normal and height mapping. They
//!   are twins of the WGSL files of the same names, generic over `f32` and `f64`.
//!   So are [`blend`] (two normal maps as one), [`derivative`] (tangents from screen derivatives), [`parallax`] and
//!   [`octahedral`] (directions in two numbers).
//! * [`batch`] does normal mapping for whole arrays, by vectors.
//! * [`tangents()`] is MikkTSpace with a tangent for every vertex; [`frame`] carries normals through any matrix.
//!
//! The crate knows no path, no GPU and no node graph: bytes come from the caller, results go to the caller.

pub mod batch;
pub mod blend;
pub mod color;
pub mod decode;
pub mod derivative;
pub mod frame;
pub mod height;
pub mod image;
pub mod mip;
pub mod normal;
pub mod octahedral;
pub mod parallax;
mod real;
pub mod tangents;

pub use crate::image::{Channels, Image, Texels};
pub use decode::{DecodeError, Limits, decode};
pub use mip::{ColorSpace, MapKind, mip_chain};
pub use real::Real;
pub use tangents::{SplitTangents, split_tangents, tangents};
