//! What each lobe shows of an environment, as a shader computes it, against the integral of the lobe over every texel: the
//! lookups of the baked levels, the directions and widths of those lookups, and the split sum, all errors together. On the
//! two environments of our own. Nothing is timed here: what they cost is measured in their shaders (`shaders`).

use super::ibl::{direction, unit};
use super::split_sum::{cells, view};
use std::sync::{Mutex, PoisonError};

use crate::error::Errors;
use crate::{Row, Run};
use halfvector_brdf::frame::{Frame, frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_schlick, f0_from_ior};
use halfvector_brdf::lobe_anisotropic::{
    ANISOTROPIC_STRIPS, Anisotropic, anisotropic_alphas_gltf, anisotropic_environment, anisotropic_eval,
    anisotropic_reflection, anisotropic_strip,
};
use halfvector_brdf::lobe_coat::{Coat, coat_environment, coat_eval};
use halfvector_brdf::lobe_sheen::{Sheen, sheen_direction, sheen_environment, sheen_eval, sheen_ring};
use halfvector_brdf::lobe_specular::{Specular, specular_direction, specular_environment, specular_eval};
use halfvector_brdf::lobe_thin_film::{ThinFilm, thin_film_cosine, thin_film_fresnel};
use halfvector_brdf::lobe_transmission::{
    Transmission, f0_of_sheet, transmission_compensation, transmission_direction, transmission_environment,
    transmission_eval, transmission_lookup, transmission_thin_compensation, transmission_thin_eval,
};
use halfvector_ibl::environment::{environment_sample, environment_sample_hermite, lod_geometric};
use halfvector_ibl::occlusion::{horizon_cone, horizon_squared, specular_occlusion_cone, specular_occlusion_lagarde};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Equirect, LoadedEnvironment, Source, Visibility, bake, dfg, sky, studio,
};
use rayon::prelude::*;

/// Rows of the map that stands for the environment: both sides see it.
const ROWS: usize = 128;

const N_DOT_V: [f64; 3] = [0.2, 0.5, 0.9];
const ROUGHNESS: [f64; 4] = [0.2, 0.4, 0.7, 1.0];
/// Refraction narrows a lobe: below this roughness the map's texels are wider.
const ROUGHNESS_THROUGH: [f64; 3] = [0.4, 0.7, 1.0];
const ANISOTROPY: [f64; 3] = [0.3, 0.6, 0.9];
const IOR: [f64; 3] = [1.2, 1.5, 2.0];
/// Thickness [nm] and index of a film.
const FILMS: [[f64; 2]; 3] = [[250.0, 1.33], [400.0, 1.4], [600.0, 2.0]];
const OCCLUSION: [f64; 3] = [0.3, 0.6, 0.9];
/// Tilts of the shading normal from the geometry's, in degrees.
const TILT: [f64; 3] = [15.0, 30.0, 45.0];

/// Errors count against the true radiance, or this part of its mean over the domain where that is more: what lies in the
/// dark beside the rest is not seen.
const FLOOR: f64 = 0.1;

/// Gold, and a dielectric.
const F0: [[f64; 3]; 2] = [[1.0, 0.71, 0.29], [0.04; 3]];

/// What is measured beside the methods that shaders have.
const IN_NO_SHADER: [(&str, &str); 6] = [
    ("anisotropy", "round"),
    ("transmission", "refracted, width of a reflection"),
    ("transmission", "straight through"),
    ("thin_film", "at n.v"),
    ("thin_film", "f0 from n.v"),
    ("specular_occlusion", "none"),
];

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    const LOBES: [fn(&Light, usize) -> Vec<Row>; 9] =
        [specular, coat, sheen, anisotropy, transmission, thin_walled, thin_film, occlusion, horizon];
    let count = run.effort().pick(2, 12);
    let finished: Mutex<(usize, Vec<Row>)> = Mutex::default();
    let kept = |rows: Vec<Row>| {
        let mut finished = finished.lock().unwrap_or_else(PoisonError::into_inner);
        let (lobes, all) = &mut *finished;
        *lobes += 1;
        all.extend_from_slice(&rows);
        run.keep(all, *lobes as f64 / (2 * LOBES.len()) as f64);
        rows
    };
    let under = |(name, environment): (&'static str, LoadedEnvironment)| {
        let Source::Equirect(map) = &environment.source else { return Vec::new() };
        let light = Light::new(name, map.area_resampled(2 * ROWS, ROWS));
        LOBES.par_iter().flat_map_iter(|rows| kept(rows(&light, count))).collect::<Vec<_>>()
    };
    [("studio", studio()), ("sky", sky())].into_iter().flat_map(under).collect()
}

