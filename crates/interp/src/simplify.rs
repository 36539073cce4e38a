//! Leaves out what nothing reads: values without a use, variables that are only written, and initial values that are
//! overwritten at once.

use std::collections::HashMap;

use crate::ir::{Ir, NONE, Node, Op, Origin};

pub(crate) fn simplify(ir: &mut Ir) {
    let mut nodes = std::mem::take(&mut ir.nodes);
    overwritten(ir, &mut nodes);
    // Once more for what only dead code has read.
    for _ in 0..2 {
        let mut needed = vec![false; ir.registers.len()];
        mark_variables(ir, &nodes, &mut needed);
        for reg in &ir.outputs {
            needed[*reg as usize] = true;
        }
        sweep(ir, &mut nodes, &mut needed);
    }
    ir.nodes = nodes;
}

/// A variable may be read before it is written, in the next round of a loop: every read anywhere counts.
fn mark_variables(ir: &Ir, nodes: &[Node], needed: &mut [bool]) {
    let mut mark = |reg: u32| {
        if reg != NONE && matches!(ir.registers[reg as usize].origin, Origin::Variable(_)) {
            needed[reg as usize] = true;
        }
    };
    let mut open = vec![nodes];
    while let Some(nodes) = open.pop() {
        for node in nodes {
            match node {
                Node::Inst(inst) => ir.sources(inst, &mut mark),
                Node::If { condition, accept, reject, .. } => {
                    mark(*condition);
                    open.extend([&accept[..], &reject[..]]);
                }
                Node::Loop { body, continuing, break_if, .. } => {
                    mark(*break_if);
                    open.extend([&body[..], &continuing[..]]);
                }
                Node::Switch { body, .. } | Node::Scope { body, .. } => open.push(body),
                Node::Break | Node::Continue | Node::Return | Node::Kill => {}
            }
        }
    }
}

/// Drops, from the last to the first, instructions whose results nothing needs, and blocks that are left empty.
fn sweep(ir: &Ir, nodes: &mut Vec<Node>, needed: &mut [bool]) {
    let mut kept = Vec::with_capacity(nodes.len());
    for mut node in std::mem::take(nodes).into_iter().rev() {
        let keep = match &mut node {
            Node::Inst(inst) => {
                // What is written into a buffer is for others.
                let mut used = matches!(inst.op, Op::Store(_));
                ir.destinations(inst, |reg| used |= needed[reg as usize]);
                if used {
                    ir.sources(inst, |reg| needed[reg as usize] = true);
                }
                used
            }
            Node::If { condition, accept, reject, .. } => {
                sweep(ir, reject, needed);
                sweep(ir, accept, needed);
                needed[*condition as usize] = true;
                !accept.is_empty() || !reject.is_empty()
            }
            // A loop stays even when it is empty: it may be endless, and that is an error.
            Node::Loop { body, continuing, break_if, .. } => {
                if *break_if != NONE {
                    needed[*break_if as usize] = true;
                }
                sweep(ir, continuing, needed);
                sweep(ir, body, needed);
                true
            }
            Node::Switch { body, .. } | Node::Scope { body, .. } => {
                sweep(ir, body, needed);
                !body.is_empty()
            }
            Node::Break | Node::Continue | Node::Return | Node::Kill => true,
        };
        if keep {
            kept.push(node);
        }
    }
    kept.reverse();
    *nodes = kept;
}

/// Drops a move into a variable that is followed, in the same straight line and before any read, by another one.
fn overwritten(ir: &Ir, nodes: &mut Vec<Node>) {
    let mut pending: HashMap<u32, usize> = HashMap::new();
    let mut dead = vec![false; nodes.len()];
    for (i, node) in nodes.iter_mut().enumerate() {
        match node {
            Node::Inst(inst) => {
                ir.sources(inst, |reg| {
                    pending.remove(&reg);
                });
                if let Op::Scatter(table) = inst.op {
                    for reg in ir.table(table) {
                        pending.remove(reg);
                    }
                }
                let variable =
                    inst.op == Op::Move && matches!(ir.registers[inst.dst as usize].origin, Origin::Variable(_));
                if variable && let Some(before) = pending.insert(inst.dst, i) {
                    dead[before] = true;
                }
            }
            Node::If { accept, reject, .. } => {
                pending.clear();
                overwritten(ir, accept);
                overwritten(ir, reject);
            }
            Node::Loop { body, continuing, .. } => {
                pending.clear();
                overwritten(ir, body);
                overwritten(ir, continuing);
            }
            Node::Switch { body, .. } | Node::Scope { body, .. } => {
                pending.clear();
                overwritten(ir, body);
            }
            Node::Break | Node::Continue | Node::Return | Node::Kill => pending.clear(),
        }
    }
    let mut dead = dead.into_iter();
    nodes.retain(|_| !dead.next().unwrap_or(false));
}
