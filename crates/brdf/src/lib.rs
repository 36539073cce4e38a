//! BRDF math: Fresnel, GGX, Beckmann, cloth, diffuse, thin films, split-sum terms and the lobes made of them, generic over
//! `f32`, `f64` and SIMD lanes.
//!
//! Each function has a twin of the same file, name, argument order and unit in the WGSL library (`shaders/brdf/*.wgsl`
//! and `shaders/math.wgsl`); a test holds them together. Sampling ([`sampling`],
//! [`sampling_bounded`], [`lobe_sampling`]), quadrature ([`albedo`],
//! [`thin_film_spectral`]) and slices (`batch`) have none.
//!
//! The crate knows no file, no GPU and no graph. With the feature `libm` in the place of `std` (default) it is `no_std`,
//! without batches. Vectors are `[R; 3]`, colours are linear
//! Rec. 709, directions point away from the surface and are unit. BRDFs are in 1/sr.
//!
//! Nothing here panics. Each function names its domain, where it never returns NaN, an infinity or a negative number;
//! the lobes (`*_eval`, `*_environment`) return finite numbers for any input whatever.

#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("halfvector-brdf needs elementary functions: enable the feature `std` (default) or `libm`");

pub mod albedo;
pub mod anisotropic;
#[cfg(feature = "std")]
pub mod batch;
pub mod beckmann;
pub mod coupling;
pub mod dfg;
pub mod diffuse;
#[cfg(feature = "std")]
mod elementary;
pub mod frame;
pub mod fresnel;
pub mod ggx;
#[cfg(feature = "std")]
mod lanes;
pub mod lobe_anisotropic;
pub mod lobe_coat;
pub mod lobe_diffuse;
pub mod lobe_multiscatter;
pub mod lobe_sampling;
pub mod lobe_sheen;
pub mod lobe_specular;
pub mod lobe_thin_film;
pub mod lobe_transmission;
pub mod math;
pub mod metallic_roughness;
pub mod multiscatter;
mod real;
pub mod sampling;
pub mod sampling_bounded;
pub mod sheen;
pub mod specular_aa;
pub mod thin_film;
pub mod thin_film_spectral;
pub mod vector;
pub mod visibility;

#[cfg(feature = "std")]
pub use lanes::Lane;
pub use real::{Real, Scalar};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
