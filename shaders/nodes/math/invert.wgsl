//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Invert
///
/// 1 - x, component by component: a mask or colour turned into its complement.
/// @node math/invert   @also one minus, complement, negative
/// - x: value [0; 0..1]
/// - return: the complement
fn node_math_invert(x: T) -> T {
    return T(1.0) - x;
}
