/// Bump
///
/// The normal bent by a height that some nodes compute, from how it changes between neighbouring pixels: for heights that are no picture.
/// Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU". Blocks of 2 x 2 pixels share their differences; a height map is
/// finer read by Normal from Height. The fragment stage only.
/// @node textures/bump   @also relief, height, normal, emboss
/// - height: above the surface [0; -0.1..0.1; m]
/// - strength: factor of the height [1; 0..2]
/// - normal: unit normal [context world_normal]
/// - position: the point [context world_position]
/// - return: unit normal in world space
/// @slope height
fn node_textures_bump(height: f32, strength: f32, normal: vec3f, position: vec3f) -> vec3f {
    let p_x = dpdx(position);
    let p_y = dpdy(position);
    let across_x = cross(p_y, normal);
    let across_y = cross(normal, p_x);
    let area = dot(p_x, across_x);
    let slope = select(-1.0, 1.0, area >= 0.0) * strength * (dpdx(height) * across_x + dpdy(height) * across_y);
    return normalize_or(abs(area) * normal - slope, normal);
}
