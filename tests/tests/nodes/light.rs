//! Colours of light against the CIE 1931 observer: of a temperature by Planck's law, of a wavelength by the table itself.

use super::run::Node;

/// First wavelength of the tables in nm; they go on by 10.
const FIRST: f64 = 380.0;

/// CIE 1931 2 degree observer, x, y and z (CIE 015:2018, table T.4), every 10 nm from 380 to 780 nm.
#[rustfmt::skip]
const OBSERVER: [[f64; 41]; 3] = [
    [
        0.001368, 0.004243, 0.014310, 0.043510, 0.134380, 0.283900, 0.348280, 0.336200, 0.290800, 0.195360,
        0.095640, 0.032010, 0.004900, 0.009300, 0.063270, 0.165500, 0.290400, 0.433450, 0.594500, 0.762100,
        0.916300, 1.026300, 1.062200, 1.002600, 0.854450, 0.642400, 0.447900, 0.283500, 0.164900, 0.087400,
        0.046770, 0.022700, 0.011359, 0.005790, 0.002899, 0.001440, 0.000690, 0.000332, 0.000166, 0.000083,
        0.000042,
    ],
    [
        0.000039, 0.000120, 0.000396, 0.001210, 0.004000, 0.011600, 0.023000, 0.038000, 0.060000, 0.090980,
        0.139020, 0.208020, 0.323000, 0.503000, 0.710000, 0.862000, 0.954000, 0.994950, 0.995000, 0.952000,
        0.870000, 0.757000, 0.631000, 0.503000, 0.381000, 0.265000, 0.175000, 0.107000, 0.061000, 0.032000,
        0.017000, 0.008210, 0.004102, 0.002091, 0.001047, 0.000520, 0.000249, 0.000120, 0.000060, 0.000030,
        0.000015,
    ],
    [
        0.006450, 0.020050, 0.067850, 0.207400, 0.645600, 1.385600, 1.747060, 1.772110, 1.669200, 1.287640,
        0.812950, 0.465180, 0.272000, 0.158200, 0.078250, 0.042160, 0.020300, 0.008750, 0.003900, 0.002100,
        0.001650, 0.001100, 0.000800, 0.000340, 0.000190, 0.000050, 0.000020, 0.000000, 0.000000, 0.000000,
        0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        0.000000,
    ],
];

/// CIE standard illuminant D65 (ISO/CIE 11664-2), every 10 nm from 380 to 780 nm.
#[rustfmt::skip]
pub(super) const D65: [f64; 41] = [
    49.98, 54.65, 82.75, 91.49, 93.43, 86.68, 104.86, 117.01, 117.81, 114.86,
    115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05, 100.00, 96.33,
    95.79, 88.69, 90.01, 89.60, 87.70, 83.29, 83.70, 80.03, 80.21, 82.28,
    78.28, 69.72, 71.61, 74.35, 61.60, 69.89, 75.09, 63.59, 46.42, 66.81,
    63.38,
];

/// Linear Rec. 709 of XYZ. IEC 61966-2-1:1999.
fn rec709(xyz: [f64; 3]) -> [f64; 3] {
    let row = |m: [f64; 3]| m[0] * xyz[0] + m[1] * xyz[1] + m[2] * xyz[2];
    [
        row([3.2404542, -1.5371385, -0.4985314]),
        row([-0.9692660, 1.8760108, 0.0415560]),
        row([0.0556434, -0.2040259, 1.0572252]),
    ]
}

/// The colour of a spectrum that is given at the tables' wavelengths.
pub(super) fn color(spectrum: impl Fn(usize, f64) -> f64) -> [f64; 3] {
    let sum = |curve: &[f64; 41]| (0..41).map(|i| curve[i] * spectrum(i, FIRST + 10.0 * i as f64)).sum::<f64>();
    rec709([sum(&OBSERVER[0]), sum(&OBSERVER[1]), sum(&OBSERVER[2])])
}

#[test]
fn the_tables_are_whole() {
    // The observer's curves have equal areas: white of equal energy is x = y = 1/3.
    let area = OBSERVER.map(|curve| curve.iter().sum::<f64>());
    assert!(area.iter().all(|a| (a - 10.68).abs() < 0.01), "{area:?}");
    let white = color(|i, _| D65[i]);
    assert!(white.iter().all(|c| (c / white[1] - 1.0).abs() < 0.002), "{white:?}");
}

#[test]
fn a_temperature_is_plancks_law() {
    let node = Node::new("color/blackbody");
    let temperatures: Vec<f64> = (10..=150).map(|t| f64::from(t) * 100.0).collect();
    let rows: Vec<Vec<f32>> = temperatures.iter().map(|t| vec![*t as f32]).collect();
    let mut worst = (0.0, 0.0);
    for (found, t) in node.call::<f32>(&rows).iter().zip(&temperatures) {
        // The second radiation constant in nm K; the first one is brightness.
        let planck = color(|_, w| 1.0 / (w.powi(5) * ((1.438_776_877e7 / (w * t)).exp() - 1.0)));
        let greatest = planck[0].max(planck[1]).max(planck[2]);
        for i in 0..3 {
            let error = (found[i] - planck[i].max(0.0) / greatest).abs();
            if error > worst.0 {
                worst = (error, *t);
            }
        }
    }
    println!("blackbody: {:.4} of the greatest channel at {} K", worst.0, worst.1);
    assert!(worst.0 < 0.003);
}

#[test]
fn a_wavelength_is_the_observers_colour() {
    let node = Node::new("color/wavelength");
    let rows: Vec<Vec<f32>> = (0..41).map(|i| vec![(FIRST + 10.0 * f64::from(i)) as f32]).collect();
    let mut worst: f64 = 0.0;
    for (i, found) in node.call::<f32>(&rows).iter().enumerate() {
        let truth = rec709([OBSERVER[0][i], OBSERVER[1][i], OBSERVER[2][i]]);
        for c in 0..3 {
            worst = worst.max((found[c] - truth[c].max(0.0)).abs());
        }
    }
    println!("wavelength: {worst:.3} of 2.5");
    assert!(worst < 0.1);
}
