//! Emission: a program and its plan as WGSL text, with reflection and the table of what comes from where.

mod environment;
pub(crate) mod expression;
mod fragment;
mod header;
mod interface;
mod lights;
pub(crate) mod material;
mod terms;
pub(crate) mod text;
mod tidy;
mod value;
pub(crate) mod vertex;

use std::collections::BTreeMap;

use halfvector_graph::document::Document;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::Needs;

use crate::emit::expression::{Names, Uses};
use crate::emit::fragment::FragmentParts;
use crate::emit::interface::Interface;
use crate::emit::material::Product;
use crate::emit::text::{Origin, Part, Text};
use crate::ir::Program;
use crate::link::{self, Index};
use crate::passes::plan::Plan;
use crate::{CodegenError, Remark, Shader};

/// The whole shader: `vs_main` and `fs_main`.
pub(crate) fn shader(
    program: &Program<'_>,
    plan: Plan,
    document: &Document,
    needs: &Needs,
    remarks: &[Remark],
    index: &Index,
    names: &Names,
) -> Result<Shader, CodegenError> {
    let alpha_cutoff = document.surface.alpha_cutoff;
    let parts = FragmentParts { program, plan: &plan, needs, alpha_cutoff, index, names };
    let (fragment, fragment_uses) = fragment::fragment(&parts)?;
    let (vertex, vertex_uses) = vertex::vertex(program, &plan, index, names, &fragment_uses.members)?;
    let interface = Interface { program, document, names, vertex: &vertex_uses, fragment: &fragment_uses };
    let reflection = interface.reflection(&plan);

    let mut text = Text::default();
    header::header(document, &plan, needs, remarks, &mut text);
    text.part = Part::Bindings;
    interface::declarations(&reflection, &mut text);
    text.line("");
    text.part = Part::Interface;
    interface::stage_structs(&reflection, &fragment_uses, &mut text);
    text.line("");
    text.append(&vertex);
    text.line("");
    text.append(&fragment);
    library(index, &[&vertex_uses, &fragment_uses], &needs.methods, &mut text);
    let methods = header::methods(&plan, needs);
    let Text { text: wgsl, segments, .. } = text;
    let (dropped, dropped_nodes, slope_reads) = (plan.dropped, Vec::new(), Vec::new());
    Ok(Shader { wgsl, reflection, segments, dropped, dropped_nodes, slope_reads, methods })
}

/// The material alone, or a part of it: one function of the context.
pub(crate) fn material(
    program: &Program<'_>,
    product: Product,
    document: &Document,
    methods: &Methods,
    index: &Index,
    names: &Names,
) -> Result<Shader, CodegenError> {
    let (body, uses) = material::material(program, product, index, names)?;
    let none = Uses::default();
    let interface = Interface { program, document, names, vertex: &none, fragment: &uses };
    let reflection = interface.material_reflection();

    let mut text = Text::default();
    header::material_header(document, product, &mut text);
    text.part = Part::Bindings;
    interface::declarations(&reflection, &mut text);
    text.part = Part::Material;
    if !uses.contexts.is_empty() {
        text.line("struct Context {");
        for context in halfvector_graph::context::CONTEXTS.iter().filter(|c| uses.contexts.contains(c.name)) {
            text.line(&format!("    // {}", context.help));
            text.line(&format!("    {}: {},", context.name, context.ty.wgsl()));
        }
        for frame in halfvector_graph::context::FRAMES.iter().filter(|f| uses.contexts.contains(f.name)) {
            text.line(&format!("    // {}", frame.help));
            text.line(&format!("    {}: mat4x4f,", frame.name));
        }
        text.line("}");
    }
    text.line("");
    text.append(&body);
    library(index, &[&uses], methods, &mut text);
    let Text { text: wgsl, segments, .. } = text;
    let (dropped, dropped_nodes, slope_reads, methods) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    Ok(Shader { wgsl, reflection, segments, dropped, dropped_nodes, slope_reads, methods })
}

/// The library's items that the stages reach, by file.
fn library(index: &Index, uses: &[&Uses], methods: &Methods, text: &mut Text) {
    let exchanged: BTreeMap<&str, &str> = link::exchanged(methods);
    let roots = uses.iter().flat_map(|u| u.functions.iter().copied()).collect();
    let mut file = "";
    for instance in index.reach(&roots, &exchanged) {
        let item = index.text(instance, &exchanged);
        let origin = Origin::Library(item.path.to_owned());
        if item.path != file {
            file = item.path;
            text.push(origin.clone(), &format!("\n// ---- {file}\n"));
        }
        text.push(origin, &format!("\n{}\n", item.text));
    }
}
