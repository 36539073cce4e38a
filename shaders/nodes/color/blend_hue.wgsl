// The blend modes of W3C 2015, "Compositing and Blending Level 1", section 9.2, which take hue, saturation and luminosity from one
// colour or the other. They know luminosity as 0.3 R + 0.59 G + 0.11 B and saturation as greatest less least channel.

/// Luminosity as the W3C has it.
fn blend_luminosity(c: vec3f) -> f32 {
    return dot(c, vec3f(0.3, 0.59, 0.11));
}

/// Saturation as the W3C has it.
fn blend_saturation(c: vec3f) -> f32 {
    return max(c.r, max(c.g, c.b)) - min(c.r, min(c.g, c.b));
}

/// The colour with another luminosity l in 0..1: moved, and drawn towards its grey where channels leave 0..1.
fn blend_with_luminosity(c: vec3f, l: f32) -> vec3f {
    let moved = c + (l - blend_luminosity(c));
    let least = min(moved.r, min(moved.g, moved.b));
    let greatest = max(moved.r, max(moved.g, moved.b));
    let raised = select(moved, l + (moved - l) * (l / max(l - least, DIVISOR_FLOOR)), least < 0.0);
    return select(raised, l + (raised - l) * ((1.0 - l) / max(greatest - l, DIVISOR_FLOOR)), greatest > 1.0);
}

/// The colour with another saturation: its channels spread over 0..s; black for a grey.
fn blend_with_saturation(c: vec3f, s: f32) -> vec3f {
    let least = min(c.r, min(c.g, c.b));
    let spread = blend_saturation(c);
    return select(vec3f(0.0), (c - least) * (s / max(spread, DIVISOR_FLOOR)), spread > DIVISOR_FLOOR);
}

/// Blend by hue of both colours at full opacity.
fn blend_of_hue(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    let blend = blend_with_luminosity(blend_with_saturation(t, blend_saturation(b)), blend_luminosity(b));
    return blend;
}

/// Blend Hue
///
/// The hue of the top with saturation and luminosity of the base.
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_hue   @also layer, tint, recolor
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_hue(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_hue(base, top), opacity);
}

/// Blend by saturation of both colours at full opacity.
fn blend_of_saturation(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    let blend = blend_with_luminosity(blend_with_saturation(b, blend_saturation(t)), blend_luminosity(b));
    return blend;
}

/// Blend Saturation
///
/// The saturation of the top with hue and luminosity of the base.
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_saturation   @also layer, vivid
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_saturation(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_saturation(base, top), opacity);
}

/// Blend by colour of both colours at full opacity.
fn blend_of_color(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    return blend_with_luminosity(t, blend_luminosity(b));
}

/// Blend Colour
///
/// Hue and saturation of the top with the luminosity of the base: tints what is grey.
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_color   @also layer, tint, colorize
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_color(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_color(base, top), opacity);
}

/// Blend by luminosity of both colours at full opacity.
fn blend_of_luminosity(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    return blend_with_luminosity(b, blend_luminosity(t));
}

/// Blend Luminosity
///
/// The luminosity of the top with hue and saturation of the base.
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_luminosity   @also layer, value
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_luminosity(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_luminosity(base, top), opacity);
}
