//! The split sum's pair: tables of several sizes and layouts, and analytic fits, against quadrature; and what the light that
//! bounces more than once adds to it, and the base under it.

use halfvector_brdf::albedo::{directional_albedo_ggx, directional_albedo_ggx_with, gauss_legendre};
use halfvector_brdf::dfg::{dfg_fit, dfg_karis};
use halfvector_brdf::ggx::v_smith_ggx_correlated;
use halfvector_ibl::environment::dfg_from_table;
use halfvector_ibl::{DFG_SIZE, dfg_table};

use rayon::prelude::*;

use super::{coupling, multiple};
use crate::error::Errors;
use crate::search::Search;
use crate::timing::{self, Candidate};
use crate::{Effort, Row, Run};

const INNER: &str = "n.v >= 0.05, roughness >= 0.089; absolute error, that of a + b or of b, against quadrature";
const WIDE: &str = "n.v >= 0.001, roughness >= 0.02; absolute error, that of a + b or of b, against quadrature";

/// A table: what stands where.
struct Layout {
    name: &'static str,
    size: usize,
    /// Whether the ends of each axis are texel centres; else they are the table's edges.
    vertices: bool,
    /// n.v is this power of the place along x, and roughness of that along y.
    powers: [i32; 2],
    /// Bytes of a number: 2 or 4.
    bytes: usize,
}

const LAYOUTS: &[Layout] = &[
    Layout { name: "32^2 f16, texel-centred, n.v", size: 32, vertices: false, powers: [1, 1], bytes: 2 },
    Layout { name: "32^2 f16, vertex-centred, n.v", size: 32, vertices: true, powers: [1, 1], bytes: 2 },
    Layout { name: "32^2 f16, vertex-centred, sqrt(n.v)", size: 32, vertices: true, powers: [2, 1], bytes: 2 },
    Layout { name: "32^2 f16, vertex-centred, both warped", size: 32, vertices: true, powers: [4, 2], bytes: 2 },
    Layout { name: "45^2 f16, vertex-centred, sqrt(n.v)", size: 45, vertices: true, powers: [2, 1], bytes: 2 },
    Layout { name: "45^2 f16, vertex-centred, both warped", size: 45, vertices: true, powers: [4, 2], bytes: 2 },
    Layout { name: "45^2 f32, vertex-centred, both warped", size: 45, vertices: true, powers: [4, 2], bytes: 4 },
    Layout { name: "64^2 f16, vertex-centred, sqrt(n.v)", size: 64, vertices: true, powers: [2, 1], bytes: 2 },
    Layout { name: "64^2 f16, vertex-centred, both warped", size: 64, vertices: true, powers: [4, 2], bytes: 2 },
];

/// Scale and bias by n.v and perceptual roughness.
type Form<'a> = &'a (dyn Fn(f32, f32) -> [f32; 2] + Sync);

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    const PIECES: [fn(Effort) -> Vec<Row>; 3] = [pairs, multiple::rows, coupling::rows];
    run.pieces(&PIECES, |piece| piece(run.effort()))
}

