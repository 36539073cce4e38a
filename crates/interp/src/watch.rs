//! What a program decides by, as further outputs: the numbers whose sign or whole part makes its results jump, and those at
//! whose 0 they leave the finite numbers. Whoever searches for such places sees between two points that one of them passes.

use std::collections::HashSet;

use crate::ir::{Class, Inst, Ir, NONE, Node, Op, Origin, Reg, Register};
use crate::kernel::{CompareOp, Convert, FloatOp};

/// How a watched number matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Watch {
    /// A divisor, or the distance to the end of the domain of a root, a logarithm, a power or an angle: at 0 the result may be
    /// infinite, no number, or steep without limit.
    Pole,
    /// The difference of two numbers that are compared, or a number whose sign is taken: the result may jump at 0.
    Sign,
    /// A number of which the whole part is taken: the result may jump where it passes a whole number.
    Whole,
}

/// Most numbers that are watched; what comes later in the program is not.
const MOST: usize = 4096;

/// Adds an output for each number that is watched: of the last time that it was computed in a loop, and NaN where it was not.
pub(crate) fn watch(ir: &mut Ir) -> Vec<Watch> {
    let mut nodes = std::mem::take(&mut ir.nodes);
    let mut watcher = Watcher { ir, watches: Vec::new(), outputs: Vec::new() };
    watcher.nodes(&mut nodes);
    let Watcher { watches, outputs, .. } = watcher;
    let unknown = [Class::Float, Class::Double].map(|class| number(ir, class, f64::NAN));
    let begin = |reg: &Reg| {
        let a = unknown[usize::from(ir.registers[*reg as usize].class == Class::Double)];
        Node::Inst(Inst { op: Op::Move, dst: *reg, a, b: NONE, c: NONE })
    };
    nodes.splice(0..0, outputs.iter().map(begin).collect::<Vec<_>>());
    ir.nodes = nodes;
    ir.outputs.extend(outputs);
    watches
}

fn number(ir: &mut Ir, class: Class, x: f64) -> Reg {
    register(ir, class, Origin::Constant(x.to_bits()))
}

fn register(ir: &mut Ir, class: Class, origin: Origin) -> Reg {
    ir.registers.push(Register { class, origin });
    (ir.registers.len() - 1) as Reg
}

struct Watcher<'i> {
    ir: &'i mut Ir,
    watches: Vec<Watch>,
    outputs: Vec<Reg>,
}

