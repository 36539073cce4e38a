//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Power
///
/// base^exponent, component by component. A negative base counts as 0; 0 to the power 0 is 1, to any other power 0.
/// The result is limited to 2^126.
/// @node math/power   @also pow, exponent, ^
/// - base: what is raised [1; 0..2]
/// - exponent: how far [1; 0..10]
/// - return: the power
fn node_math_power(base: T, exponent: T) -> T {
    let exponent_of_2 = exponent * log2(max(base, T(DIVISOR_FLOOR)));
    let power = exp2(clamp(exponent_of_2, T(-EXPONENT_CEILING), T(EXPONENT_CEILING)));
    return select(power, select(T(0.0), T(1.0), exponent == T(0.0)), base <= T(0.0));
}
