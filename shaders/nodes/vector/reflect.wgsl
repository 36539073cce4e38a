/// Reflect
///
/// A direction thrown back by a mirror: d - 2 (n . d) n. It runs onto the surface, as d does.
/// @node vector/reflect   @also mirror, bounce
/// - incident: direction towards the surface [0,0,-1]
/// - normal: unit normal of the mirror [0,0,1]
/// - return: direction away from the surface
fn node_vector_reflect(incident: vec3f, normal: vec3f) -> vec3f {
    return reflect(incident, normal);
}
