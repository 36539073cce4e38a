//! T = vec2f | vec3f | vec4f
alias T = vec3f;

/// Dot Product
///
/// The sum of the products of the components; for unit vectors the cosine between them.
/// @node vector/dot   @also inner product, scalar product
/// - a: first vector [0]
/// - b: second vector [0]
/// - return: a . b
fn node_vector_dot(a: T, b: T) -> f32 {
    return dot(a, b);
}
