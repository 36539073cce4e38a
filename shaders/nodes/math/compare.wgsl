/// Greater Than
///
/// Whether a is greater than b.
/// @node math/greater_than   @also compare, above, >
/// - a: first value [0]
/// - b: second value [0]
/// - return: the condition, for a switch
fn node_math_greater_than(a: f32, b: f32) -> bool {
    return a > b;
}

/// Less Than
///
/// Whether a is less than b.
/// @node math/less_than   @also compare, below, <
/// - a: first value [0]
/// - b: second value [0]
/// - return: the condition, for a switch
fn node_math_less_than(a: f32, b: f32) -> bool {
    return a < b;
}

/// Nearly Equal
///
/// Whether a and b are no further apart than `tolerance`. Numbers that were computed are seldom equal to the last digit.
/// @node math/nearly_equal   @also compare, same, ==
/// - a: first value [0]
/// - b: second value [0]
/// - tolerance: how far apart they may be [0.001; 0..1]
/// - return: the condition, for a switch
fn node_math_nearly_equal(a: f32, b: f32, tolerance: f32) -> bool {
    return abs(a - b) <= tolerance;
}
