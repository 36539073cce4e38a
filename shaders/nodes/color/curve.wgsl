/// Colour Curve
///
/// Each channel bent by the same smooth curve through five points, which stand at 0, 1/4, 1/2, 3/4 and 1; channels are held in 0..1.
/// Steffen 1990, "A simple method for monotonic interpolation in one dimension".
/// @node color/curve   @also rgb curves, tone curve, contrast
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - at_0: result at 0 [0; 0..1]
/// - at_25: result at 1/4 [0.25; 0..1]
/// - at_50: result at 1/2 [0.5; 0..1]
/// - at_75: result at 3/4 [0.75; 0..1]
/// - at_100: result at 1 [1; 0..1]
/// - return: the changed colour
fn node_color_curve(color: vec3f, at_0: f32, at_25: f32, at_50: f32, at_75: f32, at_100: f32) -> vec3f {
    return vec3f(
        monotone_curve(color.r, at_0, at_25, at_50, at_75, at_100),
        monotone_curve(color.g, at_0, at_25, at_50, at_75, at_100),
        monotone_curve(color.b, at_0, at_25, at_50, at_75, at_100),
    );
}
