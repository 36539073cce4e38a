//! Terms of the BRDF: each form in f32 against itself in f64, and against the exact form it stands for; the largest error is
//! searched for. Times of one call and of an element of a batch with the widest vectors of the machine.

use crate::error::{Errors, named};
use crate::placed::Columns;
use crate::search::CHEAP;
use crate::timing::{Candidate, SITTINGS, measured};
use crate::{Effort, Row, Run};
use halfvector_brdf::Real;
use halfvector_brdf::albedo::directional_albedo_charlie;
use halfvector_brdf::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use halfvector_brdf::batch::kernels::SpecularEval;
use halfvector_brdf::batch::{Kernel, Simd};
use halfvector_brdf::beckmann::{
    d_beckmann, v_smith_beckmann_correlated, v_smith_beckmann_exact, v_smith_beckmann_separable,
};
use halfvector_brdf::diffuse::{
    diffuse_burley, diffuse_eon, diffuse_eon_exact, diffuse_fon, diffuse_lambert, diffuse_oren_nayar,
};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_exact, f_f82_tint, f_schlick};
use halfvector_brdf::ggx::{d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::lobe_sheen::sheen_albedo;
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::multiscatter::{energy_compensation, energy_compensation_fdez_aguera, multiscatter_color};
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::thin_film::f_thin_film;
use halfvector_brdf::thin_film_spectral::f_thin_film_spectral;
use halfvector_brdf::visibility::{v_cook_torrance, v_hammon, v_kelemen, v_schlick_smith};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;

/// Index and extinction of what the films are on: glass, silver, iron, about those at 550 nm. Polyanskiy 2024, refractiveindex.info.
const UNDER_FILMS: [(f64, f64); 3] = [(1.5, 0.0), (0.2, 3.9), (2.9, 3.1)];

/// A metal's reflectance.
const F0: [f64; 3] = [0.9, 0.6, 0.3];

/// Elements of a batch that is timed.
const BATCH: usize = 1024;

/// Calls a form once for each point and adds the results up.
type Calls<const N: usize> = Box<dyn Fn(&[[f32; N]]) -> f64 + Sync>;

/// Runs a form over a batch: slices of each argument, and of the results.
type Batch<const N: usize> = Box<dyn Fn([&[f32]; N], &mut [f32]) + Sync>;

/// A form in every arithmetic.
struct Form<const N: usize> {
    name: &'static str,
    single: Box<dyn Fn([f32; N]) -> f32 + Sync>,
    exact: Box<dyn Fn([f64; N]) -> f64 + Sync>,
    /// All points, one call each.
    calls: Calls<N>,
    batch: Batch<N>,
}

impl<const N: usize> Form<N> {
    fn new<K: Kernel<N, 1> + Copy + Sync + 'static>(name: &'static str, kernel: K) -> Self {
        Self {
            name,
            single: Box::new(move |x| kernel.call(x)[0]),
            exact: Box::new(move |x| kernel.call(x)[0]),
            // A black box around each result keeps the compiler from widening the loop.
            calls: Box::new(move |points| points.iter().map(|&x| f64::from(black_box(kernel.call(x)[0]))).sum()),
            batch: Box::new(move |inputs, output| {
                let equal = Simd::best().run(&kernel, inputs, [output]);
                assert!(equal.is_ok(), "columns of one length");
            }),
        }
    }
}

/// A form of as many arguments as the first number says.
macro_rules! form {
    ($n:literal, $name:literal, $input:pat => $value:expr) => {{
        #[derive(Clone, Copy)]
        struct Of;
        impl Kernel<$n, 1> for Of {
            #[inline(always)]
            fn call<R: Real>(&self, $input: [R; $n]) -> [R; 1] {
                [$value]
            }
        }
        Form::new($name, Of)
    }};
}

/// A place in the unit cube: of points that have fewer numbers the last ones do not count.
type Cube = [f64; 5];

/// Forms of one term, on one set of points.
struct Group<const N: usize> {
    term: &'static str,
    /// The points, in words.
    points_are: String,
    /// What the numbers of a point are: a name, and how many of them it is of.
    names: &'static [(&'static str, usize)],
    /// The point at each place of the unit cube.
    point: Box<dyn Fn(Cube) -> [f32; N] + Sync>,
    forms: Vec<Form<N>>,
}

