// GGX stretched along the tangent: D and V for two widths, alpha_t along the tangent and alpha_b along the bitangent.
// Vectors are unit, in the tangent frame: (tangent, bitangent, normal).

// Smallest denominator of D's root: reached only for alphas below 1e-9, makes the 0 / 0 of alpha = 0 a 0.
const D_ANISOTROPIC_FLOOR: f32 = 1e-36;
// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0.
const V_ANISOTROPIC_FLOOR: f32 = 1e-36;

/// Burley 2012, Physically-Based Shading at Disney (appendix B); Heitz 2014, equation 85:
/// D = 1 / (pi alpha_t alpha_b ((t.h / alpha_t)^2 + (b.h / alpha_b)^2 + (n.h)^2)^2).
///
/// With s = alpha_t alpha_b and w = s / ((alpha_b t.h)^2 + (alpha_t b.h)^2 + (s n.h)^2) it is s w^2 / pi: no alpha is
/// divided by, and no square leaves f32 (w <= 1 / s).
fn d_ggx_anisotropic(h_in_tangent: vec3f, alpha_t: f32, alpha_b: f32) -> f32 {
    let s = alpha_t * alpha_b;
    let q = h_in_tangent * vec3f(alpha_b, alpha_t, s);
    let w = s / max(dot(q, q), D_ANISOTROPIC_FLOOR);
    return s * w * (w * INV_PI);
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equations 86 and 99 over 4 n.l n.v:
/// V = 1/2 / (n.l |(alpha_t t.v, alpha_b b.v, n.v)| + n.v |(alpha_t t.l, alpha_b b.l, n.l)|).
fn v_smith_ggx_anisotropic(view_in_tangent: vec3f, light_in_tangent: vec3f, alpha_t: f32, alpha_b: f32) -> f32 {
    let widths = vec3f(alpha_t, alpha_b, 1.0);
    let view = light_in_tangent.z * length(view_in_tangent * widths);
    let light = view_in_tangent.z * length(light_in_tangent * widths);
    return 0.5 / max(view + light, V_ANISOTROPIC_FLOOR);
}
