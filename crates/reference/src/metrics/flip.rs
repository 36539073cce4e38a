//! FLIP: how different two pictures look when they are shown in turns, 0 to 1 for each pixel.
//!
//! Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
//! Images" (display values), and Andersson, Nilsson, Shirley, Akenine-Moller 2021, "Visualizing Errors in Rendered High
//! Dynamic Range Images" (radiance: the largest error over the exposures at which the picture shows anything). Written
//! from the papers' equations.

use rayon::prelude::*;

mod color;

use color::{Opponent, lab_from_rgb, opponent_from_rgb, rgb_from_opponent};

use crate::random::Random;

/// Pixels per degree of sight on a display of 3840 pixels and 0.7 m, seen from 0.7 m.
pub const FLIP_PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * std::f64::consts::PI / 180.0;

/// Exponent of the colour difference.
const COLOR_EXPONENT: f64 = 0.7;
/// Differences below this share of the largest one ...
const COMPRESSED_FROM: f64 = 0.4;
/// ... take up this share of the scale.
const COMPRESSED_TO: f64 = 0.95;
/// Exponent of the feature difference.
const FEATURE_EXPONENT: f64 = 0.5;
/// Width of a feature in degrees.
const FEATURE_WIDTH: f64 = 0.082;
/// Spread b of the widest contrast sensitivity filter.
const WIDEST: f64 = 0.04;
/// Gaussians (a, b) of each opponent channel's contrast sensitivity.
const SENSITIVITY: [&[(f64, f64)]; 3] = [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];
/// The tone curve that exposures are chosen for and shown with: (a x^2 + b x + c) / (d x^2 + e x + f), Narkowicz's fit of
/// ACES with its pre-exposure of 0.6.
const TONE: [f64; 6] = [0.36 * 2.51, 0.6 * 0.03, 0.0, 0.36 * 2.43, 0.6 * 0.59, 0.14];
/// The display value that the brightest and the median pixel are brought to.
const TONE_TARGET: f64 = 0.85;

/// How pictures are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipOptions {
    /// Pixels per degree of sight.
    pub pixels_per_degree: f64,
}

impl Default for FlipOptions {
    fn default() -> Self {
        FlipOptions { pixels_per_degree: FLIP_PIXELS_PER_DEGREE }
    }
}

/// FLIP of two pictures of display values, decoded to linear light in 0..1 (held). One error for each pixel, row by row;
/// the pictures have `width` pixels a row and are of the same size.
pub fn flip_ldr(reference: &[[f64; 3]], test: &[[f64; 3]], width: usize, options: FlipOptions) -> Vec<f64> {
    let pixels = reference.len().min(test.len());
    if width == 0 || pixels == 0 {
        return Vec::new();
    }
    let height = pixels / width;
    let held = |picture: &[[f64; 3]]| -> Vec<[f64; 3]> {
        let finite = |x: f64| if x > 0.0 { x.min(1.0) } else { 0.0 };
        picture[..width * height].iter().map(|pixel| pixel.map(finite)).collect()
    };
    let kernels = Kernels::new(options.pixels_per_degree.max(1e-3));
    let [a, b] = [reference, test].map(|picture| seen(&held(picture), width, &kernels));
    let most = largest_color_difference();
    (0..width * height)
        .into_par_iter()
        .map(|i| {
            let color = spread(hyab(a.color[i], b.color[i]).powf(COLOR_EXPONENT), most);
            let edge = (a.edge[i] - b.edge[i]).abs();
            let point = (a.point[i] - b.point[i]).abs();
            let feature = (edge.max(point) * std::f64::consts::FRAC_1_SQRT_2).powf(FEATURE_EXPONENT);
            color.powf(1.0 - feature.min(1.0))
        })
        .collect()
}

/// FLIP of two pictures of linear radiance: the largest of the errors at exposures from where the reference's brightest
/// pixel is just shown to where its median is, one stop apart at most. A black reference is looked at as it is, and so are
/// negative numbers: as black. The authors' program (v1.4) puts them through the tone curve, whose squares make large ones white, and
/// takes them into the median.
pub fn flip_hdr(reference: &[[f64; 3]], test: &[[f64; 3]], width: usize, options: FlipOptions) -> Vec<f64> {
    let mut largest = vec![0.0_f64; reference.len().min(test.len())];
    for stops in exposures(reference) {
        let factor = stops.exp2();
        let shown = |picture: &[[f64; 3]]| -> Vec<[f64; 3]> {
            picture.par_iter().map(|pixel| pixel.map(|x| toned(x * factor))).collect()
        };
        let errors = flip_ldr(&shown(reference), &shown(test), width, options);
        largest.iter_mut().zip(errors).for_each(|(most, error)| *most = most.max(error));
    }
    largest
}

/// [`flip_ldr`] or [`flip_hdr`].
pub type Flip = fn(&[[f64; 3]], &[[f64; 3]], usize, FlipOptions) -> Vec<f64>;

