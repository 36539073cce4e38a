//! Chi-square tests of every sampler against its density.
//!
//! Bins adapt to the sampler: a pilot set of samples is halved again and again at its median, so that each of the
//! rectangles in z and azimuth has about as many samples, however narrow the lobe. The density is integrated
//! over each bin by a rule that halves a rectangle until two estimates agree. What is drawn outside of all bins, or
//! carries no direction (total internal reflection), is a bin of its own, whose expectation is 1 less all integrals: with it
//! the test fails for a density that is not normalised. The level is 1 % over all tests together (Bonferroni).

use halfvector_brdf::lobe_sampling::{
    diffuse_pdf, diffuse_sample, sheen_pdf, sheen_sample, transmission_pdf, transmission_sample, transmission_thin_pdf,
    transmission_thin_sample,
};
use halfvector_brdf::lobe_transmission::Transmission;
use halfvector_brdf::sampling::{pdf_solid_angle_ggx_vndf, sample_ggx_vndf};
use halfvector_brdf::sampling_bounded::{
    pdf_half_vector_ggx_vndf_anisotropic, pdf_solid_angle_ggx_bounded, pdf_solid_angle_ggx_vndf_anisotropic, reflected,
    sample_ggx_bounded, sample_ggx_vndf_anisotropic,
};
use halfvector_brdf::vector::{add, cross, dot, scale};

const PILOT: usize = 1 << 12;
const SAMPLES: usize = 1 << 17;
/// Halvings: 2^7 bins.
const DEPTH: usize = 7;
/// Number of (sampler, parameters) pairs: the tests below count them.
const TESTS: f64 = 150.0;

/// Steele, Lea, Flood 2014 (SplitMix64), in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn pair(&mut self) -> [f64; 2] {
        [self.next(), self.next()]
    }
}

/// z and azimuth from the mirror direction's, so that no lobe lies across the rectangle's seam.
fn place(dir: [f64; 3]) -> [f64; 2] {
    [dir[2].clamp(-1.0, 1.0), (-dir[1]).atan2(-dir[0])]
}

fn direction([z, phi]: [f64; 2]) -> [f64; 3] {
    let r = (1.0 - z * z).max(0.0).sqrt();
    [-r * phi.cos(), -r * phi.sin(), z]
}

#[derive(Clone, Copy)]
struct Bin {
    low: [f64; 2],
    high: [f64; 2],
}

/// A leaf is no larger than its points: a lobe may end at its edge.
fn split(mut points: Vec<[f64; 2]>, depth: usize, bins: &mut Vec<Bin>) {
    if depth == 0 || points.len() < 8 {
        let ends = |axis: usize| {
            points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], p| [l.min(p[axis]), h.max(p[axis])])
        };
        let [z, phi] = [ends(0), ends(1)];
        return bins.push(Bin { low: [z[0], phi[0]], high: [z[1], phi[1]] });
    }
    let axis = depth % 2;
    points.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
    let rest = points.split_off(points.len() / 2);
    split(points, depth - 1, bins);
    split(rest, depth - 1, bins);
}

/// Gauss's five points on [0, 1].
const RULE: [[f64; 2]; 5] = [
    [0.046_910_077_030_668, 0.118_463_442_528_095],
    [0.230_765_344_947_158, 0.239_314_335_249_683],
    [0.5, 0.284_444_444_444_444],
    [0.769_234_655_052_842, 0.239_314_335_249_683],
    [0.953_089_922_969_332, 0.118_463_442_528_095],
];

fn once(bin: Bin, pdf: &dyn Fn([f64; 3]) -> f64) -> f64 {
    let size = [bin.high[0] - bin.low[0], bin.high[1] - bin.low[1]];
    let mut sum = 0.0;
    for [x, wx] in RULE {
        for [y, wy] in RULE {
            sum += wx * wy * pdf(direction([bin.low[0] + size[0] * x, bin.low[1] + size[1] * y]));
        }
    }
    sum * size[0] * size[1]
}

fn integral(bin: Bin, whole: f64, pdf: &dyn Fn([f64; 3]) -> f64, depth: usize) -> f64 {
    let middle = [0.5 * (bin.low[0] + bin.high[0]), 0.5 * (bin.low[1] + bin.high[1])];
    let parts: [(Bin, f64); 4] = std::array::from_fn(|i| {
        let (mut low, mut high) = (bin.low, bin.high);
        for axis in 0..2 {
            if i >> axis & 1 == 0 { high[axis] = middle[axis] } else { low[axis] = middle[axis] }
        }
        let part = Bin { low, high };
        (part, once(part, pdf))
    });
    let sum: f64 = parts.iter().map(|p| p.1).sum();
    if depth == 0 || depth < 11 && (sum - whole).abs() < 1e-6 + 1e-5 * sum {
        return sum;
    }
    parts.iter().map(|&(part, value)| integral(part, value, pdf, depth - 1)).sum()
}

