/// The outputs of the node color/over.
struct OverOutputs {
    /// colour of both, not multiplied by alpha
    color: vec3f,
    /// coverage of both
    alpha: f32,
}

/// Over
///
/// One colour with coverage laid over another. Porter and Duff 1984, "Compositing digital images", as in W3C 2015, "Compositing and
/// Blending Level 1", with colours that are not multiplied by their alpha:
///   alpha = a_top + a_base (1 - a_top),  color = (c_top a_top + c_base a_base (1 - a_top)) / alpha
/// Black where both alphas are 0. Alphas are held in 0..1.
/// @node color/over   @also alpha, composite, layer, decal
/// - base: the colour below [0.5,0.5,0.5; 0..1; color]
/// - base_alpha: its coverage [1; 0..1]
/// - top: the colour above [1,1,1; 0..1; color]
/// - top_alpha: its coverage [1; 0..1]
fn node_color_over(base: vec3f, base_alpha: f32, top: vec3f, top_alpha: f32) -> OverOutputs {
    let above = clamp(top_alpha, 0.0, 1.0);
    let below = clamp(base_alpha, 0.0, 1.0) * (1.0 - above);
    let alpha = above + below;
    let color = (top * above + base * below) / max(alpha, DIVISOR_FLOOR);
    return OverOutputs(select(vec3f(0.0), color, alpha > DIVISOR_FLOOR), alpha);
}
