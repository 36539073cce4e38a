/// The outputs of the node textures/triplanar.
struct TriplanarOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// coverage; 1 for an image without it
    alpha: f32,
}

/// Where a triplanar projection reads along each axis, and how much each counts.
struct TriplanarMapping {
    /// coordinates on the plane across x
    uv_x: vec2f,
    /// coordinates on the plane across y
    uv_y: vec2f,
    /// coordinates on the plane across z
    uv_z: vec2f,
    /// of each plane; their sum is 1
    weights: vec3f,
}

/// The three projections of a point, unmirrored as seen from outside, with up on walls and +X to the right on floors.
/// The weights are |n|^sharpness over their sum. Geiss 2007, "Generating Complex Procedural Terrains Using the GPU",
/// GPU Gems 3. A zero normal counts as +Y.
fn triplanar_mapping(position: vec3f, normal: vec3f, scale: f32, sharpness: f32) -> TriplanarMapping {
    let n = normalize_or(normal, vec3f(0.0, 1.0, 0.0));
    let side = select(vec3f(-1.0), vec3f(1.0), n >= vec3f(0.0));
    let p = position * scale;
    // The greatest component of n is at least 0.57, and 0.57^64 = 2e-16: the sum is never 0.
    let w = pow(max(abs(n), vec3f(1e-4)), vec3f(clamp(sharpness, 0.0, 64.0)));
    return TriplanarMapping(
        vec2f(-side.x * p.z, -p.y),
        vec2f(p.x, side.y * p.z),
        vec2f(side.z * p.x, -p.y),
        w / (w.x + w.y + w.z),
    );
}

/// Triplanar Image
///
/// Projects a picture along three axes and blends by the normal, so that no texture coordinates are needed:
/// weights |n|^sharpness over their sum. Geiss 2007, "Generating Complex Procedural Terrains Using the GPU", GPU Gems 3.
/// Three reads.
/// @node textures/triplanar   @also box mapping, projection, terrain, rock
/// - image: the picture [image srgb]
/// - position: the point [context world_position]
/// - normal: which way the surface looks, in the space of the position [context world_normal]
/// - scale: repeats per metre [1; 0..10; 1/m]
/// - sharpness: how quickly one picture takes over; held in 0..64 [4; 1..16]
/// @vertex node_textures_triplanar_vertex
fn node_textures_triplanar(image: texture_2d<f32>, image_sampler: sampler, position: vec3f, normal: vec3f, scale: f32, sharpness: f32) -> TriplanarOutputs {
    let map = triplanar_mapping(position, normal, scale, sharpness);
    let x = textureSample(image, image_sampler, map.uv_x);
    let y = textureSample(image, image_sampler, map.uv_y);
    let z = textureSample(image, image_sampler, map.uv_z);
    let texel = x * map.weights.x + y * map.weights.y + z * map.weights.z;
    return TriplanarOutputs(texel.rgb, texel.a);
}

/// The triplanar image read at its finest level: the vertex stage has no derivatives to choose another one by.
fn node_textures_triplanar_vertex(image: texture_2d<f32>, image_sampler: sampler, position: vec3f, normal: vec3f, scale: f32, sharpness: f32) -> TriplanarOutputs {
    let map = triplanar_mapping(position, normal, scale, sharpness);
    let x = textureSampleLevel(image, image_sampler, map.uv_x, 0.0);
    let y = textureSampleLevel(image, image_sampler, map.uv_y, 0.0);
    let z = textureSampleLevel(image, image_sampler, map.uv_z, 0.0);
    let texel = x * map.weights.x + y * map.weights.y + z * map.weights.z;
    return TriplanarOutputs(texel.rgb, texel.a);
}
