//! Textures in memory: their shape, their levels, and the texels.

mod sampling;

use std::sync::LazyLock;

use crate::ir::Dimension;

pub use sampling::{Address, Filter, LevelRule, Sampler};

/// How many dimensions a texture has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One, or an array of such.
    D1,
    /// Two, or an array of such.
    D2,
    /// Three.
    D3,
    /// A cube: six layers +X -X +Y -Y +Z -Z for each cube of an array.
    Cube,
}

/// One level of a texture; of f32 texels, or of 8-bit codes for [`Texture::from_codes`].
#[derive(Clone, Debug, PartialEq)]
pub struct Level<T = [f32; 4]> {
    /// Texels along x.
    pub width: u32,
    /// Texels along y.
    pub height: u32,
    /// Texels along z, 1 but for `Shape::D3`.
    pub depth: u32,
    /// RGBA; x first, then y, z, layers.
    pub texels: Vec<T>,
}

/// A texture of RGBA texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    shape: Shape,
    layers: u32,
    levels: Levels,
}

/// The levels in one of the codings. Codes take a quarter of the memory, which is what sampling waits for.
#[derive(Clone, Debug, PartialEq)]
enum Levels {
    Floats(Vec<Level>),
    /// c / 255.
    Codes(Vec<Level<[u8; 4]>>),
    /// The same, red, green and blue decoded from sRGB.
    SrgbCodes(Vec<Level<[u8; 4]>>),
}

/// The linear value of each sRGB code; IEC 61966-2-1.
static LINEAR_FROM_SRGB: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let c = code as f64 / 255.0;
        (if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }) as f32
    })
});

/// Why levels are no texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextureError {
    /// There is no level, or one without texels.
    #[error("a texture needs at least one level, and each at least one texel")]
    Empty,
    /// A level has another number of texels than its size and the layers say.
    #[error("level {0} of the texture has another number of texels than its size says")]
    Texels(usize),
    /// A cube's face is not square, or its layers are no multiple of six.
    #[error("a cube needs square faces, six of them for each cube")]
    Cube,
}

/// Whether levels are a texture.
fn check<T>(shape: Shape, layers: u32, levels: &[Level<T>]) -> Result<(), TextureError> {
    if levels.is_empty() || layers == 0 {
        return Err(TextureError::Empty);
    }
    for (i, level) in levels.iter().enumerate() {
        let texels = [level.height, level.depth, layers]
            .iter()
            .try_fold(level.width as usize, |n, factor| n.checked_mul(*factor as usize));
        if texels == Some(0) {
            return Err(TextureError::Empty);
        }
        if texels != Some(level.texels.len()) {
            return Err(TextureError::Texels(i));
        }
        if shape == Shape::Cube && (level.width != level.height || !layers.is_multiple_of(6)) {
            return Err(TextureError::Cube);
        }
    }
    Ok(())
}

impl Texture {
    /// A texture of `layers` layers (faces count; 1 for a plain one) from its levels, the finest first.
    ///
    /// # Errors
    /// Where the numbers of texels do not fit.
    pub fn new(shape: Shape, layers: u32, levels: Vec<Level>) -> Result<Texture, TextureError> {
        check(shape, layers, &levels)?;
        Ok(Texture { shape, layers, levels: Levels::Floats(levels) })
    }

    /// A texture whose texels are 8-bit codes: c / 255, and with `srgb` red, green and blue decoded from sRGB.
    ///
    /// # Errors
    /// Where the numbers of texels do not fit.
    pub fn from_codes(
        shape: Shape,
        layers: u32,
        levels: Vec<Level<[u8; 4]>>,
        srgb: bool,
    ) -> Result<Texture, TextureError> {
        check(shape, layers, &levels)?;
        Ok(Texture { shape, layers, levels: if srgb { Levels::SrgbCodes(levels) } else { Levels::Codes(levels) } })
    }

    pub(crate) fn fits(&self, dimension: Dimension) -> bool {
        matches!(
            (self.shape, dimension),
            (Shape::D1, Dimension::One)
                | (Shape::D2, Dimension::Two)
                | (Shape::D3, Dimension::Three)
                | (Shape::Cube, Dimension::Cube)
        )
    }

    pub(crate) fn level_count(&self) -> u32 {
        match &self.levels {
            Levels::Floats(levels) => levels.len() as u32,
            Levels::Codes(levels) | Levels::SrgbCodes(levels) => levels.len() as u32,
        }
    }

    /// Layers of an array; cubes of an array of cubes.
    pub(crate) fn array_layers(&self) -> u32 {
        if self.shape == Shape::Cube { self.layers / 6 } else { self.layers }
    }

    pub(crate) fn size(&self, level: u32) -> [u32; 3] {
        let level = level.min(self.level_count() - 1) as usize;
        match &self.levels {
            Levels::Floats(levels) => levels[level].size(),
            Levels::Codes(levels) | Levels::SrgbCodes(levels) => levels[level].size(),
        }
    }

    /// One texel; 0 outside of the texture, as devices with robust access return.
    pub(crate) fn fetch(&self, at: [i64; 3], layer: i64, level: u32) -> [f32; 4] {
        if level >= self.level_count() {
            return [0.0; 4];
        }
        let size = self.size(level).map(i64::from);
        let inside = at.iter().zip(size).all(|(at, size)| (0..size).contains(at));
        if !inside || !(0..i64::from(self.layers)).contains(&layer) {
            return [0.0; 4];
        }
        let texel = ((layer * size[2] + at[2]) * size[1] + at[1]) as usize * size[0] as usize + at[0] as usize;
        self.texel(level as usize, texel)
    }

    /// A texel of a level by its number.
    fn texel(&self, level: usize, number: usize) -> [f32; 4] {
        match &self.levels {
            Levels::Floats(levels) => levels[level].texels[number],
            Levels::Codes(levels) => levels[level].texels[number].map(unit),
            Levels::SrgbCodes(levels) => {
                let [r, g, b, a] = levels[level].texels[number];
                let linear = |code: u8| LINEAR_FROM_SRGB[usize::from(code)];
                [linear(r), linear(g), linear(b), unit(a)]
            }
        }
    }
}

impl<T> Level<T> {
    fn size(&self) -> [u32; 3] {
        [self.width, self.height, self.depth]
    }
}

fn unit(code: u8) -> f32 {
    f32::from(code) / 255.0
}
