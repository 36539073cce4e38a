/// Triplanar Normal
///
/// Projects a normal map along three axes and blends by the normal, so that neither texture coordinates nor tangents are needed. Each
/// projection's slopes are added to the surface's own normal ("whiteout"). Golus 2017, "Normal Mapping for a Triplanar Shader". Maps are +Y.
/// Three reads.
/// @node textures/triplanar_normal   @also box mapping, normal map, terrain, rock
/// - image: the normal map [image linear]
/// - position: the point [context world_position]
/// - normal: which way the surface looks, in the space of the position [context world_normal]
/// - scale: repeats per metre [1; 0..10; 1/m]
/// - sharpness: how quickly one picture takes over; held in 0..64 [4; 1..16]
/// - strength: factor of the slopes [1; 0..2]
/// - return: unit normal, in the space of the position
fn node_textures_triplanar_normal(image: texture_2d<f32>, image_sampler: sampler, position: vec3f, normal: vec3f, scale: f32, sharpness: f32, strength: f32) -> vec3f {
    let map = triplanar_mapping(position, normal, scale, sharpness);
    let x = normal_from_texel(textureSample(image, image_sampler, map.uv_x).rgb, strength, false);
    let y = normal_from_texel(textureSample(image, image_sampler, map.uv_y).rgb, strength, false);
    let z = normal_from_texel(textureSample(image, image_sampler, map.uv_z).rgb, strength, false);
    let n = normalize_or(normal, vec3f(0.0, 1.0, 0.0));
    let side = select(vec3f(-1.0), vec3f(1.0), n >= vec3f(0.0));
    // Where u and v of each projection run, see triplanar_mapping: +v falls on walls, and +Y of a map is -v.
    let bent_x = vec3f(n.x * x.z, n.y + x.y, n.z - side.x * x.x);
    let bent_y = vec3f(n.x + y.x, n.y * y.z, n.z - side.y * y.y);
    let bent_z = vec3f(n.x + side.z * z.x, n.y + z.y, n.z * z.z);
    return normalize_or(bent_x * map.weights.x + bent_y * map.weights.y + bent_z * map.weights.z, n);
}
