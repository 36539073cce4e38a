//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Hyperbolic Tangent
///
/// sinh(x) / cosh(x), component by component: a soft limit at -1 and 1. From 15 on it is 1 in f32; x is held there, for
/// some devices divide infinity by infinity.
/// @node math/tanh   @also hyperbolic, sigmoid, soft clamp
/// - x: value [0; -5..5]
/// - return: -1 to 1
fn node_math_tanh(x: T) -> T {
    return tanh(clamp(x, T(-15.0), T(15.0)));
}
