//! From document to shader: the passes in their order, each one step of what follows.

use std::borrow::Cow;

use halfvector_graph::check::{Problem, Severity, check, node_label};
use halfvector_graph::document::Document;
use halfvector_graph::flatten::{Flat, flatten};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::Needs;

use crate::emit::expression::Names;
use crate::emit::material::Product;
use crate::fate::{self, Fates};
use crate::ir::{Expr, Program};
use crate::link::Index;
use crate::names::Namer;
use crate::passes::drop_unused::{drop_dead, drop_unused};
use crate::passes::lower::{StageKind, lower, lower_height, lower_material};
use crate::passes::plan::{Keep, Plan, Wanted};
use crate::passes::specialise::{constants, specialise};
use crate::passes::types::Types;
use crate::passes::{fold, share::share, types};
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
    let sound = Sound::new(document, library)?;
    let material = sound.material()?;
    material.draft(needs, fold, None)?.shader(&material, needs, &[])
}

/// A document without errors and without groups: what is the same for all of its shaders begins here.
pub(crate) struct Sound<'d> {
    flat: Flat<'d>,
    index: Cow<'static, Index>,
}

impl<'d> Sound<'d> {
    pub(crate) fn new(document: &'d Document, library: &Library) -> Result<Sound<'d>, CodegenError> {
        // check
        no_errors(check(document, library))?;
        // take groups apart
        let flat = flatten(document, library)?;
        let index = Index::of(&flat.document);
        Ok(Sound { flat, index })
    }

    pub(crate) fn material(&self) -> Result<Material<'_>, CodegenError> {
        let (document, library) = (self.flat.document.as_ref(), &self.flat.library);
        // resolve types of what reaches the surface; from here on there is nothing else
        Ok(Material { document, library, index: &self.index, types: types::resolve(document, library)? })
    }
}

/// The nodes of a document that reach the surface, with their types.
pub(crate) struct Material<'s> {
    document: &'s Document,
    library: &'s Library,
    pub(crate) index: &'s Index,
    pub(crate) types: Types<'s>,
}

/// A shader before its text is written.
pub(crate) struct Draft<'s> {
    pub(crate) program: Program<'s>,
    pub(crate) plan: Plan,
    names: Names,
    /// What became of the nodes.
    pub(crate) fates: Fates,
}

impl<'s> Material<'s> {
    /// All passes up to the text. `keep` is not left out.
    pub(crate) fn draft(&self, needs: &Needs, fold: Fold, keep: Option<Keep>) -> Result<Draft<'s>, CodegenError> {
        let Material { document, library, index, types } = self;
        let lowered = |fold| lower(types, index, &needs.methods, fold, keep.and_then(Keep::socket));
        // lower and fold, and what is constant whatever is folded: a live shader asks it too, for what is left out must not depend
        // on how numbers are kept, or the two would draw different pictures
        let mut program = lowered(Fold::Export)?;
        let mut fates = Fates { lowered: fate::calls(&program), ..Fates::default() };
        let faults = fold::fold(&mut program, index);
        no_faults(document, library, &program, &faults)?;
        fates.folded = fate::calls(&program);
        fates.constant = fate::constants(&program);
        let constants = constants(&program, index);
        if fold == Fold::Live {
            program = lowered(Fold::Live)?;
            fold::fold(&mut program, index);
        }
        // drop what folding left behind
        drop_dead(&mut program.fragment);
        drop_dead(&mut program.vertex);
        // specialise to needs
        let plan = specialise(&mut program, Wanted { surface: document.surface, needs, fold, constants, keep });
        // fold constants of the shading
        fold::fold(&mut program, index);
        // drop unused
        drop_unused(&mut program);
        fates.live = fate::calls(&program);
        // share common subexpressions
        share(&mut program);
        fates.kept = fate::calls(&program);
        // name
        let names = Names::of(&program, &parameter_names(document), &mut Namer::new(index), index);
        Ok(Draft { program, plan, names, fates })
    }
}

impl Draft<'_> {
    /// The text: links and emits. `remarks` stand in the header.
    pub(crate) fn shader(
        &self,
        material: &Material<'_>,
        needs: &Needs,
        remarks: &[Remark],
    ) -> Result<Shader, CodegenError> {
        let Draft { program, plan, names, .. } = self;
        emit::shader(program, plan.clone(), material.document, needs, remarks, material.index, names)
    }
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
    let sound = Sound::new(document, library)?;
    let material = sound.material()?;
    // lower
    let program = lower_material(&material.types, material.index, methods, fold)?;
    let alone = material.alone(program)?;
    alone.shader(&material, methods, Product::Surface)
}

/// The height of a material that displaces: functions of a `Context`, as [`material()`] is one.
#[derive(Clone, Debug, PartialEq)]
pub struct Height {
    /// `fn height(context: Context) -> f32` as the vertex stage computes it: the length by which a vertex moves along its
    /// normal, in the unit of the position.
    pub vertex: Shader,
    /// `fn height_change(context: Context) -> vec2f` as the fragment stage computes it: the derivatives of the height along x and
    /// y. The displaced surface's normal is made of them, and is what the sockets `normal` and `coat_normal` see as `world_normal`.
    /// None where the height is the same everywhere, or the method of `height_normals` keeps the old normals.
    pub change: Option<Shader>,
}

/// The height alone, without which a displaced surface is not known; none where it is 0. Numbers are folded as in
/// [`Fold::Export`].
///
/// # Errors
/// As for [`shader()`].
pub fn height(document: &Document, library: &Library, methods: &Methods) -> Result<Option<Height>, CodegenError> {
    let sound = Sound::new(document, library)?;
    let material = sound.material()?;
    let of = |stage| -> Result<_, CodegenError> {
        lower_height(&material.types, material.index, methods, stage)?
            .map(|program| material.alone(program))
            .transpose()
    };
    let Some(vertex) = of(StageKind::Vertex)? else { return Ok(None) };
    let arena = &vertex.program.vertex.arena;
    let constant = vertex.program.vertex.root("height").and_then(|id| arena.as_literal(id));
    if constant.is_some_and(|height| height.is_all(0.0)) {
        return Ok(None);
    }
    let varies = arena.exprs.iter().any(|entry| matches!(entry.expr, Expr::Context(_) | Expr::Frame(_)));
    let bends = varies && !methods.is("height_normals", "report");
    let change = if bends { of(StageKind::Fragment)? } else { None };
    Ok(Some(Height {
        vertex: vertex.shader(&material, methods, Product::Height)?,
        change: change.map(|change| change.shader(&material, methods, Product::HeightChange)).transpose()?,
    }))
}

/// The program of one function, before its text is written.
struct Alone<'s> {
    program: Program<'s>,
    names: Names,
}

impl<'s> Material<'s> {
    /// All passes up to the text, of a program of one stage.
    fn alone(&self, mut program: Program<'s>) -> Result<Alone<'s>, CodegenError> {
        let Material { document, library, index, .. } = self;
        // fold constants
        let faults = fold::fold(&mut program, index);
        no_faults(document, library, &program, &faults)?;
        // drop unused
        drop_unused(&mut program);
        // share common subexpressions
        share(&mut program);
        // name
        let names = Names::of(&program, &parameter_names(document), &mut Namer::new(index), index);
        Ok(Alone { program, names })
    }
}

impl Alone<'_> {
    /// Links and emits.
    fn shader(&self, material: &Material<'_>, methods: &Methods, product: Product) -> Result<Shader, CodegenError> {
        emit::material(&self.program, product, material.document, methods, material.index, &self.names)
    }
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
