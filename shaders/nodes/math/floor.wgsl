//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Floor
///
/// The greatest whole number that is not above x, component by component.
/// @node math/floor   @also round down
/// - x: value [0]
/// - return: the whole number
fn node_math_floor(x: T) -> T {
    return floor(x);
}
