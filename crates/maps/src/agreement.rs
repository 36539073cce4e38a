//! Whether a normal map and a height map tell of the same surface, and which way the normal map's green runs.
//! Reads files as they are made; does not mend them.

use rayon::prelude::*;

use crate::image::Image;
use crate::mip::{ColorSpace, MapKind, mip_chain};

/// Which way green runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GreenSign {
    /// Up the picture, along the bitangent (OpenGL, glTF).
    PlusY,
    /// Down the picture (DirectX).
    MinusY,
    /// The two maps do not say: they are unrelated, flat, or too small.
    Unknown,
}

/// What the comparison found. Correlations are Pearson's, over all texels but those on the edge, between the slope that
/// the normal map says and the slope of the height map (white is high); +1 where they are the same but for a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Which way green most likely runs.
    pub green_sign: GreenSign,
    /// Correlation of x slopes; negative where red is mirrored.
    pub red: f64,
    /// Correlation of y slopes as a +Y map has them. Its size is the confidence of `green_sign`.
    pub green: f64,
    /// Height of white over black, in texels, that brings the slopes together best.
    pub height_in_texels: f64,
    /// Mean angle in degrees between the map's normals, green turned as found, and those of the height at that scale.
    pub mean_degrees: f64,
}

impl Agreement {
    /// Correlation below which nothing is said about a sign: three standard deviations of what two unrelated maps of a
    /// hundred features show by chance.
    pub const LEAST_CORRELATION: f64 = 0.3;

    /// Whether the maps tell of one surface: x and y correlate by more than [`Self::LEAST_CORRELATION`], x the right way.
    pub fn maps_agree(&self) -> bool {
        self.green_sign != GreenSign::Unknown && self.red > Self::LEAST_CORRELATION
    }
}

/// Slopes beyond this (79 degrees) are compression's more than the surface's.
const STEEPEST: f64 = 5.0;

/// Fewest texels a side, and in all, that something is said about.
const LEAST_SIDE: u32 = 8;

/// Compares a normal map (2 c - 1) with the red channel of a height map of the same proportions; the larger is averaged
/// down to the size of the other. `None` where the proportions differ or a side has fewer than 8 texels.
pub fn agreement(normal: &Image, height: &Image) -> Option<Agreement> {
    let (normal, height) = same_size(normal, height)?;
    let (width, rows) = (normal.width(), normal.height());
    if width.min(rows) < LEAST_SIDE {
        return None;
    }
    let at = |x: u32, y: u32| f64::from(height.texel(x, y)[0]);
    let slopes = |x: u32, y: u32| {
        let [r, g, b, _] = normal.texel(x, y).map(|c| 2.0 * f64::from(c) - 1.0);
        let slope = |t: f64| if b > 0.0 { (t / b).clamp(-STEEPEST, STEEPEST) } else { 0.0 };
        // Against x the height falls where the normal leans along it; rows count downwards and +Y up.
        ([slope(r), slope(g)], [(at(x - 1, y) - at(x + 1, y)) / 2.0, (at(x, y + 1) - at(x, y - 1)) / 2.0])
    };
    let rows_inside = || (1..rows - 1).into_par_iter();
    let moments = rows_inside()
        .map(|y| {
            let mut row = [Moments::default(); 2];
            for x in 1..width - 1 {
                let (map, field) = slopes(x, y);
                (0..2).for_each(|k| row[k].add(map[k], field[k]));
            }
            row
        })
        .reduce(|| [Moments::default(); 2], |a, b| [a[0].plus(&b[0]), a[1].plus(&b[1])]);
    let [red, green] = moments.map(|m| m.correlation());
    let green_sign = if green.abs() < Agreement::LEAST_CORRELATION {
        GreenSign::Unknown
    } else if green > 0.0 {
        GreenSign::PlusY
    } else {
        GreenSign::MinusY
    };
    let turn = if green < 0.0 { -1.0 } else { 1.0 };
    let over = moments[0].xy + turn * moments[1].xy;
    let under = moments[0].yy + moments[1].yy;
    let height_in_texels = if under > 0.0 { over / under } else { 0.0 };
    let degrees = |x: u32, y: u32| {
        let ([mx, my], [hx, hy]) = slopes(x, y);
        let (hx, hy) = (height_in_texels * hx, height_in_texels * hy);
        let cosine = (mx * hx + turn * my * hy + 1.0) / ((mx * mx + my * my + 1.0) * (hx * hx + hy * hy + 1.0)).sqrt();
        cosine.min(1.0).acos().to_degrees()
    };
    let count = f64::from(width - 2) * f64::from(rows - 2);
    // Rows one after the other, so that the sum does not depend on how the work was split.
    let by_row: Vec<f64> = rows_inside().map(|y| (1..width - 1).map(|x| degrees(x, y)).sum()).collect();
    Some(Agreement { green_sign, red, green, height_in_texels, mean_degrees: by_row.iter().sum::<f64>() / count })
}

/// Both at the size of the smaller, by their mip levels.
fn same_size(normal: &Image, height: &Image) -> Option<(Image, Image)> {
    let size = |image: &Image| [image.width(), image.height()];
    let reduced = |image: &Image, kind, to: [u32; 2]| {
        if size(image) == to {
            return Some(image.clone());
        }
        mip_chain(image, ColorSpace::Linear, kind).into_iter().find(|level| size(level) == to)
    };
    if normal.width() > height.width() {
        Some((reduced(normal, MapKind::Normal, size(height))?, height.clone()))
    } else {
        Some((normal.clone(), reduced(height, MapKind::Data, size(normal))?))
    }
}

/// Sums over pairs (x, y).
#[derive(Clone, Copy, Default)]
struct Moments {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    yy: f64,
    xy: f64,
}

impl Moments {
    fn add(&mut self, x: f64, y: f64) {
        *self = self.plus(&Self { n: 1.0, x, y, xx: x * x, yy: y * y, xy: x * y });
    }

    fn plus(&self, o: &Self) -> Self {
        Self {
            n: self.n + o.n,
            x: self.x + o.x,
            y: self.y + o.y,
            xx: self.xx + o.xx,
            yy: self.yy + o.yy,
            xy: self.xy + o.xy,
        }
    }

    /// Pearson's; 0 where one of the two does not vary (but for rounding).
    fn correlation(&self) -> f64 {
        let (vx, vy) = (self.xx - self.x * self.x / self.n, self.yy - self.y * self.y / self.n);
        if vx > 1e-9 * self.n && vy > 1e-12 * self.n {
            (self.xy - self.x * self.y / self.n) / (vx * vy).sqrt()
        } else {
            0.0
        }
    }
}
