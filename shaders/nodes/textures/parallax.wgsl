/// Parallax
///
/// Texture coordinates moved to where the line of sight meets the relief of a height map, which lies below the mesh: white
/// is the mesh, black is `depth` under it. Up to 38 reads. Silhouettes stay those of the mesh; the surface's height
/// socket moves the mesh itself. Read the other maps by "Image at Moved Coordinates", with the old coordinates as
/// the smooth ones. Tatarchuk 2006, "Practical Parallax Occlusion Mapping".
/// @node textures/parallax   @also pom, relief, depth, height, displacement
/// - image: the height map; its red is read [image linear]
/// - uv: where the mesh reads; (0,0) is the top left [context uv0]
/// - depth: between white and black, in units of the picture's edge [0.05; 0..0.2]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: texture coordinates
fn node_textures_parallax(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, depth: f32, view_dir: vec3f, normal: vec3f, tangent: vec4f) -> vec2f {
    let offset = parallax_offset(view_dir, normal, tangent, depth);
    return parallax_occlusion(image, image_sampler, uv, dpdx(uv), dpdy(uv), offset);
}
