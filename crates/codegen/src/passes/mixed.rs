//! Part of lowering: a socket of the material's surface, which may be mixed of several surfaces. A mixture of surfaces is one of
//! their parameters (`shaders/nodes/surface/mix.wgsl`), so each socket is mixed by itself: one that is the same on both sides is
//! not mixed at all, and a lobe that both lack is still known to be absent.

use std::collections::{BTreeSet, HashMap};

use halfvector_graph::document::SURFACE_MIX;
use halfvector_graph::value::Type;

use crate::ir::{Arena, Entry, Expr, Id, Table};
use crate::passes::lower::{Lowering, StageKind, unit_normal};
use crate::passes::specialise::NORMALS;
use crate::{CodegenError, Fold};

/// The library's function that mixes two normals.
pub(crate) const MIX_NORMALS: &str = "surface_mix_normals";

impl<'a> Lowering<'a, '_> {
    /// The expression of a socket of the material's surface; `None` when the surface has no such input. Normals are unit.
    pub(crate) fn surface(
        &mut self,
        arena: &mut Arena<'a>,
        table: &mut Table,
        socket: &'static str,
    ) -> Result<Option<Id>, CodegenError> {
        let mut made: HashMap<usize, Id> = HashMap::new();
        let mut units: HashMap<Id, Id> = HashMap::new();
        // Each node comes after what feeds it.
        for node in 0..=self.types.surface {
            if !self.types.gives_surface(node) {
                continue;
            }
            let id = if self.types.nodes[node].def.id == SURFACE_MIX {
                let side = |input: &str| made.get(&self.types.source(node, input)?).copied();
                match (side("a"), side("b")) {
                    (Some(a), Some(b)) => Some(self.mixed(arena, table, node, socket, [a, b])?),
                    _ => None,
                }
            } else {
                let id = self.input(arena, table, node, socket)?;
                match id.filter(|_| NORMALS.contains(&socket)) {
                    Some(id) => Some(*units.entry(id).or_insert_with(|| unit_normal(arena, self.types, id))),
                    None => id,
                }
            };
            made.extend(id.map(|id| (node, id)));
        }
        Ok(made.get(&self.types.surface).copied())
    }

    /// One socket of a mixture.
    fn mixed(
        &mut self,
        arena: &mut Arena<'a>,
        table: &mut Table,
        node: usize,
        socket: &'static str,
        sides: [Id; 2],
    ) -> Result<Id, CodegenError> {
        let [a, b] = sides;
        // A height that both lack needs no weight, which may be one that only the fragment stage has.
        let flat = |id: Id| match &arena.get(id).expr {
            Expr::Literal(literal) => literal.is_all(0.0),
            Expr::Input(input) if self.fold == Fold::Live => table.inputs[*input].value.iter().all(|x| *x == 0.0),
            _ => false,
        };
        if are_same(arena, a, b) || self.stage == StageKind::Vertex && flat(a) && flat(b) {
            return Ok(a);
        }
        let weight = match self.weights.get(&node) {
            Some(weight) => *weight,
            None => {
                let t = self.input(arena, table, node, "t")?.ok_or(CodegenError::NoSurface)?;
                let held = Expr::Builtin { name: "saturate", arguments: vec![t] };
                let ty = crate::ir::Ty::Value(Type::F32);
                let weight = arena.push(Entry { expr: held, ty, node: Some(node), hint: "weight" });
                self.weights.insert(node, weight);
                weight
            }
        };
        let arguments = vec![a, b, weight];
        let expr = if NORMALS.contains(&socket) {
            Expr::Call { function: MIX_NORMALS, generic: None, arguments }
        } else {
            Expr::Builtin { name: "mix", arguments }
        };
        let ty = arena.get(a).ty;
        Ok(arena.push(Entry { expr, ty, node: Some(node), hint: socket }))
    }
}

/// Whether two expressions are known to have one value: they are one, or the same constant, number or context.
pub(crate) fn are_same(arena: &Arena<'_>, a: Id, b: Id) -> bool {
    let (first, second) = (arena.get(a), arena.get(b));
    let is_plain = matches!(first.expr, Expr::Literal(_) | Expr::Input(_) | Expr::Context(_));
    a == b || is_plain && first.expr == second.expr && first.ty == second.ty
}

/// What an expression is mixed of: itself where it is no mixture. Each once, as often as it is mixed in.
pub(crate) fn parts(arena: &Arena<'_>, id: Id) -> BTreeSet<Id> {
    let (mut open, mut seen, mut parts) = (vec![id], BTreeSet::new(), BTreeSet::new());
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        match &arena.get(id).expr {
            Expr::Builtin { name: "mix", arguments } => open.extend(arguments),
            Expr::Builtin { name: "saturate", arguments } => open.extend(arguments),
            _ => {
                parts.insert(id);
            }
        }
    }
    parts
}
