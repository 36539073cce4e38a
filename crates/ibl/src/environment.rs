//! Reading a baked environment: rotation, level of detail, cube lookup, diffuse irradiance, split-sum table.
//!
//! Twins of the functions of `shaders/ibl/environment.wgsl`; those that read textures there read cubes and tables here.

use crate::cube::{Cube, interpolated};
use crate::dfg::DfgTable;
use halfvector_brdf::Real;

/// World direction to environment direction when the environment is turned counter-clockwise seen from above (+Y) by an
/// angle a: the rotation Ry(-a). `cos_sin` = (cos a, sin a), computed once.
pub fn rotate_about_y<R: Real>(dir: [R; 3], cos_sin: [R; 2]) -> [R; 3] {
    let [cos, sin] = cos_sin;
    [cos * dir[0] - sin * dir[2], dir[1], sin * dir[0] + cos * dir[2]]
}

/// Level that holds a perceptual roughness when level 0 is the unfiltered environment, level 1 is prefiltered for 0.1, the
/// last for 1, and each between them for the same multiple of the one before.
pub fn lod_geometric<R: Real>(perceptual_roughness: R, levels: R) -> R {
    let ten = R::of(10.0);
    let above = R::ONE + (levels - R::of(2.0)) * ((ten * perceptual_roughness).max(R::ONE).log2() / ten.log2());
    let below = ten * perceptual_roughness;
    R::choose(below.lt(R::ONE), below, above).min(levels - R::ONE)
}

/// Level that holds a perceptual roughness when level i of n is prefiltered for i / (n - 1).
pub fn lod_linear<R: Real>(perceptual_roughness: R, levels: R) -> R {
    perceptual_roughness * (levels - R::ONE)
}

/// Level as the report reads it: lod = 5 roughness, for six levels 0..5 (fewer levels end at their last).
pub fn lod_report<R: Real>(perceptual_roughness: R, levels: R) -> R {
    (R::of(5.0) * perceptual_roughness).min(levels - R::ONE)
}

/// Radiance that arrives from a direction, prefiltered as much as the level says; mixed linearly between levels.
///
/// `dir` need not be unit. `lod` is held within the levels; no levels give 0.
pub fn environment_sample(levels: &[Cube], dir: [f64; 3], lod: f64) -> [f32; 3] {
    let Some(last) = levels.len().checked_sub(1) else { return [0.0; 3] };
    let lod = if lod > 0.0 { lod.min(last as f64) } else { 0.0 };
    let mip = lod.floor() as usize;
    let t = (lod - mip as f64) as f32;
    let near = levels[mip].sample(dir);
    if t == 0.0 {
        return near;
    }
    let far = levels[(mip + 1).min(last)].sample(dir);
    std::array::from_fn(|i| near[i] + (far[i] - near[i]) * t)
}

/// Radiance between two levels of which the fourth channel holds how log2(red + green + blue) changes from level to level,
/// as a derivative; `t` is 0 at `near` and 1 at `far`.
///
/// Where a lobe meets a lamp the light goes with a power of its width, falling in the middle and rising outside, so that
/// logarithms are mixed: of the colours linearly, and of their sum by Hermite's cubic, which also follows the slopes.
/// Black is taken as 1e-7, about the least that half precision holds.
pub fn mix_levels<R: Real>(near: [R; 4], far: [R; 4], t: R) -> [R; 3] {
    let bright = |texel: [R; 4]| [0, 1, 2].map(|i| texel[i].max(R::of(1e-7)));
    let (n, f) = (bright(near), bright(far));
    let rise = ((f[0] + f[1] + f[2]) / (n[0] + n[1] + n[2])).log2();
    let bend = t * (R::ONE - t) * ((R::ONE - t) * (near[3] - rise) - t * (far[3] - rise));
    [0, 1, 2].map(|i| (t * (f[i] / n[i]).log2() + bend).exp2() * n[i])
}

/// Radiance that arrives from a direction, prefiltered as much as the level says, from levels with slopes: see
/// [`mix_levels`]. Below level 1, where the environment itself may be black, the mix is linear.
///
/// `slopes` holds a number for each texel of `levels`. `lod` is held within the levels; no levels give 0.
pub fn environment_sample_hermite(levels: &[Cube], slopes: &[Vec<f32>], dir: [f64; 3], lod: f64) -> [f32; 3] {
    let Some(last) = levels.len().checked_sub(1) else { return [0.0; 3] };
    if lod.is_nan() || lod < 1.0 || slopes.len() <= last {
        return environment_sample(levels, dir, lod);
    }
    let lod = lod.min(last as f64);
    let mip = lod.floor() as usize;
    let texel = |mip: usize| {
        let (level, slopes) = (&levels[mip], &slopes[mip]);
        interpolated(level.size, dir, |index| {
            let [r, g, b] = level.texels[index];
            [r, g, b, slopes[index]]
        })
    };
    mix_levels(texel(mip), texel((mip + 1).min(last)), (lod - mip as f64) as f32)
}

/// Diffuse irradiance over pi of nine spherical-harmonic coefficients (order 2).
/// Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation 13, with the
/// basis constants and the cosine factors (1, 2/3, 1/4) folded into the coefficients:
///
/// ```text
/// E/pi = c0 + c1 y + c2 z + c3 x + c4 xy + c5 yz + c6 (3z^2 - 1) + c7 xz + c8 (x^2 - y^2)
/// ```
///
/// `dir` is unit. The floor at 0 removes the negative lobe that order 2 leaves opposite a small bright lamp.
pub fn irradiance_sh2<R: Real>(coefficients: [[R; 4]; 9], dir: [R; 3]) -> [R; 3] {
    let [x, y, z] = dir;
    [0, 1, 2].map(|i| {
        let c = |k: usize| coefficients[k][i];
        let linear = c(1) * y + c(2) * z + c(3) * x;
        let mixed = c(4) * (x * y) + c(5) * (y * z) + c(7) * (x * z);
        let squares = c(6) * (R::of(3.0) * z * z - R::ONE) + c(8) * (x * x - y * y);
        (c(0) + linear + mixed + squares).max(R::ZERO)
    })
}

/// Split-sum scale and bias (a, b) from a square table: specular albedo = f0 a + f90 b.
/// Karis 2013, "Real Shading in Unreal Engine 4", the environment BRDF. Texel centre i of n holds the value at i / (n - 1),
/// along x for the fourth root of n_dot_v and along y for the square root of the perceptual roughness: both ends of each
/// range are texels, and smooth surfaces at grazing angles, whose albedo changes within n_dot_v of about alpha, have most.
pub fn dfg_from_table(table: &DfgTable, n_dot_v: f64, perceptual_roughness: f64) -> [f32; 2] {
    let last = table.size - 1;
    let place = |x: f64| {
        let x = if x > 0.0 { x.min(1.0) } else { 0.0 } * last as f64;
        let low = (x.floor() as usize).min(last);
        (low, (low + 1).min(last), (x - low as f64) as f32)
    };
    let ((x0, x1, s), (y0, y1, t)) = (place(n_dot_v.sqrt().sqrt()), place(perceptual_roughness.sqrt()));
    let at = |x: usize, y: usize| table.texels[y * table.size + x];
    std::array::from_fn(|i| {
        let above = at(x0, y0)[i] + (at(x1, y0)[i] - at(x0, y0)[i]) * s;
        let below = at(x0, y1)[i] + (at(x1, y1)[i] - at(x0, y1)[i]) * s;
        above + (below - above) * t
    })
}
