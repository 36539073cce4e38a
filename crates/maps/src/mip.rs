//! Mip chains: every level of an image down to one texel, averaged in linear light.
//!
//! Any size works. A level has half the width and height, rounded down, and each of its texels is the mean over the area
//! that it covers of the level above: two texels a side where the size is even, parts of three where it is odd. So every
//! level has the mean of the first. Averages go from level to level in f32 and are rounded only when they are stored.
//! Does not filter wider than a box, and does not wrap.

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::image::{Image, Texels};
use crate::real::normalize_or;

/// How the red, green and blue of an image are encoded. Alpha is linear always.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// IEC 61966-2-1, as colours are stored.
    Srgb,
    /// Values as they are, as everything else is stored.
    Linear,
}

/// What the texels are, which decides what their average is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapKind {
    /// A colour with coverage in alpha: the mean is weighted by alpha, so that what cannot be seen does not bleed. Where
    /// nothing can be seen it is the plain mean.
    Color,
    /// A tangent-space normal, 2 c - 1: vectors are averaged and their mean is made unit. Alpha is averaged beside it.
    Normal,
    /// Independent channels (roughness, metalness, occlusion, height, packed maps): each has its own mean.
    Data,
}

/// The image and all its smaller levels: the first is a copy of `image`, the last has one texel. The levels keep its
/// format (8-bit, 16-bit, float) and channels. NaN counts as 0.
pub fn mip_chain(image: &Image, color_space: ColorSpace, kind: MapKind) -> Vec<Image> {
    let mut levels = vec![image.clone()];
    let coding = Coding { color_space, kind, srgb8: &SRGB8 };
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width == 1 && height == 1 {
        return levels;
    }
    let weighted = kind == MapKind::Color && image.channels().has_alpha();
    let mut level = match image.texels() {
        Texels::U8(texels) => halved(width, height, weighted, |i| coding.read_u8(texels[i])),
        Texels::U16(texels) => halved(width, height, weighted, |i| coding.read_u16(texels[i])),
        Texels::F32(texels) => halved(width, height, weighted, |i| coding.read_f32(texels[i])),
    };
    loop {
        levels.push(coding.stored(&level, image));
        if level.width == 1 && level.height == 1 {
            return levels;
        }
        level = halved(level.width, level.height, weighted, |i| level.texels[i]);
    }
}

/// A level in linear light, or for normals in vectors that are not made unit.
struct Level {
    width: usize,
    height: usize,
    texels: Vec<[f32; 4]>,
}

/// The level below one of `width` x `height` texels.
fn halved(width: usize, height: usize, weighted: bool, texel: impl Fn(usize) -> [f32; 4] + Sync) -> Level {
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let is_even = width.is_multiple_of(2) && height.is_multiple_of(2);
    let mut texels = vec![[0.0; 4]; half_width * half_height];
    let rows = texels.par_chunks_mut(half_width).with_min_len(4096_usize.div_ceil(half_width)).enumerate();
    rows.for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let mut mean = Mean::default();
            if is_even {
                let first = 2 * y * width + 2 * x;
                for i in [first, first + 1, first + width, first + width + 1] {
                    mean.add(0.25, texel(i));
                }
            } else {
                for (j, row_weight) in footprint(height, y).weights() {
                    for (i, weight) in footprint(width, x).weights() {
                        mean.add(weight * row_weight, texel(j * width + i));
                    }
                }
            }
            *out = if weighted { mean.by_alpha() } else { mean.sum };
        }
    });
    Level { width: half_width, height: half_height, texels }
}

/// A sum of texels whose weights sum to 1.
#[derive(Default)]
struct Mean {
    sum: [f32; 4],
    /// The colours times their alphas.
    visible: [f32; 3],
}

impl Mean {
    fn add(&mut self, weight: f32, texel: [f32; 4]) {
        for (sum, c) in self.sum.iter_mut().zip(texel) {
            *sum += weight * c;
        }
        for (sum, c) in self.visible.iter_mut().zip(texel) {
            *sum += weight * texel[3] * c;
        }
    }

    /// The colour weighted by alpha, or the plain one where there is no alpha; and the mean alpha.
    fn by_alpha(self) -> [f32; 4] {
        let [.., alpha] = self.sum;
        if alpha > 0.0 {
            let [r, g, b] = self.visible.map(|c| c / alpha);
            [r, g, b, alpha]
        } else {
            self.sum
        }
    }
}

/// What texel `i` of a level covers along one axis of the level above.
#[derive(Clone, Copy)]
struct Footprint {
    first: usize,
    count: usize,
    weights: [f32; 3],
}

impl Footprint {
    fn weights(&self) -> impl Iterator<Item = (usize, f32)> {
        (0..self.count).map(|tap| (self.first + tap, self.weights[tap]))
    }
}

/// With n texels above and m = max(1, floor(n / 2)) here, texel i covers [i n / m, (i + 1) n / m). For n = 2 m that is two
/// whole texels; for n = 2 m + 1 it is the parts 1 - i / m, 1 and (i + 1) / m of three; all over n / m.
fn footprint(n: usize, i: usize) -> Footprint {
    let m = n / 2;
    if n == 1 {
        Footprint { first: 0, count: 1, weights: [1.0, 0.0, 0.0] }
    } else if n.is_multiple_of(2) {
        Footprint { first: 2 * i, count: 2, weights: [0.5, 0.5, 0.0] }
    } else {
        let part = |p: usize| p as f32 / n as f32;
        Footprint { first: 2 * i, count: 3, weights: [part(m - i), part(m), part(i + 1)] }
    }
}

