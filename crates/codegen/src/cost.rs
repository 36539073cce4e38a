//! What a shader costs, estimated from naga's view of it: instructions by class, in total and for each node.
//!
//! An operation on a scalar or vector is one instruction, a call costs what the called function does, a loop's body counts as often as
//! it turns, or once where the text does not say how often, and both sides of a branch count. A driver merges, spreads and drops; the
//! numbers are for comparing materials and nodes with each other, not for telling time.

mod turns;

use std::collections::BTreeMap;

use halfvector_graph::document::NodeId;
use naga::{Block, Expression, Function, Handle, MathFunction, Module, Span, Statement};
use serde::Serialize;

use crate::Shader;
use crate::emit::text::Origin;
use crate::reflection::Resource;
use crate::validate::{ValidationError, validate};
use turns::Counters;

/// Instructions by class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Instructions {
    /// Sums, products, dot products, minima, roundings and the like.
    pub arithmetic: u32,
    /// Division, roots, powers, exponentials, logarithms, trigonometry.
    pub transcendental: u32,
    /// Comparisons, selections, branches, loops.
    pub choices: u32,
    /// Reads of textures.
    pub samples: u32,
}

/// A node's part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NodeCost {
    /// The node; in a group its path.
    pub node: NodeId,
    /// In both stages.
    pub instructions: Instructions,
    /// Whether a loop of it turns as often as a value says that the text does not hold: its body counts once.
    pub per_turn: bool,
}

/// What a shader costs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// For each vertex.
    pub vertex: Instructions,
    /// For each pixel: nodes, lights, environment and all.
    pub fragment: Instructions,
    /// Bytes of the uniforms.
    pub uniform_bytes: u32,
    /// The nodes that are in the shader, in order of id.
    pub nodes: Vec<NodeCost>,
    /// Whether the body of some loop, of a node or not, counts once because the text does not say how often it turns.
    pub per_turn: bool,
}

impl Instructions {
    /// All of them.
    pub fn total(self) -> u32 {
        let Instructions { arithmetic, transcendental, choices, samples } = self;
        arithmetic.saturating_add(transcendental).saturating_add(choices).saturating_add(samples)
    }

    fn add(&mut self, other: Instructions) {
        self.arithmetic = self.arithmetic.saturating_add(other.arithmetic);
        self.transcendental = self.transcendental.saturating_add(other.transcendental);
        self.choices = self.choices.saturating_add(other.choices);
        self.samples = self.samples.saturating_add(other.samples);
    }

    fn times(self, count: u32) -> Instructions {
        Instructions {
            arithmetic: self.arithmetic.saturating_mul(count),
            transcendental: self.transcendental.saturating_mul(count),
            choices: self.choices.saturating_mul(count),
            samples: self.samples.saturating_mul(count),
        }
    }
}

/// What a part of a shader does.
#[derive(Clone, Copy, Default)]
struct Part {
    instructions: Instructions,
    per_turn: bool,
}

impl Part {
    fn add(&mut self, other: Part) {
        self.instructions.add(other.instructions);
        self.per_turn |= other.per_turn;
    }
}

/// Estimates what a whole shader costs.
///
/// # Errors
/// The shader is not valid.
pub fn cost(shader: &Shader) -> Result<Cost, ValidationError> {
    let valid = validate(shader)?;
    let module = &valid.module;
    let functions = of_functions(module);
    let mut cost = Cost::default();
    let mut nodes: BTreeMap<NodeId, Part> = BTreeMap::new();
    for entry in &module.entry_points {
        let mut total = Part::default();
        each(module, &entry.function, &functions, |span, part| {
            total.add(part);
            if let Some(Origin::Node(id)) = span.to_range().and_then(|range| origin(shader, range.start)) {
                match nodes.get_mut(id) {
                    Some(node) => node.add(part),
                    None => drop(nodes.insert(id.clone(), part)),
                }
            }
        });
        cost.per_turn |= total.per_turn;
        match entry.stage {
            naga::ShaderStage::Vertex => cost.vertex = total.instructions,
            _ => cost.fragment = total.instructions,
        }
    }
    let of_node = |(node, Part { instructions, per_turn })| NodeCost { node, instructions, per_turn };
    cost.nodes = nodes.into_iter().map(of_node).collect();
    cost.uniform_bytes = shader
        .reflection
        .bindings
        .iter()
        .map(|binding| match &binding.resource {
            Resource::Uniform(block) => block.size,
            _ => 0,
        })
        .sum();
    Ok(cost)
}

