//! Pass: constants are computed and identities taken out, so that neither reaches the shader.
//!
//! A call folds when all its arguments are constants and its function can run on numbers alone; where some are, what is left of it
//! (`reduce`): an argument, two that are joined, a number; a mix of two surfaces when they are alike. What is not finite is an error at
//! its node, never text.

use std::collections::HashMap;

use halfvector_graph::value::Type;

use crate::ir::{Arena, Entry, Expr, Id, Literal, Program, Stage, Ty};
use crate::link::Index;
use crate::passes::eval::{Kind, Number, Value};
use crate::passes::identity::{Left, left_of};
use crate::passes::mixed::{MIX_NORMALS, are_same};
use crate::passes::reduce::{Reduced, is_function};

/// A node whose constant value is not a finite number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NotFinite {
    /// Index into the program's nodes.
    pub(crate) node: Option<usize>,
}

/// Folds both stages of a program.
pub(crate) fn fold<'a>(program: &mut Program<'a>, index: &Index) -> Vec<NotFinite> {
    let mut faults = Vec::new();
    fold_stage(&mut program.fragment, index, &mut faults);
    fold_stage(&mut program.vertex, index, &mut faults);
    faults
}

/// Folds one stage.
pub(crate) fn fold_stage<'a>(stage: &mut Stage<'a>, index: &Index, faults: &mut Vec<NotFinite>) {
    // Calls of functions that return structs, whose members are known.
    let mut structs: HashMap<Id, Vec<(String, Literal)>> = HashMap::new();
    stage.rebuild(|arena, _, entry| {
        let folded = match &entry.expr {
            Expr::Convert { of } => arena
                .as_literal(*of)
                .zip(value_type(entry.ty))
                .map(|(literal, to)| Folded::Literal(Literal::new(to, &literal.numbers()))),
            Expr::Field { of, name } => structs.get(of).and_then(|members| {
                members.iter().find(|(n, _)| n == name).map(|(_, literal)| Folded::Literal(*literal))
            }),
            Expr::Call { function, generic, arguments } => {
                call(arena, index, function, *generic, arguments, value_type(entry.ty))
            }
            Expr::Builtin { name, arguments } => builtin(arena, name, arguments, value_type(entry.ty)),
            _ => None,
        };
        let (node, hint) = (entry.node, entry.hint);
        // Members and conversions of what is not finite are no faults of their own.
        let computed = matches!(entry.expr, Expr::Call { .. } | Expr::Builtin { .. });
        Some(match folded {
            Some(Folded::Literal(literal)) => {
                if computed && !literal.is_finite() {
                    faults.push(NotFinite { node });
                }
                arena.push(Entry { expr: Expr::Literal(literal), ty: Ty::Value(literal.ty), node, hint })
            }
            Some(Folded::Same(id)) => id,
            Some(Folded::Spread(id, ty)) => arena.convert(id, ty),
            Some(Folded::Rest(rest, arguments, ty)) => built(arena, &rest, &arguments, ty, &entry),
            Some(Folded::Struct(members)) => {
                if members.iter().any(|(_, literal)| !literal.is_finite()) {
                    faults.push(NotFinite { node });
                }
                let id = arena.push(entry);
                structs.insert(id, members);
                id
            }
            None => arena.push(entry),
        })
    });
}

enum Folded {
    Literal(Literal),
    Same(Id),
    Spread(Id, Type),
    /// What is left of a call of these arguments, of a type.
    Rest(Reduced, Vec<Id>, Type),
    Struct(Vec<(String, Literal)>),
}

fn value_type(ty: Ty) -> Option<Type> {
    match ty {
        Ty::Value(ty) => Some(ty),
        _ => None,
    }
}

