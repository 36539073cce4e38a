//! Mip chains: every level of an image down to one texel, averaged in linear light.
//!
//! Any size works. A level has half the width and height, rounded down, and each of its texels is the mean over the area
//! that it covers of the level above: two texels a side where the size is even, parts of three where it is odd. So every
//! level has the mean of the first. Averages go from level to level in f32 and are rounded only when they are stored.
//! Does not filter wider than a box, and does not wrap.

use crate::coding::{code_u8, code_u16, srgb8};
use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::image::{Image, Texels};
use crate::levels::{Block, ByAlpha, Plain, filled, levels};
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
/// format (8-bit, 16-bit, float) and channels. NaN counts as 0. [`smaller_levels`] saves the copy.
pub fn mip_chain(image: &Image, color_space: ColorSpace, kind: MapKind) -> Vec<Image> {
    let mut levels = smaller_levels(image, color_space, kind);
    levels.insert(0, image.clone());
    levels
}

/// The levels of [`mip_chain`] below the first; none for one texel.
pub fn smaller_levels(image: &Image, color_space: ColorSpace, kind: MapKind) -> Vec<Image> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width == 1 && height == 1 {
        return Vec::new();
    }
    let weighted = kind == MapKind::Color && image.channels().has_alpha();
    let size = (width, height, weighted);
    // One loop for each coding, so that no texel asks which it is. Normals have no colour space: 2 c - 1 is of the codes.
    let levels = match (image.texels(), kind, color_space) {
        (Texels::U8(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(unit_u8(t)), |v| normal_codes(v).map(code_u8), Texels::U8)
        }
        (Texels::U8(texels), _, ColorSpace::Srgb) => {
            let table = srgb8();
            let read = |[r, g, b, a]: [u8; 4]| {
                let [r, g, b] = [r, g, b].map(|c| table.linear[usize::from(c)]);
                [r, g, b, f32::from(a) * (1.0 / 255.0)]
            };
            let store = |[r, g, b, a]: [f32; 4]| [table.code(r), table.code(g), table.code(b), code_u8(a)];
            all_levels(size, texels, read, store, Texels::U8)
        }
        (Texels::U8(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, unit_u8, |v| v.map(code_u8), Texels::U8)
        }
        (Texels::U16(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(unit_u16(t)), |v| normal_codes(v).map(code_u16), Texels::U16)
        }
        (Texels::U16(texels), _, ColorSpace::Srgb) => {
            all_levels(size, texels, |t| linear(unit_u16(t)), |v| encoded(v).map(code_u16), Texels::U16)
        }
        (Texels::U16(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, unit_u16, |v| v.map(code_u16), Texels::U16)
        }
        (Texels::F32(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(without_nan(t, kind)), normal_codes, Texels::F32)
        }
        (Texels::F32(texels), _, ColorSpace::Srgb) => {
            all_levels(size, texels, |t| linear(without_nan(t, kind)), encoded, Texels::F32)
        }
        (Texels::F32(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, |t| without_nan(t, kind), |v| v, Texels::F32)
        }
    };
    levels
        .into_iter()
        .map(|(width, height, texels)| Image::from_parts(width as u32, height as u32, image.channels(), texels))
        .collect()
}

#[inline(always)]
pub(crate) fn unit_u8(texel: [u8; 4]) -> [f32; 4] {
    bytes(texel).map(|c| c as f32 * (1.0 / 255.0))
}

/// The bytes by shifts of a word, which become vectors where loads of every fourth byte do not.
#[inline(always)]
fn bytes(texel: [u8; 4]) -> [u32; 4] {
    let word = u32::from_le_bytes(texel);
    [word & 255, word >> 8 & 255, word >> 16 & 255, word >> 24]
}

#[inline(always)]
pub(crate) fn unit_u16(texel: [u16; 4]) -> [f32; 4] {
    texel.map(|c| f32::from(c) * (1.0 / 65_535.0))
}

/// NaN is 0; the alpha of a colour is a weight and must be one.
#[inline(always)]
fn without_nan(texel: [f32; 4], kind: MapKind) -> [f32; 4] {
    let [r, g, b, a] = texel.map(|c| if c.is_nan() { 0.0 } else { c });
    [r, g, b, if kind == MapKind::Color { a.clamp(0.0, 1.0) } else { a }]
}

fn linear([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = linear_from_srgb([r, g, b]);
    [r, g, b, a]
}

fn encoded([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = srgb_from_linear([r, g, b]);
    [r, g, b, a]
}

#[inline(always)]
fn vector([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [x, y, z] = crate::normal::normal_from_texel([r, g, b], 1.0, false);
    [x, y, z, a]
}

/// (n + 1) / 2 of the vector made unit.
#[inline(always)]
fn normal_codes([x, y, z, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = normalize_or([x, y, z], [0.0, 0.0, 1.0]).map(|x| 0.5 * x + 0.5);
    [r, g, b, a]
}

/// All levels below `first`: `read` brings a texel to what is averaged, `store` back.
fn all_levels<T: Copy + Default + Send + Sync>(
    (width, height, weighted): (usize, usize, bool),
    first: &[[T; 4]],
    read: impl Fn([T; 4]) -> [f32; 4] + Sync,
    store: impl Fn([f32; 4]) -> [T; 4] + Sync,
    texels: impl Fn(Vec<[T; 4]>) -> Texels,
) -> Vec<(usize, usize, Texels)> {
    let fill = |x: usize, y: usize, block: &mut Block<4>| {
        filled(&first[y * width..][x..width], block, |_, t| read(t));
    };
    let levels = if weighted {
        levels(&ByAlpha, [width, height], fill, store)
    } else {
        levels(&Plain, [width, height], fill, store)
    };
    levels.into_iter().map(|level| (level.width, level.height, texels(level.texels))).collect()
}
