//! What a file says about the coding of its colours, and bringing them to sRGB, which is how colours are stored here.
//!
//! ICC profiles of curves and a matrix, or of one grey curve, PNG's gAMA, cHRM and cICP and their like are applied.
//! Profiles of tables, of other colour models and damaged ones are refused by name. Does not adapt gamuts: what sRGB
//! cannot show is clipped, and counted.

use moxcms::{Chromaticity, ColorPrimaries, ColorProfile, DataColorSpace, ProfileText, ToneReprCurve};
use rayon::prelude::*;

use crate::coding::srgb8;
use crate::color::srgb_from_linear;
use crate::image::{Image, Texels};

/// What a file says about its colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Where it stands and what it is called, such as `ICC profile "Display P3"` or `gAMA 0.45455`.
    name: String,
    meaning: Meaning,
}

#[derive(Clone, Debug, PartialEq)]
enum Meaning {
    /// sRGB, to within one step of 8 bits.
    Srgb,
    Curves(Box<Curves>),
    /// Not understood, and why.
    Refused(String),
}

/// Linear Rec. 709 is `rec709_from_file` times the curves' values.
#[derive(Clone, Debug, PartialEq)]
struct Curves {
    linear_from_file: [ToneReprCurve; 3],
    rec709_from_file: [[f64; 3]; 3],
}

/// ISO/IEC 15948 (2003), 11.3.3.5: the gAMA value that stands for sRGB, in hundred thousandths.
const SRGB_GAMMA: u32 = 45_455;

/// IEC 61966-2-1 as an ICC parametric curve: g, a, b, c, d of (a x + b)^g where x >= d, else c x.
const SRGB_CURVE: [f32; 5] = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.040_45];

