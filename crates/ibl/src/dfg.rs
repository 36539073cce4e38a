//! The split sum's second factor as a table, by quadrature in f64.

use halfvector_brdf::albedo::{directional_albedo_ggx_with, gauss_legendre};
use halfvector_brdf::ggx::{v_smith_ggx_correlated, v_smith_ggx_separable};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Which masking and shadowing the albedo is integrated with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Height-correlated Smith (Heitz 2014).
    #[default]
    Correlated,
    /// The product of both directions' G1 (Walter et al. 2007).
    Separable,
}

impl Visibility {
    fn function(self) -> fn(f64, f64, f64, f64) -> f64 {
        match self {
            Visibility::Correlated => v_smith_ggx_correlated::<f64>,
            Visibility::Separable => v_smith_ggx_separable::<f64>,
        }
    }
}

/// Scale and bias over n.v and perceptual roughness.
#[derive(Clone, Debug, PartialEq)]
pub struct DfgTable {
    /// Texels along each axis, at least 2.
    pub size: usize,
    /// `size * size` pairs (a, b), row by row: column i is n_dot_v = (i / (size - 1))^4, row j is perceptual roughness
    /// (j / (size - 1))^2. Specular albedo = f0 a + f90 b.
    pub texels: Vec<[f32; 2]>,
}

/// Texels along each axis of the table that shaders read: the largest square of f16 pairs within 8 KiB (8,100 bytes).
///
/// Largest error of a + b between texels, as f16: 9e-4 for n.v >= 0.05 and roughness >= 0.089, 2.2e-3 for n.v >= 0.001
/// and roughness >= 0.02; of b 1.6e-3 and 1.9e-3. Both axes are warped because all of the albedo's steep places lie where
/// n.v is about alpha and small; `halfvector report` has other layouts.
pub const DFG_SIZE: usize = 45;

/// Points in each panel of the quadrature: for tables, and where a single value is asked for.
const POINTS: usize = 6;
const FINE_POINTS: usize = 12;

/// The table for height-correlated Smith; `size` is held in 2..=1024.
pub fn dfg_table(size: usize) -> DfgTable {
    dfg_table_with(size, Visibility::Correlated)
}

/// The table for a visibility; `size` is held in 2..=1024.
///
/// It is made by threads of its own: one of rayon's that waits takes up other work, which may ask for the same table.
pub fn dfg_table_with(size: usize, visibility: Visibility) -> DfgTable {
    let size = size.clamp(2, 1024);
    let rule = gauss_legendre::<POINTS>();
    let place = |i: usize| i as f64 / (size - 1) as f64;
    let texel = |i: usize, j: usize| {
        let (n_dot_v, roughness) = (place(i).powi(4), place(j).powi(2));
        directional_albedo_ggx_with::<POINTS>(n_dot_v, roughness, visibility.function(), &rule).map(|x| x as f32)
    };
    let mut texels = vec![[0.0; 2]; size * size];
    {
        let rows = Mutex::new(texels.chunks_mut(size).enumerate());
        let next = || rows.lock().unwrap_or_else(PoisonError::into_inner).next();
        let fill = || {
            while let Some((j, row)) = next() {
                row.iter_mut().enumerate().for_each(|(i, pair)| *pair = texel(i, j));
            }
        };
        let others = std::thread::available_parallelism().map_or(0, |cores| cores.get() - 1);
        std::thread::scope(|scope| {
            (0..others.min(size)).for_each(|_| drop(scope.spawn(fill)));
            fill();
        });
    }
    DfgTable { size, texels }
}

/// The table of [`DFG_SIZE`] that shaders read, made once in a process for each visibility.
pub fn dfg_table_of_shaders(visibility: Visibility) -> &'static DfgTable {
    static TABLES: [OnceLock<DfgTable>; 2] = [OnceLock::new(), OnceLock::new()];
    let table = &TABLES[usize::from(visibility == Visibility::Separable)];
    table.get_or_init(|| dfg_table_with(DFG_SIZE, visibility))
}

/// Scale and bias (a, b) of one n.v and perceptual roughness, both held in 0..=1, to 1e-8:
/// [`halfvector_brdf::albedo::directional_albedo_ggx`] for a visibility.
pub fn dfg(n_dot_v: f64, perceptual_roughness: f64, visibility: Visibility) -> [f64; 2] {
    let rule = gauss_legendre::<FINE_POINTS>();
    directional_albedo_ggx_with::<FINE_POINTS>(n_dot_v, perceptual_roughness, visibility.function(), &rule)
}
