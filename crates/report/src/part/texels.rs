//! What texels of normal maps mean and what storing them costs: 8 bits, two channels, BC5's blocks; and height fields: moved
//! vertices with the old and the derived normal, parallax, fine geometry.

use halfvector_maps::blend::texel_from_normal;
use halfvector_maps::derivative::normal_from_slopes;
use halfvector_maps::height::normal_from_height;
use halfvector_maps::normal::normal_from_texel;
use halfvector_maps::parallax::{parallax_occlusion, parallax_offset};
use halfvector_maps::texel::{normal_from_texel_snorm, normal_from_texel_two_channel, texel_from_normal_snorm};

use rayon::prelude::*;

use super::ibl::unit;
use crate::search::{CHEAP, Search};
use crate::{Effort, Row};

type Vector = [f64; 3];

pub(super) fn degrees_between(a: Vector, b: Vector) -> f64 {
    let apart = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    2.0 * (0.5 * apart).min(1.0).asin().to_degrees()
}

/// Measures decoding and heights.
pub(super) fn rows(effort: Effort) -> Vec<Row> {
    let mut rows = decoded(effort.pick(20_000, 200_000));
    rows.extend(odd_texels());
    rows.extend(heights(effort.pick(2_000, 20_000)));
    rows.extend(heights_on_ball(effort.pick(4_000, 40_000)));
    rows
}

/// A code of 8 bits, as a sampler gives it.
fn eight_bits(color: Vector) -> Vector {
    color.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() / 255.0)
}

/// A channel of a 4 x 4 block of BC4: two ends of 8 bits and six steps between, the nearest for each texel. Two such make BC5.
fn bc4(block: [f64; 16]) -> [f64; 16] {
    let low = (block.iter().copied().fold(1.0, f64::min) * 255.0).floor() / 255.0;
    let high = (block.iter().copied().fold(0.0, f64::max) * 255.0).ceil() / 255.0;
    block.map(|c| if high > low { low + ((c - low) / (high - low) * 7.0).round() / 7.0 * (high - low) } else { low })
}

/// What [`decoded`] draws.
pub(crate) const DECODED: &str = "normals of tilt 0..80 deg at any azimuth, stored with 8 bits a channel where the name says nothing else; angle to the stored normal in degrees";

