//! Operations on floats, with WGSL's meaning of each.

use super::{Block, LANES, Source, map1, map2, operations};
use crate::real::Float;

operations! {
    /// Float operands, float result.
    FloatOp, plain_one, plain_block, T: Float;
    unary {
        Neg: |a| -a;
        Abs: |a| a.abs();
        Floor: |a| a.floor();
        Ceil: |a| a.ceil();
        Trunc: |a| a.trunc();
        Round: |a| a.round_even();
        Fract: |a| a - a.floor();
        Saturate: |a| a.most(T::ZERO).least(T::ONE);
        Sign: |a| if a > T::ZERO { T::ONE } else if a < T::ZERO { -T::ONE } else { T::ZERO };
        Sqrt: |a| a.sqrt();
        InverseSqrt: |a| T::ONE / a.sqrt();
        Exp: |a| a.exp();
        Exp2: |a| a.exp2();
        Log: |a| a.ln();
        Log2: |a| a.log2();
        Sin: |a| a.sin();
        Cos: |a| a.cos();
        Tan: |a| a.tan();
        Asin: |a| a.asin();
        Acos: |a| a.acos();
        Atan: |a| a.atan();
        Sinh: |a| a.sinh();
        Cosh: |a| a.cosh();
        Tanh: |a| a.tanh();
        Asinh: |a| a.asinh();
        Acosh: |a| a.acosh();
        Atanh: |a| a.atanh();
        Significand: |a| a.significand();
    }
    binary {
        Add: |a, b| a + b;
        Sub: |a, b| a - b;
        Mul: |a, b| a * b;
        Div: |a, b| a / b;
        // WGSL 2023, 8.7: the remainder of a division that truncates.
        Rem: |a, b| a - b * (a / b).trunc();
        Min: |a, b| a.least(b);
        Max: |a, b| a.most(b);
        Pow: |a, b| a.pow(b);
        Atan2: |a, b| a.atan2(b);
        Step: |edge, x| if edge <= x { T::ONE } else { T::ZERO };
    }
    ternary {
        // Two roundings: WGSL allows it, and so a machine's instructions change no result.
        Fma: |a, b, c| a * b + c;
        Clamp: |x, low, high| x.most(low).least(high);
        Mix: |a, b, t| a * (T::ONE - t) + b * t;
        Smoothstep: |low, high, x| {
            let t = ((x - low) / (high - low)).most(T::ZERO).least(T::ONE);
            t * t * (T::number(3.0) - T::number(2.0) * t)
        };
    }
}

fn wild<T: Float>(x: T) -> bool {
    x.abs() > T::WILD
}

#[inline(always)]
fn turn_wild<T: Float>(op: FloatOp, x: T) -> T {
    match op {
        FloatOp::Sin => x.sin_wild(),
        FloatOp::Cos => x.cos_wild(),
        _ => x.tan_wild(),
    }
}

fn has_period(op: FloatOp) -> bool {
    matches!(op, FloatOp::Sin | FloatOp::Cos | FloatOp::Tan)
}

pub(crate) fn float_one<T: Float>(op: FloatOp, a: T, b: T, c: T) -> T {
    if has_period(op) && wild(a) { turn_wild(op, a) } else { plain_one(op, a, b, c) }
}

#[inline(always)]
pub(crate) fn float_block<T: Float>(
    op: FloatOp,
    a: Source<'_, T>,
    b: Source<'_, T>,
    c: Source<'_, T>,
    out: &mut Block<T>,
) {
    if has_period(op) && (0..LANES).any(|i| wild(a.lane(i))) {
        return map1(out, a, |x| if wild(x) { turn_wild(op, x) } else { plain_one(op, x, x, x) });
    }
    plain_block(op, a, b, c, out);
}

/// Float operands, a mask as the result: all bits set for true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CompareOp {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    IsNan,
    IsInf,
}

#[inline(always)]
fn mask(condition: bool) -> u32 {
    u32::from(condition).wrapping_neg()
}

pub(crate) fn compare_one<T: Float>(op: CompareOp, a: T, b: T) -> u32 {
    mask(match op {
        CompareOp::Equal => a == b,
        CompareOp::NotEqual => a != b,
        CompareOp::Less => a < b,
        CompareOp::LessEqual => a <= b,
        CompareOp::IsNan => a.is_nan(),
        CompareOp::IsInf => a.is_infinite(),
    })
}

#[inline(always)]
pub(crate) fn compare_block<T: Float>(op: CompareOp, a: Source<'_, T>, b: Source<'_, T>, out: &mut Block<u32>) {
    match op {
        CompareOp::Equal => map2(out, a, b, |a, b| mask(a == b)),
        CompareOp::NotEqual => map2(out, a, b, |a, b| mask(a != b)),
        CompareOp::Less => map2(out, a, b, |a, b| mask(a < b)),
        CompareOp::LessEqual => map2(out, a, b, |a, b| mask(a <= b)),
        CompareOp::IsNan => map1(out, a, |a| mask(a.is_nan())),
        CompareOp::IsInf => map1(out, a, |a| mask(a.is_infinite())),
    }
}
