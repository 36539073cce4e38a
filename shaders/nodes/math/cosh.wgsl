//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Hyperbolic Cosine
///
/// (e^x + e^-x) / 2, component by component: a hanging chain. x is held in -80..80, where it stays in f32.
/// @node math/cosh   @also hyperbolic, catenary
/// - x: value [0; -5..5]
/// - return: the hyperbolic cosine, at least 1
fn node_math_cosh(x: T) -> T {
    return cosh(clamp(x, T(-80.0), T(80.0)));
}
