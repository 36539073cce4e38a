//! Where a material is numerically unstable: each of its nodes in f32 (or f16) and in f64, by the same WGSL, over the points
//! and parameters that it may meet.
//!
//! The nodes of `material(context) -> Surface` are computed from the same contexts in both precisions. With f the chain of
//! nodes up to an output and x its context, in numbers of f32, the output is unstable where
//!
//! ```text
//! |f32(x) - f64(x)| > 8 max |f64(x') - f64(x)| + 1e-3 max(|f64(x)|, rms f64),    x' within 2 ulp of x
//! ```
//!
//! or where f32(x) is not finite and f64(x) is. Of f16 the tolerance is 8e-3, and x and its ulps are f16's. Steps (floor, checker, the borders of Worley's cells) are excused: between x
//! and a neighbour where f64 has what f32 has at x there is a jump that does not shrink however closely it is looked at. They are listed as
//! edges. A node that is only handed what a node before it spoiled is not named: the first one is.
//!
//! Textures are read at their finest level. Lights, lobes and the vertex stage are not judged.

mod domain;
mod judge;
mod trace;

use halfvector_graph::document::NodeId;
use halfvector_scene::Scene;

pub use crate::stability::domain::Precision;
use crate::stability::trace::Trace;

/// An output of a node that computes differently in the narrow arithmetic: f32, or f16 where that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The node's id in the document.
    pub node: NodeId,
    /// For people: the node's label, or the name of its kind.
    pub label: String,
    /// The output, with a component where it is a vector: `out.x`.
    pub output: String,
    /// What it gives where it is farthest from f64; may be infinite or NaN.
    pub narrow: f64,
    /// What f64 gives there.
    pub exact: f64,
    /// Where that is: contexts (`uv0.x`) and exposed parameters by name.
    pub input: Vec<(String, f64)>,
    /// Points at which it is infinite or no number, and f64 is finite.
    pub not_finite: usize,
    /// Points at which it is 0 or below the normal range, and f64 is not 0.
    pub underflows: usize,
    /// Points at which the value is too large for f16.
    pub beyond_f16: usize,
}

impl Finding {
    /// How far it is from f64 there; infinite where it is no number.
    pub fn error(&self) -> f64 {
        let error = (self.narrow - self.exact).abs();
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// What was found in a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stability {
    /// Outputs that it gets wrong: at most one for each node, its worst.
    pub unstable: Vec<Finding>,
    /// Outputs that jump, and that it gets wrong only at the jumps.
    pub edges: Vec<Finding>,
}

/// Why a material could not be judged.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// It could not be turned into WGSL, or its WGSL is not sound.
    #[error("material `{material}`: {why}")]
    Shader {
        /// Its name.
        material: String,
        /// With node and reason.
        why: String,
    },
    /// An image was not loaded.
    #[error("material `{material}`: the image {file} was not loaded; load the scene's images first")]
    MissingImage {
        /// Its name.
        material: String,
        /// As the document has it.
        file: String,
    },
    /// The interpreter refused it or gave up.
    #[error("material `{material}`: {why}")]
    Run {
        /// Its name.
        material: String,
        /// What, and where.
        why: String,
    },
}

/// Judges material number `material` of a scene whose images are loaded, computed in `precision`, against f64.
///
/// # Errors
/// When it is no sound material, or an image is missing.
///
/// # Panics
/// When the scene has no material of that number.
pub fn stability(scene: &Scene, material: usize, precision: Precision) -> Result<Stability, StabilityError> {
    let trace = Trace::new(scene, &scene.materials[material])?;
    judge::judge(&trace, precision)
}