/// The upper tail of the chi-square distribution with k degrees of freedom: the regularised incomplete gamma function
/// Q(k/2, x/2), by its series or its continued fraction. Press et al. 2007, Numerical Recipes, section 6.2.
fn chi_square_tail(x: f64, k: f64) -> f64 {
    let (a, x) = (k / 2.0, x / 2.0);
    let front = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for n in 1..1000 {
            term *= x / (a + f64::from(n));
            sum += term;
        }
        1.0 - front * sum
    } else {
        let (mut b, mut c) = (x + 1.0 - a, 1e300);
        let mut d = 1.0 / b;
        let mut h = d;
        for i in 1..1000 {
            let i = f64::from(i);
            let an = -i * (i - a);
            b += 2.0;
            d = 1.0 / (an * d + b);
            c = b + an / c;
            h *= d * c;
        }
        front * h
    }
}

/// Lanczos 1964.
fn ln_gamma(x: f64) -> f64 {
    const C: [f64; 6] = [
        76.180_091_729_471_46,
        -86.505_320_329_416_77,
        24.014_098_240_830_91,
        -1.231_739_572_450_155,
        1.208_650_973_866_179e-3,
        -5.395_239_384_953e-6,
    ];
    let t = x + 5.5;
    let series = C.iter().enumerate().fold(1.000_000_000_190_015, |sum, (i, c)| sum + c / (x + 1.0 + i as f64));
    (2.506_628_274_631_000_5 * series / x).ln() - (t - (x + 0.5) * t.ln())
}

/// Tests one sampler; gives the part of the samples that have no direction. `sample` returns the zero vector for no direction.
fn chi_square(name: &str, sample: &dyn Fn([f64; 2]) -> [f64; 3], pdf: &dyn Fn([f64; 3]) -> f64) -> f64 {
    let seed = name.bytes().fold(7_u64, |s, b| s.wrapping_mul(0x100_0000_01b3) ^ u64::from(b));
    let mut random = Random(seed);
    let drawn = |random: &mut Random| Some(sample(random.pair())).filter(|d| dot(*d, *d) > 0.5).map(place);
    let pilot: Vec<_> = (0..PILOT).filter_map(|_| drawn(&mut random)).collect();
    let mut bins = Vec::new();
    split(pilot, DEPTH, &mut bins);
    let mut expected: Vec<f64> = bins.iter().map(|b| integral(*b, once(*b, pdf), pdf, 12)).collect();
    let total: f64 = expected.iter().sum();
    assert!(total < 1.0 + 2e-3, "{name}: the density integrates to {total}");
    let mut found = vec![0.0; bins.len() + 1];
    let mut lost = 0.0;
    for _ in 0..SAMPLES {
        let place = drawn(&mut random);
        lost += if place.is_none() { 1.0 / SAMPLES as f64 } else { 0.0 };
        let holds = |p: [f64; 2], b: &Bin| (0..2).all(|i| p[i] >= b.low[i] && p[i] < b.high[i]);
        let bin = place.and_then(|p| bins.iter().position(|b| holds(p, b)));
        found[bin.unwrap_or(bins.len())] += 1.0;
    }
    expected.push((1.0 - total).max(0.0));
    // Bins with few expected samples are taken together.
    let (mut statistic, mut freedom, mut pool) = (0.0, -1.0, (0.0, 0.0));
    for (found, expected) in found.iter().zip(&expected) {
        let expected = expected * SAMPLES as f64;
        if expected < 8.0 {
            pool = (pool.0 + found, pool.1 + expected);
        } else {
            statistic += (found - expected) * (found - expected) / expected;
            freedom += 1.0;
        }
    }
    if pool.1 >= 1.0 {
        statistic += (pool.0 - pool.1) * (pool.0 - pool.1) / pool.1;
        freedom += 1.0;
    } else {
        assert!(pool.0 < 12.0, "{name}: {} samples where {} are expected", pool.0, pool.1);
    }
    let p = chi_square_tail(statistic, freedom);
    assert!(p > 0.01 / TESTS, "{name}: chi-square {statistic:.1} of {freedom} degrees, p = {p:.1e}");
    lost
}

fn view_at(n_dot_v: f64, azimuth: f64) -> [f64; 3] {
    let s = (1.0 - n_dot_v * n_dot_v).sqrt();
    [s * azimuth.cos(), s * azimuth.sin(), n_dot_v]
}

const VIEWS: [f64; 4] = [0.05, 0.3, 0.7, 1.0];
const WIDTHS: [[f64; 2]; 6] = [[0.01, 0.01], [0.1, 0.1], [0.5, 0.5], [1.0, 1.0], [0.4, 0.05], [0.2, 0.9]];

#[test]
fn the_tail_is_the_distribution_s() {
    // Tables of the distribution: 95 % and 99 % points.
    for (x, k, p) in [(3.841_459, 1.0, 0.05), (18.307_04, 10.0, 0.05), (135.806_7, 100.0, 0.01)] {
        assert!((chi_square_tail(x, k) - p).abs() < 1e-5, "{x} {k}: {}", chi_square_tail(x, k));
    }
}

