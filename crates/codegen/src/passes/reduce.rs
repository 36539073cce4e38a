//! What a function does when some of its arguments are known: it may hand one of the others on, or join two of them.
//!
//! Only functions without branches, loops and variables are looked at, expression by expression; behind the end of a mixture a call of
//! another function may be left, or one or two operators. Nothing is taken out that would
//! change a rounding: x 1, x / 1, x - 0 and x + 0 are x (but for the sign of a zero), and a product with 0 is 0, as everywhere in folding.

use std::cell::Cell;
use std::collections::HashMap;

use naga::{
    BinaryOperator as B, Expression, Function, Handle, Literal, MathFunction, Module, RelationalFunction, ScalarKind,
    Statement, TypeInner, UnaryOperator,
};

/// What a function gives.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reduced {
    /// These numbers: one, or one for each component.
    Known(Vec<f32>),
    /// An argument, spread over a vector where the function's type asks for it.
    Argument(usize),
    /// An operator or function of WGSL about others of these, component by component.
    Applied(&'static str, Vec<Reduced>),
    /// A function of the library by its name, with arguments and numbers, and how many components each of its own has.
    Called(String, Vec<(Reduced, usize)>),
}

impl Reduced {
    /// How many operators, functions and calls it is.
    fn steps(&self) -> usize {
        match self {
            Reduced::Known(_) | Reduced::Argument(_) => 0,
            Reduced::Applied(_, parts) => 1 + parts.iter().map(Reduced::steps).sum::<usize>(),
            Reduced::Called(..) => 1,
        }
    }

    /// Whether it is two arguments that are joined, or none.
    fn is_plain(&self) -> bool {
        match self {
            Reduced::Known(_) | Reduced::Argument(_) => true,
            Reduced::Applied(name, parts) => {
                !is_function(name) && parts.iter().all(|part| matches!(part, Reduced::Argument(_)))
            }
            Reduced::Called(..) => false,
        }
    }
}

/// Whether it is a function, not an operator.
pub(crate) fn is_function(name: &str) -> bool {
    name.len() > 1
}

/// A value on the way.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Of(Reduced),
    Other,
}

/// Longer ones stay the functions that they are.
const MAX_STEPS: usize = 2;

/// What a function gives for arguments of which some are known; `None` where that is nothing simple.
pub(crate) fn reduce(module: &Module, function: &Function, known: &[Option<Vec<f32>>]) -> Option<Reduced> {
    let mut returned = None;
    let mut calls = HashMap::new();
    for statement in function.body.iter() {
        match statement {
            Statement::Emit(_) => {}
            Statement::Call { function, arguments, result: Some(result) } => {
                calls.insert(*result, (*function, arguments.as_slice()));
            }
            Statement::Return { value } => returned = *value,
            _ => return None,
        }
    }
    let returned = returned?;
    let ended = Cell::new(false);
    let mut values: Vec<Value> = Vec::with_capacity(function.expressions.len());
    for (handle, expression) in function.expressions.iter() {
        let value = match calls.get(&handle) {
            Some((callee, arguments)) => call(module, &values, &module.functions[*callee], arguments),
            None => value(module, &values, known, expression, &ended),
        };
        values.push(value);
    }
    match values.swap_remove(returned.index()) {
        Value::Of(reduced) if reduced.is_plain() => Some(reduced),
        // What is no shorter than it was stays as it is written.
        Value::Of(reduced) if ended.get() && reduced.steps() <= MAX_STEPS => Some(reduced),
        _ => None,
    }
}

/// A call of arguments and numbers.
fn call(module: &Module, values: &[Value], callee: &Function, arguments: &[Handle<Expression>]) -> Value {
    let Some(name) = callee.name.clone() else { return Value::Other };
    let float = |size: usize, kind: ScalarKind| (kind == ScalarKind::Float).then_some(size);
    let components = |ty: Handle<naga::Type>| match module.types[ty].inner {
        TypeInner::Scalar(scalar) => float(1, scalar.kind),
        TypeInner::Vector { size, scalar } => float(size as usize, scalar.kind),
        _ => None,
    };
    let one = |(argument, own): (&Handle<Expression>, &naga::FunctionArgument)| match &values[argument.index()] {
        Value::Of(reduced @ (Reduced::Known(_) | Reduced::Argument(_))) => Some((reduced.clone(), components(own.ty)?)),
        _ => None,
    };
    let all: Option<Vec<_>> = arguments.iter().zip(&callee.arguments).map(one).collect();
    all.map_or(Value::Other, |all| Value::Of(Reduced::Called(name, all)))
}

