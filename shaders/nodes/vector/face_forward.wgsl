/// Face Forward
///
/// A direction, or its opposite, whichever looks to the same side as another one: turns normals of back sides to the viewer.
/// @node vector/face_forward   @also flip, two sided, backface
/// - v: the direction [context world_normal]
/// - toward: to which side [context view_dir]
/// - return: v or -v
fn node_vector_face_forward(v: vec3f, toward: vec3f) -> vec3f {
    return select(-v, v, dot(v, toward) >= 0.0);
}
