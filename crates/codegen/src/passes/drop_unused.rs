//! Pass: what no wanted value uses and no function reads is left out, and a node of several outputs of which one is used is computed by its
//! cheaper form for that output, where it has one.

use std::collections::BTreeSet;

use halfvector_graph::node_def::Argument;

use crate::ir::{Expr, Id, NodeInfo, Program, Stage, Ty};
use crate::link::Index;

/// Drops in both stages.
pub(crate) fn drop_unused(program: &mut Program<'_>) {
    drop_dead(&mut program.fragment);
    drop_dead(&mut program.vertex);
    // Only the fragment's functions have single-output forms that may take implicit derivatives.
    if narrow(&mut program.fragment, &program.nodes) {
        drop_dead(&mut program.fragment);
    }
}

/// Drops arguments that functions do not read.
pub(crate) fn drop_unread(stage: &mut Stage<'_>, index: &Index) {
    for entry in &mut stage.arena.exprs {
        if let Expr::Call { function, arguments, .. } = &mut entry.expr {
            let unread = index.unread(function);
            let mut places = 0..;
            arguments.retain(|_| places.next().is_none_or(|place| !unread.contains(&place)));
        }
    }
}

/// Drops what no root uses.
pub(crate) fn drop_dead(stage: &mut Stage<'_>) {
    let live = stage.live();
    stage.rebuild(|arena, old, entry| live[old.index()].then(|| arena.push(entry)));
}

/// Exchanges calls for single-output forms; says whether it did.
fn narrow<'a>(stage: &mut Stage<'a>, nodes: &[NodeInfo<'a>]) -> bool {
    let mut outputs: Vec<BTreeSet<&'a str>> = vec![BTreeSet::new(); stage.arena.exprs.len()];
    let mut whole: Vec<bool> = vec![false; stage.arena.exprs.len()];
    for entry in &stage.arena.exprs {
        match &entry.expr {
            Expr::Field { of, name } => {
                outputs[of.index()].insert(name);
            }
            other => other.uses().iter().for_each(|id| whole[id.index()] = true),
        }
    }
    let mut narrowed: BTreeSet<Id> = BTreeSet::new();
    stage.rebuild(|arena, old, mut entry| {
        if let Expr::Field { of, .. } = entry.expr
            && narrowed.contains(&of)
        {
            return Some(of);
        }
        let only = outputs[old.index()].iter().next().copied();
        if let (Expr::Call { function, generic, arguments }, Some(node), Some(only)) = (&entry.expr, entry.node, only)
            && outputs[old.index()].len() == 1
            && !whole[old.index()]
        {
            let def = nodes[node].def;
            let cheaper = def.output_functions.iter().find(|(output, _)| output == only).map(|(_, f)| f);
            let output = def.outputs.iter().find(|o| o.name == only);
            if let (Some(cheaper), Some(output), true) = (cheaper, output, *function == def.function.name) {
                let position = |argument: &Argument| def.function.arguments.iter().position(|a| a == argument);
                let subset: Option<Vec<Id>> =
                    cheaper.arguments.iter().map(|a| arguments.get(position(a)?).copied()).collect();
                if let Some(subset) = subset {
                    let ty = match output.ty {
                        halfvector_graph::value::SocketType::Value(ty) => ty,
                        _ => nodes[node].generic.unwrap_or(halfvector_graph::value::Type::F32),
                    };
                    let generic = *generic;
                    entry.expr = Expr::Call { function: &cheaper.name, generic, arguments: subset };
                    entry.ty = Ty::Value(ty);
                    let id = arena.push(entry);
                    narrowed.insert(id);
                    return Some(id);
                }
            }
        }
        Some(arena.push(entry))
    });
    !narrowed.is_empty()
}
