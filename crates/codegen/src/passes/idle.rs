//! Pass: what a document's function is given and does not use is not computed for it. A parameter may be named and have no effect: its
//! name stands for another value, what is made of it goes nowhere, is multiplied by 0, or is an output that nothing is wired to. What is
//! given in its place is 0.
//!
//! What an argument has an effect on is found in naga's form of the function, without looking at the order of statements: a variable holds
//! whatever is ever stored in it, and what stands under a condition depends on it. So a parameter that is said to have no effect has none.

use std::collections::BTreeSet;

use naga::{Block, Expression, Function, Handle, Literal, LocalVariable, MathFunction, Module, Statement};

use crate::ir::{Entry, Expr, Id, Literal as Number, Stage, Ty};
use crate::link::Index;

/// Most turns over a function.
const MAX_TURNS: usize = 32;

/// Numbers of arguments.
type Arguments = BTreeSet<usize>;

/// What has an effect on the members of what a function returns, or on all of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Effects {
    members: Vec<Arguments>,
}

impl Effects {
    /// Whether an argument has an effect on one of these members; on any, where none are named.
    fn reaches(&self, argument: usize, members: Option<&BTreeSet<usize>>) -> bool {
        let is_wanted =
            |member: usize| members.is_none_or(|members| self.members.len() == 1 || members.contains(&member));
        (0..self.members.len()).any(|member| is_wanted(member) && self.members[member].contains(&argument))
    }

    fn all(&self) -> Arguments {
        self.members.iter().flatten().copied().collect()
    }
}

/// Gives 0 to the functions of the document for what they do not use.
pub(crate) fn drop_idle(stage: &mut Stage<'_>, index: &Index) {
    // Which outputs of each call are read.
    let count = stage.arena.exprs.len();
    let mut fields: Vec<BTreeSet<&str>> = vec![BTreeSet::new(); count];
    let mut is_whole = vec![false; count];
    for entry in &stage.arena.exprs {
        match &entry.expr {
            Expr::Field { of, name } => {
                fields[of.index()].insert(name);
            }
            other => other.uses().iter().for_each(|id| is_whole[id.index()] = true),
        }
    }
    stage.roots.values().for_each(|id| is_whole[id.index()] = true);
    let fields: Vec<BTreeSet<String>> =
        fields.into_iter().map(|names| names.into_iter().map(str::to_owned).collect()).collect();
    stage.rebuild(|arena, old, mut entry| {
        if let Expr::Call { function, generic, arguments } = &mut entry.expr
            && index.is_of_document(function)
            && let Some(compiled) = index.instance(function, *generic).and_then(|instance| index.compiled(instance))
        {
            let number = |name: &String| compiled.members.iter().position(|member| member == name);
            let wanted = (!is_whole[old.index()]).then(|| fields[old.index()].iter().filter_map(number).collect());
            let effects = compiled.effects();
            for (place, argument) in arguments.iter_mut().enumerate() {
                if let Ty::Value(ty) = arena.get(*argument).ty
                    && !effects.reaches(place, wanted.as_ref())
                {
                    let literal = Expr::Literal(Number::new(ty, &[0.0]));
                    let zero: Id = arena.push(Entry { expr: literal, ty: Ty::Value(ty), node: None, hint: "" });
                    *argument = zero;
                }
            }
        }
        Some(arena.push(entry))
    });
}

/// What has an effect on what a function returns.
pub(crate) fn effects(module: &Module, function: Handle<Function>) -> Effects {
    let mut known: Vec<Effects> = Vec::new();
    // Callees come first.
    for (handle, body) in module.functions.iter() {
        known.push(Reading::new(module, &known, body).effects());
        if handle == function {
            break;
        }
    }
    known.pop().unwrap_or_default()
}