/// An environment: texel by texel, and baked.
struct Light {
    name: &'static str,
    cells: Vec<[f64; 6]>,
    baked: BakedEnvironment,
}

impl Light {
    fn new(name: &'static str, map: Equirect) -> Light {
        let cells = cells(&map);
        let baked = bake(&LoadedEnvironment::from(map), &BakeOptions { size: 256, ..BakeOptions::default() });
        Light { name, cells, baked }
    }

    /// Light times a lobe, summed over the sphere.
    fn integral(&self, lobe: impl Fn([f64; 3]) -> [f64; 3]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for &[x, y, z, r, g, b] in &self.cells {
            let weight = lobe([x, y, z]);
            for ((sum, weight), light) in sum.iter_mut().zip(weight).zip([r, g, b]) {
                *sum += weight * light;
            }
        }
        sum
    }

    /// The prefiltered environment as a shader reads it by default.
    fn radiance(&self, dir: [f64; 3], roughness: f64) -> [f64; 3] {
        let lod = lod_geometric(roughness, self.baked.radiance.len() as f64);
        environment_sample_hermite(&self.baked.radiance, &self.baked.slope, dir, lod).map(f64::from)
    }

    fn irradiance(&self, dir: [f64; 3]) -> [f64; 3] {
        environment_sample(std::slice::from_ref(&self.baked.irradiance_over_pi), dir, 0.0).map(f64::from)
    }

    /// What the sheen's ring does not see.
    fn last_but_one(&self, dir: [f64; 3]) -> [f64; 3] {
        environment_sample(&self.baked.radiance, dir, self.baked.radiance.len() as f64 - 2.0).map(f64::from)
    }

    /// A row for each method: its values against the truth.
    fn table<const N: usize>(
        &self,
        term: &str,
        what: &str,
        methods: [&str; N],
        cases: impl ParallelIterator<Item = Case<N>>,
    ) -> Vec<Row> {
        let cases: Vec<Case<N>> = cases.collect();
        let mean: [f64; 3] =
            std::array::from_fn(|c| cases.iter().map(|case| case.truth[c]).sum::<f64>() / cases.len() as f64);
        let mut errors: [Errors; N] = std::array::from_fn(|_| Errors::default());
        for Case { at, truth, values } in cases {
            for (errors, value) in errors.iter_mut().zip(values) {
                let error = |c: usize| (value[c] - truth[c]) / truth[c].max(FLOOR * mean[c]);
                errors.add_color(std::array::from_fn(error), || at.clone());
            }
        }
        let domain = format!(
            "{}: {what}, under this environment; error against the integral over every texel, relative to it or to \
             {FLOOR} of its mean over the domain",
            self.name
        );
        let row = |(method, errors): (&str, Errors)| {
            let mut row = Row::new(term, method, &domain);
            errors.fill(&mut row);
            if IN_NO_SHADER.contains(&(term, method)) {
                row.note = Some("no cost: no shader is made with it, it stands here to be compared".to_owned());
            }
            row
        };
        methods.into_iter().zip(errors).map(row).collect()
    }
}

/// One point of a domain.
struct Case<const N: usize> {
    at: String,
    truth: [f64; 3],
    /// What each method gives.
    values: [[f64; 3]; N],
}

/// Frames at each n.v, their normals spread evenly.
fn frames(count: usize) -> impl Iterator<Item = Frame<f64>> {
    (0..count * N_DOT_V.len()).map(|k| {
        let n = direction(k);
        frame_from_normal(n, view(n, N_DOT_V[k % N_DOT_V.len()]))
    })
}

/// The frames with each of some numbers.
fn with<const N: usize>(count: usize, numbers: [f64; N]) -> impl IndexedParallelIterator<Item = (Frame<f64>, f64)> {
    let all: Vec<_> = frames(count).flat_map(|frame| numbers.map(|number| (frame, number))).collect();
    all.into_par_iter()
}

fn mirror(frame: Frame<f64>) -> [f64; 3] {
    let twice = 2.0 * dot(frame.normal, frame.view_dir);
    std::array::from_fn(|i| twice * frame.normal[i] - frame.view_dir[i])
}