fn value(
    module: &Module,
    values: &[Value],
    known: &[Option<Vec<f32>>],
    expression: &Expression,
    ended: &Cell<bool>,
) -> Value {
    let of = |handle: Handle<Expression>| &values[handle.index()];
    let numbers = |handle: Handle<Expression>| match of(handle) {
        Value::Of(Reduced::Known(numbers)) => Some(numbers),
        _ => None,
    };
    let all_known = |numbers: Option<Vec<f32>>| numbers.map_or(Value::Other, |all| Value::Of(Reduced::Known(all)));
    match *expression {
        Expression::Literal(literal) => all_known(number(literal).map(|number| vec![number])),
        Expression::Constant(handle) => match module.global_expressions[module.constants[handle].init] {
            Expression::Literal(literal) => all_known(number(literal).map(|number| vec![number])),
            _ => Value::Other,
        },
        Expression::FunctionArgument(index) => {
            let index = index as usize;
            match known.get(index) {
                Some(Some(numbers)) => Value::Of(Reduced::Known(numbers.clone())),
                _ => Value::Of(Reduced::Argument(index)),
            }
        }
        // One number for all components is kept as one.
        Expression::Splat { value, .. } => match of(value) {
            kept @ Value::Of(Reduced::Known(_) | Reduced::Argument(_)) => kept.clone(),
            _ => Value::Other,
        },
        Expression::Compose { ref components, .. } => {
            all_known(components.iter().map(|part| numbers(*part).filter(|n| n.len() == 1).map(|n| n[0])).collect())
        }
        Expression::Unary { op, expr } => match (op, numbers(expr)) {
            (UnaryOperator::Negate, Some(numbers)) => all_known(Some(numbers.iter().map(|x| -x).collect())),
            (UnaryOperator::LogicalNot, Some(numbers)) => {
                all_known(Some(numbers.iter().map(|x| f32::from(*x == 0.0)).collect()))
            }
            _ => Value::Other,
        },
        Expression::Binary { op, left, right } => binary(op, of(left), of(right)),
        Expression::Select { condition, accept, reject } => match numbers(condition) {
            Some(bools) if bools.iter().all(|x| *x != 0.0) => of(accept).clone(),
            Some(bools) if bools.iter().all(|x| *x == 0.0) => of(reject).clone(),
            _ => Value::Other,
        },
        Expression::Relational { fun: RelationalFunction::All | RelationalFunction::Any, argument } => {
            // Of several that differ nothing is said.
            match numbers(argument) {
                Some(bools) if bools.iter().all(|x| *x == bools[0]) => all_known(Some(vec![bools[0]])),
                _ => Value::Other,
            }
        }
        Expression::Math { fun: MathFunction::Abs, arg, .. } => match of(arg) {
            Value::Of(Reduced::Known(numbers)) => all_known(Some(numbers.iter().map(|x| x.abs()).collect())),
            other => applied("abs", &[other]),
        },
        Expression::Math { fun: MathFunction::Min, arg, arg1: Some(b), .. } => applied("min", &[of(arg), of(b)]),
        Expression::Math { fun: MathFunction::Max, arg, arg1: Some(b), .. } => applied("max", &[of(arg), of(b)]),
        Expression::Math { fun: MathFunction::Mix, arg, arg1: Some(b), arg2: Some(t), .. } => {
            let is = |end: f32| numbers(t).is_some_and(|t| t.iter().all(|t| *t == end));
            ended.set(ended.get() || is(0.0) || is(1.0));
            match (is(0.0), is(1.0)) {
                (true, _) => of(arg).clone(),
                (_, true) => of(b).clone(),
                _ => Value::Other,
            }
        }
        _ => Value::Other,
    }
}

/// An operator or function about values that are followed. Calls stay the last step.
fn applied(name: &'static str, parts: &[&Value]) -> Value {
    let part = |value: &&Value| match value {
        Value::Of(Reduced::Called(..)) | Value::Other => None,
        Value::Of(reduced) => Some(reduced.clone()),
    };
    let parts: Option<Vec<Reduced>> = parts.iter().map(part).collect();
    let whole = parts.map(|parts| Reduced::Applied(name, parts)).filter(|whole| whole.steps() <= MAX_STEPS);
    whole.map_or(Value::Other, Value::Of)
}

fn number(literal: Literal) -> Option<f32> {
    match literal {
        Literal::F32(number) => Some(number),
        Literal::AbstractFloat(number) => Some(number as f32),
        Literal::Bool(value) => Some(f32::from(value)),
        _ => None,
    }
}

