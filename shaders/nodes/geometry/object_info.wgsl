/// The outputs of the node geometry/object_info.
struct ObjectInfoOutputs {
    /// where the object's origin is in world space [m]
    location: vec3f,
    /// a random value of the object, 0 to 1
    random: f32,
    /// three random values of the object, 0 to 1
    color: vec3f,
}

/// Object Info
///
/// What tells objects with one material apart: where each stands, and random numbers of it, for bricks, leaves, books that shall not look alike.
/// The numbers are made of the place in millimetres: an object that moves gets others, and objects in one place get the same.
/// Wood and other patterns in object space are moved from object to object by adding `color` to their position.
/// @node geometry/object_info   @also random per object, instance, variation, location
/// - seed: another one, other numbers [0; 0..100]
fn node_geometry_object_info(seed: i32, world_from_object: mat4x4f) -> ObjectInfoOutputs {
    let location = world_from_object[3].xyz;
    // Whole numbers, within 2^31 by far.
    let place = vec3i(round(clamp(location, vec3f(-1e6), vec3f(1e6)) * 1000.0));
    let color = unit_floats(lattice_hash(place, seed));
    return ObjectInfoOutputs(location, color.x, color);
}
