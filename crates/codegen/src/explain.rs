//! What leaving something out of a shader saves: each thing is put back alone, and the two shaders are counted; of a node, what its
//! function does.
//!
//! Counted is the text that codegen writes, as [`cost()`] counts it, before any compiler has seen it: a driver may drop part of
//! what is put back. What is put back alone shares nothing with other things that were left out, so the savings of several are
//! about, and not exactly, their sum.

use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::needs::{EnvironmentNeeds, Needs};

use crate::fate::dropped_nodes;
use crate::passes::plan::Keep;
use crate::pipeline::{Material, Sound};
use crate::{CodegenError, DroppedNode, Fold, Shader, cost, slopes};

/// A paragraph of the comment at the top of a shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// What it is about, in one word.
    pub lead: &'static str,
    /// What it says.
    pub text: String,
}

/// Longest text, in bytes, of which savings are counted, and most nodes that reach the surface. A shader of a thousand nodes has less.
/// Beyond, each count would take a good part of a second, and what is left out would save next to nothing of such a shader.
const MAX_COUNTED: usize = 192 << 10;
const MAX_COUNTED_NODES: usize = 4000;

/// The shader that [`shader()`](crate::shader()) makes under [`Fold::Export`], which says also what each thing saves that was left
/// out, which nodes are not in it, which pictures are read by arithmetic, and in its comment what `remarks` say. It makes one shader more for each thing that was left out:
/// some milliseconds each. In a shader of more than 192 KiB, or of more than 4000 nodes, savings are not counted.
///
/// # Errors
/// As for [`shader()`](crate::shader()).
pub fn explained(
    document: &Document,
    library: &Library,
    needs: &Needs,
    remarks: &[Remark],
) -> Result<Shader, CodegenError> {
    let sound = Sound::new(document, library)?;
    let material = sound.material()?;
    let mut draft = material.draft(needs, Fold::Export, None)?;
    let dropped_nodes = dropped_nodes(&material.types, &draft.fates, &draft.plan, material.index);
    let mut remarks = remarks.to_vec();
    remarks.extend(of_nodes(&dropped_nodes));
    let slope_reads = slopes::slopes(&draft.program, material.index);
    remarks.extend(slopes::remark(&slope_reads));
    let mut shader = draft.shader(&material, needs, &remarks)?;
    if shader.wgsl.len() <= MAX_COUNTED
        && material.types.nodes.len() <= MAX_COUNTED_NODES
        && let Some(own) = total(&shader)
    {
        for dropped in &mut draft.plan.dropped {
            let kept = with(&material, needs, dropped.kept_by);
            dropped.instructions = kept.and_then(|shader| Some(total(&shader)?.saturating_sub(own)));
        }
        shader = draft.shader(&material, needs, &remarks)?;
    }
    Ok(Shader { dropped_nodes, slope_reads, ..shader })
}

/// What is said of nodes in the comment: it names none, since what is left out leaves no trace.
fn of_nodes(dropped: &[DroppedNode]) -> Option<Remark> {
    let saved = dropped.iter().filter_map(|node| node.instructions).fold(0, u32::saturating_add);
    let text = match dropped.len() {
        0 => return None,
        1 => format!("1 node that nothing reads or whose value is known (saves {saved} instructions)"),
        count => format!("{count} nodes that nothing reads or whose values are known (save {saved} instructions)"),
    };
    Some(Remark { lead: "left out", text })
}

/// Instructions of both stages.
fn total(shader: &Shader) -> Option<u32> {
    let cost = cost(shader).ok()?;
    Some(cost.vertex.total().saturating_add(cost.fragment.total()))
}

/// The shader that has this one thing.
fn with(material: &Material<'_>, needs: &Needs, keep: Keep) -> Option<Shader> {
    let mut needs = needs.clone();
    match keep {
        Keep::Light => needs.directional_lights = 1,
        Keep::Environment => needs.environment = Some(EnvironmentNeeds { rotated: false }),
        Keep::Method(term, method) => needs.methods.set(term, method).ok()?,
        _ => {}
    }
    material.draft(&needs, Fold::Export, Some(keep)).ok()?.shader(material, &needs, &[]).ok()
}
