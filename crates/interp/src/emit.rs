//! The tree of control flow to flat code. Registers are still without limit; jumps name labels, then places.

use crate::code::{Code, Step};
use crate::ir::{Class, Inst, Ir, NONE, Node, Op, Origin, Reg};
use crate::uniform::{Around, Stack};

/// Flat code with the registers of the tree, and the loops as ranges of its steps, outer loops before inner ones.
#[derive(Debug, Default)]
pub(crate) struct Flat {
    pub(crate) code: Vec<Code>,
    pub(crate) loops: Vec<(u32, u32)>,
    pub(crate) slots: u32,
}

struct Frame {
    divergent: bool,
    /// Where lanes go that are done with it.
    exit: u32,
    /// Where a `continue` goes.
    next: u32,
    exit_slot: u32,
    next_slot: u32,
}

struct Emit<'a> {
    ir: &'a Ir,
    varying: &'a [bool],
    flat: Flat,
    labels: Vec<u32>,
    stack: Stack,
    frames: Vec<Frame>,
    /// Where to go on when no lane is active: the innermost place at which lanes may come back.
    joins: Vec<u32>,
    free_slot: u32,
}

pub(crate) fn flatten(ir: &Ir, varying: &[bool]) -> Flat {
    let mut emit = Emit {
        ir,
        varying,
        flat: Flat::default(),
        labels: Vec::new(),
        stack: Stack::default(),
        frames: Vec::new(),
        joins: Vec::new(),
        free_slot: 0,
    };
    let end = emit.label();
    emit.joins.push(end);
    emit.nodes(&ir.nodes);
    emit.place(end);
    let Emit { mut flat, labels, .. } = emit;
    for code in &mut flat.code {
        match code {
            Code::Jump { to }
            | Code::JumpIf { to, .. }
            | Code::Split { to, .. }
            | Code::Other { to, .. }
            | Code::Rejoin { to, .. }
            | Code::JumpIfNone { to }
            | Code::Again { to, .. } => *to = labels[*to as usize],
            Code::Step(_)
            | Code::Join { .. }
            | Code::Clear { .. }
            | Code::Leave { .. }
            | Code::LeaveIf { .. }
            | Code::Kill => {}
        }
    }
    flat
}

