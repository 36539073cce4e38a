//! Functions that read pictures for a slope: twins of the library's and of a document's functions that take a sampler, with the reads
//! exchanged for arithmetic (`shaders/nodes/textures/blend_texels.wgsl` says why). Only names are exchanged, as for methods: what stands
//! in a read's place takes the same arguments.

use std::borrow::Cow;
use std::collections::HashMap;

use halfvector_shaders::{Item, ItemKind, SliceError, emit, slice};

/// Where the reads by arithmetic stand; they have no twins.
pub(crate) const FILE: &str = "nodes/textures/blend_texels.wgsl";

/// What stands for what in a twin. Derivatives are those of the block of 2 x 2 pixels, which then reads one level: its difference is
/// one of places.
const READS: [(&str, &str); 6] = [
    ("textureSample", "blended_sample"),
    ("textureSampleLevel", "blended_level"),
    ("textureSampleGrad", "blended_grad"),
    ("dpdx", "dpdxCoarse"),
    ("dpdy", "dpdyCoarse"),
    ("fwidth", "fwidthCoarse"),
];

fn has_twin(item: &Item) -> bool {
    item.kind == ItemKind::Fn && item.dependencies.iter().any(|name| name == "sampler")
}

/// The functions of a text that have a twin, with its name.
pub(crate) fn twins(source: &str) -> Result<HashMap<String, String>, SliceError> {
    // No function of the library is named so, which a test holds, and none of a document's: those begin with `custom`.
    let twin = |item: Item| (format!("blended_{}", item.name), item.name);
    Ok(slice(source)?.into_iter().filter(has_twin).map(twin).map(|(twin, name)| (name, twin)).collect())
}

/// A text with its twins below. `twins` has those of other texts, too, which its functions may call.
pub(crate) fn with_twins<'s>(source: &'s str, twins: &HashMap<String, String>) -> Result<Cow<'s, str>, SliceError> {
    let mut whole = Cow::Borrowed(source);
    for item in slice(source)?.iter().filter(|item| twins.contains_key(&item.name)) {
        let exchanged = |name: &str| {
            let read = || READS.iter().find(|(read, _)| *read == name).map(|(_, by)| (*by).to_owned());
            twins.get(name).cloned().or_else(read)
        };
        let text = emit(source, item, exchanged);
        whole.to_mut().push_str(&format!("\n/// For a slope, with texels blended by arithmetic:\n///\n{text}\n"));
    }
    Ok(whole)
}
