//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Switch
///
/// One of two values by a condition. Both are computed.
/// @node math/switch   @also if, select, choose, condition
/// - condition: which one [false]
/// - when_false: the value without the condition [0]
/// - when_true: the value with it [1]
/// - return: the chosen value
fn node_math_switch(condition: bool, when_false: T, when_true: T) -> T {
    return select(when_false, when_true, condition);
}
