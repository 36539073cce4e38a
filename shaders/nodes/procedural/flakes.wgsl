/// The outputs of the node procedural/flakes.
struct FlakesOutputs {
    /// unit normal of the flake in world space
    normal: vec3f,
    /// a random value of the flake, 0 to 1
    id: f32,
}

/// Flakes
///
/// Small mirrors at random tilts, one around each random point of space: the flakes of metallic paint, sparkle of snow and sandstone. Wire
/// the normal into the coat's base or the surface. Where flakes are smaller than pixels the normal goes to the surface's: add to the roughness
/// there what is lost. 27 cells are looked into.
/// @node procedural/flakes   @also car paint, metallic, glitter, sparkle, snow
/// - position: the point [context object_position]
/// - normal: unit normal [context world_normal]
/// - scale: flakes per metre [200; 0..2000]
/// - tilt: how far flakes lean, as a slope [0.3; 0..1]
/// - seed: another one, other flakes [0; 0..100]
/// @vertex node_procedural_flakes_vertex
fn node_procedural_flakes(position: vec3f, normal: vec3f, scale: f32, tilt: f32, seed: i32) -> FlakesOutputs {
    let left = left_of_cells(squared_footprint(held3(position * scale)));
    let flake = node_procedural_flakes_vertex(position, normal, scale, tilt * left, seed);
    return FlakesOutputs(flake.normal, mix(0.5, flake.id, left));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_flakes_vertex(position: vec3f, normal: vec3f, scale: f32, tilt: f32, seed: i32) -> FlakesOutputs {
    let p = held3(position * scale);
    let cell = vec3i(floor(p));
    let f = fract(p);
    var least = 8.0;
    var nearest = vec3u(0u);
    for (var z = -1; z <= 1; z++) {
        for (var y = -1; y <= 1; y++) {
            for (var x = -1; x <= 1; x++) {
                let h = lattice_hash(cell + vec3i(x, y, z), seed);
                let d = vec3f(f32(x), f32(y), f32(z)) + unit_floats(h) - f;
                let closer = dot(d, d) < least;
                least = select(least, dot(d, d), closer);
                nearest = select(nearest, h, closer);
            }
        }
    }
    // The words placed the flake; hashed again they tilt it.
    let random = unit_floats(pcg3d(nearest));
    let lean = 2.0 * random - 1.0;
    return FlakesOutputs(normalize_or(normal + tilt * lean, normal), f32(nearest.x & 255u) / 255.0);
}
