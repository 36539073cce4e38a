/// Number
///
/// One number, for several sockets or as a parameter.
/// @node input/number   @also float, value, constant, scalar
/// - value: the number [0]
/// - return: the number
fn node_input_number(value: f32) -> f32 {
    return value;
}

/// Whole Number
///
/// One whole number, for several sockets or as a parameter.
/// @node input/integer   @also int, count, constant
/// - value: the number [0]
/// - return: the number
fn node_input_integer(value: i32) -> i32 {
    return value;
}

/// Condition
///
/// True or false, for several switches or as a parameter.
/// @node input/condition   @also bool, toggle, checkbox
/// - value: the condition [false]
/// - return: the condition
fn node_input_condition(value: bool) -> bool {
    return value;
}

/// Vector 2
///
/// One vector of two, for several sockets or as a parameter.
/// @node input/vector2   @also vec2, constant
/// - value: the vector [0,0]
/// - return: the vector
fn node_input_vector2(value: vec2f) -> vec2f {
    return value;
}

/// Vector 3
///
/// One vector of three, for several sockets or as a parameter.
/// @node input/vector3   @also vec3, constant
/// - value: the vector [0,0,0]
/// - return: the vector
fn node_input_vector3(value: vec3f) -> vec3f {
    return value;
}

/// Vector 4
///
/// One vector of four, for several sockets or as a parameter.
/// @node input/vector4   @also vec4, constant
/// - value: the vector [0,0,0,0]
/// - return: the vector
fn node_input_vector4(value: vec4f) -> vec4f {
    return value;
}

/// Colour
///
/// One colour, for several sockets or as a parameter. Linear Rec. 709.
/// @node input/color   @also rgb, constant
/// - value: the colour [0.5,0.5,0.5; 0..1; color]
/// - return: the colour
fn node_input_color(value: vec3f) -> vec3f {
    return value;
}
