//! Which terms a surface is shaded with: the scene's methods, or another renderer's model.

use halfvector_brdf::anisotropic::v_smith_ggx_anisotropic;
use halfvector_brdf::beckmann::{d_beckmann, v_smith_beckmann_correlated, v_smith_beckmann_separable};
use halfvector_brdf::diffuse::{diffuse_burley, diffuse_eon_exact, diffuse_fon, diffuse_lambert, diffuse_oren_nayar};
use halfvector_brdf::fresnel::{f_conductor, f_exact, f_schlick};
use halfvector_brdf::ggx::{d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::multiscatter::{energy_compensation, energy_compensation_fdez_aguera};
use halfvector_brdf::sheen::v_neubelt;
use halfvector_brdf::vector::dot;
use halfvector_brdf::visibility::{v_cook_torrance, v_hammon, v_kelemen, v_schlick_smith};
use halfvector_graph::method::Methods;

use crate::albedo::Albedo;

/// A metal's measured index of refraction, for each of red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Real part.
    pub eta: [f64; 3],
    /// Extinction.
    pub k: [f64; 3],
}

type Distribution = fn(f64, f64, f64) -> f64;
type Visibility = fn(f64, f64, f64, f64) -> f64;
/// View and light in the tangent frame, and the two widths.
type BrushedVisibility = fn([f64; 3], [f64; 3], f64, f64) -> f64;
type Diffuse = fn([f64; 3], f64, f64, f64, f64) -> [f64; 3];
type Fresnel = fn([f64; 3], [f64; 3], f64) -> [f64; 3];
type Compensation = fn([f64; 3], [f64; 3], [f64; 2]) -> [f64; 3];

/// What the interface leaves to the diffuse base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coupling {
    None,
    View,
    Reciprocal,
}

/// The terms.
pub(crate) struct Model {
    pub(crate) d: Distribution,
    pub(crate) v: Visibility,
    /// The brushed lobe's: Smith's form, correlated or separable.
    pub(crate) v_brushed: BrushedVisibility,
    pub(crate) fresnel: Fresnel,
    pub(crate) diffuse: Diffuse,
    pub(crate) compensation: Option<Compensation>,
    /// Kulla and Conty's lobe.
    pub(crate) multiscatter: bool,
    pub(crate) coupling: Coupling,
    pub(crate) conductor: Option<Conductor>,
    separable: bool,
}

impl Model {
    /// The terms that a scene's methods choose. Methods of how an environment is stored, filtered and looked up have no
    /// meaning here: the reference integrates it.
    pub(crate) fn new(methods: &Methods, conductor: Option<Conductor>) -> Model {
        let d: Distribution = if methods.is("d", "beckmann") { d_beckmann::<f64> } else { d_ggx::<f64> };
        let v: Visibility = match methods.get("v").name {
            "separable" => v_smith_ggx_separable::<f64>,
            "hammon" => v_hammon::<f64>,
            "schlick_smith" => v_schlick_smith::<f64>,
            "cook_torrance" => v_cook_torrance::<f64>,
            "kelemen" => v_kelemen::<f64>,
            "neubelt" => v_neubelt::<f64>,
            "beckmann_correlated" => v_smith_beckmann_correlated::<f64>,
            "beckmann_separable" => v_smith_beckmann_separable::<f64>,
            _ => v_smith_ggx_correlated::<f64>,
        };
        let separable = methods.is("v", "separable");
        let diffuse: Diffuse = match methods.get("diffuse").name {
            "burley" => diffuse_burley::<f64>,
            "oren_nayar" => diffuse_oren_nayar::<f64>,
            "fon" => diffuse_fon::<f64>,
            "eon" => diffuse_eon_exact::<f64>,
            _ => diffuse_lambert::<f64>,
        };
        let fresnel: Fresnel = if methods.is("fresnel", "exact") { f_exact::<f64> } else { f_schlick::<f64> };
        let compensation: Option<Compensation> = match methods.get("compensation").name {
            "none" | "kulla_conty" => None,
            "fdez_aguera" => Some(energy_compensation_fdez_aguera::<f64>),
            _ => Some(energy_compensation::<f64>),
        };
        let coupling = match methods.get("coupling").name {
            "none" => Coupling::None,
            "reciprocal" => Coupling::Reciprocal,
            _ => Coupling::View,
        };
        Model {
            d,
            v,
            v_brushed: if separable { v_separable_anisotropic } else { v_smith_ggx_anisotropic::<f64> },
            fresnel,
            diffuse,
            compensation,
            multiscatter: methods.is("compensation", "kulla_conty"),
            coupling,
            conductor,
            separable,
        }
    }

    /// Whether the lobe's multiple scattering is given back in any way.
    pub(crate) fn compensates(&self) -> bool {
        self.compensation.is_some() || self.multiscatter
    }

    /// Fresnel reflectance of the specular lobe.
    pub(crate) fn reflectance(&self, f0: [f64; 3], f90: [f64; 3], l_dot_h: f64) -> [f64; 3] {
        match &self.conductor {
            Some(metal) => std::array::from_fn(|i| f_conductor(metal.eta[i], metal.k[i], l_dot_h)),
            None => (self.fresnel)(f0, f90, l_dot_h),
        }
    }

    /// The pair (a, b) of the GGX lobe's directional albedo f0 a + f90 b.
    pub(crate) fn dfg(&self, n_dot_v: f64, perceptual_roughness: f64) -> [f64; 2] {
        Albedo::of(self.separable).pair(n_dot_v, perceptual_roughness)
    }
}

/// Smith's separable form for two widths, G1(v) G1(l) over 4 n.l n.v, with G1(w) = 2 n.w / (n.w + |(alpha_t t.w, alpha_b
/// b.w, n.w)|): Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equation 23, stretched as
/// Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", equation 86.
fn v_separable_anisotropic(view: [f64; 3], light: [f64; 3], alpha_t: f64, alpha_b: f64) -> f64 {
    let part = |w: [f64; 3]| {
        let stretched = [alpha_t * w[0], alpha_b * w[1], w[2]];
        w[2] + dot(stretched, stretched).sqrt()
    };
    1.0 / (part(view) * part(light)).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two equal widths it is the separable form of one.
    #[test]
    fn the_brushed_form_is_the_round_one_where_it_is_not_brushed() {
        let unit = |z: f64, phi: f64| {
            let s = (1.0 - z * z).sqrt();
            [s * phi.cos(), s * phi.sin(), z]
        };
        for (alpha, v, l) in [(0.1, 0.9, 0.2), (0.5, 0.3, 0.7), (1.0, 0.01, 0.5)] {
            let brushed = v_separable_anisotropic(unit(v, 0.3), unit(l, 2.0), alpha, alpha);
            let round = v_smith_ggx_separable(v, l, 0.5, alpha);
            assert!((brushed / round - 1.0).abs() < 1e-12, "{alpha}: {brushed} {round}");
        }
    }
}
