//! What leaving something out of a shader saves: each thing is put back alone, and the two shaders are counted.
//!
//! Counted is the text that codegen writes, as [`cost()`] counts it, before any compiler has seen it: a driver may drop part of
//! what is put back. What is put back alone shares nothing with other things that were left out, so the savings of several are
//! about, and not exactly, their sum.

use halfvector_graph::document::{AlphaMode, Document};
use halfvector_graph::library::Library;
use halfvector_graph::needs::{EnvironmentNeeds, Needs};

use crate::passes::plan::Keep;
use crate::pipeline::{Extra, Making};
use crate::{CodegenError, Fold, Shader, cost};

/// A paragraph of the comment at the top of a shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// What it is about, in one word.
    pub lead: &'static str,
    /// What it says.
    pub text: String,
}

/// Longest text, in bytes, of which savings are counted. A shader of a thousand nodes has less. Beyond, each count would take a good part of
/// a second, and what is left out would save next to nothing of such a shader.
const MAX_COUNTED: usize = 256 << 10;

/// The shader that [`shader()`](crate::shader()) makes under [`Fold::Export`], which says also what each thing saves that was left
/// out, and in its comment what `remarks` say. It makes one shader more for each of those things: some milliseconds each. In a
/// shader of more than 256 KiB savings are not counted.
///
/// # Errors
/// As for [`shader()`](crate::shader()).
pub fn explained(
    document: &Document,
    library: &Library,
    needs: &Needs,
    remarks: &[Remark],
) -> Result<Shader, CodegenError> {
    let making = Making { document, library, needs, fold: Fold::Export };
    let shader = making.make(Extra::default())?;
    let instructions = if shader.wgsl.len() <= MAX_COUNTED { total(&shader) } else { None };
    let saving = |keep: Keep| instructions.and_then(|own| Some(total(&with(making, keep)?)?.saturating_sub(own)));
    let saved: Vec<Option<u32>> = shader.dropped.iter().map(|dropped| saving(dropped.kept_by)).collect();
    making.make(Extra { remarks, saved: &saved, ..Extra::default() })
}

/// Instructions of both stages.
fn total(shader: &Shader) -> Option<u32> {
    let cost = cost(shader).ok()?;
    Some(cost.vertex.total().saturating_add(cost.fragment.total()))
}

/// The shader that has this one thing.
fn with(making: Making<'_>, keep: Keep) -> Option<Shader> {
    let (mut document, mut needs) = (making.document.clone(), making.needs.clone());
    match keep {
        Keep::Opacity if document.surface.alpha_mode == AlphaMode::Opaque => {
            document.surface.alpha_mode = AlphaMode::Blend;
        }
        Keep::Light => needs.directional_lights = 1,
        Keep::Environment => needs.environment = Some(EnvironmentNeeds { rotated: false }),
        Keep::Method(term, method) => needs.methods.set(term, method).ok()?,
        _ => {}
    }
    let making = Making { document: &document, needs: &needs, ..making };
    making.make(Extra { keep: Some(keep), ..Extra::default() }).ok()
}
