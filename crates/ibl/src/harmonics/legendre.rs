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

    /// Calls `two((l - m) / 2, P_lm, P_(l+1)m)` for every second l from m to the band; at its end the second may be 0.
    ///
    /// Returns at once where the functions are too small to matter: close to the poles, where m > l sin theta, they fall
    /// like Airy's function over a width of cbrt(m) (Schaeffer 2013, "Efficient spherical harmonic transforms aimed at
    /// pseudospectral numerical simulations", polar optimisation), and where sin^m is below 1e-280.
    #[inline(always)]
    pub(super) fn each_two(&self, cos: &Lanes, sin: &Lanes, mut two: impl FnMut(usize, &Lanes, &Lanes)) {
        let band = (self.m + self.factors.len()) as f64;
        let widest = sin.iter().fold(0.0f64, |a, &b| a.max(b));
        if self.m as f64 > band * widest + 10.0 + 8.0 * band.cbrt() {
            return;
        }
        let power = sin.map(|s| {
            let power = s.powi(self.m as i32);
            // Denormal numbers would be slow.
            if power < 1e-280 { 0.0 } else { power }
        });
        if power.iter().all(|&p| p == 0.0) {
            return;
        }
        let mut odd = [0.0; LANES];
        let mut even = power.map(|x| x * self.start);
        let mut k = 0;
        let steps = self.factors.chunks_exact(2);
        let last = steps.remainder();
        for pair in steps {
            odd = step(pair[0], cos, &even, &odd);
            two(k, &even, &odd);
            even = step(pair[1], cos, &odd, &even);
            k += 1;
        }
        odd = if let [factors] = last { step(*factors, cos, &even, &odd) } else { [0.0; LANES] };
        two(k, &even, &odd);
    }
}

/// The function of the next degree from the two before it.
#[inline(always)]
fn step((a, b): (f64, f64), cos: &Lanes, p: &Lanes, before: &Lanes) -> Lanes {
    let mut next = [0.0; LANES];
    for i in 0..LANES {
        next[i] = a * cos[i] * p[i] - b * before[i];
    }
    next
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
                order.each_two(&[x; LANES], &[(1.0 - x * x).sqrt(); LANES], |k, even, odd| {
                    p[2 * k] = even[0];
                    if let Some(p) = p.get_mut(2 * k + 1) {
                        *p = odd[0];
                    }
                });
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
