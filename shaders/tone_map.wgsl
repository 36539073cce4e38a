// Tone maps: radiance times exposure becomes a display's linear light. Linear Rec. 709 in and out, 0 to 1 out; the sRGB
// coding comes after (color.wgsl). Inputs are clamped to 0..65504 (the largest half float), so that no square overflows.

/// The largest radiance that the tone maps tell from infinity: the largest half float.
const TONE_MAP_MAX: f32 = 65504.0;

// What a display cannot show is cut off: c' = min(max(c, 0), 1).
fn tone_map_none(c: vec3f) -> vec3f {
    return clamp(c, vec3f(0.0), vec3f(1.0));
}

// Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic tone reproduction for digital images", eq. 3, by channel:
// c' = c / (1 + c).
fn tone_map_reinhard(c: vec3f) -> vec3f {
    let x = clamp(c, vec3f(0.0), vec3f(TONE_MAP_MAX));
    return x / (vec3f(1.0) + x);
}

// Narkowicz 2015, "ACES filmic tone mapping curve": a rational fit of the ACES reference and output transforms, by
// channel: c' = c (2.51 c + 0.03) / (c (2.43 c + 0.59) + 0.14). It passes 1 at c = 7.22 and is cut off there.
fn tone_map_aces(c: vec3f) -> vec3f {
    let x = clamp(c, vec3f(0.0), vec3f(TONE_MAP_MAX));
    let y = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return clamp(y, vec3f(0.0), vec3f(1.0));
}

// Sobotka 2022, "AgX", in Wrensch's form (2023, "Minimal AgX implementation"): the primaries are drawn inwards by a
// matrix, log2 exposure from -12.47393 to 4.026069 stops is mapped to 0..1, a polynomial of degree 6 stands for the
// sigmoid, and the inverse matrix draws the primaries out again. AgX ends in a display of gamma 2.2: undone here, so
// that the result is linear.
fn tone_map_agx(c: vec3f) -> vec3f {
    let x = clamp(c, vec3f(0.0), vec3f(TONE_MAP_MAX));
    let inset = vec3f(
        dot(vec3f(0.842479062253094, 0.0784335999999992, 0.0792237451477643), x),
        dot(vec3f(0.0423282422610123, 0.878468636469772, 0.0791661274605434), x),
        dot(vec3f(0.0423756549057051, 0.0784336, 0.879142973793104), x),
    );
    // 1e-10 keeps the logarithm finite; it is far below the lowest stop.
    let stops = clamp(log2(max(inset, vec3f(1e-10))), vec3f(-12.47393), vec3f(4.026069));
    let t = (stops + vec3f(12.47393)) / (4.026069 + 12.47393);
    let shaped = agx_contrast(t);
    let outset = vec3f(
        dot(vec3f(1.19687900512017, -0.0980208811401368, -0.0990297440797205), shaped),
        dot(vec3f(-0.0528968517574562, 1.15190312990417, -0.0989611768448433), shaped),
        dot(vec3f(-0.0529716355144438, -0.0980434501171241, 1.15107367264116), shaped),
    );
    return pow(clamp(outset, vec3f(0.0), vec3f(1.0)), vec3f(2.2));
}

// Wrensch 2023: polynomial fit of AgX's default contrast curve on 0..1, mean square error 3.7e-6:
// 15.5 t^6 - 40.14 t^5 + 31.96 t^4 - 6.868 t^3 + 0.4298 t^2 + 0.1191 t - 0.00232.
fn agx_contrast(t: vec3f) -> vec3f {
    return ((((((15.5 * t - 40.14) * t + 31.96) * t - 6.868) * t + 0.4298) * t) + 0.1191) * t - 0.00232;
}

// Khronos 2024, "Khronos PBR Neutral tone mapper": colours up to 0.8 are kept but for the 4 % that a dielectric's
// reflection adds (subtracted: f = x - x^2 / (4 * 0.04) below x = min(r, g, b) = 0.08, else 0.04), the peak above
// s = 0.76 is compressed by 1 - d^2 / (p + d - s), d = 1 - s, and mixed towards white by 1 - 1 / (0.15 (p - p') + 1).
fn tone_map_pbr_neutral(c: vec3f) -> vec3f {
    let positive = clamp(c, vec3f(0.0), vec3f(TONE_MAP_MAX));
    let dark = min(min(positive.r, min(positive.g, positive.b)), 0.08);
    let x = positive - vec3f(dark - 6.25 * dark * dark);
    let start: f32 = 0.76;
    // A lower peak is taken as s, where nothing is compressed or mixed: no branch.
    let peak = max(max(x.r, max(x.g, x.b)), start);
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(x * (new_peak / peak), vec3f(new_peak), white);
}
