//! What is true: where a material's f32 computes something else than exact arithmetic ([`stability()`]).

mod stability;

pub use stability::{Finding, Stability, StabilityError, stability};
