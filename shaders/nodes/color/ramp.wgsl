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
