// The operators of Porter and Duff 1984, "Compositing digital images", as in W3C 2015, "Compositing and Blending Level 1",
// section 8, beside color/over, for colours that are not multiplied by their alpha. Alphas are held in 0..1.

/// What an operator makes of two colours with coverage.
struct CompositeOutputs {
    /// the colour, not multiplied by alpha
    color: vec3f,
    /// its coverage
    alpha: f32,
}

/// The colour of two layers, with the part of each that is seen; black where nothing is.
fn composite(base: vec3f, base_part: f32, top: vec3f, top_part: f32) -> CompositeOutputs {
    let alpha = base_part + top_part;
    let color = (base * base_part + top * top_part) / max(alpha, DIVISOR_FLOOR);
    return CompositeOutputs(select(vec3f(0.0), color, alpha > DIVISOR_FLOOR), alpha);
}

/// In
///
/// The upper colour where the lower one is: alpha = a_top a_base. Porter and Duff 1984, "Compositing digital images". Called mask
/// where the roles are exchanged.
/// @node color/in   @also alpha, composite, mask, inside, source-in, clip
/// - base_alpha: coverage of what lies below [1; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [1; 0..1]
fn node_color_in(base_alpha: f32, top: vec3f, top_alpha: f32) -> CompositeOutputs {
    return composite(vec3f(0.0), 0.0, top, clamp(top_alpha, 0.0, 1.0) * clamp(base_alpha, 0.0, 1.0));
}

/// Out
///
/// The upper colour where the lower one is not: alpha = a_top (1 - a_base). Porter and Duff 1984, "Compositing digital images".
/// @node color/out   @also alpha, composite, held out, outside, source-out, stencil
/// - base_alpha: coverage of what lies below [0; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [1; 0..1]
fn node_color_out(base_alpha: f32, top: vec3f, top_alpha: f32) -> CompositeOutputs {
    return composite(vec3f(0.0), 0.0, top, clamp(top_alpha, 0.0, 1.0) * (1.0 - clamp(base_alpha, 0.0, 1.0)));
}

/// Atop
///
/// The upper colour over the lower one, seen only where the lower one is: alpha = a_base, color = mix(c_base, c_top, a_top).
/// Porter and Duff 1984, "Compositing digital images".
/// @node color/atop   @also alpha, composite, source-atop, matte, decal
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - base_alpha: its coverage [1; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [1; 0..1]
fn node_color_atop(base: vec3f, base_alpha: f32, top: vec3f, top_alpha: f32) -> CompositeOutputs {
    let above = clamp(top_alpha, 0.0, 1.0);
    let below = clamp(base_alpha, 0.0, 1.0);
    return composite(base, below * (1.0 - above), top, below * above);
}

/// Xor
///
/// Each colour where the other one is not: alpha = a_top (1 - a_base) + a_base (1 - a_top). Porter and Duff 1984, "Compositing
/// digital images".
/// @node color/xor   @also alpha, composite, exclusive or
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - base_alpha: its coverage [1; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [0; 0..1]
fn node_color_xor(base: vec3f, base_alpha: f32, top: vec3f, top_alpha: f32) -> CompositeOutputs {
    let above = clamp(top_alpha, 0.0, 1.0);
    let below = clamp(base_alpha, 0.0, 1.0);
    return composite(base, below * (1.0 - above), top, above * (1.0 - below));
}

/// Disjoint Over
///
/// One colour over another when both cover different parts of a pixel as long as there is room: nothing is hidden until the coverages
/// add up to 1.
///   alpha = min(a_top + a_base, 1),  color = (c_top a_top + c_base min(a_base, 1 - a_top)) / alpha
/// The OpenGL extension NV_blend_equation_advanced, SRC_OVER with DISJOINT.
/// @node color/disjoint_over   @also alpha, composite, layer, coverage
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - base_alpha: its coverage [0.5; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [0.5; 0..1]
fn node_color_disjoint_over(base: vec3f, base_alpha: f32, top: vec3f, top_alpha: f32) -> CompositeOutputs {
    let above = clamp(top_alpha, 0.0, 1.0);
    return composite(base, min(clamp(base_alpha, 0.0, 1.0), 1.0 - above), top, above);
}

/// Premultiply
///
/// color alpha: the form in which colours with coverage may be blurred, scaled and added.
/// @node color/premultiply   @also alpha, associated, premult
/// - color: not multiplied by alpha [1,1,1; 0..1; color]
/// - alpha: its coverage [1; 0..1]
/// - return: multiplied by alpha
fn node_color_premultiply(color: vec3f, alpha: f32) -> vec3f {
    return color * alpha;
}

/// Unpremultiply
///
/// color / alpha, the way back from color/premultiply; black where alpha is 0.
/// @node color/unpremultiply   @also alpha, unassociated, straight, unpremult
/// - color: multiplied by alpha [1,1,1; 0..1; color]
/// - alpha: its coverage [1; 0..1]
/// - return: not multiplied by alpha
fn node_color_unpremultiply(color: vec3f, alpha: f32) -> vec3f {
    return select(vec3f(0.0), color / max(alpha, DIVISOR_FLOOR), alpha > DIVISOR_FLOOR);
}
