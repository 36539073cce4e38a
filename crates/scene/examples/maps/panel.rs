//! The maps of a riveted metal panel: painted plates, worn to the metal at their edges, rusty in the joints. Everything is
//! a function of the place and repeats at the borders.

use image::{DynamicImage, GrayImage, Luma, RgbImage};

use super::noise::{blend, fractal, hash, mix, noise, smooth, wrapped};
use super::{byte, height_map};

/// Edge of the maps in texels.
const SIZE: u32 = 512;
/// Edge of the height map, whose 16 bits cost more.
const HEIGHT_SIZE: u32 = 256;
/// Height between black and white over the edge of the tile, as the normal map has it.
const RELIEF: f64 = 0.035;
/// Plates along each edge of the tile.
const PLATES: f64 = 2.0;

/// File name and picture of each map: albedo (sRGB), roughness, metalness, normal (+Y), height (16 bits).
pub(super) fn maps() -> Vec<(&'static str, DynamicImage)> {
    let at =
        |x: u32, y: u32, size: u32| [(f64::from(x) + 0.5) / f64::from(size), (f64::from(y) + 0.5) / f64::from(size)];
    let albedo = RgbImage::from_fn(SIZE, SIZE, |x, y| image::Rgb(look(at(x, y, SIZE)).albedo.map(byte)));
    let roughness = GrayImage::from_fn(SIZE, SIZE, |x, y| Luma([byte(look(at(x, y, SIZE)).roughness)]));
    let metalness = GrayImage::from_fn(SIZE, SIZE, |x, y| Luma([byte(look(at(x, y, SIZE)).metalness)]));
    let normal = RgbImage::from_fn(SIZE, SIZE, |x, y| image::Rgb(normal(at(x, y, SIZE)).map(|c| byte(0.5 + 0.5 * c))));
    let height = height_map(HEIGHT_SIZE, height);
    vec![
        ("panel_albedo.png", albedo.into()),
        ("panel_roughness.png", roughness.into()),
        ("panel_metalness.png", metalness.into()),
        ("panel_normal.png", normal.into()),
        ("panel_height.png", height),
    ]
}

/// What the surface is at a place.
struct Look {
    /// sRGB-coded.
    albedo: [f64; 3],
    roughness: f64,
    metalness: f64,
}

/// Distances that the pattern is made of, in widths of a plate.
struct Pattern {
    /// To the nearest joint: 0 in it, 0.5 in the plate's middle.
    joint: f64,
    /// Outside of the raised middle of the plate when positive.
    raised: f64,
    /// To the middle of the nearest rivet.
    rivet: f64,
}

fn pattern([u, v]: [f64; 2]) -> Pattern {
    let (x, y) = ((u * PLATES).fract(), (v * PLATES).fract());
    let (from_x, from_y) = (x.min(1.0 - x), y.min(1.0 - y));
    // A square with round corners.
    let (half, corner) = (0.27, 0.08);
    let (dx, dy) = (((x - 0.5).abs() - half + corner).max(0.0), ((y - 0.5).abs() - half + corner).max(0.0));
    let raised = (dx * dx + dy * dy).sqrt() - corner;
    // Rivets along the border, five on each side.
    let step = 0.2;
    let nearest = |t: f64| (((t - 0.1) / step + 0.5).floor() * step + 0.1).clamp(0.1, 0.9);
    let distance = |rx: f64, ry: f64| ((x - rx) * (x - rx) + (y - ry) * (y - ry)).sqrt();
    let side = |t: f64| if t < 0.5 { 0.1 } else { 0.9 };
    let rivet = distance(nearest(x), side(y)).min(distance(side(x), nearest(y)));
    Pattern { joint: from_x.min(from_y), raised, rivet }
}

const RIVET_RADIUS: f64 = 0.042;

