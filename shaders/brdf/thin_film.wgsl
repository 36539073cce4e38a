// Fresnel reflectance of a surface under a thin transparent film, whose two reflections interfere: soap bubbles, oil, heat
// tint. In linear Rec. 709, by sensitivities of the eye in closed form; no spectrum is sampled.

// Below this thickness [nm] the film's index goes to the outside's, so that a film of no thickness is none.
const FADE_THICKNESS: f32 = 30.0;
// Thickest film [nm]: from a few micrometres on all colours have merged and the result no longer changes.
const THICKNESS_CEILING: f32 = 1e5;
// Range of the film's index.
const FILM_IOR_CEILING: f32 = 10.0;
// Smallest index of film and base that is divided by.
const FILM_IOR_FLOOR: f32 = 1e-3;
// Largest index and extinction of the base; the fourth power must not overflow.
const BASE_IOR_CEILING: f32 = 1e6;
// Smallest denominator.
const FILM_FLOOR: f32 = 1e-18;

/// What the eye's three channels make of exp(i m k D), m = 1..3: real parts, imaginary parts.
struct FilmTones {
    re1: vec3f,
    im1: vec3f,
    re2: vec3f,
    im2: vec3f,
    re3: vec3f,
    im3: vec3f,
}

/// Belcour and Barla 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence: reflectance
/// of a base of index `base_eta` + i `base_k` (per channel) under a film of index `film_ior` and `thickness` in nanometres,
/// in air, unpolarised.
///
/// For each polarisation, with the amplitudes r12 (air, film) and r23 (film, base), T = 1 - r12^2, z = -r12 r23 and the
/// optical path D = 2 film_ior thickness cos(theta_2), Airy's sum is, as a Fourier series in the wavenumber k,
///   R = r12^2 + C + 2 (C - T) sum over m of Re(z^m exp(i m k D)),  C = T^2 |r23|^2 / (1 - |z|^2).
/// The eye's response to exp(i m k D) is the Fourier transform of its sensitivity: for a Gaussian lobe (centre c, deviation s)
/// exp(-(m s D)^2 / 2) exp(i m c D). The orders m = 1..3 are summed. The result is held in [0, 1].
fn f_thin_film(film_ior: f32, thickness: f32, base_eta: vec3f, base_k: vec3f, cos_theta: f32) -> vec3f {
    let c1 = clamp(cos_theta, 0.0, 1.0);
    let s2 = (1.0 - c1) * (1.0 + c1);
    let depth = clamp(thickness, 0.0, THICKNESS_CEILING);
    let present = min(depth * (1.0 / FADE_THICKNESS), 1.0);
    let fade = present * present * (3.0 - 2.0 * present);
    let ior = 1.0 + fade * (clamp(film_ior, FILM_IOR_FLOOR, FILM_IOR_CEILING) - 1.0);
    // film_ior cos(theta_2), from which both the path and the amplitudes are made.
    let q2 = (ior - 1.0) * (ior + 1.0) + c1 * c1;
    let q = sqrt(max(q2, 0.0));
    let ior2 = ior * ior;
    let r12 = vec2f((c1 - q) / max(c1 + q, FILM_FLOOR), (ior2 * c1 - q) / max(ior2 * c1 + q, FILM_FLOOR));
    let tones = film_tones(2.0 * depth * q);
    let red = film_channel(r12, ior2, q, s2, base_eta.x, base_k.x,
        vec3f(tones.re1.x, tones.re2.x, tones.re3.x), vec3f(tones.im1.x, tones.im2.x, tones.im3.x));
    let green = film_channel(r12, ior2, q, s2, base_eta.y, base_k.y,
        vec3f(tones.re1.y, tones.re2.y, tones.re3.y), vec3f(tones.im1.y, tones.im2.y, tones.im3.y));
    let blue = film_channel(r12, ior2, q, s2, base_eta.z, base_k.z,
        vec3f(tones.re1.z, tones.re2.z, tones.re3.z), vec3f(tones.im1.z, tones.im2.z, tones.im3.z));
    return select(clamp(vec3f(red, green, blue), vec3f(0.0), vec3f(1.0)), vec3f(1.0), q2 < 0.0);
}

