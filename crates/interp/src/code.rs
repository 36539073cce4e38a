//! The flat code that the machine runs: instructions on registers of the machine's files, and jumps that split and join
//! the mask of active lanes.

use crate::ir::{Class, Op};

/// An operand: index of a block of lanes, or, with this bit set, of a number that is the same in all lanes.
pub(crate) const SAME: u32 = 1 << 31;

/// An instruction. `class`: of the result, and of `a` for comparisons and conversions from floats.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) op: Op,
    pub(crate) class: Class,
    /// A move that writes only the active lanes.
    pub(crate) masked: bool,
    /// A move whose operand is used up: blocks change places.
    pub(crate) last: bool,
    pub(crate) dst: u32,
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) c: u32,
}

/// One step of the program. `slot` is a place for a mask, `to` the index of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Code {
    Step(Step),
    Jump {
        to: u32,
    },
    /// On a condition that is the same in all lanes.
    JumpIf {
        condition: u32,
        wanted: bool,
        to: u32,
    },
    /// Goes on with the lanes where the condition holds and keeps the others in the slot; jumps where there are none.
    Split {
        condition: u32,
        slot: u32,
        to: u32,
    },
    /// Goes on with the lanes of the slot and keeps the active ones in it; jumps where there are none.
    Other {
        slot: u32,
        to: u32,
    },
    /// The lanes of the slot are active too.
    Join {
        slot: u32,
    },
    /// The same, and the slot is empty then; jumps where no lane is active.
    Rejoin {
        slot: u32,
        to: u32,
    },
    /// The slot is empty.
    Clear {
        slot: u32,
    },
    /// Active lanes go into the slot.
    Leave {
        slot: u32,
    },
    /// Those where the condition holds.
    LeaveIf {
        condition: u32,
        slot: u32,
    },
    /// Jumps where no lane is active.
    JumpIfNone {
        to: u32,
    },
    /// The end of a loop: jumps back where a lane is active, and counts the steps.
    Again {
        to: u32,
        site: u32,
    },
    /// Active lanes end here, without a result.
    Kill,
}
