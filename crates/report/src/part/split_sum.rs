//! The split sum's model error: what is left when prefiltered light and the table of albedos are exact. It is no error of a
//! prefilter, and no filter can mend it.

use super::ibl::{add, direction, direction_at, unit};
use crate::error::Errors;
use crate::search;
use crate::timing::measured;
use crate::{Effort, Row};
use halfvector_brdf::ggx::{d_ggx, v_smith_ggx_correlated};
use halfvector_ibl::environment::{dfg_from_table, environment_sample_hermite, lod_geometric};
use halfvector_ibl::{
    BakedEnvironment, DFG_SIZE, Equirect, LoadedEnvironment, Quadrature, Source, Visibility, dfg, dfg_table,
    direction_from_equirect, equirect_texel_solid_angle,
};
use rayon::prelude::*;

const N_DOT_V: [f64; 4] = [0.15, 0.3, 0.6, 1.0];
const ROUGHNESS: [f64; 4] = [0.2, 0.4, 0.7, 1.0];

/// Reflectance at normal incidence: a dielectric, gold.
const F0: [[f64; 3]; 2] = [[0.04; 3], [1.0, 0.71, 0.29]];

/// The methods of the rows: the split sum, and the sum over all light.
pub(crate) const MODEL: &str = "model";
pub(crate) const WHOLE: &str = "full integration";

/// Rows of the map that stands for the environment, and pieces along an edge of each of its texels.
const ROWS: usize = 128;
const PIECES: usize = 2;

/// A row for each n.v and roughness, over directions of the normal and both reflectances: prefiltered light times
/// (F0 a + b), both without numerical error, against the integral of light times the lobe. What it takes is the same for all of
/// them: it reads `baked` and the table of albedos. The integral, which reads the map, has one row, and no error: it is the truth.
pub(super) fn rows(effort: Effort, name: &str, environment: &LoadedEnvironment, baked: &BakedEnvironment) -> Vec<Row> {
    let Source::Equirect(map) = &environment.source else { return Vec::new() };
    // Both sides see this map: how coarse it is changes what is lit, not what the model loses.
    let map = map.area_resampled(2 * ROWS, ROWS);
    let (truth, cells) = (Quadrature::new(&map), cells(&map));
    let costs = costs(effort, baked, &cells);
    let of_view = |n_dot_v: f64| -> [Row; ROUGHNESS.len()] {
        let pairs = ROUGHNESS.map(|roughness| dfg(n_dot_v, roughness, Visibility::Correlated));
        // A normal, the view, and for each roughness what is reflected and the prefiltered light.
        let points: Vec<_> = (0..effort.pick(120, 600))
            .into_par_iter()
            .map(|k| {
                let [a, b, turn] = search::place(k);
                let n = direction_at([a, b]);
                let v = view(n, n_dot_v, turn);
                let reflected = unit(std::array::from_fn(|i| 2.0 * n_dot_v * n[i] - v[i]));
                let lit = reflection(&cells, n, v, ROUGHNESS.map(|roughness| roughness * roughness));
                (n, v, lit, ROUGHNESS.map(|roughness| truth.prefiltered(reflected, roughness)))
            })
            .collect();
        std::array::from_fn(|i| {
            let domain = format!(
                "{name}: the split sum's model error, n.v {n_dot_v}, roughness {}; exact levels times exact \
                 (F0 a + b), relative to the integral of light times the lobe",
                ROUGHNESS[i]
            );
            let ([a, b], mut errors) = (pairs[i], Errors::default());
            for (n, v, lit, prefiltered) in &points {
                let [light_a, light_b] = lit[i];
                for f0 in F0 {
                    let split = std::array::from_fn(|c| (prefiltered[i][c] * (f0[c] * a + b)) as f32);
                    let exact = std::array::from_fn(|c| f0[c] * light_a[c] + light_b[c]);
                    let mean = std::array::from_fn(|c| truth.mean()[c] * (f0[c] * a + b));
                    add(&mut errors, split, exact, mean, || format!("normal = {n:?}, view = {v:?}, f0 = {f0:?}"));
                }
            }
            let mut row = Row { domain, ..costs[0].clone() };
            errors.fill(&mut row);
            row
        })
    };
    let mut rows: Vec<Row> = N_DOT_V.into_iter().flat_map(of_view).collect();
    let domain = format!("{name}: the integral of light times the lobe over every texel; the truth of the other rows");
    rows.push(Row { domain, ..costs[1].clone() });
    rows
}

