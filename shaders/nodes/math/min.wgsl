//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Minimum
///
/// The smaller of a and b, component by component.
/// @node math/min   @also minimum, smaller, darken
/// - a: first value [0]
/// - b: second value [0]
/// - return: the smaller one
fn node_math_min(a: T, b: T) -> T {
    return min(a, b);
}
