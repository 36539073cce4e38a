//! Where a material is numerically unstable: each of its nodes in f32 (or f16) and in f64, by the same WGSL, over the points
//! and parameters that it may meet.
//!
//! The nodes of `material(context) -> Surface` are computed from the same contexts and exposed parameters in both precisions.
//! With f the chain of nodes up to an output and x what it reads, in numbers of f32, the output is unstable where
//!
//! ```text
//! |f32(x) - f64(x)| > 8 max |f64(x') - f64(x)| + 1e-3 max(|f64(x)|, rms f64),    x' within 2 ulp of x
//! ```
//!
//! or where f32(x) is not finite and f64(x) is. The largest change is looked for at the ends of that way, and where that would not excuse
//! an error at 32 places between. Of f16 the tolerance is 8e-3, and x and its ulps are f16's. A node that is only handed
//! what a node before it spoiled is not named: the first one is, with those behind it, which were not judged by themselves.
//! A node whose f64(x) is no number, or infinite, where all that it is fed is finite, is unstable, too: in any arithmetic.
//! What has no inputs but constants is computed before a shader is made; those nodes are judged as they stand in the document.
//!
//! Steps (floor, checker, the borders of Worley's cells) are excused: between x and a neighbour where f64 has what f32 has
//! at x there is a jump that does not shrink however closely it is looked at. Jumps are looked for along each input and at critical
//! points as well, both sides of them are judged, and they are listed as edges: at critical points from 1e-5 of the output's value or
//! rms, elsewhere from the tolerance.
//!
//! What is tried:
//!
//! - Points all over the domain, and jumps between points of a few lines along each input.
//! - Critical points of intermediate numbers: divisors, arguments of logarithms, roots, powers and angles at the ends of their
//!   domains, differences that are compared, numbers whose sign or whole part is taken. Where such a number passes it between two
//!   neighbours on a line the way is halved; where it is small its slope is followed down by Newton's steps. Points at distances of
//!   1e-6 to 1e-3 of the domain around are judged; at a pole itself, and at the numbers next to it, only what is not finite counts.
//! - Points close to each other along each input, and closer around those where the error is largest for its tolerance: half a
//!   thousandth apart between two whole texture coordinates in a material of at most 400 steps of the interpreter that reads no more than
//!   two numbers that move alone, up to six times as far in longer ones.
//!
//! None of that is a proof: what is found is so, what is not found may be. Not found is what stands in a branch that no sample takes;
//! behind a hollow that no slope leads to; at critical points of a number in another turn of a loop than the last; beyond the first, middle
//! and last places where one number was seen to pass; and, where nothing is decided, in bands narrower than those points are apart. A
//! pole is named where a number of the precision meets it; one that lies between them everywhere is an edge at most. The search is bounded:
//! of a material at most 512 ways of each sort are followed, and fewer the longer it is, about 65 in one of 17,000 steps; one way of each
//! number before the second of any, of crossings those of divisors and ends of domains first.
//!
//! Textures are read at their finest level. Lights, lobes and the vertex stage are not judged.

mod constant;
mod critical;
mod dense;
mod domain;
mod edge;
mod effort;
mod judge;
mod trace;
mod wiring;

use halfvector_graph::document::NodeId;
use halfvector_interp::Half;
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
    /// Where that is: those contexts (`uv0.x`) and exposed parameters by name that the output depends on; empty where it
    /// depends on none.
    pub input: Vec<(String, f64)>,
    /// Points at which it is no number, in the narrow arithmetic or in f64.
    pub nan: usize,
    /// Points at which it is infinite, in the narrow arithmetic or in f64.
    pub infinite: usize,
    /// Points at which the exact value lies below the normal range of the narrow arithmetic, and is not 0.
    pub underflows: usize,
    /// Points at which the value is too large for f16.
    pub beyond_f16: usize,
    /// Ids of nodes that it feeds, at any distance, and that give something wrong as well: whether by themselves is not known
    /// before this one is mended.
    pub behind: Vec<NodeId>,
}

impl Finding {
    /// How far it is from f64 there; infinite where it is no number.
    pub fn error(&self) -> f64 {
        let error = (self.narrow - self.exact).abs();
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// An output that jumps, and that the narrow arithmetic computes well but for the place of the jump.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// The node's id in the document.
    pub node: NodeId,
    /// For people: the node's label, or the name of its kind.
    pub label: String,
    /// The output, with a component where it is a vector: `out.x`.
    pub output: String,
    /// What it gives on one side.
    pub from: f64,
    /// What it gives on the other side.
    pub to: f64,
    /// Where that is, as in [`Finding::input`].
    pub input: Vec<(String, f64)>,
}

/// What was found in a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stability {
    /// Outputs that it gets wrong: at most one for each node, its worst.
    pub unstable: Vec<Finding>,
    /// Outputs that jump, and that it gets wrong at most at the jumps: at most one for each node, and none that is fed by
    /// another of them.
    pub edges: Vec<Edge>,
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
    let material = &scene.materials[material];
    let trace = Trace::new(scene, material)?;
    let constant = constant::nodes(&trace);
    let live = if constant.is_empty() { None } else { Some((Trace::live(scene, material)?, constant)) };
    match precision {
        Precision::Single => judge::judge::<f32>(&trace, live.as_ref(), precision),
        Precision::Half => judge::judge::<Half>(&trace, live.as_ref(), precision),
    }
}
