//! The number that batches compute with: one `f32` lane of a loop that LLVM widens to the machine's vectors.
//!
//! A batch is a loop over elements; the loop's body is a function over [`Real`], called with [`Lane`]. What would keep the
//! loop from being widened is a call into the C library or a branch, so a `Lane` has elementary functions of its own,
//! made of products, sums and choices. The module does not choose the instruction set: [`crate::batch`] does.

use crate::Real;
use crate::elementary;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// One `f32` among those that are computed side by side.
///
/// `FUSED` says whether `a * b + c` may be one instruction. It must be false where the CPU has none: it would be a call.
/// `WIDE` says that vectors have 16 lanes: a divider takes two turns for one, so that some roots are taken by products.
///
/// Sums, products, quotients, square roots, comparisons, minimum and maximum are those of `f32`. The others are of this
/// crate; their errors were measured against f64 over every 997th `f32` of the domain, fused or not:
///
/// | function | domain | error |
/// |---|---|---|
/// | `exp2` | all; denormal results are rounded twice | <= 2 ulp |
/// | `log2` | all; NaN below 0 | <= 2 ulp |
/// | `powf` | base >= 0 (NaN below), any power | <= 2 ulp |
/// | `sin_cos` | angles within +-8192 | <= 1.2e-7 absolute |
/// | `acos` | -1..1 (NaN outside) | <= 2 ulp |
/// | `sqrt_by_products` where wide | 0, 1e-37..3e38 | <= 2 ulp |
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Lane<const FUSED: bool, const WIDE: bool = false>(pub f32);

impl<const FUSED: bool, const WIDE: bool> Add for Lane<FUSED, WIDE> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<const FUSED: bool, const WIDE: bool> Sub for Lane<FUSED, WIDE> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<const FUSED: bool, const WIDE: bool> Mul for Lane<FUSED, WIDE> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl<const FUSED: bool, const WIDE: bool> Div for Lane<FUSED, WIDE> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<const FUSED: bool, const WIDE: bool> Neg for Lane<FUSED, WIDE> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const FUSED: bool, const WIDE: bool> Real for Lane<FUSED, WIDE> {
    type Mask = bool;
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn of(x: f64) -> Self {
        Self(x as f32)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(Real::sqrt(self.0))
    }
    #[inline(always)]
    fn sqrt_by_products(self) -> Self {
        if WIDE { elementary::sqrt_by_products(self) } else { self.sqrt() }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        elementary::exp2(self)
    }
    #[inline(always)]
    fn log2(self) -> Self {
        elementary::log2(self)
    }
    #[inline(always)]
    fn acos(self) -> Self {
        elementary::acos(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }
    #[inline(always)]
    fn choose(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn powf(self, power: Self) -> Self {
        elementary::powf(self, power)
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        if FUSED { Self(self.0.mul_add(factor.0, term.0)) } else { self * factor + term }
    }
}
