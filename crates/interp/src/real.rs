//! The two scalars that a shader's floats run in: f32, as a device computes, and f64, the same program with (nearly)
//! exact arithmetic. Elementary functions of f32 are computed through f64 polynomials without branches, so that loops
//! over them become SIMD code; their error is within one unit in the last place of f32. Those of f64 are the standard library's.

use std::fmt::Debug;

use crate::elementary;

/// A floating-point number that the interpreter computes in: `f32`, `f64` or [`Half`](crate::Half).
pub trait Float: Copy + Debug + Default + PartialOrd + Send + Sync + 'static + sealed::Arithmetic {
    /// Rounds to f32 where this is f64's narrower brother.
    fn from_f64(x: f64) -> Self;
    /// Exact.
    fn to_f64(self) -> f64;
    /// Rounds to f32; exact for f32.
    fn to_f32(self) -> f32;
}

/// What the kernels need; the trait is sealed, for the semantics of WGSL are stated for these types alone.
pub(crate) mod sealed {
    use std::ops::{Add, Div, Mul, Neg, Sub};

    /// Operations of one scalar.
    pub trait Arithmetic:
        Copy
        + PartialOrd
        + Add<Output = Self>
        + Sub<Output = Self>
        + Mul<Output = Self>
        + Div<Output = Self>
        + Neg<Output = Self>
    {
        const ZERO: Self;
        const ONE: Self;
        const HALF: Self;
        /// Size of an argument up to which `sin`, `cos` and `tan` are right without a slower reduction.
        const WILD: Self;
        fn number(x: f64) -> Self;
        fn abs(self) -> Self;
        fn least(self, other: Self) -> Self;
        fn most(self, other: Self) -> Self;
        fn floor(self) -> Self;
        fn ceil(self) -> Self;
        fn trunc(self) -> Self;
        fn round_even(self) -> Self;
        fn sqrt(self) -> Self;
        fn exp(self) -> Self;
        fn exp2(self) -> Self;
        fn ln(self) -> Self;
        fn log2(self) -> Self;
        fn pow(self, y: Self) -> Self;
        fn sin(self) -> Self;
        fn cos(self) -> Self;
        fn tan(self) -> Self;
        fn sin_wild(self) -> Self;
        fn cos_wild(self) -> Self;
        fn tan_wild(self) -> Self;
        fn asin(self) -> Self;
        fn acos(self) -> Self;
        fn atan(self) -> Self;
        fn atan2(self, x: Self) -> Self;
        fn sinh(self) -> Self;
        fn cosh(self) -> Self;
        fn tanh(self) -> Self;
        fn asinh(self) -> Self;
        fn acosh(self) -> Self;
        fn atanh(self) -> Self;
        /// Significand in [0.5, 1) with the sign, or the number itself where it is 0 or not finite.
        fn significand(self) -> Self;
        /// The exponent that belongs to `significand`, 0 where that is the number itself.
        fn exponent(self) -> i32;
        /// Self times two to the power of `e`.
        fn scale(self, e: i32) -> Self;
        fn is_nan(self) -> bool;
        fn is_infinite(self) -> bool;
    }
}

impl Float for f32 {
    #[inline(always)]
    fn from_f64(x: f64) -> f32 {
        x as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self
    }
}

impl Float for f64 {
    #[inline(always)]
    fn from_f64(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self as f32
    }
}

/// Forwards to the standard library's method of the same type.
macro_rules! own {
    ($t:ty: $($name:ident = $method:ident),* $(,)?) => {
        $(#[inline(always)]
        fn $name(self) -> $t {
            <$t>::$method(self)
        })*
    };
}

/// Forwards to a function of f64 and rounds.
macro_rules! through_f64 {
    ($($name:ident = $function:path),* $(,)?) => {
        $(#[inline(always)]
        fn $name(self) -> f32 {
            $function(f64::from(self)) as f32
        })*
    };
}

impl sealed::Arithmetic for f32 {
    const ZERO: f32 = 0.0;
    const ONE: f32 = 1.0;
    const HALF: f32 = 0.5;
    const WILD: f32 = 1e9;

