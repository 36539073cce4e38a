/// Scratches
///
/// Straight strokes of random place, direction and length, one to a cell. Averaged over the pixel across the stroke, and fading to the mean where
/// cells are smaller than pixels. Add two of different scales for more.
/// @node procedural/scratches   @also wear, strokes, hairs, brushed, dust
/// - uv: coordinates [context uv0]
/// - scale: cells per unit [12; 0..64]
/// - density: part of the cells that have a stroke [0.7; 0..1]
/// - width: of a stroke, in cells; held in 0..0.2 [0.02; 0..0.2]
/// - spread: directions, 0 all along u, 1 any [1; 0..1]
/// - seed: another one, other strokes [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_scratches_vertex
fn node_procedural_scratches(uv: vec2f, scale: f32, density: f32, width: f32, spread: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return scratches(p, squared_footprint2(p), clamp(density, 0.0, 1.0), clamp(width, 0.0, 0.2), spread, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_scratches_vertex(uv: vec2f, scale: f32, density: f32, width: f32, spread: f32, seed: i32) -> f32 {
    return scratches(held2(uv * scale), 0.0, clamp(density, 0.0, 1.0), clamp(width, 0.0, 0.2), spread, seed);
}

/// Strokes over a window. A stroke is up to 1.6 long, so that those of the cells around are all that reach a point.
fn scratches(p: vec2f, squared_width: f32, density: f32, width: f32, spread: f32, seed: i32) -> f32 {
    let cell = vec2i(floor(p));
    let f = fract(p);
    let window = sqrt(squared_width);
    var rest = 1.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let h = lattice_hash(vec3i(cell + vec2i(x, y), 0), seed);
            let random = unit_floats(h);
            // The low bytes, which the three numbers do not use.
            let more = vec3f(h & vec3u(255u)) / 255.0;
            let angle = (random.z - 0.5) * PI * spread;
            let along = vec2f(cos(angle), sin(angle));
            let d = f - vec2f(f32(x), f32(y)) - 0.25 - 0.5 * random.xy;
            let across = dot(d, vec2f(-along.y, along.x));
            let beyond = abs(dot(d, along)) - (0.25 + 0.5 * more.x);
            let stroke = line_share(across, 0.5 * width, window) * inside_share(beyond, 0.1, window);
            rest *= 1.0 - select(0.0, stroke * (0.4 + 0.6 * more.y), more.z < density);
        }
    }
    // A stroke covers its mean length of 1 times its width, by 0.7.
    return mix(1.0 - rest, 0.7 * density * width, share_of_mean(squared_width));
}
