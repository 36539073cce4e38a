//! The metals' colours and edge tints against published optical constants: Fresnel's reflectance of eta + i k over the spectrum, under D65,
//! seen by the CIE 1931 observer.

use super::light::{D65, color};
use super::run::Node;

/// A metal and its optical constants: wavelength in micrometres, eta and k.
struct Metal {
    name: &'static str,
    constants: &'static [[f64; 3]],
}

/// From the sources that the nodes name, as refractiveindex.info (public domain) has them, thinned to the visible.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "chromium absorbs by 3.14 at 451 nm")]
const METALS: &[Metal] = &[
    // Johnson and Christy 1972.
    Metal { name: "gold", constants: &[
        [0.3815, 1.46, 1.933], [0.3974, 1.47, 1.952], [0.4133, 1.46, 1.958], [0.4305, 1.45, 1.948], [0.4509, 1.38, 1.914],
        [0.4714, 1.31, 1.849], [0.4959, 1.04, 1.833], [0.5209, 0.62, 2.081], [0.5486, 0.43, 2.455], [0.5821, 0.29, 2.863],
        [0.6168, 0.21, 3.272], [0.6595, 0.14, 3.697], [0.7045, 0.13, 4.103], [0.756, 0.14, 4.542], [0.8211, 0.16, 5.083],
    ] },
    // Johnson and Christy 1972.
    Metal { name: "silver", constants: &[
        [0.3679, 0.07, 1.657], [0.3815, 0.05, 1.864], [0.3974, 0.05, 2.07], [0.4133, 0.05, 2.275], [0.4305, 0.04, 2.462],
        [0.4509, 0.04, 2.657], [0.4714, 0.05, 2.869], [0.4959, 0.05, 3.093], [0.5209, 0.05, 3.324], [0.5486, 0.06, 3.586],
        [0.5821, 0.05, 3.858], [0.6168, 0.06, 4.152], [0.6595, 0.05, 4.483], [0.7045, 0.04, 4.838], [0.756, 0.03, 5.242],
        [0.8211, 0.04, 5.727],
    ] },
    // Johnson and Christy 1972.
    Metal { name: "copper", constants: &[
        [0.3679, 1.36, 1.975], [0.3815, 1.33, 2.045], [0.3974, 1.32, 2.116], [0.4133, 1.28, 2.207], [0.4305, 1.25, 2.305],
        [0.4509, 1.24, 2.397], [0.4714, 1.25, 2.483], [0.4959, 1.22, 2.564], [0.5209, 1.18, 2.608], [0.5486, 1.02, 2.577],
        [0.5821, 0.7, 2.704], [0.6168, 0.3, 3.205], [0.6595, 0.22, 3.747], [0.7045, 0.21, 4.205], [0.756, 0.24, 4.665],
        [0.8211, 0.26, 5.18],
    ] },
    // Rakic 1995.
    Metal { name: "aluminium", constants: &[
        [0.36466, 0.39877, 4.3957], [0.41328, 0.52135, 5.0008], [0.4428, 0.6079, 5.3676], [0.47687, 0.7278, 5.7781], [0.5166, 0.8734, 6.2418],
        [0.56357, 1.0728, 6.7839], [0.61993, 1.366, 7.4052], [0.65225, 1.5724, 7.7354], [0.68881, 1.8301, 8.0601], [0.72932, 2.1606, 8.3565],
        [0.77491, 2.6154, 8.4914], [0.79478, 2.7675, 8.3866],
    ] },
    // Johnson and Christy 1974.
    Metal { name: "iron", constants: &[
        [0.368, 2.02, 2.43], [0.381, 2.12, 2.5], [0.397, 2.24, 2.58], [0.413, 2.35, 2.65], [0.431, 2.48, 2.71],
        [0.451, 2.59, 2.77], [0.471, 2.67, 2.82], [0.496, 2.74, 2.88], [0.521, 2.86, 2.91], [0.549, 2.95, 2.93],
        [0.582, 2.94, 2.99], [0.617, 2.88, 3.05], [0.659, 2.92, 3.1], [0.704, 2.86, 3.19], [0.756, 2.87, 3.28],
        [0.821, 2.94, 3.39],
    ] },
    // Johnson and Christy 1974.
    Metal { name: "chromium", constants: &[
        [0.368, 1.87, 2.69], [0.381, 1.92, 2.74], [0.397, 2.0, 2.83], [0.413, 2.08, 2.93], [0.431, 2.19, 3.04],
        [0.451, 2.33, 3.14], [0.471, 2.51, 3.24], [0.496, 2.75, 3.3], [0.521, 2.94, 3.33], [0.549, 3.18, 3.33],
        [0.582, 3.22, 3.3], [0.617, 3.17, 3.3], [0.659, 3.09, 3.34], [0.704, 3.05, 3.39], [0.756, 3.08, 3.42],
        [0.821, 3.2, 3.48],
    ] },
    // Johnson and Christy 1974.
    Metal { name: "titanium", constants: &[
        [0.368, 1.9, 2.9], [0.381, 1.99, 2.93], [0.397, 2.08, 2.95], [0.413, 2.14, 2.98], [0.431, 2.21, 3.01],
        [0.451, 2.27, 3.04], [0.471, 2.32, 3.1], [0.496, 2.36, 3.19], [0.521, 2.44, 3.3], [0.549, 2.54, 3.43],
        [0.582, 2.6, 3.58], [0.617, 2.67, 3.72], [0.659, 2.76, 3.84], [0.704, 2.86, 3.96], [0.756, 3.0, 4.01],
        [0.821, 3.21, 4.01],
    ] },
    // Johnson and Christy 1974.
    Metal { name: "nickel", constants: &[
        [0.368, 1.7, 2.4], [0.381, 1.72, 2.48], [0.397, 1.72, 2.57], [0.413, 1.7, 2.69], [0.431, 1.71, 2.82],
        [0.451, 1.73, 2.95], [0.471, 1.78, 3.09], [0.496, 1.82, 3.25], [0.521, 1.85, 3.42], [0.549, 1.92, 3.61],
        [0.582, 1.96, 3.8], [0.617, 1.99, 4.02], [0.659, 1.99, 4.26], [0.704, 2.06, 4.5], [0.756, 2.13, 4.73],
        [0.821, 2.26, 4.97],
    ] },
    // Rakic et al. 1998, Brendel-Bormann.
    Metal { name: "platinum", constants: &[
        [0.3747, 1.6643, 2.6963], [0.39746, 1.7225, 2.8323], [0.42161, 1.7804, 2.9727], [0.44722, 1.839, 3.1204], [0.47439, 1.9006, 3.2774],
        [0.50321, 1.9676, 3.4447], [0.53378, 2.0427, 3.6219], [0.5662, 2.1281, 3.8079], [0.6006, 2.2255, 4.0007], [0.63709, 2.3354, 4.1979],
        [0.67579, 2.4574, 4.3969], [0.71684, 2.5903, 4.5958], [0.76039, 2.7317, 4.7932], [0.80658, 2.8789, 4.9889],
    ] },
    // Weaver, Olson and Lynch 1975.
    Metal { name: "tungsten", constants: &[
        [0.372, 3.431, 2.621], [0.3912, 3.445, 2.46], [0.4115, 3.379, 2.416], [0.4298, 3.336, 2.45], [0.4487, 3.314, 2.511],
        [0.4694, 3.332, 2.591], [0.4921, 3.38, 2.664], [0.5111, 3.433, 2.7], [0.5298, 3.49, 2.716], [0.5489, 3.522, 2.739],
        [0.5739, 3.526, 2.794], [0.6024, 3.562, 2.866], [0.626, 3.607, 2.906], [0.646, 3.657, 2.925], [0.6712, 3.746, 2.937],
        [0.7008, 3.871, 2.879], [0.7314, 3.891, 2.828], [0.7549, 3.857, 2.784], [0.7817, 3.772, 2.731],
    ] },
    // Querry 1985, 70 % copper.
    Metal { name: "brass", constants: &[
        [0.37, 1.497, 1.818], [0.39, 1.471, 1.813], [0.41, 1.405, 1.794], [0.43, 1.278, 1.784], [0.45, 1.094, 1.829],
        [0.47, 0.9, 1.957], [0.49, 0.745, 2.145], [0.51, 0.639, 2.358], [0.53, 0.573, 2.568], [0.55, 0.527, 2.765],
        [0.57, 0.484, 2.958], [0.59, 0.46, 3.159], [0.61, 0.452, 3.345], [0.63, 0.445, 3.522], [0.65, 0.444, 3.695],
        [0.68, 0.444, 3.943], [0.71, 0.448, 4.186], [0.74, 0.455, 4.424], [0.77, 0.46, 4.657], [0.8, 0.473, 4.89],
    ] },
];

