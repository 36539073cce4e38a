//! Cube maps: face rules, lookups without seams, halving.
//!
//! It knows nothing of lobes or files.

use rayon::prelude::*;

/// A cube map of linear Rec. 709 values.
///
/// Faces in the order +X -X +Y -Y +Z -Z, rows from the top, laid out as GPUs read them: sampling with a direction
/// in world space returns what arrives from there.
#[derive(Clone, Debug, PartialEq)]
pub struct Cube {
    /// Texels along an edge, at least 1.
    pub size: usize,
    /// `6 * size * size` values: face by face, row by row.
    pub texels: Vec<[f32; 3]>,
}

/// The direction, not normalised (its largest component is 1), through the point (s, t) of a face; s and t in -1..1, s to
/// the right and t down.
pub fn direction_from_face(face: usize, s: f64, t: f64) -> [f64; 3] {
    match face {
        0 => [1.0, -t, -s],
        1 => [-1.0, -t, s],
        2 => [s, 1.0, t],
        3 => [s, -1.0, -t],
        4 => [s, -t, 1.0],
        _ => [-s, -t, -1.0],
    }
}

/// The face that a direction meets, and where: (face, s, t) with s and t in -1..1.
pub fn face_from_direction(dir: [f64; 3]) -> (usize, f64, f64) {
    let [x, y, z] = dir;
    let [ax, ay, az] = dir.map(f64::abs);
    // The floor keeps the zero vector finite.
    if ax >= ay && ax >= az {
        let m = ax.max(f64::MIN_POSITIVE);
        if x >= 0.0 { (0, -z / m, -y / m) } else { (1, z / m, -y / m) }
    } else if ay >= az {
        if y >= 0.0 { (2, x / ay, z / ay) } else { (3, x / ay, -z / ay) }
    } else if z >= 0.0 {
        (4, x / az, -y / az)
    } else {
        (5, -x / az, -y / az)
    }
}

/// The solid angle, in sr, of a texel at column i, row j of a face of `size` texels.
///
/// The solid angle between the face's centre and the point (s, t) is atan(s t / sqrt(1 + s^2 + t^2)).
pub fn texel_solid_angle(size: usize, i: usize, j: usize) -> f64 {
    let corner = |i: usize, j: usize| {
        let (s, t) = (2.0 * i as f64 / size as f64 - 1.0, 2.0 * j as f64 / size as f64 - 1.0);
        (s * t).atan2((1.0 + s * s + t * t).sqrt())
    };
    corner(i, j) - corner(i + 1, j) - corner(i, j + 1) + corner(i + 1, j + 1)
}

impl Cube {
    /// A cube whose texels are `value(direction)` at the texel centres; the direction is unit.
    pub fn from_fn(size: usize, value: impl Fn([f64; 3]) -> [f32; 3] + Sync) -> Cube {
        Cube::from_texels(size, |face, i, j| value(unit(texel_direction(size, face, i as f64, j as f64))))
    }

    /// A cube whose texels are `value(face, column, row)`, computed row by row in parallel.
    pub(crate) fn from_texels(size: usize, value: impl Fn(usize, usize, usize) -> [f32; 3] + Sync) -> Cube {
        let size = size.max(1);
        Cube { size, texels: texels(size, value) }
    }

    /// The value in a direction, interpolated bilinearly, across edges too.
    pub fn sample(&self, dir: [f64; 3]) -> [f32; 3] {
        interpolated(self.size, dir, |index| self.texels[index])
    }

    fn at(&self, face: usize, i: usize, j: usize) -> [f32; 3] {
        self.texels[(face * self.size + j) * self.size + i]
    }

    /// Half the resolution (rounded down, at least 1): each texel the mean of the ones below it by solid angle.
    /// An odd size is read at the new texels' centres with bilinear interpolation.
    pub fn halved(&self) -> Cube {
        let size = (self.size / 2).max(1);
        if self.size % 2 == 1 {
            return Cube::from_fn(size, |dir| self.sample(dir));
        }
        Cube::from_texels(size, |face, i, j| {
            let mut sum = [0.0f64; 3];
            let mut area = 0.0;
            for (i, j) in [(2 * i, 2 * j), (2 * i + 1, 2 * j), (2 * i, 2 * j + 1), (2 * i + 1, 2 * j + 1)] {
                let weight = texel_solid_angle(self.size, i, j);
                let texel = self.at(face, i, j);
                area += weight;
                for k in 0..3 {
                    sum[k] += weight * f64::from(texel[k]);
                }
            }
            sum.map(|x| (x / area) as f32)
        })
    }

    /// The cube with another number of texels along an edge: halved while it is at least twice as large, then read at the
    /// new texels' centres. The same size gives the same texels.
    pub fn resized(&self, size: usize) -> Cube {
        let size = size.max(1);
        if size == self.size {
            return self.clone();
        }
        if self.size >= 2 * size {
            return self.halved().resized(size);
        }
        Cube::from_fn(size, |dir| self.sample(dir))
    }
}

/// `value(face, column, row)` for each texel of a cube, computed row by row in parallel.
pub(crate) fn texels<T: Copy + Default + Send>(size: usize, value: impl Fn(usize, usize, usize) -> T + Sync) -> Vec<T> {
    let mut texels = vec![T::default(); 6 * size * size];
    texels.par_chunks_mut(size).enumerate().for_each(|(line, row)| {
        let (face, j) = (line / size, line % size);
        for (i, texel) in row.iter_mut().enumerate() {
            *texel = value(face, i, j);
        }
    });
    texels
}

