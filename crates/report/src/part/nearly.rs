//! About what a sum over every texel gives, in a hundredth of its time: far from the middle of the lobe many texels count as one. Says where
//! an error is large; how large it is there is held against the sum over every texel.

use halfvector_ibl::{Equirect, direction_from_equirect, equirect_texel_solid_angle};

use super::ibl::unit;

/// Texels along an edge of a block.
const EDGE: usize = 8;

/// Pieces along an edge of a texel that is not small against the lobe.
const PIECES: usize = 4;

/// A block is opened where it is more of the lobe's width and its distance than this.
const SMALL: f64 = 0.15;

/// A map ready to be summed quickly.
pub(super) struct Nearly {
    width: usize,
    height: usize,
    blocks: Vec<Block>,
}

struct Block {
    /// The middle of its light.
    middle: [f64; 3],
    /// How far from there the farthest texel reaches.
    reach: f64,
    /// Radiance times solid angle.
    light: [f64; 3],
    texels: Vec<Texel>,
    /// How much brighter its brightest texel is than its darkest, and where that is.
    rise: (f64, [f64; 3]),
}

struct Texel {
    dir: [f64; 3],
    light: [f64; 3],
    /// Column and row.
    place: [f64; 2],
}

impl Nearly {
    pub(super) fn new(map: &Equirect) -> Nearly {
        let (width, height) = (map.width, map.height);
        let corner = |k: usize| [k % width.div_ceil(EDGE) * EDGE, k / width.div_ceil(EDGE) * EDGE];
        let block = |k: usize| {
            let [left, top] = corner(k);
            let rows = top..(top + EDGE).min(height);
            let places = rows.flat_map(|row| (left..(left + EDGE).min(width)).map(move |column| (column, row)));
            Block::new(map, places)
        };
        Nearly { width, height, blocks: (0..width.div_ceil(EDGE) * height.div_ceil(EDGE)).map(block).collect() }
    }

    /// As `Quadrature::prefiltered` says, nearly.
    pub(super) fn prefiltered(&self, dir: [f64; 3], roughness: f64) -> [f64; 3] {
        let a2 = roughness.powi(4);
        let texel = std::f64::consts::PI / self.height as f64;
        let even = (6.0 * texel).powi(2) - 4.0 * a2;
        let mut sum = [0.0; 3];
        let mut add = |weight: f64, light: [f64; 3]| (0..3).for_each(|c| sum[c] += weight * light[c]);
        for block in &self.blocks {
            let apart = squared(block.middle, dir);
            // The lobe ends where light comes from below.
            let ends = a2 > 1e-3 && (1.0 - 0.5 * apart).abs() < block.reach;
            if !ends && block.reach.powi(2) < SMALL.powi(2) * (apart + 4.0 * a2) {
                add(weight(apart, a2), block.light);
                continue;
            }
            for one in &block.texels {
                let apart = squared(one.dir, dir);
                add(if apart < even { self.cut_up(one.place, dir, a2) } else { weight(apart, a2) }, one.light);
            }
        }
        sum.map(|x| x / whole(a2))
    }

    /// The mean weight over a texel.
    fn cut_up(&self, [column, row]: [f64; 2], dir: [f64; 3], a2: f64) -> f64 {
        let piece = |k: usize| (k as f64 + 0.5) / PIECES as f64;
        let at = |k: usize| {
            let (x, y) = (column + piece(k % PIECES), row + piece(k / PIECES));
            weight(squared(direction_from_equirect(x / self.width as f64, y / self.height as f64), dir), a2)
        };
        (0..PIECES * PIECES).map(at).sum::<f64>() / (PIECES * PIECES) as f64
    }

    /// Where light changes most within a few texels: so many directions, no two of them near each other.
    pub(super) fn edges(&self, count: usize) -> Vec<[f64; 3]> {
        let mut all: Vec<(f64, [f64; 3])> = self.blocks.iter().map(|block| block.rise).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut found: Vec<[f64; 3]> = Vec::new();
        for (_, dir) in all {
            if found.len() < count && found.iter().all(|other| squared(*other, dir) > 0.1_f64.powi(2)) {
                found.push(dir);
            }
        }
        found
    }