/// Normals of tilt 0..80 degrees at any azimuth, stored and read again.
fn decoded(count: usize) -> Vec<Row> {
    type Stored = fn(Vector) -> Vector;
    let one = |stored: Stored| {
        move |[tilt, azimuth, _]: [f64; 3]| {
            let n = tilted(tilt, azimuth);
            degrees_between(stored(n), n)
        }
    };
    let unorm = one(|n| normal_from_texel(eight_bits(texel_from_normal(n)), 1.0, false));
    let snorm = one(|n| normal_from_texel_snorm(eight_bits(texel_from_normal_snorm(n)), 1.0, false));
    let two_channel = one(|n| normal_from_texel_two_channel(eight_bits(texel_from_normal(n)), 1.0, false));
    let sixteen_bits = one(|n| {
        let color = texel_from_normal(n).map(|c| (c * 65535.0).round() / 65535.0);
        normal_from_texel(color, 1.0, false)
    });
    type Error<'a> = &'a (dyn Fn([f64; 3]) -> f64 + Sync);
    let methods: [(&str, u64, Error<'_>); 5] = [
        ("unorm", 4, &unorm),
        ("snorm", 4, &snorm),
        ("two_channel", 2, &two_channel),
        ("unorm, 16 bits", 8, &sixteen_bits),
        ("two_channel, BC5", 1, &|[tilt, azimuth, texel]| block_error([tilt, azimuth, texel_of_block(texel) as f64])),
    ];
    let row = |&(name, bytes, error): &(&str, u64, Error<'_>)| {
        let angles = |[s, t, texel]: [f64; 3]| [MOST_TILT * s, std::f64::consts::TAU * t, texel];
        let at = |place: [f64; 3]| {
            let [tilt, azimuth, texel] = angles(place);
            let block = if name.ends_with("BC5") {
                format!(", texel of the block = {}", texel_of_block(texel))
            } else {
                String::new()
            };
            format!("tilt = {tilt:?} deg, azimuth = {:?} deg{block}", azimuth.to_degrees())
        };
        let place =
            |k: usize| [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|step: f64| (0.5 + step * k as f64).fract());
        let mut row = Row::new("normal_decode", name, DECODED);
        STEPS.errors((0..count).map(place), |place| error(angles(place)), at).fill(&mut row);
        row.bytes = Some(bytes);
        row
    };
    methods.par_iter().map(row).collect()
}

/// The error of a texel of a block of normals that differ by some degrees, by the block's tilt [deg] and azimuth, and the texel's number.
fn block_error([tilt, azimuth, texel]: [f64; 3]) -> f64 {
    let block: [Vector; 16] = std::array::from_fn(|i| {
        let tilt = (tilt + 6.0 * ((i % 4) as f64 / 3.0 - 0.5)).clamp(0.0, MOST_TILT);
        tilted(tilt, azimuth + 0.1 * (i / 4) as f64)
    });
    let channel = |c: usize| bc4(block.map(|n| texel_from_normal(n)[c]));
    let (x, y, i) = (channel(0), channel(1), (texel as usize).min(15));
    degrees_between(normal_from_texel_two_channel([x[i], y[i], 0.0], 1.0, false), block[i])
}

/// The texel of a block at a number in 0..1.
fn texel_of_block(number: f64) -> usize {
    ((16.0 * number) as usize).min(15)
}

/// Largest tilt of normals that are stored [deg].
const MOST_TILT: f64 = 80.0;

/// Errors of codes jump from code to code: many places are searched around.
const STEPS: Search = Search { starts: 600, rounds: 12 };

/// The unit normal of a tilt in degrees and an azimuth in radians.
fn tilted(tilt: f64, azimuth: f64) -> Vector {
    let (sine, cosine) = tilt.to_radians().sin_cos();
    [sine * azimuth.cos(), sine * azimuth.sin(), cosine]
}

/// Texels that say no direction above the surface: every reading is a unit vector, and says where it points.
fn odd_texels() -> Vec<Row> {
    let texels = [
        ("(128, 128, 255), flat", [128.0, 128.0, 255.0]),
        ("(255, 128, 128), z = 0", [255.0, 128.0, 128.0]),
        ("(128, 128, 128), no direction", [128.0, 128.0, 128.0]),
        ("(0, 0, 0), black", [0.0; 3]),
        ("(128, 128, 0), below the surface", [128.0, 128.0, 0.0]),
    ];
    type Read = fn(Vector) -> Vector;
    let methods: [(&str, Read); 3] = [
        ("unorm", |c| normal_from_texel(c, 1.0, false)),
        ("snorm", |c| normal_from_texel_snorm(c, 1.0, false)),
        ("two_channel", |c| normal_from_texel_two_channel(c, 1.0, false)),
    ];
    let row = |(name, code): (&str, Vector), (method, read): (&str, Read)| {
        let found = read(code.map(|c| c / 255.0));
        let domain = format!("texel {name}; angle to straight up in degrees");
        let mut row = Row::new("normal_decode", method, &domain);
        let angle = degrees_between(found, [0.0, 0.0, 1.0]);
        (row.error_max, row.at) = (Some(angle), Some(format!("texel = {code:?}")));
        row.note = Some(format!("the normal that is read: {found:.4?}"));
        row.not_finite = Some(u64::from(!found.iter().all(|x| x.is_finite())));
        row
    };
    texels.into_iter().flat_map(|texel| methods.map(|method| row(texel, method))).collect()
}

/// The height field over texture coordinates, 0..1, and its slopes.
fn field([u, v]: [f64; 2]) -> f64 {
    let tau = std::f64::consts::TAU;
    0.5 + 0.4 * (2.0 * tau * u).sin() * (tau * v).cos() + 0.05 * (5.0 * tau * (u + v)).sin()
}

fn slopes([u, v]: [f64; 2]) -> [f64; 2] {
    const STEP: f64 = 1e-5;
    let by = |du: f64, dv: f64| (field([u + du, v + dv]) - field([u - du, v - dv])) / (2.0 * STEP);
    [by(STEP, 0.0), by(0.0, STEP)]
}

/// Height of the field's white over its black, in edges of the texture.
const DEPTH: f64 = 0.05;
/// A pixel of a picture of 400 pixels that shows the texture once.
const PIXEL: f64 = 1.0 / 400.0;
/// Squares along a side of the moved mesh.
const SQUARES: f64 = 64.0;

/// The shading normal of a relief on a square, seen from 30 degrees aside: where the line of sight meets the relief, against the
/// relief's own normal there.
fn heights(count: usize) -> Vec<Row> {
    const DOMAIN: &str = "waves 0.05 high on a square of 1, seen 30 deg aside, pixels of 1/400; angle to the relief's normal where \
                          the line of sight meets it, in degrees";
    // v runs down, against y.
    let normal = |[u, v]: [f64; 2]| normal_from_slopes(DEPTH * u, -DEPTH * v);
    let view = unit([0.5, 0.0, 0.866_025_403_784]);
    let (up, tangent) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]);
    let offset = parallax_offset(view, up, tangent, DEPTH);
    // What each method makes of the pixel whose line of sight enters the relief's top at a place of the unit square.
    let angles = |place: [f64; 2]| -> [f64; HEIGHTS.len()] {
        let enters = place.map(|x| 0.15 + 0.7 * x);
        let seen = traced(enters, offset);
        let truth = normal(slopes(seen));
        // A moved mesh is hit where the relief is, but for what its squares leave out.
        let corners = [0, 1].map(|i| (seen[i] * SQUARES).floor() / SQUARES);
        let coarse = |u: f64, v: f64| {
            let [s, t] = [(u - corners[0]) * SQUARES, (v - corners[1]) * SQUARES];
            let at = |i: f64, j: f64| field([corners[0] + i / SQUARES, corners[1] + j / SQUARES]);
            if s + t <= 1.0 {
                at(0.0, 0.0) + s * (at(1.0, 0.0) - at(0.0, 0.0)) + t * (at(0.0, 1.0) - at(0.0, 0.0))
            } else {
                at(1.0, 1.0) + (1.0 - s) * (at(0.0, 1.0) - at(1.0, 1.0)) + (1.0 - t) * (at(1.0, 0.0) - at(1.0, 1.0))
            }
        };
        const STEP: f64 = 1e-7;
        let [u, v] = [0, 1].map(|i| corners[i] + ((seen[i] - corners[i]) * SQUARES).clamp(0.01, 0.98) / SQUARES);
        let face = normal([(coarse(u + STEP, v) - coarse(u, v)) / STEP, (coarse(u, v + STEP) - coarse(u, v)) / STEP]);
        // Differences between neighbouring pixels of the height that the pixel reads.
        let height = |du: f64, dv: f64| DEPTH * field([seen[0] + du, seen[1] + dv]);
        let (h_x, h_y) = (height(PIXEL, 0.0) - height(0.0, 0.0), height(0.0, PIXEL) - height(0.0, 0.0));
        let derived = normal_from_height([PIXEL, 0.0, 0.0], [0.0, -PIXEL, 0.0], up, h_x, h_y);
        let parallax = normal(slopes(parallax_occlusion(field, enters, offset)));
        [up, derived, face, parallax, normal(slopes(enters))].map(|n| degrees_between(n, truth))
    };
    let at = |place: [f64; 2]| format!("uv where the line of sight enters = {:?}", place.map(|x| 0.15 + 0.7 * x));
    let place = |k: usize| [0.754_877_666, 0.569_840_291].map(|step: f64| (0.5 + step * k as f64).fract());
    let drawn: Vec<_> = (0..count).into_par_iter().map(|k| (place(k), angles(place(k)))).collect();
    let row = |(method, name): (usize, &&str)| {
        let own: Vec<_> = drawn.iter().map(|(place, angles)| (*place, angles[method])).collect();
        let mut row = Row::new("height_normals", name, DOMAIN);
        RELIEF.errors_of(own, |place| angles(place)[method], at).fill(&mut row);
        if ["report", "derived", "moved vertices, their own normals"].contains(name) {
            row.note = Some(MOVING.to_owned());
        }
        row
    };
    HEIGHTS.par_iter().enumerate().map(row).collect()
}

