/// The outputs of the node procedural/wood.
struct WoodOutputs {
    /// year's ring: 0 early wood, rising to 1 at the late wood's end
    ring: f32,
    /// fibres along the trunk, -1 to 1
    fiber: f32,
}

/// Wood
///
/// The rings of a trunk along the y axis, wobbling, each pale and wide first and dark and narrow last, and fine fibres along it. Rings
/// are the fourth power of a saw, averaged over the pixel; fibres fade to 0. After the solid wood of Perlin 1985, "An Image Synthesizer".
/// @node procedural/wood   @also timber, rings, grain, planks, oak, pine
/// - position: the point; the trunk's axis is y [context object_position]
/// - scale: rings per metre [12; 0..64]
/// - wobble: how far rings leave the circle, in rings [0.6; 0..3]
/// - seed: another one, another trunk [0; 0..100]
/// @vertex node_procedural_wood_vertex
fn node_procedural_wood(position: vec3f, scale: f32, wobble: f32, seed: i32) -> WoodOutputs {
    let age = wood_age(position, scale, wobble, seed);
    let fiber = wood_fiber(position, scale);
    return wood(age, fwidth(age), fiber, squared_footprint(fiber), seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_wood_vertex(position: vec3f, scale: f32, wobble: f32, seed: i32) -> WoodOutputs {
    return wood(wood_age(position, scale, wobble, seed), 0.0, wood_fiber(position, scale), 0.0, seed);
}

/// Rings from the axis to the point. The wobble is noise of a few rings' size, drawn out along the trunk.
fn wood_age(position: vec3f, scale: f32, wobble: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return held1(length(p.xz) + wobble * gradient_noise3(p * vec3f(0.23, 0.05, 0.23), seed));
}

/// Where the point lies in the noise of fibres, which are six to a ring and forty times as long.
fn wood_fiber(position: vec3f, scale: f32) -> vec3f {
    return held3(position * scale) * vec3f(6.0, 0.15, 6.0);
}

/// The rings and fibres over their windows.
fn wood(age: f32, window: f32, fiber: vec3f, squared_fiber_window: f32, seed: i32) -> WoodOutputs {
    let w = max(window, WINDOW_FLOOR);
    let start = fract(age - 0.5 * w);
    let end = start + w;
    let rest = fract(end);
    // The integral of x^4 is x^5 / 5 in each ring.
    let within = 0.2 * (floor(end) + pow5(rest) - pow5(start)) / w;
    let at_point = fract(age) * fract(age);
    let ring = select(within, at_point * at_point, window < WINDOW_FLOOR);
    return WoodOutputs(ring, gradient_noise3(fiber, seed + 1) * left_of_noise(1.0, squared_fiber_window));
}
