//! A material document becomes WGSL: named passes, reflection, export targets.
mod layout;
pub mod reflection;

pub use layout::PackError;