impl Watcher<'_> {
    fn nodes(&mut self, nodes: &mut Vec<Node>) {
        let mut with = Vec::with_capacity(nodes.len());
        // The components of a vector are divided by one length.
        let mut known = HashSet::new();
        for mut node in std::mem::take(nodes) {
            match &mut node {
                Node::Inst(inst) => self.inst(*inst, &mut known, &mut with),
                Node::If { accept, reject, .. } => {
                    self.nodes(accept);
                    self.nodes(reject);
                }
                Node::Loop { body, continuing, .. } => {
                    self.nodes(body);
                    self.nodes(continuing);
                }
                Node::Switch { body, .. } | Node::Scope { body, .. } => self.nodes(body),
                Node::Break | Node::Continue | Node::Return | Node::Kill => {}
            }
            with.push(node);
        }
        *nodes = with;
    }

    /// Puts what watches an instruction's operands in front of it.
    fn inst(&mut self, Inst { op, a, b, c: _, .. }: Inst, known: &mut HashSet<(Reg, Watch)>, with: &mut Vec<Node>) {
        match op {
            Op::Float(FloatOp::Div) => self.add(b, Watch::Pole, known, with),
            Op::Float(FloatOp::Rem) => {
                self.add(b, Watch::Pole, known, with);
                self.combined(FloatOp::Div, a, b, Watch::Whole, with);
            }
            Op::Float(FloatOp::Smoothstep) => self.combined(FloatOp::Sub, b, a, Watch::Pole, with),
            Op::Float(FloatOp::Log | FloatOp::Log2 | FloatOp::Sqrt | FloatOp::InverseSqrt | FloatOp::Pow) => {
                self.add(a, Watch::Pole, known, with);
            }
            Op::Float(FloatOp::Acos | FloatOp::Asin | FloatOp::Atanh) => {
                let size = self.emit(FloatOp::Abs, a, NONE, with);
                let one = self.number(a, 1.0);
                self.combined(FloatOp::Sub, one, size, Watch::Pole, with);
            }
            Op::Float(FloatOp::Acosh) => {
                let one = self.number(a, 1.0);
                self.combined(FloatOp::Sub, a, one, Watch::Pole, with);
            }
            Op::Float(FloatOp::Atan2) => {
                self.add(a, Watch::Sign, known, with);
                let sizes = [a, b].map(|reg| self.emit(FloatOp::Abs, reg, NONE, with));
                self.combined(FloatOp::Max, sizes[0], sizes[1], Watch::Pole, with);
            }
            Op::Float(FloatOp::Floor | FloatOp::Ceil | FloatOp::Fract | FloatOp::Trunc)
            | Op::Convert(Convert::SignedFromFloat | Convert::UnsignedFromFloat) => {
                self.add(a, Watch::Whole, known, with)
            }
            Op::Float(FloatOp::Round) => {
                let half = self.number(a, 0.5);
                self.combined(FloatOp::Add, a, half, Watch::Whole, with);
            }
            Op::Float(FloatOp::Sign) => self.add(a, Watch::Sign, known, with),
            Op::Float(FloatOp::Step) => self.combined(FloatOp::Sub, b, a, Watch::Sign, with),
            Op::Compare(CompareOp::Equal | CompareOp::NotEqual | CompareOp::Less | CompareOp::LessEqual) => {
                self.combined(FloatOp::Sub, a, b, Watch::Sign, with);
            }
            _ => {}
        }
    }

    fn class(&self, reg: Reg) -> Class {
        self.ir.registers[reg as usize].class
    }

    /// A constant of the class of another register.
    fn number(&mut self, like: Reg, x: f64) -> Reg {
        let class = self.class(like);
        number(self.ir, class, x)
    }

    fn is_constant(&self, reg: Reg) -> bool {
        reg == NONE || matches!(self.ir.registers[reg as usize].origin, Origin::Constant(_))
    }

    fn emit(&mut self, op: FloatOp, a: Reg, b: Reg, with: &mut Vec<Node>) -> Reg {
        let class = self.class(a);
        let dst = register(self.ir, class, Origin::Temporary);
        with.push(Node::Inst(Inst { op: Op::Float(op), dst, a, b, c: NONE }));
        dst
    }

    /// Watches what an operation makes of two registers.
    fn combined(&mut self, op: FloatOp, a: Reg, b: Reg, watch: Watch, with: &mut Vec<Node>) {
        if !(self.is_constant(a) && self.is_constant(b)) {
            let reg = self.emit(op, a, b, with);
            self.add(reg, watch, &mut HashSet::new(), with);
        }
    }

    fn add(&mut self, reg: Reg, watch: Watch, known: &mut HashSet<(Reg, Watch)>, with: &mut Vec<Node>) {
        // A variable may be another number by now.
        let is_value = !matches!(self.ir.registers[reg as usize].origin, Origin::Variable(_));
        let is_new = !self.is_constant(reg) && (known.insert((reg, watch)) || !is_value);
        if is_new && self.watches.len() < MOST {
            // Of the scope around all: it is read at the end.
            let class = self.class(reg);
            let dst = register(self.ir, class, Origin::Variable(0));
            with.push(Node::Inst(Inst { op: Op::Move, dst, a: reg, b: NONE, c: NONE }));
            self.watches.push(watch);
            self.outputs.push(dst);
        }
    }
}