/// What the forms of a group are measured against.
struct Against<'a, const N: usize> {
    name: &'static str,
    /// `None` is each form itself in f64.
    truth: Option<&'a (dyn Fn([f64; N]) -> f64 + Sync)>,
    /// The error is relative to the truth, or to this where the truth is less.
    floor: f64,
    /// One in so many places is looked at: more than one where the truth takes long.
    one_in: usize,
}

impl<const N: usize> Against<'_, N> {
    fn itself(floor: f64) -> Self {
        Against { name: "the same form in f64", truth: None, floor, one_in: 1 }
    }

    /// What errors are, in words. No reflectance is more than 1, so that the greater of it and 1 is 1.
    fn errors(&self) -> String {
        match self.floor {
            0.0 => "relative error".to_owned(),
            1.0 => "absolute error, of a reflectance in 0..1,".to_owned(),
            floor => format!("error relative to max(truth, {floor})"),
        }
    }
}

impl<const N: usize> Group<N> {
    fn rows(&self, effort: Effort, against: &[Against<'_, N>]) -> Vec<Row> {
        // Points that are timed are few: their errors are those of more.
        let points: Vec<[f32; N]> = spread(effort.pick(1 << 11, 1 << 14)).map(&self.point).collect();
        let points = &points;
        // As many as stay in the nearest cache, so that the time is the form's and not the memory's.
        let batch = points.len().min(BATCH);
        let columns: [Vec<f32>; N] = std::array::from_fn(|i| points[..batch].iter().map(|x| x[i]).collect());
        let inputs: [Columns<N>; SITTINGS] =
            std::array::from_fn(|sitting| Columns::read(columns.each_ref().map(Vec::as_slice), sitting));
        let inputs = &inputs;
        let mut runs: Vec<Box<dyn FnMut(usize) -> f64 + '_>> = Vec::new();
        for form in &self.forms {
            let mut outputs: [Columns<1>; SITTINGS] = std::array::from_fn(|sitting| Columns::written(batch, sitting));
            runs.push(Box::new(|_| (form.calls)(points)));
            runs.push(Box::new(move |sitting| {
                let [output] = outputs[sitting].slices_mut();
                (form.batch)(inputs[sitting].slices(), output);
                f64::from(output[0])
            }));
        }
        let mut candidates: Vec<_> = runs.iter_mut().map(|run| run.as_mut() as Candidate<'_>).collect();
        let times = measured(&mut candidates, effort.pick(20, 200));

        let places: Vec<Cube> = spread(effort.pick(1 << 14, 1 << 16)).collect();
        let cases: Vec<_> =
            against.iter().flat_map(|against| (0..self.forms.len()).map(move |i| (against, i))).collect();
        let row = |(against, i): (&Against<'_, N>, usize)| {
            let domain = format!("{}; {} against {}", self.points_are, against.errors(), against.name);
            let form = &self.forms[i];
            let mut row = Row::new(self.term, form.name, &domain);
            self.errors(form, against, &places).fill(&mut row);
            row.take_time(times[2 * i], points.len());
            row.take_batch_time(times[2 * i + 1], batch);
            row
        };
        cases.into_par_iter().map(row).collect()
    }

    /// The errors of a form at some places, and the largest that a search from there finds.
    fn errors(&self, form: &Form<N>, against: &Against<'_, N>, places: &[Cube]) -> Errors {
        let error = |place: Cube| {
            let x = (self.point)(place);
            let wide = x.map(f64::from);
            let truth = against.truth.map_or_else(|| (form.exact)(wide), |truth| truth(wide));
            ((f64::from((form.single)(x)) - truth) / truth.abs().max(against.floor)).abs()
        };
        CHEAP.errors(places.iter().copied().step_by(against.one_in), error, |place| {
            named(self.names, &(self.point)(place))
        })
    }
}

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    const GROUPS: [fn(Effort) -> Vec<Row>; 11] =
        [d, sheen, v, v_beckmann, v_anisotropic, dielectric, conductor, thin_film, diffuse, compensation, specular];
    let effort = run.effort();
    run.pieces(&GROUPS, |group| group(effort))
}

/// Evenly spread places of the unit cube: multiples of irrational numbers. Roberts 2018, The Unreasonable Effectiveness of
/// Quasirandom Sequences.
fn spread(count: usize) -> impl Iterator<Item = Cube> {
    const STEPS: Cube =
        [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_865, 0.538_597_257_223_612, 0.461_430_9];
    (0..count).map(|k| STEPS.map(|step| (0.5 + step * k as f64).fract()))
}

/// The numbers of [`half_angles`], and of [`cosines`] whose fourth is alpha.
const HALF_ANGLES: &[(&str, usize)] = &[("n.h", 1), ("1 - n.h^2", 1), ("alpha", 1)];
const COSINES: &[(&str, usize)] = &[("n.v", 1), ("n.l", 1), ("l.h", 1), ("alpha", 1)];

/// n.h, sin^2 and alpha: half vectors dense about the normal.
fn half_angles([a, r, ..]: Cube) -> [f32; 3] {
    let (sine, cosine) = (FRAC_PI_2 * a * a).sin_cos();
    let roughness = 0.045 + 0.955 * r;
    [cosine, sine * sine, roughness * roughness].map(|x| x as f32)
}

/// n.v, n.l, l.h and a fourth argument; the cosines logarithmic from 0.01, at any azimuth between both directions.
fn cosines([v, l, phi, x, _]: Cube, fourth: impl Fn(f64) -> f64) -> [f32; 4] {
    let (v, l) = (0.01_f64.powf(v), 0.01_f64.powf(l));
    let l_dot_v = v * l + ((1.0 - v * v) * (1.0 - l * l)).sqrt() * (2.0 * FRAC_PI_2 * phi).cos();
    [v, l, (0.5 + 0.5 * l_dot_v).max(0.0).sqrt(), fourth(x)].map(|x| x as f32)
}

/// A unit direction of this cosine, which is 0..1, and a share of the whole turn.
fn direction(z: f64, turn: f64) -> [f64; 3] {
    let (sine, phi) = ((1.0 - z * z).sqrt(), 4.0 * FRAC_PI_2 * turn);
    [sine * phi.cos(), sine * phi.sin(), z]
}

fn d(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "d",
        points_are: "half vectors 0..90 deg, dense at the normal, roughness 0.045..1".into(),
        names: HALF_ANGLES,
        point: Box::new(half_angles),
        forms: vec![
            form!(3, "ggx", [n_dot_h, sin2, alpha] => d_ggx(n_dot_h, sin2, alpha)),
            form!(3, "ggx_anisotropic", [n_dot_h, sin2, alpha] =>
                d_ggx_anisotropic([sin2.sqrt(), R::ZERO, n_dot_h], alpha, alpha)),
            form!(3, "beckmann", [n_dot_h, sin2, alpha] => d_beckmann(n_dot_h, sin2, alpha)),
        ],
    };
    let ggx = |[n_dot_h, sin2, alpha]: [f64; 3]| d_ggx(n_dot_h, sin2, alpha);
    let against = Against { name: "GGX in f64", truth: Some(&ggx), floor: 1e-6, one_in: 1 };
    group.rows(effort, &[Against::itself(1e-6), against])
}

