/// Combine 2
///
/// A vector of two numbers.
/// @node vector/combine2   @also make vec2, xy
/// - x: first component [0]
/// - y: second component [0]
/// - return: (x, y)
fn node_vector_combine2(x: f32, y: f32) -> vec2f {
    return vec2f(x, y);
}

/// Combine 3
///
/// A vector, or a colour, of three numbers.
/// @node vector/combine3   @also make vec3, xyz, rgb, combine color
/// - x: first component, or red [0]
/// - y: second component, or green [0]
/// - z: third component, or blue [0]
/// - return: (x, y, z)
fn node_vector_combine3(x: f32, y: f32, z: f32) -> vec3f {
    return vec3f(x, y, z);
}

/// Combine 4
///
/// A vector of four numbers.
/// @node vector/combine4   @also make vec4, xyzw, rgba
/// - x: first component [0]
/// - y: second component [0]
/// - z: third component [0]
/// - w: fourth component [0]
/// - return: (x, y, z, w)
fn node_vector_combine4(x: f32, y: f32, z: f32, w: f32) -> vec4f {
    return vec4f(x, y, z, w);
}
