//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Bias
///
/// Bends 0..1 up or down and keeps its ends, component by component:
///   x / ((1 / amount - 2) (1 - x) + 1)
/// 0.5 goes to `amount`; an amount of 0.5 changes nothing. Schlick 1994, "Fast Alternatives to Perlin's Bias and Gain
/// Functions", Graphics Gems IV. x is held in 0..1, the amount in 0.001..0.999.
/// @node math/bias   @also midtones, curve
/// - x: value [0.5; 0..1]
/// - amount: where 0.5 goes [0.5; 0..1]
/// - return: 0 to 1
fn node_math_bias(x: T, amount: T) -> T {
    let t = clamp(x, T(0.0), T(1.0));
    let a = clamp(amount, T(0.001), T(0.999));
    return t / ((T(1.0) / a - 2.0) * (T(1.0) - t) + 1.0);
}
