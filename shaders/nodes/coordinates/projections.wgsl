/// Spherical Coordinates
///
/// Where a direction lies on an equirectangular picture: u = atan2(z, x) / (2 pi) + 1/2, v = acos(y) / pi. u jumps at -x; Panorama reads a
/// picture without the seam.
/// @node coordinates/spherical   @also latlong, equirectangular, globe, environment
/// - dir: the direction, of any length; 0 counts as +Y [context object_position]
/// - return: the coordinates
fn node_coordinates_spherical(dir: vec3f) -> vec2f {
    return uv_from_direction(dir);
}

/// Where a direction lies on an equirectangular picture; +Y for one of length 0.
fn uv_from_direction(dir: vec3f) -> vec2f {
    let d = normalize_or(dir, vec3f(0.0, 1.0, 0.0));
    let on_axis = max(abs(d.x), abs(d.z)) <= 1e-12;
    let u = select(atan2(d.z, select(d.x, 1.0, on_axis)), 0.0, on_axis);
    return vec2f(u * 0.5 * INV_PI + 0.5, acos(clamp(d.y, -1.0, 1.0)) * INV_PI);
}

/// Cylindrical Coordinates
///
/// A picture rolled around the y axis: u once around, from -x over -z, v down. u jumps at -x.
/// @node coordinates/cylindrical   @also label, bottle, barrel, wrap around
/// - position: the point [context object_position]
/// - height: of the picture; nearer to 0 than 1e-6 counts as 1e-6 [1; 0..10; m]
/// - return: the coordinates; v is 0.5 at y = 0
fn node_coordinates_cylindrical(position: vec3f, height: f32) -> vec2f {
    return vec2f(uv_from_direction(vec3f(position.x, 0.0, position.z)).x, 0.5 - position.y / max(height, 1e-6));
}

/// Box Projection
///
/// Coordinates on the side of a box that the surface looks at most: one read where Triplanar takes three, with hard borders between the
/// sides. Unmirrored as seen from outside, with up on walls.
/// @node coordinates/box   @also cube mapping, planar, dominant axis
/// - position: the point [context object_position]
/// - normal: which way the surface looks, in the space of the position [context world_normal]
/// - scale: repeats per metre [1; 0..10; 1/m]
/// - return: the coordinates
fn node_coordinates_box(position: vec3f, normal: vec3f, scale: f32) -> vec2f {
    let map = triplanar_mapping(position, normal, scale, 1.0);
    let w = map.weights;
    return select(select(map.uv_z, map.uv_y, w.y >= w.z), map.uv_x, w.x >= max(w.y, w.z));
}

/// Matcap Coordinates
///
/// Coordinates on a picture of a lit ball, by how the normal stands to the viewer: the middle where it faces them, the rim at its rim.
/// Up is world up.
/// @node coordinates/matcap   @also sphere map, lit sphere, clay
/// - normal: unit normal [context world_normal]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - return: the coordinates
fn node_coordinates_matcap(normal: vec3f, view_dir: vec3f) -> vec2f {
    // Straight from above, right is still +x.
    let right = normalize_or(cross(vec3f(0.0, 1.0, 0.0), view_dir), vec3f(1.0, 0.0, 0.0));
    let up = cross(view_dir, right);
    return 0.5 + 0.5 * vec2f(dot(normal, right), -dot(normal, up));
}
