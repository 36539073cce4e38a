//! The surface at one point as what it does with light: all lobes together, evaluated, sampled, and their density.
//!
//! Lobes, their order and what layers leave to what lies below are those of the generated shaders; what those look up in
//! filtered environments is integrated here.

use halfvector_brdf::anisotropic::d_ggx_anisotropic;
use halfvector_brdf::coupling::{coupling_colored, coupling_compensated, coupling_light, coupling_single};
use halfvector_brdf::frame::{Frame, Half, frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::f0_from_ior;
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx};
use halfvector_brdf::lobe_anisotropic::{anisotropic_alphas_gltf, anisotropic_tangent};
use halfvector_brdf::lobe_coat::{Coat, coat_base, coat_eval};
use halfvector_brdf::lobe_multiscatter::{Multiscatter, multiscatter_eval, multiscatter_from_dfg};
use halfvector_brdf::lobe_sampling::{
    anisotropic_pdf, anisotropic_sample, diffuse_pdf, diffuse_sample, sheen_pdf, sheen_sample, specular_pdf,
    specular_sample, transmission_pdf, transmission_sample, transmission_thin_pdf, transmission_thin_sample,
};
use halfvector_brdf::lobe_sheen::{Sheen, sheen_base, sheen_eval};
use halfvector_brdf::lobe_thin_film::{
    ThinFilm, thin_film_cosine, thin_film_fresnel, thin_film_shift, thin_film_through,
};
use halfvector_brdf::lobe_transmission::{
    Transmission, f0_of_sheet, transmission_compensation, transmission_eval, transmission_thin_compensation,
    transmission_thin_eval,
};
use halfvector_brdf::math::{finite_or_zero, normalize_or};
use halfvector_brdf::metallic_roughness::{diffuse_color, f0_from_metallic};
use halfvector_brdf::sampling_bounded::area_ggx_bounded;
use halfvector_brdf::vector::{add, cross, dot, mul, scale};

use crate::material::Surface;
use crate::model::{Coupling, Model};

/// The smallest alpha: a mirror to 15 digits.
const ALPHA_FLOOR: f64 = 1e-8;

/// What an index is off 1 by at least: a body that bends nothing has all its light in one direction, which no density can say. At this
/// much a ray is turned by 0.06 degrees at most up to 45 degrees, and a quarter of a millionth of it is reflected.
const LEAST_BENDING: f64 = 1e-3;

/// An index that bends, the one asked for or the nearest.
fn bending(ior: f64) -> f64 {
    if (ior - 1.0).abs() >= LEAST_BENDING { ior } else { 1.0 + LEAST_BENDING.copysign(ior - 1.0) }
}
/// The least n.v that the samplers take.
const N_DOT_V_LEAST: f64 = 1e-6;
/// The least share of the samples that a lobe gets which is there at all.
const SHARE_FLOOR: f64 = 0.05;

/// A shading normal with two directions across it.
#[derive(Clone, Copy, Debug)]
struct Basis {
    frame: Frame<f64>,
    tangent: [f64; 3],
    bitangent: [f64; 3],
    /// The viewer in the basis, lifted to the domain of the samplers.
    view: [f64; 3],
}

impl Basis {
    fn new(normal: [f64; 3], view_dir: [f64; 3]) -> Basis {
        let [x, y, z] = normal;
        // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        Basis::along(normal, [1.0 + sign * x * x * a, sign * b, -sign * x], view_dir)
    }

    /// With a unit tangent across the normal that is given.
    fn along(normal: [f64; 3], tangent: [f64; 3], view_dir: [f64; 3]) -> Basis {
        let bitangent = cross(normal, tangent);
        let (u, v) = (dot(tangent, view_dir), dot(bitangent, view_dir));
        let w = dot(normal, view_dir).max(N_DOT_V_LEAST);
        let length = (u * u + v * v + w * w).sqrt();
        Basis { frame: frame_from_normal(normal, view_dir), tangent, bitangent, view: [u, v, w].map(|x| x / length) }
    }

    fn local(&self, dir: [f64; 3]) -> [f64; 3] {
        [dot(self.tangent, dir), dot(self.bitangent, dir), dot(self.frame.normal, dir)]
    }

    fn world(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        add(add(scale(self.tangent, x), scale(self.bitangent, y)), scale(self.frame.normal, z))
    }
}

