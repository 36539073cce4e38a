/// Colour with Alpha
///
/// A colour and its coverage as one vector of four.
/// @node vector/combine_color_alpha   @also rgba, pack, append
/// - color: red, green and blue [0.5,0.5,0.5; 0..1; color]
/// - alpha: coverage [1; 0..1]
/// - return: (r, g, b, alpha)
fn node_vector_combine_color_alpha(color: vec3f, alpha: f32) -> vec4f {
    return vec4f(color, alpha);
}

/// The outputs of the node vector/separate_color_alpha.
struct ColorAlphaOutputs {
    /// the first three components
    color: vec3f,
    /// the fourth
    alpha: f32,
}

/// Separate Alpha
///
/// A vector of four as a colour and its coverage.
/// @node vector/separate_color_alpha   @also rgba, unpack, split
/// - v: vector [0,0,0,1]
fn node_vector_separate_color_alpha(v: vec4f) -> ColorAlphaOutputs {
    return ColorAlphaOutputs(v.rgb, v.a);
}

/// Extend
///
/// A vector of two with a third component.
/// @node vector/extend   @also append, vec2 to vec3, depth
/// - xy: first and second component [0,0]
/// - z: third component [0]
/// - return: (x, y, z)
fn node_vector_extend(xy: vec2f, z: f32) -> vec3f {
    return vec3f(xy, z);
}

/// The outputs of the node vector/planes.
struct PlanesOutputs {
    /// first and second component
    xy: vec2f,
    /// first and third component: the ground
    xz: vec2f,
    /// third and second component
    zy: vec2f,
}

/// Planes
///
/// A point seen along each axis: coordinates for patterns on floors and walls.
/// @node vector/planes   @also flatten, vec3 to vec2, project, top down
/// - v: vector [context object_position]
fn node_vector_planes(v: vec3f) -> PlanesOutputs {
    return PlanesOutputs(v.xy, v.xz, v.zy);
}
