//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Arc Cosine
///
/// The angle whose cosine is x, component by component. x is held in -1..1.
/// @node math/acos   @also arccosine, inverse cosine
/// - x: cosine [1; -1..1]
/// - return: the angle [rad], 0 to pi
fn node_math_acos(x: T) -> T {
    return acos(clamp(x, T(-1.0), T(1.0)));
}
