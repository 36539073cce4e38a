//! How textures are sampled: addressing, filtering, levels, seamless cubes.

use super::{Shape, Texture};
use crate::real::Float;

/// What happens outside of 0..1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The texture is repeated.
    Repeat,
    /// The texels at the edge go on.
    #[default]
    Clamp,
    /// The texture is repeated, every other time mirrored.
    Mirror,
}

impl Address {
    /// The texel that stands for one that may lie outside of `0..count`.
    fn wrapped(self, at: i64, count: i64) -> i64 {
        if (0..count).contains(&at) {
            return at;
        }
        match self {
            Address::Clamp => at.clamp(0, count - 1),
            Address::Repeat => at.rem_euclid(count),
            Address::Mirror => {
                let place = at.rem_euclid(2 * count);
                place.min(2 * count - 1 - place)
            }
        }
    }
}

/// How numbers between texels or levels are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest one.
    #[default]
    Nearest,
    /// Between the neighbours.
    Linear,
}

/// How the level is found from the length l, in texels, that a pixel covers. WGSL leaves this to the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LevelRule {
    /// log2 l.
    #[default]
    Exact,
    /// Half of the chords of log2 over l^2 between powers of two: `e + m - 1` for l^2 = m 2^e, 1 <= m < 2. Below log2 l by up
    /// to 0.0431, and less than the sixteenth that Vulkan's least `mipmapPrecisionBits` of 4 tells apart. Mesa's llvmpipe
    /// computes levels so, and it needs no logarithm.
    Chords,
}

impl LevelRule {
    /// The level for the square of the length.
    fn level<F: Float>(self, squared: F) -> F {
        match self {
            LevelRule::Chords if squared > F::ZERO => {
                let exponent = F::number(f64::from(squared.exponent()));
                (exponent * F::HALF - F::ONE) + squared.significand()
            }
            LevelRule::Exact | LevelRule::Chords => squared.log2() * F::HALF,
        }
    }
}

/// How a texture is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampler {
    /// Along x, y, z; cubes need none.
    pub address: [Address; 3],
    /// Where a texel covers more than a pixel.
    pub magnify: Filter,
    /// Where it covers less.
    pub minify: Filter,
    /// Between levels.
    pub levels: Filter,
    /// Least and greatest level.
    pub level_range: [f32; 2],
    /// From derivatives to levels.
    pub level_rule: LevelRule,
}

impl Default for Sampler {
    /// WebGPU's: clamp, nearest, levels 0 to 32.
    fn default() -> Self {
        Sampler {
            address: [Address::Clamp; 3],
            magnify: Filter::Nearest,
            minify: Filter::Nearest,
            levels: Filter::Nearest,
            level_range: [0.0, 32.0],
            level_rule: LevelRule::Exact,
        }
    }
}

impl Sampler {
    /// Linear in all ways, with one address mode.
    pub fn linear(address: Address) -> Self {
        Sampler {
            address: [address; 3],
            magnify: Filter::Linear,
            minify: Filter::Linear,
            levels: Filter::Linear,
            ..Sampler::default()
        }
    }
}

/// Where a sample is taken: coordinates of the texture or a face, in 0..1, and a layer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot<F> {
    pub(crate) at: [F; 3],
    pub(crate) layer: i64,
}

/// The face that a direction hits, and numbers there: (s, t) from -1 to 1 and the length of the major axis.
fn face_of<F: Float>(d: [F; 3]) -> (usize, [F; 2], F) {
    let a = [d[0].abs(), d[1].abs(), d[2].abs()];
    let axis = if a[0] >= a[1] && a[0] >= a[2] {
        0
    } else if a[1] >= a[2] {
        1
    } else {
        2
    };
    let face = 2 * axis + usize::from(d[axis] < F::ZERO);
    (face, on_face(face, d), a[axis])
}

/// The components of a vector along a face's s and t.
fn on_face<F: Float>(face: usize, d: [F; 3]) -> [F; 2] {
    let [x, y, z] = d;
    match face {
        0 => [-z, -y],
        1 => [z, -y],
        2 => [x, z],
        3 => [x, -z],
        4 => [x, -y],
        _ => [-x, -y],
    }
}

/// The direction of a point of a face.
fn direction(face: usize, s: f64, t: f64) -> [f64; 3] {
    match face {
        0 => [1.0, -t, -s],
        1 => [-1.0, -t, s],
        2 => [s, 1.0, t],
        3 => [s, -1.0, -t],
        4 => [s, -t, 1.0],
        _ => [-s, -t, -1.0],
    }
}

