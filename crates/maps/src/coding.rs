//! 8-bit sRGB by tables, and rounding to codes. The transfer function itself is in [`crate::color`].

use std::sync::LazyLock;

use crate::color::linear_from_srgb;

/// The nearest 8-bit code of 0..1; clamped, NaN is 0.
#[inline(always)]
pub(crate) fn code_u8(x: f32) -> u8 {
    (x * 255.0 + 0.5) as u8
}

/// The nearest 16-bit code of 0..1; clamped, NaN is 0.
#[inline(always)]
pub(crate) fn code_u16(x: f32) -> u16 {
    (x * 65535.0 + 0.5) as u16
}

/// 8-bit sRGB by table, exact in both directions.
pub(crate) struct Srgb8 {
    /// Linear value of each code.
    pub(crate) linear: [f32; 256],
    /// Linear value from which on each code is the nearest.
    /// The last is past all.
    threshold: [f32; 257],
    /// Code at the lower end of each 4096th of the linear range. Two thresholds are never so near to each other (255 x
    /// 12.92 is less than 4096), so that the code is this one or the next.
    start: [u8; Self::STEPS + 1],
}

static SRGB8: LazyLock<Srgb8> = LazyLock::new(|| {
    let linear_of = |s: f64| linear_from_srgb([s; 3])[0] as f32;
    let linear = std::array::from_fn(|code| linear_of(code as f64 / 255.0));
    let threshold = std::array::from_fn(|code| match code {
        0 => f32::NEG_INFINITY,
        256 => f32::INFINITY,
        code => linear_of((code as f64 - 0.5) / 255.0),
    });
    let start = std::array::from_fn(|step| {
        let low = step as f32 / Srgb8::STEPS as f32;
        threshold.iter().filter(|&&t: &&f32| t <= low).count().saturating_sub(1) as u8
    });
    Srgb8 { linear, threshold, start }
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
        let code = self.start[((linear * Self::STEPS as f32) as usize).min(Self::STEPS)];
        code + u8::from(linear >= self.threshold[usize::from(code) + 1])
    }
}