/// White, red, green and blue of Rec. 709 as x, y.
pub(crate) const REC709: [[f64; 2]; 4] = [[0.3127, 0.3290], [0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// The matrix that changes nothing.
const NEUTRAL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Profile {
    /// Says sRGB in so many words.
    pub(crate) fn srgb(name: impl Into<String>) -> Self {
        Self { name: name.into(), meaning: Meaning::Srgb }
    }

    pub(crate) fn refused(name: impl Into<String>, why: impl Into<String>) -> Self {
        Self { name: name.into(), meaning: Meaning::Refused(why.into()) }
    }

    /// Rec. 709 colours that are linear.
    pub(crate) fn linear(name: impl Into<String>) -> Self {
        Self::of_curves(name.into(), ToneReprCurve::Lut(Vec::new()), REC709)
    }

    /// PNG's gAMA (the exponent from light to code, in hundred thousandths) and cHRM (white, red, green, blue). Without
    /// gAMA the curve is sRGB's, without cHRM the colours are.
    pub(crate) fn from_gamma(name: String, gamma: Option<u32>, primaries: Option<[[f64; 2]; 4]>) -> Self {
        let curve = match gamma {
            Some(0) => return Self::refused(name, "it is 0"),
            Some(gamma) if gamma.abs_diff(SRGB_GAMMA) > 100 => ToneReprCurve::Parametric(vec![1e5 / gamma as f32]),
            _ => ToneReprCurve::Parametric(SRGB_CURVE.to_vec()),
        };
        Self::of_curves(name, curve, primaries.unwrap_or(REC709))
    }

    /// PNG's cICP: colour primaries, transfer function, matrix and range by the numbers of ITU-T H.273.
    pub(crate) fn from_cicp([primaries, transfer, matrix, full_range]: [u8; 4]) -> Self {
        let name = format!("cICP {primaries}/{transfer}/{matrix}/{full_range}");
        if matrix != 0 || full_range != 1 {
            return Self::refused(name, "only full-range RGB is read");
        }
        let xy = match primaries {
            1 => REC709,
            9 => [[0.3127, 0.3290], [0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            12 => [[0.3127, 0.3290], [0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
            _ => return Self::refused(name, "only the primaries 1, 9 and 12 (Rec. 709, Rec. 2020, P3) are read"),
        };
        match transfer {
            13 => Self::of_curves(name, ToneReprCurve::Parametric(SRGB_CURVE.to_vec()), xy),
            8 => Self::of_curves(name, ToneReprCurve::Lut(Vec::new()), xy),
            _ => Self::refused(name, "only the transfer functions 8 and 13 (linear, sRGB) are read"),
        }
    }

    /// An ICC profile (ISO 15076-1) for an image of grey or of colours.
    pub(crate) fn from_icc(bytes: &[u8], is_grey: bool) -> Self {
        let Ok(profile) = ColorProfile::new_from_slice(bytes) else {
            return Self::refused("ICC profile", "it is damaged");
        };
        let name = format!("ICC profile {}", described(profile.description.as_ref()));
        let tables = [&profile.lut_a_to_b_perceptual, &profile.lut_a_to_b_colorimetric, &profile.lut_a_to_b_saturation];
        if tables.iter().any(|table| table.is_some()) {
            return Self::refused(name, "it maps colours through tables");
        }
        let curves = match profile.color_space {
            DataColorSpace::Gray if is_grey => {
                let Some(curve) = profile.gray_trc else { return Self::refused(name, "it has no curve") };
                Curves { linear_from_file: [curve.clone(), curve.clone(), curve], rec709_from_file: NEUTRAL }
            }
            DataColorSpace::Rgb if profile.is_matrix_shaper() && profile.pcs == DataColorSpace::Xyz => {
                let matrix = profile.transform_matrix(&ColorProfile::new_srgb()).v;
                let (Some(r), Some(g), Some(b)) = (profile.red_trc, profile.green_trc, profile.blue_trc) else {
                    return Self::refused(name, "it has not three curves");
                };
                Curves { linear_from_file: [r, g, b], rec709_from_file: matrix }
            }
            DataColorSpace::Rgb => return Self::refused(name, "it has no matrix and curves"),
            DataColorSpace::Gray => return Self::refused(name, "it is one for grey and the image has colours"),
            other => return Self::refused(name, format!("it is one for {other:?}")),
        };
        Self::checked(name, curves)
    }

    fn of_curves(name: String, curve: ToneReprCurve, [white, red, green, blue]: [[f64; 2]; 4]) -> Self {
        let across = |[x, y]: [f64; 2], [u, v]: [f64; 2]| (x - blue[0]) * (v - blue[1]) - (y - blue[1]) * (u - blue[0]);
        if white[1] < 0.01 || across(red, green).abs() < 1e-4 {
            return Self::refused(name, "its primaries are no colours");
        }
        let linear_from_file = [curve.clone(), curve.clone(), curve];
        let is_rec709 = |stated: [[f64; 2]; 4]| {
            let apart = |(a, b): (&f64, &f64)| (a - b).abs() > 1.5e-5;
            !stated.as_flattened().iter().zip(REC709.as_flattened()).any(apart)
        };
        if is_rec709([white, red, green, blue]) {
            // Exactly: what rounding leaves beside the diagonal would take saturated colours out of the gamut.
            return Self::checked(name, Curves { linear_from_file, rec709_from_file: NEUTRAL });
        }
        let xy = |[x, y]: [f64; 2]| Chromaticity::new(x as f32, y as f32);
        let mut profile = ColorProfile::default();
        profile.update_rgb_colorimetry(
            xy(white).to_xyyb(),
            ColorPrimaries { red: xy(red), green: xy(green), blue: xy(blue) },
        );
        let rec709_from_file = profile.transform_matrix(&ColorProfile::new_srgb()).v;
        Self::checked(name, Curves { linear_from_file, rec709_from_file })
    }

    /// Finds out whether curves and matrix make sense, and whether they are sRGB's.
    fn checked(name: String, curves: Curves) -> Self {
        let Some(tables) = curves.tables::<256>() else { return Self::refused(name, "its curves are damaged") };
        if !curves.rec709_from_file.as_flattened().iter().all(|x| x.is_finite() && x.abs() < 1e3) {
            return Self::refused(name, "its primaries are no colours");
        }
        let steps = || (0..=255_usize).step_by(15).chain([1, 2, 4, 8]);
        let moves = |codes: [usize; 3]| {
            let linear = curves.rec709([0, 1, 2].map(|k| tables[k][codes[k]]));
            (0..3).any(|k| usize::from(srgb8().code(linear[k] as f32)).abs_diff(codes[k]) > 1)
        };
        let is_srgb = !steps().any(|r| steps().any(|g| steps().any(|b| moves([r, g, b]))));
        Self { name, meaning: if is_srgb { Meaning::Srgb } else { Meaning::Curves(Box::new(curves)) } }
    }

    /// Where it stands and what it is called, such as `ICC profile "Display P3"`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it says what is taken for granted without one: sRGB, to within one step of 8 bits.
    pub fn is_srgb(&self) -> bool {
        self.meaning == Meaning::Srgb
    }

    /// The image with colours in sRGB, of the same depth, and how many texels had to be clipped; `None` where nothing was to be
    /// done. 8 and 16 bits are clipped to 0..1 and rounded, floats are not. Alpha stays. Nothing is copied.
    ///
    /// # Errors
    /// Why the profile cannot be applied, in words.
    pub(crate) fn to_srgb(&self, image: Image) -> Result<(Image, Option<usize>), &str> {
        let curves = match &self.meaning {
            Meaning::Srgb => return Ok((image, None)),
            Meaning::Refused(why) => return Err(why),
            Meaning::Curves(curves) => curves,
        };
        let damaged = "its curves are damaged";
        let is_out = |linear: &[f64; 3]| linear.iter().any(|c| !(-1e-4..=1.0 + 1e-4).contains(c));
        let (width, height, channels) = (image.width(), image.height(), image.channels());
        let mut texels = image.into_texels();
        let clipped = match &mut texels {
            Texels::U8(texels) => {
                let tables = curves.tables::<256>().ok_or(damaged)?;
                each(texels, |[r, g, b, a]| {
                    let linear = curves.rec709([(0, r), (1, g), (2, b)].map(|(k, c)| tables[k][usize::from(c)]));
                    let [r, g, b] = linear.map(|c| srgb8().code(c as f32));
                    ([r, g, b, a], is_out(&linear))
                })
            }
            Texels::U16(texels) => {
                let tables = curves.tables::<65_536>().ok_or(damaged)?;
                each(texels, |[r, g, b, a]| {
                    let linear = curves.rec709([(0, r), (1, g), (2, b)].map(|(k, c)| tables[k][usize::from(c)]));
                    let [r, g, b] = srgb_from_linear(linear).map(|c| (c * 65_535.0 + 0.5) as u16);
                    ([r, g, b, a], is_out(&linear))
                })
            }
            Texels::F32(_) => return Err("it codes light for integers and the file has floats"),
        };
        let image = Image::new(width, height, channels, texels).map_err(|_| damaged)?;
        Ok((image, Some(clipped)))
    }
}

impl Curves {
    /// Linear light of N evenly spaced codes of each channel; `None` for a curve that cannot be evaluated.
    fn tables<const N: usize>(&self) -> Option<[Vec<f64>; 3]> {
        let table = |curve: &ToneReprCurve| {
            let values: Option<Vec<f64>> = (0..N).map(|code| linear(curve, code as f64 / (N - 1) as f64)).collect();
            values.filter(|values| values.iter().all(|x| x.is_finite()))
        };
        let [r, g, b] = &self.linear_from_file;
        Some([table(r)?, table(g)?, table(b)?])
    }

    fn rec709(&self, linear: [f64; 3]) -> [f64; 3] {
        self.rec709_from_file.map(|row| row[0] * linear[0] + row[1] * linear[1] + row[2] * linear[2])
    }
}

/// A curve's value at `x` in 0..1; `None` for one of no kind. ISO 15076-1 (2010), 10.6 and 10.18. In f64 here: evaluators
/// made for speed are wrong at 0.
fn linear(curve: &ToneReprCurve, x: f64) -> Option<f64> {
    let power = |base: f64, exponent: f64| base.max(0.0).powf(exponent);
    Some(match curve {
        ToneReprCurve::Lut(table) => match table.as_slice() {
            [] => x,
            [gamma] => power(x, f64::from(*gamma) / 256.0),
            table => {
                let place = x * (table.len() - 1) as f64;
                let first = (place as usize).min(table.len() - 2);
                let [a, b] = [table[first], table[first + 1]].map(|code| f64::from(code) / 65_535.0);
                a + (b - a) * (place - first as f64)
            }
        },
        ToneReprCurve::Parametric(parameters) => {
            let parameters: Vec<f64> = parameters.iter().map(|&x| f64::from(x)).collect();
            match *parameters.as_slice() {
                [g] => power(x, g),
                [g, a, b] if a * x + b >= 0.0 => power(a * x + b, g),
                [_, _, _] => 0.0,
                [g, a, b, c] if a * x + b >= 0.0 => power(a * x + b, g) + c,
                [_, _, _, c] => c,
                [g, a, b, _, d] if x >= d => power(a * x + b, g),
                [_, _, _, c, _] => c * x,
                [g, a, b, _, d, e, _] if x >= d => power(a * x + b, g) + e,
                [_, _, _, c, _, _, f] => c * x + f,
                _ => return None,
            }
        }
    })
}

/// All texels through `f`, and how often it said true.
fn each<T: Copy + Send + Sync>(texels: &mut [[T; 4]], f: impl Fn([T; 4]) -> ([T; 4], bool) + Sync) -> usize {
    texels
        .par_iter_mut()
        .with_min_len(1 << 14)
        .map(|texel| {
            let (new, is_out) = f(*texel);
            *texel = new;
            usize::from(is_out)
        })
        .sum()
}

/// A profile's own name in quotes, made safe to print.
fn described(description: Option<&ProfileText>) -> String {
    let text = match description {
        Some(ProfileText::PlainString(text)) => text.as_str(),
        Some(ProfileText::Localizable(texts)) => texts.first().map_or("", |text| text.value.as_str()),
        Some(ProfileText::Description(text)) => text.ascii_string.as_str(),
        None => "",
    };
    let text: String = text.chars().filter(|c| !c.is_control()).take(60).collect();
    if text.trim().is_empty() { "without a name".to_owned() } else { format!("\"{}\"", text.trim()) }
}