    /// The middle of the brightest block.
    pub(super) fn brightest(&self) -> [f64; 3] {
        let light = |block: &Block| block.light.iter().sum::<f64>();
        let most = self.blocks.iter().max_by(|a, b| light(a).total_cmp(&light(b)));
        most.map_or([0.0, 1.0, 0.0], |block| block.middle)
    }
}

impl Block {
    fn new(map: &Equirect, places: impl Iterator<Item = (usize, usize)>) -> Block {
        let texel = |(column, row): (usize, usize)| {
            let place = [column as f64, row as f64];
            let dir =
                direction_from_equirect((place[0] + 0.5) / map.width as f64, (place[1] + 0.5) / map.height as f64);
            let area = equirect_texel_solid_angle(map.width, map.height, row);
            Texel { dir, light: map.pixels[row * map.width + column].map(|x| f64::from(x) * area), place }
        };
        let texels: Vec<Texel> = places.map(texel).collect();
        let bright = |texel: &Texel| texel.light.iter().sum::<f64>();
        let mean = |of: &dyn Fn(&Texel) -> [f64; 3]| -> [f64; 3] {
            texels.iter().fold([0.0; 3], |sum, texel| std::array::from_fn(|i| sum[i] + of(texel)[i]))
        };
        let middle = mean(&|texel| texel.dir.map(|x| x * bright(texel).max(1e-30)));
        let middle = unit(middle);
        let half = std::f64::consts::FRAC_PI_2 / map.height as f64;
        let far = texels.iter().map(|texel| squared(texel.dir, middle)).fold(0.0, f64::max).sqrt();
        let by_light = |a: &&Texel, b: &&Texel| bright(a).total_cmp(&bright(b));
        let (least, most) = (texels.iter().min_by(by_light), texels.iter().max_by(by_light));
        let rise = match (least, most) {
            (Some(least), Some(most)) => (bright(most) / bright(least).max(1e-30), most.dir),
            _ => (0.0, middle),
        };
        Block { middle, reach: far + half, light: mean(&|texel| texel.light), texels, rise }
    }
}

fn squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)
}

/// The lobe's weight at a squared chord, as `Quadrature` has it.
fn weight(apart: f64, a2: f64) -> f64 {
    let d = 0.25 * apart * (1.0 - a2) + a2;
    (1.0 - 0.5 * apart).max(0.0) / (d * d)
}

/// The integral of the weight over the sphere.
fn whole(a2: f64) -> f64 {
    let m = 0.5 * (1.0 - a2);
    if m < 1e-4 {
        return std::f64::consts::PI;
    }
    let (first, end) = ((1.0 / a2 - 1.0 / (m + a2)) / m, m + a2);
    2.0 * std::f64::consts::PI * (first - ((end / a2).ln() + a2 / end - 1.0) / (m * m))
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfvector_ibl::{Quadrature, Source, sky, studio};

    /// Beside the sum over every texel it errs by a percent at most, next to what is brightest: enough to say where to look.
    #[test]
    fn it_is_near_the_sum_over_every_texel() {
        for environment in [studio(), sky()] {
            let Source::Equirect(map) = &environment.source else { panic!("a map") };
            let (exact, near) = (Quadrature::new(map), Nearly::new(map));
            for (k, roughness) in [0.1, 0.2154, 0.35, 0.6, 1.0].into_iter().enumerate() {
                let mut worst = 0.0_f64;
                for i in 0..12 {
                    let dir = super::super::ibl::direction(12 * k + i);
                    let (a, b) = (exact.prefiltered(dir, roughness), near.prefiltered(dir, roughness));
                    worst = (0..3).map(|c| (a[c] - b[c]).abs() / a[c]).fold(worst, f64::max);
                }
                println!("roughness {roughness}: {worst:.1e}");
                assert!(worst < 2e-2, "roughness {roughness}: {worst}");
            }
        }
    }
}