/// What gives a relief its normals.
const HEIGHTS: [&str; 5] =
    ["report", "derived", "moved vertices, their own normals", "parallax occlusion", "normal map without parallax"];

/// How much is searched for the largest error on a relief.
const RELIEF: Search = Search { starts: 8, rounds: 8 };

/// Radius of a ball raised by rings, at an angle from its pole.
fn rings(theta: f64) -> f64 {
    1.0 + DEPTH * (0.5 + 0.5 * (12.0 * theta).cos())
}

/// The shading normal of rings on a ball, where the surface under the height map is bent itself: the ball's normal, and the one
/// derived from neighbouring pixels of what was moved.
fn heights_on_ball(count: usize) -> Vec<Row> {
    const DOMAIN: &str =
        "rings 0.05 high, 12 around a ball of radius 1, pixels of 1/400; angle to the raised ball's normal in degrees";
    let direction = |theta: f64, phi: f64| tilted(theta.to_degrees(), phi);
    let angles = |[s, t]: [f64; 2]| -> [f64; 2] {
        let (theta, phi) = (0.2 + 2.7 * s, std::f64::consts::TAU * t);
        let up = direction(theta, phi);
        let moved = |theta: f64, phi: f64| direction(theta, phi).map(|x| rings(theta) * x);
        const STEP: f64 = 1e-6;
        let slope = (rings(theta + STEP) - rings(theta - STEP)) / (2.0 * STEP);
        let along = direction(theta + std::f64::consts::FRAC_PI_2, phi);
        let truth = unit(std::array::from_fn(|i| up[i] - slope / rings(theta) * along[i]));
        // Two directions of the screen, 30 degrees from the rings.
        let pixel = |a: f64, b: f64| [theta + PIXEL * a, phi + PIXEL * b / theta.sin()];
        let by = |[to_theta, to_phi]: [f64; 2]| {
            let (here, there) = (moved(theta, phi), moved(to_theta, to_phi));
            (std::array::from_fn(|i| there[i] - here[i]), rings(to_theta) - rings(theta))
        };
        let ((p_x, h_x), (p_y, h_y)) = (by(pixel(0.5, 0.866)), by(pixel(0.866, -0.5)));
        [up, normal_from_height(p_x, p_y, up, h_x, h_y)].map(|n| degrees_between(n, truth))
    };
    let place = |k: usize| [0.754_877_666, 0.569_840_291].map(|step: f64| (0.5 + step * k as f64).fract());
    let at = |[s, t]: [f64; 2]| {
        format!("angle from the pole = {:?} deg, around it = {:?} deg", (0.2 + 2.7 * s).to_degrees(), 360.0 * t)
    };
    let row = |method: usize| {
        let mut row = Row::new("height_normals", HEIGHTS[method], DOMAIN);
        CHEAP.errors((0..count).map(place), |place| angles(place)[method], at).fill(&mut row);
        row.note = Some(MOVING.to_owned());
        row
    };
    vec![row(0), row(1)]
}