fn sheen(effort: Effort) -> Vec<Row> {
    let d = Group {
        term: "sheen",
        points_are: "D of half vectors 0..90 deg, dense at the normal, roughness 0.045..1".into(),
        names: HALF_ANGLES,
        point: Box::new(half_angles),
        forms: vec![form!(3, "charlie", [n_dot_h, sin2, alpha] => d_charlie(n_dot_h, sin2, alpha))],
    };
    let albedo = Group {
        term: "sheen",
        points_are: "directional albedo of directions 0..90 deg, dense at the normal, roughness 0.045..1".into(),
        names: &[("n.v", 1), ("1 - n.v^2", 1), ("alpha", 1)],
        point: Box::new(half_angles),
        forms: vec![form!(3, "charlie", [n_dot_w, _, alpha] => sheen_albedo(n_dot_w, alpha.sqrt()))],
    };
    let integral = |[n_dot_w, _, alpha]: [f64; 3]| directional_albedo_charlie(n_dot_w, alpha.sqrt());
    let fit = Against { name: "its integral", truth: Some(&integral), floor: 2e-2, one_in: 8 };
    let mut rows = d.rows(effort, &[Against::itself(1e-2)]);
    rows.extend(albedo.rows(effort, &[Against::itself(1e-2), fit]));
    rows
}

