//! Tone maps: radiance times exposure becomes a display's linear light, linear Rec. 709 in and out, 0 to 1 out. Twins of
//! `tone_map.wgsl`, generic over f32 and f64. The sRGB coding comes after and is not done here.

use halfvector_graph::needs::ToneMap;
use halfvector_maps::Real;

use crate::real::{clamp, dot, max, min, real};

/// The largest radiance that the tone maps tell from infinity: the largest half float.
pub const TONE_MAP_MAX: f64 = 65504.0;

/// What a display cannot show is cut off: c' = min(max(c, 0), 1).
pub fn tone_map_none<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|x| clamp(x, real(0.0), real(1.0)))
}

/// Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic tone reproduction for digital images", eq. 3, by channel:
/// c' = c / (1 + c).
pub fn tone_map_reinhard<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|c| {
        let x = clamp(c, real(0.0), real(TONE_MAP_MAX));
        x / (real::<R>(1.0) + x)
    })
}

/// Narkowicz 2015, "ACES filmic tone mapping curve": a rational fit of the ACES reference and output transforms, by
/// channel: c' = c (2.51 c + 0.03) / (c (2.43 c + 0.59) + 0.14), cut off at 1.
pub fn tone_map_aces<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|c| {
        let x = clamp(c, real(0.0), real(TONE_MAP_MAX));
        let y = x * (real::<R>(2.51) * x + real(0.03)) / (x * (real::<R>(2.43) * x + real(0.59)) + real(0.14));
        clamp(y, real(0.0), real(1.0))
    })
}

/// Sobotka 2022, "AgX", in Wrensch's form (2023, "Minimal AgX implementation"): inset of the primaries, log2 exposure
/// from -12.47393 to 4.026069 stops, a polynomial sigmoid, outset. AgX ends in a display of gamma 2.2: undone here, so
/// that the result is linear.
pub fn tone_map_agx<R: Real>(c: [R; 3]) -> [R; 3] {
    let x = c.map(|x| clamp(x, real(0.0), real(TONE_MAP_MAX)));
    let row = |a: f64, b: f64, c: f64, v: [R; 3]| dot([a, b, c].map(real), v);
    let inset = [
        row(0.842479062253094, 0.0784335999999992, 0.0792237451477643, x),
        row(0.0423282422610123, 0.878468636469772, 0.0791661274605434, x),
        row(0.0423756549057051, 0.0784336, 0.879142973793104, x),
    ];
    let t = inset.map(|v| {
        // 1e-10 keeps the logarithm finite; it is far below the lowest stop.
        let stops = clamp(max(v, real(1e-10)).log2(), real(-12.47393), real(4.026069));
        (stops + real(12.47393)) / real(4.026069 + 12.47393)
    });
    let shaped = agx_contrast(t);
    let outset = [
        row(1.19687900512017, -0.0980208811401368, -0.0990297440797205, shaped),
        row(-0.0528968517574562, 1.15190312990417, -0.0989611768448433, shaped),
        row(-0.0529716355144438, -0.0980434501171241, 1.15107367264116, shaped),
    ];
    outset.map(|v| clamp(v, real(0.0), real(1.0)).powf(real(2.2)))
}

