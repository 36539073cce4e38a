//! Conversions between floats and words.

use half::f16;

use crate::real::Float;

/// A conversion; the classes of operand and result say between which registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Convert {
    /// Rounds toward zero, limited to the i32 that an f32 can hold (all of them from f64); NaN is 0.
    SignedFromFloat,
    /// The same for u32.
    UnsignedFromFloat,
    FloatFromSigned,
    FloatFromUnsigned,
    /// Between f32 and f64.
    FloatFromFloat,
    /// The bits of the f32.
    BitsFromFloat,
    /// The f32 of the bits.
    FloatFromBits,
    /// The bits of the f16, rounded to nearest even.
    HalfFromFloat,
    /// The f32 of the low 16 bits.
    FloatFromHalf,
    /// Rounds to f32.
    RoundToF32,
}

/// Float to word. `narrow`: the shader's type is f32.
#[inline(always)]
pub(crate) fn int_from_float<T: Float>(op: Convert, narrow: bool, x: T) -> u32 {
    match op {
        // naga limits to what an f32 can hold, in its own evaluator as on devices.
        Convert::SignedFromFloat => {
            let high = if narrow { 2_147_483_520.0 } else { 2_147_483_647.0 };
            let x = x.to_f64();
            (if x > high { high as i32 } else { x as i32 }).cast_unsigned()
        }
        Convert::UnsignedFromFloat => {
            let high = if narrow { 4_294_967_040.0 } else { 4_294_967_295.0 };
            let x = x.to_f64();
            if x > high { high as u32 } else { x as u32 }
        }
        Convert::HalfFromFloat => u32::from(f16::from_f32(x.to_f32()).to_bits()),
        _ => x.to_f32().to_bits(),
    }
}

/// Word to float.
#[inline(always)]
pub(crate) fn float_from_bits<T: Float>(op: Convert, x: u32) -> T {
    match op {
        Convert::FloatFromSigned => T::from_f64(f64::from(x.cast_signed())),
        Convert::FloatFromUnsigned => T::from_f64(f64::from(x)),
        Convert::FloatFromHalf => T::from_f64(f64::from(f16::from_bits(x as u16))),
        _ => T::from_f64(f64::from(f32::from_bits(x))),
    }
}

/// Float to float of another width, or rounded to f32.
#[inline(always)]
pub(crate) fn float_from_float<A: Float, B: Float>(x: A) -> B {
    B::from_f64(x.to_f64())
}

#[inline(always)]
pub(crate) fn round_to_f32<T: Float>(x: T) -> T {
    T::from_f64(f64::from(x.to_f32()))
}
