//! Radiance as the 8-bit codes that displays and PNG files take.

use halfvector_graph::needs::ToneMap;

use crate::tone_map::tone_mapped;

/// How radiance becomes 8-bit codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Display {
    /// Times a factor, through a tone map, then sRGB.
    ToneMapped {
        /// Factor from radiance.
        exposure: f32,
        /// After it.
        tone_map: ToneMap,
    },
    /// The picture holds display values already (`encode=report`).
    AsIs,
}

impl Display {
    /// The codes of a pixel of radiance times alpha and alpha. They have straight alpha: the colour is what lies behind
    /// the coverage. NaN becomes 0.
    pub fn codes(self, [r, g, b, alpha]: [f32; 4]) -> [u8; 4] {
        let alpha = alpha.clamp(0.0, 1.0);
        let straight = if alpha > 0.0 { [r, g, b].map(|c| c / alpha) } else { [0.0; 3] };
        let [r, g, b] = match self {
            Display::AsIs => straight,
            Display::ToneMapped { exposure, tone_map } => {
                halfvector_maps::color::srgb_from_linear(tone_mapped(tone_map, straight.map(|c| c * exposure)))
            }
        };
        [r, g, b, alpha].map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Display = Display::ToneMapped { exposure: 1.0, tone_map: ToneMap::None };

    #[test]
    fn pixels_are_coded_with_straight_alpha() {
        // A half covered pixel of radiance 0.25: 0.25 is 137 in sRGB.
        assert_eq!(PLAIN.codes([0.125, 0.125, 0.125, 0.5]), [137, 137, 137, 128]);
        assert_eq!(PLAIN.codes([0.0; 4]), [0; 4]);
        assert_eq!(PLAIN.codes([f32::NAN, 2.0, -1.0, 1.0]), [0, 255, 0, 255]);
        assert_eq!(Display::AsIs.codes([0.5, 0.25, 0.0, 1.0]), [128, 64, 0, 255]);
        let brighter = Display::ToneMapped { exposure: 2.0, tone_map: ToneMap::None };
        assert_eq!(brighter.codes([0.125, 0.125, 0.125, 1.0]), [137, 137, 137, 255]);
    }
}