fn leaning(frame: Frame<f64>, roughness: f64) -> [f64; 3] {
    specular_direction(frame, mirror(frame), roughness)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn split_sum(frame: Frame<f64>, roughness: f64) -> [f64; 2] {
    dfg(frame.n_dot_v, roughness, Visibility::Correlated)
}

fn say(frame: Frame<f64>, roughness: f64) -> String {
    format!("view = {:?}, roughness = {roughness}, normal = {:?}", frame.view_dir, frame.normal)
}

/// The base's own reflection: beside it stand the lobes that are looked up in the same way.
fn specular(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).flat_map_iter(|(frame, r)| {
        F0.map(|f0| {
            let (lobe, pair) = (Specular { f0, f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
            let value = |dir| specular_environment(lobe, light.radiance(dir, r), pair);
            Case {
                at: format!("{}, f0 = {f0:?}", say(frame, r)),
                truth: light.integral(|l| specular_eval(frame, l, lobe)),
                values: [value(leaning(frame, r)), value(mirror(frame))],
            }
        })
    });
    light.table("reflection", "n.v 0.2 to 0.9, roughness 0.2 to 1, gold and a dielectric", LOOKUPS, cases)
}

/// The methods of the term `reflection`.
const LOOKUPS: [&str; 2] = ["leaning", "mirror"];

fn coat(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).map(|(frame, r)| {
        let lobe = Coat { weight: 1.0, color: [1.0; 3], f0: 0.04, alpha: r * r };
        let pair = split_sum(frame, r);
        Case {
            at: say(frame, r),
            truth: light.integral(|l| coat_eval(frame, l, lobe)),
            values: [leaning(frame, r), mirror(frame)].map(|dir| coat_environment(lobe, light.radiance(dir, r), pair)),
        }
    });
    light.table("coat", "n.v 0.2 to 0.9, roughness 0.2 to 1", LOOKUPS, cases)
}

fn sheen(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).map(|(frame, r)| {
        let lobe = Sheen { color: [1.0; 3], perceptual_roughness: r };
        Case {
            at: say(frame, r),
            truth: light.integral(|l| sheen_eval(frame, l, lobe)),
            values: [
                sheen_ring(lobe, light.irradiance(sheen_direction(frame)), light.last_but_one(frame.normal)),
                light.irradiance(frame.normal),
            ]
            .map(|radiance| sheen_environment(lobe, frame.n_dot_v, radiance)),
        }
    });
    light.table("sheen", "n.v 0.2 to 0.9, roughness 0.2 to 1", ["ring", "irradiance"], cases)
}

fn anisotropy(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, [0.3, 0.5, 0.7]).enumerate().flat_map_iter(|(k, (frame, r))| {
        ANISOTROPY.map(|strength| {
            let aside = unit(cross(frame.normal, direction(3 * k + 1)));
            let [alpha_t, alpha_b] = anisotropic_alphas_gltf(r, strength);
            let lobe = Anisotropic { f0: F0[0], f90: [1.0; 3], tangent: aside, alpha_t, alpha_b };
            let width = (alpha_t * alpha_b).sqrt().sqrt();
            let pair = split_sum(frame, width);
            let mut sum = [0.0; 4];
            for i in 0..ANISOTROPIC_STRIPS {
                let strip = anisotropic_strip(frame, aside, alpha_t, alpha_b, f64::from(i));
                let dir = specular_direction(frame, strip.dir, strip.perceptual_roughness);
                let radiance = light.radiance(dir, strip.perceptual_roughness);
                for (sum, x) in sum.iter_mut().zip([radiance[0], radiance[1], radiance[2], 1.0]) {
                    *sum += strip.weight * x;
                }
            }
            let strips = [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]];
            let bent = light
                .radiance(specular_direction(frame, anisotropic_reflection(frame, aside, strength, r), width), width);
            let round = light.radiance(leaning(frame, width), width);
            Case {
                at: format!("{}, anisotropy = {strength}", say(frame, r)),
                truth: light.integral(|l| anisotropic_eval(frame, l, lobe)),
                values: [strips, bent, round].map(|radiance| anisotropic_environment(lobe, radiance, pair)),
            }
        })
    });
    let methods = ["strips", "bent", "round"];
    let what = "n.v 0.2 to 0.9, roughness 0.3 to 0.7, anisotropy 0.3 to 0.9, gold, five lookups by strips and one by the others";
    light.table("anisotropy", what, methods, cases)
}

