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
    let n = clamp(base_eta, vec3f(FILM_IOR_FLOOR), vec3f(BASE_IOR_CEILING));
    let k = clamp(base_k, vec3f(0.0), vec3f(BASE_IOR_CEILING));
    // (a + i b)^2 = (n + i k)^2 - 1 + c1^2 of each channel, each root without cancellation as in f_conductor. A base of
    // nearly the index outside has a = c1 at grazing incidence: 1 - c1^2 would have lost it.
    let nk = n * k;
    let squared_re = n * n - k * k;
    let squared_im = 2.0 * nk;
    let t = (n - 1.0) * (n + 1.0) + c1 * c1 - k * k;
    let greater = sqrt(0.5 * (sqrt(t * t + squared_im * squared_im) + abs(t)));
    let smaller = nk / max(greater, vec3f(FILM_FLOOR));
    let is_metal = t < vec3f(0.0);
    let a = select(greater, smaller, is_metal);
    let b = select(smaller, greater, is_metal);
    let s = film_series(r12.x, q - a, -b, q + a, b, tones);
    let minus_re = squared_re * q - ior2 * a;
    let minus_im = squared_im * q - ior2 * b;
    let p = film_series(r12.y, minus_re, minus_im, squared_re * q + ior2 * a, squared_im * q + ior2 * b, tones);
    return select(clamp(0.5 * (s + p), vec3f(0.0), vec3f(1.0)), vec3f(1.0), q2 < 0.0);
}

/// f_thin_film on a dielectric base, of index `base_eta` from 1 up: all amplitudes are real there, which is a third of the
/// work.
fn f_thin_film_dielectric(film_ior: f32, thickness: f32, base_eta: vec3f, cos_theta: f32) -> vec3f {
    // Above 0, and so is every denominator.
    let c1 = clamp(cos_theta, 1e-6, 1.0);
    let depth = clamp(thickness, 0.0, THICKNESS_CEILING);
    let present = min(depth * (1.0 / FADE_THICKNESS), 1.0);
    let fade = present * present * (3.0 - 2.0 * present);
    let ior = 1.0 + fade * (clamp(film_ior, FILM_IOR_FLOOR, FILM_IOR_CEILING) - 1.0);
    // 0 where the film reflects all: then nothing is lost below.
    let q = sqrt(max((ior - 1.0) * (ior + 1.0) + c1 * c1, 0.0));
    let tones = film_real_tones(2.0 * depth * q);
    let ior2 = ior * ior;
    let n = clamp(base_eta, vec3f(1.0), vec3f(BASE_IOR_CEILING));
    let a = sqrt((n - 1.0) * (n + 1.0) + c1 * c1);
    return saturate(1.0 - (film_loss(q, c1, a, tones) + film_loss(q, ior2 * c1, ior2 * a / (n * n), tones)));
}

/// The real parts of film_tones, a column for each order: five Gaussians at three orders as four vectors.
fn film_real_tones(path: f32) -> mat3x3f {
    let centres = vec4f(0.010258501116189029, 0.010910616526684985, 0.01405857181573468, 0.011209009787066005);
    let last_centre = vec3f(0.013915925235247472, 0.027831850470494944, 0.041747775705742416);
    // Minus half of log2(e), times the squares of the deviations.
    let spreads = vec4f(-1.3549409347110175e-7, -2.0767855249904617e-7, -2.757450462015585e-7, -5.038222444322254e-7);
    let last_spread = vec3f(-3.6136968939176454e-7, -1.4454787575670581e-6, -3.2523272045258807e-6);
    let weights = mat4x3f(
        1.341800362, -0.401351635, 0.023040702,
        1.218921421, -0.364596791, 0.020930688,
        0.519232538, -0.155309862, 0.008915993,
        -1.537138409, 1.876010867, -0.204025901,
    );
    let last_weight = vec3f(-0.542815912, 0.045247421, 1.151138518);
    let path2 = path * path;
    let last = exp2(path2 * last_spread) * cos(path * last_centre);
    let one = weights * (exp2(path2 * spreads) * cos(path * centres));
    let two = weights * (exp2(path2 * (4.0 * spreads)) * cos(path * (2.0 * centres)));
    let three = weights * (exp2(path2 * (9.0 * spreads)) * cos(path * (3.0 * centres)));
    return mat3x3f(one + last.xxx * last_weight, two + last.yyy * last_weight, three + last.zzz * last_weight);
}

/// What one polarisation does not reflect of its half of the light, (1 - R)/2 of film_series with the real amplitudes
/// -r12 = (q - c)/(q + c) and r23 = (q - a)/(q + a). With m = q^2 + c a and s = q (c + a) it is
/// 4 q c a / (m (c + a)) (1/2 + sum over j of z^j Re(..)), z = (m - s)/(m + s).
fn film_loss(q: f32, c: f32, a: vec3f, tones: mat3x3f) -> vec3f {
    let ca = c * a;
    let sum = c + a;
    let m = q * q + ca;
    let s = q * sum;
    let z = (m - s) / (m + s);
    return 4.0 * q * ca / (m * sum) * (0.5 + z * (tones[0] + z * (tones[1] + z * tones[2])));
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

/// Airy's sum of one polarisation in each channel: the film's amplitude is `r12`, the base's the quotient of the complex
/// numbers x and y, where 0 / 0 is 0.
fn film_series(r12: f32, x_re: vec3f, x_im: vec3f, y_re: vec3f, y_im: vec3f, tones: FilmTones) -> vec3f {
    let inverse = 1.0 / max(y_re * y_re + y_im * y_im, vec3f(FILM_FLOOR * FILM_FLOOR));
    let r23_re = (x_re * y_re + x_im * y_im) * inverse;
    let r23_im = (x_im * y_re - x_re * y_im) * inverse;
    let big_r12 = r12 * r12;
    let big_r23 = r23_re * r23_re + r23_im * r23_im;
    let t = 1.0 - big_r12;
    let c = t * t * big_r23 / max(1.0 - big_r12 * big_r23, vec3f(FILM_FLOOR));
    let z_re = -r12 * r23_re;
    let z_im = -r12 * r23_im;
    let z2_re = z_re * z_re - z_im * z_im;
    let z2_im = 2.0 * z_re * z_im;
    let z3_re = z2_re * z_re - z2_im * z_im;
    let z3_im = z2_re * z_im + z2_im * z_re;
    let re = z_re * tones.re1 + z2_re * tones.re2 + z3_re * tones.re3;
    let im = z_im * tones.im1 + z2_im * tones.im2 + z3_im * tones.im3;
    return big_r12 + c + 2.0 * (c - t) * (re - im);
}
