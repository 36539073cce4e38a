//! HDRE 2.0 to 3.0: six levels of a cube in one file, with nine irradiance coefficients.
//!
//! Fields of the header, little endian, at byte: 0 signature, 4 version f32, 8 width u16, 10 height u16, 12 maxFileSize f32,
//! 16 numChannels u16, 18 bitsPerChannel u16, 20 headerSize u16, 22 endianEncoding u16, 24 maxLuminance f32, 28 type u16
//! (1 u8, 2 half, 3 float, 4 RGBE bytes), 30 includesSH u16, 32 numCoeffs f32, 36 coefficients. Types 1, 2 and 4 have no
//! reference reader. maxFileSize and maxLuminance are a writer's constants: nothing is taken from them.

use super::{Fault, Limits, StoredLevels, StoredLobe, checked_texels, field};
use crate::cube::Cube;
use half::f16;

/// Every HDRE file has six levels.
const LEVELS: usize = 6;
/// Levels up to version 2.0 are not smaller than this.
const SMALLEST: usize = 8;
/// Up to the end of the coefficients.
const HEADER: usize = 144;
/// The headerSize that writers give.
const USUAL_HEADER: usize = 256;

pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<StoredLevels, Fault> {
    if bytes.starts_with(b"ERDH") {
        return Err(field("signature", "it is written with the other byte order, which no HDRE writer does"));
    }
    if bytes.len() < HEADER {
        return Err(Fault::Truncated("its header".to_owned()));
    }
    let float = |at: usize| f32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
    let short = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));

    let version = float(4);
    // Also refuses what is not a number.
    if !(2.0..=3.0).contains(&version) {
        return Err(field("version", format!("{version} is not between 2.0 and 3.0; convert it with a newer program")));
    }
    let (width, height) = (short(8), short(10));
    if width != height {
        return Err(field("height", format!("faces must be square and this says {width} x {height}")));
    }
    checked_texels(width as u64, 6 * height as u64, Limits { max_edge: u64::MAX, ..limits })?;
    if short(22) != 1 {
        return Err(field("endianEncoding", format!("{} is not 1, little endian", short(22))));
    }
    let channels = short(16);
    if !(channels == 4 || channels == 3 && version > 2.5) {
        return Err(field("numChannels", format!("{channels} channels in a file of version {version}")));
    }
    let coding = Coding::of(short(28), short(18), channels)?;
    let data_at = short(20);
    if data_at < HEADER {
        return Err(field("headerSize", format!("{data_at} bytes are fewer than a header has")));
    }
    if data_at > bytes.len() {
        return Err(field("headerSize", format!("{data_at} lies outside of the file of {} bytes", bytes.len())));
    }

    let sizes: Vec<usize> = (0..LEVELS)
        .map(|level| {
            let size = width >> level;
            if version > 2.0 { size.max(1) } else { size.max(SMALLEST) }
        })
        .collect();
    let texels: usize = sizes.iter().map(|size| 6 * size * size).sum();
    checked_texels(texels as u64, 1, Limits { max_edge: u64::MAX, ..limits })?;
    let data_bytes = texels * channels * coding.bytes();
    let needed = data_at + data_bytes;
    // More than is needed, or what the usual header leaves: then it is not the end that is missing.
    if bytes.len() > needed || bytes.len() == USUAL_HEADER + data_bytes && data_at != USUAL_HEADER {
        return Err(field(
            "headerSize",
            format!(
                "{data_at} and the levels' {data_bytes} bytes are not the file's {}; a size in the header is damaged",
                bytes.len()
            ),
        ));
    }
    if bytes.len() < needed {
        return Err(Fault::Truncated(format!("its levels: {needed} bytes are needed and {} are there", bytes.len())));
    }

    let mut data = &bytes[data_at..];
    let mut levels: Vec<Cube> = sizes
        .iter()
        .map(|&size| {
            let (level, rest) = data.split_at(6 * size * size * channels * coding.bytes());
            data = rest;
            let texels = level.chunks_exact(channels * coding.bytes()).map(|texel| coding.decoded(texel)).collect();
            Cube { size, texels }
        })
        .collect();
    let mut irradiance_sh = coefficients(short(30), float(32), |k| float(36 + 4 * k))?;

    if version < 3.0 {
        // Stored upside down: the swap of +Y and -Y and the flip of all rows together mirror y.
        levels.iter_mut().for_each(mirror_y);
        irradiance_sh = irradiance_sh.as_ref().map(mirrored_sh);
    } else {
        // Writers of 3.0 order the rows of level 0 and of the others differently, and readers disagree: see which way round
        // each level looks like the one before it.
        for level in 1..LEVELS {
            let reference = levels[level - 1].resized(levels[level].size);
            let flipped = flipped_rows(&levels[level]);
            if difference(&reference, &flipped) < difference(&reference, &levels[level]) {
                levels[level] = flipped;
            }
        }
    }
    Ok(StoredLevels { levels, lobe: StoredLobe::Hdre { version }, slope: Vec::new(), irradiance_sh })
}

