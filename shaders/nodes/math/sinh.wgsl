//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Hyperbolic Sine
///
/// (e^x - e^-x) / 2, component by component. x is held in -80..80, where it stays in f32.
/// @node math/sinh   @also hyperbolic
/// - x: value [0; -5..5]
/// - return: the hyperbolic sine
fn node_math_sinh(x: T) -> T {
    return sinh(clamp(x, T(-80.0), T(80.0)));
}