/// The whole specular lobe: as one point is shaded, and as batches compute it.
fn specular(effort: Effort) -> Vec<Row> {
    let point = |[vz, phi, lz, psi, r]: Cube| {
        let ([vx, vy, vz], [lx, ly, lz], roughness) = (direction(vz, phi), direction(lz, psi), 0.3 + 0.7 * r);
        [vx, vy, vz, lx, ly, lz, roughness * roughness].map(|x| x as f32)
    };
    let group = Group {
        term: "specular",
        points_are:
            "sum of r, g, b of D V F n.l, f0 0.9, 0.6, 0.3, any two directions above the surface, roughness 0.3..1"
                .into(),
        names: &[("view", 3), ("light", 3), ("alpha", 1)],
        point: Box::new(point),
        forms: vec![
            form!(7, "specular_eval", [vx, vy, vz, lx, ly, lz, alpha] => {
                let frame = frame_from_normal([R::ZERO, R::ZERO, R::ONE], [vx, vy, vz]);
                let [r, g, b] = specular_eval(frame, [lx, ly, lz], Specular { f0: F0.map(R::of), f90: [R::ONE; 3], alpha });
                r + g + b
            }),
            form!(7, "SpecularEval", [vx, vy, vz, lx, ly, lz, alpha] => {
                let f0 = F0.map(R::of);
                let [r, g, b] = SpecularEval.call([vx, vy, vz, lx, ly, lz, alpha, f0[0], f0[1], f0[2]]);
                r + g + b
            }),
        ],
    };
    group.rows(effort, &[Against::itself(1e-3)])
}

fn v(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "v",
        points_are: "n.v and n.l logarithmic in 0.01..1 at any azimuth, alpha logarithmic in 0.002..1".into(),
        names: COSINES,
        point: Box::new(|place| cosines(place, |x| 0.002_f64.powf(x))),
        forms: vec![
            form!(4, "correlated", [v, l, h, alpha] => v_smith_ggx_correlated(v, l, h, alpha)),
            form!(4, "separable", [v, l, h, alpha] => v_smith_ggx_separable(v, l, h, alpha)),
            form!(4, "hammon", [v, l, h, alpha] => v_hammon(v, l, h, alpha)),
            form!(4, "schlick_smith", [v, l, h, alpha] => v_schlick_smith(v, l, h, alpha)),
            form!(4, "cook_torrance", [v, l, h, alpha] => v_cook_torrance(v, l, h, alpha)),
            form!(4, "kelemen", [v, l, h, alpha] => v_kelemen(v, l, h, alpha)),
            form!(4, "neubelt", [v, l, h, alpha] => v_neubelt(v, l, h, alpha)),
            form!(4, "beckmann_correlated", [v, l, h, alpha] => v_smith_beckmann_correlated(v, l, h, alpha)),
            form!(4, "beckmann_separable", [v, l, h, alpha] => v_smith_beckmann_separable(v, l, h, alpha)),
        ],
    };
    let smith = |[v, l, h, alpha]: [f64; 4]| v_smith_ggx_correlated(v, l, h, alpha);
    let name = "Smith's height-correlated form for GGX in f64";
    group.rows(effort, &[Against::itself(0.0), Against { name, truth: Some(&smith), floor: 0.0, one_in: 1 }])
}

fn v_beckmann(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "v",
        points_are: "n.v and n.l logarithmic in 0.01..1 at any azimuth, alpha logarithmic in 0.002..1".into(),
        names: COSINES,
        point: Box::new(|place| cosines(place, |x| 0.002_f64.powf(x))),
        forms: vec![
            form!(4, "beckmann_exact", [v, l, h, alpha] => v_smith_beckmann_exact(v, l, h, alpha)),
            form!(4, "beckmann_correlated", [v, l, h, alpha] => v_smith_beckmann_correlated(v, l, h, alpha)),
            form!(4, "beckmann_separable", [v, l, h, alpha] => v_smith_beckmann_separable(v, l, h, alpha)),
        ],
    };
    let smith = |[v, l, h, alpha]: [f64; 4]| v_smith_beckmann_exact(v, l, h, alpha);
    let name = "Smith's height-correlated form for Beckmann in f64";
    group.rows(effort, &[Against { name, truth: Some(&smith), floor: 0.0, one_in: 1 }])
}

