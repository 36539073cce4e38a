//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Inverse Hyperbolic Cosine
///
/// ln(x + sqrt(x^2 - 1)), component by component. x below 1 counts as 1.
/// @node math/acosh   @also area, hyperbolic
/// - x: value [1; 1..10]
/// - return: the number >= 0 whose hyperbolic cosine is x
fn node_math_acosh(x: T) -> T {
    let held = max(x, T(1.0));
    return log(held + sqrt((held - T(1.0)) * (held + T(1.0))));
}
