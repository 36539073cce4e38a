//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Inverse Hyperbolic Tangent
///
/// ln((1 + x) / (1 - x)) / 2, component by component. x is held in -0.999999..0.999999, whose value is 7.25.
/// @node math/atanh   @also area, hyperbolic, logit
/// - x: value [0; -1..1]
/// - return: the number whose hyperbolic tangent is x
fn node_math_atanh(x: T) -> T {
    return atanh(clamp(x, T(-0.999999), T(0.999999)));
}