fn call(
    arena: &Arena<'_>,
    index: &Index,
    function: &str,
    generic: Option<Type>,
    arguments: &[Id],
    ty: Option<Type>,
) -> Option<Folded> {
    if function == MIX_NORMALS {
        return end_of_mix(arena, arguments, ty?);
    }
    if function == "node_math_mix"
        && let Some(end) = end_of_mix(arena, arguments, ty?)
    {
        return Some(end);
    }
    let literals: Vec<Option<Literal>> = arguments.iter().map(|id| arena.as_literal(*id)).collect();
    if literals.iter().all(Option::is_none) {
        return None;
    }
    let compiled = index.compiled(index.instance(function, generic)?)?;
    let all: Option<Vec<Number>> = literals.iter().map(|l| l.as_ref().map(number)).collect();
    if let Some(numbers) = all {
        return Some(match (compiled.evaluate(&numbers)?, ty) {
            (Value::Number(number), Some(ty)) => Folded::Literal(literal(ty, &number)),
            (Value::Struct(members), None) => Folded::Struct(
                compiled
                    .members
                    .iter()
                    .zip(&members)
                    .map(|(name, number)| Some((name.clone(), literal(type_of(number)?, number))))
                    .collect::<Option<_>>()?,
            ),
            _ => return None,
        });
    }
    if let (Some(left), Some(ty)) = (left_of(arena, function, arguments), ty) {
        let first = Reduced::Argument(0);
        let rest = match left {
            Left::Same => return same_or_spread(arena, *arguments.first()?, ty),
            Left::AtLeastZero => Reduced::Applied("max", vec![first, Reduced::Known(vec![0.0])]),
            Left::Saturated => Reduced::Applied("saturate", vec![first]),
        };
        return is_of_type(arena, &rest, arguments, ty).then(|| Folded::Rest(rest, arguments.to_vec(), ty));
    }
    // Whole numbers divide in another way: they are handed on at most.
    let known = literals.iter().map(|l| l.filter(|l| l.ty != Type::I32).map(|l| l.components()));
    let known: Vec<Option<Vec<f32>>> = known.collect();
    let (reduced, ty) = (compiled.reduced(&known)?, ty?);
    let of = |argument: usize| arguments.get(argument).copied();
    match reduced {
        Reduced::Known(numbers) if numbers.iter().any(|x| !x.is_finite()) => None,
        Reduced::Known(numbers) => {
            let numbers: Vec<f64> = numbers.iter().map(|x| f64::from(*x)).collect();
            Some(Folded::Literal(Literal::new(ty, &numbers)))
        }
        Reduced::Argument(kept) => same_or_spread(arena, of(kept)?, ty),
        // What is joined is no longer to be read out of a function.
        rest => is_of_type(arena, &rest, arguments, ty).then(|| Folded::Rest(rest, arguments.to_vec(), ty)),
    }
}

/// Whether what is left of a call is of its type, of arguments that operators of WGSL take.
fn is_of_type(arena: &Arena<'_>, rest: &Reduced, arguments: &[Id], ty: Type) -> bool {
    let own = |argument: usize| arguments.get(argument).and_then(|id| value_type(arena.get(*id).ty));
    match rest {
        Reduced::Known(numbers) => {
            let is_whole = numbers.len() == 1 || numbers.len() == ty.components();
            is_whole && numbers.iter().all(|x| x.is_finite())
        }
        Reduced::Argument(argument) => own(*argument).is_some_and(|own| own == ty || own == Type::F32),
        Reduced::Applied(name, parts) => {
            let is = |part: &Reduced| match part {
                Reduced::Argument(argument) => own(*argument) == Some(ty),
                Reduced::Known(_) => false,
                _ => true,
            };
            let is_spread = is_function(name) || parts.iter().any(is);
            is_number(ty) && is_spread && parts.iter().all(|part| is_of_type(arena, part, arguments, ty))
        }
        Reduced::Called(name, parts) => {
            let fits = |(part, size): &(Reduced, usize)| {
                of_size(*size).is_some_and(|of| match part {
                    Reduced::Argument(argument) => own(*argument) == Some(of),
                    part => is_of_type(arena, part, arguments, of),
                })
            };
            Index::name_in_library(name).is_some() && parts.iter().all(fits)
        }
    }
}

/// What is left of a call as expressions in its place.
fn built<'a>(arena: &mut Arena<'a>, rest: &Reduced, arguments: &[Id], ty: Type, call: &Entry<'a>) -> Id {
    let expr = match rest {
        Reduced::Known(numbers) => {
            let numbers: Vec<f64> = numbers.iter().map(|x| f64::from(*x)).collect();
            return arena.literal(ty, &numbers);
        }
        Reduced::Argument(argument) => return arguments[*argument],
        Reduced::Applied(name, parts) => {
            let mut parts: Vec<Id> = parts.iter().map(|part| built(arena, part, arguments, ty, call)).collect();
            if is_function(name) {
                parts = parts.into_iter().map(|part| arena.convert(part, ty)).collect();
            }
            Expr::Builtin { name, arguments: parts }
        }
        Reduced::Called(name, parts) => {
            let parts =
                parts.iter().map(|(part, size)| built(arena, part, arguments, of_size(*size).unwrap_or(ty), call));
            let arguments = parts.collect();
            match Index::name_in_library(name) {
                Some(function) => Expr::Call { function, generic: None, arguments },
                None => call.expr.clone(),
            }
        }
    };
    arena.push(Entry { expr, ty: Ty::Value(ty), node: call.node, hint: call.hint })
}

