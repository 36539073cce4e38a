//! The colour spaces of FLIP: linear Rec. 709, CIE XYZ, CIE 1976 L*a*b*, and the linear opponent space YCxCz.

/// (Y, Cx, Cz): lightness, red against green, blue against yellow, all linear in light.
pub(super) type Opponent = [f64; 3];

/// XYZ from linear Rec. 709 with white D65. IEC 61966-2-1:1999, from the primaries' chromaticities.
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [0.412_386_563_252_991_7, 0.357_591_490_920_625_37, 0.180_450_491_203_563_68],
    [0.212_636_821_677_323_84, 0.715_182_981_841_250_7, 0.072_180_196_481_425_47],
    [0.019_330_620_152_483_987, 0.119_197_163_640_208_45, 0.950_372_587_005_435_4],
];
/// Its inverse.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_232_976_358, -1.537_398_969_488_785, -0.498_615_881_996_363],
    [-0.969_224_252_202_516_4, 1.875_929_983_695_176, 0.041_554_226_340_084_72],
    [0.055_639_419_851_975_47, -0.204_011_206_123_909_7, 1.057_148_977_187_533],
];

fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ of white.
fn white() -> [f64; 3] {
    times(&XYZ_FROM_RGB, [1.0; 3])
}

/// Luminance of linear Rec. 709.
pub(super) fn luminance(rgb: [f64; 3]) -> f64 {
    times(&XYZ_FROM_RGB, rgb)[1]
}

fn relative_to_white(rgb: [f64; 3]) -> [f64; 3] {
    let (xyz, white) = (times(&XYZ_FROM_RGB, rgb), white());
    std::array::from_fn(|i| xyz[i] / white[i])
}

/// Flohr, Kolpatzik, Balasubramanian, Carrara, Bouman, Allebach 1993: Lab's opponents without its cube root.
pub(super) fn opponent_from_rgb(rgb: [f64; 3]) -> Opponent {
    let [x, y, z] = relative_to_white(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

pub(super) fn rgb_from_opponent([lightness, cx, cz]: Opponent) -> [f64; 3] {
    let y = (lightness + 16.0) / 116.0;
    let (relative, white) = ([y + cx / 500.0, y, y - cz / 200.0], white());
    times(&RGB_FROM_XYZ, std::array::from_fn(|i| relative[i] * white[i]))
}

/// CIE 1976, with the linear part near black.
pub(super) fn lab_from_rgb(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let root = |t: f64| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
    let [x, y, z] = relative_to_white(rgb).map(root);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}
