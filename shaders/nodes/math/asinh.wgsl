//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Inverse Hyperbolic Sine
///
/// ln(x + sqrt(x^2 + 1)), component by component: a logarithm that goes through 0 to negative numbers. Computed from |x|, which
/// keeps its digits.
/// @node math/asinh   @also area, hyperbolic, signed logarithm
/// - x: value [0; -10..10]
/// - return: the number whose hyperbolic sine is x
fn node_math_asinh(x: T) -> T {
    let size = abs(x);
    let root = sqrt(size * size + T(1.0));
    // ln(1 + y), y = size + root - 1 written without cancellation: exact enough below 1e-3 as y - y^2 / 2.
    let y = size + size * size / (root + T(1.0));
    return sign(x) * select(log(T(1.0) + y), y - 0.5 * y * y, y < T(1e-3));
}