fn v_anisotropic(effort: Effort) -> Vec<Row> {
    let point = |[vz, phi, lz, psi, a]: Cube| {
        let [[vx, vy, vz], [lx, ly, lz]] = [[vz, phi], [lz, psi]].map(|[z, turn]| direction(0.01_f64.powf(z), turn));
        [vx, vy, vz, lx, ly, lz, 0.002_f64.powf(a)].map(|x| x as f32)
    };
    let group = Group {
        term: "v",
        points_are:
            "n.v and n.l logarithmic in 0.01..1, each at any azimuth from the tangent, alphas of ratio 4, logarithmic"
                .into(),
        names: &[("view", 3), ("light", 3), ("alpha along the tangent", 1)],
        point: Box::new(point),
        forms: vec![form!(7, "ggx_anisotropic", [vx, vy, vz, lx, ly, lz, alpha] =>
            v_smith_ggx_anisotropic([vx, vy, vz], [lx, ly, lz], alpha, alpha * R::of(0.25)))],
    };
    group.rows(effort, &[Against::itself(0.0)])
}

/// Refractive indices of water, glass and diamond.
const IORS: [f64; 3] = [1.33, 1.5, 2.42];

fn dielectric(effort: Effort) -> Vec<Row> {
    let of = |ior: f64| {
        let f0 = f_dielectric(ior, 1.0);
        let group = Group {
            term: "fresnel",
            points_are: format!("ior {ior}: a dielectric, l.h evenly in 0..1"),
            names: &[("l.h", 1), ("f0", 1), ("ior", 1)],
            point: Box::new(move |[c, ..]| [c, f0, ior].map(|x| x as f32)),
            forms: vec![
                form!(3, "schlick", [c, f0, _] => f_schlick([f0; 3], [R::ONE; 3], c)[0]),
                form!(3, "exact", [c, f0, _] => f_exact([f0; 3], [R::ONE; 3], c)[0]),
                form!(3, "dielectric", [c, _, ior] => f_dielectric(ior, c)),
            ],
        };
        let truth = |[c, ..]: [f64; 3]| f_dielectric(ior, c);
        let name = "Fresnel's equations in f64";
        group.rows(effort, &[Against::itself(0.02), Against { name, truth: Some(&truth), floor: 1.0, one_in: 1 }])
    };
    IORS.into_iter().flat_map(of).collect()
}

/// Metals at 550 nm: index and extinction, as in `shaders/nodes/optics/metals.wgsl`, which names the sources.
const METALS: [(&str, [f64; 2]); 4] =
    [("gold", [0.424, 2.472]), ("copper", [1.007, 2.582]), ("aluminium", [1.015, 6.627]), ("iron", [2.95, 2.932])];

fn conductor(effort: Effort) -> Vec<Row> {
    let of = |(metal, [eta, k]): (&str, [f64; 2])| {
        let f0 = f_conductor(eta, k, 1.0);
        let tint = tint_at_82_degrees(eta, k, f0);
        let group = Group {
            term: "fresnel",
            points_are: format!("{metal}, {eta} + {k} i: a metal in the green, l.h evenly in 0..1"),
            names: &[("l.h", 1), ("f0", 1), ("tint", 1), ("eta", 1), ("k", 1)],
            point: Box::new(move |[c, ..]| [c, f0, tint, eta, k].map(|x| x as f32)),
            forms: vec![
                form!(5, "schlick", [c, f0, ..] => f_schlick([f0; 3], [R::ONE; 3], c)[0]),
                form!(5, "f82_tint", [c, f0, tint, ..] => f_f82_tint([f0; 3], [tint; 3], c)[0]),
                form!(5, "conductor", [c, _, _, eta, k] => f_conductor(eta, k, c)),
            ],
        };
        let truth = |[c, ..]: [f64; 5]| f_conductor(eta, k, c);
        let name = "Fresnel's equations in f64";
        group.rows(effort, &[Against::itself(0.02), Against { name, truth: Some(&truth), floor: 1.0, one_in: 1 }])
    };
    METALS.into_iter().flat_map(of).collect()
}

