/// And
///
/// Whether both conditions hold.
/// @node math/and   @also both, logic
/// - a: first condition [false]
/// - b: second condition [false]
/// - return: the condition
fn node_math_and(a: bool, b: bool) -> bool {
    return a & b;
}

/// Or
///
/// Whether at least one of two conditions holds.
/// @node math/or   @also either, logic
/// - a: first condition [false]
/// - b: second condition [false]
/// - return: the condition
fn node_math_or(a: bool, b: bool) -> bool {
    return a | b;
}

/// Not
///
/// Whether the condition does not hold.
/// @node math/not   @also opposite, logic
/// - a: condition [false]
/// - return: the condition
fn node_math_not(a: bool) -> bool {
    return !a;
}
