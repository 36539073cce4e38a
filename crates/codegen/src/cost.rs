//! What a shader costs, counted in naga's IR: operations on numbers, texture samples, bytes of uniforms; in total and for each
//! node of the document.
//!
//! An estimate, good for comparing nodes of one material: what a function costs belongs to who calls it, both ways of a
//! branch count, and a loop counts as [`LOOP_PASSES`] passes, since how often it runs is not known before it does. What a
//! driver makes of it is not asked, and neither are caches or bandwidth.

use std::collections::{BTreeMap, HashMap};
use std::ops::{Add, AddAssign, Mul};

use halfvector_graph::document::NodeId;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Block, Expression, Function, Handle, MathFunction, Module, Statement, TypeInner, VectorSize};

use crate::emit::text::Origin;
use crate::reflection::{Resource, UniformSource, UniformType};
use crate::{Shader, ValidationError, place_of, validate};

/// How often a loop is taken to run.
pub const LOOP_PASSES: u32 = 4;

/// What a transcendental function counts, in operations per component: GPUs compute them at a quarter of the rate.
pub const SPECIAL_OPERATIONS: u32 = 4;

/// Counts of a shader or of a part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// Operations on single numbers: a sum of two `vec3f` is three.
    pub operations: u32,
    /// Reads of textures.
    pub samples: u32,
}

/// What a shader costs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// One run of the fragment stage.
    pub fragment: Figures,
    /// One run of the vertex stage.
    pub vertex: Figures,
    /// Both stages' parts that come from a node, in order of ids. The rest is lighting, transforms and interface.
    pub nodes: Vec<(NodeId, Figures)>,
    /// Bytes of uniforms, with padding.
    pub uniform_bytes: u32,
    /// Bytes of uniforms that hold inputs of a node, without padding, in order of ids.
    pub node_uniform_bytes: Vec<(NodeId, u32)>,
}

/// Counts a shader.
///
/// # Errors
/// When it is not valid.
pub fn cost(shader: &Shader) -> Result<Cost, ValidationError> {
    let valid = validate(shader)?;
    let mut counter = Counter { module: &valid.module, info: &valid.info, functions: HashMap::new() };
    let mut cost = Cost::default();
    let mut nodes: BTreeMap<NodeId, Figures> = BTreeMap::new();
    for (index, entry) in valid.module.entry_points.iter().enumerate() {
        let info = valid.info.get_entry_point(index);
        let mut total = Figures::default();
        counter.block(&entry.function, info, &entry.function.body, 1, &mut |span, figures| {
            total += figures;
            let place = span.to_range().and_then(|range| place_of(shader, range.start));
            if let Some(Origin::Node(id)) = place.map(|place| place.origin) {
                *nodes.entry(id).or_default() += figures;
            }
        });
        match entry.stage {
            naga::ShaderStage::Vertex => cost.vertex += total,
            _ => cost.fragment += total,
        }
    }
    cost.nodes = nodes.into_iter().collect();
    uniforms(shader, &mut cost);
    Ok(cost)
}

fn uniforms(shader: &Shader, cost: &mut Cost) {
    let mut nodes: BTreeMap<NodeId, u32> = BTreeMap::new();
    for binding in &shader.reflection.bindings {
        let Resource::Uniform(block) = &binding.resource else { continue };
        cost.uniform_bytes += block.size;
        for member in &block.members {
            if let (UniformSource::Input(socket), UniformType::Value(ty)) = (&member.source, member.ty) {
                *nodes.entry(socket.node.clone()).or_default() += 4 * ty.components() as u32;
            }
        }
    }
    cost.node_uniform_bytes = nodes.into_iter().collect();
}

struct Counter<'m> {
    module: &'m Module,
    info: &'m ModuleInfo,
    /// Functions that were counted.
    functions: HashMap<Handle<Function>, Figures>,
}