/// Reflectance at 82 degrees, relative to Schlick's.
fn tint_at_82_degrees(eta: f64, k: f64, f0: f64) -> f64 {
    let cosine = 1.0 / 7.0;
    f_conductor(eta, k, cosine) / f_schlick([f0; 3], [1.0; 3], cosine)[0]
}

fn thin_film(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "fresnel",
        points_are: "films of index 1.2..2.4 and 40..1240 nm on glass, silver and iron, l.h evenly in 0.1..1".into(),
        names: &[("film's index", 1), ("thickness", 1), ("base's index", 2), ("l.h", 1), ("channel", 1)],
        point: Box::new(|[c, thickness, index, base, channel]| {
            let below = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
            let (eta, k) = UNDER_FILMS[below(base, UNDER_FILMS.len())];
            [1.2 + 1.2 * index, 40.0 + 1200.0 * thickness, eta, k, 0.1 + 0.9 * c, below(channel, 3) as f64]
                .map(|x| x as f32)
        }),
        forms: vec![form!(6, "thin_film", [film, thickness, eta, k, c, channel] => {
            let [red, green, blue] = f_thin_film(film, thickness, [eta; 3], [k; 3], c);
            R::choose(channel.lt(R::of(0.5)), red, R::choose(channel.lt(R::of(1.5)), green, blue))
        })],
    };
    let spectral = |[film, thickness, eta, k, c, channel]: [f64; 6]| {
        f_thin_film_spectral(film, thickness, eta, k, c)[channel as usize]
    };
    let against = Against { name: "the integral over the spectrum", truth: Some(&spectral), floor: 1.0, one_in: 4 };
    group.rows(effort, &[Against::itself(0.02), against])
}

fn diffuse(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "diffuse",
        points_are: "albedo 0.8, n.v and n.l logarithmic in 0.01..1 at any azimuth, roughness evenly in 0..1".into(),
        names: &[("n.v", 1), ("n.l", 1), ("l.h", 1), ("roughness", 1)],
        point: Box::new(|place| cosines(place, |x| x)),
        forms: vec![
            form!(4, "lambert", [v, l, h, r] => diffuse_lambert([R::of(0.8); 3], v, l, h, r)[0]),
            form!(4, "burley", [v, l, h, r] => diffuse_burley([R::of(0.8); 3], v, l, h, r)[0]),
            form!(4, "oren_nayar", [v, l, h, r] => diffuse_oren_nayar([R::of(0.8); 3], v, l, h, r)[0]),
            form!(4, "fon", [v, l, h, r] => diffuse_fon([R::of(0.8); 3], v, l, h, r)[0]),
            form!(4, "eon", [v, l, h, r] => diffuse_eon([R::of(0.8); 3], v, l, h, r)[0]),
            form!(4, "eon_exact", [v, l, h, r] => diffuse_eon_exact([R::of(0.8); 3], v, l, h, r)[0]),
        ],
    };
    let truth = |[v, l, h, r]: [f64; 4]| diffuse_eon_exact([0.8; 3], v, l, h, r)[0];
    let name = "EON with exact albedos in f64";
    // Where next to nothing is reflected an error of many times that is nothing: a tenth of what Lambert reflects.
    group.rows(effort, &[Against::itself(0.0), Against { name, truth: Some(&truth), floor: 0.025, one_in: 1 }])
}

fn compensation(effort: Effort) -> Vec<Row> {
    let group = Group {
        term: "compensation",
        points_are: "f0 evenly in 0..1, single-scattering albedo of white evenly in 0.4..1".into(),
        names: &[("f0", 1), ("albedo", 1)],
        point: Box::new(|[f0, albedo, ..]| [f0, 0.4 + 0.6 * albedo].map(|x| x as f32)),
        forms: vec![
            form!(2, "turquin", [f0, albedo] => energy_compensation([f0; 3], [R::ONE; 3], [albedo, R::ZERO])[0]),
            form!(2, "fdez_aguera", [f0, albedo] =>
                energy_compensation_fdez_aguera([f0; 3], [R::ONE; 3], [albedo, R::ZERO])[0]),
            form!(2, "kulla_conty", [f0, albedo] => multiscatter_color([f0; 3], [R::ONE; 3], albedo)[0]),
        ],
    };
    group.rows(effort, &[Against::itself(1e-3)])
}

#[cfg(test)]
mod tests;
