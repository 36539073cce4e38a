//! From document to shader: the passes in their order, each one step of what follows.

use halfvector_graph::check::{Problem, Severity, check, node_label};
use halfvector_graph::document::Document;
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::Needs;

use crate::emit::expression::Names;
use crate::ir::Program;
use crate::link::Index;
use crate::names::Namer;
use crate::passes::lower::{lower, lower_material};
use crate::passes::plan::{Constants, Keep};
use crate::passes::specialise::{constants, specialise};
use crate::passes::types::Types;
use crate::passes::{drop_unused::drop_unused, fold, share::share, types};
use crate::{CodegenError, Fold, Remark, Shader, emit};

/// The shader of a material for what a scene needs.
///
/// The same arguments give the same bytes. Where nodes lie on the canvas is never read. Under [`Fold::Live`] changing a
/// number changes no text, unless it goes to or from the value at which a lobe or a part of the surface has no effect.
///
/// # Errors
/// The document's problems that keep it from being a shader, all at once; constants that fold to no finite number are
/// among them.
pub fn shader(document: &Document, library: &Library, needs: &Needs, fold: Fold) -> Result<Shader, CodegenError> {
    Making { document, library, needs, fold }.make(Extra::default())
}

/// What a shader is made of.
#[derive(Clone, Copy)]
pub(crate) struct Making<'m> {
    pub(crate) document: &'m Document,
    pub(crate) library: &'m Library,
    pub(crate) needs: &'m Needs,
    pub(crate) fold: Fold,
}

/// What is asked of it beside.
#[derive(Clone, Copy, Default)]
pub(crate) struct Extra<'m> {
    /// What is not left out.
    pub(crate) keep: Option<Keep>,
    /// What the header says beside.
    pub(crate) remarks: &'m [Remark],
    /// What leaving something out saves, in the order of what is left out.
    pub(crate) saved: &'m [Option<u32>],
}

impl Making<'_> {
    /// Makes the shader.
    pub(crate) fn make(self, extra: Extra<'_>) -> Result<Shader, CodegenError> {
        let Making { document, library, needs, fold } = self;
        whole(document, library, needs, fold, extra)
    }
}

fn whole(
    document: &Document,
    library: &Library,
    needs: &Needs,
    fold: Fold,
    extra: Extra<'_>,
) -> Result<Shader, CodegenError> {
    let open = extra.keep.and_then(Keep::socket);
    // check
    no_errors(check(document, library))?;
    // take groups apart
    let flat = flatten(document, library)?;
    let (document, library) = (flat.document.as_ref(), &flat.library);
    let index = &*Index::of(document);
    // resolve types
    let types = types::resolve(document, library)?;
    // lower, and what is constant whatever is folded
    let (exported, constants) = export(document, library, &types, index, &needs.methods, open)?;
    let mut program = match fold {
        Fold::Export => exported,
        Fold::Live => lower(document, &types, index, &needs.methods, Fold::Live, open)?,
    };
    // fold constants of the nodes
    fold::fold(&mut program, index);
    // specialise to needs
    let mut plan = specialise(&mut program, document, needs, fold, constants, extra.keep);
    plan.dropped.iter_mut().zip(extra.saved).for_each(|(dropped, saved)| dropped.instructions = *saved);
    // fold constants of the shading
    fold::fold(&mut program, index);
    // drop unused
    drop_unused(&mut program);
    // share common subexpressions
    share(&mut program);
    // name
    let names = Names::of(&program, &parameter_names(document), &mut Namer::new(index), index);
    // link and emit
    emit::shader(&program, plan, document, needs, extra.remarks, index, &names)
}

/// The material alone: `fn material(context: Context) -> Surface` and the library behind it, without lights, stages or
/// transforms. `Context` has only the members that the material reads. Numbers are folded as in [`Fold::Export`].
///
/// # Errors
/// As for [`shader()`].
pub fn material(document: &Document, library: &Library, methods: &Methods) -> Result<Shader, CodegenError> {
    alone(document, library, methods, Fold::Export)
}

/// The same with all numbers open, as in [`Fold::Live`]: nothing is computed beforehand. For those who ask how a constant
/// came about.
///
/// # Errors
/// As for [`shader()`].
pub fn material_live(document: &Document, library: &Library, methods: &Methods) -> Result<Shader, CodegenError> {
    alone(document, library, methods, Fold::Live)
}

fn alone(document: &Document, library: &Library, methods: &Methods, fold: Fold) -> Result<Shader, CodegenError> {
    // check
    no_errors(check(document, library))?;
    // take groups apart
    let flat = flatten(document, library)?;
    let (document, library) = (flat.document.as_ref(), &flat.library);
    let index = &*Index::of(document);
    // resolve types
    let types = types::resolve(document, library)?;
    // lower
    let mut program = lower_material(document, &types, methods, fold)?;
    // fold constants
    let faults = fold::fold(&mut program, index);
    no_faults(document, library, &program, &faults)?;
    // drop unused
    drop_unused(&mut program);
    // share common subexpressions
    share(&mut program);
    // name
    let names = Names::of(&program, &parameter_names(document), &mut Namer::new(index), index);
    // link and emit
    emit::material(&program, document, methods, index, &names)
}

/// The program with all numbers folded, and what is known of it. A live shader asks it too: what is left out must not
/// depend on how numbers are kept, or the two would draw different pictures.
fn export<'a>(
    document: &'a Document,
    library: &Library,
    types: &Types<'a>,
    index: &Index,
    methods: &Methods,
    open: Option<&'static str>,
) -> Result<(Program<'a>, Constants), CodegenError> {
    let mut program = lower(document, types, index, methods, Fold::Export, open)?;
    let faults = fold::fold(&mut program, index);
    no_faults(document, library, &program, &faults)?;
    let constants = constants(&program, index);
    Ok((program, constants))
}

fn no_errors(problems: Vec<Problem>) -> Result<(), CodegenError> {
    let errors: Vec<Problem> = problems.into_iter().filter(|p| p.severity == Severity::Error).collect();
    if errors.is_empty() { Ok(()) } else { Err(CodegenError::Problems(errors)) }
}

fn no_faults(
    document: &Document,
    library: &Library,
    program: &Program<'_>,
    faults: &[fold::NotFinite],
) -> Result<(), CodegenError> {
    let mut nodes: Vec<Option<usize>> = faults.iter().map(|f| f.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let problems = nodes.into_iter().map(|node| {
        let node = node.map(|node| program.nodes[node].id.clone());
        Problem {
            severity: Severity::Error,
            group: None,
            node_label: node.as_ref().map(|id| node_label(&document.graph, library, id)),
            node,
            socket: None,
            message:
                "its inputs are constant and what it computes from them is not a finite number; change one of them"
                    .into(),
        }
    });
    no_errors(problems.collect())
}

/// Name and label of each parameter of a document.
fn parameter_names(document: &Document) -> Vec<&str> {
    document.parameters.iter().map(|p| p.name.as_str()).collect()
}
