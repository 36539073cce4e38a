//! What a picture from outside may contain that light cannot be, and what is made of it.

/// The largest half-precision number: baked environments are stored as rgba16f.
pub const MAX_RADIANCE: f32 = 65504.0;

/// How many colour components of a loaded environment were changed, and why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Not a number: became 0.
    pub not_a_number: u64,
    /// Infinite: became [`MAX_RADIANCE`], or 0 where it was minus infinity.
    pub infinite: u64,
    /// Below 0, and finite: became 0.
    pub negative: u64,
    /// Above [`MAX_RADIANCE`], and finite: became [`MAX_RADIANCE`].
    pub too_bright: u64,
}

impl Repairs {
    /// Whether nothing was changed.
    pub fn is_none(&self) -> bool {
        *self == Repairs::default()
    }
}

impl std::ops::AddAssign for Repairs {
    fn add_assign(&mut self, other: Repairs) {
        self.not_a_number += other.not_a_number;
        self.infinite += other.infinite;
        self.negative += other.negative;
        self.too_bright += other.too_bright;
    }
}

impl std::fmt::Display for Repairs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.is_none() {
            return write!(f, "no value needed repair");
        }
        let parts = [
            (self.not_a_number, "not a number (now 0)"),
            (self.infinite, "infinite (now 65504, or 0 where negative)"),
            (self.negative, "negative (now 0)"),
            (self.too_bright, "above 65504 (now 65504)"),
        ];
        let parts: Vec<_> = parts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
        write!(f, "values repaired: {}", parts.join(", "))
    }
}

/// Makes every component finite and within 0..=[`MAX_RADIANCE`]; says what was changed.
pub fn repair(pixels: &mut [[f32; 3]]) -> Repairs {
    let mut repairs = Repairs::default();
    for x in pixels.iter_mut().flatten() {
        if x.is_nan() {
            repairs.not_a_number += 1;
            *x = 0.0;
        } else if x.is_infinite() {
            repairs.infinite += 1;
            *x = if *x > 0.0 { MAX_RADIANCE } else { 0.0 };
        } else if *x < 0.0 {
            repairs.negative += 1;
            *x = 0.0;
        } else if *x > MAX_RADIANCE {
            repairs.too_bright += 1;
            *x = MAX_RADIANCE;
        }
    }
    repairs
}
