//! Functions of the library that do nothing, or next to nothing, for some numbers, though no single expression of them says so: what is
//! raised to the power of 1, turned by 0. Where a rounding changes, it is for the better: 2^(log2 x) becomes x.

use halfvector_graph::value::Type;

use crate::ir::{Arena, Id};

/// What is left of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Left {
    /// Its first argument.
    Same,
    /// Its first argument, 0 where that is negative.
    AtLeastZero,
    /// Its first argument, held in 0..1.
    Saturated,
}

/// A function, the numbers that its arguments have to have, by their places, and what is left then.
type Identity = (&'static str, &'static [(usize, &'static [f32])], Left);

const X: &[f32] = &[1.0, 0.0, 0.0];
const Y: &[f32] = &[0.0, 1.0, 0.0];
const Z: &[f32] = &[0.0, 0.0, 1.0];

const IDENTITIES: [Identity; 8] = [
    // Powers: exact where the function rounds twice.
    ("node_math_power", &[(1, &[1.0])], Left::AtLeastZero),
    ("node_color_gamma", &[(1, &[1.0])], Left::AtLeastZero),
    ("node_color_levels", &[(1, &[0.0]), (2, &[1.0]), (3, &[1.0]), (4, &[0.0]), (5, &[1.0])], Left::Saturated),
    // The others change no rounding.
    ("node_color_exposure", &[(1, &[0.0])], Left::Same),
    ("node_color_channel_mixer", &[(1, X), (2, Y), (3, Z)], Left::Same),
    ("node_vector_matrix_transform", &[(1, X), (2, Y), (3, Z), (4, &[0.0])], Left::Same),
    ("node_vector_rotate_euler", &[(1, &[0.0])], Left::Same),
    ("node_vector_rotate_about_axis", &[(2, &[0.0])], Left::Same),
];

/// What is left of a call, if it is an identity.
pub(crate) fn left_of(arena: &Arena<'_>, function: &str, arguments: &[Id]) -> Option<Left> {
    let (_, wanted, left) = IDENTITIES.iter().find(|(name, ..)| *name == function)?;
    let fits = |(place, numbers): &(usize, &[f32])| {
        let literal = arguments.get(*place).and_then(|id| arena.as_literal(*id));
        literal.filter(|literal| literal.ty != Type::I32).is_some_and(|literal| {
            literal.components().iter().enumerate().all(|(i, number)| *number == numbers[i % numbers.len()])
        })
    };
    wanted.iter().all(fits).then_some(*left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::Index;
    use crate::passes::eval::{Kind, Number, Value};

    /// Each function gives for its numbers what is left of it.
    #[test]
    fn the_functions_do_what_is_left_of_them() {
        let index = Index::standard();
        for (name, wanted, left) in IDENTITIES {
            let compiled = index.compiled(index.instance(name, Some(Type::Vec3)).expect(name)).expect(name);
            for first in [[0.0, 0.25, 1.0], [-0.5, 3.0, 0.7], [1e-3, 40.0, -7.0]] {
                let mut arguments = vec![Number::new(Kind::Float, &first)];
                let last = wanted.iter().map(|(place, _)| *place).max().unwrap_or(0);
                for place in 1..=last {
                    let numbers = wanted.iter().find(|(at, _)| *at == place).map(|(_, numbers)| *numbers);
                    // Of vectors all components are 0 or 1 where one number stands for them.
                    let is_vector = matches!(
                        (name, place),
                        ("node_math_power", 1)
                            | ("node_vector_matrix_transform", 4)
                            | ("node_vector_rotate_euler", 1)
                            | ("node_vector_rotate_about_axis", 1)
                    );
                    let numbers: Vec<f64> = numbers.unwrap_or(&[0.3]).iter().map(|x| f64::from(*x)).collect();
                    let numbers = if is_vector { numbers.repeat(3) } else { numbers };
                    arguments.push(Number::new(Kind::Float, &numbers));
                }
                let Some(Value::Number(given)) = compiled.evaluate(&arguments) else { panic!("{name}") };
                for (given, first) in given.components().iter().zip(first) {
                    let wanted = match left {
                        Left::Same => first,
                        Left::AtLeastZero => first.max(0.0),
                        Left::Saturated => first.clamp(0.0, 1.0),
                    };
                    assert!((given - wanted).abs() <= 4e-6 * wanted.abs(), "{name}: {given} for {wanted}");
                }
            }
        }
    }
}
