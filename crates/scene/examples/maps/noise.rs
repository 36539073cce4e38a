//! What the patterns are made of; all repeat on the unit square. Only + - * / and sqrt: the same on every machine.

/// To -0.5..0.5.
pub(super) fn wrapped(x: f64) -> f64 {
    x - (x + 0.5).floor()
}

pub(super) fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

pub(super) fn blend(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    std::array::from_fn(|i| mix(a[i], b[i], t.clamp(0.0, 1.0)))
}

/// From 0 at `low` to 1 at `high`, which may be the smaller one.
pub(super) fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Value noise with `cells` lattice points along the tile, 0 to 1.
pub(super) fn noise([u, v]: [f64; 2], cells: u32, salt: u32) -> f64 {
    let split = |t: f64| {
        let t = (t - t.floor()) * f64::from(cells);
        (t as u32 % cells, smooth(0.0, 1.0, t.fract()))
    };
    let ((x, fx), (y, fy)) = (split(u), split(v));
    let value = |dx: u32, dy: u32| f64::from(hash((x + dx) % cells, (y + dy) % cells, salt)) / f64::from(u32::MAX);
    mix(mix(value(0, 0), value(1, 0), fx), mix(value(0, 1), value(1, 1), fx), fy)
}

/// Octaves of value noise, 0 to 1.
pub(super) fn fractal(place: [f64; 2], cells: u32, octaves: u32, salt: u32) -> f64 {
    let mut sum = 0.0;
    let mut weights = 0.0;
    let mut weight = 1.0;
    for octave in 0..octaves {
        sum += weight * noise(place, cells << octave, salt + 100 * octave);
        weights += weight;
        weight *= 0.5;
    }
    sum / weights
}

/// A random number for a lattice point: multiplications and shifts in the manner of Jarzynski and Olano 2020, "Hash
/// Functions for GPU Rendering" (PCG).
pub(super) fn hash(x: u32, y: u32, salt: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9E37_79B9) ^ y.wrapping_mul(0x85EB_CA6B) ^ salt.wrapping_mul(0xC2B2_AE35);
    for _ in 0..2 {
        h = h.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        h = ((h >> ((h >> 28) + 4)) ^ h).wrapping_mul(277_803_737);
        h ^= h >> 22;
    }
    h
}
