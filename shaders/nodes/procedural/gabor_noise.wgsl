// Gabor noise: a sum of short waves at random places. Lagae, Lefebvre, Drettakis and Dutre 2009, "Procedural Noise using Sparse Gabor
// Convolution"; the complex sum and its outputs after Tavernier, Neyret, Vergne and Thollot 2019, "Making Gabor Noise Fast and Normalized". The
// envelope is (1 - r^2)^2 up to one cell, which ends smoothly where a Gaussian would be cut.

// Waves that begin in each cell: 4 pi = 12.6 reach a point, enough for values that are distributed as a bell.
const WAVES_PER_CELL: i32 = 4;
// One over three standard deviations of the sum: its variance is half the number of waves times the integral of the squared envelope, 4/2 pi/5.
const GABOR_SCALE: f32 = 0.29735;
// The mean of the intensity: sqrt(pi/2)/3, as lengths of such pairs are distributed after Rayleigh.
const GABOR_INTENSITY: f32 = 0.41777;
// What is left of a wave of f periods over a window is sin(pi f)/(pi f), near exp(-f^2 pi^2/6) up to where nothing is left.
const WAVE_FILTER: f32 = 1.6449341;

/// The outputs of the node procedural/gabor_noise.
struct GaborOutputs {
    /// the waves, -1 to 1 for three standard deviations, mean 0
    value: f32,
    /// where on the wave the point is, 0 to 1 from crest to crest: a saw that any profile can be made of
    phase: f32,
    /// how strong the waves are there, 0 to 1
    intensity: f32,
}

/// Gabor Noise
///
/// Waves of one length, in one direction or in all: brushed and woven surfaces, fur, ripples of sand, water, fingerprints. Unlike other
/// noises its wavelength and direction are exact. Value, phase and strength of the waves are given each by itself. Every wave is filtered by
/// itself over the pixel; phase and strength fade to their means. 36 waves are summed. Lagae et al. 2009, "Procedural Noise using Sparse Gabor
/// Convolution"; Tavernier et al. 2019, "Making Gabor Noise Fast and Normalized".
/// @node procedural/gabor_noise   @also waves, anisotropic, brushed, fur, ripples, directional
/// - uv: coordinates [context uv0]
/// - scale: cells per unit; a train of waves is two cells long [8; 0..64]
/// - frequency: waves per cell; held in 0..64 [2; 0..8]
/// - anisotropy: 1 all waves along one direction, 0 along all; held in 0..1 [1; 0..1]
/// - orientation: direction in which the waves follow each other, counter-clockwise from +u [0; 0..180; deg]
/// - seed: another one, another pattern [0; 0..100]
/// @vertex node_procedural_gabor_noise_vertex
fn node_procedural_gabor_noise(uv: vec2f, scale: f32, frequency: f32, anisotropy: f32, orientation: f32, seed: i32) -> GaborOutputs {
    let p = held2(uv * scale);
    // Limited to where each wave is its mean.
    let ddx = clamp(dpdx(p), vec2f(-1e3), vec2f(1e3));
    let ddy = clamp(dpdy(p), vec2f(-1e3), vec2f(1e3));
    return gabor_noise(p, ddx, ddy, clamp(frequency, 0.0, 64.0), anisotropy, orientation, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_gabor_noise_vertex(uv: vec2f, scale: f32, frequency: f32, anisotropy: f32, orientation: f32, seed: i32) -> GaborOutputs {
    return gabor_noise(held2(uv * scale), vec2f(0.0), vec2f(0.0), clamp(frequency, 0.0, 64.0), anisotropy, orientation, seed);
}

/// Gabor Noise over a window with these sides.
fn gabor_noise(p: vec2f, ddx: vec2f, ddy: vec2f, frequency: f32, anisotropy: f32, orientation: f32, seed: i32) -> GaborOutputs {
    let cell = vec2i(floor(p));
    let f = fract(p);
    let fan = PI * (1.0 - clamp(anisotropy, 0.0, 1.0));
    var waves = vec2f(0.0);
    var filtered = 0.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            var h = lattice_hash(vec3i(cell + vec2i(x, y), 0), seed);
            for (var i = 0; i < WAVES_PER_CELL; i++) {
                let random = unit_floats(h);
                let d = f - vec2f(f32(x), f32(y)) - random.xy;
                let inside = 1.0 - dot(d, d);
                if inside > 0.0 {
                    let angle = radians(orientation) + fan * (random.z - 0.5);
                    // v grows downwards.
                    let wave = frequency * vec2f(cos(angle), -sin(angle));
                    // The low bits of a word, which places the wave by the others, are where it begins.
                    let turns = dot(wave, d) + f32(h.x & 255u) / 256.0;
                    let crest = inside * inside * vec2f(cos(2.0 * PI * fract(turns)), sin(2.0 * PI * fract(turns)));
                    waves += crest;
                    let across = vec2f(dot(wave, ddx), dot(wave, ddy));
                    filtered += crest.x * exp(-WAVE_FILTER * dot(across, across));
                }
                h = pcg3d(h);
            }
        }
    }
    let window = 0.5 * (dot(ddx, ddx) + dot(ddy, ddy));
    // The envelopes' own frequencies, 0.17 in the square, are filtered like the waves'.
    let left = exp(-0.17 * WAVE_FILTER * window);
    let turn = fract(atan2(waves.y, select(waves.x, 1.0, dot(waves, waves) < 1e-20)) * (0.5 * INV_PI));
    let intensity = min(GABOR_SCALE * length(waves), 1.0);
    return GaborOutputs(
        clamp(GABOR_SCALE * filtered * left, -1.0, 1.0),
        mix(0.5, turn, left * exp(-WAVE_FILTER * frequency * frequency * window)),
        mix(GABOR_INTENSITY, intensity, left_of_noise(1.0, window)));
}