/// Wrensch 2023: polynomial fit of AgX's default contrast curve on 0..1, mean square error 3.7e-6:
/// 15.5 t^6 - 40.14 t^5 + 31.96 t^4 - 6.868 t^3 + 0.4298 t^2 + 0.1191 t - 0.00232.
pub fn agx_contrast<R: Real>(t: [R; 3]) -> [R; 3] {
    const COEFFICIENTS: [f64; 6] = [-40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
    t.map(|t| COEFFICIENTS.iter().fold(real(15.5), |sum: R, &c| sum * t + real(c)))
}

/// Khronos 2024, "Khronos PBR Neutral tone mapper": colours up to 0.8 are kept but for the 4 % that a dielectric's
/// reflection adds, the peak above 0.76 is compressed by 1 - d^2 / (p + d - s) and mixed towards white.
pub fn tone_map_pbr_neutral<R: Real>(c: [R; 3]) -> [R; 3] {
    let positive = c.map(|x| clamp(x, real(0.0), real(TONE_MAP_MAX)));
    let dark = min(min(positive[0], min(positive[1], positive[2])), real(0.08));
    let x = positive.map(|x| x - (dark - real::<R>(6.25) * dark * dark));
    let start: R = real(0.76);
    let peak = max(max(x[0], max(x[1], x[2])), start);
    let one: R = real(1.0);
    let room = one - start;
    let new_peak = one - room * room / (peak + room - start);
    let white = one - one / (real::<R>(0.15) * (peak - new_peak) + one);
    x.map(|x| x * (new_peak / peak) * (one - white) + new_peak * white)
}

/// The tone map with this choice: linear Rec. 709 in and out, 0 to 1 out.
pub fn tone_mapped<R: Real>(tone_map: ToneMap, c: [R; 3]) -> [R; 3] {
    match tone_map {
        ToneMap::None => tone_map_none(c),
        ToneMap::Reinhard => tone_map_reinhard(c),
        ToneMap::Aces => tone_map_aces(c),
        ToneMap::Agx => tone_map_agx(c),
        ToneMap::PbrNeutral => tone_map_pbr_neutral(c),
    }
}

/// The tone map with this name on the command line and in files; the error lists the names.
pub fn tone_map_from_name(name: &str) -> Result<ToneMap, String> {
    ToneMap::ALL.into_iter().find(|t| t.name() == name).ok_or_else(|| {
        let names: Vec<_> = ToneMap::ALL.iter().map(|t| t.name()).collect();
        format!("there is no tone map `{name}`; choose one of {}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tone_map_stays_in_range_for_any_input() {
        let inputs = [0.0, -1.0, 1e-30, 0.04, 0.18, 1.0, 7.3, 1e4, 1e30, f64::MAX, f64::INFINITY, f64::NEG_INFINITY];
        for map in ToneMap::ALL {
            for r in inputs {
                for g in inputs {
                    let display = tone_mapped(map, [r, g, 0.5]);
                    let display32 = tone_mapped(map, [r as f32, g as f32, 0.5]);
                    for (x, y) in display.into_iter().zip(display32) {
                        assert!((0.0..=1.0).contains(&x), "{map:?} of {r} {g}: {x}");
                        assert!((0.0..=1.0 + 1e-6).contains(&y), "{map:?} in f32 of {r} {g}: {y}");
                        assert!((x - f64::from(y)).abs() < 2e-5, "{map:?} of {r} {g}: {x} in f64, {y} in f32");
                    }
                }
            }
        }
    }

    #[test]
    fn greys_stay_grey_and_in_order() {
        for map in ToneMap::ALL {
            let mut last = -1.0;
            for i in 0..400 {
                let x = f64::from(i) * 0.025;
                let [r, g, b] = tone_mapped(map, [x; 3]);
                // Wrensch's matrices have rows that sum to 1 within 3e-4.
                assert!((r - g).abs() < 1e-3 && (g - b).abs() < 1e-3, "{map:?} of grey {x}: {r} {g} {b}");
                assert!(g >= last - 1e-12, "{map:?} falls at {x}");
                last = g;
            }
        }
    }

    #[test]
    fn known_values() {
        assert_eq!(tone_map_reinhard([1.0, 3.0, 0.0]), [0.5, 0.75, 0.0]);
        // Neutral keeps a colour whose lowest channel is 0.04 over the toe: 0.08 - 0.04 = 0.04.
        let [r, g, b] = tone_map_pbr_neutral([0.5, 0.3, 0.08]);
        assert!((r - 0.46).abs() < 1e-12 && (g - 0.26).abs() < 1e-12 && (b - 0.04).abs() < 1e-12);
        // Below that the toe is x - 6.25 x^2: 0.04 - 0.01 = 0.03.
        let [r, _, b] = tone_map_pbr_neutral([0.5, 0.3, 0.04]);
        assert!((r - 0.47).abs() < 1e-12 && (b - 0.01).abs() < 1e-12);
        // It is continuous where the compression starts, at a peak of 0.8.
        let [below, ..] = tone_map_pbr_neutral([0.8 - 1e-9, 0.2, 0.1]);
        let [above, ..] = tone_map_pbr_neutral([0.8 + 1e-9, 0.2, 0.1]);
        assert!((below - above).abs() < 1e-8);
        // AgX puts middle grey near the display's middle (Sobotka: 0.18 to about 0.18 linear).
        let [r, ..] = tone_map_agx([0.18; 3]);
        assert!((0.15..0.25).contains(&r), "AgX of 0.18 is {r}");
        // Narkowicz's fit: 0.18 to 0.2669.
        let [r, ..] = tone_map_aces([0.18; 3]);
        assert!((r - 0.26690).abs() < 1e-4, "ACES of 0.18 is {r}");
    }

    #[test]
    fn names_are_found_and_refused() {
        assert_eq!(tone_map_from_name("agx"), Ok(ToneMap::Agx));
        assert!(tone_map_from_name("filmic").unwrap_err().contains("pbr-neutral"));
    }
}
