//! How much of an environment's reflection the surface itself hides: under an occlusion map, and below the horizon of the
//! geometry where a normal map turns the shading normal. The environment is taken as uniform.
//!
//! Twins of the functions of `shaders/ibl/occlusion.wgsl`.

use halfvector_brdf::Real;

/// a + (b - a) t as WGSL's `mix` has it.
fn mix<R: Real>(a: R, b: R, t: R) -> R {
    a * (R::ONE - t) + b * t
}

fn saturate<R: Real>(x: R) -> R {
    x.clamp(R::ZERO, R::ONE)
}

/// 0 below -width, 1 above width, a cubic step between.
pub fn smooth_step_about_zero<R: Real>(x: R, width: R) -> R {
    let t = saturate(R::of(0.5) + R::of(0.5) * x / width);
    t * t * (R::of(3.0) - R::of(2.0) * t)
}

/// The part of the specular lobe that a cone about the normal leaves. `occlusion` is the open part of the cosine-weighted
/// hemisphere, and the cone's half angle t has cos t = sqrt(1 - occlusion) (Jimenez et al. 2016, "Practical Real-Time
/// Strategies for Accurate Indirect Occlusion"). A narrow lobe is inside or not, with a smooth step about the mirror
/// direction, whose cosine is n.v; a wide one is hidden as diffuse light is. The constants are fitted to the integral.
///
/// Domain: all in [0, 1]. occlusion = 1 gives 1, 0 gives 0.
/// Error against the integral of GGX inside the cone: 0.045 rms, 0.32 max (the occlusion itself: 0.23 and 0.96).
pub fn specular_occlusion_cone<R: Real>(n_dot_v: R, occlusion: R, perceptual_roughness: R) -> R {
    let open = saturate(occlusion);
    let alpha = perceptual_roughness * perceptual_roughness;
    let edge = (R::ONE - open).sqrt();
    let edge2 = edge * edge;
    let edge4 = edge2 * edge2;
    // 0 for a closed cone, which hides narrow lobes too.
    let spread = R::ONE - edge4 * edge4;
    let width =
        ((R::of(1.027) * perceptual_roughness - R::of(0.0688)) * spread).min(R::of(2.0) * edge).max(R::of(1e-4));
    // The small numbers make a whole hemisphere 1 and none 0, at any n.v.
    let inside = n_dot_v + R::of(1e-4) - R::of(1.001) * edge + R::of(0.0548) * alpha * spread;
    mix(smooth_step_about_zero(inside, width), open, saturate(R::of(2.053) * alpha))
}

/// Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.10.2:
/// saturate((n.v + occlusion)^(2^(-16 r - 1)) - 1 + occlusion).
/// Error against the integral of GGX inside the cone of [`specular_occlusion_cone`]: 0.23 rms, 0.98 max.
pub fn specular_occlusion_lagarde<R: Real>(n_dot_v: R, occlusion: R, perceptual_roughness: R) -> R {
    let power = (R::of(-16.0) * perceptual_roughness - R::ONE).exp2();
    saturate((n_dot_v + occlusion).powf(power) - R::ONE + occlusion)
}

/// The part of the specular lobe above the geometry's horizon, where the shading normal n is not the geometric normal g;
/// r is the mirror direction about n. The lobe's middle moves from r to n as it widens; the part above g's horizon is a
/// smooth step of the middle's height over it, divided by the part above n's own, which the lobe has lost already.
/// The constants are fitted to the integral.
///
/// Domain: cosines r.g in [-1, 1], n.g and n.v in [0, 1], perceptual roughness in [0, 1]. n = g gives 1.
/// Error against the integral of GGX for tilts up to 60 degrees: 0.030 rms, 0.19 max (none: 0.26 and 1).
pub fn horizon_cone<R: Real>(r_dot_g: R, n_dot_g: R, n_dot_v: R, perceptual_roughness: R) -> R {
    let alpha = perceptual_roughness * perceptual_roughness;
    let wide = (R::of(1.226) * alpha).min(R::ONE);
    let width = (R::of(0.659) * alpha + R::of(1.23) * perceptual_roughness - R::of(0.0717)).max(R::of(0.01));
    let sunk = R::of(0.379) * alpha;
    let above = smooth_step_about_zero(mix(r_dot_g, n_dot_g, wide) - sunk, width);
    let own = smooth_step_about_zero(mix(n_dot_v, R::ONE, wide) - sunk, width);
    // Where n = g both are one number; the floor keeps inputs outside of the domain finite.
    (above / own.max(R::of(1e-6))).min(R::ONE)
}

/// Lagarde and de Rousiers 2014, as in Filament: saturate(1 + r.g)^2.
/// Error against the integral of GGX for tilts up to 60 degrees: 0.17 rms, 0.90 max.
pub fn horizon_squared<R: Real>(r_dot_g: R, _n_dot_g: R, _n_dot_v: R, _perceptual_roughness: R) -> R {
    let above = saturate(R::ONE + r_dot_g);
    above * above
}