/// A picture whose noise is known.
#[derive(Clone, Copy, Debug)]
pub struct Noisy<'a> {
    /// The picture.
    pub pixels: &'a [[f64; 3]],
    /// Standard error of each channel of each pixel; pixels beyond its end are exact.
    pub standard_error: &'a [[f64; 3]],
}

/// What FLIP says of two pictures when nothing but their noise differs: each pixel's difference is taken out, and one drawn
/// from a normal distribution of its standard error put in its place. Of pictures whose mean FLIP is no larger than the
/// mean of this, noise may be all. A path brings its noise to all channels alike, so one number is drawn for the three of a pixel;
/// pixels are independent. The same for the same pictures; pixels without a standard error do not differ.
///
/// What takes the place of the pictures a and b of standard errors s and t, s^2 + t^2 = D^2, is m + s^2 / D x and m - t^2 / D x, with x normal
/// and m = (t^2 a + s^2 b) / D^2, the likeliest of what both show. It has the noise of a, the noise of b, and none in common, where noise
/// that is added to b alone would stand on what b has already, and draw edges that neither has.
pub fn flip_of_noise(
    flip: Flip,
    test: Noisy<'_>,
    reference: Noisy<'_>,
    width: usize,
    options: FlipOptions,
) -> Vec<f64> {
    let error = |picture: &Noisy<'_>, pixel: usize| picture.standard_error.get(pixel).copied().unwrap_or_default();
    let noisy = |(pixel, (a, b)): (usize, (&[f64; 3], &[f64; 3]))| -> ([f64; 3], [f64; 3]) {
        let (s, t) = (error(&test, pixel), error(&reference, pixel));
        // Box and Muller 1958, "A Note on the Generation of Random Normal Deviates"; 1 - u is never 0.
        let [u, v] = Random::new(0, pixel as u64, 0).pair();
        let normal = (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos();
        let mut drawn = (*b, *b);
        for c in 0..3 {
            let both = s[c].hypot(t[c]);
            if both > 0.0 {
                let (of_test, of_reference) = ((s[c] / both).powi(2), (t[c] / both).powi(2));
                let middle = of_reference * a[c] + of_test * b[c];
                drawn.0[c] = middle + of_test * both * normal;
                drawn.1[c] = middle - of_reference * both * normal;
            }
        }
        drawn
    };
    let pairs = test.pixels.iter().zip(reference.pixels).enumerate();
    let (drawn_test, drawn_reference): (Vec<_>, Vec<_>) = pairs.map(noisy).unzip();
    flip(&drawn_reference, &drawn_test, width, options)
}

/// The stops at which a picture of radiance is looked at.
fn exposures(reference: &[[f64; 3]]) -> Vec<f64> {
    let [a, b, c, d, e, f] = TONE;
    let (k0, k1, k2) = (a - TONE_TARGET * d, b - TONE_TARGET * e, c - TONE_TARGET * f);
    let half = -0.5 * k1 / k0;
    let bright = half + (half * half - k2 / k0).sqrt();
    let mut luminance: Vec<f64> =
        reference.iter().map(|p| color::luminance(p.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 }))).collect();
    luminance.sort_by(f64::total_cmp);
    let largest = luminance.last().copied().unwrap_or(0.0);
    if largest <= 0.0 {
        return vec![0.0];
    }
    let n = luminance.len();
    let median = if n % 2 == 1 { luminance[n / 2] } else { 0.5 * (luminance[n / 2 - 1] + luminance[n / 2]) };
    // A picture that is black for more than a half has its median among what is lit.
    let median = median.max(largest * (-24.0_f64).exp2());
    let (start, stop) = ((bright / largest).log2(), (bright / median).log2());
    let steps = ((stop - start).ceil() as usize).max(2);
    (0..steps).map(|i| start + (stop - start) * i as f64 / (steps - 1) as f64).collect()
}

fn toned(x: f64) -> f64 {
    let [a, b, c, d, e, f] = TONE;
    let x = if x > 0.0 { x.min(1e30) } else { 0.0 };
    ((a * x * x + b * x + c) / (d * x * x + e * x + f)).clamp(0.0, 1.0)
}

/// A picture as it is seen.
struct Seen {
    /// Filtered by contrast sensitivity, in Lab with Hunt's adjustment.
    color: Vec<[f64; 3]>,
    /// Strength of edges and points of the lightness.
    edge: Vec<f64>,
    point: Vec<f64>,
}

fn seen(picture: &[[f64; 3]], width: usize, kernels: &Kernels) -> Seen {
    let opponent: Vec<Opponent> = picture.par_iter().map(|&pixel| opponent_from_rgb(pixel)).collect();
    let channel = |c: usize| -> Vec<f64> { opponent.iter().map(|pixel| pixel[c]).collect() };
    let filtered: [Vec<f64>; 3] = std::array::from_fn(|c| {
        let plane = channel(c);
        let mut sum = vec![0.0; plane.len()];
        for (weight, kernel) in &kernels.sensitivity[c] {
            let part = convolved(&plane, width, kernel, kernel);
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += weight * part);
        }
        sum
    });
    let color = (0..picture.len())
        .into_par_iter()
        .map(|i| {
            let rgb = rgb_from_opponent([filtered[0][i], filtered[1][i], filtered[2][i]]);
            hunt(lab_from_rgb(rgb.map(|x| x.clamp(0.0, 1.0))))
        })
        .collect();
    let lightness: Vec<f64> = opponent.iter().map(|pixel| (pixel[0] + 16.0) / 116.0).collect();
    let strength = |kernel: &[f64]| -> Vec<f64> {
        let across = convolved(&lightness, width, kernel, &kernels.smooth);
        let down = convolved(&lightness, width, &kernels.smooth, kernel);
        across.into_iter().zip(down).map(|(x, y)| x.hypot(y)).collect()
    };
    Seen { color, edge: strength(&kernels.edge), point: strength(&kernels.point) }
}

