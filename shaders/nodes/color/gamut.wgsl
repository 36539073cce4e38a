// Colours of wider gamuts in the linear Rec. 709 that everything here is in. What lies outside of it has channels below 0.

/// Rec. 709 from Display P3
///
/// A linear colour of Display P3 as the same colour in linear Rec. 709: Apple's and SMPTE EG 432-1's wide gamut, white D65. Colours
/// outside of Rec. 709 have negative channels; keep them or saturate them.
/// @node color/rec709_from_display_p3   @also gamut, color space, phone, wide gamut
/// - color: linear colour of Display P3 [0.5,0.5,0.5; 0..1; color]
/// - return: linear Rec. 709
fn node_color_rec709_from_display_p3(color: vec3f) -> vec3f {
    return vec3f(
        dot(color, vec3f(1.2249402, -0.2249402, 0.0)),
        dot(color, vec3f(-0.0420570, 1.0420570, 0.0)),
        dot(color, vec3f(-0.0196376, -0.0786360, 1.0982736)),
    );
}

/// Rec. 709 from Rec. 2020
///
/// A linear colour of Rec. 2020 as the same colour in linear Rec. 709: ITU-R BT.2020-2 (2015), white D65. Colours
/// outside of Rec. 709 have negative channels; keep them or saturate them.
/// @node color/rec709_from_rec2020   @also gamut, color space, hdr, uhd, wide gamut
/// - color: linear colour of Rec. 2020 [0.5,0.5,0.5; 0..1; color]
/// - return: linear Rec. 709
fn node_color_rec709_from_rec2020(color: vec3f) -> vec3f {
    return vec3f(
        dot(color, vec3f(1.6604910, -0.5876411, -0.0728499)),
        dot(color, vec3f(-0.1245505, 1.1328999, -0.0083494)),
        dot(color, vec3f(-0.0181508, -0.1005789, 1.1187297)),
    );
}

/// Rec. 709 from ACEScg
///
/// A linear colour of ACEScg as the same colour in linear Rec. 709: AP1 primaries, white D60, of S-2014-004 (2015), with Bradford's adaptation to D65. Colours
/// outside of Rec. 709 have negative channels; keep them or saturate them.
/// @node color/rec709_from_acescg   @also gamut, color space, aces, ap1, film
/// - color: linear colour of ACEScg [0.5,0.5,0.5; 0..1; color]
/// - return: linear Rec. 709
fn node_color_rec709_from_acescg(color: vec3f) -> vec3f {
    return vec3f(
        dot(color, vec3f(1.7050510, -0.6217921, -0.0832589)),
        dot(color, vec3f(-0.1302564, 1.1408047, -0.0105483)),
        dot(color, vec3f(-0.0240034, -0.1289690, 1.1529723)),
    );
}

/// Rec. 709 from Adobe RGB
///
/// A linear colour of Adobe RGB as the same colour in linear Rec. 709: Adobe RGB (1998), version 2005-05, white D65. Pictures in it are coded
/// with the power 563/256: read them as linear, and raise them to that power first. Colours outside of Rec. 709 have negative channels;
/// keep them or saturate them.
/// @node color/rec709_from_adobe_rgb   @also gamut, color space, photograph, wide gamut
/// - color: linear colour of Adobe RGB [0.5,0.5,0.5; 0..1; color]
/// - return: linear Rec. 709
fn node_color_rec709_from_adobe_rgb(color: vec3f) -> vec3f {
    return vec3f(
        dot(color, vec3f(1.3983557, -0.3983557, 0.0)),
        dot(color, vec3f(0.0, 1.0000000, 0.0)),
        dot(color, vec3f(0.0, -0.0429290, 1.0429290)),
    );
}
