/// The outputs of the node procedural/weave.
struct WeaveOutputs {
    /// part of the pixel that shows threads along v
    warp: f32,
    /// part of the pixel that shows threads along u
    weft: f32,
    /// height of the topmost thread, 0 to 1
    height: f32,
}

/// Weave
///
/// Plain weave: threads along v and along u that go over and under each other in turn; what neither covers is gap. Averaged over the pixel.
/// @node procedural/weave   @also cloth, fabric, linen, canvas, basket, carbon
/// - uv: coordinates [context uv0]
/// - count: threads per unit, across and down [16,16; 1..128]
/// - thread: width of a thread over its place [0.85; 0..1]
/// @vertex node_procedural_weave_vertex
fn node_procedural_weave(uv: vec2f, count: vec2f, thread: f32) -> WeaveOutputs {
    let p = held2(uv * count);
    return weave(p, fwidth(p), thread);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_weave_vertex(uv: vec2f, count: vec2f, thread: f32) -> WeaveOutputs {
    return weave(held2(uv * count), vec2f(0.0), thread);
}

/// The weave over a window.
fn weave(p: vec2f, window: vec2f, thread: f32) -> WeaveOutputs {
    let part = clamp(thread, 0.0, 1.0);
    let start = 0.5 * (1.0 - part);
    let column = pulse_wave(p.x - start, window.x, part);
    let line = pulse_wave(p.y - start, window.y, part);
    let even = 1.0 - odd_share(odd_share(0.0, p.x, window.x), p.y, window.y);
    let both = column * line;
    let warp = column - both + both * even;
    let weft = line - both + both * (1.0 - even);
    // Threads swing with half the frequency, against each other: up where they are on top.
    let swing = sine_wave(0.5 * p.x, 0.5 * window.x) * sine_wave(0.5 * p.y, 0.5 * window.y);
    // Where both cross, the upper one is the one that swings up: on the mean, the squared mean of |sin| over a thread.
    let crossing = 2.0 * INV_PI * cos(PI * start);
    let lift = mix((warp - weft) * swing, crossing * crossing, share_of_mean(0.5 * dot(window, window)));
    return WeaveOutputs(warp, weft, clamp(0.5 * (warp + weft + lift), 0.0, 1.0));
}
