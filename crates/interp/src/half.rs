//! f16 as the scalar of a run: the same program as in f32 and f64, every result rounded to f16. It does not read WGSL's type
//! `f16`: what is f16 here is the shader's f32, as on targets that compute in half precision.

use half::f16;

use crate::real::Float;
use crate::real::sealed::Arithmetic;

/// A number of IEEE 754's binary16: 11 bits, 2^-24 to 65504. Sums, products, quotients and roots are rounded once, from f32,
/// which is wide enough not to matter: 24 >= 2 * 11 + 2 bits (Figueroa 1995, "When is double rounding innocuous?").
/// Elementary functions are f32's, rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Half(f32);

impl Half {
    #[inline(always)]
    fn rounded(x: f32) -> Half {
        Half(f16::from_f32(x).to_f32())
    }
}

impl Float for Half {
    #[inline(always)]
    fn from_f64(x: f64) -> Half {
        Half(f16::from_f64(x).to_f32())
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self.0
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),* $(,)?) => {
        $(impl std::ops::$operator for Half {
            type Output = Half;
            #[inline(always)]
            fn $method(self, other: Half) -> Half {
                Half::rounded(std::ops::$operator::$method(self.0, other.0))
            }
        })*
    };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl std::ops::Neg for Half {
    type Output = Half;
    #[inline(always)]
    fn neg(self) -> Half {
        Half(-self.0)
    }
}

/// Forwards to f32's method and rounds.
macro_rules! through_f32 {
    ($($name:ident),* $(,)?) => {
        $(#[inline(always)]
        fn $name(self) -> Half {
            Half::rounded(<f32 as Arithmetic>::$name(self.0))
        })*
    };
}

impl Arithmetic for Half {
    const ZERO: Half = Half(0.0);
    const ONE: Half = Half(1.0);
    const HALF: Half = Half(0.5);
    const WILD: Half = Half(65504.0);

    through_f32!(
        abs,
        floor,
        ceil,
        trunc,
        round_even,
        sqrt,
        exp,
        exp2,
        ln,
        log2,
        sin,
        cos,
        tan,
        sin_wild,
        cos_wild,
        tan_wild,
        asin,
        acos,
        atan,
        sinh,
        cosh,
        tanh,
        asinh,
        acosh,
        atanh,
        significand
    );

    #[inline(always)]
    fn number(x: f64) -> Half {
        Half::from_f64(x)
    }
    #[inline(always)]
    fn least(self, other: Half) -> Half {
        Half(self.0.min(other.0))
    }
    #[inline(always)]
    fn most(self, other: Half) -> Half {
        Half(self.0.max(other.0))
    }
    #[inline(always)]
    fn pow(self, y: Half) -> Half {
        Half::rounded(self.0.pow(y.0))
    }
    #[inline(always)]
    fn atan2(self, x: Half) -> Half {
        Half::rounded(Arithmetic::atan2(self.0, x.0))
    }
    #[inline(always)]
    fn exponent(self) -> i32 {
        self.0.exponent()
    }
    #[inline(always)]
    fn scale(self, e: i32) -> Half {
        // From f64: one rounding.
        Half::from_f64(f64::from(self.0).scale(e.clamp(-100, 100)))
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.0.is_nan()
    }
    #[inline(always)]
    fn is_infinite(self) -> bool {
        self.0.is_infinite()
    }
}