fn transmission(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS_THROUGH).flat_map_iter(|(frame, r)| {
        IOR.map(|eta| {
            let lobe = Transmission { color: [1.0; 3], eta, alpha: r * r };
            let (f0, pair) = (f0_from_ior(eta), split_sum(frame, r));
            let lookup = transmission_lookup(frame, eta, r * r);
            let smooth = transmission_direction(frame, eta);
            let gain = transmission_compensation(frame.n_dot_v, lobe);
            let value = |dir, roughness| transmission_environment(lobe, f0, light.radiance(dir, roughness), pair);
            Case {
                at: format!("{}, ior = {eta}", say(frame, r)),
                // The lookup leaves out that radiance is compressed in the body.
                truth: light.integral(|l| transmission_eval(frame, l, lobe).map(|x| x * gain * eta * eta)),
                values: [value(lookup.dir, lookup.perceptual_roughness), value(smooth, r)],
            }
        })
    });
    let methods = ["leaning facet, refracted width", "refracted, width of a reflection"];
    light.table("transmission", "a solid body, n.v 0.2 to 0.9, roughness 0.4 to 1, ior 1.2 to 2", methods, cases)
}

fn thin_walled(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).map(|(frame, r)| {
        let lobe = Transmission { color: [1.0; 3], eta: 1.5, alpha: r * r };
        let (f0, pair) = (f0_of_sheet(f0_from_ior(1.5), 1.0), split_sum(frame, r));
        let gain = transmission_thin_compensation(f0, pair);
        Case {
            at: say(frame, r),
            truth: light.integral(|l| transmission_thin_eval(frame, l, lobe).map(|x| x * gain)),
            values: [specular_direction(frame, frame.view_dir, r), frame.view_dir]
                .map(|here| transmission_environment(lobe, f0, light.radiance(here.map(|x| -x), r), pair)),
        }
    });
    let methods = ["leaning", "straight through"];
    light.table("transmission", "a thin wall, n.v 0.2 to 0.9, roughness 0.2 to 1, ior 1.5", methods, cases)
}

fn thin_film(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).enumerate().flat_map_iter(|(k, (frame, r))| {
        FILMS.map(|[thickness, ior]| {
            let film = ThinFilm { weight: 1.0, thickness, ior };
            let (f0, f90, pair) = (F0[k % F0.len()], [1.0; 3], split_sum(frame, r));
            let fresnel = |cosine| thin_film_fresnel(f0, f90, film, cosine);
            let radiance = light.radiance(leaning(frame, r), r);
            let value = |f0, f90| specular_environment(Specular { f0, f90, alpha: r * r }, radiance, pair);
            let truth = light.integral(|l| {
                // Most of the time goes into the film: none for light from below, of which nothing is reflected.
                if dot(frame.normal, l) <= 0.0 {
                    return [0.0; 3];
                }
                let f = fresnel(half_from_light(frame, l).l_dot_h);
                specular_eval(frame, l, Specular { f0: f, f90: f, alpha: r * r })
            });
            let (mean, seen) = (fresnel(thin_film_cosine(pair)), fresnel(frame.n_dot_v));
            // The f0 of which Schlick's form is what is seen.
            let grazing = f_schlick([0.0; 3], [1.0; 3], frame.n_dot_v)[0];
            let f0_seen = seen.map(|f| ((f - grazing) / (1.0 - grazing)).clamp(0.0, 1.0));
            Case {
                at: format!("{}, film = {thickness} nm, film's ior = {ior}", say(frame, r)),
                truth,
                values: [value(mean, mean), value(seen, seen), value(f0_seen, f90)],
            }
        })
    });
    let methods = ["at the split sum's mean cosine", "at n.v", "f0 from n.v"];
    let what = "n.v 0.2 to 0.9, roughness 0.2 to 1, three films on gold and on a dielectric";
    light.table("thin_film", what, methods, cases)
}

