//! A small evaluator of library functions on constants, over naga's IR, in f32: straight-line bodies of built-in
//! operators, no control flow, no calls, no textures. What it does not know it leaves alone, and the shader computes it.

use naga::{
    Expression, Function, Handle, Literal as NagaLiteral, MathFunction, Module, ScalarKind, Statement, TypeInner,
};

/// A scalar or vector of one to four components. Integers and bools are exact in f64; floats are rounded to f32 after
/// every operation (f64 carries more than twice the digits, so the rounding is that of f32 arithmetic).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number {
    pub(crate) kind: Kind,
    pub(crate) len: usize,
    /// Whether it is a vector; a scalar has length 1.
    pub(crate) components: [f64; 4],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Float,
    Int,
    Bool,
}

/// A number, or the members of a struct.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Number(Number),
    Struct(Vec<Number>),
}

impl Number {
    pub(crate) fn new(kind: Kind, components: &[f64]) -> Number {
        let mut all = [0.0; 4];
        let len = components.len().min(4);
        all[..len].copy_from_slice(&components[..len]);
        Number { kind, len, components: all }.rounded()
    }

    pub(crate) fn components(&self) -> &[f64] {
        &self.components[..self.len]
    }

    fn rounded(mut self) -> Number {
        if self.kind == Kind::Float {
            for c in &mut self.components {
                *c = f64::from(*c as f32);
            }
        }
        self
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Number {
        let mut result = self;
        for c in &mut result.components[..self.len] {
            *c = f(*c);
        }
        result.rounded()
    }

    fn zip(self, other: Number, kind: Kind, f: impl Fn(f64, f64) -> f64) -> Option<Number> {
        let len = if self.len == other.len || other.len == 1 {
            self.len
        } else if self.len == 1 {
            other.len
        } else {
            return None;
        };
        let mut components = [0.0; 4];
        for (index, slot) in components.iter_mut().enumerate().take(len) {
            *slot = f(self.components[index % self.len], other.components[index % other.len]);
        }
        Some(Number { kind, len, components }.rounded())
    }

    fn dot(self, other: Number) -> Option<f64> {
        let products = self.zip(other, self.kind, |a, b| a * b)?;
        Some(products.components().iter().fold(0.0, |sum, x| f64::from((sum + x) as f32)))
    }
}

/// The value of `function` of `module` for constant arguments; `None` where it does what this evaluator does not know.
pub(crate) fn evaluate(module: &Module, function: &Function, arguments: &[Number]) -> Option<Value> {
    let mut result = None;
    for statement in function.body.iter() {
        match statement {
            Statement::Emit(_) => {}
            Statement::Return { value: Some(value) } => result = Some(*value),
            _ => return None,
        }
    }
    let mut values: Vec<Option<Value>> = Vec::with_capacity(function.expressions.len());
    // An expression uses only those before it: one loop, no recursion.
    for (_, expression) in function.expressions.iter() {
        let value = Evaluation { module, arguments, values: &values }.expression(expression);
        values.push(value);
    }
    values.get(result?.index())?.clone()
}

struct Evaluation<'e> {
    module: &'e Module,
    arguments: &'e [Number],
    values: &'e [Option<Value>],
}

