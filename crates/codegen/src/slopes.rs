//! Pictures that are read by arithmetic because their slope is seen: which, why, and what it costs.

use std::collections::BTreeMap;

use crate::SlopeRead;
use crate::cost::Instructions;
use crate::ir::{Expr, Program};
use crate::link::Index;

/// Why a sampler does not do.
const WHY: &str = "devices blend texels by weights of 8 bits, which show as steps in a slope";

/// The nodes of a program that read pictures for a slope, in order of id.
pub(crate) fn slopes(program: &Program<'_>, index: &Index) -> Vec<SlopeRead> {
    let mut reads = BTreeMap::new();
    for stage in [&program.fragment, &program.vertex] {
        for entry in &stage.arena.exprs {
            let (Expr::Call { function, generic, .. }, Some(node)) = (&entry.expr, entry.node) else { continue };
            let info = &program.nodes[node];
            let def = info.def;
            let plain = [Some(&def.function), def.vertex_function.as_ref()].into_iter().flatten();
            let Some(plain) =
                plain.map(|plain| plain.name.as_str()).find(|name| index.blended(name) == Some(*function))
            else {
                continue;
            };
            let cost =
                |name: &str| -> Option<Instructions> { Some(index.compiled(index.instance(name, *generic)?)?.cost) };
            let more = cost(function).zip(cost(plain)).map(|(own, plain)| own.total().saturating_sub(plain.total()));
            let read = reads.entry(info.id).or_insert_with(|| SlopeRead {
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
pub(crate) fn remark(reads: &[SlopeRead]) -> Option<crate::Remark> {
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
        format!("where its slope is seen, {} is blended from texels by arithmetic: {WHY}{more}", names.join(", "));
    Some(crate::Remark { lead: "slopes", text })
}