#[test]
fn a_wrong_density_is_found() {
    let wrong = std::panic::catch_unwind(|| {
        chi_square("wrong", &|u| diffuse_sample([0.0, 0.0, 1.0], u), &|l| {
            0.9 * diffuse_pdf([0.0, 0.0, 1.0], l) + 0.1 * sheen_pdf([0.0, 0.0, 1.0], l)
        })
    });
    assert!(wrong.is_err(), "a tenth of another density is seen");
}

#[test]
fn wide_samplers() {
    let up = [0.0, 0.0, 1.0];
    let lost = chi_square("cosine", &|u| diffuse_sample(up, u), &|l| diffuse_pdf(up, l));
    let lost_sheen = chi_square("hemisphere", &|u| sheen_sample(up, u), &|l| sheen_pdf(up, l));
    assert_eq!((lost, lost_sheen), (0.0, 0.0));
}

#[test]
fn visible_normals() {
    for alpha in [0.01, 0.1, 0.5, 1.0] {
        for n_dot_v in VIEWS {
            let view = view_at(n_dot_v, 0.0);
            let pdf = |l: [f64; 3]| {
                let s = add(view, l);
                let length = dot(s, s).sqrt();
                let h = scale(s, 1.0 / length.max(1e-12));
                let sine = cross([0.0, 0.0, 1.0], h);
                if h[2] > 0.0 { pdf_solid_angle_ggx_vndf(n_dot_v, h[2], dot(sine, sine), alpha) } else { 0.0 }
            };
            let lost = chi_square(
                &format!("vndf {alpha} {n_dot_v}"),
                &|u| reflected(view, sample_ggx_vndf(view, alpha, u)),
                &pdf,
            );
            assert_eq!(lost, 0.0);
        }
    }
}

#[test]
fn visible_normals_of_two_widths() {
    for [t, b] in WIDTHS {
        for n_dot_v in VIEWS {
            let view = view_at(n_dot_v, 0.7);
            let lost = chi_square(
                &format!("normals {t} {b} {n_dot_v}"),
                &|u| sample_ggx_vndf_anisotropic(view, t, b, u),
                &|h| if h[2] > 0.0 { pdf_half_vector_ggx_vndf_anisotropic(view, h, t, b) } else { 0.0 },
            );
            let lost_reflected = chi_square(
                &format!("reflections {t} {b} {n_dot_v}"),
                &|u| reflected(view, sample_ggx_vndf_anisotropic(view, t, b, u)),
                &|l| pdf_solid_angle_ggx_vndf_anisotropic(view, l, t, b),
            );
            assert_eq!((lost, lost_reflected), (0.0, 0.0));
        }
    }
}

/// The bounded sampler above the horizon; less is lost below it than without the bound.
#[test]
fn bounded_visible_normals() {
    let above = |l: [f64; 3]| if l[2] > 0.0 { l } else { [0.0; 3] };
    for [t, b] in WIDTHS {
        for n_dot_v in VIEWS {
            let view = view_at(n_dot_v, 0.7);
            let name = format!("bounded {t} {b} {n_dot_v}");
            let lost = chi_square(&name, &|u| above(sample_ggx_bounded(view, t, b, u)), &|l| {
                if l[2] > 0.0 { pdf_solid_angle_ggx_bounded(view, l, t, b) } else { 0.0 }
            });
            let unbounded = chi_square(
                &format!("cut {t} {b} {n_dot_v}"),
                &|u| above(reflected(view, sample_ggx_vndf_anisotropic(view, t, b, u))),
                &|l| if l[2] > 0.0 { pdf_solid_angle_ggx_vndf_anisotropic(view, l, t, b) } else { 0.0 },
            );
            println!("alphas {t} {b}, n.v {n_dot_v}: {lost:.4} lost below the horizon, {unbounded:.4} unbounded");
            assert!(lost <= unbounded + 5e-3, "{name}: {lost} lost, {unbounded} unbounded");
        }
    }
}

#[test]
fn transmission() {
    for eta in [1.5, 1.0 / 1.5, 1.1] {
        for alpha in [0.05, 0.3, 0.8] {
            for n_dot_v in [0.2, 0.6, 1.0] {
                let view = view_at(n_dot_v, 0.0);
                let p = Transmission { color: [1.0; 3], eta, alpha };
                let lost = chi_square(
                    &format!("refraction {eta} {alpha} {n_dot_v}"),
                    &|u| transmission_sample(view, p, u),
                    &|l| transmission_pdf(view, l, p),
                );
                println!("eta {eta:.3}, alpha {alpha}, n.v {n_dot_v}: {lost:.4} totally reflected");
                assert!(eta < 1.0 || lost == 0.0, "{lost}");
            }
        }
    }
    let view = view_at(0.4, 0.0);
    let below = |l: [f64; 3]| if l[2] < 0.0 { l } else { [0.0; 3] };
    chi_square("thin", &|u| below(transmission_thin_sample(view, 0.3, u)), &|l| {
        if l[2] < 0.0 { transmission_thin_pdf(view, l, 0.3) } else { 0.0 }
    });
}
