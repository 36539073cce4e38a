//! Three-component vectors as plain arrays: the few operations that WGSL has built in and Rust has not.

use crate::Real;

/// Dot product.
#[inline]
pub fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

/// Cross product.
#[inline]
pub fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Sum.
#[inline]
pub fn add<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Product with a number.
#[inline]
pub fn scale<R: Real>(v: [R; 3], s: R) -> [R; 3] {
    v.map(|x| x * s)
}

/// Product component by component.
#[inline]
pub fn mul<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}
