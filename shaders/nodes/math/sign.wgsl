//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Sign
///
/// -1, 0 or 1, component by component: the sign of x.
/// @node math/sign   @also signum
/// - x: value [0]
/// - return: its sign
fn node_math_sign(x: T) -> T {
    return sign(x);
}
