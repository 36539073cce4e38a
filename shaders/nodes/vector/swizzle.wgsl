/// One component of a vector by number: 0 to 3 are x to w, 4 is the number 0, 5 the number 1; others take the nearest.
fn component_by_number(v: vec4f, index: i32) -> f32 {
    let low = select(select(v.x, v.y, index > 0), select(v.z, v.w, index > 2), index > 1);
    return select(low, select(0.0, 1.0, index > 4), index > 3);
}

/// Swizzle
///
/// The components of a vector in another order. Each number says which component comes there: 0 x, 1 y, 2 z, 3 w, 4 the number 0,
/// 5 the number 1.
/// @node vector/swizzle   @also shuffle, reorder, channels, rgba
/// - v: vector [0,0,0,0]
/// - x: what comes first [0; 0..5]
/// - y: what comes second [1; 0..5]
/// - z: what comes third [2; 0..5]
/// - w: what comes fourth [3; 0..5]
/// - return: the new vector
fn node_vector_swizzle(v: vec4f, x: i32, y: i32, z: i32, w: i32) -> vec4f {
    return vec4f(component_by_number(v, x), component_by_number(v, y), component_by_number(v, z), component_by_number(v, w));
}

/// Extract
///
/// One component of a vector by number: 0 x, 1 y, 2 z, 3 w, 4 the number 0, 5 the number 1.
/// @node vector/extract   @also channel, component, mask
/// - v: vector [0,0,0,0]
/// - index: which one [0; 0..5]
/// - return: the component
fn node_vector_extract(v: vec4f, index: i32) -> f32 {
    return component_by_number(v, index);
}