/// Lobes that directions are drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lobe {
    Diffuse,
    Specular,
    Coat,
    Sheen,
    Transmission,
}

/// All lobes of a point.
pub(crate) struct Bsdf<'m> {
    model: &'m Model,
    base: Basis,
    coat_basis: Basis,
    perceptual_roughness: f64,
    diffuse: [f64; 3],
    /// f0 and f90 of the interface over the diffuse base.
    dielectric: [f64; 2],
    f0: [f64; 3],
    f90: [f64; 3],
    /// Widths along the basis' tangent and across it; the same where the surface is not brushed.
    alphas: [f64; 2],
    /// What half of D is divided by for the specular lobe's density; 0 where that is not by D: a brushed surface, or one seen
    /// from behind its normal.
    specular_area: f64,
    /// The roughness of the specular lobe's albedo.
    specular_roughness: f64,
    film: Option<ThinFilm<f64>>,
    compensation: [f64; 3],
    multiscatter: Option<Multiscatter<f64>>,
    coat: Option<Coat<f64>>,
    sheen: Option<Sheen<f64>>,
    transmission: Option<Transmission<f64>>,
    /// What brings back what single scattering loses of the light that passes.
    transmission_gain: f64,
    /// A sheet, which light leaves as it came, and not a body.
    is_sheet: bool,
    under_coat: [f64; 3],
    under_sheen: f64,
    /// Radiance of its own.
    pub(crate) emission: [f64; 3],
    /// Lobes with their shares of the samples; the shares' sum is 1.
    shares: [(Lobe, f64); 5],
}

impl<'m> Bsdf<'m> {
    /// `tangent` is the mesh's, with its handedness; only a brushed surface looks at it. `sheet`: transmission is that of a thin
    /// wall.
    #[inline(always)]
    pub(crate) fn new(
        model: &'m Model,
        surface: &Surface,
        view_dir: [f64; 3],
        tangent: [f64; 4],
        sheet: bool,
    ) -> Bsdf<'m> {
        let r = surface.perceptual_roughness;
        let floored = |r: f64| alpha_from_perceptual_roughness(r).max(ALPHA_FLOOR);
        let mut base = Basis::new(surface.normal, view_dir);
        let (mut alphas, mut specular_roughness) = ([floored(r); 2], r);
        if surface.anisotropy > 0.0 {
            let tangent = anisotropic_tangent(surface.normal, tangent, surface.anisotropy_rotation);
            base = Basis::along(surface.normal, tangent, view_dir);
            alphas = anisotropic_alphas_gltf(r, surface.anisotropy).map(|alpha| alpha.max(ALPHA_FLOOR));
            specular_roughness = (alphas[0] * alphas[1]).sqrt().sqrt();
        }
        let n_dot_v = base.frame.n_dot_v;
        let through = surface.transmission_weight * (1.0 - surface.metallic.clamp(0.0, 1.0));
        let is_sheet = sheet && through > 0.0;
        let mut dielectric = [f0_from_ior(surface.ior) * surface.specular, surface.specular];
        if is_sheet {
            dielectric[0] = f0_of_sheet(dielectric[0], surface.transmission_weight);
        }
        let f0 = f0_from_metallic(surface.base_color, surface.metallic, dielectric[0]);
        let f90 = [surface.specular + (1.0 - surface.specular) * surface.metallic; 3];
        let f90 = if model.conductor.is_some() { [1.0; 3] } else { f90 };
        let color = diffuse_color(surface.base_color, surface.metallic);
        let has_specular = model.conductor.is_some() || f0.iter().chain(&f90).any(|f| *f > 0.0);
        let has_diffuse = color.iter().any(|c| *c > 0.0);
        let film = ThinFilm {
            weight: surface.thin_film_weight,
            thickness: 1000.0 * surface.thin_film_thickness,
            ior: surface.thin_film_ior,
        };
        let film = Some(film).filter(|film| film.weight > 0.0 && has_specular && model.conductor.is_none());

        let couples = has_diffuse && dielectric[1] > 0.0 && model.coupling != Coupling::None;
        let reads_dfg = has_specular && (model.compensates() || couples || film.is_some());
        let dfg = if reads_dfg { model.dfg(n_dot_v, specular_roughness) } else { [1.0, 0.0] };
        // What the film adds to the reflectance of the whole lobe, and of its dielectric part alone.
        let cosine = thin_film_cosine(dfg);
        let shift = |f0: [f64; 3], f90: [f64; 3]| film.map_or([0.0; 3], |film| thin_film_shift(f0, f90, film, cosine));
        let added = shift(f0, f90);
        let (of_base, at_grazing) = ([dielectric[0]; 3], [dielectric[1]; 3]);
        let below = shift(of_base, at_grazing);

