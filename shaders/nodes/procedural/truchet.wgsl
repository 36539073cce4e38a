/// Truchet
///
/// Square tiles with two quarter circles each, turned at random: winding paths, brain coral, woven wire. Smith and Boucher 1987, "The
/// tiling patterns of Sebastien Truchet". Lines are averaged over the pixel, and fade to their mean where tiles are smaller than pixels.
/// @node procedural/truchet   @also maze, winding, tiles, arcs, coral
/// - uv: coordinates [context uv0]
/// - scale: tiles per unit [8; 0..64]
/// - width: of the lines, over the tile's side; held in 0..0.4 [0.15; 0..0.4]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 1 on a line, 0 beside
/// @vertex node_procedural_truchet_vertex
fn node_procedural_truchet(uv: vec2f, scale: f32, width: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return truchet(p, squared_footprint2(p), clamp(width, 0.0, 0.4), seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_truchet_vertex(uv: vec2f, scale: f32, width: f32, seed: i32) -> f32 {
    return truchet(held2(uv * scale), 0.0, clamp(width, 0.0, 0.4), seed);
}

/// The part of a window that the arcs cover.
fn truchet(p: vec2f, squared_width: f32, width: f32, seed: i32) -> f32 {
    let is_turned = (lattice_hash(vec3i(vec2i(floor(p)), 0), seed).x >> 31u) != 0u;
    let f = fract(p);
    let q = vec2f(select(f.x, 1.0 - f.x, is_turned), f.y);
    // Two quarters of radius 1/2 about opposite corners, half a circle in all: pi/2 long.
    let away = min(abs(length(q) - 0.5), abs(length(1.0 - q) - 0.5));
    return mix(line_share(away, 0.5 * width, sqrt(squared_width)), 0.5 * PI * width, share_of_mean(squared_width));
}