impl Texture {
    /// The spot that coordinates name.
    pub(crate) fn spot<F: Float>(&self, at: [F; 3], layer: i64) -> Spot<F> {
        let layer = layer.clamp(0, i64::from(self.array_layers()) - 1);
        if self.shape != Shape::Cube {
            return Spot { at, layer };
        }
        let (face, [s, t], major) = face_of(at);
        let half = |x: F| (x / major + F::ONE) * F::HALF;
        Spot { at: [half(s), half(t), F::ZERO], layer: 6 * layer + face as i64 }
    }

    /// log2 of the larger of the lengths, in texels, that two derivatives of the coordinates have, by a rule.
    pub(crate) fn level_of<F: Float>(&self, at: [F; 3], ddx: [F; 3], ddy: [F; 3], rule: LevelRule) -> F {
        let size = self.size(0).map(|n| F::number(f64::from(n)));
        let texels = |d: [F; 3]| -> F {
            let d = if self.shape == Shape::Cube {
                let (face, p, major) = face_of(at);
                let (dp, along) = (on_face(face, d), d[face / 2]);
                let along = if face % 2 == 1 { -along } else { along };
                // d(s / m) = (ds - s dm / m) / m, and half of that for coordinates of 0..1.
                let part = |i: usize| (dp[i] - p[i] * along / major) / major * F::HALF;
                [part(0), part(1), F::ZERO]
            } else {
                d
            };
            let n = match self.shape {
                Shape::D1 => 1,
                Shape::D2 | Shape::Cube => 2,
                Shape::D3 => 3,
            };
            (0..n).fold(F::ZERO, |sum, i| sum + d[i] * size[i] * d[i] * size[i])
        };
        rule.level(texels(ddx).most(texels(ddy)))
    }

    /// A filtered sample at a level, limited by the sampler and the texture.
    pub(crate) fn sample<F: Float>(&self, spot: Spot<F>, level: F, sampler: &Sampler, offset: [i32; 3]) -> [F; 4] {
        let [low, high] = sampler.level_range.map(|x| F::number(f64::from(x)));
        let level = if level.is_nan() { low } else { level.most(low).least(high) };
        let filter = if level <= F::ZERO { sampler.magnify } else { sampler.minify };
        let last = F::number(f64::from(self.level_count() - 1));
        let level = level.most(F::ZERO).least(last);
        match sampler.levels {
            Filter::Nearest => {
                let nearest = (level + F::HALF).floor().least(last);
                self.sample_level(spot, nearest.to_f64() as usize, filter, sampler, offset)
            }
            Filter::Linear => {
                let finer = level.floor();
                let t = level - finer;
                let index = finer.to_f64() as usize;
                let a = self.sample_level(spot, index, filter, sampler, offset);
                if t == F::ZERO {
                    return a;
                }
                let b = self.sample_level(spot, index + 1, filter, sampler, offset);
                mix(a, b, t)
            }
        }
    }

    fn sample_level<F: Float>(
        &self,
        spot: Spot<F>,
        level: usize,
        filter: Filter,
        sampler: &Sampler,
        offset: [i32; 3],
    ) -> [F; 4] {
        let size = self.size(level as u32);
        let dimensions = match self.shape {
            Shape::D1 => 1,
            Shape::D2 | Shape::Cube => 2,
            Shape::D3 => 3,
        };
        let mut first = [0_i64; 3];
        let mut part = [F::ZERO; 3];
        for i in 0..dimensions {
            let x = spot.at[i] * F::number(f64::from(size[i])) + F::number(f64::from(offset[i]));
            let x = if filter == Filter::Linear { x - F::HALF } else { x };
            // Beyond this there are no texels to tell apart; it also keeps the sums below from wrapping.
            let floor = x.floor();
            first[i] = (floor.to_f64() as i64).clamp(-(1 << 40), 1 << 40);
            part[i] = if x.is_infinite() || x.is_nan() { F::ZERO } else { x - floor };
        }
        if filter == Filter::Nearest {
            return self.tap(first, spot.layer, level, sampler);
        }
        if dimensions == 2
            && let Some([[left, right], [top, bottom]]) = self.pairs(first, size, sampler)
        {
            let row = |y: usize| (spot.layer as usize * size[1] as usize + y) * size[0] as usize;
            let (upper, lower) = (row(top), row(bottom));
            let texel = |number: usize| self.texel(level, number).map(|x| F::number(f64::from(x)));
            let above = mix(texel(upper + left), texel(upper + right), part[0]);
            return mix(above, mix(texel(lower + left), texel(lower + right), part[0]), part[1]);
        }
        let step =
            |x: i64, y: i64, z: i64| self.tap([first[0] + x, first[1] + y, first[2] + z], spot.layer, level, sampler);
        let row = |y, z| mix(step(0, y, z), step(1, y, z), part[0]);
        let plane = |z| if dimensions > 1 { mix(row(0, z), row(1, z), part[1]) } else { row(0, z) };
        if dimensions > 2 { mix(plane(0), plane(1), part[2]) } else { plane(0) }
    }

