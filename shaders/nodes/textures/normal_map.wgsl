/// Normal Map
///
/// The surface's normal bent by a colour of a normal map (read it as linear): t = 2 c - 1 in the tangent frame.
/// Maps are +Y (OpenGL); a -Y (DirectX) map wants the switch. The scene's `normal` method may choose a tangent frame
/// from the pixel's derivatives, for meshes without tangents, or one of the report's rotations instead.
/// @node textures/normal_map   @also bump, normals, tangent space
/// - color: the map's colour; (0.5, 0.5, 1) is flat [0.5,0.5,1]
/// - strength: factor of the tilt [1; 0..2]
/// - flip_y: whether the map is -Y (DirectX) [false]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - uv: where the map is read; of `tbn_derivative` alone [context uv0]
/// - position: the point; of `tbn_derivative` alone [context world_position]
/// - return: unit normal in world space
/// @method normal=tbn node_textures_normal_map_tbn
/// @method normal=tbn_derivative node_textures_normal_map_tbn_derivative
/// @method normal=rotation_report node_textures_normal_map_rotation_report
/// @method normal=rotation_fixed node_textures_normal_map_rotation_fixed
fn node_textures_normal_map(color: vec3f, strength: f32, flip_y: bool, normal: vec3f, tangent: vec4f, uv: vec2f, position: vec3f) -> vec3f {
    return node_textures_normal_map_tbn(color, strength, flip_y, normal, tangent);
}

/// The normal map by the tangent frame of the mesh.
fn node_textures_normal_map_tbn(color: vec3f, strength: f32, flip_y: bool, normal: vec3f, tangent: vec4f) -> vec3f {
    return bent_normal(tilt_from_texel(color, strength, flip_y), normal, normal, tangent);
}

/// The normal map by a tangent frame from derivatives: it needs no tangent.
fn node_textures_normal_map_tbn_derivative(color: vec3f, strength: f32, flip_y: bool, normal: vec3f, uv: vec2f, position: vec3f) -> vec3f {
    let n_tangent = normal_from_texel(color, strength, flip_y);
    return normal_tbn_derivative(n_tangent, dpdx(position), dpdy(position), normal, dpdx(uv), dpdy(uv));
}

/// The normal map by three rotations as the report gives them: it needs no tangent.
fn node_textures_normal_map_rotation_report(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_report(normal_from_texel(color, strength, flip_y), normal);
}

/// The normal map by two rotations with the report's signs mended: it needs no tangent.
fn node_textures_normal_map_rotation_fixed(color: vec3f, strength: f32, flip_y: bool, normal: vec3f) -> vec3f {
    return normal_rotation_fixed(normal_from_texel(color, strength, flip_y), normal);
}
