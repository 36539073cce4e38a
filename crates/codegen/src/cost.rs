//! What a shader costs, estimated from naga's view of it: instructions by class, in total and for each node.
//!
//! An operation on a scalar or vector is one instruction, a call costs what the called function does, a loop's body counts once and
//! both sides of a branch count. A driver merges, spreads and drops; the numbers are for comparing materials and nodes with
//! each other, not for telling time.

use std::collections::BTreeMap;

use halfvector_graph::document::NodeId;
use naga::{Block, Expression, Function, MathFunction, Span, Statement};
use serde::Serialize;

use crate::Shader;
use crate::emit::text::Origin;
use crate::reflection::Resource;
use crate::validate::{ValidationError, validate};

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
}

/// Estimates what a whole shader costs.
///
/// # Errors
/// The shader is not valid.
pub fn cost(shader: &Shader) -> Result<Cost, ValidationError> {
    let valid = validate(shader)?;
    let module = &valid.module;
    // Callees come first in naga's arena, so one pass is enough.
    let mut functions: Vec<Instructions> = Vec::with_capacity(module.functions.len());
    for (_, function) in module.functions.iter() {
        let mut total = Instructions::default();
        each(function, &functions, |_, instructions| total.add(instructions));
        functions.push(total);
    }
    let mut cost = Cost::default();
    let mut nodes: BTreeMap<NodeId, Instructions> = BTreeMap::new();
    for entry in &module.entry_points {
        let mut total = Instructions::default();
        each(&entry.function, &functions, |span, instructions| {
            total.add(instructions);
            if let Some(Origin::Node(id)) = span.to_range().and_then(|range| origin(shader, range.start)) {
                nodes.entry(id.clone()).or_default().add(instructions);
            }
        });
        match entry.stage {
            naga::ShaderStage::Vertex => cost.vertex = total,
            _ => cost.fragment = total,
        }
    }
    cost.nodes = nodes.into_iter().map(|(node, instructions)| NodeCost { node, instructions }).collect();
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

/// Tells every instruction of a function with its place; a call with all that it does.
fn each(function: &Function, functions: &[Instructions], mut tell: impl FnMut(Span, Instructions)) {
    for (handle, expression) in function.expressions.iter() {
        tell(function.expressions.get_span(handle), of_expression(expression));
    }
    let mut blocks: Vec<&Block> = vec![&function.body];
    while let Some(block) = blocks.pop() {
        for (statement, span) in block.span_iter() {
            let choice = Instructions { choices: 1, ..Instructions::default() };
            match statement {
                Statement::Call { function, .. } => {
                    tell(*span, functions.get(function.index()).copied().unwrap_or_default());
                }
                Statement::Block(block) => blocks.push(block),
                Statement::If { accept, reject, .. } => {
                    tell(*span, choice);
                    blocks.extend([accept, reject]);
                }
                Statement::Switch { cases, .. } => {
                    tell(*span, choice);
                    blocks.extend(cases.iter().map(|case| &case.body));
                }
                Statement::Loop { body, continuing, .. } => {
                    tell(*span, choice);
                    blocks.extend([body, continuing]);
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