/// Fresnel's reflectance of a conductor, unpolarised: complex square roots written out. Born and Wolf 1999, Principles of Optics, 14.2.
fn fresnel(eta: f64, k: f64, cosine: f64) -> f64 {
    let sine2 = 1.0 - cosine * cosine;
    // (p + i q)^2 = (eta + i k)^2 - sin^2.
    let (re, im) = (eta * eta - k * k - sine2, 2.0 * eta * k);
    let size = re.hypot(im);
    let (p, q) = ((0.5 * (size + re)).sqrt(), (0.5 * (size - re)).sqrt());
    let rs = ((cosine - p).powi(2) + q * q) / ((cosine + p).powi(2) + q * q);
    let tan_sine = sine2 / cosine;
    let rp = rs * ((p - tan_sine).powi(2) + q * q) / ((p + tan_sine).powi(2) + q * q);
    0.5 * (rs + rp)
}

/// The constants at a wavelength in nm, linear between their rows and on to 380 nm, where gold's begin at 381.5 nm.
fn at(metal: &Metal, wavelength: f64) -> (f64, f64) {
    let x = wavelength / 1000.0;
    let i = metal.constants.windows(2).position(|w| x <= w[1][0]).expect("within the table");
    let [a, b] = [metal.constants[i], metal.constants[i + 1]];
    let t = (x - a[0]) / (b[0] - a[0]);
    (a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]))
}

