//! 8-bit sRGB by tables, and rounding to codes. The transfer function itself is in [`crate::color`].

use std::sync::LazyLock;

use crate::color::linear_from_srgb;

/// 2^23: from here on the numbers of f32 are whole, so that adding it rounds, to even where two are as near. A cast would too,
/// but its care for what does not fit keeps loops from becoming vectors.
const WHOLE: f32 = 8_388_608.0;

/// The nearest whole number of `x` within 0..=`most`, which is below 2^23; NaN is 0.
#[inline(always)]
fn nearest(x: f32, most: f32) -> u32 {
    let x = if x > 0.0 { x } else { 0.0 };
    let x = if x < most { x } else { most };
    (x + WHOLE).to_bits() - WHOLE.to_bits()
}

/// The nearest 8-bit code of 0..1; clamped, NaN is 0.
#[inline(always)]
pub(crate) fn code_u8(x: f32) -> u8 {
    nearest(x * 255.0, 255.0) as u8
}

/// The nearest 16-bit code of 0..1; clamped, NaN is 0.
#[inline(always)]
pub(crate) fn code_u16(x: f32) -> u16 {
    nearest(x * 65535.0, 65535.0) as u16
}

/// 8-bit sRGB by table, exact in both directions.
pub(crate) struct Srgb8 {
    /// Linear value of each code.
    pub(crate) linear: [f32; 256],
    /// Linear value from which on the code after each is nearer; none is for the last.
    above: [f32; 256],
    /// Code at the lower end of each 4096th of the linear range. Two thresholds are never so near to each other (255 x
    /// 12.92 is less than 4096), so that the code is this one or the next. Past the range the last, so that masked numbers
    /// are places.
    start: [u32; 2 * Self::STEPS],
}

static SRGB8: LazyLock<Srgb8> = LazyLock::new(|| {
    let linear_of = |s: f64| linear_from_srgb([s; 3])[0] as f32;
    let linear = std::array::from_fn(|code| linear_of(code as f64 / 255.0));
    let above = std::array::from_fn(|code| if code == 255 { f32::NAN } else { linear_of((code as f64 + 0.5) / 255.0) });
    let start = std::array::from_fn(|step| {
        let low = step as f32 / Srgb8::STEPS as f32;
        above.iter().filter(|&&t: &&f32| t <= low).count() as u32
    });
    Srgb8 { linear, above, start }
});

/// The tables, made on first use.
pub(crate) fn srgb8() -> &'static Srgb8 {
    &SRGB8
}

impl Srgb8 {
    const STEPS: usize = 4096;

    /// The code nearest, in sRGB, to a linear value; clamped to 0..1, NaN is 0.
    #[inline(always)]
    pub(crate) fn code(&self, linear: f32) -> u8 {
        // Rounded from half a step below: the step that holds the value, or at its lower end the one before.
        let step = nearest(linear * Self::STEPS as f32 - 0.5, Self::STEPS as f32);
        let code = self.start[step as usize % (2 * Self::STEPS)];
        (code + u32::from(linear >= self.above[code as usize % 256])) as u8
    }
}
