//! BRDF math: Fresnel, GGX, Beckmann, cloth, diffuse, thin films, split-sum terms and the lobes made of them, generic over `f32` and `f64`.
//!
//! Each function has a twin of the same file, name, argument order and unit in the WGSL library (`shaders/brdf/*.wgsl`
//! and `shaders/math.wgsl`); a test holds them together. Sampling ([`sampling`],
//! [`sampling_bounded`], [`lobe_sampling`]) and quadrature ([`albedo`]) have none.
//!
//! The crate knows no file, no GPU and no graph, and depends on `std` alone. Vectors are `[R; 3]`, colours are linear
//! Rec. 709, directions point away from the surface and are unit. BRDFs are in 1/sr.
//!
//! Nothing here panics. Each function names its domain, where it never returns NaN, an infinity or a negative number;
//! the lobes (`*_eval`, `*_environment`) return finite numbers for any input whatever.

pub mod albedo;
pub mod anisotropic;
pub mod beckmann;
pub mod coupling;
pub mod dfg;
pub mod diffuse;
pub mod frame;
pub mod fresnel;
pub mod ggx;
pub mod lobe_anisotropic;
pub mod lobe_coat;
pub mod lobe_diffuse;
pub mod lobe_multiscatter;
pub mod lobe_sampling;
pub mod lobe_sheen;
pub mod lobe_specular;
pub mod lobe_transmission;
pub mod math;
pub mod metallic_roughness;
pub mod multiscatter;
mod real;
pub mod sampling;
pub mod sampling_bounded;
pub mod sheen;
pub mod thin_film;
pub mod vector;
pub mod visibility;

pub use real::{Real, Scalar};