/// A row of each way with its time and memory: one reflection on one core.
fn costs(effort: Effort, baked: &BakedEnvironment, cells: &[[f64; 6]]) -> [Row; 2] {
    const READS: usize = 64;
    let table = dfg_table(DFG_SIZE);
    let levels = baked.radiance.len() as f64;
    let n = [0.0, 1.0, 0.0];
    let mut split = |_: usize| {
        let read = |k: usize| {
            let (roughness, n_dot_v) = (ROUGHNESS[k % 4], N_DOT_V[k / 4 % 4]);
            let [a, b] = dfg_from_table(&table, n_dot_v, roughness);
            let lod = lod_geometric(roughness, levels);
            let [r, ..] = environment_sample_hermite(&baked.radiance, &baked.slope, direction(k), lod);
            f64::from(r * (a + b))
        };
        (0..READS).map(read).sum()
    };
    let mut whole = |_: usize| reflection(cells, n, view(n, N_DOT_V[2], 0.0), [0.16])[0][0][0];
    let times = measured(&mut [&mut split, &mut whole], effort.pick(5, 20));
    let mut rows = [MODEL, WHOLE].map(|method| Row::new("split_sum", method, ""));
    rows[0].take_time(times[0], READS);
    rows[1].take_time(times[1], 1);
    let texels: usize = baked.radiance.iter().map(|cube| cube.texels.len()).sum();
    // Texels of four numbers of 16 bits, and the table's of two.
    rows[0].bytes = Some((8 * texels + 4 * DFG_SIZE * DFG_SIZE) as u64);
    rows[1].bytes = Some((6 * cells.len() / (PIECES * PIECES)) as u64);
    rows
}

/// The pieces of a map's texels: direction x, y, z, and radiance times solid angle.
pub(super) fn cells(map: &Equirect) -> Vec<[f64; 6]> {
    let (width, height) = (PIECES * map.width, PIECES * map.height);
    let cell = |k: usize| {
        let (row, column) = (k / width, k % width);
        let [x, y, z] =
            direction_from_equirect((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
        let area = equirect_texel_solid_angle(width, height, row);
        let [r, g, b] = map.pixels[row / PIECES * map.width + column / PIECES].map(|x| f64::from(x) * area);
        [x, y, z, r, g, b]
    };
    (0..width * height).map(cell).collect()
}

/// A unit direction at this cosine to the unit normal, and this share of a turn around it.
pub(super) fn view(n: [f64; 3], n_dot_v: f64, turn: f64) -> [f64; 3] {
    let aside = if n[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let along = n[0] * aside[0] + n[1] * aside[1] + n[2] * aside[2];
    let t = unit(std::array::from_fn(|i| aside[i] - along * n[i]));
    let b = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
    let ((sin, cos), across) = ((std::f64::consts::TAU * turn).sin_cos(), (1.0 - n_dot_v * n_dot_v).sqrt());
    std::array::from_fn(|i| n_dot_v * n[i] + across * (cos * t[i] + sin * b[i]))
}

/// For each alpha the sums of light times D V n.l (1 - (1 - l.h)^5) and times D V n.l (1 - l.h)^5: the reflection is F0 times the first
/// plus the second (Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering").
fn reflection<const N: usize>(cells: &[[f64; 6]], n: [f64; 3], v: [f64; 3], alphas: [f64; N]) -> [[[f64; 3]; 2]; N] {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let n_dot_v = dot(n, v);
    let mut sums = [[[0.0; 3]; 2]; N];
    for &[x, y, z, r, g, b] in cells {
        let l = [x, y, z];
        let n_dot_l = dot(n, l);
        if n_dot_l <= 0.0 {
            continue;
        }
        let h = unit(std::array::from_fn(|i| l[i] + v[i]));
        let (n_dot_h, l_dot_h) = (dot(n, h), dot(l, h));
        let fresnel = (1.0 - l_dot_h).max(0.0).powi(5);
        for (sums, alpha) in sums.iter_mut().zip(alphas) {
            let d = d_ggx(n_dot_h, (1.0 - n_dot_h * n_dot_h).max(0.0), alpha);
            let weight = d * v_smith_ggx_correlated(n_dot_v, n_dot_l, l_dot_h, alpha) * n_dot_l;
            for (sum, share) in sums.iter_mut().zip([1.0 - fresnel, fresnel]) {
                for (sum, light) in sum.iter_mut().zip([r, g, b]) {
                    *sum += weight * share * light;
                }
            }
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfvector_ibl::BakeOptions;

    /// Under an even sky the split sum is exact: what the rows show is the model's error, not that of their sums, which is a percent and a half
    /// where the view grazes and the lobe is narrow.
    #[test]
    fn white_has_no_error() {
        let white = halfvector_ibl::white();
        let baked = halfvector_ibl::bake(&white, &BakeOptions { size: 16, ..BakeOptions::default() });
        let Row { error_max, .. } = rows(Effort::Quick, "white", &white, &baked)
            .into_iter()
            .max_by(|a, b| a.error_max.partial_cmp(&b.error_max).expect("numbers"))
            .expect("a row");
        assert!(error_max.is_some_and(|error| error < 0.02), "{error_max:?}");
    }
}
