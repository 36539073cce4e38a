/// Normal Map
///
/// The surface's normal bent by a colour of a normal map (read it as linear): t = 2 c - 1 in the tangent frame.
/// Maps are +Y (OpenGL); a -Y (DirectX) map wants the switch. The scene's `normal` method may choose one of the report's
/// rotations instead of the tangent frame.
/// @node textures/normal_map   @also bump, normals, tangent space
/// - color: the map's colour; (0.5, 0.5, 1) is flat [0.5,0.5,1]
/// - strength: factor of the tilt [1; 0..2]
/// - flip_y: whether the map is -Y (DirectX) [false]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: unit normal in world space
/// @method normal=rotation_report node_textures_normal_map_rotation_report
/// @method normal=rotation_fixed node_textures_normal_map_rotation_fixed
fn node_textures_normal_map(color: vec3f, strength: f32, flip_y: bool, normal: vec3f, tangent: vec4f) -> vec3f {
    return normal_tbn(normal_from_texel(color, strength, flip_y), normal, tangent);
}

/// The normal map by three rotations as the report gives them: it needs no tangent.
fn node_textures_normal_map_rotation_report(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_report(normal_from_texel(color, strength, flip_y), normal);
}

/// The normal map by two rotations with the report's signs mended: it needs no tangent.
fn node_textures_normal_map_rotation_fixed(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_fixed(normal_from_texel(color, strength, flip_y), normal);
}