fn occlusion(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).flat_map_iter(|(frame, r)| {
        OCCLUSION.map(|open| {
            let (lobe, pair) = (Specular { f0: F0[0], f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
            let edge = (1.0 - open).sqrt();
            let inside = |l| if dot(frame.normal, l) > edge { specular_eval(frame, l, lobe) } else { [0.0; 3] };
            let whole = specular_environment(lobe, light.radiance(leaning(frame, r), r), pair);
            let parts = [
                specular_occlusion_cone(frame.n_dot_v, open, r),
                specular_occlusion_lagarde(frame.n_dot_v, open, r),
                open,
                1.0,
            ];
            Case {
                at: format!("{}, occlusion = {open}", say(frame, r)),
                truth: light.integral(inside),
                values: parts.map(|part| whole.map(|x| x * part)),
            }
        })
    });
    let what = "n.v 0.2 to 0.9, roughness 0.2 to 1, occlusion 0.3 to 0.9, gold, open in a cone about the normal";
    light.table("specular_occlusion", what, ["cone", "lagarde", "plain", "none"], cases)
}

fn horizon(light: &Light, count: usize) -> Vec<Row> {
    let cases = with(count, ROUGHNESS).enumerate().flat_map_iter(|(k, (frame, r))| {
        TILT.map(|tilt| {
            let aside = unit(cross(frame.normal, direction(5 * k + 2)));
            let (sin, cos) = tilt.to_radians().sin_cos();
            let g: [f64; 3] = std::array::from_fn(|i| cos * frame.normal[i] + sin * aside[i]);
            let (lobe, pair) = (Specular { f0: F0[0], f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
            let above = |l| if dot(g, l) > 0.0 { specular_eval(frame, l, lobe) } else { [0.0; 3] };
            let whole = specular_environment(lobe, light.radiance(leaning(frame, r), r), pair);
            let r_dot_g = dot(mirror(frame), g);
            let parts =
                [horizon_cone(r_dot_g, cos, frame.n_dot_v, r), horizon_squared(r_dot_g, cos, frame.n_dot_v, r), 1.0];
            Case {
                at: format!("{}, tilt = {tilt} deg", say(frame, r)),
                truth: light.integral(above),
                values: parts.map(|part| whole.map(|x| x * part)),
            }
        })
    });
    let what = "n.v 0.2 to 0.9, roughness 0.2 to 1, shading normals 15 to 45 degrees off, gold";
    light.table("horizon", what, ["cone", "squared", "none"], cases)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Effort;

    /// Largest rms error of each default, in the studio and under the sky: what is measured, and a tenth.
    const BOUNDS: [(&str, &str, f64, f64); 9] = [
        ("reflection", "leaning", 0.5, 0.15),
        ("coat", "leaning", 0.6, 0.15),
        ("sheen", "ring", 0.25, 0.23),
        ("anisotropy", "strips", 0.31, 0.25),
        ("transmission", "leaning facet, refracted width", 0.19, 0.1),
        ("transmission", "leaning", 0.72, 0.26),
        ("thin_film", "at the split sum's mean cosine", 0.55, 0.35),
        ("specular_occlusion", "cone", 0.8, 0.78),
        ("horizon", "cone", 0.39, 0.17),
    ];

    #[test]
    fn lobes_are_near_their_integrals() {
        let rows = rows(&Run::alone(Effort::Quick));
        for row in &rows {
            let (rms, max) = (row.error_rms.expect("measured"), row.error_max.expect("measured"));
            let place = if row.domain.contains("studio") { "studio" } else { "sky" };
            println!("{place} {} / {}: {:.1} % rms, {:.0} % max", row.term, row.method, 100.0 * rms, 100.0 * max);
        }
        for (term, method, in_studio, under_sky) in BOUNDS {
            for (name, bound) in [("studio", in_studio), ("sky", under_sky)] {
                let of = |r: &&Row| r.term == term && r.domain.contains(name);
                let row = rows.iter().find(|r| of(r) && r.method == method).expect("a row of the part");
                let rms = row.error_rms.expect("measured");
                assert!(rms <= bound, "{name} {term} {method}: {rms}");
                // No other method of the same domain is better by more than a seventh: there are few frames.
                let much_less = |r: &&Row| 1.15 * r.error_rms.expect("measured") < rms;
                let better = rows.iter().filter(of).filter(much_less).find(|r| r.domain == row.domain);
                assert!(better.is_none(), "{name} {term} {method}: {rms}, but {better:?}");
            }
        }
    }

    /// Under an even sky the directions and widths of lookups do not matter: what is left is the albedo.
    #[test]
    fn white_leaves_the_albedos() {
        let light = Light::new("white", Equirect { width: 2, height: 1, pixels: vec![[1.0; 3]; 2] });
        let cells = cells(&Equirect { width: 256, height: 128, pixels: vec![[1.0; 3]; 256 * 128] });
        let light = Light { cells, ..light };
        let bounds = [
            (specular(&light, 1), 0.01),
            (coat(&light, 1), 0.01),
            (sheen(&light, 1), 0.03),
            (anisotropy(&light, 1), 0.15),
            (thin_film(&light, 1), 0.18),
            (transmission(&light, 1), 0.04),
            (thin_walled(&light, 1), 0.01),
        ];
        for (rows, bound) in bounds {
            let (rms, at) = (rows[0].error_rms.expect("measured"), &rows[0].at);
            println!("{} / {}: {rms:.4} rms, {:?} at {at:?}", rows[0].term, rows[0].method, rows[0].error_max);
            assert!(rms < bound, "{}: {rms}, most at {at:?}", rows[0].term);
        }
    }
}
