//! What each lobe shows of an environment, as a shader computes it, against the integral of the lobe over every texel: the
//! lookups of the baked levels, the directions and widths of those lookups, and the split sum, all errors together. On the
//! two environments of our own. Nothing is timed here: what they cost is measured in their shaders (`shaders`).

use super::ibl::direction_at;
use super::split_sum::{cells, view};
use std::sync::{Mutex, PoisonError};

use crate::error::Errors;
use crate::search;
use crate::{Row, Run};
use halfvector_brdf::frame::{Frame, frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_schlick, f0_from_ior};
use halfvector_brdf::lobe_anisotropic::{
    ANISOTROPIC_STRIPS, Anisotropic, anisotropic_alphas_gltf, anisotropic_environment, anisotropic_eval,
    anisotropic_reflection, anisotropic_strip,
};
use halfvector_brdf::lobe_coat::{Coat, coat_environment};
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

/// Least and most of what is drawn evenly between.
const N_DOT_V: [f64; 2] = [0.2, 0.9];
const ROUGHNESS: [f64; 2] = [0.2, 1.0];
/// Refraction narrows a lobe: below this roughness the map's texels are wider.
const ROUGHNESS_THROUGH: [f64; 2] = [0.4, 1.0];
const ROUGHNESS_ANISOTROPIC: [f64; 2] = [0.3, 0.7];
const ANISOTROPY: [f64; 2] = [0.3, 0.9];
const IOR: [f64; 2] = [1.2, 2.0];
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
    const LOBES: [fn(&Light, usize) -> Vec<Row>; 6] =
        [reflected, sheen, anisotropy, transmission, thin_walled, thin_film];
    let count = run.effort().pick(240, 1200);
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

/// What is drawn: a frame, a roughness, a direction along the surface, and a number in 0..1.
struct Point {
    frame: Frame<f64>,
    roughness: f64,
    aside: [f64; 3],
    more: f64,
}

/// Points that fill the domain evenly, however many of them there are: fewer have nearly the mean square of more.
fn points(count: usize, roughness: [f64; 2]) -> impl IndexedParallelIterator<Item = Point> {
    (0..count).into_par_iter().map(move |k| {
        let [a, b, turn, n_dot_v, r, more, aside] = search::place(k);
        let normal = direction_at([a, b]);
        let view_dir = view(normal, mixed(N_DOT_V, n_dot_v), turn);
        let aside = view(normal, 0.0, aside);
        Point { frame: frame_from_normal(normal, view_dir), roughness: mixed(roughness, r), aside, more }
    })
}

fn mixed([least, most]: [f64; 2], share: f64) -> f64 {
    least + (most - least) * share
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

fn split_sum(frame: Frame<f64>, roughness: f64) -> [f64; 2] {
    dfg(frame.n_dot_v, roughness, Visibility::Correlated)
}

fn say(frame: Frame<f64>, roughness: f64) -> String {
    format!("view = {:?}, roughness = {roughness:?}, normal = {:?}", frame.view_dir, frame.normal)
}

/// What comes of light times D V n.l, without Fresnel's factor and with the part of it that Schlick's form adds.
type Sums = [[f64; 3]; 2];

/// One pass over all light: what is reflected in all, in each cone that an occlusion leaves open, and above each horizon.
struct Pass {
    whole: Sums,
    open: [Sums; OCCLUSION.len()],
    above: [Sums; TILT.len()],
}

impl Pass {
    fn of(light: &Light, point: &Point) -> Pass {
        let Point { frame, roughness, .. } = *point;
        // The first channel has F = 1, the second what grazes.
        let lobe = Specular { f0: [1.0, 0.0, 0.0], f90: [1.0; 3], alpha: roughness * roughness };
        let (edges, horizons) = (OCCLUSION.map(|open| (1.0 - open).sqrt()), TILT.map(|tilt| horizon(point, tilt)));
        let none = [[0.0; 3]; 2];
        let mut pass = Pass { whole: none, open: [none; OCCLUSION.len()], above: [none; TILT.len()] };
        for &[x, y, z, r, g, b] in &light.cells {
            let l = [x, y, z];
            let n_dot_l = dot(frame.normal, l);
            if n_dot_l <= 0.0 {
                continue;
            }
            let [all, grazing, _] = specular_eval(frame, l, lobe);
            let parts = [all - grazing, grazing].map(|weight| [r, g, b].map(|x| x * weight));
            let add = |sums: &mut Sums| {
                for (sum, part) in sums.as_flattened_mut().iter_mut().zip(parts.as_flattened()) {
                    *sum += part;
                }
            };
            add(&mut pass.whole);
            pass.open.iter_mut().zip(edges).filter(|(_, edge)| n_dot_l > *edge).for_each(|(sums, _)| add(sums));
            pass.above.iter_mut().zip(&horizons).filter(|(_, g)| dot(**g, l) > 0.0).for_each(|(sums, _)| add(sums));
        }
        pass
    }
}

/// What is reflected by Schlick's form.
fn with_f0([constant, grazing]: Sums, f0: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| f0[c] * constant[c] + grazing[c])
}

