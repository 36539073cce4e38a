// What several nodes share: the bounds that keep a result finite, and steps between two values.
// The nodes' domain is numbers up to 1e8 in size; f32 ends at 3.4e38.

// A divisor nearer to zero than this counts as zero: 1e8 / 1e-30 is still finite.
const DIVISOR_FLOOR: f32 = 1e-30;
// Largest exponent of 2 that a power or an exponential returns: 2^126 = 8.5e37.
const EXPONENT_CEILING: f32 = 126.0;

/// How far x has come from `low` to `high`, linearly: 0 at low, 1 at high, clamped. Equal ends make a step at `low`.
fn linear_step(low: f32, high: f32, x: f32) -> f32 {
    let width = high - low;
    let inside = clamp((x - low) / width, 0.0, 1.0);
    return select(select(0.0, 1.0, x >= low), inside, abs(width) > DIVISOR_FLOOR);
}

/// base^exponent by channel, for a base >= 0; a negative base counts as 0, and 0^exponent is 0 unless the exponent is 0.
/// The exponent of 2 is clamped to +-126, so the result is finite.
fn power_of_color(base: vec3f, exponent: f32) -> vec3f {
    let power = exp2(clamp(exponent * log2(max(base, vec3f(DIVISOR_FLOOR))), vec3f(-EXPONENT_CEILING), vec3f(EXPONENT_CEILING)));
    return select(power, vec3f(select(0.0, 1.0, exponent == 0.0)), base <= vec3f(0.0));
}
