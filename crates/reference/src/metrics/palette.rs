//! The colours of error maps.

/// Nine colours of the map magma by Nathaniel Smith and Stefan van der Walt (2015, matplotlib, CC0), at equal steps.
const MAGMA: [[f64; 3]; 9] = [
    [0.0, 0.0, 4.0],
    [29.0, 17.0, 71.0],
    [81.0, 18.0, 124.0],
    [130.0, 38.0, 129.0],
    [182.0, 54.0, 121.0],
    [230.0, 81.0, 100.0],
    [251.0, 136.0, 97.0],
    [254.0, 194.0, 135.0],
    [252.0, 253.0, 191.0],
];

/// The sRGB codes of an error in 0..1 (held): black over purple and orange to pale yellow, ever lighter, mixed linearly
/// between nine colours of magma. NaN is the colour of 0.
pub fn magma(error: f64) -> [u8; 3] {
    let at = if error > 0.0 { error.min(1.0) * (MAGMA.len() - 1) as f64 } else { 0.0 };
    let low = (at as usize).min(MAGMA.len() - 2);
    let part = at - low as f64;
    std::array::from_fn(|i| (MAGMA[low][i] + (MAGMA[low + 1][i] - MAGMA[low][i]) * part).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::magma;

    #[test]
    fn from_black_to_pale_ever_lighter() {
        assert_eq!((magma(0.0), magma(1.0)), ([0, 0, 4], [252, 253, 191]));
        assert_eq!((magma(f64::NAN), magma(-1.0), magma(7.0)), (magma(0.0), magma(0.0), magma(1.0)));
        let light = |i: i32| {
            magma(f64::from(i) / 100.0).map(f64::from).iter().zip([0.21, 0.72, 0.07]).map(|(c, w)| c * w).sum()
        };
        assert!((1..=100).all(|i| {
            let (a, b): (f64, f64) = (light(i - 1), light(i));
            b >= a - 0.5
        }));
    }
}
