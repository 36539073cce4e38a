//! An image in memory: always four channels, 8-bit, 16-bit or float.
//! Does not say what the channels mean; colour spaces and uses are arguments of the functions that need them.

/// Which channels the source of an image had. All images are stored as RGBA: grey is spread to red, green and blue, a
/// missing alpha is opaque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channels {
    /// One channel.
    Grey,
    /// One channel and alpha.
    GreyAlpha,
    /// Three channels.
    Rgb,
    /// Three channels and alpha.
    Rgba,
}

impl Channels {
    /// Whether the source had an alpha channel.
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::Rgba)
    }

    /// Whether the source had red, green and blue.
    pub fn has_color(self) -> bool {
        matches!(self, Self::Rgb | Self::Rgba)
    }

    /// How many there are.
    pub fn count(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }
}

/// The texels, row by row from the top left, each red, green, blue, alpha.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Codes 0..=255 for 0..1.
    U8(Vec<[u8; 4]>),
    /// Codes 0..=65535 for 0..1.
    U16(Vec<[u16; 4]>),
    /// Values as they are, of any range.
    F32(Vec<[f32; 4]>),
}

impl Texels {
    /// The number of texels.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(texels) => texels.len(),
            Self::U16(texels) => texels.len(),
            Self::F32(texels) => texels.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// An image of at least one texel.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    channels: Channels,
    texels: Texels,
}

/// The number of texels is not width x height, or is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("an image of {width} x {height} needs that many texels and at least one; {texels} were given")]
pub struct SizeError {
    /// Width asked for.
    pub width: u32,
    /// Height asked for.
    pub height: u32,
    /// Number of texels given.
    pub texels: usize,
}

impl Image {
    /// An image of these texels.
    ///
    /// # Errors
    /// When there are not exactly `width * height` texels, or none.
    pub fn new(width: u32, height: u32, channels: Channels, texels: Texels) -> Result<Self, SizeError> {
        let count = u64::from(width) * u64::from(height);
        if count == 0 || u64::try_from(texels.len()) != Ok(count) {
            return Err(SizeError { width, height, texels: texels.len() });
        }
        Ok(Self { width, height, channels, texels })
    }

    /// An image whose texels are as many as its size says, which the caller knows.
    pub(crate) fn from_parts(width: u32, height: u32, channels: Channels, texels: Texels) -> Self {
        debug_assert_eq!(texels.len(), width as usize * height as usize);
        Self { width, height, channels, texels }
    }

    /// Width in texels, at least 1.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in texels, at least 1.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Which channels the source had.
    pub fn channels(&self) -> Channels {
        self.channels
    }

    /// The texels, row by row from the top left.
    pub fn texels(&self) -> &Texels {
        &self.texels
    }

    /// Takes the texels out.
    pub fn into_texels(self) -> Texels {
        self.texels
    }

    /// The texel at column `x`, row `y` (both clamped to the image), codes scaled to 0..1, with no colour space applied.
    pub fn texel(&self, x: u32, y: u32) -> [f32; 4] {
        let (x, y) = (x.min(self.width - 1) as usize, y.min(self.height - 1) as usize);
        let index = y * self.width as usize + x;
        match &self.texels {
            Texels::U8(texels) => texels[index].map(|c| f32::from(c) / 255.0),
            Texels::U16(texels) => texels[index].map(|c| f32::from(c) / 65535.0),
            Texels::F32(texels) => texels[index],
        }
    }
}
