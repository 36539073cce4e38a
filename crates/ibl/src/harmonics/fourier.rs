//! Fast Fourier transform of a power-of-two length, in f64.

use std::f64::consts::PI;

/// A complex number: real and imaginary part.
pub(super) type Complex = [f64; 2];

/// A transform of one length, with its table of twiddle factors.
pub(super) struct Fourier {
    /// exp(-2 pi i k / n) for k < n / 2.
    twiddles: Vec<Complex>,
    n: usize,
}

impl Fourier {
    /// For sequences of `n` numbers; `n` is a power of two.
    pub(super) fn new(n: usize) -> Fourier {
        debug_assert!(n.is_power_of_two());
        let twiddles = (0..n / 2)
            .map(|k| {
                let (sin, cos) = (2.0 * PI * k as f64 / n as f64).sin_cos();
                [cos, -sin]
            })
            .collect();
        Fourier { twiddles, n }
    }

    /// X_k = sum over j of x_j exp(-2 pi i j k / n), in place (Cooley and Tukey 1965).
    pub(super) fn forward(&self, x: &mut [Complex]) {
        let n = self.n;
        if n < 2 {
            return;
        }
        let shift = usize::BITS - n.trailing_zeros();
        for i in 0..n {
            let j = i.reverse_bits() >> shift;
            if i < j {
                x.swap(i, j);
            }
        }
        let mut half = 1;
        while half < n {
            let stride = n / (2 * half);
            for block in x.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                for (k, (a, b)) in low.iter_mut().zip(high).enumerate() {
                    let [c, s] = self.twiddles[k * stride];
                    let turned = [b[0] * c - b[1] * s, b[0] * s + b[1] * c];
                    *b = [a[0] - turned[0], a[1] - turned[1]];
                    *a = [a[0] + turned[0], a[1] + turned[1]];
                }
            }
            half *= 2;
        }
    }

    /// x_j = sum over k of X_k exp(+2 pi i j k / n), in place: the inverse without its factor 1 / n.
    pub(super) fn backward(&self, x: &mut [Complex]) {
        self.forward(x);
        if self.n > 1 {
            x[1..].reverse();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_sum_and_goes_back() {
        for n in [1usize, 2, 8, 64] {
            let x: Vec<Complex> = (0..n).map(|i| [(i as f64 * 0.7).sin() + 0.2, (i * i % 5) as f64 - 1.3]).collect();
            let fourier = Fourier::new(n);
            let mut y = x.clone();
            fourier.forward(&mut y);
            for (k, value) in y.iter().enumerate() {
                let mut sum = [0.0; 2];
                for (j, [re, im]) in x.iter().enumerate() {
                    let (s, c) = (-2.0 * PI * (j * k) as f64 / n as f64).sin_cos();
                    sum[0] += re * c - im * s;
                    sum[1] += re * s + im * c;
                }
                assert!((sum[0] - value[0]).abs() + (sum[1] - value[1]).abs() < 1e-10 * n as f64);
            }
            fourier.backward(&mut y);
            for (a, b) in x.iter().zip(&y) {
                assert!((a[0] - b[0] / n as f64).abs() + (a[1] - b[1] / n as f64).abs() < 1e-12);
            }
        }
    }
}
