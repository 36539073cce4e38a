// Blend modes of W3C 2015, "Compositing and Blending Level 1", section 9, on linear colours: B(base, top), then
// base + (B - base) opacity. The modes are made for 0..1; other numbers stay finite.

/// Blend Multiply
///
/// base top: darkens, white changes nothing. W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_multiply   @also layer, darken, shadow
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [1,1,1; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_multiply(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, base * top, opacity);
}

/// Screen of both colours at full opacity.
fn blend_of_screen(base: vec3f, top: vec3f) -> vec3f {
    return base + top - base * top;
}

/// Blend Screen
///
/// 1 - (1 - base)(1 - top): lightens, black changes nothing. W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_screen   @also layer, lighten, glow
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_screen(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_screen(base, top), opacity);
}

/// Overlay of both colours at full opacity.
fn blend_of_overlay(base: vec3f, top: vec3f) -> vec3f {
    let light = 1.0 - 2.0 * (1.0 - base) * (1.0 - top);
    return select(light, 2.0 * base * top, base <= vec3f(0.5));
}

/// Blend Overlay
///
/// Multiplies the dark parts of the base and screens the light ones; a top of 0.5 changes nothing.
///   2 base top                        where base <= 0.5
///   1 - 2 (1 - base)(1 - top)         elsewhere
/// W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_overlay   @also layer, contrast
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_overlay(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_overlay(base, top), opacity);
}

/// Soft light of both colours at full opacity.
fn blend_of_soft_light(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let t = clamp(top, vec3f(0.0), vec3f(1.0));
    let d = select(sqrt(b), ((16.0 * b - 12.0) * b + 4.0) * b, b <= vec3f(0.25));
    let darker = b - (1.0 - 2.0 * t) * b * (1.0 - b);
    let lighter = b + (2.0 * t - 1.0) * (d - b);
    return select(lighter, darker, t <= vec3f(0.5));
}

/// Blend Soft Light
///
/// A gentle overlay: lightens where the top is above 0.5, darkens below.
///   base - (1 - 2 top) base (1 - base)                where top <= 0.5
///   base + (2 top - 1) (D(base) - base)               elsewhere
///   D(x) = ((16 x - 12) x + 4) x where x <= 0.25, else sqrt(x)
/// W3C 2015, "Compositing and Blending Level 1". Both colours are held in 0..1.
/// @node color/blend_soft_light   @also layer, overlay
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0.5,0.5,0.5; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_soft_light(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_soft_light(base, top), opacity);
}

/// Dodge of both colours at full opacity.
fn blend_of_dodge(base: vec3f, top: vec3f) -> vec3f {
    let b = clamp(base, vec3f(0.0), vec3f(1.0));
    let rest = 1.0 - clamp(top, vec3f(0.0), vec3f(1.0));
    let blend = select(vec3f(1.0), b / rest, b < rest);
    return select(blend, vec3f(0.0), b <= vec3f(0.0));
}

/// Blend Dodge
///
/// min(1, base / (1 - top)): burns highlights out. A black base stays black. W3C 2015, "Compositing and Blending
/// Level 1". Both colours are held in 0..1.
/// @node color/blend_dodge   @also layer, lighten, color dodge
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_dodge(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, blend_of_dodge(base, top), opacity);
}

/// Blend Difference
///
/// |base - top|; black changes nothing. W3C 2015, "Compositing and Blending Level 1".
/// @node color/blend_difference   @also layer, compare
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - top: the colour above [0,0,0; 0..1; color]
/// - opacity: of the upper one [1; 0..1]
/// - return: the blend
fn node_color_blend_difference(base: vec3f, top: vec3f, opacity: f32) -> vec3f {
    return mix(base, abs(base - top), opacity);
}