/// Where a byte of a shader comes from: its segments lie in order.
fn origin(shader: &Shader, at: usize) -> Option<&Origin> {
    let number = shader.segments.partition_point(|segment| segment.end <= at);
    shader.segments.get(number).map(|segment| &segment.origin)
}

/// What each function of a module does, by its place there.
fn of_functions(module: &Module) -> Vec<Part> {
    // Callees come first in naga's arena, so one pass is enough.
    let mut functions: Vec<Part> = Vec::with_capacity(module.functions.len());
    for (_, function) in module.functions.iter() {
        let mut total = Part::default();
        each(module, function, &functions, |_, part| total.add(part));
        functions.push(total);
    }
    functions
}

/// What a function of a module does.
pub(crate) fn of_function(module: &Module, function: Handle<Function>) -> Instructions {
    of_functions(module).get(function.index()).copied().unwrap_or_default().instructions
}

/// Tells every instruction of a function with its place, in a loop as often as it turns; a call with all that it does.
fn each(module: &Module, function: &Function, functions: &[Part], mut tell: impl FnMut(Span, Part)) {
    let counters = Counters::of(module, function);
    let mut blocks: Vec<(&Block, u32, bool)> = vec![(&function.body, 1, false)];
    while let Some((block, times, per_turn)) = blocks.pop() {
        let part = |instructions: Instructions| Part { instructions: instructions.times(times), per_turn };
        let choice = Instructions { choices: 1, ..Instructions::default() };
        for (statement, span) in block.span_iter() {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let one = of_expression(&function.expressions[handle]);
                        tell(function.expressions.get_span(handle), part(one));
                    }
                }
                Statement::Call { function, .. } => {
                    let called = functions.get(function.index()).copied().unwrap_or_default();
                    tell(*span, Part { per_turn: per_turn || called.per_turn, ..part(called.instructions) });
                }
                Statement::Block(block) => blocks.push((block, times, per_turn)),
                Statement::If { accept, reject, .. } => {
                    tell(*span, part(choice));
                    blocks.extend([accept, reject].map(|block| (block, times, per_turn)));
                }
                Statement::Switch { cases, .. } => {
                    tell(*span, part(choice));
                    blocks.extend(cases.iter().map(|case| (&case.body, times, per_turn)));
                }
                Statement::Loop { body, continuing, .. } => {
                    let turns = counters.turns(body, continuing);
                    let inside = (times.saturating_mul(turns.unwrap_or(1)), per_turn || turns.is_none());
                    tell(*span, Part { instructions: choice.times(inside.0), per_turn: inside.1 });
                    blocks.extend([body, continuing].map(|block| (block, inside.0, inside.1)));
                }
                _ => {}
            }
        }
    }
}

fn of_expression(expression: &Expression) -> Instructions {
    use naga::BinaryOperator as B;
    let mut one = Instructions::default();
    match expression {
        Expression::Binary { op: B::Divide | B::Modulo, .. } => one.transcendental = 1,
        Expression::Binary {
            op:
                B::Equal
                | B::NotEqual
                | B::Less
                | B::LessEqual
                | B::Greater
                | B::GreaterEqual
                | B::LogicalAnd
                | B::LogicalOr,
            ..
        }
        | Expression::Select { .. }
        | Expression::Relational { .. } => one.choices = 1,
        Expression::Binary { .. } | Expression::Unary { .. } | Expression::Derivative { .. } => one.arithmetic = 1,
        Expression::As { convert: Some(_), .. } => one.arithmetic = 1,
        Expression::ImageSample { .. } | Expression::ImageLoad { .. } => one.samples = 1,
        Expression::Math { fun, .. } => match is_transcendental(*fun) {
            true => one.transcendental = 1,
            false => one.arithmetic = 1,
        },
        _ => {}
    }
    one
}

fn is_transcendental(function: MathFunction) -> bool {
    use MathFunction as M;
    matches!(
        function,
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
            | M::InverseSqrt
            | M::Length
            | M::Distance
            | M::Normalize
            | M::Refract
    )
}
