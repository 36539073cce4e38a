//! What methods cost: kinds of cost, and how each was measured.

use crate::Row;

/// What the methods of a comparison cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Time of an element of a batch.
    Batch,
    /// Time of one call.
    Call,
    /// Memory that is read.
    Bytes,
    /// Time of a pixel of a whole shader on the device.
    Device,
    /// Instructions of a whole shader.
    Instructions,
}

impl Cost {
    pub(crate) const ALL: [Cost; 5] = [Cost::Batch, Cost::Call, Cost::Bytes, Cost::Device, Cost::Instructions];

    /// Of a row, where it has this kind.
    pub fn of(self, row: &Row) -> Option<f64> {
        match self {
            Cost::Batch => row.cost_batch_ns,
            Cost::Call => row.cost_ns,
            Cost::Bytes => row.bytes.map(|bytes| bytes as f64),
            Cost::Device => row.gpu_ns,
            Cost::Instructions => row.instructions.map(|count| count as f64),
        }
    }

    /// How sure a row's cost is, in parts; what is counted is exact. None where it is not known.
    pub fn spread(self, row: &Row) -> Option<f64> {
        match self {
            Cost::Batch => row.cost_batch_spread,
            Cost::Call => row.cost_spread,
            Cost::Device => row.gpu_spread,
            Cost::Bytes | Cost::Instructions => Some(0.0),
        }
    }

    /// Title of an axis or a column, with the unit.
    pub fn title(self) -> &'static str {
        match self {
            Cost::Batch => "time of one element of a batch [ns]",
            Cost::Call => "time of one call [ns]",
            Cost::Bytes => "memory read [bytes]",
            Cost::Device => "time of a pixel of a whole fragment stage on the device [ns]",
            Cost::Instructions => "instructions of a whole fragment stage",
        }
    }

    /// Whether it is a time: times are as sure as their spread says, what is counted is exact.
    pub fn is_time(self) -> bool {
        matches!(self, Cost::Batch | Cost::Call | Cost::Device)
    }

    /// How it was measured.
    pub fn measured(self) -> &'static str {
        match self {
            Cost::Batch => {
                "Time: one element of a batch on one core; the median of interleaved runs, of five sittings the fastest."
            }
            Cost::Call => {
                "Time: one call after the other on one core; the median of interleaved runs, of five sittings the fastest."
            }
            Cost::Bytes => "Memory: what the method reads, counted and not timed.",
            Cost::Device => {
                "Time: a pixel of a whole fragment stage with the method, by the device's timestamps; the shortest of several passes, of five \
                 sittings the fastest."
            }
            Cost::Instructions => {
                "Instructions: SPIR-V of a whole fragment stage with the method, counted and not timed."
            }
        }
    }
}
