//! Registers without limit to registers of the machine. A value that is the same in all lanes gets a number of its own;
//! blocks of lanes are given to the next value as soon as nothing reads them, so that the working set stays in the cache.

use std::collections::BTreeMap;

use crate::code::{Code, SAME, Step};
use crate::emit::Flat;
use crate::ir::{Class, Ir, NONE, Op, Origin, Reg};

/// What the machine needs to know of one file of registers.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileSize {
    /// Blocks of lanes.
    pub(crate) blocks: u32,
    /// Initial values of the numbers that are the same in all lanes.
    pub(crate) same: Vec<u64>,
}

/// Where each register is; `NONE` for one that nothing uses.
#[derive(Debug)]
pub(crate) struct Allocation {
    pub(crate) places: Vec<u32>,
    /// By class.
    pub(crate) files: [FileSize; 3],
}

/// Every register that a step reads or writes. The flag: whether it writes.
fn registers_of(ir: &Ir, code: &Code, mut f: impl FnMut(Reg, bool)) {
    match code {
        Code::Step(Step { op, dst, a, b, c, .. }) => {
            let inst = crate::ir::Inst { op: *op, dst: *dst, a: *a, b: *b, c: *c };
            ir.sources(&inst, |r| f(r, false));
            ir.destinations(&inst, |r| f(r, true));
        }
        Code::JumpIf { condition, .. } | Code::Split { condition, .. } | Code::LeaveIf { condition, .. } => {
            f(*condition, false);
        }
        _ => {}
    }
}

/// First and last step at which each register is needed.
fn lifetimes(ir: &Ir, flat: &Flat) -> Vec<Option<(u32, u32)>> {
    let mut lives: Vec<Option<(u32, u32)>> = vec![None; ir.registers.len()];
    let mut touch = |reg: Reg, at: u32| {
        let life = lives[reg as usize].get_or_insert((at, at));
        *life = (life.0.min(at), life.1.max(at));
    };
    let end = flat.code.len() as u32;
    for (at, code) in flat.code.iter().enumerate() {
        registers_of(ir, code, |reg, _| touch(reg, at as u32));
    }
    for reg in &ir.outputs {
        touch(*reg, end);
    }
    // Inputs are written before the first step.
    for reg in &ir.inputs {
        if lives[*reg as usize].is_some() {
            let life = lives[*reg as usize].get_or_insert((0, 0));
            life.0 = 0;
        }
    }
    // The innermost loop around each step, and the next one around that.
    let mut inner = vec![NONE; flat.code.len() + 1];
    let mut outer = vec![NONE; flat.loops.len()];
    for (i, (start, last)) in flat.loops.iter().enumerate() {
        outer[i] = inner[*start as usize];
        inner[*start as usize..=*last as usize].fill(i as u32);
    }
    for life in lives.iter_mut().flatten() {
        // A value from before a loop is needed until the loop's end, and one that is needed after it, from its start.
        let mut at = inner[life.1 as usize];
        while at != NONE {
            let (start, last) = flat.loops[at as usize];
            if life.0 < start {
                life.1 = life.1.max(last);
            }
            at = outer[at as usize];
        }
        let mut at = inner[life.0 as usize];
        while at != NONE {
            let (start, last) = flat.loops[at as usize];
            if life.1 > last {
                life.0 = life.0.min(start);
            }
            at = outer[at as usize];
        }
    }
    lives
}

pub(crate) fn allocate(ir: &Ir, flat: &mut Flat, varying: &[bool]) -> Allocation {
    let lives = lifetimes(ir, flat);
    let mut places = vec![NONE; ir.registers.len()];
    let mut files: [FileSize; 3] = Default::default();
    let mut by_start: Vec<(u32, u32, Reg)> = Vec::new();
    for (reg, life) in lives.iter().enumerate() {
        let Some((start, end)) = life else { continue };
        let info = ir.registers[reg];
        if varying[reg] {
            by_start.push((*start, *end, reg as Reg));
        } else {
            let same = &mut files[info.class as usize].same;
            same.push(if let Origin::Constant(bits) = info.origin { bits } else { 0 });
            places[reg] = SAME | (same.len() - 1) as u32;
        }
    }
    by_start.sort_unstable();
    let mut free: [Vec<u32>; 3] = Default::default();
    let mut ends: BTreeMap<u32, Vec<(Class, u32)>> = BTreeMap::new();
    for (start, end, reg) in by_start {
        while let Some(entry) = ends.first_entry()
            && *entry.key() < start
        {
            for (class, block) in entry.remove() {
                free[class as usize].push(block);
            }
        }
        let class = ir.registers[reg as usize].class;
        let block = free[class as usize].pop().unwrap_or_else(|| {
            files[class as usize].blocks += 1;
            files[class as usize].blocks - 1
        });
        places[reg as usize] = block;
        ends.entry(end).or_default().push((class, block));
    }
    for (at, code) in flat.code.iter_mut().enumerate() {
        match code {
            Code::Step(step) => {
                // Where the operand of a move is needed no more, it changes places with the target.
                step.last = step.op == Op::Move
                    && ir.registers[step.a as usize].origin == Origin::Temporary
                    && varying[step.a as usize]
                    && varying[step.dst as usize]
                    && lives[step.a as usize].is_some_and(|(_, end)| end == at as u32);
                for reg in [&mut step.dst, &mut step.a, &mut step.b, &mut step.c] {
                    if *reg != NONE {
                        *reg = places[*reg as usize];
                    }
                }
            }
            Code::JumpIf { condition, .. } | Code::Split { condition, .. } | Code::LeaveIf { condition, .. } => {
                *condition = places[*condition as usize];
            }
            _ => {}
        }
    }
    Allocation { places, files }
}
