//! HDRE 2.0: six levels of a cube as floats, with nine irradiance coefficients. `load/hdre.rs` has the header's layout.

use super::SaveError;
use crate::cube::Cube;
use crate::load::mirrored_sh;

/// How many levels every HDRE file has.
pub const HDRE_LEVELS: usize = 6;

/// Bytes of the header that writers of 2.0 reserve.
const HEADER_BYTES: usize = 256;

/// The limit that writers of the format state, in bytes; readers in the field refuse longer files.
const MAX_FILE_SIZE: f32 = 60e6;

/// Texels along an edge of a level when level 0 has `size`: halved, but never below 8.
pub fn hdre_face(size: usize, level: usize) -> usize {
    (size >> level).max(8)
}

/// The bytes of an HDRE 2.0 file. What was read from one gives the same bytes again.
///
/// The format does not say what the levels are filtered with; its readers look level i up at a roughness of i / 5.
///
/// # Errors
/// When there are not six levels, when one has not the size of [`hdre_face`], or when a face is wider than 32767 texels.
pub fn hdre(levels: &[Cube], irradiance_sh: Option<&[[f32; 3]; 9]>) -> Result<Vec<u8>, SaveError> {
    let size = super::face_size(levels)?;
    if levels.len() != HDRE_LEVELS {
        return Err(SaveError::Levels { found: levels.len(), needed: HDRE_LEVELS.to_string() });
    }
    for (level, found) in levels.iter().map(|level| level.size).enumerate() {
        let needed = hdre_face(size, level).min(i16::MAX as usize);
        if found != needed {
            return Err(SaveError::Size { level, found, needed });
        }
    }
    // Alpha is 1 and counts.
    let max_luminance = levels.iter().flat_map(|level| level.texels.iter().flatten()).copied().fold(1.0, f32::max);
    let mut bytes = b"HDRE".to_vec();
    bytes.extend(2f32.to_le_bytes());
    bytes.extend([size as u16; 2].iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(MAX_FILE_SIZE.to_le_bytes());
    // Channels, bits of each, bytes of the header, little endian.
    bytes.extend([4, 32, HEADER_BYTES as u16, 1].iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(max_luminance.to_le_bytes());
    // Type 3: floats.
    bytes.extend([3, u16::from(irradiance_sh.is_some())].iter().flat_map(|x| x.to_le_bytes()));
    if let Some(coefficients) = irradiance_sh {
        bytes.extend(9f32.to_le_bytes());
        bytes.extend(mirrored_sh(coefficients).iter().flatten().flat_map(|x| x.to_le_bytes()));
    }
    bytes.resize(HEADER_BYTES, 0);
    for level in levels {
        // Versions below 3.0 store the cube upside down: faces +Y and -Y exchanged, rows from the bottom.
        for face in [0, 1, 3, 2, 4, 5] {
            for row in (0..level.size).rev() {
                let start = (face * level.size + row) * level.size;
                for [r, g, b] in &level.texels[start..start + level.size] {
                    bytes.extend([*r, *g, *b, 1.0].iter().flat_map(|x| x.to_le_bytes()));
                }
            }
        }
    }
    Ok(bytes)
}
