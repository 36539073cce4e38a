//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Smooth Minimum
///
/// The smaller of a and b with a round transition where they are nearer than `radius`, component by component.
/// With h = max(radius - |a - b|, 0) / radius:
///   min(a, b) - h^2 radius / 4
/// Quilez 2013, "Smooth minimum" (quadratic). A radius of 0 is the plain minimum.
/// @node math/smooth_min   @also soft minimum, smin, union
/// - a: first value [0]
/// - b: second value [0]
/// - radius: how far apart they still blend [0.1; 0..1]
/// - return: at most the smaller one
fn node_math_smooth_min(a: T, b: T, radius: T) -> T {
    let r = max(radius, T(DIVISOR_FLOOR));
    let h = max(r - abs(a - b), T(0.0)) / r;
    return min(a, b) - 0.25 * h * h * r;
}