/// The type of so many floats.
fn of_size(components: usize) -> Option<Type> {
    [Type::F32, Type::Vec2, Type::Vec3, Type::Vec4].into_iter().find(|ty| ty.components() == components)
}

/// Whether operators of floats work on a type.
fn is_number(ty: Type) -> bool {
    !matches!(ty, Type::Bool | Type::I32)
}

/// Operators and functions that passes add themselves.
fn builtin(arena: &Arena<'_>, name: &str, arguments: &[Id], ty: Option<Type>) -> Option<Folded> {
    let ty = ty?;
    let literal = |n: usize| arguments.get(n).and_then(|id| arena.as_literal(*id));
    let is = |n: usize, x: f32| literal(n).is_some_and(|l| l.is_all(x));
    match name {
        "*" if is(0, 1.0) => same_or_spread(arena, arguments[1], ty),
        "+" if is(0, 0.0) => same_or_spread(arena, arguments[1], ty),
        "*" | "/" if is(1, 1.0) => same_or_spread(arena, arguments[0], ty),
        "+" | "-" if is(1, 0.0) => same_or_spread(arena, arguments[0], ty),
        "*" | "/" | "+" | "-" => {
            let (a, b) = (literal(0)?.components(), literal(1)?.components());
            let join = |i: usize| {
                let (a, b) = (a[i % a.len()], b[i % b.len()]);
                match name {
                    "*" => a * b,
                    "/" => a / b,
                    "+" => a + b,
                    _ => a - b,
                }
            };
            let joined: Vec<f64> = (0..ty.components()).map(|i| f64::from(join(i))).collect();
            Some(Folded::Literal(Literal::new(ty, &joined)))
        }
        "mix" => end_of_mix(arena, arguments, ty).or_else(|| {
            let (a, b, t) = (literal(0)?.components(), literal(1)?.components(), literal(2)?.components());
            let mixed = |i: usize| {
                let t = t[i % t.len()];
                a[i % a.len()] * (1.0 - t) + b[i % b.len()] * t
            };
            Some(Folded::Literal(Literal::new(
                ty,
                &(0..ty.components()).map(mixed).map(f64::from).collect::<Vec<f64>>(),
            )))
        }),
        "saturate" => {
            let held: Vec<f64> = literal(0)?.numbers().iter().map(|x| x.clamp(0.0, 1.0)).collect();
            Some(Folded::Literal(Literal::new(ty, &held)))
        }
        _ => None,
    }
}

/// The one side that a mixture is known to be: its weight is 0 or 1, or both sides are the same.
fn end_of_mix(arena: &Arena<'_>, arguments: &[Id], ty: Type) -> Option<Folded> {
    let &[a, b, t] = arguments else { return None };
    let is = |x: f32| arena.as_literal(t).is_some_and(|l| l.is_all(x));
    if is(0.0) || are_same(arena, a, b) {
        return same_or_spread(arena, a, ty);
    }
    if is(1.0) { same_or_spread(arena, b, ty) } else { None }
}

fn same_or_spread(arena: &Arena<'_>, id: Id, ty: Type) -> Option<Folded> {
    match value_type(arena.get(id).ty)? {
        from if from == ty => Some(Folded::Same(id)),
        from if from.converts_to(ty) => Some(Folded::Spread(id, ty)),
        _ => None,
    }
}

fn number(literal: &Literal) -> Number {
    let kind = match literal.ty {
        Type::Bool => Kind::Bool,
        Type::I32 => Kind::Int,
        _ => Kind::Float,
    };
    Number::new(kind, &literal.numbers())
}

fn literal(ty: Type, number: &Number) -> Literal {
    Literal::new(ty, number.components())
}

fn type_of(number: &Number) -> Option<Type> {
    Some(match (number.kind, number.components().len()) {
        (Kind::Bool, 1) => Type::Bool,
        (Kind::Int, 1) => Type::I32,
        (Kind::Float, 1) => Type::F32,
        (Kind::Float, 2) => Type::Vec2,
        (Kind::Float, 3) => Type::Vec3,
        (Kind::Float, 4) => Type::Vec4,
        _ => return None,
    })
}
