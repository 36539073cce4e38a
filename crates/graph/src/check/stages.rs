//! Problems of stages: what feeds the surface's height runs in the vertex stage, which has no implicit derivatives and may lack a
//! context. And what the stages do that a user may not expect.

use super::Checker;
use crate::context::{Context, context};
use crate::document::{SURFACE_MIX, SocketRef};
use crate::node_def::Default;
use crate::value::Value;

/// Perceptual roughness below which punctual lights draw this value instead.
const PUNCTUAL_ROUGHNESS_FLOOR: f32 = 0.045;

pub(super) fn check(checker: &mut Checker) {
    let parts = checker.parts();
    let mut feeding: Vec<&str> = parts
        .iter()
        .filter_map(|surface| checker.wiring.incoming(surface, "height"))
        .map(|height| height.node.as_str())
        .collect();
    if !feeding.is_empty() || is_displaced(checker, &parts) {
        let mixes = checker.live.iter().filter(|id| is_mix(checker, id));
        feeding.extend(mixes.filter_map(|id| checker.wiring.incoming(id, "t")).map(|weight| weight.node.as_str()));
        feeding.sort_unstable();
    }
    // A ring is reported as such.
    for id in checker.wiring.order(&feeding).unwrap_or_default() {
        vertex_stage(checker, id);
    }
    for surface in parts {
        roughness(checker, surface);
    }
}

fn is_mix(checker: &Checker, id: &str) -> bool {
    checker.graph.nodes.get(id).is_some_and(|node| node.node == SURFACE_MIX)
}

/// Whether a height is set on one of some surfaces, which are sorted, or may be by a parameter.
fn is_displaced(checker: &Checker, surfaces: &[&str]) -> bool {
    let set = |surface: &&str| {
        let value = checker.graph.nodes.get(*surface).and_then(|node| node.values.get("height"));
        value.and_then(Value::components).is_some_and(|c| c.iter().any(|x| *x != 0.0))
    };
    let exposed =
        |socket: &SocketRef| socket.socket == "height" && surfaces.binary_search(&socket.node.as_str()).is_ok();
    surfaces.iter().any(set) || checker.document.parameters.iter().any(|parameter| exposed(&parameter.socket))
}

fn vertex_stage(checker: &mut Checker, id: &str) {
    let Some(def) = checker.graph.nodes.get(id).and_then(|node| checker.library.get(&node.node)) else {
        return;
    };
    if def.function.implicit_derivatives && def.vertex_function.is_none() {
        let message = format!(
            "it feeds the surface's height, which is computed for each vertex, but `{}` compares neighbouring pixels and works in the fragment stage only; feed height from another node",
            def.id
        );
        checker.wrong(id, None, message);
    }
    for input in &def.inputs {
        let is_free = checker.wiring.incoming(id, &input.name).is_none()
            && !checker.graph.nodes[id].values.contains_key(&input.name);
        let reads = match &input.default {
            Default::Context(name) if is_free => context(name),
            _ => None,
        };
        if let Some(message) = reads.and_then(vertex_stage_lacks) {
            checker.wrong(id, Some(&input.name), message);
        }
    }
}

/// Why a context cannot feed the height, if it cannot.
fn vertex_stage_lacks(context: &Context) -> Option<String> {
    (!context.vertex).then(|| {
        format!(
            "it reads `{}` and feeds the surface's height, which is computed for each vertex, where that is not known; link or set another value",
            context.name
        )
    })
}

fn roughness(checker: &mut Checker, surface: &str) {
    const SOCKET: &str = "perceptual_roughness";
    let Some(node) = checker.graph.nodes.get(surface) else { return };
    let default = || {
        let def = checker.library.get(&node.node)?;
        match &def.inputs.iter().find(|input| input.name == SOCKET)?.default {
            Default::Value(value) => Some(value),
            _ => None,
        }
    };
    let constant = match (checker.wiring.incoming(surface, SOCKET), node.values.get(SOCKET).or_else(default)) {
        (None, Some(Value::Number(x) | Value::Decimal { nearest: x, .. })) => Some(*x),
        _ => None,
    };
    if let Some(x) = constant.filter(|x| *x < PUNCTUAL_ROUGHNESS_FLOOR) {
        let message = format!(
            "punctual lights draw a roughness of {x} as {PUNCTUAL_ROUGHNESS_FLOOR}, for a sharper highlight would be smaller than a pixel; environments use {x}"
        );
        checker.warn(surface, Some(SOCKET), message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::Type;

    #[test]
    fn a_context_of_the_fragment_stage_cannot_feed_the_height() {
        let context = Context { name: "front_facing", ty: Type::Bool, vertex: false, help: "" };
        assert!(vertex_stage_lacks(&context).is_some_and(|message| message.contains("front_facing")));
        assert!(vertex_stage_lacks(&Context { vertex: true, ..context }).is_none());
    }
}
