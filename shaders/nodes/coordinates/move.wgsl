/// Pan
///
/// Coordinates that run on with time, each second by the velocity. Whole turns are taken off, which a repeating picture does not show.
/// @node coordinates/pan   @also scroll, animate, flow, conveyor
/// - uv: coordinates [context uv0]
/// - time: seconds [context time]
/// - velocity: units per second [0.1,0; -1..1]
/// - return: the moved coordinates
fn node_coordinates_pan(uv: vec2f, time: f32, velocity: vec2f) -> vec2f {
    return uv + fract(velocity * time);
}

/// Swirl
///
/// Coordinates turned about a centre, most in the middle, not at all from the radius on; the turn falls off as a smooth step.
/// @node coordinates/swirl   @also twirl, twist, vortex
/// - uv: coordinates [context uv0]
/// - center: about which point [0.5,0.5; 0..1]
/// - angle: turn in the middle [90; -720..720; deg]
/// - radius: where it ends; at least 1e-6 [0.5; 0..1]
/// - return: the new coordinates
fn node_coordinates_swirl(uv: vec2f, center: vec2f, angle: f32, radius: f32) -> vec2f {
    let d = uv - center;
    let turn = radians(angle) * (1.0 - smoothstep(0.0, max(radius, 1e-6), length(d)));
    return center + vec2f(cos(turn) * d.x - sin(turn) * d.y, sin(turn) * d.x + cos(turn) * d.y);
}

/// Bump Offset
///
/// Coordinates moved along the line of sight by a height that was already read: a parallax of one step, cheap and swimming where Parallax
/// searches. White (1) is the mesh, black (0) lies `depth` below. Kaneko et al. 2001, "Detailed shape representation with parallax mapping".
/// @node coordinates/bump_offset   @also parallax, depth, height
/// - uv: where the mesh reads [context uv0]
/// - height: the height map's value there [0.5; 0..1]
/// - depth: between white and black, in units of the picture's edge [0.05; 0..0.2]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: texture coordinates
fn node_coordinates_bump_offset(uv: vec2f, height: f32, depth: f32, view_dir: vec3f, normal: vec3f, tangent: vec4f) -> vec2f {
    return uv + parallax_offset(view_dir, normal, tangent, depth) * (1.0 - height);
}

/// Footprint
///
/// How wide a pixel is on a pattern: the square root of the mean squared length of its two sides there. For fading out detail by hand;
/// the patterns of this library do it themselves. 0 in the vertex stage.
/// @node coordinates/footprint   @also pixel size, derivative, fwidth, level of detail, antialias
/// - position: coordinates or a point of the pattern [context object_position]
/// - return: width of a pixel
/// @vertex node_coordinates_footprint_vertex
fn node_coordinates_footprint(position: vec3f) -> f32 {
    return sqrt(squared_footprint(position));
}

/// The vertex stage has no pixels.
fn node_coordinates_footprint_vertex(position: vec3f) -> f32 {
    return 0.0;
}
