//! The shading frame of a point, and the half vector of a light in it. Everything that a lobe asks of directions.

use crate::Real;
use crate::math::LENGTH2_FLOOR;
use crate::vector::{add, cross, dot, scale};

/// Smallest n.v: below the library's domain of cosines, which starts at 1e-6.
pub const N_DOT_V_FLOOR: f64 = 1e-7;

/// A shading normal and the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<R> {
    /// Shading normal in world space, unit.
    pub normal: [R; 3],
    /// From the surface to the viewer in world space, unit.
    pub view_dir: [R; 3],
    /// n.v in [1e-7, 1].
    pub n_dot_v: R,
}

/// The half vector h = (v + l) / |v + l| of one light, as the cosines that a microfacet lobe needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Half<R> {
    /// n.l in [0, 1]; 0 where the light is behind the surface.
    pub n_dot_l: R,
    /// n.h.
    pub n_dot_h: R,
    /// l.h = v.h in [0, 1].
    pub l_dot_h: R,
    /// sin^2 of the angle between n and h, as |n x h|^2.
    pub sin2_theta_h: R,
    /// h, unit; zero where there is none.
    pub h: [R; 3],
}

/// The frame of a unit shading normal and a unit direction to the viewer, with n.v held in [[`N_DOT_V_FLOOR`], 1].
///
/// A shading normal may face away from the viewer, where no BRDF is defined: such a point is shaded as seen at grazing
/// incidence. NaN in either vector gives n_dot_v = [`N_DOT_V_FLOOR`].
#[inline]
pub fn frame_from_normal<R: Real>(normal: [R; 3], view_dir: [R; 3]) -> Frame<R> {
    let n_dot_v = dot(normal, view_dir);
    Frame { normal, view_dir, n_dot_v: n_dot_v.clamp(R::of(N_DOT_V_FLOOR), R::ONE) }
}

/// The half vector of the unit direction `dir` to a light.
///
/// s = v + l,  l.h = |s| / 2,  n.h = n.s / |s|,  sin^2 = |n x s|^2 / |s|^2.
///
/// No term subtracts numbers of equal size but the cross product itself: 1 - (n.h)^2 has no correct digit left in f32
/// below an angle of 3e-4, and v.h by a dot product none where l is opposite to v. |s| / 2 is v.h for unit vectors only:
/// a length off by e moves it by e.
/// Where v + l = 0 there is no half vector: l.h = n.h = 0 and sin^2 = 1, which is h in the tangent plane.
#[inline]
pub fn half_from_light<R: Real>(frame: Frame<R>, dir: [R; 3]) -> Half<R> {
    let n_dot_l = dot(frame.normal, dir);
    let sum = add(frame.view_dir, dir);
    let length2 = dot(sum, sum);
    let has_half = R::of(LENGTH2_FLOOR).lt(length2);
    let inv_length = R::choose(has_half, R::ONE / length2.sqrt(), R::ZERO);
    let h = scale(sum, inv_length);
    let sine = cross(frame.normal, h);
    Half {
        n_dot_l: n_dot_l.clamp(R::ZERO, R::ONE),
        n_dot_h: dot(frame.normal, h),
        l_dot_h: R::of(0.5) * length2 * inv_length,
        sin2_theta_h: R::choose(has_half, dot(sine, sine), R::ONE),
        h,
    }
}
