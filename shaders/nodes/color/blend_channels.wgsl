// More blend modes of W3C 2015, "Compositing and Blending Level 1", section 9.1, on linear colours, channel by channel.

/// Blend Darken
///
/// The darker of both in each channel; white changes nothing.
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_darken   @also layer, minimum
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [1,1,1; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_darken(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, min(base, top), opacity);
}

/// Blend Lighten
///
/// The lighter of both in each channel; black changes nothing.
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_lighten   @also layer, maximum
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_lighten(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, max(base, top), opacity);
}

/// Burn of both colours at full opacity.
fn blend_of_burn(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    let blend = select(vec3f(0.0), 1.0 - (1.0 - b) / t, 1.0 - b < t);
    return select(blend, vec3f(1.0), b >= vec3f(1.0));
}

/// Blend Burn
///
/// 1 - min(1, (1 - base) / top): burns shadows in. A white base stays white, and a black top leaves nothing else.
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_burn   @also layer, darken, color burn
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [1,1,1; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_burn(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_burn(base, top), opacity);
}

/// Hard light of both colours at full opacity.
fn blend_of_hard_light(base: vec3f, top: vec3f) -> vec3f {
    let light = 1.0 - 2.0 * (1.0 - base) * (1.0 - top);
    return select(light, 2.0 * base * top, top <= vec3f(0.5));
}

/// Blend Hard Light
///
/// Multiplies where the top is dark and screens where it is light: an overlay with base and top exchanged.
///   2 base top                        where top <= 0.5
///   1 - 2 (1 - base)(1 - top)         elsewhere
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_hard_light   @also layer, contrast, overlay
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_hard_light(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_hard_light(base, top), opacity);
}

/// Exclusion of both colours at full opacity.
fn blend_of_exclusion(base: vec3f, top: vec3f) -> vec3f {
    return base + top - 2.0 * base * top;
}

/// Blend Exclusion
///
/// base + top - 2 base top: a difference of less contrast; black changes nothing.
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_exclusion   @also layer, invert
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_exclusion(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_exclusion(base, top), opacity);
}

/// Blend Add
///
/// base + top: light upon light, not limited to 1. The sum of "plus lighter" in
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_add   @also layer, linear dodge, plus lighter
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_add(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, base + top, opacity);
}
