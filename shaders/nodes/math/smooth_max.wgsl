//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Smooth Maximum
///
/// The greater of a and b with a round transition where they are nearer than `radius`, component by component.
/// With h = max(radius - |a - b|, 0) / radius:
///   max(a, b) + h^2 radius / 4
/// Quilez 2013, "Smooth minimum" (quadratic), mirrored. A radius of 0 is the plain maximum.
/// @node math/smooth_max   @also soft maximum, smax, intersection
/// - a: first value [0]
/// - b: second value [0]
/// - radius: how far apart they still blend [0.1; 0..1]
/// - return: at least the greater one
fn node_math_smooth_max(a: T, b: T, radius: T) -> T {
    let r = max(radius, T(DIVISOR_FLOOR));
    let h = max(r - abs(a - b), T(0.0)) / r;
    return max(a, b) + 0.25 * h * h * r;
}
