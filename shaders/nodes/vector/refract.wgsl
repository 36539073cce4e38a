/// Refract
///
/// A direction bent by a surface between two media. Snell's law in vector form: with c = -n . d and
/// k = 1 - eta^2 (1 - c^2),
///   eta d + (eta c - sqrt(k)) n
/// Zero where k < 0: total internal reflection.
/// @node vector/refract   @also bend, snell, glass
/// - incident: unit direction towards the surface [0,0,-1]
/// - normal: unit normal on the side that it comes from [0,0,1]
/// - eta: index of refraction before over after the surface [0.6667; 0.3..3]
/// - return: unit direction behind the surface, or zero
fn node_vector_refract(incident: vec3f, normal: vec3f, eta: f32) -> vec3f {
    let c = -dot(normal, incident);
    let k = 1.0 - eta * eta * (1.0 - c * c);
    return select(vec3f(0.0), eta * incident + (eta * c - sqrt(max(k, 0.0))) * normal, k >= 0.0);
}
