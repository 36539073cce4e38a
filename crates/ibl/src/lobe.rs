//! Lobes too narrow for the harmonic series: prefiltered radiance by direct quadrature around each direction.

use crate::cube::{Cube, unit};
use crate::environment::environment_sample;
use std::f64::consts::PI;

/// Rings about the lobe's middle, and lookups on each.
const RINGS: usize = 16;
const SECTORS: usize = 16;

/// Prefilters a cube with a GGX lobe (n = v = r) of `alpha` > 0 that is narrow: a few texels of the source.
///
/// Křivánek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling": lookups at the lobe's own quantiles,
/// each in a level of the source whose texels are as large as the solid angle that the lookup stands for. Here the
/// quantiles are those of a fixed polar grid, turned from ring to ring, so nothing is random. Between the rings light is
/// smoothed over, about 1 % for ordinary pictures and more beside a lamp far brighter than its surroundings.
pub(crate) fn narrow_lobe(source: &Cube, alpha: f64, size: usize) -> Cube {
    let mut pyramid = vec![source.clone()];
    while let Some(last) = pyramid.last().filter(|last| last.size > 1) {
        let next = last.halved();
        pyramid.push(next);
    }
    let texel = 4.0 * PI / (6 * source.size * source.size) as f64;
    let samples: Vec<Sample> = (0..RINGS)
        .flat_map(|ring| {
            // Walter et al. 2007, equations 35 and 36: tan^2 theta_h = alpha^2 u / (1 - u).
            let u = (ring as f64 + 0.5) / RINGS as f64;
            let tan2 = alpha * alpha * u / (1.0 - u);
            let cos_h2 = 1.0 / (1.0 + tan2);
            let cos_l = 2.0 * cos_h2 - 1.0;
            let sin_l = (1.0 - cos_l * cos_l).max(0.0).sqrt();
            // The density of l is D / 4 when n = v; the solid angle is what one of all lookups stands for.
            let d = alpha * alpha / (PI * (cos_h2 * (alpha * alpha + tan2)).powi(2));
            let lod = 0.5 * (4.0 / (d * (RINGS * SECTORS) as f64) / texel).log2();
            (0..SECTORS).filter(move |_| cos_l > 0.0).map(move |sector| {
                let phi = 2.0 * PI * (sector as f64 + 0.618_034 * ring as f64) / SECTORS as f64;
                Sample { local: [sin_l * phi.cos(), sin_l * phi.sin(), cos_l], lod }
            })
        })
        .collect();
    Cube::from_fn(size, |dir| {
        let [t, b] = basis(dir);
        let mut sum = [0.0f64; 3];
        let mut weight = 0.0;
        for sample in &samples {
            let [x, y, z] = sample.local;
            let l = std::array::from_fn(|i| t[i] * x + b[i] * y + dir[i] * z);
            let texel = environment_sample(&pyramid, l, sample.lod);
            weight += z;
            for c in 0..3 {
                sum[c] += z * f64::from(texel[c]);
            }
        }
        sum.map(|x| (x / weight) as f32)
    })
}

struct Sample {
    local: [f64; 3],
    lod: f64,
}

/// Two unit vectors at right angles to a unit vector and to each other.
fn basis(n: [f64; 3]) -> [[f64; 3]; 2] {
    let axis = if n[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let t = unit(cross(axis, n));
    [t, cross(n, t)]
}