/// What the cost of moved vertices leaves out.
const MOVING: &str = "its cost is that of the fragment stage: moving the vertices of the mesh is not in it";

/// Where a line of sight that enters at `from` meets the relief: by steps, and by halving the one that crosses it. True geometry.
fn traced(from: [f64; 2], offset: [f64; 2]) -> [f64; 2] {
    const STEPS: usize = 400;
    let at = |t: f64| [from[0] + t * offset[0], from[1] + t * offset[1]];
    let is_below = |t: f64| field(at(t)) >= 1.0 - t;
    let Some(step) = (1..=STEPS).find(|&i| is_below(i as f64 / STEPS as f64)) else { return at(1.0) };
    let [mut above, mut below] = [step - 1, step].map(|i| i as f64 / STEPS as f64);
    for _ in 0..30 {
        let middle = 0.5 * (above + below);
        if is_below(middle) { below = middle } else { above = middle }
    }
    at(below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::inputs;

    /// Ten times as many normals, drawn by chance, find none that errs more, but for a little.
    #[test]
    fn largest_errors_of_codes_are_the_largest() {
        let mut state = 3_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut found = [0.0_f64; 2];
        for _ in 0..200_000 {
            let n = tilted(MOST_TILT * number(), std::f64::consts::TAU * number());
            let color = eight_bits(texel_from_normal(n));
            let read = [normal_from_texel(color, 1.0, false), normal_from_texel_two_channel(color, 1.0, false)];
            found = [0, 1].map(|i| found[i].max(degrees_between(read[i], n)));
        }
        let rows = decoded(20_000);
        // What a row says of its largest error can be put in again.
        let block = rows.iter().find(|row| row.method.ends_with("BC5")).expect("a row");
        assert!(block.error_max > Some(10.4), "{block:?}");
        let said: Vec<f64> = inputs(block.at.as_deref().expect("a place")).into_iter().flat_map(|(_, x)| x).collect();
        let again = block_error([said[0], said[1].to_radians(), said[2]]);
        assert!(block.error_max.is_some_and(|most| (most - again).abs() < 1e-6), "{again}, but {block:?}");
        for (method, found) in ["unorm", "two_channel"].into_iter().zip(found) {
            let row = rows.iter().find(|row| row.method == method).expect("a row");
            assert!(row.error_max.is_some_and(|said| said >= 0.97 * found), "{method}: {found}, but {row:?}");
        }
        assert!(found[1] > 1.5, "{found:?}");
    }

    #[test]
    fn derived_normals_are_near_the_relief_and_the_old_ones_are_not() {
        let rows = rows(Effort::Quick);
        let on_ball = |method: &str| {
            let is_own = |row: &&Row| row.method == method && row.domain.starts_with("rings");
            rows.iter().find(is_own).and_then(|row| row.error_rms).expect("a row")
        };
        assert!(on_ball("derived") < 1.0 && on_ball("report") > 10.0, "{} {}", on_ball("derived"), on_ball("report"));
        let rms = |term: &str, method: &str| {
            rows.iter()
                .find(|row| row.term == term && row.method == method)
                .and_then(|row| row.error_rms)
                .expect("a row")
        };
        assert!(rms("height_normals", "derived") < 1.0, "{}", rms("height_normals", "derived"));
        assert!(rms("height_normals", "report") > 5.0);
        assert!(rms("height_normals", "parallax occlusion") < rms("height_normals", "normal map without parallax"));
        assert!(rms("normal_decode", "unorm") < 0.5 && rms("normal_decode", "unorm, 16 bits") < 0.01);
        assert!(rows.iter().all(|row| row.not_finite.unwrap_or(0) == 0));
    }
}
