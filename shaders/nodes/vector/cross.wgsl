/// Cross Product
///
/// The vector at right angles to a and b, by the right-hand rule; its length is the area that they span.
/// @node vector/cross   @also outer product, perpendicular
/// - a: first vector [1,0,0]
/// - b: second vector [0,1,0]
/// - return: a x b
fn node_vector_cross(a: vec3f, b: vec3f) -> vec3f {
    return cross(a, b);
}
