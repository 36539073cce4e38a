//! What is true: a Monte Carlo renderer in f64, metrics of difference between pictures, and where a material's f32 computes
//! something else than exact arithmetic ([`stability()`]).
//!
//! The renderer evaluates a material's own `material(context) -> Surface` by the interpreter in f64, reflects by the lobes of
//! `halfvector-brdf` in f64, traces shadows, and integrates the environment itself: no prefiltered levels, no split sum, no
//! fitted albedos. Meshes are displaced vertex by vertex, as the shaders do it. Every pixel comes with its standard error.
//!
//! What it does not do: light inside of bodies. What enters a transmitting surface is refracted once, or passes a thin wall,
//! and sees the environment, as the shaders have it.

mod albedo;
mod bsdf;
mod camera;
mod directions;
mod displacement;
mod elementary;
mod environment;
mod error;
mod film;
mod function;
mod geometry;
mod light;
mod material;
pub mod metrics;
mod model;
mod random;
mod render;
mod stability;
mod texture;
mod wave;

pub use environment::EnvironmentFilter;
pub use error::ReferenceError;
pub use film::Picture;
pub use model::Conductor;
pub use render::{Reference, RenderOptions};
pub use stability::{Edge, Finding, Precision, Stability, StabilityError, stability};
