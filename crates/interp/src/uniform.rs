//! What is the same in all lanes, and where lanes go apart. A register is uniform until something shows that it may
//! differ between lanes: an input, a varying operand, or (for a variable) a write that not all lanes make. A construct
//! is divergent when lanes leave it at different times. Both only grow, so the walk is repeated until nothing changes.

use crate::ir::{Inst, Ir, NONE, Node, Op, Origin, Reg};

/// An enclosing construct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Around {
    If,
    Loop,
    Switch,
    Scope(u32),
}

/// The constructs around a place, with whether lanes have gone apart in each; the outermost first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stack(pub(crate) Vec<(Around, bool)>);

impl Stack {
    /// Whether a write to a variable of scope `owner` may be made by some lanes only, as the others that will read the
    /// variable later are elsewhere.
    pub(crate) fn parts_lanes_of(&self, owner: u32) -> bool {
        self.0.iter().rev().take_while(|(around, _)| *around != Around::Scope(owner)).any(|(_, divergent)| *divergent)
    }

    /// Marks the constructs that a jump out of `target` leaves, that one included, if it is made by some lanes only.
    fn leave(&mut self, target: impl Fn(Around) -> bool) {
        let Some(index) = self.0.iter().rposition(|(around, _)| target(*around)) else { return };
        if self.0[index..].iter().skip(1).any(|(_, divergent)| *divergent) || self.0[index].1 {
            for (around, divergent) in &mut self.0[index..] {
                *divergent |= *around != Around::If;
            }
        }
    }
}

/// Which registers may differ between lanes; sets `divergent` in the nodes.
pub(crate) fn varying_registers(ir: &mut Ir) -> Vec<bool> {
    let mut nodes = std::mem::take(&mut ir.nodes);
    let mut varying: Vec<bool> = ir.registers.iter().map(|r| r.origin == Origin::Input).collect();
    loop {
        let mut walk = Walk { ir, varying: &mut varying, changed: false, stack: Stack::default() };
        walk.nodes(&mut nodes);
        if !walk.changed {
            break;
        }
    }
    ir.nodes = nodes;
    varying
}

struct Walk<'a> {
    ir: &'a Ir,
    varying: &'a mut Vec<bool>,
    changed: bool,
    stack: Stack,
}

impl Walk<'_> {
    fn set(&mut self, reg: Reg) {
        if !self.varying[reg as usize] {
            self.varying[reg as usize] = true;
            self.changed = true;
        }
    }

    fn inst(&mut self, inst: &Inst) {
        let mut differs = false;
        self.ir.sources(inst, |reg| differs |= self.varying[reg as usize]);
        let mut written = Vec::new();
        match inst.op {
            // Most instructions: no list.
            Op::Scatter(_) | Op::Texture(_) | Op::Store(_) => self.ir.destinations(inst, |reg| written.push(reg)),
            _ => written.push(inst.dst),
        }
        for reg in written {
            let partial = match self.ir.registers[reg as usize].origin {
                Origin::Variable(owner) => self.stack.parts_lanes_of(owner),
                _ => false,
            };
            if differs || partial {
                self.set(reg);
            }
        }
    }

    /// Walks a construct's blocks with it on the stack; returns whether it is divergent now.
    fn within(&mut self, around: Around, divergent: bool, blocks: [&mut Vec<Node>; 2], exit: Reg) -> bool {
        self.stack.0.push((around, divergent));
        for block in blocks {
            self.nodes(block);
        }
        let (_, mut now) = self.stack.0.pop().unwrap_or((around, false));
        now |= exit != NONE && self.varying[exit as usize];
        self.changed |= now != divergent;
        now
    }

    fn nodes(&mut self, nodes: &mut [Node]) {
        for node in nodes {
            match node {
                Node::Inst(inst) => self.inst(inst),
                Node::If { condition, accept, reject, divergent } => {
                    let differs = *divergent || self.varying[*condition as usize];
                    self.changed |= differs != *divergent;
                    *divergent = differs;
                    self.within(Around::If, differs, [accept, reject], NONE);
                }
                Node::Loop { body, continuing, break_if, divergent, .. } => {
                    *divergent = self.within(Around::Loop, *divergent, [body, continuing], *break_if);
                }
                Node::Switch { body, divergent } => {
                    *divergent = self.within(Around::Switch, *divergent, [body, &mut Vec::new()], NONE);
                }
                Node::Scope { id, body, divergent } => {
                    *divergent = self.within(Around::Scope(*id), *divergent, [body, &mut Vec::new()], NONE);
                }
                Node::Break => self.stack.leave(|a| matches!(a, Around::Loop | Around::Switch)),
                Node::Continue => self.stack.leave(|a| a == Around::Loop),
                Node::Return => self.stack.leave(|a| matches!(a, Around::Scope(_))),
                // Lanes that are gone leave every loop, which must notice when none is left.
                Node::Kill => {
                    if self.stack.0.iter().any(|(_, divergent)| *divergent) {
                        for (around, divergent) in &mut self.stack.0 {
                            *divergent |= *around == Around::Loop;
                        }
                    }
                }
            }
        }
    }
}
