//! Spherical harmonics of an environment, to a high order, and back: what makes a prefilter without noise.
//!
//! With n = v = r a lobe is symmetric about its direction, so prefiltering is a convolution with a zonal kernel, and a
//! convolution on the sphere multiplies the coefficients of degree l by one number k_l (Funk 1915, Hecke 1918; Driscoll
//! and Healy 1994, "Computing Fourier Transforms and Convolutions on the 2-Sphere"). A lobe of finite width ends the
//! series: for GGX the numbers fall like exp(-2 alpha l). Nothing is sampled at random and nothing of the map is missed.
//!
//! It knows no lobe; see `kernel`.

mod fourier;
mod legendre;
mod low;
mod quadrature;
mod spectrum;

pub(crate) use quadrature::gauss_legendre;
pub(crate) use spectrum::{Grid, MAX_BAND, MAX_ROWS, Spectrum};