/// 0 to 1.
fn height(place: [f64; 2]) -> f64 {
    let Pattern { joint, raised, rivet } = pattern(place);
    let plate = 0.5 * smooth(0.006, 0.03, joint);
    let middle = 0.2 * smooth(0.03, -0.005, raised);
    let inside = (1.0 - (rivet / RIVET_RADIUS) * (rivet / RIVET_RADIUS)).max(0.0);
    let dome = 0.27 * inside.sqrt() * smooth(0.0, 0.2, inside);
    // A shallow dent around each rivet, and sheet that is not quite flat.
    let dent = 0.03 * smooth(0.1, 0.04, rivet) * (1.0 - smooth(0.0, 0.2, inside));
    let waves = 0.03 * (noise(place, 6, 1) - 0.5);
    (plate + middle + dome - dent + waves + 0.02).clamp(0.0, 1.0)
}

/// Unit, +Y up the picture. A bump of the map is a bump of the surface.
fn normal([u, v]: [f64; 2]) -> [f64; 3] {
    let e = 0.5 / f64::from(SIZE);
    let slope_u = (height([u + e, v]) - height([u - e, v])) / (2.0 * e) * RELIEF;
    let slope_v = (height([u, v + e]) - height([u, v - e])) / (2.0 * e) * RELIEF;
    let length = (slope_u * slope_u + slope_v * slope_v + 1.0).sqrt();
    // v runs down.
    [-slope_u / length, slope_v / length, 1.0 / length]
}

fn look(place: [f64; 2]) -> Look {
    let Pattern { joint, raised, rivet } = pattern(place);
    let coarse = fractal(place, 5, 3, 2);
    let fine = fractal(place, 17, 3, 3);
    // The paint is gone on edges and rivets, and in a few scratches.
    let edge = smooth(0.022, 0.0, (raised - 0.005).abs()).max(smooth(0.055, 0.028, joint));
    let on_rivet = smooth(RIVET_RADIUS, 0.6 * RIVET_RADIUS, rivet);
    let wear = 0.55 * edge + 0.62 * on_rivet + 0.75 * (fine - 0.5) + 0.35 * (coarse - 0.5);
    let bare = smooth(0.36, 0.46, wear).max(0.9 * scratches(place));
    let rust = smooth(
        0.5,
        0.62,
        0.62 * smooth(0.05, 0.0, joint)
            + 0.3 * smooth(0.075, 0.045, rivet) * (1.0 - on_rivet)
            + 0.55 * (fractal(place, 9, 3, 4) - 0.42),
    );

    let paint = blend([0.13, 0.42, 0.45], [0.17, 0.5, 0.52], coarse);
    let metal = blend([0.74, 0.73, 0.71], [0.82, 0.81, 0.79], fine);
    let rusty = blend([0.26, 0.12, 0.06], [0.52, 0.27, 0.12], fine);
    let dirt = 0.3 * smooth(0.12, 0.02, joint) + 0.12 * smooth(0.08, 0.05, rivet);
    let albedo = blend(blend(blend(paint, metal, bare), rusty, rust), [0.09, 0.08, 0.07], dirt);
    let roughness = mix(mix(0.34 + 0.1 * coarse, 0.24 + 0.16 * fine, bare), 0.86, rust);
    Look { albedo, roughness: roughness + 0.2 * dirt, metalness: bare * (1.0 - rust) * (1.0 - 0.6 * dirt) }
}

/// Thin straight lines, each over a part of the tile.
fn scratches([u, v]: [f64; 2]) -> f64 {
    let mut strongest: f64 = 0.0;
    for i in 0..14 {
        let random = |salt: u32| f64::from(hash(i, salt, 77)) / f64::from(u32::MAX);
        let (cu, cv) = (random(0), random(1));
        // Lines are shorter than half of the tile, so that wrapped distances keep them whole.
        let (du, dv) = (wrapped(u - cu), wrapped(v - cv));
        let slope = 2.4 * random(2) - 1.2;
        let along = (du + slope * dv) / (1.0 + slope * slope).sqrt();
        let across = (dv - slope * du) / (1.0 + slope * slope).sqrt();
        let reach = 0.05 + 0.16 * random(3);
        let line = smooth(0.0019, 0.0006, across.abs()) * smooth(reach, 0.7 * reach, along.abs());
        strongest = strongest.max(line);
    }
    strongest
}
