//! The numbers that the crate computes with: `f32`, which a GPU has, `f64`, which the truth is made of, and lanes of `f32`,
//! which a CPU computes side by side.
//!
//! It is a trait of our own, and small: `num-traits` would bring a surface of a hundred methods for the dozen that a BRDF
//! needs, and has no masks. `simba` has both and far more; `wide` and `pulp` have lanes and no trait that `f64` shares.
//! It is not a general numeric tower: add what a lobe needs, no more.
//!
//! A function over `Real` has no `if` on values, because lanes differ: it computes both sides and calls [`Real::choose`].

use core::fmt::{Debug, Display};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A real number: `f32`, `f64`, or several `f32` side by side.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// What a comparison gives: `bool`, or one of them per lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The nearest number of this type.
    fn of(x: f64) -> Self;
    /// Square root; NaN below 0.
    fn sqrt(self) -> Self;
    /// Square root of a number from 1e-37, or of 0, within 2 ulp; any other number gives any number. In lanes it does without
    /// the divider, for which vector CPUs have no wide unit: for functions that take several roots of one element.
    #[inline(always)]
    fn sqrt_by_products(self) -> Self {
        self.sqrt()
    }
    /// Absolute value.
    fn abs(self) -> Self;
    /// 2 to this power.
    fn exp2(self) -> Self;
    /// Logarithm to base 2; NaN below 0.
    fn log2(self) -> Self;
    /// Arc cosine in radians, in 0..pi; NaN outside -1..1.
    fn acos(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The greater; of a number and NaN, the number.
    fn max(self, other: Self) -> Self;
    /// The smaller; of a number and NaN, the number.
    fn min(self, other: Self) -> Self;
    /// Whether less; false for NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// Whether less or equal; false for NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `a` where the mask is true, `b` elsewhere (both are computed, as by WGSL's `select`, whose order is (b, a, mask)).
    fn choose(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// This number to a power.
    fn powf(self, power: Self) -> Self;
    /// self * factor + term, by one rounding where that is one instruction.
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }
    /// Held in `low..=high`; NaN gives `low`.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

/// A single real number, `f32` or `f64`: one that can be compared, printed and widened.
pub trait Scalar: Real<Mask = bool> + PartialOrd + Default + Display {
    /// The same number, exactly.
    fn to_f64(self) -> f64;
}

/// A method of the standard library where there is one, else a function of `libm`.
#[cfg(feature = "std")]
macro_rules! elementary {
    ($x:ident.$method:ident($($arg:ident),*), $function:ident($($all:ident),*)) => {
        Self::$method($x $(, $arg)*)
    };
}
#[cfg(not(feature = "std"))]
macro_rules! elementary {
    ($x:ident.$method:ident($($arg:ident),*), $function:ident($($all:ident),*)) => {
        libm::$function($($all),*)
    };
}

macro_rules! real {
    ($t:ident, $sqrt:ident, $exp2:ident, $log2:ident, $acos:ident, $sincos:ident, $pow:ident) => {
        impl Real for $t {
            type Mask = bool;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                elementary!(self.sqrt(), $sqrt(self))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline]
            fn exp2(self) -> Self {
                elementary!(self.exp2(), $exp2(self))
            }
            #[inline]
            fn log2(self) -> Self {
                elementary!(self.log2(), $log2(self))
            }
            #[inline]
            fn acos(self) -> Self {
                elementary!(self.acos(), $acos(self))
            }
            #[inline]
            fn powf(self, power: Self) -> Self {
                elementary!(self.powf(power), $pow(self, power))
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                elementary!(self.sin_cos(), $sincos(self))
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn choose(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $t::max(self, other)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $t::min(self, other)
            }
        }

        impl Scalar for $t {
            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
        }
    };
}

real!(f32, sqrtf, exp2f, log2f, acosf, sincosf, powf);
real!(f64, sqrt, exp2, log2, acos, sincos, pow);
