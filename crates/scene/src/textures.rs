//! What renderers make textures of: levels of pictures in the coding that samples them best, and which table of albedos
//! the methods want. Nothing is uploaded here.

use std::borrow::Cow;

use halfvector_graph::method::Methods;
use halfvector_graph::value::ColorSpace;
use halfvector_ibl::Visibility;
use halfvector_maps::{Image, MapKind, Texels};

/// A picture with all its mip levels.
#[derive(Clone, Debug)]
pub struct TextureLevels<'a> {
    /// The finest level.
    pub base: Cow<'a, Image>,
    /// The others, the last of one texel.
    pub smaller: Vec<Image>,
    /// How the levels are coded: sRGB only where they have 8 bits.
    pub color_space: ColorSpace,
}

impl TextureLevels<'_> {
    /// All levels, the finest first.
    pub fn all(&self) -> impl Iterator<Item = &Image> {
        std::iter::once(self.base.as_ref()).chain(&self.smaller)
    }
}

/// The levels of a picture that is read as `color_space` says. Pictures of more than 8 bits are decoded from sRGB: no
/// texture decodes it from other than 8 bits.
pub fn texture_levels(image: &Image, color_space: ColorSpace) -> TextureLevels<'_> {
    let coded = matches!(image.texels(), Texels::U8(_));
    let (base, space) = if coded || color_space == ColorSpace::Linear {
        (Cow::Borrowed(image), color_space)
    } else {
        (Cow::Owned(decoded(image)), ColorSpace::Linear)
    };
    // Colours are weighted by their coverage; whether other data are normals is not known here, and the mean of vectors
    // that the shader makes unit serves them too.
    let kind = if color_space == ColorSpace::Srgb { MapKind::Color } else { MapKind::Data };
    let maps_space = match space {
        ColorSpace::Srgb => halfvector_maps::ColorSpace::Srgb,
        ColorSpace::Linear => halfvector_maps::ColorSpace::Linear,
    };
    let smaller = halfvector_maps::smaller_levels(&base, maps_space, kind);
    TextureLevels { base, smaller, color_space: space }
}

/// The visibility that the table of directional albedos is made for.
pub fn dfg_visibility(methods: &Methods) -> Visibility {
    if methods.is("v", "separable") { Visibility::Separable } else { Visibility::Correlated }
}

/// The sRGB-decoded picture in floats. Alpha is linear as it is.
fn decoded(image: &Image) -> Image {
    let linear = |[r, g, b, a]: [f32; 4]| {
        let [r, g, b] = halfvector_maps::color::linear_from_srgb([r, g, b]);
        [r, g, b, a]
    };
    let texels = match image.texels() {
        Texels::U8(texels) => texels.iter().map(|&texel| linear(texel.map(|c| f32::from(c) / 255.0))).collect(),
        Texels::U16(texels) => texels.iter().map(|&texel| linear(texel.map(|c| f32::from(c) / 65535.0))).collect(),
        Texels::F32(texels) => texels.iter().map(|&texel| linear(texel)).collect(),
    };
    let same = || image.clone();
    Image::new(image.width(), image.height(), image.channels(), Texels::F32(texels)).unwrap_or_else(|_| same())
}
