//! OpenEXR strips: the levels below each other, each a row of its six faces, 32-bit floats.
//!
//! The attributes `halfvector.content` and `halfvector.roughness` say what they are, so that `load` reads radiance back as
//! levels.

use super::{CubeContent, CubeLevels, SaveError, face_size, strip};
use crate::ktx2::{KEY_CONTENT, KEY_ROUGHNESS};
use exr::image::{Encoding, Image, Layer, SpecificChannels};
use exr::meta::attribute::AttributeValue;
use exr::meta::header::LayerAttributes;
use exr::prelude::{Compression, Text, Vec2, WritableImage};

/// The bytes of an OpenEXR file with the picture of [`strip`].
///
/// # Errors
/// When there is no level or the encoder refuses.
pub fn exr(cube: CubeLevels<'_>) -> Result<Vec<u8>, SaveError> {
    face_size(cube.levels)?;
    let (width, height, texels) = strip(cube.levels);
    let text = |text: &str| Text::new_or_none(text).map(AttributeValue::Text);
    let roughness: Vec<String> = cube.roughness.iter().map(f32::to_string).collect();
    let mut attributes = LayerAttributes::default();
    let mut put = |key: &str, value: &str| {
        attributes.other.extend(Text::new_or_none(key).zip(text(value)));
    };
    put(KEY_CONTENT, cube.content.name());
    if cube.content == CubeContent::Radiance {
        put(KEY_ROUGHNESS, &roughness.join(","));
    }
    let channels = SpecificChannels::rgb(|Vec2(x, y): Vec2<usize>| {
        let [r, g, b] = texels[y * width + x];
        (r, g, b)
    });
    let encoding = Encoding { compression: Compression::ZIP16, ..Encoding::FAST_LOSSLESS };
    let layer = Layer::new((width, height), attributes, encoding, channels);
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|error| SaveError::Encoder(error.to_string()))?;
    Ok(bytes.into_inner())
}