impl Evaluation<'_> {
    fn number(&self, handle: Handle<Expression>) -> Option<Number> {
        match self.values.get(handle.index())?.as_ref()? {
            Value::Number(number) => Some(*number),
            Value::Struct(_) => None,
        }
    }

    fn expression(&self, expression: &Expression) -> Option<Value> {
        let number = match *expression {
            Expression::FunctionArgument(index) => *self.arguments.get(index as usize)?,
            Expression::Literal(literal) => from_literal(literal)?,
            Expression::Constant(constant) => global(self.module, self.module.constants[constant].init)?,
            Expression::ZeroValue(ty) => zero(&self.module.types[ty].inner)?,
            Expression::Compose { ty, ref components } => {
                return self.compose(&self.module.types[ty].inner, components);
            }
            Expression::Splat { size, value } => {
                let scalar = self.number(value)?;
                Number::new(scalar.kind, &vec![scalar.components[0]; size as usize])
            }
            Expression::Swizzle { size, vector, pattern } => {
                let vector = self.number(vector)?;
                let picked: Vec<f64> =
                    pattern.iter().take(size as usize).map(|c| vector.components[*c as usize]).collect();
                Number::new(vector.kind, &picked)
            }
            Expression::AccessIndex { base, index } => match self.values.get(base.index())?.as_ref()? {
                Value::Number(vector) => Number::new(vector.kind, &[*vector.components().get(index as usize)?]),
                Value::Struct(members) => *members.get(index as usize)?,
            },
            Expression::Unary { op, expr } => self.unary(op, expr)?,
            Expression::Binary { op, left, right } => binary(op, self.number(left)?, self.number(right)?)?,
            Expression::Select { condition, accept, reject } => self.select(condition, accept, reject)?,
            Expression::Relational { fun, argument } => {
                let bools = self.number(argument)?;
                let truth = match fun {
                    naga::RelationalFunction::All => bools.components().iter().all(|b| *b != 0.0),
                    naga::RelationalFunction::Any => bools.components().iter().any(|b| *b != 0.0),
                    _ => return None,
                };
                Number::new(Kind::Bool, &[f64::from(u8::from(truth))])
            }
            Expression::As { expr, kind, convert: Some(_) } => {
                let from = self.number(expr)?;
                match (from.kind, kind) {
                    (_, ScalarKind::Float) => Number::new(Kind::Float, from.components()),
                    (Kind::Bool, ScalarKind::Sint) => Number::new(Kind::Int, from.components()),
                    (Kind::Float | Kind::Int, ScalarKind::Sint) => {
                        let clamped: Vec<f64> =
                            from.components().iter().map(|x| x.trunc().clamp(-2147483648.0, 2147483647.0)).collect();
                        Number::new(Kind::Int, &clamped)
                    }
                    _ => return None,
                }
            }
            Expression::Math { fun, arg, arg1, arg2, .. } => self.math(fun, arg, arg1, arg2)?,
            _ => return None,
        };
        Some(Value::Number(number))
    }

    fn compose(&self, ty: &TypeInner, components: &[Handle<Expression>]) -> Option<Value> {
        let parts: Vec<Number> = components.iter().map(|c| self.number(*c)).collect::<Option<_>>()?;
        match ty {
            TypeInner::Vector { .. } => {
                let all: Vec<f64> = parts.iter().flat_map(|p| p.components().to_vec()).collect();
                Some(Value::Number(Number::new(parts.first()?.kind, &all)))
            }
            TypeInner::Struct { .. } => Some(Value::Struct(parts)),
            _ => None,
        }
    }

    fn unary(&self, op: naga::UnaryOperator, expr: Handle<Expression>) -> Option<Number> {
        let value = self.number(expr)?;
        match (op, value.kind) {
            (naga::UnaryOperator::Negate, Kind::Float) => Some(value.map(|x| -x)),
            (naga::UnaryOperator::LogicalNot, Kind::Bool) => Some(value.map(|x| 1.0 - x)),
            _ => None,
        }
    }

    fn select(
        &self,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Option<Number> {
        let (condition, accept, reject) = (self.number(condition)?, self.number(accept)?, self.number(reject)?);
        let mut result = reject;
        for index in 0..result.len {
            if condition.components[index % condition.len] != 0.0 {
                result.components[index] = accept.components[index];
            }
        }
        Some(result)
    }

    fn math(
        &self,
        fun: MathFunction,
        a: Handle<Expression>,
        b: Option<Handle<Expression>>,
        c: Option<Handle<Expression>>,
    ) -> Option<Number> {
        use MathFunction as M;
        let a = self.number(a)?;
        if a.kind != Kind::Float {
            return None;
        }
        let b = b.map(|b| self.number(b).ok_or(())).transpose().ok()?;
        let c = c.map(|c| self.number(c).ok_or(())).transpose().ok()?;
        let float = |x: f64| Number::new(Kind::Float, &[x]);
        let zip = |f: fn(f64, f64) -> f64| a.zip(b?, Kind::Float, f);
        Some(match fun {
            M::Abs => a.map(f64::abs),
            M::Sign => a.map(|x| if x == 0.0 { 0.0 } else { x.signum() }),
            M::Floor => a.map(f64::floor),
            M::Ceil => a.map(f64::ceil),
            M::Trunc => a.map(f64::trunc),
            M::Round => a.map(f64::round_ties_even),
            M::Fract => a.map(|x| f64::from((x - x.floor()) as f32)),
            M::Sqrt => a.map(f64::sqrt),
            M::InverseSqrt => a.map(|x| 1.0 / x.sqrt()),
            M::Exp => a.map(f64::exp),
            M::Exp2 => a.map(f64::exp2),
            M::Log => a.map(f64::ln),
            M::Log2 => a.map(f64::log2),
            M::Sin => a.map(f64::sin),
            M::Cos => a.map(f64::cos),
            M::Tan => a.map(f64::tan),
            M::Asin => a.map(f64::asin),
            M::Acos => a.map(f64::acos),
            M::Atan => a.map(f64::atan),
            M::Sinh => a.map(f64::sinh),
            M::Cosh => a.map(f64::cosh),
            M::Tanh => a.map(f64::tanh),
            M::Radians => a.map(f64::to_radians),
            M::Degrees => a.map(f64::to_degrees),
            M::Saturate => a.map(|x| x.clamp(0.0, 1.0)),
            M::Min => zip(f64::min)?,
            M::Max => zip(f64::max)?,
            M::Pow => zip(f64::powf)?,
            M::Atan2 => zip(f64::atan2)?,
            M::Step => zip(|edge, x| if edge <= x { 1.0 } else { 0.0 })?,
            M::Clamp => a.zip(b?, Kind::Float, f64::max)?.zip(c?, Kind::Float, f64::min)?,
            M::Mix => {
                let t = c?;
                let from = a.zip(t.map(|t| 1.0 - t), Kind::Float, |a, s| a * s)?;
                from.zip(b?.zip(t, Kind::Float, |b, t| b * t)?, Kind::Float, |a, b| a + b)?
            }
            M::Fma => a.zip(b?, Kind::Float, |a, b| a * b)?.zip(c?, Kind::Float, |p, c| p + c)?,
            M::SmoothStep => {
                let (low, high, x) = (a, b?, c?);
                let width = high.zip(low, Kind::Float, |h, l| h - l)?;
                let t =
                    x.zip(low, Kind::Float, |x, l| x - l)?.zip(width, Kind::Float, |d, w| (d / w).clamp(0.0, 1.0))?;
                t.map(|t| t * t * (3.0 - 2.0 * t))
            }
            M::Dot => float(a.dot(b?)?),
            M::Length => float(a.dot(a)?.sqrt()),
            M::Distance => {
                let d = a.zip(b?, Kind::Float, |a, b| a - b)?;
                float(d.dot(d)?.sqrt())
            }
            M::Normalize => {
                let length = f64::from(a.dot(a)?.sqrt() as f32);
                a.map(|x| x / length)
            }
            M::Cross => {
                let (u, v) = (a.components, b?.components);
                let component = |i: usize, j: usize| f64::from((u[i] * v[j]) as f32) - f64::from((u[j] * v[i]) as f32);
                Number::new(Kind::Float, &[component(1, 2), component(2, 0), component(0, 1)])
            }
            _ => return None,
        })
    }
}