/// Each channel's response to exp(i m k `path`), m = 1..3.
///
/// The colour matching functions of the CIE 1931 observer over k = 2 pi / wavelength [1/nm] are five Gaussians (centre,
/// deviation), three for x, one each for y and z: least squares on the analytic functions of Wyman, Sloan, Shirley 2013,
/// Simple Analytic Approximations to the CIE XYZ Color Matching Functions. The weights take XYZ to Rec. 709; those of a
/// channel add up to 1.
fn film_tones(path: f32) -> FilmTones {
    var tones = FilmTones(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
    tones = film_lobe(tones, path, 0.010258501116189029, 0.0004333990052411747, vec3f(1.341800362, -0.401351635, 0.023040702));
    tones = film_lobe(tones, path, 0.010910616526684985, 0.0005365664975144916, vec3f(1.218921421, -0.364596791, 0.020930688));
    tones = film_lobe(tones, path, 0.01405857181573468, 0.0006182748601196432, vec3f(0.519232538, -0.155309862, 0.008915993));
    tones = film_lobe(tones, path, 0.011209009787066005, 0.0008357307798945551, vec3f(-1.537138409, 1.876010867, -0.204025901));
    tones = film_lobe(tones, path, 0.013915925235247472, 0.0007077886426635069, vec3f(-0.542815912, 0.045247421, 1.151138518));
    return tones;
}

/// The response with that of one Gaussian lobe added.
fn film_lobe(tones: FilmTones, path: f32, centre: f32, deviation: f32, weight: vec3f) -> FilmTones {
    let phase = vec3f(centre, 2.0 * centre, 3.0 * centre) * path;
    let spread = vec3f(deviation, 2.0 * deviation, 3.0 * deviation) * path;
    // Half of log2(e).
    let size = exp2(-0.72134752044448170368 * spread * spread);
    let re = size * cos(phase);
    let im = size * sin(phase);
    return FilmTones(
        tones.re1 + weight * re.x,
        tones.im1 + weight * im.x,
        tones.re2 + weight * re.y,
        tones.im2 + weight * im.y,
        tones.re3 + weight * re.z,
        tones.im3 + weight * im.z,
    );
}

/// One channel: the mean of both polarisations. `q` is the film's index times the cosine in it, `s2` the squared sine outside.
fn film_channel(
    r12: vec2f, ior2: f32, q: f32, s2: f32, base_eta: f32, base_k: f32, re: vec3f, im: vec3f,
) -> f32 {
    let n = clamp(base_eta, FILM_IOR_FLOOR, BASE_IOR_CEILING);
    let k = clamp(base_k, 0.0, BASE_IOR_CEILING);
    // (a + i b)^2 = (n + i k)^2 - s2, each root without cancellation as in f_conductor.
    let nk = n * k;
    let squared = vec2f(n * n - k * k, 2.0 * nk);
    let t = squared.x - s2;
    let greater = sqrt(0.5 * (sqrt(t * t + squared.y * squared.y) + abs(t)));
    let smaller = nk / max(greater, FILM_FLOOR);
    let ab = select(vec2f(greater, smaller), vec2f(smaller, greater), t < 0.0);
    let s = film_quotient(vec2f(q, 0.0) - ab, vec2f(q, 0.0) + ab);
    let p = film_quotient(squared * q - ior2 * ab, squared * q + ior2 * ab);
    return 0.5 * (film_series(r12.x, s, re, im) + film_series(r12.y, p, re, im));
}

/// Quotient of two complex numbers; 0 / 0 is 0.
fn film_quotient(x: vec2f, y: vec2f) -> vec2f {
    return vec2f(dot(x, y), x.y * y.x - x.x * y.y) / max(dot(y, y), FILM_FLOOR * FILM_FLOOR);
}

/// Airy's sum of one polarisation seen by one channel: `re` and `im` are its response to the orders 1 to 3.
fn film_series(r12: f32, r23: vec2f, re: vec3f, im: vec3f) -> f32 {
    let big_r12 = r12 * r12;
    let big_r23 = dot(r23, r23);
    let t = 1.0 - big_r12;
    let c = t * t * big_r23 / max(1.0 - big_r12 * big_r23, FILM_FLOOR);
    let z = -r12 * r23;
    let z2 = vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y);
    let z3 = vec2f(z2.x * z.x - z2.y * z.y, z2.x * z.y + z2.y * z.x);
    let sum = dot(vec3f(z.x, z2.x, z3.x), re) - dot(vec3f(z.y, z2.y, z3.y), im);
    return big_r12 + c + 2.0 * (c - t) * sum;
}
