//! The two number types that the mathematics of this crate is written for, and vectors of three of them.
//!
//! Not a general numeric tower: only what the twins of the WGSL functions need.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `f32` or `f64`. Sealed: the limits inside the functions are chosen for these two.
pub trait Real:
    Copy
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + sealed::Sealed
{
    /// The nearest value of this type.
    fn from_f64(x: f64) -> Self;
    /// The same value, exactly.
    fn to_f64(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// Logarithm to base 2.
    fn log2(self) -> Self;
    /// `self` to the power `exponent`.
    fn powf(self, exponent: Self) -> Self;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

macro_rules! real {
    ($type:ty) => {
        impl Real for $type {
            fn from_f64(x: f64) -> Self {
                x as $type
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            fn abs(self) -> Self {
                self.abs()
            }
            fn log2(self) -> Self {
                self.log2()
            }
            fn powf(self, exponent: Self) -> Self {
                self.powf(exponent)
            }
        }
    };
}
real!(f32);
real!(f64);

/// A constant of the formula at hand.
#[inline]
pub(crate) fn real<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

#[inline]
pub(crate) fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn add<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
pub(crate) fn scale<R: Real>(a: [R; 3], s: R) -> [R; 3] {
    a.map(|x| x * s)
}

/// +Z, the direction of a texel that says nothing and of a normal that is not there.
#[inline]
pub(crate) fn plus_z<R: Real>() -> [R; 3] {
    [real(0.0), real(0.0), real(1.0)]
}

/// v / |v|, or `fallback` where v has no direction: zero, NaN, infinite, or of a length outside 3e-19 .. 3e18, the range
/// of lengths whose square is a normal `f32` (the same for `f64`, so that both take the same branch).
#[inline]
pub(crate) fn normalize_or<R: Real>(v: [R; 3], fallback: [R; 3]) -> [R; 3] {
    let length_squared = dot(v, v);
    if length_squared > real(1e-37) && length_squared < real(1e37) {
        scale(v, real::<R>(1.0) / length_squared.sqrt())
    } else {
        fallback
    }
}
