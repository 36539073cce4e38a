/// A curve through five points at 0, 1/4, 1/2, 3/4 and 1, whose values are given; x is held in 0..1. Steffen 1990, "A simple method for
/// monotonic interpolation in one dimension": a cubic between neighbours with the slope, per interval,
///   (sign(a) + sign(b)) min(|a|, |b|, |a + b| / 4)
/// where a and b are the rises before and after the point. It never passes the values of its neighbours.
fn monotone_curve(x: f32, v0: f32, v1: f32, v2: f32, v3: f32, v4: f32) -> f32 {
    let along = 4.0 * clamp(x, 0.0, 1.0);
    let interval = min(floor(along), 3.0);
    let t = along - interval;
    // Beyond the ends the curve goes on as a line.
    var points = array<f32, 7>(2.0 * v0 - v1, v0, v1, v2, v3, v4, 2.0 * v4 - v3);
    let i = i32(interval);
    let p1 = points[i + 1];
    let p2 = points[i + 2];
    let rise = vec3f(p1 - points[i], p2 - p1, points[i + 3] - p2);
    let before = rise.xy;
    let after = rise.yz;
    let slope = (sign(before) + sign(after)) * min(min(abs(before), abs(after)), 0.25 * abs(before + after));
    let cubic = slope.x + slope.y - 2.0 * rise.y;
    return p1 + t * (slope.x + t * (3.0 * rise.y - 2.0 * slope.x - slope.y + t * cubic));
}

/// Curve
///
/// A value bent by a smooth curve through five points, which stand at 0, 1/4, 1/2, 3/4 and 1; level outside. Between two points
/// it never passes their values. Steffen 1990, "A simple method for monotonic interpolation in one dimension".
/// @node math/curve   @also float curve, spline, levels, tone curve
/// - x: value, held in 0..1 [0.5; 0..1]
/// - at_0: result at 0 [0; 0..1]
/// - at_25: result at 1/4 [0.25; 0..1]
/// - at_50: result at 1/2 [0.5; 0..1]
/// - at_75: result at 3/4 [0.75; 0..1]
/// - at_100: result at 1 [1; 0..1]
/// - return: the bent value
fn node_math_curve(x: f32, at_0: f32, at_25: f32, at_50: f32, at_75: f32, at_100: f32) -> f32 {
    return monotone_curve(x, at_0, at_25, at_50, at_75, at_100);
}
