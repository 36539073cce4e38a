//! A thin film on the base: what takes the place of the specular lobe's Fresnel term. OpenPBR 1.1 (Academy Software
//! Foundation 2024), section 3.6; Khronos 2022, KHR_materials_iridescence.
//!
//! The base is taken as a dielectric of the index that f0 / f90 implies; a metal's extinction turns the phase of its
//! reflection, which is not known from a colour.

use crate::Real;
use crate::fresnel::{f_schlick, ior_from_f0};
use crate::thin_film::f_thin_film_dielectric;

/// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both to nothing.
const FILM_F90_FLOOR: f64 = 1e-30;

/// Parameters of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinFilm<R> {
    /// Presence of the film in [0, 1].
    pub weight: R,
    /// Thickness [nm].
    pub thickness: R,
    /// Index of refraction.
    pub ior: R,
}

/// What the film adds to the reflectance at the cosine l.h of a base of reflectances f0 and f90:
/// weight (f90 F_film - F(f0, f90)). For the light of a whole lobe it is added to both f0 and f90: the split sum
/// (f0 + s) a + (f90 + s) b at [`thin_film_cosine`] is that of the film, and what multiple scattering and the base below make
/// of f0 and f90 is theirs, exactly, at weight 0.
///
/// Domain: f0 <= f90 in [0, 1], l.h in [0, 1], film as in [`f_thin_film_dielectric`]. In [-1, 1]; weight 0 is 0, exactly.
#[inline]
pub fn thin_film_shift<R: Real>(f0: [R; 3], f90: [R; 3], p: ThinFilm<R>, l_dot_h: R) -> [R; 3] {
    let eta = [0, 1, 2].map(|i| ior_from_f0(f0[i] / f90[i].max(R::of(FILM_F90_FLOOR))));
    let film = f_thin_film_dielectric(p.ior, p.thickness, eta, l_dot_h);
    let bare = f_schlick(f0, f90, l_dot_h);
    let weight = p.weight.clamp(R::ZERO, R::ONE);
    [0, 1, 2].map(|i| weight * (f90[i] * film[i] - bare[i]))
}

/// Reflectance at the cosine l.h, `p.weight` of the base under the film: F(f0, f90) + [`thin_film_shift`]. It takes the place
/// of f0 and of f90 in a lobe lit from one direction.
///
/// Domain: as [`thin_film_shift`]. Weight 0 is Schlick's F, exactly.
#[inline]
pub fn thin_film_fresnel<R: Real>(f0: [R; 3], f90: [R; 3], p: ThinFilm<R>, l_dot_h: R) -> [R; 3] {
    let shift = thin_film_shift(f0, f90, p, l_dot_h);
    let bare = f_schlick(f0, f90, l_dot_h);
    [0, 1, 2].map(|i| bare[i] + shift[i])
}

/// The cosine l.h at which Schlick's F is the lobe's mean, from the split-sum pair: b / (a + b) is the mean of
/// (1 - l.h)^5. An environment meets the film at it; on a smooth surface it is n.v.
///
/// Domain: a and b in [0, 1]. In [0, 1].
#[inline]
pub fn thin_film_cosine<R: Real>(dfg: [R; 2]) -> R {
    let mean = (dfg[1] / (dfg[0] + dfg[1]).max(R::of(1e-6))).clamp(R::of(1e-30), R::ONE);
    R::ONE - (R::of(0.2) * mean.log2()).exp2()
}

/// What a film that adds `shift` to the reflectance changes of the light that passes the base: (1 - F - shift) / (1 - F), all
/// at one cosine.
///
/// Held in [0, 4]: at grazing incidence both are 0.
#[inline]
pub fn thin_film_through<R: Real>(shift: [R; 3], f0: [R; 3], f90: [R; 3], l_dot_h: R) -> [R; 3] {
    let bare = f_schlick(f0, f90, l_dot_h);
    [0, 1, 2].map(|i| (R::ONE - shift[i] / (R::ONE - bare[i]).max(R::of(1e-3))).clamp(R::ZERO, R::of(4.0)))
}