/// A function while it is read.
struct Reading<'m> {
    module: &'m Module,
    known: &'m [Effects],
    function: &'m Function,
    values: Vec<Arguments>,
    variables: Vec<Arguments>,
    /// What decides whether the rest of the function is reached.
    ways: Arguments,
    returned: Vec<Arguments>,
    has_changed: bool,
}

impl<'m> Reading<'m> {
    fn new(module: &'m Module, known: &'m [Effects], function: &'m Function) -> Reading<'m> {
        let members = match function.result.as_ref().map(|result| &module.types[result.ty].inner) {
            Some(naga::TypeInner::Struct { members, .. }) => members.len(),
            _ => 1,
        };
        Reading {
            module,
            known,
            function,
            values: vec![Arguments::new(); function.expressions.len()],
            variables: vec![Arguments::new(); function.local_variables.len()],
            ways: Arguments::new(),
            returned: vec![Arguments::new(); members],
            has_changed: true,
        }
    }

    fn effects(mut self) -> Effects {
        for (handle, variable) in self.function.local_variables.iter() {
            if let Some(init) = variable.init {
                self.values[init.index()] = self.of(init);
                self.variables[handle.index()] = self.values[init.index()].clone();
            }
        }
        // Sets only grow, so it would end; of a text that winds itself up for long all is said to have an effect.
        let mut turns = 0;
        while std::mem::take(&mut self.has_changed) {
            turns += 1;
            if turns > MAX_TURNS {
                let all: Arguments = (0..self.function.arguments.len()).collect();
                return Effects { members: vec![all; self.returned.len()] };
            }
            for (handle, _) in self.function.expressions.iter() {
                let value = self.of(handle);
                grow(&mut self.values[handle.index()], &value, &mut self.has_changed);
            }
            self.block(&self.function.body, &Arguments::new());
        }
        let ways = self.ways;
        Effects { members: self.returned.into_iter().map(|own| &own | &ways).collect() }
    }

    /// What has an effect on an expression, by what is known so far.
    fn of(&self, handle: Handle<Expression>) -> Arguments {
        let own = |handle: Handle<Expression>| &self.values[handle.index()];
        match self.function.expressions[handle] {
            Expression::FunctionArgument(index) => Arguments::from([index as usize]),
            Expression::LocalVariable(variable) => self.variables[variable.index()].clone(),
            // Written by the statement that calls.
            Expression::CallResult(_) => own(handle).clone(),
            Expression::Binary { op: naga::BinaryOperator::Multiply, left, right }
                if self.is(left, 0.0) || self.is(right, 0.0) =>
            {
                Arguments::new()
            }
            Expression::Math { fun: MathFunction::Mix, arg, arg2: Some(weight), .. } if self.is(weight, 0.0) => {
                own(arg).clone()
            }
            Expression::Math { fun: MathFunction::Mix, arg1: Some(end), arg2: Some(weight), .. }
                if self.is(weight, 1.0) =>
            {
                own(end).clone()
            }
            ref other => operands(other).into_iter().flat_map(own).copied().collect(),
        }
    }

    /// Whether an expression is a literal of this number in all of its components.
    fn is(&self, handle: Handle<Expression>, number: f32) -> bool {
        match self.function.expressions[handle] {
            Expression::Literal(Literal::F32(literal)) => literal == number,
            Expression::Literal(Literal::AbstractFloat(literal)) => literal == f64::from(number),
            Expression::Splat { value, .. } => self.is(value, number),
            Expression::Compose { ref components, .. } => components.iter().all(|part| self.is(*part, number)),
            Expression::ZeroValue(_) => number == 0.0,
            Expression::Constant(constant) => {
                let init = &self.module.global_expressions[self.module.constants[constant].init];
                matches!(init, Expression::Literal(Literal::F32(literal)) if *literal == number)
            }
            _ => false,
        }
    }

    fn block(&mut self, block: &Block, under: &Arguments) {
        for statement in block {
            match statement {
                Statement::Block(inner) => self.block(inner, under),
                Statement::If { condition, accept, reject } => {
                    let inner = under | &self.values[condition.index()];
                    self.branches(&[accept, reject], &inner);
                }
                Statement::Switch { selector, cases } => {
                    let inner = under | &self.values[selector.index()];
                    let bodies: Vec<&Block> = cases.iter().map(|case| &case.body).collect();
                    self.branches(&bodies, &inner);
                }
                Statement::Loop { body, continuing, break_if } => {
                    let condition = break_if.map_or_else(Arguments::new, |end| self.values[end.index()].clone());
                    self.branches(&[body, continuing], &(under | &condition));
                }
                Statement::Store { pointer, value } => {
                    let stored = &(under | &self.values[value.index()]) | &self.ways;
                    let stored = &stored | &self.places(*pointer);
                    if let Some(variable) = self.variable(*pointer) {
                        grow(&mut self.variables[variable.index()], &stored, &mut self.has_changed);
                    }
                }
                Statement::Call { function, arguments, result } => {
                    let used = self.known.get(function.index()).map(Effects::all).unwrap_or_default();
                    let given = used.iter().filter_map(|place| arguments.get(*place));
                    let all: Arguments = given.flat_map(|argument| &self.values[argument.index()]).copied().collect();
                    if let Some(result) = result {
                        grow(&mut self.values[result.index()], &all, &mut self.has_changed);
                    }
                }
                Statement::Return { value: Some(value) } => {
                    let parts = match &self.function.expressions[*value] {
                        Expression::Compose { components, .. } if components.len() == self.returned.len() => {
                            components.iter().map(|part| self.values[part.index()].clone()).collect()
                        }
                        _ => vec![self.values[value.index()].clone(); self.returned.len()],
                    };
                    for (member, part) in self.returned.iter_mut().zip(&parts) {
                        grow(member, &(part | under), &mut self.has_changed);
                    }
                }
                _ => {}
            }
        }
    }

    /// Blocks of which conditions choose; where one of them may leave, all that follows depends on them.
    fn branches(&mut self, blocks: &[&Block], under: &Arguments) {
        if blocks.iter().any(|block| leaves(block)) {
            grow(&mut self.ways, under, &mut self.has_changed);
        }
        blocks.iter().for_each(|block| self.block(block, under));
    }

    /// The variable that a pointer is into.
    fn variable(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => self.variable(base),
            _ => None,
        }
    }

