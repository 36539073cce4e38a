//! T = vec2f | vec3f | vec4f
alias T = vec3f;

/// Normalize
///
/// v / |v|: the same direction with length 1. Zero where v has no direction: for lengths below 1e-15.
/// @node vector/normalize   @also unit vector, direction
/// - v: vector [0]
/// - return: a unit vector, or zero
fn node_vector_normalize(v: T) -> T {
    let length2 = dot(v, v);
    return select(T(0.0), v * inverseSqrt(length2), length2 > DIVISOR_FLOOR);
}
