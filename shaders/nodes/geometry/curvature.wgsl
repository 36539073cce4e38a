/// Curvature
///
/// How strongly the surface bends under the pixel: mean curvature from the derivatives of normal and position along the two directions of
/// the screen, 1 / radius for a ball, above 0 where it bulges, below in hollows. It is that of the interpolated normals: flat in a flat-shaded
/// face, and noisy where triangles meet. The fragment stage only.
/// @node geometry/curvature   @also edges, cavity, wear, pointiness, convexity
/// - normal: unit normal [context world_normal]
/// - position: the point [context world_position]
/// - return: the curvature [1/m]
/// @slope normal
fn node_geometry_curvature(normal: vec3f, position: vec3f) -> f32 {
    let p_x = dpdx(position);
    let p_y = dpdy(position);
    let n_x = dpdx(normal);
    let n_y = dpdy(normal);
    // The trace of the shape operator: with the metric g of the pixel, tr(g^-1 (dn . dp)) / 2.
    let xx = dot(p_x, p_x);
    let xy = dot(p_x, p_y);
    let yy = dot(p_y, p_y);
    let bend = dot(n_x, p_x) * yy - (dot(n_x, p_y) + dot(n_y, p_x)) * xy + dot(n_y, p_y) * xx;
    let area2 = xx * yy - xy * xy;
    // A degenerate pixel has no curvature; 1e6 is a radius of a micrometre.
    return select(0.0, clamp(0.5 * bend / area2, -1e6, 1e6), area2 > DIVISOR_FLOOR);
}

/// Face Normal
///
/// Unit normal of the triangle itself, without smoothing, towards the viewer: facets. The fragment stage only.
/// @node geometry/face_normal   @also flat shading, facets, low poly, geometric
/// - position: the point [context world_position]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - return: unit direction
fn node_geometry_face_normal(position: vec3f, view_dir: vec3f) -> vec3f {
    let n = normalize_or(cross(dpdx(position), dpdy(position)), view_dir);
    return select(-n, n, dot(n, view_dir) >= 0.0);
}
