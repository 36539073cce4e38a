//! Pass: what is computed twice is computed once. Two expressions are one when they are the same operation on the same
//! operands; the node that comes first names it.

use std::collections::HashMap;

use crate::ir::{Expr, Program, Stage, Ty};

/// Shares in both stages.
pub(crate) fn share(program: &mut Program<'_>) {
    share_stage(&mut program.fragment);
    share_stage(&mut program.vertex);
}

fn share_stage<'a>(stage: &mut Stage<'a>) {
    let mut known: HashMap<(Expr<'a>, Ty), _> = HashMap::new();
    stage.rebuild(|arena, _, entry| {
        let key = (entry.expr.clone(), entry.ty);
        Some(*known.entry(key).or_insert_with(|| arena.push(entry)))
    });
}