/// The geometry's normal where the shading normal is so many degrees off.
fn horizon(point: &Point, tilt: f64) -> [f64; 3] {
    let (sin, cos) = tilt.to_radians().sin_cos();
    std::array::from_fn(|i| cos * point.frame.normal[i] + sin * point.aside[i])
}

/// The base's own reflection, the coat's, and what of it is occluded or below the horizon: each is a part of the same sums.
fn reflected(light: &Light, count: usize) -> Vec<Row> {
    // Few of them see the sun, and err most.
    let count = 2 * count;
    let passes: Vec<(Point, Pass)> = points(count, ROUGHNESS)
        .map(|point| {
            let pass = Pass::of(light, &point);
            (point, pass)
        })
        .collect();
    [specular, coat, occlusion, above_horizon].into_iter().flat_map(|rows| rows(light, &passes)).collect()
}

fn specular(light: &Light, passes: &[(Point, Pass)]) -> Vec<Row> {
    let cases = passes.par_iter().flat_map_iter(|(point, pass)| {
        let (frame, r) = (point.frame, point.roughness);
        F0.map(|f0| {
            let (lobe, pair) = (Specular { f0, f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
            let value = |dir| specular_environment(lobe, light.radiance(dir, r), pair);
            Case {
                at: format!("{}, f0 = {f0:?}", say(frame, r)),
                truth: with_f0(pass.whole, f0),
                values: [value(leaning(frame, r)), value(mirror(frame))],
            }
        })
    });
    light.table("reflection", "n.v 0.2 to 0.9, roughness 0.2 to 1, gold and a dielectric", LOOKUPS, cases)
}

/// The methods of the term `reflection`.
const LOOKUPS: [&str; 2] = ["leaning", "mirror"];

fn coat(light: &Light, passes: &[(Point, Pass)]) -> Vec<Row> {
    let cases = passes.par_iter().map(|(point, pass)| {
        let (frame, r) = (point.frame, point.roughness);
        let lobe = Coat { weight: 1.0, color: [1.0; 3], f0: 0.04, alpha: r * r };
        let pair = split_sum(frame, r);
        Case {
            at: say(frame, r),
            truth: with_f0(pass.whole, [lobe.f0; 3]),
            values: [leaning(frame, r), mirror(frame)].map(|dir| coat_environment(lobe, light.radiance(dir, r), pair)),
        }
    });
    light.table("coat", "n.v 0.2 to 0.9, roughness 0.2 to 1", LOOKUPS, cases)
}

fn sheen(light: &Light, count: usize) -> Vec<Row> {
    let cases = points(count, ROUGHNESS).map(|Point { frame, roughness: r, .. }| {
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
    let cases = points(count, ROUGHNESS_ANISOTROPIC).map(|Point { frame, roughness: r, aside, more }| {
        let strength = mixed(ANISOTROPY, more);
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
        let bent =
            light.radiance(specular_direction(frame, anisotropic_reflection(frame, aside, strength, r), width), width);
        let round = light.radiance(leaning(frame, width), width);
        Case {
            at: format!("{}, tangent = {aside:?}, anisotropy = {strength:?}", say(frame, r)),
            truth: light.integral(|l| anisotropic_eval(frame, l, lobe)),
            values: [strips, bent, round].map(|radiance| anisotropic_environment(lobe, radiance, pair)),
        }
    });
    let methods = ["strips", "bent", "round"];
    let what = "n.v 0.2 to 0.9, roughness 0.3 to 0.7, anisotropy 0.3 to 0.9, gold, five lookups by strips and one by the others";
    light.table("anisotropy", what, methods, cases)
}

fn transmission(light: &Light, count: usize) -> Vec<Row> {
    let cases = points(count, ROUGHNESS_THROUGH).map(|Point { frame, roughness: r, more, .. }| {
        let eta = mixed(IOR, more);
        let lobe = Transmission { color: [1.0; 3], eta, alpha: r * r };
        let (f0, pair) = (f0_from_ior(eta), split_sum(frame, r));
        let lookup = transmission_lookup(frame, eta, r * r);
        let smooth = transmission_direction(frame, eta);
        let gain = transmission_compensation(frame.n_dot_v, lobe);
        let value = |dir, roughness| transmission_environment(lobe, f0, light.radiance(dir, roughness), pair);
        Case {
            at: format!("{}, ior = {eta:?}", say(frame, r)),
            // The lookup leaves out that radiance is compressed in the body.
            truth: light.integral(|l| transmission_eval(frame, l, lobe).map(|x| x * gain * eta * eta)),
            values: [value(lookup.dir, lookup.perceptual_roughness), value(smooth, r)],
        }
    });
    let methods = ["leaning facet, refracted width", "refracted, width of a reflection"];
    light.table("transmission", "a solid body, n.v 0.2 to 0.9, roughness 0.4 to 1, ior 1.2 to 2", methods, cases)
}

fn thin_walled(light: &Light, count: usize) -> Vec<Row> {
    let cases = points(count, ROUGHNESS).map(|Point { frame, roughness: r, .. }| {
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
    const STEPS: usize = 2048;
    // Most of the time would go into the film: its F is known by the cosine.
    let known = F0.map(|f0| {
        FILMS.map(|[thickness, ior]| {
            let film = ThinFilm { weight: 1.0, thickness, ior };
            let at = |k: usize| thin_film_fresnel(f0, [1.0; 3], film, k as f64 / STEPS as f64);
            (0..=STEPS).map(at).collect::<Vec<_>>()
        })
    });
    let cases = points(count / 2, ROUGHNESS).enumerate().flat_map_iter(|(k, Point { frame, roughness: r, .. })| {
        let (f0, f90, pair) = (F0[k % F0.len()], [1.0; 3], split_sum(frame, r));
        let plain = Specular { f0: f90, f90, alpha: r * r };
        let mut sums = [[0.0; 3]; FILMS.len()];
        for &[x, y, z, red, green, blue] in &light.cells {
            let l = [x, y, z];
            if dot(frame.normal, l) <= 0.0 {
                continue;
            }
            let [weight, ..] = specular_eval(frame, l, plain);
            let place = half_from_light(frame, l).l_dot_h.clamp(0.0, 1.0) * STEPS as f64;
            let step = (place as usize).min(STEPS - 1);
            for (sum, f) in sums.iter_mut().zip(&known[k % F0.len()]) {
                for (c, light) in [red, green, blue].into_iter().enumerate() {
                    let f = f[step][c] + (place - step as f64) * (f[step + 1][c] - f[step][c]);
                    sum[c] += weight * f * light;
                }
            }
        }
        std::array::from_fn::<_, { FILMS.len() }, _>(|i| {
            let ([thickness, ior], truth) = (FILMS[i], sums[i]);
            let film = ThinFilm { weight: 1.0, thickness, ior };
            let fresnel = |cosine| thin_film_fresnel(f0, f90, film, cosine);
            let radiance = light.radiance(leaning(frame, r), r);
            let value = |f0, f90| specular_environment(Specular { f0, f90, alpha: r * r }, radiance, pair);
            let (mean, seen) = (fresnel(thin_film_cosine(pair)), fresnel(frame.n_dot_v));
            // The f0 of which Schlick's form is what is seen.
            let grazing = f_schlick([0.0; 3], [1.0; 3], frame.n_dot_v)[0];
            let f0_seen = seen.map(|f| ((f - grazing) / (1.0 - grazing)).clamp(0.0, 1.0));
            Case {
                at: format!("{}, film = {thickness} nm, film's ior = {ior}, f0 = {f0:?}", say(frame, r)),
                truth,
                values: [value(mean, mean), value(seen, seen), value(f0_seen, f90)],
            }
        })
    });
    let methods = ["at the split sum's mean cosine", "at n.v", "f0 from n.v"];
    let what = "n.v 0.2 to 0.9, roughness 0.2 to 1, three films on gold and on a dielectric";
    light.table("thin_film", what, methods, cases)
}

fn occlusion(light: &Light, passes: &[(Point, Pass)]) -> Vec<Row> {
    let cases = passes.par_iter().flat_map_iter(|(point, pass)| {
        let (frame, r) = (point.frame, point.roughness);
        let (lobe, pair) = (Specular { f0: F0[0], f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
        let whole = specular_environment(lobe, light.radiance(leaning(frame, r), r), pair);
        OCCLUSION.into_iter().zip(&pass.open).map(move |(open, inside)| {
            let parts = [
                specular_occlusion_cone(frame.n_dot_v, open, r),
                specular_occlusion_lagarde(frame.n_dot_v, open, r),
                open,
                1.0,
            ];
            Case {
                at: format!("{}, occlusion = {open}", say(frame, r)),
                truth: with_f0(*inside, F0[0]),
                values: parts.map(|part| whole.map(|x| x * part)),
            }
        })
    });
    let what = "n.v 0.2 to 0.9, roughness 0.2 to 1, occlusion 0.3 to 0.9, gold, open in a cone about the normal";
    light.table("specular_occlusion", what, ["cone", "lagarde", "plain", "none"], cases)
}

fn above_horizon(light: &Light, passes: &[(Point, Pass)]) -> Vec<Row> {
    let cases = passes.par_iter().flat_map_iter(|(point, pass)| {
        let (frame, r) = (point.frame, point.roughness);
        let (lobe, pair) = (Specular { f0: F0[0], f90: [1.0; 3], alpha: r * r }, split_sum(frame, r));
        let whole = specular_environment(lobe, light.radiance(leaning(frame, r), r), pair);
        TILT.into_iter().zip(&pass.above).map(move |(tilt, above)| {
            let g = horizon(point, tilt);
            let (r_dot_g, cos) = (dot(mirror(frame), g), tilt.to_radians().cos());
            let parts =
                [horizon_cone(r_dot_g, cos, frame.n_dot_v, r), horizon_squared(r_dot_g, cos, frame.n_dot_v, r), 1.0];
            Case {
                at: format!("{}, geometry's normal = {g:?}", say(frame, r)),
                truth: with_f0(*above, F0[0]),
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
    use halfvector_brdf::lobe_coat::coat_eval;

    /// Largest rms error of each default, in the studio and under the sky: what is measured, and a tenth.
    const BOUNDS: [(&str, &str, f64, f64); 9] = [
        ("reflection", "leaning", 0.36, 0.18),
        ("coat", "leaning", 0.42, 0.19),
        ("sheen", "ring", 0.33, 0.32),
        ("anisotropy", "strips", 0.25, 0.25),
        ("transmission", "leaning facet, refracted width", 0.26, 0.12),
        ("transmission", "leaning", 0.3, 0.25),
        ("thin_film", "at the split sum's mean cosine", 0.45, 0.25),
        ("specular_occlusion", "cone", 2.0, 2.4),
        ("horizon", "cone", 0.48, 0.3),
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

    /// What one pass sums up is what each lobe sums up alone.
    #[test]
    fn one_pass_is_every_sum() {
        let map = Equirect::from_fn(64, 32, |[x, y, z]| [x, y, z].map(|c| (1.1 + c) as f32));
        let light = Light::new("even", map);
        for point in points(6, ROUGHNESS).collect::<Vec<_>>() {
            let (pass, frame) = (Pass::of(&light, &point), point.frame);
            let alpha = point.roughness * point.roughness;
            let gold = Specular { f0: F0[0], f90: [1.0; 3], alpha };
            let coat = Coat { weight: 1.0, color: [1.0; 3], f0: 0.04, alpha };
            let inside = |is_inside: &dyn Fn([f64; 3]) -> bool| {
                light.integral(|l| if is_inside(l) { specular_eval(frame, l, gold) } else { [0.0; 3] })
            };
            let (g, edge) = (horizon(&point, TILT[1]), (1.0 - OCCLUSION[1]).sqrt());
            let pairs = [
                (with_f0(pass.whole, F0[0]), inside(&|_| true)),
                (with_f0(pass.whole, [0.04; 3]), light.integral(|l| coat_eval(frame, l, coat))),
                (with_f0(pass.open[1], F0[0]), inside(&|l| dot(frame.normal, l) > edge)),
                (with_f0(pass.above[1], F0[0]), inside(&|l| dot(g, l) > 0.0)),
            ];
            for (a, b) in pairs {
                assert!((0..3).all(|c| (a[c] - b[c]).abs() <= 1e-9 * b[c]), "{a:?}, not {b:?}");
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
            (reflected(&light, 24), 0.01),
            (sheen(&light, 24), 0.03),
            (anisotropy(&light, 24), 0.15),
            (thin_film(&light, 24), 0.18),
            (transmission(&light, 24), 0.04),
            (thin_walled(&light, 24), 0.01),
        ];
        for (rows, bound) in bounds {
            let (rms, at) = (rows[0].error_rms.expect("measured"), &rows[0].at);
            println!("{} / {}: {rms:.4} rms, {:?} at {at:?}", rows[0].term, rows[0].method, rows[0].error_max);
            assert!(rms < bound, "{}: {rms}, most at {at:?}", rows[0].term);
        }
    }
}