/// The colour of light from D65 that the metal reflects at a cosine, where a perfect mirror's is 1.
fn reflected(metal: &Metal, cosine: f64) -> [f64; 3] {
    let white = color(|i, _| D65[i]);
    let seen = color(|i, wavelength| {
        let (eta, k) = at(metal, wavelength);
        D65[i] * fresnel(eta, k, cosine)
    });
    [seen[0] / white[0], seen[1] / white[1], seen[2] / white[2]]
}

#[test]
fn metals_are_fresnels_reflectance_of_their_constants() {
    for metal in METALS {
        let found = &Node::new(&format!("optics/{}", metal.name)).call::<f32>(&[vec![]])[0];
        let f0 = reflected(metal, 1.0).map(|c| c.clamp(0.0, 1.0));
        let f82 = reflected(metal, 1.0 / 7.0);
        let mut worst: f64 = 0.0;
        for i in 0..3 {
            let schlick = f0[i] + (1.0 - f0[i]) * (6.0_f64 / 7.0).powi(5);
            worst = worst.max((found[i] - f0[i]).abs());
            worst = worst.max((found[3 + i] - (f82[i] / schlick).clamp(0.0, 1.0)).abs());
        }
        println!("{}: {:?}, {worst:.5} from the spectrum", metal.name, &found[..3]);
        assert!(worst < 2e-4, "{}: {worst}", metal.name);
    }
}

/// Through the constants at 650, 550 and 450 nm the node for any metal comes near the nodes of known ones.
#[test]
fn three_wavelengths_come_near_the_spectrum() {
    let node = Node::new("optics/conductor");
    for metal in METALS {
        let [r, g, b] = [650.0, 550.0, 450.0].map(|w| at(metal, w));
        let eta = [r.0, g.0, b.0].map(|x| x as f32);
        let k = [r.1, g.1, b.1].map(|x| x as f32);
        let found = &node.call::<f32>(&[node.row(&[("eta", &eta), ("k", &k)])])[0];
        for i in 0..3 {
            let (eta, k) = [r, g, b][i];
            let f0 = fresnel(eta, k, 1.0);
            let tint = fresnel(eta, k, 1.0 / 7.0) / (f0 + (1.0 - f0) * (6.0_f64 / 7.0).powi(5));
            assert!((found[i] - f0).abs() < 1e-5, "{}", metal.name);
            assert!((found[3 + i] - tint.min(1.0)).abs() < 1e-5, "{}", metal.name);
        }
        let spectrum = reflected(metal, 1.0);
        let apart = (0..3).map(|i| (found[i] - spectrum[i].min(1.0)).abs()).fold(0.0, f64::max);
        println!("{}: three wavelengths are {apart:.3} from the spectrum", metal.name);
        assert!(apart < 0.07, "{}: {apart}", metal.name);
    }
}
