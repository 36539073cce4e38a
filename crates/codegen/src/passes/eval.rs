//! Calls of library functions on constants, run by the interpreter in f32. What it refuses, and what takes derivatives or
//! too long, is left alone, and the shader computes it.

use halfvector_interp::{Column, Derivatives, Entry, Limits, Outputs, Program, Resources};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle, Module, Scalar, ScalarKind, TypeInner};

/// What folding one call may cost: a shader computes in an instant what needs more.
const LIMITS: Limits = Limits { steps: 1 << 14, bytes: 1 << 22 };

/// A scalar or vector of one to four components: f32, integers and bools are exact in f64.
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
        Number { kind, len, components: all }
    }

    pub(crate) fn components(&self) -> &[f64] {
        &self.components[..self.len]
    }

    /// What the interpreter takes for a component.
    fn word(&self, component: usize) -> u32 {
        (self.components[component] as i32).cast_unsigned()
    }
}

/// A function that can be called with constants.
pub(crate) struct Callable {
    program: Program,
    /// Components of each argument.
    arguments: Vec<(Kind, usize)>,
    /// Kind and components of the result, or of its members.
    results: Vec<(Kind, usize)>,
    is_struct: bool,
}

fn number_type(inner: &TypeInner) -> Option<(Kind, usize)> {
    let (scalar, len) = match *inner {
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (scalar, size as usize),
        _ => return None,
    };
    let kind = match scalar {
        Scalar::F32 => Kind::Float,
        Scalar::I32 => Kind::Int,
        Scalar { kind: ScalarKind::Bool, .. } => Kind::Bool,
        _ => return None,
    };
    Some((kind, len))
}

impl Callable {
    /// `None` for a function that cannot run on numbers alone.
    pub(crate) fn new(module: &Module, function: &Function) -> Option<Callable> {
        let inner = |ty: Handle<naga::Type>| &module.types[ty].inner;
        let arguments = function.arguments.iter().map(|a| number_type(inner(a.ty))).collect::<Option<Vec<_>>>()?;
        let (results, is_struct) = match inner(function.result.as_ref()?.ty) {
            TypeInner::Struct { members, .. } => {
                (members.iter().map(|m| number_type(inner(m.ty))).collect::<Option<Vec<_>>>()?, true)
            }
            plain => (vec![number_type(plain)?], false),
        };
        let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(module).ok()?;
        let program = Program::compile(module, &info, Entry::Function(function.name.as_deref()?)).ok()?;
        (!program.uses_derivatives()).then_some(Callable { program, arguments, results, is_struct })
    }

    /// The value for constant arguments; `None` where there is none within the limits.
    pub(crate) fn call(&self, arguments: &[Number]) -> Option<Value> {
        let mut floats: Vec<[f32; 1]> = Vec::new();
        let mut words: Vec<[u32; 1]> = Vec::new();
        let mut kinds = Vec::new();
        if arguments.len() != self.arguments.len() {
            return None;
        }
        for (number, (kind, len)) in arguments.iter().zip(&self.arguments) {
            if number.kind != *kind || number.len != *len && number.len != 1 {
                return None;
            }
            for i in 0..*len {
                floats.push([number.components[i % number.len] as f32]);
                words.push([number.word(i % number.len)]);
                kinds.push(*kind);
            }
        }
        let inputs: Vec<Column<'_, f32>> = kinds
            .iter()
            .enumerate()
            .map(|(i, kind)| if *kind == Kind::Float { Column::Float(&floats[i]) } else { Column::Word(&words[i]) })
            .collect();
        let mut out = Outputs::default();
        self.program.run(&inputs, 1, &mut out, &Resources::default(), Derivatives::Zero, LIMITS).ok()?;
        let mut columns = out.columns.iter().map(|c| c.to_f64()[0]);
        let numbers: Vec<Number> = self
            .results
            .iter()
            .map(|(kind, len)| {
                let components: Vec<f64> = columns.by_ref().take(*len).collect();
                match kind {
                    // Words come back unsigned.
                    Kind::Int => {
                        let signed: Vec<f64> =
                            components.iter().map(|x| f64::from((*x as u32).cast_signed())).collect();
                        Number::new(*kind, &signed)
                    }
                    _ => Number::new(*kind, &components),
                }
            })
            .collect();
        if self.is_struct { Some(Value::Struct(numbers)) } else { numbers.first().map(|n| Value::Number(*n)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(body: &str, arguments: &[Number]) -> Option<Vec<f64>> {
        let source = format!("const K: vec3f = vec3f(2.0);\nstruct S {{ a: f32, b: vec2f }}\n{body}");
        let module = naga::front::wgsl::parse_str(&source).expect("sound WGSL");
        let (_, function) = module.functions.iter().next().expect("a function");
        match Callable::new(&module, function)?.call(arguments)? {
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
    fn runs_control_flow_and_calls() {
        let branch = "fn g(a: f32) -> f32 { if a > 1.0 { return 2.0; } return a; }";
        assert_eq!(run(branch, &[f(&[3.0])]).unwrap(), [2.0]);
        assert_eq!(run(branch, &[f(&[0.5])]).unwrap(), [0.5]);
        let looped = "fn g(n: i32) -> i32 { var s = 0; for (var i = 0; i < n; i++) { s -= i; } return s; }";
        assert_eq!(run(looped, &[Number::new(Kind::Int, &[4.0])]).unwrap(), [-6.0]);
        let chosen = "fn g(b: bool, x: vec2f) -> bool { return b && any(x > vec2f(1.0)); }";
        assert_eq!(run(chosen, &[Number::new(Kind::Bool, &[1.0]), f(&[0.0, 2.0])]).unwrap(), [1.0]);
    }

    #[test]
    fn leaves_alone_what_it_cannot_know() {
        assert_eq!(run("fn g(a: f32) -> f32 { loop { if a < 0.0 { break; } } return a; }", &[f(&[3.0])]), None);
        assert_eq!(run("fn g(a: f32) -> f32 { return dpdx(a); }", &[f(&[3.0])]), None);
        assert_eq!(
            run("@group(0) @binding(0) var<uniform> u: f32; fn g(a: f32) -> f32 { return a * u; }", &[f(&[3.0])]),
            None
        );
    }
}
