// Blend modes beyond W3C's that painting programs and other renderers have, on linear colours: B(base, top), then base + (B - base) opacity.

/// Blend Subtract
///
/// base - top: takes light away, black changes nothing. Channels may end below 0: saturate them where that hurts.
/// @node color/blend_subtract   @also layer, minus, darken
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_subtract(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return base - top * opacity;
}

/// Quotient of both colours at full opacity.
fn blend_of_divide(base: vec3f, top: vec3f) -> vec3f {
    return base / max(top, vec3f(1e-3));
}

/// Blend Divide
///
/// base / top: takes a tint or a shadow out of a picture, white changes nothing. A channel of the top below 0.001 counts as 0.001.
/// @node color/blend_divide   @also layer, delight, flatten
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [1,1,1; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_divide(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_divide(base, top), opacity);
}

/// Blend Linear Light
///
/// base + 2 top - 1: adds what the top has above 0.5 and takes away what it has below; a top of 0.5 changes nothing. For detail
/// of which the mean is grey. Channels may end below 0.
/// @node color/blend_linear_light   @also layer, add, detail, high pass
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_linear_light(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return base + (2.0 * top - 1.0) * opacity;
}
