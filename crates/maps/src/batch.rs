//! Normal mapping of many texels at once: one array for each component, and the widest vectors that the machine has.
//!
//! The functions are those of [`crate::normal`], texel for texel and bit for bit: they hold no branch that a compiler cannot
//! turn into a choice, so the loop around them becomes vectors by itself. `pulp` chooses the instruction set at run time
//! (AVX2 with FMA, or what the target has), without unsafe code here. It does not use several threads: give each its part.

use pulp::Arch;

use crate::normal::{normal_from_texel, normal_rotation_fixed, normal_rotation_report, normal_tbn};

/// Texels that the loop body works on: enough to fill vectors several times over, few enough to stay in the first cache.
const BLOCK: usize = 64;

/// [`normal_from_texel`] of each texel: red, green and blue in 0..1, to x, y and z.
///
/// # Panics
/// When the arrays are not all of one length.
pub fn normals_from_texels(color: [&[f32]; 3], strength: f32, flip_y: bool, out: [&mut [f32]; 3]) {
    each(color, out, |c| normal_from_texel(c, strength, flip_y));
}

/// [`normal_tbn`] of each texel: tangent-space normals, normals and tangents with handedness, to x, y and z.
///
/// # Panics
/// When the arrays are not all of one length.
pub fn normals_tbn(n_tangent: [&[f32]; 3], normal: [&[f32]; 3], tangent: [&[f32]; 4], out: [&mut [f32]; 3]) {
    let ([a, b, c], [d, e, f], [g, h, i, j]) = (n_tangent, normal, tangent);
    each([a, b, c, d, e, f, g, h, i, j], out, |[a, b, c, d, e, f, g, h, i, j]| {
        normal_tbn([a, b, c], [d, e, f], [g, h, i, j])
    });
}

/// [`normal_rotation_report`] of each texel.
///
/// # Panics
/// When the arrays are not all of one length.
pub fn normals_rotation_report(n_tangent: [&[f32]; 3], normal: [&[f32]; 3], out: [&mut [f32]; 3]) {
    let ([a, b, c], [d, e, f]) = (n_tangent, normal);
    each([a, b, c, d, e, f], out, |[a, b, c, d, e, f]| normal_rotation_report([a, b, c], [d, e, f]));
}

/// [`normal_rotation_fixed`] of each texel.
///
/// # Panics
/// When the arrays are not all of one length.
pub fn normals_rotation_fixed(n_tangent: [&[f32]; 3], normal: [&[f32]; 3], out: [&mut [f32]; 3]) {
    let ([a, b, c], [d, e, f]) = (n_tangent, normal);
    each([a, b, c, d, e, f], out, |[a, b, c, d, e, f]| normal_rotation_fixed([a, b, c], [d, e, f]));
}

/// Calls `f` for each place of the arrays. Blocks are copied to arrays of known length, which have no bounds to check and
/// cannot overlap.
fn each<const N: usize>(inputs: [&[f32]; N], out: [&mut [f32]; 3], f: impl Fn([f32; N]) -> [f32; 3]) {
    let count = out[0].len();
    let lengths = inputs.iter().map(|a| a.len()).chain(out.iter().map(|a| a.len()));
    assert!(lengths.clone().all(|n| n == count), "arrays of one length: {:?}", lengths.collect::<Vec<_>>());
    let [out_x, out_y, out_z] = out;
    Arch::new().dispatch(|| {
        let mut block = [[0.0_f32; BLOCK]; N];
        let mut result = [[0.0_f32; BLOCK]; 3];
        for start in (0..count).step_by(BLOCK) {
            let end = count.min(start + BLOCK);
            for (block, input) in block.iter_mut().zip(&inputs) {
                block[..end - start].copy_from_slice(&input[start..end]);
            }
            for i in 0..BLOCK {
                let [x, y, z] = f(std::array::from_fn(|k| block[k][i]));
                (result[0][i], result[1][i], result[2][i]) = (x, y, z);
            }
            for (out, result) in [&mut *out_x, &mut *out_y, &mut *out_z].into_iter().zip(&result) {
                out[start..end].copy_from_slice(&result[..end - start]);
            }
        }
    });
}
