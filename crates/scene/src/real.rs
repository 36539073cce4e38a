//! What the twins need beside the operators of [`Real`]: small functions named as in WGSL.

use halfvector_maps::Real;

/// The nearest number of this type.
pub(crate) fn real<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

/// The smaller of two.
pub(crate) fn min<R: Real>(a: R, b: R) -> R {
    if b < a { b } else { a }
}

/// The larger of two.
pub(crate) fn max<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}

/// At least `low` and at most `high`.
pub(crate) fn clamp<R: Real>(x: R, low: R, high: R) -> R {
    min(max(x, low), high)
}

/// Scalar product.
pub(crate) fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