impl Counter<'_> {
    /// One call of a function. WGSL knows no recursion.
    fn function(&mut self, handle: Handle<Function>) -> Figures {
        if let Some(known) = self.functions.get(&handle) {
            return *known;
        }
        let function = &self.module.functions[handle];
        let info = &self.info[handle];
        let mut total = Figures::default();
        self.block(function, info, &function.body, 1, &mut |_, figures| total += figures);
        self.functions.insert(handle, total);
        total
    }

    /// Tells what each expression and call of a block costs, and where it stands.
    fn block(
        &mut self,
        function: &Function,
        info: &FunctionInfo,
        block: &Block,
        times: u32,
        tell: &mut dyn FnMut(naga::Span, Figures),
    ) {
        for (statement, span) in block.span_iter() {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let figures = self.expression(function, info, handle);
                        tell(function.expressions.get_span(handle), figures * times);
                    }
                }
                Statement::Call { function: callee, .. } => tell(*span, self.function(*callee) * times),
                Statement::Block(inner) => self.block(function, info, inner, times, tell),
                Statement::If { accept, reject, .. } => {
                    self.block(function, info, accept, times, tell);
                    self.block(function, info, reject, times, tell);
                }
                Statement::Switch { cases, .. } => {
                    cases.iter().for_each(|case| self.block(function, info, &case.body, times, tell));
                }
                Statement::Loop { body, continuing, .. } => {
                    let times = times.saturating_mul(LOOP_PASSES);
                    self.block(function, info, body, times, tell);
                    self.block(function, info, continuing, times, tell);
                }
                _ => {}
            }
        }
    }

    fn expression(&self, function: &Function, info: &FunctionInfo, handle: Handle<Expression>) -> Figures {
        let components = |handle: Handle<Expression>| components(info[handle].ty.inner_with(&self.module.types));
        let operations = |operations: u32| Figures { operations, samples: 0 };
        match &function.expressions[handle] {
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } => Figures { operations: 0, samples: 1 },
            Expression::Binary { left, right, .. } => {
                // A matrix times a vector: each number of the matrix is multiplied and added once.
                operations(components(handle).max(components(*left)).max(components(*right)))
            }
            Expression::Unary { .. }
            | Expression::Select { .. }
            | Expression::Derivative { .. }
            | Expression::Relational { .. }
            | Expression::As { .. } => operations(components(handle)),
            Expression::Math { fun, arg, .. } => operations(math(*fun, components(*arg))),
            _ => Figures::default(),
        }
    }
}

/// Operations of a built-in function on an argument of so many components.
fn math(function: MathFunction, components: u32) -> u32 {
    use MathFunction as M;
    match function {
        M::Cos
        | M::Cosh
        | M::Sin
        | M::Sinh
        | M::Tan
        | M::Tanh
        | M::Acos
        | M::Asin
        | M::Atan
        | M::Atan2
        | M::Asinh
        | M::Acosh
        | M::Atanh
        | M::Exp
        | M::Exp2
        | M::Log
        | M::Log2
        | M::Pow
        | M::Sqrt
        | M::InverseSqrt => SPECIAL_OPERATIONS * components,
        M::Length | M::Distance | M::Normalize => 2 * components + SPECIAL_OPERATIONS,
        M::Dot => 2 * components - 1,
        M::Cross | M::Reflect | M::Mix | M::SmoothStep | M::Refract | M::FaceForward => 3 * components,
        _ => components,
    }
}

fn components(inner: &TypeInner) -> u32 {
    let size = |size: VectorSize| size as u32;
    match *inner {
        TypeInner::Vector { size: length, .. } => size(length),
        TypeInner::Matrix { columns, rows, .. } => size(columns) * size(rows),
        _ => 1,
    }
}

impl Add for Figures {
    type Output = Figures;

    fn add(self, other: Figures) -> Figures {
        Figures {
            operations: self.operations.saturating_add(other.operations),
            samples: self.samples.saturating_add(other.samples),
        }
    }
}

impl AddAssign for Figures {
    fn add_assign(&mut self, other: Figures) {
        *self = *self + other;
    }
}

impl Mul<u32> for Figures {
    type Output = Figures;

    fn mul(self, times: u32) -> Figures {
        Figures { operations: self.operations.saturating_mul(times), samples: self.samples.saturating_mul(times) }
    }
}
