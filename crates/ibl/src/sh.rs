//! The light's own spherical harmonics up to degree 3, and diffuse irradiance of them by order and window.
//!
//! What shaders read is made of these: nine coefficients of order 2, not windowed
//! ([`irradiance_sh2`](crate::environment::irradiance_sh2)), for that has the least error of what is offered here. The
//! cosine lobe has nothing of degree 3 (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment
//! Maps", equation 8), so that without a window the third order is the second; with one it is the wider window.

use crate::harmonics::gauss_legendre;
use std::f64::consts::PI;

/// Degrees 0 to 3 have this many harmonics.
pub const RADIANCE_SH: usize = 16;

/// Degree of each harmonic, in their order.
const DEGREE: [usize; RADIANCE_SH] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3];

/// The degrees that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShOrder {
    /// Degrees 0 and 1: four coefficients.
    One,
    /// Degrees 0 to 2: nine.
    Two,
    /// Degrees 0 to 3: sixteen.
    Three,
}

impl ShOrder {
    /// The highest degree.
    fn degree(self) -> usize {
        match self {
            ShOrder::One => 1,
            ShOrder::Two => 2,
            ShOrder::Three => 3,
        }
    }
}

/// What the degrees are multiplied by so that a series that ends rings less, and is softer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShWindow {
    /// 1.
    None,
    /// Hann's: (1 + cos(pi l / (n + 1))) / 2 for degree l of order n (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
    Hann,
}

impl ShWindow {
    /// The factor of a degree in a series of this order; 0 beyond it.
    pub fn factor(self, degree: usize, order: ShOrder) -> f64 {
        match self {
            _ if degree > order.degree() => 0.0,
            ShWindow::None => 1.0,
            ShWindow::Hann => 0.5 + 0.5 * (PI * degree as f64 / (order.degree() + 1) as f64).cos(),
        }
    }
}

/// The cosine lobe's number of a degree, over pi: 1, 2/3, 1/4, 0.
pub fn cosine_factor(degree: usize) -> f64 {
    [1.0, 2.0 / 3.0, 0.25].get(degree).copied().unwrap_or(0.0)
}

/// The orthonormal real harmonics of a unit direction, without alternating signs, as constants times
/// 1; y, z, x; xy, yz, 3z^2 - 1, xz, x^2 - y^2; y (3x^2 - y^2), xyz, y (5z^2 - 1), z (5z^2 - 3), x (5z^2 - 1),
/// z (x^2 - y^2), x (x^2 - 3y^2).
pub fn real_harmonics(dir: [f64; 3]) -> [f64; RADIANCE_SH] {
    let [x, y, z] = dir;
    let polynomials = [
        1.0,
        y,
        z,
        x,
        x * y,
        y * z,
        3.0 * z * z - 1.0,
        x * z,
        x * x - y * y,
        y * (3.0 * x * x - y * y),
        x * y * z,
        y * (5.0 * z * z - 1.0),
        z * (5.0 * z * z - 3.0),
        x * (5.0 * z * z - 1.0),
        z * (x * x - y * y),
        x * (x * x - 3.0 * y * y),
    ];
    let constants = harmonic_constants();
    std::array::from_fn(|k| constants[k] * polynomials[k])
}

/// The constants of [`real_harmonics`].
pub fn harmonic_constants() -> [f64; RADIANCE_SH] {
    let root = |numerator: f64, denominator: f64| (numerator / (denominator * PI)).sqrt();
    let (first, second, third) = (root(3.0, 4.0), root(15.0, 4.0), root(21.0, 32.0));
    [
        root(1.0, 4.0),
        first,
        first,
        first,
        second,
        second,
        root(5.0, 16.0),
        second,
        root(15.0, 16.0),
        root(35.0, 32.0),
        root(105.0, 4.0),
        third,
        root(7.0, 16.0),
        third,
        root(105.0, 16.0),
        root(35.0, 32.0),
    ]
}

/// Diffuse irradiance over pi at a unit normal, from coefficients of [`real_harmonics`] of the light
/// ([`BakedEnvironment::radiance_sh`](crate::BakedEnvironment::radiance_sh)). Never below 0.
pub fn irradiance_from_radiance_sh(
    radiance: &[[f32; 3]; RADIANCE_SH],
    order: ShOrder,
    window: ShWindow,
    normal: [f64; 3],
) -> [f32; 3] {
    let harmonics = real_harmonics(normal);
    let mut sum = [0.0; 3];
    for ((coefficients, harmonic), degree) in radiance.iter().zip(harmonics).zip(DEGREE) {
        let weight = harmonic * cosine_factor(degree) * window.factor(degree, order);
        for (sum, coefficient) in sum.iter_mut().zip(coefficients) {
            *sum += weight * f64::from(*coefficient);
        }
    }
    sum.map(|x| x.max(0.0) as f32)
}

/// Coefficients about +Z of what has these about +Y, with azimuths from +X towards +Z: y and z change places. The products
/// of two harmonics are polynomials of degree 6, which the sum has exactly.
pub(crate) fn about_z(about_y: [f64; RADIANCE_SH]) -> [f64; RADIANCE_SH] {
    const AZIMUTHS: usize = 8;
    let mut turned = [0.0; RADIANCE_SH];
    for (z, weight) in gauss_legendre(4) {
        for k in 0..AZIMUTHS {
            let (sin, cos) = (2.0 * PI * k as f64 / AZIMUTHS as f64).sin_cos();
            let across = (1.0 - z * z).sqrt();
            let (x, y) = (across * cos, across * sin);
            let value: f64 = about_y.iter().zip(real_harmonics([x, z, y])).map(|(c, h)| c * h).sum();
            for (turned, harmonic) in turned.iter_mut().zip(real_harmonics([x, y, z])) {
                *turned += weight * 2.0 * PI / AZIMUTHS as f64 * value * harmonic;
            }
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_are_orthonormal() {
        for k in 0..RADIANCE_SH {
            // Turned there and back a harmonic is itself, and so it is by the sum's own weights.
            let mut one = [0.0; RADIANCE_SH];
            one[k] = 1.0;
            let back = about_z(about_z(one));
            assert!(back.iter().zip(one).all(|(a, b)| (a - b).abs() < 1e-12), "{k}: {back:?}");
        }
        // y becomes z; z (x^2 - y^2) becomes y (x^2 - z^2).
        let mut y = [0.0; RADIANCE_SH];
        y[1] = 1.0;
        assert!((about_z(y)[2] - 1.0).abs() < 1e-12);
        let mut cubic = [0.0; RADIANCE_SH];
        cubic[14] = 1.0;
        let [x, y, z] = [0.48, 0.6, 0.64];
        let value: f64 = about_z(cubic).iter().zip(real_harmonics([x, y, z])).map(|(c, h)| c * h).sum();
        assert!((value - harmonic_constants()[14] * y * (x * x - z * z)).abs() < 1e-12);
    }

    #[test]
    fn windows_begin_at_one_and_end() {
        for window in [ShWindow::None, ShWindow::Hann] {
            for order in [ShOrder::One, ShOrder::Two, ShOrder::Three] {
                assert_eq!(window.factor(0, order), 1.0);
                assert_eq!(window.factor(order.degree() + 1, order), 0.0);
            }
        }
        assert!((ShWindow::Hann.factor(1, ShOrder::Two) - 0.75).abs() < 1e-12);
        assert!((ShWindow::Hann.factor(2, ShOrder::Three) - 0.5).abs() < 1e-12);
    }
}
