/// The outputs of the node vector/project.
struct ProjectOutputs {
    /// the part along the other vector
    along: vec3f,
    /// the rest, at right angles to it
    across: vec3f,
    /// signed length of the part along
    distance_along: f32,
}

/// Project
///
/// A vector split into a part along another one and a part at right angles to it. Nothing lies along a vector of length 0.
/// @node vector/project   @also component, along, reject
/// - v: vector [1,0,0]
/// - onto: the other vector, of any length [0,1,0]
fn node_vector_project(v: vec3f, onto: vec3f) -> ProjectOutputs {
    let dir = normalize_or(onto, vec3f(0.0));
    let along = dot(v, dir);
    return ProjectOutputs(along * dir, v - along * dir, along);
}