/// One-dimensional kernels; each sums to 1, or its positive part to 1 and its negative part to -1.
struct Kernels {
    /// Of each opponent channel: weight and kernel of each Gaussian.
    sensitivity: [Vec<(f64, Vec<f64>)>; 3],
    smooth: Vec<f64>,
    edge: Vec<f64>,
    point: Vec<f64>,
}

impl Kernels {
    fn new(pixels_per_degree: f64) -> Kernels {
        use std::f64::consts::PI;
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i64;
        let sensitivity = SENSITIVITY.map(|gaussians| {
            let parts: Vec<(f64, Vec<f64>)> = gaussians
                .iter()
                .map(|&(a, b)| {
                    let at = |x: f64| (-PI * PI * (x / pixels_per_degree).powi(2) / b).exp();
                    let kernel = sampled(radius, at);
                    let sum: f64 = kernel.iter().sum();
                    // What the Gaussian weighs over the square of the kernel.
                    (a * (PI / b).sqrt() * sum * sum, kernel.iter().map(|x| x / sum).collect())
                })
                .collect();
            let total: f64 = parts.iter().map(|(weight, _)| weight).sum();
            parts.into_iter().map(|(weight, kernel)| (weight / total, kernel)).collect()
        });
        let sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sigma).ceil() as i64;
        let gauss = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
        let smooth = sampled(radius, gauss);
        let sum: f64 = smooth.iter().sum();
        Kernels {
            sensitivity,
            smooth: smooth.into_iter().map(|x| x / sum).collect(),
            edge: balanced(sampled(radius, |x| -x * gauss(x))),
            point: balanced(sampled(radius, |x| (x * x / (sigma * sigma) - 1.0) * gauss(x))),
        }
    }
}

fn sampled(radius: i64, at: impl Fn(f64) -> f64) -> Vec<f64> {
    (-radius..=radius).map(|x| at(x as f64)).collect()
}

/// The kernel with its positive and its negative part each scaled to a sum of 1.
fn balanced(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|x| **x > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|x| **x < 0.0).sum::<f64>();
    let by = |x: f64, sum: f64| if sum > 0.0 { x / sum } else { 0.0 };
    kernel.into_iter().map(|x| if x > 0.0 { by(x, positive) } else { by(x, negative) }).collect()
}

/// A plane weighted along rows and then along columns; what lies outside is the nearest pixel.
fn convolved(plane: &[f64], width: usize, across: &[f64], down: &[f64]) -> Vec<f64> {
    let height = plane.len() / width;
    let middle = (across.len() / 2) as isize;
    let inside = |i: isize, n: usize| i.clamp(0, n as isize - 1) as usize;
    let mut rows = vec![0.0; plane.len()];
    rows.par_chunks_mut(width).zip(plane.par_chunks(width)).for_each(|(out, line)| {
        for (x, out) in out.iter_mut().enumerate() {
            *out = across
                .iter()
                .enumerate()
                .map(|(k, weight)| weight * line[inside(x as isize + k as isize - middle, width)])
                .sum();
        }
    });
    let middle = (down.len() / 2) as isize;
    let mut result = vec![0.0; plane.len()];
    result.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (k, weight) in down.iter().enumerate() {
            let row = inside(y as isize + k as isize - middle, height);
            out.iter_mut().zip(&rows[row * width..]).for_each(|(out, x)| *out += weight * x);
        }
    });
    result
}

/// Hunt's effect: colours look paler where it is dark.
fn hunt([lightness, a, b]: [f64; 3]) -> [f64; 3] {
    [lightness, 0.01 * lightness * a, 0.01 * lightness * b]
}

/// Abasi, Amani Tehran, Fairchild 2020, "Distance metrics for very large color differences".
fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// The difference of green and blue, which is the largest.
fn largest_color_difference() -> f64 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt(lab_from_rgb(rgb)));
    hyab(green, blue).powf(COLOR_EXPONENT)
}

/// Brings a difference into 0..1, the large ones close together.
fn spread(difference: f64, most: f64) -> f64 {
    let knee = COMPRESSED_FROM * most;
    if difference < knee {
        COMPRESSED_TO / knee * difference
    } else {
        (COMPRESSED_TO + (difference - knee) / (most - knee) * (1.0 - COMPRESSED_TO)).min(1.0)
    }
}

#[cfg(test)]
mod tests;
