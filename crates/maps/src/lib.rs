//! Texture maps: bytes become values, and values become frames.
//!
//! * [`decode()`] reads PNG, JPEG, TIFF, WebP, TGA, BMP and QOI within [`Limits`] into an [`Image`] of 8-bit, 16-bit or
//!   float RGBA, with what the file says of its colours applied or named; [`mip_chain()`] averages it in linear light
//!   down to one texel.
//! * [`color`] is the sRGB transfer function and its like; [`normal`] and [`height`] are normal and height mapping. They
//!   are twins of the WGSL files of the same names, generic over `f32` and `f64`.
//!   So are [`blend`] (two normal maps as one), [`derivative`] (tangents from screen derivatives), [`parallax`] and
//!   [`octahedral`] (directions in two numbers).
//! * [`batch`] does normal mapping for whole arrays, by vectors.
//! * [`texel`] is other readings of normal maps; [`agreement()`] says which way a normal map's green runs when a height map
//!   is beside it; [`pack()`] and [`unpack()`] know which channel holds what.
//! * [`tangents()`] is MikkTSpace with a tangent for every vertex; [`frame`] carries normals through any matrix.
//!
//! The crate knows no path, no GPU and no node graph: bytes come from the caller, results go to the caller.

pub mod agreement;
pub mod batch;
pub mod blend;
mod coding;
pub mod color;
pub mod decode;
pub mod derivative;
pub mod frame;
pub mod height;
pub mod image;
mod levels;
pub mod lost_length;
pub mod mip;
pub mod normal;
pub mod octahedral;
pub mod pack;
pub mod parallax;
mod profile;
mod real;
pub mod tangents;
pub mod texel;

pub use crate::image::{Channels, Image, Texels};
pub use agreement::{Agreement, GreenSign, agreement};
pub use decode::{DecodeError, Decoded, Limits, Noted, decode};
pub use lost_length::adjusted_roughness;
pub use mip::{ColorSpace, MapKind, mip_chain, smaller_levels};
pub use pack::{Layout, Map, PackError, pack, unpack};
pub use profile::Profile;
pub use real::Real;
pub use tangents::{SplitTangents, split_tangents, tangents};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
