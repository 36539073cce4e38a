/// New Function
///
/// What it gives, in words. Each argument becomes an input: [default; range; unit].
/// @node custom/new_function
/// - a: first colour [0.8,0.8,0.8; 0..1; color]
/// - b: second colour [0.1,0.1,0.1; 0..1; color]
/// - t: how much of the second [0.5; 0..1]
fn new_function(a: vec3f, b: vec3f, t: f32) -> vec3f {
    return mix(a, b, t);
}