impl Emit<'_> {
    fn label(&mut self) -> u32 {
        self.labels.push(0);
        (self.labels.len() - 1) as u32
    }

    fn place(&mut self, label: u32) {
        self.labels[label as usize] = self.flat.code.len() as u32;
    }

    fn push(&mut self, code: Code) {
        self.flat.code.push(code);
    }

    fn slot(&mut self) -> u32 {
        self.free_slot += 1;
        self.flat.slots = self.flat.slots.max(self.free_slot);
        self.free_slot - 1
    }

    fn step(&mut self, inst: &Inst) {
        let masked = match self.ir.registers.get(inst.dst as usize).map(|r| r.origin) {
            Some(Origin::Variable(owner)) => self.varying[inst.dst as usize] && self.stack.parts_lanes_of(owner),
            _ => matches!(inst.op, Op::Scatter(_)),
        };
        let class_of = |reg: Reg| self.ir.registers[reg as usize].class;
        let class = match inst.op {
            Op::Compare(_) | Op::Exponent => class_of(inst.a),
            Op::Scatter(_) | Op::Store(_) => class_of(inst.b),
            Op::Convert(_) if class_of(inst.dst) == Class::Bits => class_of(inst.a),
            Op::Texture(_) => Class::Float,
            _ => class_of(inst.dst),
        };
        let Inst { op, dst, a, b, c } = *inst;
        self.push(Code::Step(Step { op, class, masked, last: false, dst, a, b, c }));
    }

    /// Emits nodes; returns whether lanes may leave from inside.
    fn nodes(&mut self, nodes: &[Node]) -> bool {
        let mut exits = false;
        for node in nodes {
            let inside = match node {
                Node::Inst(inst) => {
                    self.step(inst);
                    false
                }
                Node::If { condition, accept, reject, divergent } => {
                    self.branch(*condition, accept, reject, *divergent)
                }
                Node::Loop { .. } => self.repeat(node),
                Node::Switch { body, divergent } => self.once(Around::Switch, body, *divergent),
                Node::Scope { id, body, divergent } => self.once(Around::Scope(*id), body, *divergent),
                Node::Break => self.leave(|a| matches!(a, Around::Loop | Around::Switch), false),
                Node::Continue => self.leave(|a| a == Around::Loop, true),
                Node::Return => self.leave(|a| matches!(a, Around::Scope(_)), false),
                Node::Kill => {
                    self.push(Code::Kill);
                    self.jump_to_join();
                    true
                }
            };
            let jumped = matches!(node, Node::Break | Node::Continue | Node::Return | Node::Kill);
            if inside && !jumped {
                let to = self.joins[self.joins.len() - 1];
                self.push(Code::JumpIfNone { to });
            }
            exits |= inside;
        }
        exits
    }

    fn jump_to_join(&mut self) {
        let to = self.joins[self.joins.len() - 1];
        self.push(Code::Jump { to });
    }

    /// A jump out of a construct: of all its lanes at once, or of the active ones.
    fn leave(&mut self, target: impl Fn(Around) -> bool, next: bool) -> bool {
        let Some(index) = self.stack.0.iter().rposition(|(around, _)| target(*around)) else { return false };
        let Frame { divergent, exit, next: continues, exit_slot, next_slot } = self.frames[index];
        if divergent {
            self.push(Code::Leave { slot: if next { next_slot } else { exit_slot } });
            self.jump_to_join();
        } else {
            self.push(Code::Jump { to: if next { continues } else { exit } });
        }
        true
    }

    fn enter(&mut self, around: Around, frame: Frame) {
        self.stack.0.push((around, frame.divergent));
        self.frames.push(frame);
    }

    fn exit(&mut self) {
        self.stack.0.pop();
        self.frames.pop();
    }

    fn branch(&mut self, condition: Reg, accept: &[Node], reject: &[Node], divergent: bool) -> bool {
        let (other, end) = (self.label(), self.label());
        let first_slot = self.free_slot;
        let frame = Frame { divergent, exit: end, next: end, exit_slot: 0, next_slot: 0 };
        self.enter(Around::If, frame);
        let mut exits;
        if divergent {
            let slot = self.slot();
            self.push(Code::Split { condition, slot, to: other });
            self.joins.push(other);
            exits = self.nodes(accept);
            self.joins.pop();
            self.place(other);
            if !reject.is_empty() {
                self.push(Code::Other { slot, to: end });
                self.joins.push(end);
                exits |= self.nodes(reject);
                self.joins.pop();
            }
            self.place(end);
            self.push(Code::Join { slot });
        } else {
            self.push(Code::JumpIf { condition, wanted: false, to: other });
            exits = self.nodes(accept);
            if !reject.is_empty() {
                self.push(Code::Jump { to: end });
            }
            self.place(other);
            exits |= self.nodes(reject);
            self.place(end);
        }
        self.exit();
        self.free_slot = first_slot;
        exits
    }

    fn once(&mut self, around: Around, body: &[Node], divergent: bool) -> bool {
        let end = self.label();
        let first_slot = self.free_slot;
        let exit_slot = if divergent { self.slot() } else { 0 };
        self.enter(around, Frame { divergent, exit: end, next: end, exit_slot, next_slot: 0 });
        if divergent {
            self.push(Code::Clear { slot: exit_slot });
            self.joins.push(end);
        }
        let exits = self.nodes(body);
        if divergent {
            self.joins.pop();
        }
        self.place(end);
        if divergent {
            self.push(Code::Join { slot: exit_slot });
        }
        self.exit();
        self.free_slot = first_slot;
        exits
    }

    fn repeat(&mut self, node: &Node) -> bool {
        let Node::Loop { body, continuing, break_if, site, divergent } = node else { return false };
        let (head, next, again, exit) = (self.label(), self.label(), self.label(), self.label());
        let first_slot = self.free_slot;
        let (exit_slot, next_slot) = if *divergent { (self.slot(), self.slot()) } else { (0, 0) };
        self.enter(Around::Loop, Frame { divergent: *divergent, exit, next, exit_slot, next_slot });
        if *divergent {
            self.push(Code::Clear { slot: exit_slot });
            self.push(Code::Clear { slot: next_slot });
        }
        let index = self.flat.loops.len();
        self.flat.loops.push((self.flat.code.len() as u32, 0));
        self.place(head);
        self.joins.push(if *divergent { next } else { self.joins[self.joins.len() - 1] });
        let mut exits = self.nodes(body);
        self.joins.pop();
        self.place(next);
        if *divergent {
            self.push(Code::Rejoin { slot: next_slot, to: exit });
        }
        self.joins.push(if *divergent { again } else { self.joins[self.joins.len() - 1] });
        exits |= self.nodes(continuing);
        self.joins.pop();
        if *break_if != NONE {
            if self.varying[*break_if as usize] {
                self.push(Code::LeaveIf { condition: *break_if, slot: exit_slot });
            } else {
                self.push(Code::JumpIf { condition: *break_if, wanted: true, to: exit });
            }
        }
        self.place(again);
        self.flat.loops[index].1 = self.flat.code.len() as u32;
        self.push(Code::Again { to: head, site: *site });
        self.place(exit);
        if *divergent {
            self.push(Code::Join { slot: exit_slot });
        }
        self.exit();
        self.free_slot = first_slot;
        exits
    }
}
