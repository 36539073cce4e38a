//! From the artist's base colour and metallic to the two lobes' colours.
//! Burley 2012, Physically-Based Shading at Disney; glTF 2.0, appendix B.

use crate::Real;

/// Colour of the diffuse lobe: base_color (1 - metallic).
///
/// Domain: metallic in [0, 1]; exact at both ends.
#[inline]
pub fn diffuse_color<R: Real>(base_color: [R; 3], metallic: R) -> [R; 3] {
    base_color.map(|c| c * (R::ONE - metallic))
}

/// Reflectance at normal incidence: dielectric_f0 (1 - metallic) + base_color metallic.
///
/// Domain: all arguments in [0, 1]; exact at both ends of metallic.
#[inline]
pub fn f0_from_metallic<R: Real>(base_color: [R; 3], metallic: R, dielectric_f0: R) -> [R; 3] {
    base_color.map(|c| dielectric_f0 * (R::ONE - metallic) + c * metallic)
}