/// `value(column, row)` for the texels at the same place of the six faces, computed row by row in parallel.
pub(crate) fn texels_of_six<T: Copy + Default + Send>(
    size: usize,
    value: impl Fn(usize, usize) -> [T; 6] + Sync,
) -> Vec<T> {
    let mut texels = vec![T::default(); 6 * size * size];
    let mut faces: Vec<_> = texels.chunks_exact_mut(size * size).map(|face| face.chunks_exact_mut(size)).collect();
    let rows: Vec<Vec<&mut [T]>> = (0..size).map(|_| faces.iter_mut().flat_map(Iterator::next).collect()).collect();
    rows.into_par_iter().enumerate().for_each(|(j, mut row)| {
        for i in 0..size {
            for (face, texel) in row.iter_mut().zip(value(i, j)) {
                face[i] = texel;
            }
        }
    });
    texels
}

/// The map coordinates of the point (s, t) of each of the six faces: those of
/// [`equirect_from_direction`](crate::equirect::equirect_from_direction) of [`direction_from_face`], by a third of its work.
pub(crate) fn equirect_from_six_faces(s: f64, t: f64) -> [(f64, f64); 6] {
    use std::f64::consts::PI;
    // Turning by a face turns the azimuth by a quarter.
    let (azimuth, v) = (s.atan() / (2.0 * PI), (1.0 + s * s).sqrt().atan2(-t) / PI);
    let behind = if s >= 0.0 { 1.0 } else { 0.0 };
    let (around, from_pole) = (t.atan2(s) / (2.0 * PI), (s * s + t * t).sqrt().atan() / PI);
    [
        (0.5 - azimuth, v),
        (behind - azimuth, v),
        (0.5 + around, from_pole),
        (0.5 - around, 1.0 - from_pole),
        (0.75 - azimuth, v),
        (0.25 - azimuth, v),
    ]
}

/// The value in a direction, interpolated bilinearly between the texels `at(index)` of a cube, across its edges too.
pub(crate) fn interpolated<const N: usize>(size: usize, dir: [f64; 3], at: impl Fn(usize) -> [f32; N]) -> [f32; N] {
    let (face, s, t) = face_from_direction(dir);
    let (x, y) = ((s + 1.0) * 0.5 * size as f64 - 0.5, (t + 1.0) * 0.5 * size as f64 - 0.5);
    let (i, j) = (x.floor(), y.floor());
    let (wx, wy) = ((x - i) as f32, (y - j) as f32);
    let (i, j) = (i as isize, j as isize);
    let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| texel(size, face, i + dx, j + dy, &at));
    std::array::from_fn(|k| {
        let above = a[k] + (b[k] - a[k]) * wx;
        let below = c[k] + (d[k] - c[k]) * wx;
        above + (below - above) * wy
    })
}

/// The texel of a face, whose column or row may be one outside: then it is the neighbouring face's. At a corner of the
/// cube, where there is no fourth texel, it is the mean of the three.
fn texel<const N: usize>(size: usize, face: usize, i: isize, j: isize, at: &impl Fn(usize) -> [f32; N]) -> [f32; N] {
    let last = size as isize - 1;
    let (ci, cj) = (i.clamp(0, last), j.clamp(0, last));
    let index = |face: usize, i: usize, j: usize| (face * size + j) * size + i;
    match (i == ci, j == cj) {
        (true, true) => at(index(face, i as usize, j as usize)),
        (false, false) => {
            let three = [(ci, j), (i, cj), (ci, cj)].map(|(i, j)| texel(size, face, i, j, at));
            std::array::from_fn(|k| (three[0][k] + three[1][k] + three[2][k]) / 3.0)
        }
        _ => {
            // The point on the edge itself, a hair outside, has the same place along the edge on both faces.
            let place = |outside: isize, inside: isize| {
                if outside == inside {
                    (2.0 * outside as f64 + 1.0) / size as f64 - 1.0
                } else {
                    (1.0 + 1e-9) * if outside < 0 { -1.0 } else { 1.0 }
                }
            };
            let (face, s, t) = face_from_direction(direction_from_face(face, place(i, ci), place(j, cj)));
            let place = |x: f64| (((x + 1.0) * 0.5 * size as f64) as usize).min(size - 1);
            at(index(face, place(s), place(t)))
        }
    }
}

/// The direction, not normalised, through a point of a face given in texels; whole numbers are texel centres.
pub(crate) fn texel_direction(size: usize, face: usize, i: f64, j: f64) -> [f64; 3] {
    direction_from_face(face, (2.0 * i + 1.0) / size as f64 - 1.0, (2.0 * j + 1.0) / size as f64 - 1.0)
}

/// The unit vector along a vector that is not zero.
pub(crate) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equirect::equirect_from_direction;

    #[test]
    fn six_faces_agree_with_each() {
        for (s, t) in [(0.0, 0.0), (0.3, -0.7), (-0.3, -0.7), (1.0, 1.0), (-1.0, 0.2), (0.001, -0.999), (-0.5, 0.0)] {
            for (face, (u, v)) in equirect_from_six_faces(s, t).into_iter().enumerate() {
                let (x, y) = equirect_from_direction(direction_from_face(face, s, t));
                // u is a place on a circle.
                let across = (u - x).abs();
                assert!(across.min(1.0 - across) < 1e-12 && (v - y).abs() < 1e-12, "{face}: {u} {v} for {x} {y}");
            }
        }
    }
}
