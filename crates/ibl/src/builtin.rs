//! Environments of our own: plain white, a photographer's studio, a sky with a sun. Formulas, no pictures.

use crate::cube::unit;
use crate::equirect::Equirect;
use crate::load::LoadedEnvironment;

/// Columns of the built-in maps: their edges are softer than a texel.
const WIDTH: usize = 1024;

/// Radiance 1 from everywhere.
pub fn white() -> LoadedEnvironment {
    Equirect { width: 1, height: 1, pixels: vec![[1.0; 3]] }.into()
}

/// A studio: softboxes before a dark grey surround. Its mean radiance is about 0.5.
///
/// Placed for a camera on +Z that looks at the origin: a large key light to the upper left, a tall strip to the right, a
/// panel overhead, two rim lights behind the subject and a weak reflector below, so that a metal sphere shows broad
/// gradients, clean edges and a dark core between them.
pub fn studio() -> LoadedEnvironment {
    Equirect::from_fn(WIDTH, WIDTH / 2, studio_radiance).into()
}

/// A clear sky over dull ground, with a sun of 1 degree radius, 40 degrees high, to the left of a camera on +Z and behind
/// it. Its mean radiance is about 0.5, and the sun gives about as much light as the sky.
pub fn sky() -> LoadedEnvironment {
    Equirect::from_fn(WIDTH, WIDTH / 2, sky_radiance).into()
}

/// A rectangular lamp with soft round corners, seen from the origin.
struct Softbox {
    /// Where its middle is; need not be unit.
    towards: [f64; 3],
    /// Half of its width and height, as tangents of the angle.
    half: [f64; 2],
    /// Turn about its middle, in degrees.
    roll: f64,
    /// Radiance in its middle.
    radiance: [f64; 3],
    /// What is left of it at the edge, 0..1: a diffuser is brightest before its bulb.
    edge: f64,
}

const SOFTBOXES: [Softbox; 6] = [
    Softbox { towards: [-0.80, 0.66, 0.70], half: [0.46, 0.60], roll: 8.0, radiance: [4.9, 4.7, 4.45], edge: 0.45 },
    Softbox { towards: [1.0, 0.22, 0.50], half: [0.15, 0.80], roll: 0.0, radiance: [2.4, 2.55, 2.8], edge: 0.6 },
    Softbox { towards: [0.15, 1.0, -0.10], half: [0.62, 0.30], roll: 0.0, radiance: [1.9, 1.9, 1.95], edge: 0.5 },
    Softbox { towards: [-0.95, 0.10, -0.55], half: [0.10, 0.60], roll: -6.0, radiance: [2.6, 2.75, 3.0], edge: 0.7 },
    Softbox { towards: [0.80, 0.35, -0.85], half: [0.22, 0.40], roll: 6.0, radiance: [3.0, 2.9, 2.75], edge: 0.5 },
    Softbox { towards: [0.3, -1.0, 0.7], half: [0.9, 0.45], roll: 0.0, radiance: [0.15, 0.15, 0.155], edge: 0.3 },
];

fn studio_radiance(dir: [f64; 3]) -> [f32; 3] {
    // The surround: a floor a little lighter than the wall far away, a horizon without a line, a dark ceiling.
    let wall = 0.03 + 0.09 * (-(dir[1] / 0.3).powi(2)).exp();
    let floor = 0.07 * smoothstep(0.05, -0.6, dir[1]);
    let grey = wall + floor;
    let mut radiance = [grey, grey, grey * 1.04];
    for lamp in &SOFTBOXES {
        let (share, strength) = softbox_share(lamp, dir);
        for (sum, lamp) in radiance.iter_mut().zip(lamp.radiance) {
            *sum += share * (lamp * strength - *sum);
        }
    }
    radiance.map(|x| x as f32)
}

/// How much of a direction a lamp covers, 0..1, and its strength there.
fn softbox_share(lamp: &Softbox, dir: [f64; 3]) -> (f64, f64) {
    let forward = unit(lamp.towards);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let depth = dot(dir, forward);
    if depth <= 0.05 {
        return (0.0, 0.0);
    }
    let up = if forward[1].abs() > 0.8 { [0.0, 0.0, -1.0] } else { [0.0, 1.0, 0.0] };
    let right = unit(cross(up, forward));
    let up = cross(forward, right);
    let (sin, cos) = lamp.roll.to_radians().sin_cos();
    let (x, y) = (dot(dir, right) / depth, dot(dir, up) / depth);
    let (x, y) = (x * cos + y * sin, y * cos - x * sin);
    // Distance to a rectangle with round corners, negative inside.
    let corner = 0.06;
    let (dx, dy) = (x.abs() - lamp.half[0] + corner, y.abs() - lamp.half[1] + corner);
    let outside = dx.max(0.0).hypot(dy.max(0.0)) + dx.max(dy).min(0.0) - corner;
    let share = smoothstep(0.012, -0.012, outside);
    let (u, v) = (x / lamp.half[0], y / lamp.half[1]);
    let falloff = 1.0 - (1.0 - lamp.edge) * smoothstep(0.0, 1.3, (u * u + v * v).sqrt());
    (share, falloff)
}

/// Towards the sun: 40 degrees high, 35 degrees to the left of +Z.
const SUN: [f64; 3] = [-0.4394, 0.6428, 0.6275];
/// Radius of the disc and half of the width of its edge, in degrees.
const SUN_RADIUS: f64 = 1.0;
const SUN_EDGE: f64 = 0.2;
const SUN_RADIANCE: [f64; 3] = [1750.0, 1560.0, 1270.0];

fn sky_radiance(dir: [f64; 3]) -> [f32; 3] {
    let [x, y, z] = dir;
    let cos_sun = x * SUN[0] + y * SUN[1] + z * SUN[2];
    let angle = cos_sun.clamp(-1.0, 1.0).acos().to_degrees();
    // More air lies along a flat line of sight: the sky pales towards the horizon, and warms beside the sun.
    let air = (-3.2 * y.max(0.0)).exp();
    let glow = (-angle / 9.0).exp();
    let haze = 0.5 + 0.5 * cos_sun;
    let zenith = [0.13, 0.29, 0.72];
    let horizon = [0.86, 0.95, 1.05];
    let ground = [0.20, 0.175, 0.145];
    let warm = [1.0, 0.86, 0.62];
    // The horizon itself is a soft line of half a degree.
    let below = smoothstep(0.006, -0.006, y);
    let disc = smoothstep(SUN_RADIUS + SUN_EDGE, SUN_RADIUS - SUN_EDGE, angle);
    std::array::from_fn(|i| {
        let sky = zenith[i] + (horizon[i] - zenith[i]) * air;
        let sky = sky * (0.75 + 0.5 * haze * haze) + warm[i] * (1.6 * glow + 0.18 * haze.powi(6));
        let earth = ground[i] * (1.0 + 0.5 * (6.0 * y.min(0.0)).exp());
        let light = sky + below * (earth - sky) + disc * SUN_RADIANCE[i];
        light as f32
    })
}

/// 0 at `from`, 1 at `to`, smooth between; `from` may be the greater.
fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