/// How a component is stored.
enum Coding {
    U8,
    Half,
    Float,
    Rgbe,
}

impl Coding {
    fn of(kind: usize, bits: usize, channels: usize) -> Result<Coding, Fault> {
        let (coding, expected) = match kind {
            1 => (Coding::U8, 8),
            2 => (Coding::Half, 16),
            3 => (Coding::Float, 32),
            4 if channels == 4 => (Coding::Rgbe, 8),
            4 => return Err(field("numChannels", "RGBE data (type 4) needs four")),
            _ => return Err(field("type", format!("{kind} is not 1 (u8), 2 (half), 3 (float) or 4 (RGBE)"))),
        };
        if bits != expected {
            return Err(field("bitsPerChannel", format!("{bits} where type {kind} has {expected}")));
        }
        Ok(coding)
    }

    fn bytes(&self) -> usize {
        match self {
            Coding::U8 | Coding::Rgbe => 1,
            Coding::Half => 2,
            Coding::Float => 4,
        }
    }

    /// The colour of a texel of three or four components.
    fn decoded(&self, texel: &[u8]) -> [f32; 3] {
        match self {
            Coding::U8 => std::array::from_fn(|i| f32::from(texel[i]) / 255.0),
            Coding::Half => std::array::from_fn(|i| f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32()),
            Coding::Float => std::array::from_fn(|i| f32::from_le_bytes(std::array::from_fn(|k| texel[4 * i + k]))),
            Coding::Rgbe if texel[3] == 0 => [0.0; 3],
            Coding::Rgbe => std::array::from_fn(|i| f32::from(texel[i]) * (f32::from(texel[3]) - 136.0).exp2()),
        }
    }
}

fn coefficients(includes: usize, count: f32, at: impl Fn(usize) -> f32) -> Result<Option<[[f32; 3]; 9]>, Fault> {
    match includes {
        0 => Ok(None),
        1 if count == 9.0 => {
            let all: [[f32; 3]; 9] = std::array::from_fn(|k| std::array::from_fn(|c| at(3 * k + c)));
            if all.iter().flatten().any(|x| !x.is_finite()) {
                return Err(field("coeffs", "one of them is not a finite number"));
            }
            Ok(Some(all))
        }
        1 => Err(field("numCoeffs", format!("{count} where there are always 9"))),
        other => Err(field("includesSH", format!("{other} is neither 0 nor 1"))),
    }
}

/// Coefficients of `irradiance_sh2` seen in a mirror that lies flat: those of y, xy and yz change their sign.
pub(crate) fn mirrored_sh(coefficients: &[[f32; 3]; 9]) -> [[f32; 3]; 9] {
    std::array::from_fn(|k| if [1, 4, 5].contains(&k) { coefficients[k].map(|x| -x) } else { coefficients[k] })
}

/// The cube seen in a mirror that lies flat: y becomes -y.
fn mirror_y(cube: &mut Cube) {
    let face = cube.size * cube.size;
    let (up, down) = cube.texels[2 * face..4 * face].split_at_mut(face);
    up.swap_with_slice(down);
    *cube = flipped_rows(cube);
}

/// The rows of every face in the other order.
fn flipped_rows(cube: &Cube) -> Cube {
    let size = cube.size;
    let face = size * size;
    let texels = (0..cube.texels.len())
        .map(|k| {
            let (row, column) = (k % face / size, k % size);
            cube.texels[k / face * face + (size - 1 - row) * size + column]
        })
        .collect();
    Cube { size, texels }
}

/// Sum of squares of the differences of two cubes of one size, in logarithms so that a lamp does not decide alone.
fn difference(a: &Cube, b: &Cube) -> f64 {
    let log = |x: f32| f64::from((x.max(0.0) + 1e-3).ln());
    let pairs = a.texels.iter().flatten().zip(b.texels.iter().flatten());
    pairs.map(|(&a, &b)| log(a) - log(b)).filter(|d| d.is_finite()).map(|d| d * d).sum()
}
