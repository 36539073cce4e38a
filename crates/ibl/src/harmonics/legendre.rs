//! Normalised associated Legendre functions, several arguments at a time.

use std::f64::consts::PI;

/// How many arguments go together: enough for the widest vector registers.
pub(super) const LANES: usize = 8;

/// One number for each of the arguments that go together.
pub(super) type Lanes = [f64; LANES];

/// P_lm for one order m and rising degree l, with the integral over the sphere of (P_lm(cos theta) exp(i m phi))^2 = 1
/// and no alternating sign.
///
/// P_mm = sqrt((2m + 1)!! / (4 pi (2m)!!)) sin^m, and
/// P_lm = sqrt((4 l^2 - 1) / (l^2 - m^2)) (cos P_(l-1)m - sqrt(((l-1)^2 - m^2) / (4 (l-1)^2 - 1)) P_(l-2)m)
/// (Holmes and Featherstone 2002, "A Unified Approach to the Clenshaw Summation and the Recursive Computation of Very High
/// Degree and Order Normalised Associated Legendre Functions").
pub(super) struct Order {
    m: usize,
    start: f64,
    /// For degree m + 1 and up: factor of cos P_(l-1)m, and of P_(l-2)m.
    factors: Vec<(f64, f64)>,
}

impl Order {
    /// Order `m`, for degrees up to `band`.
    pub(super) fn new(m: usize, band: usize) -> Order {
        let start = (1..=m).map(|k| (2 * k + 1) as f64 / (2 * k) as f64).product::<f64>() / (4.0 * PI);
        let m2 = (m * m) as f64;
        let factors = (m + 1..=band)
            .map(|l| {
                let (l2, before2) = ((l * l) as f64, ((l - 1) * (l - 1)) as f64);
                let a = ((4.0 * l2 - 1.0) / (l2 - m2)).sqrt();
                (a, a * ((before2 - m2) / (4.0 * before2 - 1.0)).max(0.0).sqrt())
            })
            .collect();
        Order { m, start: start.sqrt(), factors }
    }

    /// Calls `each(l - m, P_lm)` for l = m ..= band. Returns at once where sin^m is below 1e-280: there all degrees that
    /// this crate uses (up to about a thousand) are below 1e-100.
    #[inline(always)]
    pub(super) fn each(&self, cos: &Lanes, sin: &Lanes, mut each: impl FnMut(usize, &Lanes)) {
        let power = sin.map(|s| {
            let power = s.powi(self.m as i32);
            // Denormal numbers would be slow.
            if power < 1e-280 { 0.0 } else { power }
        });
        if power.iter().all(|&p| p == 0.0) {
            return;
        }
        let mut before = [0.0; LANES];
        let mut p = power.map(|x| x * self.start);
        each(0, &p);
        for (k, &(a, b)) in self.factors.iter().enumerate() {
            let mut next = [0.0; LANES];
            for i in 0..LANES {
                next[i] = a * cos[i] * p[i] - b * before[i];
            }
            (p, before) = (next, p);
            each(k + 1, &p);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harmonics::gauss_legendre;

    #[test]
    fn functions_are_orthonormal() {
        let band = 40;
        let nodes = gauss_legendre(48);
        for m in [0, 1, 2, 7, 39] {
            let order = Order::new(m, band);
            let count = band - m + 1;
            let mut gram = vec![0.0; count * count];
            for &(x, w) in &nodes {
                let mut p = vec![0.0; count];
                order.each(&[x; LANES], &[(1.0 - x * x).sqrt(); LANES], |k, lanes| p[k] = lanes[0]);
                for i in 0..count {
                    for j in 0..count {
                        gram[i * count + j] += 2.0 * PI * w * p[i] * p[j];
                    }
                }
            }
            for i in 0..count {
                for j in 0..count {
                    let exact = if i == j { 1.0 } else { 0.0 };
                    assert!((gram[i * count + j] - exact).abs() < 1e-11, "m {m}, {i}, {j}: {}", gram[i * count + j]);
                }
            }
        }
    }
}
