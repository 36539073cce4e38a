/// Ramp of Two Colours
///
/// From one colour to another between two positions, linearly; level outside. Equal positions make a hard border.
/// @node color/ramp2   @also gradient, color ramp, map
/// - t: where on the ramp [0.5; 0..1]
/// - color_a: the first colour [0,0,0; 0..1; color]
/// - color_b: the second colour [1,1,1; 0..1; color]
/// - position_a: up to where it is the first [0; 0..1]
/// - position_b: from where it is the second [1; 0..1]
/// - return: the colour at t
fn node_color_ramp2(t: f32, color_a: vec3f, color_b: vec3f, position_a: f32, position_b: f32) -> vec3f {
    return mix(color_a, color_b, linear_step(position_a, position_b, t));
}

/// Ramp of Three Colours
///
/// From one colour over a second to a third, linearly between their positions, which should rise; level outside. Equal
/// positions make a hard border.
/// @node color/ramp3   @also gradient, color ramp, map
/// - t: where on the ramp [0.5; 0..1]
/// - color_a: the first colour [0,0,0; 0..1; color]
/// - color_b: the second colour [0.5,0.5,0.5; 0..1; color]
/// - color_c: the third colour [1,1,1; 0..1; color]
/// - position_a: where it is the first [0; 0..1]
/// - position_b: where it is the second [0.5; 0..1]
/// - position_c: where it is the third [1; 0..1]
/// - return: the colour at t
fn node_color_ramp3(t: f32, color_a: vec3f, color_b: vec3f, color_c: vec3f, position_a: f32, position_b: f32, position_c: f32) -> vec3f {
    let lower = mix(color_a, color_b, linear_step(position_a, position_b, t));
    return mix(lower, color_c, linear_step(position_b, position_c, t));
}

/// Ramp of Four Colours
///
/// Through four colours at 0, between two positions, and at 1, linearly or smoothly; level outside. Positions should rise; equal
/// positions make a hard border.
/// @node color/ramp4   @also gradient, color ramp, map
/// - t: where on the ramp [0.5; 0..1]
/// - color_a: the first colour, at 0 [0,0,0; 0..1; color]
/// - color_b: the second colour [0.25,0.25,0.25; 0..1; color]
/// - color_c: the third colour [0.6,0.6,0.6; 0..1; color]
/// - color_d: the fourth colour, at 1 [1,1,1; 0..1; color]
/// - position_b: where it is the second [0.3333; 0..1]
/// - position_c: where it is the third [0.6667; 0..1]
/// - smooth_steps: whether each border is bent level at its ends [false]
/// - return: the colour at t
fn node_color_ramp4(t: f32, color_a: vec3f, color_b: vec3f, color_c: vec3f, color_d: vec3f, position_b: f32, position_c: f32, smooth_steps: bool) -> vec3f {
    let straight = vec3f(linear_step(0.0, position_b, t), linear_step(position_b, position_c, t), linear_step(position_c, 1.0, t));
    let weights = select(straight, straight * straight * (3.0 - 2.0 * straight), smooth_steps);
    return mix(mix(mix(color_a, color_b, weights.x), color_c, weights.y), color_d, weights.z);
}

/// Cosine Palette
///
/// A smooth cycle of colours: base + amplitude cos(2 pi (frequency t + phase)), channel by channel. Quilez 2015, "Palettes".
/// @node color/palette   @also rainbow, gradient, cosine, procedural colors
/// - t: where on the cycle [0; 0..1]
/// - base: the middle [0.5,0.5,0.5; 0..1; color]
/// - amplitude: how far it swings [0.5,0.5,0.5; 0..1]
/// - frequency: swings per unit [1,1,1; 0..4]
/// - phase: where each channel begins, in turns [0,0.3333,0.6667; 0..1]
/// - return: the colour, none below 0
fn node_color_palette(t: f32, base: vec3f, amplitude: vec3f, frequency: vec3f, phase: vec3f) -> vec3f {
    return max(base + amplitude * cos(2.0 * PI * fract(frequency * t + phase)), vec3f(0.0));
}
