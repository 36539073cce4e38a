//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Square Root
///
/// sqrt(x), component by component; 0 for a negative x.
/// @node math/sqrt   @also root
/// - x: value [1; 0..1]
/// - return: the root
fn node_math_sqrt(x: T) -> T {
    return sqrt(max(x, T(0.0)));
}