fn binary(op: naga::BinaryOperator, left: Number, right: Number) -> Option<Number> {
    use naga::BinaryOperator as B;
    let truth = |t: bool| f64::from(u8::from(t));
    match (op, left.kind) {
        (B::Add, Kind::Float) => left.zip(right, Kind::Float, |a, b| a + b),
        (B::Subtract, Kind::Float) => left.zip(right, Kind::Float, |a, b| a - b),
        (B::Multiply, Kind::Float) => left.zip(right, Kind::Float, |a, b| a * b),
        (B::Divide, Kind::Float) => left.zip(right, Kind::Float, |a, b| a / b),
        (B::Modulo, Kind::Float) => left.zip(right, Kind::Float, |a, b| a % b),
        (B::Equal, _) => left.zip(right, Kind::Bool, |a, b| truth(a == b)),
        (B::NotEqual, _) => left.zip(right, Kind::Bool, |a, b| truth(a != b)),
        (B::Less, _) => left.zip(right, Kind::Bool, |a, b| truth(a < b)),
        (B::LessEqual, _) => left.zip(right, Kind::Bool, |a, b| truth(a <= b)),
        (B::Greater, _) => left.zip(right, Kind::Bool, |a, b| truth(a > b)),
        (B::GreaterEqual, _) => left.zip(right, Kind::Bool, |a, b| truth(a >= b)),
        (B::LogicalAnd | B::And, Kind::Bool) => left.zip(right, Kind::Bool, |a, b| a * b),
        (B::LogicalOr | B::InclusiveOr, Kind::Bool) => left.zip(right, Kind::Bool, f64::max),
        _ => None,
    }
}