        let mut diffuse = scale(color, 1.0 - surface.transmission_weight);
        if couples && film.is_some() {
            diffuse = mul(diffuse, coupling_colored(add(of_base, below), add(at_grazing, below), dfg));
        } else if couples {
            let share = if model.compensates() { coupling_compensated::<f64> } else { coupling_single::<f64> };
            diffuse = scale(diffuse, share(dielectric[0], dielectric[1], dfg));
        }
        let mut passes = scale(color, surface.transmission_weight);
        if film.is_some() {
            passes = mul(passes, thin_film_through(below, of_base, at_grazing, cosine));
        }
        let eta = if is_sheet { surface.ior } else { bending(surface.ior) };
        let transmission = (through > 0.0).then(|| Transmission { color: passes, eta, alpha: floored(r) });
        let transmission_gain = match transmission {
            Some(_) if model.compensates() && is_sheet => {
                transmission_thin_compensation(dielectric[0], model.dfg(n_dot_v, specular_roughness))
            }
            Some(lobe) if model.compensates() => transmission_compensation(n_dot_v, lobe),
            _ => 1.0,
        };
        let (lit_f0, lit_f90) = (add(f0, added), add(f90, added));
        let compensation = model.compensation.map_or([1.0; 3], |factor| factor(lit_f0, lit_f90, dfg));
        let multiscatter = (model.multiscatter && has_specular)
            .then(|| multiscatter_from_dfg(lit_f0, lit_f90, dfg, specular_roughness));