    /// What says where in a variable a pointer is.
    fn places(&self, pointer: Handle<Expression>) -> Arguments {
        match self.function.expressions[pointer] {
            Expression::Access { base, index } => &self.values[index.index()] | &self.places(base),
            Expression::AccessIndex { base, .. } => self.places(base),
            _ => Arguments::new(),
        }
    }
}

/// Adds to a set.
fn grow(set: &mut Arguments, more: &Arguments, has_changed: &mut bool) {
    let before = set.len();
    set.extend(more);
    *has_changed |= set.len() > before;
}

/// Whether a block may end the function, or a loop or `switch` around it.
fn leaves(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill => true,
        Statement::Block(inner) => leaves(inner),
        Statement::If { accept, reject, .. } => leaves(accept) || leaves(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| leaves(&case.body)),
        Statement::Loop { body, continuing, .. } => leaves(body) || leaves(continuing),
        _ => false,
    })
}

/// What an expression is made of.
fn operands(expression: &Expression) -> Vec<Handle<Expression>> {
    match *expression {
        Expression::Access { base, index } => vec![base, index],
        Expression::AccessIndex { base, .. } => vec![base],
        Expression::Splat { value, .. } => vec![value],
        Expression::Swizzle { vector, .. } => vec![vector],
        Expression::Compose { ref components, .. } => components.clone(),
        Expression::Load { pointer } => vec![pointer],
        Expression::Unary { expr, .. } | Expression::Derivative { expr, .. } | Expression::As { expr, .. } => {
            vec![expr]
        }
        Expression::Binary { left, right, .. } => vec![left, right],
        Expression::Select { condition, accept, reject } => vec![condition, accept, reject],
        Expression::Relational { argument, .. } => vec![argument],
        Expression::Math { arg, arg1, arg2, arg3, .. } => [Some(arg), arg1, arg2, arg3].into_iter().flatten().collect(),
        Expression::ImageSample { image, sampler, coordinate, array_index, offset, level, depth_ref, .. } => {
            let level = match level {
                naga::SampleLevel::Auto | naga::SampleLevel::Zero => vec![],
                naga::SampleLevel::Exact(level) | naga::SampleLevel::Bias(level) => vec![level],
                naga::SampleLevel::Gradient { x, y } => vec![x, y],
            };
            let more = [array_index, offset, depth_ref].into_iter().flatten();
            [image, sampler, coordinate].into_iter().chain(more).chain(level).collect()
        }
        Expression::ImageLoad { image, coordinate, array_index, sample, level } => {
            [Some(image), Some(coordinate), array_index, sample, level].into_iter().flatten().collect()
        }
        Expression::ImageQuery { image, query } => {
            let level = match query {
                naga::ImageQuery::Size { level } => level,
                _ => None,
            };
            [Some(image), level].into_iter().flatten().collect()
        }
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What has an effect on each member of what the last function of a text returns.
    fn of(text: &str) -> Vec<Vec<usize>> {
        let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
        let (last, _) = module.functions.iter().next_back().expect("a function");
        effects(&module, last).members.into_iter().map(|own| own.into_iter().collect()).collect()
    }

    #[test]
    fn what_has_an_effect() {
        for (body, wanted) in [
            ("let d = b * 2.0; return a;", vec![0]),
            ("_ = b; return a;", vec![0]),
            ("return a + 0.0 * b;", vec![0]),
            ("return mix(a, b, 0.0);", vec![0]),
            ("{ let b = 1.0; return a + b; }", vec![0]),
            ("var v = b; v = a; return a;", vec![0]),
            ("var v = b; v = a; return v;", vec![0, 1]),
            ("if b > 0.0 { return 1.0; } return a;", vec![0, 1]),
            ("var v = a; if b > 0.0 { v = 1.0; } return v;", vec![0, 1]),
            ("var v = a; if b > 0.0 { var w = 1.0; w = 2.0; } return v;", vec![0]),
            ("var v = 0.0; for (var i = 0; i < 3; i++) { if b > v { break; } v += a; } return v;", vec![0, 1]),
            ("var v = vec2f(a); v[i32(b)] = 1.0; return v.x;", vec![0, 1]),
            ("switch i32(b) { case 1: { return a; } default: { return 2.0; } }", vec![0, 1]),
            ("var s = 0.0; for (var i = 0; i < 3; i++) { s += b; } return a;", vec![0]),
            ("return select(a, b, a > 1.0);", vec![0, 1]),
        ] {
            assert_eq!(of(&format!("fn f(a: f32, b: f32) -> f32 {{ {body} }}")), [wanted], "{body}");
        }
    }

    #[test]
    fn through_helpers_and_by_output() {
        let text = "struct S { x: f32, y: f32 }\nfn g(a: f32, b: f32) -> f32 { let c = b; return a; }\nfn f(a: f32, b: f32, c: f32) -> S { return S(g(a, b), c * 2.0); }";
        assert_eq!(of(text), [vec![0], vec![2]]);
        let text = "struct S { x: f32, y: f32 }\nfn f(a: f32, b: f32) -> S { var s: S; s.x = a; s.y = b; return s; }";
        assert_eq!(of(text), [vec![0, 1], vec![0, 1]]);
        let text = "struct S { x: f32, y: f32 }\nfn f(a: f32, b: f32) -> S { if b > 0.0 { return S(a, 1.0); } return S(1.0, a); }";
        assert_eq!(of(text), [vec![0, 1], vec![0, 1]]);
    }
}