fn from_literal(literal: NagaLiteral) -> Option<Number> {
    Some(match literal {
        NagaLiteral::F32(x) => Number::new(Kind::Float, &[f64::from(x)]),
        NagaLiteral::I32(x) => Number::new(Kind::Int, &[f64::from(x)]),
        NagaLiteral::Bool(x) => Number::new(Kind::Bool, &[f64::from(u8::from(x))]),
        _ => return None,
    })
}

fn zero(ty: &TypeInner) -> Option<Number> {
    let (scalar, len) = match ty {
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (scalar, *size as usize),
        _ => return None,
    };
    let kind = match scalar.kind {
        ScalarKind::Float => Kind::Float,
        ScalarKind::Sint => Kind::Int,
        ScalarKind::Bool => Kind::Bool,
        _ => return None,
    };
    Some(Number { kind, len, components: [0.0; 4] })
}

/// The value of a module-scope constant.
fn global(module: &Module, handle: Handle<Expression>) -> Option<Number> {
    match &module.global_expressions[handle] {
        Expression::Literal(literal) => from_literal(*literal),
        Expression::Splat { size, value } => {
            let Expression::Literal(literal) = module.global_expressions[*value] else { return None };
            let scalar = from_literal(literal)?;
            Some(Number::new(scalar.kind, &vec![scalar.components[0]; *size as usize]))
        }
        Expression::Compose { ty, components } if matches!(module.types[*ty].inner, TypeInner::Vector { .. }) => {
            let mut all = Vec::new();
            let mut kind = Kind::Float;
            for component in components {
                let Expression::Literal(literal) = module.global_expressions[*component] else { return None };
                let scalar = from_literal(literal)?;
                kind = scalar.kind;
                all.push(scalar.components[0]);
            }
            Some(Number::new(kind, &all))
        }
        _ => None,
    }
}

/// What a function of one built-in expression does with one of its arguments when others have a certain constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// `arguments[0] op arguments[1]`
    Binary(naga::BinaryOperator, usize, usize),
    /// `mix(a, b, t)`
    Mix(usize, usize, usize),
    /// Anything else.
    Other,
}