        let mut made = Bsdf {
            model,
            base,
            coat_basis: base,
            perceptual_roughness: r,
            diffuse,
            dielectric,
            f0,
            f90,
            alphas,
            specular_area: 0.0,
            specular_roughness,
            film,
            compensation,
            multiscatter,
            coat: None,
            sheen: None,
            transmission,
            transmission_gain,
            is_sheet,
            under_coat: [1.0; 3],
            under_sheen: 1.0,
            emission: surface.emission,
            shares: [(Lobe::Diffuse, 0.0); 5],
        };
        if surface.coat_weight > 0.0 {
            made.coat_basis = Basis::new(surface.coat_normal, view_dir);
            let coat = Coat {
                weight: surface.coat_weight,
                color: surface.coat_color,
                f0: f0_from_ior(surface.coat_ior),
                alpha: floored(surface.coat_roughness),
            };
            let n_dot_v = made.coat_basis.frame.n_dot_v;
            made.under_coat = coat_base(coat, n_dot_v, model.dfg(n_dot_v, surface.coat_roughness));
            made.coat = Some(coat);
        }
        if surface.sheen_color.iter().any(|c| *c > 0.0) {
            let sheen = Sheen { color: surface.sheen_color, perceptual_roughness: surface.sheen_roughness };
            made.under_sheen = sheen_base(sheen, n_dot_v);
            made.sheen = Some(sheen);
        }
        made.emission = mul(surface.emission, scale(made.under_coat, made.under_sheen));
        if has_specular && alphas[0] == alphas[1] && dot(surface.normal, view_dir) >= N_DOT_V_LEAST {
            made.specular_area = area_ggx_bounded(base.view, alphas[0], alphas[1]);
        }
        made.share(has_specular);
        made
    }

    /// Gives each lobe its share of the samples: by what it may reflect.
    fn share(&mut self, has_specular: bool) {
        let most = |c: [f64; 3]| c[0].max(c[1]).max(c[2]).max(0.0);
        let n_dot_v = self.base.frame.n_dot_v;
        let grazing = (1.0 - n_dot_v).powi(5);
        let bare: [f64; 3] = std::array::from_fn(|i| self.f0[i] + (self.f90[i] - self.f0[i]).max(0.0) * grazing);
        let reflected = most(self.film.map_or(bare, |film| thin_film_fresnel(self.f0, self.f90, film, n_dot_v)));
        let below = most(self.under_coat) * self.under_sheen;
        let multiscatter = self.multiscatter.map_or(0.0, |lobe| most(lobe.color) * lobe.loss);
        let weights = [
            (Lobe::Diffuse, (most(self.diffuse) + multiscatter) * below),
            (Lobe::Specular, if has_specular { (reflected * below).max(SHARE_FLOOR) } else { 0.0 }),
            (Lobe::Coat, self.coat.map_or(0.0, |coat| (coat.weight * (coat.f0 + grazing)).max(SHARE_FLOOR))),
            (Lobe::Sheen, self.sheen.map_or(0.0, |sheen| (0.5 * most(sheen.color)).max(SHARE_FLOOR))),
            (Lobe::Transmission, self.transmission.map_or(0.0, |lobe| (most(lobe.color) * below).max(SHARE_FLOOR))),
        ];
        let total: f64 = weights.iter().map(|(_, weight)| weight).sum();
        if total > 0.0 {
            self.shares = weights.map(|(lobe, weight)| (lobe, weight / total));
        }
    }

    /// Whether any lobe is there.
    pub(crate) fn reflects(&self) -> bool {
        self.shares.iter().any(|(_, share)| *share > 0.0)
    }

    /// The shading normal.
    pub(crate) fn normal(&self) -> [f64; 3] {
        self.base.frame.normal
    }

    /// BSDF times |n.l| of all lobes, [1/sr].
    pub(crate) fn eval(&self, l: [f64; 3]) -> [f64; 3] {
        self.eval_half(l, &half_from_light(self.base.frame, l))
    }

    /// The same, and the density at which [`Self::sample`] draws the direction [1/sr]; 0 for no direction.
    pub(crate) fn eval_with_density(&self, l: [f64; 3]) -> ([f64; 3], f64) {
        let n_dot_l = dot(self.base.frame.normal, l);
        if n_dot_l <= 0.0 && self.transmission.is_none() && self.coat.is_none() {
            return ([0.0; 3], 0.0);
        }
        let half = half_from_light(self.base.frame, l);
        (self.eval_half(l, &half), self.density(l, n_dot_l, &half))
    }

    fn eval_half(&self, l: [f64; 3], half: &Half<f64>) -> [f64; 3] {
        let frame = self.base.frame;
        let mut base = [0.0; 3];
        if half.n_dot_l > 0.0 {
            base = add(self.eval_diffuse(half), self.eval_specular(half, l));
            if let Some(lobe) = self.multiscatter {
                let dfg = self.model.dfg(half.n_dot_l, self.specular_roughness);
                base = add(base, multiscatter_eval(frame, l, lobe, dfg));
            }
        } else if let Some(lobe) = self.transmission {
            base = if self.is_sheet {
                scale(transmission_thin_eval(frame, l, lobe), self.transmission_gain)
            } else {
                // What enters a body is compressed by eta^2, and leaves it again.
                scale(transmission_eval(frame, l, lobe), self.transmission_gain * lobe.eta * lobe.eta)
            };
        }
        let mut sum = mul(base, scale(self.under_coat, self.under_sheen));
        if let Some(coat) = self.coat {
            sum = add(sum, scale(coat_eval(self.coat_basis.frame, l, coat), self.under_sheen));
        }
        if let Some(sheen) = self.sheen {
            sum = add(sum, sheen_eval(frame, l, sheen));
        }
        finite_or_zero(sum)
    }

    fn eval_diffuse(&self, half: &Half<f64>) -> [f64; 3] {
        if self.diffuse == [0.0; 3] {
            return [0.0; 3];
        }
        let frame = self.base.frame;
        let brdf =
            (self.model.diffuse)(self.diffuse, frame.n_dot_v, half.n_dot_l, half.l_dot_h, self.perceptual_roughness);
        let mut part = scale(brdf, half.n_dot_l);
        if self.model.coupling == Coupling::Reciprocal && self.dielectric[1] > 0.0 {
            let dfg = self.model.dfg(half.n_dot_l, self.specular_roughness);
            let [f0, f90] = self.dielectric;
            part = scale(part, coupling_light(f0, f90, dfg, self.specular_roughness));
        }
        finite_or_zero(part)
    }

    fn eval_specular(&self, half: &Half<f64>, l: [f64; 3]) -> [f64; 3] {
        let frame = self.base.frame;
        let [alpha, across] = self.alphas;
        let (d, v);
        if alpha == across {
            d = (self.model.d)(half.n_dot_h, half.sin2_theta_h, alpha);
            v = (self.model.v)(frame.n_dot_v, half.n_dot_l, half.l_dot_h, alpha);
        } else {
            let with_normal = |[x, y, _]: [f64; 3], z: f64| [x, y, z];
            let h = self.base.local(normalize_or(add(frame.view_dir, l), [0.0; 3]));
            let (view, light) = (self.base.local(frame.view_dir), self.base.local(l));
            let [h, view, light] = [(h, half.n_dot_h), (view, frame.n_dot_v), (light, half.n_dot_l)]
                .map(|(dir, cosine)| with_normal(dir, cosine));
            d = d_ggx_anisotropic(h, alpha, across);
            v = (self.model.v_brushed)(view, light, alpha, across);
        }
        let f = match self.film {
            Some(film) => thin_film_fresnel(self.f0, self.f90, film, half.l_dot_h),
            None => self.model.reflectance(self.f0, self.f90, half.l_dot_h),
        };
        finite_or_zero(mul(scale(f, v * half.n_dot_l * d), self.compensation))
    }

    /// A direction for a number that chooses the lobe and two that place the direction. It may carry no light.
    pub(crate) fn sample(&self, choice: f64, u: [f64; 2]) -> [f64; 3] {
        let mut rest = choice;
        let mut chosen = None;
        for (lobe, share) in self.shares {
            if share > 0.0 {
                chosen = Some(lobe);
                if rest < share {
                    break;
                }
            }
            rest -= share;
        }
        // What leaves through the wrong side of its lobe's surface carries no light.
        let (basis, local, side) = match (chosen, self.transmission) {
            (Some(Lobe::Specular), _) => (&self.base, anisotropic_sample(self.base.view, self.alphas, u), 1.0),
            (Some(Lobe::Coat), _) => {
                (&self.coat_basis, specular_sample(self.coat_basis.view, self.coat_alpha(), u), 1.0)
            }
            (Some(Lobe::Sheen), _) => (&self.base, sheen_sample(self.base.view, u), 1.0),
            (Some(Lobe::Transmission), Some(lobe)) if self.is_sheet => {
                (&self.base, transmission_thin_sample(self.base.view, lobe.alpha, u), -1.0)
            }
            (Some(Lobe::Transmission), Some(lobe)) => (&self.base, transmission_sample(self.base.view, lobe, u), -1.0),
            _ => (&self.base, diffuse_sample(self.base.view, u), 1.0),
        };
        if local[2] * side > 0.0 { basis.world(local) } else { [0.0; 3] }
    }

    fn coat_alpha(&self) -> f64 {
        self.coat.map_or(1.0, |coat| coat.alpha)
    }

    fn density(&self, l: [f64; 3], n_dot_l: f64, half: &Half<f64>) -> f64 {
        let (above, view) = (n_dot_l > 0.0, self.base.view);
        let mut sum = 0.0;
        for (lobe, share) in self.shares {
            if share == 0.0 {
                continue;
            }
            let density = match (lobe, self.transmission) {
                (Lobe::Specular, _) if above && self.specular_area > 0.0 => {
                    0.5 * d_ggx(half.n_dot_h, half.sin2_theta_h, self.alphas[0]) / self.specular_area
                }
                (Lobe::Specular, _) if above => anisotropic_pdf(view, self.base.local(l), self.alphas),
                (Lobe::Diffuse, _) if above => diffuse_pdf(view, self.base.local(l)),
                (Lobe::Sheen, _) if above => sheen_pdf(view, self.base.local(l)),
                (Lobe::Transmission, Some(lobe)) if n_dot_l < 0.0 && self.is_sheet => {
                    transmission_thin_pdf(view, self.base.local(l), lobe.alpha)
                }
                (Lobe::Transmission, Some(lobe)) if n_dot_l < 0.0 => transmission_pdf(view, self.base.local(l), lobe),
                (Lobe::Coat, _) => {
                    let local = self.coat_basis.local(l);
                    if local[2] > 0.0 { specular_pdf(self.coat_basis.view, local, self.coat_alpha()) } else { 0.0 }
                }
                _ => 0.0,
            };
            sum += share * density;
        }
        sum
    }
}

/// A direction across a normal, and a second one.
pub(crate) fn across(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let basis = Basis::new(normal, normal);
    [basis.tangent, cross(normal, basis.tangent)]
}

#[cfg(test)]
mod tests;