/// Tables of the pair and what stands for them.
fn pairs(effort: Effort) -> Vec<Row> {
    let points = truth(effort.pick(48, 96));
    let mut rows = Vec::new();
    for layout in LAYOUTS {
        let texels = filled(layout);
        rows.extend(measured(
            layout.name,
            &points,
            |v, r| read(layout, &texels, v, r),
            |row| {
                row.bytes = Some((layout.size * layout.size * 2 * layout.bytes) as u64);
            },
        ));
    }
    // The table that shaders read, as numbers of 16 bits, and what stands for it where there is none.
    let mut stored = dfg_table(DFG_SIZE);
    for x in stored.texels.as_flattened_mut() {
        *x = half::f16::from_f32(*x).to_f32();
    }
    let read_table = |v: f32, r: f32| dfg_from_table(&stored, f64::from(v), f64::from(r));
    let forms: [(&str, Option<u64>, Form<'_>); 3] = [
        ("table", Some((DFG_SIZE * DFG_SIZE * 4) as u64), &read_table),
        ("fit", None, &dfg_fit::<f32>),
        ("karis", None, &dfg_karis::<f32>),
    ];
    let arguments: Vec<[f32; 2]> = points.iter().map(|p| [p.0 as f32, p.1 as f32]).collect();
    let mut runs: Vec<_> = forms
        .iter()
        .map(|(_, _, form)| |_| arguments.iter().map(|&[v, r]| f64::from(form(v, r)[0])).sum::<f64>())
        .collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = timing::measured(&mut candidates, effort.pick(20, 200));
    for ((name, bytes, form), time) in forms.iter().zip(times) {
        let value = |v: f64, r: f64| form(v as f32, r as f32).map(f64::from);
        rows.extend(measured(name, &points, value, |row| {
            row.take_time(time, arguments.len());
            row.bytes = *bytes;
        }));
    }
    rows
}

/// n.v and roughness at a place of the unit square, dense where either is small, from the least of both on.
fn argument([x, y]: [f64; 2], [v, r]: [f64; 2]) -> [f64; 2] {
    [v + (1.0 - v) * x.powi(3), r + (1.0 - r) * y.powf(1.5)]
}

/// The least n.v and roughness of each domain.
const DOMAINS: [(&str, [f64; 2]); 2] = [(INNER, [0.05, 0.089]), (WIDE, [0.001, 0.02])];

/// The truth on a grid over [`WIDE`].
fn truth(count: usize) -> Vec<Point> {
    let place = |i: usize| (i as f64 + 0.37) / count as f64;
    (0..count * count)
        .into_par_iter()
        .map(|k| {
            let [v, r] = argument([place(k % count), place(k / count)], DOMAINS[1].1);
            (v, r, directional_albedo_ggx(v, r))
        })
        .collect()
}

/// n.v, roughness and the pair there.
type Point = (f64, f64, [f64; 2]);

/// How much is searched for a largest error.
const SEARCH: Search = Search { starts: 8, rounds: 9 };

fn measured(
    name: &str,
    points: &[Point],
    value: impl Fn(f64, f64) -> [f64; 2] + Sync,
    with: impl Fn(&mut Row) + Sync,
) -> Vec<Row> {
    let off = |[v, r]: [f64; 2], [a, b]: [f64; 2]| {
        let found = value(v, r);
        (found[0] + found[1] - a - b).abs().max((found[1] - b).abs())
    };
    let at = |[v, r]: [f64; 2]| format!("n.v = {v:?}, roughness = {r:?}");
    let row = |&(domain, least): &(&str, [f64; 2])| {
        let mut errors = Errors::default();
        let own = points.iter().filter(|(v, r, _)| *v >= least[0] && *r >= least[1]);
        // The search goes on in the square of which the domain is made.
        let place = |v: f64, r: f64| {
            [((v - least[0]) / (1.0 - least[0])).cbrt(), ((r - least[1]) / (1.0 - least[1])).powf(1.0 / 1.5)]
        };
        let drawn: Vec<_> = own.map(|&(v, r, pair)| (place(v, r), off([v, r], pair))).collect();
        drawn.iter().for_each(|&(place, error)| errors.add(error, || at(argument(place, least))));
        // What a table is filled with is near enough to find the place; the error there is held against the truth.
        let near = |place: [f64; 2]| {
            let [v, r] = argument(place, least);
            off([v, r], dfg_near(v, r))
        };
        for (place, _) in SEARCH.worst(drawn, near) {
            let [v, r] = argument(place, least);
            errors.search(off([v, r], directional_albedo_ggx(v, r)), || at([v, r]));
        }
        let mut row = Row::new("dfg", name, domain);
        errors.fill(&mut row);
        with(&mut row);
        row
    };
    DOMAINS.par_iter().map(row).collect()
}

/// The pair to 1e-5.
fn dfg_near(n_dot_v: f64, roughness: f64) -> [f64; 2] {
    directional_albedo_ggx_with::<6>(n_dot_v, roughness, v_smith_ggx_correlated::<f64>, &gauss_legendre::<6>())
}

fn filled(layout: &Layout) -> Vec<[f64; 2]> {
    let n = layout.size;
    let place = |i: usize| if layout.vertices { i as f64 / (n - 1) as f64 } else { (i as f64 + 0.5) / n as f64 };
    let rule = gauss_legendre::<6>();
    let stored = |x: f64| if layout.bytes == 2 { f64::from(half::f16::from_f64(x)) } else { f64::from(x as f32) };
    (0..n * n)
        .map(|k| {
            let (v, r) = (place(k % n).powi(layout.powers[0]), place(k / n).powi(layout.powers[1]));
            directional_albedo_ggx_with::<6>(v, r, v_smith_ggx_correlated::<f64>, &rule).map(stored)
        })
        .collect()
}

/// As a sampler reads it: linear between texel centres, held at the edges.
fn read(layout: &Layout, texels: &[[f64; 2]], n_dot_v: f64, roughness: f64) -> [f64; 2] {
    let n = layout.size;
    let axis = |x: f64, power: i32| {
        let place = x.powf(1.0 / f64::from(power));
        let at = if layout.vertices { place * (n - 1) as f64 } else { place * n as f64 - 0.5 };
        let at = at.clamp(0.0, (n - 1) as f64);
        let low = (at as usize).min(n - 2);
        (low, at - low as f64)
    };
    let ((x, s), (y, t)) = (axis(n_dot_v, layout.powers[0]), axis(roughness, layout.powers[1]));
    std::array::from_fn(|i| {
        let at = |x: usize, y: usize| texels[y * n + x][i];
        let above = at(x, y) + (at(x + 1, y) - at(x, y)) * s;
        let below = at(x, y + 1) + (at(x + 1, y + 1) - at(x, y + 1)) * s;
        above + (below - above) * t
    })
}
