//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Maximum
///
/// The greater of a and b, component by component.
/// @node math/max   @also maximum, greater, lighten
/// - a: first value [0]
/// - b: second value [0]
/// - return: the greater one
fn node_math_max(a: T, b: T) -> T {
    return max(a, b);
}