/// Between stored texels and what is averaged.
#[derive(Clone, Copy)]
struct Coding {
    color_space: ColorSpace,
    kind: MapKind,
    srgb8: &'static Srgb8,
}

impl Coding {
    fn read_u8(self, texel: [u8; 4]) -> [f32; 4] {
        if self.is_srgb() {
            let [r, g, b, a] = texel;
            let linear = |c: u8| self.srgb8.linear[usize::from(c)];
            [linear(r), linear(g), linear(b), f32::from(a) / 255.0]
        } else {
            self.vector(texel.map(|c| f32::from(c) / 255.0))
        }
    }

    fn read_u16(self, texel: [u16; 4]) -> [f32; 4] {
        self.read_unit(texel.map(|c| f32::from(c) / 65535.0))
    }

    fn read_f32(self, texel: [f32; 4]) -> [f32; 4] {
        let mut texel = texel.map(|c| if c.is_nan() { 0.0 } else { c });
        if self.kind == MapKind::Color {
            texel[3] = texel[3].clamp(0.0, 1.0);
        }
        self.read_unit(texel)
    }

    fn read_unit(self, [r, g, b, a]: [f32; 4]) -> [f32; 4] {
        if self.is_srgb() {
            let [r, g, b] = linear_from_srgb([r, g, b]);
            [r, g, b, a]
        } else {
            self.vector([r, g, b, a])
        }
    }

    fn vector(self, [r, g, b, a]: [f32; 4]) -> [f32; 4] {
        if self.kind == MapKind::Normal {
            let [x, y, z] = crate::normal::normal_from_texel([r, g, b], 1.0, false);
            [x, y, z, a]
        } else {
            [r, g, b, a]
        }
    }

    /// Normals have no colour space: 2 c - 1 is of the codes themselves.
    fn is_srgb(self) -> bool {
        self.color_space == ColorSpace::Srgb && self.kind != MapKind::Normal
    }

    /// Back to the range 0..1 of codes, for normals (n + 1) / 2; linear still.
    fn codes(self, [r, g, b, a]: [f32; 4]) -> [f32; 4] {
        if self.kind == MapKind::Normal {
            let [x, y, z] = normalize_or([r, g, b], [0.0, 0.0, 1.0]).map(|x| 0.5 * x + 0.5);
            [x, y, z, a]
        } else {
            [r, g, b, a]
        }
    }

    fn stored(self, level: &Level, image: &Image) -> Image {
        let texels = match image.texels() {
            Texels::U8(_) => Texels::U8(each(level, |texel| {
                let [r, g, b, a] = self.codes(texel);
                if self.is_srgb() {
                    [self.srgb8.code(r), self.srgb8.code(g), self.srgb8.code(b), code_u8(a)]
                } else {
                    [r, g, b, a].map(code_u8)
                }
            })),
            Texels::U16(_) => Texels::U16(each(level, |texel| self.encoded(texel).map(code_u16))),
            Texels::F32(_) => Texels::F32(each(level, |texel| self.encoded(texel))),
        };
        image.with_level(level.width as u32, level.height as u32, texels)
    }

    fn encoded(self, texel: [f32; 4]) -> [f32; 4] {
        let [r, g, b, a] = self.codes(texel);
        if self.is_srgb() {
            let [r, g, b] = srgb_from_linear([r, g, b]);
            [r, g, b, a]
        } else {
            [r, g, b, a]
        }
    }
}

fn each<T: Send>(level: &Level, store: impl Fn([f32; 4]) -> T + Sync) -> Vec<T> {
    level.texels.par_iter().with_min_len(1 << 12).map(|&texel| store(texel)).collect()
}

fn code_u8(x: f32) -> u8 {
    (x * 255.0 + 0.5) as u8
}

fn code_u16(x: f32) -> u16 {
    (x * 65535.0 + 0.5) as u16
}

/// 8-bit sRGB by table, exact in both directions.
struct Srgb8 {
    /// Linear value of each code.
    linear: [f32; 256],
    /// Linear value from which on each code is the nearest.
    threshold: [f32; 256],
    /// Code at the lower end of each 4096th of the linear range: where the search starts.
    start: [u8; Self::STEPS + 1],
}

static SRGB8: LazyLock<Srgb8> = LazyLock::new(|| {
    let linear_of = |s: f64| linear_from_srgb([s; 3])[0] as f32;
    let linear = std::array::from_fn(|code| linear_of(code as f64 / 255.0));
    let threshold =
        std::array::from_fn(|code| if code == 0 { f32::NEG_INFINITY } else { linear_of((code as f64 - 0.5) / 255.0) });
    let start = std::array::from_fn(|step| {
        let low = step as f32 / Srgb8::STEPS as f32;
        threshold.iter().filter(|&&t| t <= low).count().saturating_sub(1) as u8
    });
    Srgb8 { linear, threshold, start }
});

impl Srgb8 {
    const STEPS: usize = 4096;

    /// The code nearest, in sRGB, to a linear value; clamped to 0..1, NaN is 0.
    fn code(&self, linear: f32) -> u8 {
        let mut code = self.start[((linear * Self::STEPS as f32) as usize).min(Self::STEPS)];
        while code < 255 && linear >= self.threshold[usize::from(code) + 1] {
            code += 1;
        }
        code
    }
}
