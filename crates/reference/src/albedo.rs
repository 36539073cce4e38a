//! Directional albedo of the GGX lobe, as it scales other lobes: quadrature at the nodes of a table, cubic between them.

use std::sync::OnceLock;

use halfvector_ibl::{DfgTable, Visibility, dfg_table_with};

/// Nodes along each axis.
const SIZE: usize = 128;

/// (a, b) over n.v and perceptual roughness.
pub(crate) struct Albedo {
    table: DfgTable,
}

impl Albedo {
    /// That of height-correlated or of separable visibility, made once in a process.
    pub(crate) fn of(separable: bool) -> &'static Albedo {
        static ALBEDOS: [OnceLock<Albedo>; 2] = [OnceLock::new(), OnceLock::new()];
        let visibility = if separable { Visibility::Separable } else { Visibility::Correlated };
        ALBEDOS[usize::from(separable)].get_or_init(|| Albedo { table: dfg_table_with(SIZE, visibility) })
    }

    /// The pair, within 1e-4 of the integral for cosines from 1e-3. Both arguments are held in 0..1.
    pub(crate) fn pair(&self, n_dot_v: f64, perceptual_roughness: f64) -> [f64; 2] {
        let last = (SIZE - 1) as f64;
        let (column, across) = node(n_dot_v.clamp(0.0, 1.0).powf(0.25) * last);
        let (row, down) = node(perceptual_roughness.clamp(0.0, 1.0).sqrt() * last);
        let mut sum = [0.0; 2];
        for (j, wy) in down.iter().enumerate() {
            for (i, wx) in across.iter().enumerate() {
                let texel = self.table.texels[(row + j) * SIZE + column + i];
                sum[0] += wx * wy * f64::from(texel[0]);
                sum[1] += wx * wy * f64::from(texel[1]);
            }
        }
        sum
    }
}

/// The first of four nodes round a place, and the weights of Lagrange's cubic through them.
fn node(x: f64) -> (usize, [f64; 4]) {
    let first = (x.floor() as usize).saturating_sub(1).min(SIZE - 4);
    let t = x - first as f64;
    let weight = |k: usize| (0..4).filter(|j| *j != k).map(|j| (t - j as f64) / (k as f64 - j as f64)).product::<f64>();
    (first, std::array::from_fn(weight))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_nodes_it_is_the_integral() {
        let mut largest: f64 = 0.0;
        let albedo = Albedo::of(false);
        for i in 0..12 {
            for j in 0..12 {
                let (mu, r) = (((f64::from(i) + 0.37) / 12.0).powi(2), (f64::from(j) + 0.61) / 12.2);
                let (a, b) = (albedo.pair(mu, r), halfvector_ibl::dfg(mu, r, Visibility::Correlated));
                largest = largest.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
            }
        }
        println!("largest error of the table: {largest:.1e}");
        assert!(largest < 1e-4, "{largest}");
    }
}
