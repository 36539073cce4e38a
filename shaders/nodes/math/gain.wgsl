//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Gain
///
/// Makes 0..1 steeper or flatter about 0.5 and keeps its ends, component by component: two biases back to back.
/// With k = (1 / amount - 2) (1 - 2 x):
///   x / (k + 1)            below 0.5
///   (k - x) / (k - 1)      above
/// An amount of 0.5 changes nothing, a smaller one is steeper. Schlick 1994, "Fast Alternatives to Perlin's Bias and
/// Gain Functions", Graphics Gems IV. x is held in 0..1, the amount in 0.001..0.999.
/// @node math/gain   @also s-curve, contrast
/// - x: value [0.5; 0..1]
/// - amount: 0.5 changes nothing [0.5; 0..1]
/// - return: 0 to 1
fn node_math_gain(x: T, amount: T) -> T {
    let t = clamp(x, T(0.0), T(1.0));
    let a = clamp(amount, T(0.001), T(0.999));
    let k = (T(1.0) / a - 2.0) * (T(1.0) - 2.0 * t);
    return select((k - t) / (k - 1.0), t / (k + 1.0), t < T(0.5));
}
