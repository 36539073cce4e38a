//! Pictures that are read by arithmetic because they feed the height: which, why, and what it costs.

use std::collections::BTreeMap;

use crate::HeightRead;
use crate::cost::Instructions;
use crate::ir::{Expr, Program};
use crate::link::Index;

/// Why a sampler does not do.
const WHY: &str = "devices blend texels by weights of 8 bits, which show as steps in the slope of a height";

/// The nodes of a program that read pictures for the height, in order of id.
pub(crate) fn heights(program: &Program<'_>, index: &Index) -> Vec<HeightRead> {
    let mut reads = BTreeMap::new();
    for stage in [&program.fragment, &program.vertex] {
        for entry in &stage.arena.exprs {
            let (Expr::Call { function, generic, .. }, Some(node)) = (&entry.expr, entry.node) else { continue };
            let info = &program.nodes[node];
            let is_read = |[fragment, vertex]: &[halfvector_graph::node_def::Function; 2]| {
                fragment.name == *function || vertex.name == *function
            };
            if !info.def.height_functions.as_ref().is_some_and(is_read) {
                continue;
            }
            let cost =
                |name: &str| -> Option<Instructions> { Some(index.compiled(index.instance(name, *generic)?)?.cost) };
            let plain = info.def.vertex_function.as_ref().map_or(&info.def.function, |plain| {
                if std::ptr::eq(stage, &program.vertex) { plain } else { &info.def.function }
            });
            let more =
                cost(function).zip(cost(&plain.name)).map(|(own, plain)| own.total().saturating_sub(plain.total()));
            let read = reads.entry(info.id).or_insert_with(|| HeightRead {
                node: info.id.clone(),
                label: info.label.to_owned(),
                why: WHY.to_owned(),
                instructions: Some(0),
            });
            read.instructions = read.instructions.zip(more).map(|(a, b)| a.saturating_add(b));
        }
    }
    reads.into_values().collect()
}

/// What the comment says of them.
pub(crate) fn remark(reads: &[HeightRead]) -> Option<crate::Remark> {
    /// So many are named.
    const MAX_NAMED: usize = 4;
    if reads.is_empty() {
        return None;
    }
    let mut names: Vec<String> = reads.iter().take(MAX_NAMED).map(|read| format!("`{}`", read.label)).collect();
    if reads.len() > MAX_NAMED {
        names.push(format!("{} more", reads.len() - MAX_NAMED));
    }
    let more: Option<u32> = reads.iter().map(|read| read.instructions).sum();
    let more = more.map_or_else(String::new, |more| format!(" ({more} instructions more than by the sampler)"));
    let text =
        format!("where it feeds the height, {} is blended from texels by arithmetic: {WHY}{more}", names.join(", "));
    Some(crate::Remark { lead: "heights", text })
}
