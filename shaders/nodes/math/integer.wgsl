/// To Whole Number
///
/// The greatest whole number that is not above x, for sockets that take whole numbers. x is held in -2e9..2e9.
/// @node math/to_integer   @also floor, int, convert, index
/// - x: value [0]
/// - return: the whole number
fn node_math_to_integer(x: f32) -> i32 {
    return i32(floor(clamp(x, -2e9, 2e9)));
}
