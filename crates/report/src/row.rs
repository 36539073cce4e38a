//! One line of the report.

use serde::{Deserialize, Serialize};

use crate::timing::Time;

/// What one method costs, and how wrong it is, on one domain. A number that does not apply is `None`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Row {
    /// Name of the part that measured it; empty in rows of before parts were told.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub part: String,
    /// Term of shading, as `halfvector methods` names it where it is one of them.
    pub term: String,
    /// Name of the method.
    pub method: String,
    /// The inputs that were drawn; after the last semicolon, what the error is relative to and what the truth is. The word
    /// `relative` or `degrees` in it is the unit of the errors.
    pub domain: String,
    /// Largest error.
    pub error_max: Option<f64>,
    /// Root of the mean square of the errors.
    pub error_rms: Option<f64>,
    /// Where the error is lost in the noise of its truth, so that `error_rms` is null: the rms error is at most this, by two
    /// standard errors.
    pub error_bound: Option<f64>,
    /// How many inputs the errors are of; none in rows of before they were counted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<u64>,
    /// Whether the largest error was searched for, from the worst of these inputs on; else it is the largest of them.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub searched: bool,
    /// The input of the largest error.
    pub at: Option<String>,
    /// Of a picture: mean FLIP, how different it looks, 0 to 1. Andersson et al. 2021, "Visualizing and Communicating Errors in
    /// Rendered Images".
    pub flip: Option<f64>,
    /// How many results were NaN or infinite where the truth is neither.
    pub not_finite: Option<u64>,
    /// The first of these inputs.
    pub first_failure: Option<String>,
    /// Time of one call on one core, scalar f32 [ns].
    pub cost_ns: Option<f64>,
    /// Time of one element of a batch on one core [ns].
    pub cost_batch_ns: Option<f64>,
    /// How sure `cost_ns` is: by how much of it the median sitting took longer than the fastest, whose time it is.
    pub cost_spread: Option<f64>,
    /// The same for `cost_batch_ns`.
    pub cost_batch_spread: Option<f64>,
    /// Time of a step of the yardstick in the same turns [ns]: how fast the machine was; see [`crate::timing`].
    pub yardstick_ns: Option<f64>,
    /// SPIR-V instructions of a whole fragment stage with the method; see [`crate::part::shaders`].
    pub instructions: Option<u64>,
    /// Time of a pixel of that shader on the device [ns]: the shortest of several turns.
    pub gpu_ns: Option<f64>,
    /// How sure `gpu_ns` is: by how much of it the turn in the middle took longer.
    pub gpu_spread: Option<f64>,
    /// The device's name; a software rasteriser has its own name, too.
    pub gpu: Option<String>,
    /// Memory that it reads from tables or textures [bytes].
    pub bytes: Option<u64>,
    /// Why a figure that one would look for is not there, or what one has to know of it.
    pub note: Option<String>,
    /// Where the figures were not measured in this run: when they were recorded, and on which machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded: Option<String>,
    /// No other method of its term and domain is cheaper and at least as accurate, or more accurate and as cheap; set by
    /// [`mark_pareto`](crate::mark_pareto).
    pub pareto: bool,
}

impl Row {
    /// A row without figures.
    pub fn new(term: &str, method: &str, domain: &str) -> Row {
        Row { term: term.into(), method: method.into(), domain: domain.into(), ..Row::default() }
    }

    /// Takes the time of a run of `calls` calls, one after the other.
    pub(crate) fn take_time(&mut self, time: Time, calls: usize) {
        (self.cost_ns, self.cost_spread) = (Some(time.seconds * 1e9 / calls as f64), time.spread);
        self.yardstick_ns = Some(time.pace * 1e9);
    }

    /// Takes the time of a batch of `elements`.
    pub(crate) fn take_batch_time(&mut self, time: Time, elements: usize) {
        (self.cost_batch_ns, self.cost_batch_spread) = (Some(time.seconds * 1e9 / elements as f64), time.spread);
        self.yardstick_ns = Some(time.pace * 1e9);
    }

    /// Whether the largest error is that of the inputs that were drawn, and may be larger between them.
    pub(crate) fn is_of_list(&self) -> bool {
        self.points.is_some() && self.error_max.is_some() && !self.searched
    }

    /// Whether the error is what the arithmetic of f32 adds to the method, and not what the method leaves out.
    pub fn is_rounding(&self) -> bool {
        self.domain.ends_with("the same form in f64")
    }
}
