/// The components of a vector of two.
struct Separate2Outputs {
    /// first component
    x: f32,
    /// second component
    y: f32,
}

/// Separate 2
///
/// The components of a vector of two.
/// @node vector/separate2   @also split, break vec2, xy
/// - v: vector [0,0]
fn node_vector_separate2(v: vec2f) -> Separate2Outputs {
    return Separate2Outputs(v.x, v.y);
}

/// The components of a vector of three.
struct Separate3Outputs {
    /// first component, or red
    x: f32,
    /// second component, or green
    y: f32,
    /// third component, or blue
    z: f32,
}

/// Separate 3
///
/// The components of a vector of three, or the channels of a colour.
/// @node vector/separate3   @also split, break vec3, xyz, rgb, separate color
/// - v: vector [0,0,0]
fn node_vector_separate3(v: vec3f) -> Separate3Outputs {
    return Separate3Outputs(v.x, v.y, v.z);
}

/// The components of a vector of four.
struct Separate4Outputs {
    /// first component
    x: f32,
    /// second component
    y: f32,
    /// third component
    z: f32,
    /// fourth component
    w: f32,
}

/// Separate 4
///
/// The components of a vector of four.
/// @node vector/separate4   @also split, break vec4, xyzw, rgba
/// - v: vector [0,0,0,0]
fn node_vector_separate4(v: vec4f) -> Separate4Outputs {
    return Separate4Outputs(v.x, v.y, v.z, v.w);
}