/// The shape of a function's body.
pub(crate) fn shape(function: &Function) -> Shape {
    let mut returned = None;
    for statement in function.body.iter() {
        match statement {
            Statement::Emit(_) => {}
            Statement::Return { value } => returned = *value,
            _ => return Shape::Other,
        }
    }
    let Some(returned) = returned else { return Shape::Other };
    let argument = |handle: Handle<Expression>| match function.expressions[handle] {
        Expression::FunctionArgument(index) => Some(index as usize),
        // A scalar argument that the expression spreads itself.
        Expression::Splat { value, .. } => match function.expressions[value] {
            Expression::FunctionArgument(index) => Some(index as usize),
            _ => None,
        },
        _ => None,
    };
    match function.expressions[returned] {
        Expression::Binary { op, left, right } => match (argument(left), argument(right)) {
            (Some(a), Some(b)) => Shape::Binary(op, a, b),
            _ => Shape::Other,
        },
        Expression::Math { fun: MathFunction::Mix, arg, arg1: Some(b), arg2: Some(t), .. } => {
            match (argument(arg), argument(b), argument(t)) {
                (Some(a), Some(b), Some(t)) => Shape::Mix(a, b, t),
                _ => Shape::Other,
            }
        }
        _ => Shape::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(body: &str, arguments: &[Number]) -> Option<Vec<f64>> {
        let source = format!("const K: vec3f = vec3f(2.0);\nstruct S {{ a: f32, b: vec2f }}\n{body}");
        let module = naga::front::wgsl::parse_str(&source).expect("sound WGSL");
        let (_, function) = module.functions.iter().next().expect("a function");
        match evaluate(&module, function, arguments)? {
            Value::Number(number) => Some(number.components().to_vec()),
            Value::Struct(members) => Some(members.iter().flat_map(|m| m.components().to_vec()).collect()),
        }
    }

    fn f(x: &[f32]) -> Number {
        Number::new(Kind::Float, &x.iter().map(|x| f64::from(*x)).collect::<Vec<_>>())
    }

    #[test]
    fn computes_in_f32() {
        let sum = run("fn g(a: f32, b: f32) -> f32 { return a + b; }", &[f(&[0.1]), f(&[0.2])]).unwrap();
        assert_eq!(sum, [f64::from(0.1_f32 + 0.2_f32)]);
        let three =
            run("fn g(a: vec3f, t: f32) -> vec3f { return mix(a, K, t).zyx * 2.0; }", &[f(&[0., 1., 4.]), f(&[0.5])]);
        assert_eq!(three.unwrap(), [6.0, 3.0, 2.0]);
        let picked =
            run("fn g(a: f32) -> f32 { let n = select(0.0, min(a, 9.0), a > 0.0); return n * n; }", &[f(&[3.0])]);
        assert_eq!(picked.unwrap(), [9.0]);
        let both = run("fn g(a: f32) -> S { return S(a, vec2f(a, -a)); }", &[f(&[3.0])]);
        assert_eq!(both.unwrap(), [3.0, 3.0, -3.0]);
        assert_eq!(run("fn g(a: vec3f) -> f32 { return length(a); }", &[f(&[3., 0., 4.])]).unwrap(), [5.0]);
        assert!(run("fn g(a: f32) -> f32 { return 1.0 / a; }", &[f(&[0.0])]).unwrap()[0].is_infinite());
    }

    #[test]
    fn leaves_alone_what_it_does_not_know() {
        assert_eq!(run("fn g(a: f32) -> f32 { if a > 1.0 { return 2.0; } return a; }", &[f(&[3.0])]), None);
        assert_eq!(run("fn g(a: f32) -> f32 { var b = a; b += 1.0; return b; }", &[f(&[3.0])]), None);
    }

    #[test]
    fn shapes() {
        let of = |source: &str| {
            let module = naga::front::wgsl::parse_str(source).expect("sound WGSL");
            shape(module.functions.iter().next().expect("a function").1)
        };
        assert_eq!(
            of("fn g(a: f32, b: f32) -> f32 { return b * a; }"),
            Shape::Binary(naga::BinaryOperator::Multiply, 1, 0)
        );
        assert_eq!(of("fn g(a: vec3f, b: vec3f, t: f32) -> vec3f { return mix(a, b, t); }"), Shape::Mix(0, 1, 2));
        assert_eq!(of("fn g(a: f32, b: f32) -> f32 { return a * b + a; }"), Shape::Other);
    }
}