fn binary(op: B, left: &Value, right: &Value) -> Value {
    let is = |value: &Value, number: f32| matches!(value, Value::Of(Reduced::Known(all)) if all.iter().all(|x| *x == number));
    match op {
        B::Multiply if is(left, 0.0) || is(right, 0.0) => return Value::Of(Reduced::Known(vec![0.0])),
        B::Multiply | B::Divide if is(right, 1.0) => return left.clone(),
        B::Add | B::Subtract if is(right, 0.0) => return left.clone(),
        B::Multiply if is(left, 1.0) => return right.clone(),
        B::Add if is(left, 0.0) => return right.clone(),
        _ => {}
    }
    if let (Value::Of(Reduced::Known(a)), Value::Of(Reduced::Known(b))) = (left, right) {
        let one = |i: usize| {
            let (a, b) = (a[i % a.len()], b[i % b.len()]);
            Some(match op {
                B::Add => a + b,
                B::Subtract => a - b,
                B::Multiply => a * b,
                B::Divide => a / b,
                B::Greater => f32::from(a > b),
                B::GreaterEqual => f32::from(a >= b),
                B::Less => f32::from(a < b),
                B::LessEqual => f32::from(a <= b),
                B::Equal => f32::from(a == b),
                B::NotEqual => f32::from(a != b),
                _ => return None,
            })
        };
        let all: Option<Vec<f32>> = (0..a.len().max(b.len())).map(one).collect();
        return all.map_or(Value::Other, |all| Value::Of(Reduced::Known(all)));
    }
    let sign = match op {
        B::Add => "+",
        B::Subtract => "-",
        B::Multiply => "*",
        B::Divide => "/",
        _ => return Value::Other,
    };
    applied(sign, &[left, right])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(body: &str, known: &[Option<f32>]) -> Option<Reduced> {
        let module = naga::front::wgsl::parse_str(body).expect("sound WGSL");
        let (_, function) = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some("g")).expect("a function");
        let known: Vec<Option<Vec<f32>>> = known.iter().map(|x| x.map(|x| vec![x])).collect();
        reduce(&module, function, &known)
    }

    fn joined(sign: &'static str, a: usize, b: usize) -> Option<Reduced> {
        Some(Reduced::Applied(sign, vec![Reduced::Argument(a), Reduced::Argument(b)]))
    }

    /// Behind the end of a mixture the other side is left: a step or two, or the function that it is a call of.
    #[test]
    fn ends_of_mixtures() {
        let sum = "fn g(a: vec3f, b: vec3f, t: f32) -> vec3f { return mix(a, a + b, t); }";
        assert_eq!(of(sum, &[None, None, Some(1.0)]), joined("+", 0, 1));
        let with = Reduced::Applied("+", vec![Reduced::Argument(0), Reduced::Known(vec![0.5])]);
        assert_eq!(of(sum, &[None, Some(0.5), Some(1.0)]), Some(with));
        assert_eq!(of(sum, &[None, Some(0.5), Some(0.25)]), None);
        let least = "fn g(a: vec3f, b: vec3f, t: f32) -> vec3f { return mix(a, min(a, b), t); }";
        let min = Reduced::Applied("min", vec![Reduced::Argument(0), Reduced::Argument(1)]);
        assert_eq!(of(least, &[None, None, Some(1.0)]), Some(min));
        assert_eq!(of("fn g(a: f32, b: f32) -> f32 { return min(a, b); }", &[None, Some(1.0)]), None);
        let called = "fn h(a: vec3f, b: vec3f) -> vec3f { if a.x > 0.0 { return a; } return b; }\nfn g(a: vec3f, b: vec3f, t: f32) -> vec3f { return mix(a, h(a, b), t); }";
        let whole = Reduced::Called("h".into(), vec![(Reduced::Argument(0), 3), (Reduced::Argument(1), 3)]);
        assert_eq!(of(called, &[None, None, Some(1.0)]), Some(whole));
        assert_eq!(of(called, &[None, None, Some(0.0)]), Some(Reduced::Argument(0)));
        assert_eq!(of(called, &[None, None, Some(0.5)]), None);
    }

    #[test]
    fn identities() {
        let product = "fn g(a: vec3f, b: vec3f, c: vec3f) -> vec3f { return a * b + c; }";
        assert_eq!(of(product, &[None, Some(1.0), Some(0.0)]), Some(Reduced::Argument(0)));
        assert_eq!(of(product, &[None, None, Some(0.0)]), joined("*", 0, 1));
        assert_eq!(of(product, &[None, Some(1.0), None]), joined("+", 0, 2));
        assert_eq!(of(product, &[None, Some(0.0), None]), Some(Reduced::Argument(2)));
        assert_eq!(of(product, &[None, Some(2.0), None]), None);
        let mixed = "fn g(a: vec3f, b: vec3f, t: f32) -> vec3f { return mix(a, b, t); }";
        assert_eq!(of(mixed, &[None, None, Some(1.0)]), Some(Reduced::Argument(1)));
        assert_eq!(of(mixed, &[None, None, Some(0.5)]), None);
        let quotient = "fn g(a: f32, b: f32) -> f32 { return select(0.0, a / b, abs(b) > 1e-20); }";
        assert_eq!(of(quotient, &[None, Some(1.0)]), Some(Reduced::Argument(0)));
        assert_eq!(of(quotient, &[None, Some(0.0)]), Some(Reduced::Known(vec![0.0])));
        assert_eq!(of("fn g(a: f32, b: f32) -> f32 { return pow(a, b); }", &[None, Some(1.0)]), None);
        let branch = "fn g(a: f32, b: f32) -> f32 { if b > 0.0 { return a; } return a * b; }";
        assert_eq!(of(branch, &[None, Some(1.0)]), None);
    }
}