    /// The columns and rows of the four texels from one on, unless one of them lies on another face.
    fn pairs(&self, first: [i64; 3], size: [u32; 3], sampler: &Sampler) -> Option<[[usize; 2]; 2]> {
        let mut pairs = [[0; 2]; 2];
        for (axis, pair) in pairs.iter_mut().enumerate() {
            let (low, count) = (first[axis], i64::from(size[axis]));
            *pair = if low >= 0 && low + 1 < count {
                [low as usize, low as usize + 1]
            } else if self.shape == Shape::Cube {
                return None;
            } else {
                [low, low + 1].map(|x| sampler.address[axis].wrapped(x, count) as usize)
            };
        }
        Some(pairs)
    }

    /// The four texels that a linear filter reads at level 0, in WGSL's order.
    pub(crate) fn gather<F: Float>(
        &self,
        spot: Spot<F>,
        component: usize,
        sampler: &Sampler,
        offset: [i32; 3],
    ) -> [F; 4] {
        let size = self.size(0);
        let corner = |i: usize| {
            let x = spot.at[i] * F::number(f64::from(size[i])) + F::number(f64::from(offset[i])) - F::HALF;
            (x.floor().to_f64() as i64).clamp(-(1 << 40), 1 << 40)
        };
        let (x, y) = (corner(0), corner(1));
        [[0, 1], [1, 1], [1, 0], [0, 0]]
            .map(|[dx, dy]| self.tap::<F>([x + dx, y + dy, 0], spot.layer, 0, sampler)[component])
    }

    /// A texel anywhere: outside of the texture by the sampler's address modes, outside of a face on its neighbour.
    fn tap<F: Float>(&self, at: [i64; 3], layer: i64, level: usize, sampler: &Sampler) -> [F; 4] {
        let size = self.size(level as u32).map(i64::from);
        let texel = if self.shape == Shape::Cube {
            self.cube_texel(at[0], at[1], layer, level as u32)
        } else {
            let wrapped = [0, 1, 2].map(|i| sampler.address[i].wrapped(at[i], size[i]));
            self.fetch(wrapped, layer, level as u32)
        };
        texel.map(|x| F::number(f64::from(x)))
    }

    fn cube_texel(&self, x: i64, y: i64, layer: i64, level: u32) -> [f32; 4] {
        let n = i64::from(self.size(level)[0]);
        let outside = |i: i64| !(0..n).contains(&i);
        match (outside(x), outside(y)) {
            (false, false) => self.fetch([x, y, 0], layer, level),
            // At a corner three texels meet: the one that does not exist is their mean.
            (true, true) => {
                let (cx, cy) = (x.clamp(0, n - 1), y.clamp(0, n - 1));
                let (side, above) = (x.clamp(-1, n), y.clamp(-1, n));
                let three = [(cx, cy), (side, cy), (cx, above)].map(|(x, y)| self.cube_texel(x, y, layer, level));
                [0, 1, 2, 3].map(|i| (three[0][i] + three[1][i] + three[2][i]) / 3.0)
            }
            _ => {
                // The direction of the texel's centre, were the face larger: on the neighbour that is the texel beside.
                let place = |i: i64| (2.0 * i.clamp(-1, n) as f64 + 1.0) / n as f64 - 1.0;
                let (face, [s, t], major) = face_of(direction((layer % 6) as usize, place(x), place(y)));
                let index = |p: f64| (((p / major + 1.0) * 0.5 * n as f64) as i64).clamp(0, n - 1);
                self.fetch([index(s), index(t), 0], layer - layer % 6 + face as i64, level)
            }
        }
    }
}

fn mix<F: Float>(a: [F; 4], b: [F; 4], t: F) -> [F; 4] {
    [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * t)
}
