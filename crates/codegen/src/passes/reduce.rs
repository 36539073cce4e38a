//! What a function does when some of its arguments are known: it may hand one of the others on, or join two of them.
//!
//! Only functions without branches, loops and variables are looked at, expression by expression. Nothing is taken out that would
//! change a rounding: x 1, x / 1, x - 0 and x + 0 are x (but for the sign of a zero), and a product with 0 is 0, as everywhere in folding.

use naga::{
    BinaryOperator as B, Expression, Function, Handle, Literal, MathFunction, Module, RelationalFunction, Statement,
    UnaryOperator,
};

/// What a function gives.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reduced {
    /// These numbers: one, or one for each component.
    Known(Vec<f32>),
    /// An argument, spread over a vector where the function's type asks for it.
    Argument(usize),
    /// Two arguments joined by an operator of WGSL.
    Joined(&'static str, usize, usize),
}

/// A value on the way.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Known(Vec<f32>),
    Argument(usize),
    Joined(&'static str, usize, usize),
    Other,
}

/// What a function gives for arguments of which some are known; `None` where that is nothing simple.
pub(crate) fn reduce(module: &Module, function: &Function, known: &[Option<Vec<f32>>]) -> Option<Reduced> {
    let mut returned = None;
    for statement in function.body.iter() {
        match statement {
            Statement::Emit(_) => {}
            Statement::Return { value } => returned = *value,
            _ => return None,
        }
    }
    let returned = returned?;
    let mut values: Vec<Value> = Vec::with_capacity(function.expressions.len());
    for (_, expression) in function.expressions.iter() {
        let value = value(module, &values, known, expression);
        values.push(value);
    }
    match values.swap_remove(returned.index()) {
        Value::Known(numbers) => Some(Reduced::Known(numbers)),
        Value::Argument(argument) => Some(Reduced::Argument(argument)),
        Value::Joined(operator, a, b) => Some(Reduced::Joined(operator, a, b)),
        Value::Other => None,
    }
}

fn value(module: &Module, values: &[Value], known: &[Option<Vec<f32>>], expression: &Expression) -> Value {
    let of = |handle: Handle<Expression>| &values[handle.index()];
    let numbers = |handle: Handle<Expression>| match of(handle) {
        Value::Known(numbers) => Some(numbers),
        _ => None,
    };
    match *expression {
        Expression::Literal(literal) => number(literal).map_or(Value::Other, |number| Value::Known(vec![number])),
        Expression::Constant(handle) => match module.global_expressions[module.constants[handle].init] {
            Expression::Literal(literal) => number(literal).map_or(Value::Other, |number| Value::Known(vec![number])),
            _ => Value::Other,
        },
        Expression::FunctionArgument(index) => {
            let index = index as usize;
            match known.get(index) {
                Some(Some(numbers)) => Value::Known(numbers.clone()),
                _ => Value::Argument(index),
            }
        }
        // One number for all components is kept as one.
        Expression::Splat { value, .. } => of(value).clone(),
        Expression::Compose { ref components, .. } => {
            let all: Option<Vec<f32>> =
                components.iter().map(|part| numbers(*part).filter(|n| n.len() == 1).map(|n| n[0])).collect();
            all.map_or(Value::Other, Value::Known)
        }
        Expression::Unary { op, expr } => match (op, numbers(expr)) {
            (UnaryOperator::Negate, Some(numbers)) => Value::Known(numbers.iter().map(|x| -x).collect()),
            (UnaryOperator::LogicalNot, Some(numbers)) => {
                Value::Known(numbers.iter().map(|x| f32::from(*x == 0.0)).collect())
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
                Some(bools) if bools.iter().all(|x| *x == bools[0]) => Value::Known(vec![bools[0]]),
                _ => Value::Other,
            }
        }
        Expression::Math { fun: MathFunction::Abs, arg, .. } => {
            numbers(arg).map_or(Value::Other, |numbers| Value::Known(numbers.iter().map(|x| x.abs()).collect()))
        }
        Expression::Math { fun: MathFunction::Mix, arg, arg1: Some(b), arg2: Some(t), .. } => match numbers(t) {
            Some(t) if t.iter().all(|t| *t == 0.0) => of(arg).clone(),
            Some(t) if t.iter().all(|t| *t == 1.0) => of(b).clone(),
            _ => Value::Other,
        },
        _ => Value::Other,
    }
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
    let is = |value: &Value, number: f32| matches!(value, Value::Known(all) if all.iter().all(|x| *x == number));
    match op {
        B::Multiply if is(left, 0.0) || is(right, 0.0) => return Value::Known(vec![0.0]),
        B::Multiply | B::Divide if is(right, 1.0) => return left.clone(),
        B::Add | B::Subtract if is(right, 0.0) => return left.clone(),
        B::Multiply if is(left, 1.0) => return right.clone(),
        B::Add if is(left, 0.0) => return right.clone(),
        _ => {}
    }
    match (left, right) {
        (Value::Known(a), Value::Known(b)) => {
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
            all.map_or(Value::Other, Value::Known)
        }
        (Value::Argument(a), Value::Argument(b)) => match op {
            B::Add => Value::Joined("+", *a, *b),
            B::Subtract => Value::Joined("-", *a, *b),
            B::Multiply => Value::Joined("*", *a, *b),
            B::Divide => Value::Joined("/", *a, *b),
            _ => Value::Other,
        },
        _ => Value::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(body: &str, known: &[Option<f32>]) -> Option<Reduced> {
        let module = naga::front::wgsl::parse_str(body).expect("sound WGSL");
        let (_, function) = module.functions.iter().next().expect("a function");
        let known: Vec<Option<Vec<f32>>> = known.iter().map(|x| x.map(|x| vec![x])).collect();
        reduce(&module, function, &known)
    }

    #[test]
    fn identities() {
        let product = "fn g(a: vec3f, b: vec3f, c: vec3f) -> vec3f { return a * b + c; }";
        assert_eq!(of(product, &[None, Some(1.0), Some(0.0)]), Some(Reduced::Argument(0)));
        assert_eq!(of(product, &[None, None, Some(0.0)]), Some(Reduced::Joined("*", 0, 1)));
        assert_eq!(of(product, &[None, Some(1.0), None]), Some(Reduced::Joined("+", 0, 2)));
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
