/// A curve through five points at 0, 1/4, 1/2, 3/4 and 1, whose values are given; x is held in 0..1. Steffen 1990, "A simple method for
/// monotonic interpolation in one dimension": a cubic between neighbours with the slope, per interval,
///   (sign(a) + sign(b)) min(|a|, |b|, |a + b| / 4)
/// where a and b are the rises before and after the point. It never passes the values of its neighbours.
fn monotone_curve(x: f32, v0: f32, v1: f32, v2: f32, v3: f32, v4: f32) -> f32 {
    let along = 4.0 * clamp(x, 0.0, 1.0);
    let interval = min(floor(along), 3.0);
    let t = along - interval;
    // The four points about the interval; beyond the ends the curve goes on as a line. No array: it would lie in memory.
    let left = select(vec4f(2.0 * v0 - v1, v0, v1, v2), vec4f(v0, v1, v2, v3), along >= 1.0);
    let right = select(vec4f(v1, v2, v3, v4), vec4f(v2, v3, v4, 2.0 * v4 - v3), along >= 3.0);
    let points = select(left, right, along >= 2.0);
    let p1 = points.y;
    let rise = points.yzw - points.xyz;
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