    own!(f32: abs = abs, floor = floor, ceil = ceil, trunc = trunc, round_even = round_ties_even, sqrt = sqrt,
        sin_wild = sin, cos_wild = cos, tan_wild = tan);
    through_f64!(
        sinh = f64::sinh,
        cosh = f64::cosh,
        tanh = f64::tanh,
        asinh = f64::asinh,
        acosh = f64::acosh,
        atanh = f64::atanh,
        exp = elementary::exp,
        exp2 = elementary::exp2,
        ln = elementary::ln,
        log2 = elementary::log2,
        sin = elementary::sin,
        cos = elementary::cos,
        tan = elementary::tan,
        asin = elementary::asin,
        acos = elementary::acos,
        atan = elementary::atan
    );

    #[inline(always)]
    fn number(x: f64) -> f32 {
        x as f32
    }
    #[inline(always)]
    fn least(self, other: f32) -> f32 {
        self.min(other)
    }
    #[inline(always)]
    fn most(self, other: f32) -> f32 {
        self.max(other)
    }
    #[inline(always)]
    fn pow(self, y: f32) -> f32 {
        elementary::pow(f64::from(self), f64::from(y)) as f32
    }
    #[inline(always)]
    fn atan2(self, x: f32) -> f32 {
        elementary::atan2(f64::from(self), f64::from(x)) as f32
    }
    #[inline(always)]
    fn significand(self) -> f32 {
        f64::from(self).significand() as f32
    }
    #[inline(always)]
    fn exponent(self) -> i32 {
        f64::from(self).exponent()
    }
    #[inline(always)]
    fn scale(self, e: i32) -> f32 {
        // Exact in f64: the one rounding is the last, so that results below the normal range are rounded once.
        f64::from(self).scale(e.clamp(-400, 400)) as f32
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        f32::is_nan(self)
    }
    #[inline(always)]
    fn is_infinite(self) -> bool {
        f32::is_infinite(self)
    }
}

impl sealed::Arithmetic for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    const HALF: f64 = 0.5;
    const WILD: f64 = f64::INFINITY;

    own!(f64: abs = abs, floor = floor, ceil = ceil, trunc = trunc, round_even = round_ties_even, sqrt = sqrt,
        exp = exp, exp2 = exp2, ln = ln, log2 = log2, sin = sin, cos = cos, tan = tan, sin_wild = sin, cos_wild = cos,
        tan_wild = tan, asin = asin, acos = acos, atan = atan, sinh = sinh, cosh = cosh, tanh = tanh, asinh = asinh,
        acosh = acosh, atanh = atanh);

    #[inline(always)]
    fn number(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn least(self, other: f64) -> f64 {
        self.min(other)
    }
    #[inline(always)]
    fn most(self, other: f64) -> f64 {
        self.max(other)
    }
    #[inline(always)]
    fn pow(self, y: f64) -> f64 {
        if self < 0.0 { f64::NAN } else { self.powf(y) }
    }
    #[inline(always)]
    fn atan2(self, x: f64) -> f64 {
        f64::atan2(self, x)
    }
    #[inline(always)]
    fn significand(self) -> f64 {
        if self == 0.0 || !self.is_finite() {
            return self;
        }
        // Numbers below the normal range are brought into it first.
        let normal = if self.abs() < f64::MIN_POSITIVE { self * 18_014_398_509_481_984.0 } else { self };
        f64::from_bits(normal.to_bits() & !(0x7ff << 52) | (0x3fe << 52))
    }
    #[inline(always)]
    fn exponent(self) -> i32 {
        if self == 0.0 || !self.is_finite() {
            return 0;
        }
        let (normal, shift) =
            if self.abs() < f64::MIN_POSITIVE { (self * 18_014_398_509_481_984.0, 54) } else { (self, 0) };
        ((normal.to_bits() >> 52) & 0x7ff) as i32 - 1022 - shift
    }
    #[inline(always)]
    fn scale(self, e: i32) -> f64 {
        // Three factors of at most 2^+-700 reach from one end of the range to the other; each is exact.
        let e = e.clamp(-2100, 2100);
        let third = e / 3;
        let power = |n: i32| f64::from_bits(((n + 1023) as u64) << 52);
        self * power(third) * power(third) * power(e - 2 * third)
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        f64::is_nan(self)
    }
    #[inline(always)]
    fn is_infinite(self) -> bool {
        f64::is_infinite(self)
    }
}
