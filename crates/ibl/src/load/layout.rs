//! How a picture holds an environment: one map of all directions, or the six faces of a cube side by side.
//!
//! The shape of the picture decides. Cells of crosses and strips are faces by the GPU's own rules, as in KTX2 files.

use crate::cube::Cube;
use crate::equirect::Equirect;

/// How the picture or file held the environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One map of all directions; every picture that is none of the following.
    Equirect,
    /// 4 x 3 cells: +Y above and -Y below the second of -X +Z +X -Z. The other six cells are of one colour.
    HorizontalCross,
    /// 3 x 4 cells: +Y above -X +Z +X, below +Z first -Y, then -Z turned by half a turn. The other six cells are of one
    /// colour.
    VerticalCross,
    /// 6 x 1 cells: +X -X +Y -Y +Z -Z.
    HorizontalStrip,
    /// 1 x 6 cells: +X -X +Y -Y +Z -Z.
    VerticalStrip,
    /// A file of cube faces, or six files.
    Faces,
}

impl std::fmt::Display for Layout {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Layout::Equirect => "an equirectangular map",
            Layout::HorizontalCross => "a horizontal cross of cube faces",
            Layout::VerticalCross => "a vertical cross of cube faces",
            Layout::HorizontalStrip => "a horizontal strip of cube faces",
            Layout::VerticalStrip => "a vertical strip of cube faces",
            Layout::Faces => "six cube faces",
        })
    }
}

/// Columns and rows of cells, the cell of each face, whether -Z is turned by half a turn.
struct Grid {
    layout: Layout,
    cells: [usize; 2],
    faces: [[usize; 2]; 6],
    last_turned: bool,
}

const GRIDS: [Grid; 4] = [
    Grid {
        layout: Layout::HorizontalCross,
        cells: [4, 3],
        faces: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]],
        last_turned: false,
    },
    Grid {
        layout: Layout::VerticalCross,
        cells: [3, 4],
        faces: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]],
        last_turned: true,
    },
    Grid {
        layout: Layout::HorizontalStrip,
        cells: [6, 1],
        faces: [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]],
        last_turned: false,
    },
    Grid {
        layout: Layout::VerticalStrip,
        cells: [1, 6],
        faces: [[0, 0], [0, 1], [0, 2], [0, 3], [0, 4], [0, 5]],
        last_turned: false,
    },
];

/// The cube that a picture holds side by side, and how; `None` when it is one map.
pub(super) fn cube_in_picture(picture: &Equirect) -> Option<(Cube, Layout)> {
    GRIDS.iter().find_map(|grid| {
        let [columns, rows] = grid.cells;
        let size = picture.width / columns;
        if size == 0 || size * columns != picture.width || size * rows != picture.height || !grid.rest_is_blank(picture)
        {
            return None;
        }
        let cube = Cube::from_texels(size, |face, i, j| {
            let [column, row] = grid.faces[face];
            let (i, j) = if face == 5 && grid.last_turned { (size - 1 - i, size - 1 - j) } else { (i, j) };
            picture.pixels[(row * size + j) * picture.width + column * size + i]
        });
        Some((cube, grid.layout))
    })
}

impl Grid {
    /// Whether the cells without a face are of one colour, but for what lossy coding leaves: else a picture of this
    /// shape is no cross.
    fn rest_is_blank(&self, picture: &Equirect) -> bool {
        /// Coding noise, as a difference and relative to the value.
        const NOISE: f32 = 0.02;
        let [columns, rows] = self.cells;
        let size = picture.width / columns;
        let blank: Vec<[usize; 2]> =
            (0..columns * rows).map(|k| [k % columns, k / columns]).filter(|cell| !self.faces.contains(cell)).collect();
        let texel = |[column, row]: [usize; 2], k: usize| {
            picture.pixels[(row * size + k / size) * picture.width + column * size + k % size]
        };
        let Some(&first) = blank.first() else { return true };
        // The middle of a cell is the farthest from what coding smears over its edges.
        let color = texel(first, (size / 2) * size + size / 2);
        let differs = |x: f32, y: f32| x.is_finite() && (x - y).abs() > NOISE * (1.0 + y.abs());
        let different = blank
            .iter()
            .flat_map(|&cell| (0..size * size).map(move |k| texel(cell, k)))
            .filter(|texel| (0..3).any(|c| differs(texel[c], color[c])))
            .count();
        different * 50 <= blank.len() * size * size
    }
}

/// The levels that stand below each other in a picture, each a row of its six faces, each half as large as the one before:
/// the inverse of [`strip`](crate::save::strip). `None` when the picture has not the size for them.
pub(super) fn levels_in_strip(picture: &Equirect, count: usize) -> Option<Vec<Cube>> {
    let size = picture.width / 6;
    let sizes: Vec<usize> = (0..count.min(32)).map(|level| (size >> level).max(1)).collect();
    if count == 0 || size * 6 != picture.width || sizes.len() != count || sizes.iter().sum::<usize>() != picture.height
    {
        return None;
    }
    let mut top = 0;
    let levels = sizes.into_iter().map(|size| {
        let start = top;
        top += size;
        Cube::from_texels(size, |face, i, j| picture.pixels[(start + j) * picture.width + face * size + i])
    });
    Some(levels.collect())
}

/// The signs of the faces, in their order.
pub(super) const FACE_NAMES: [&str; 6] = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of which no two texels are alike, put into each grid cell by cell, comes out again; and the cells that
    /// touch in a cross are continuous there.
    #[test]
    fn cells_stand_where_the_layouts_say() {
        let cube = Cube::from_fn(8, |d| d.map(|x| x as f32));
        for grid in &GRIDS {
            let [columns, rows] = grid.cells;
            let mut picture =
                Equirect { width: 8 * columns, height: 8 * rows, pixels: vec![[0.5; 3]; 64 * columns * rows] };
            for (face, [column, row]) in grid.faces.into_iter().enumerate() {
                for k in 0..64 {
                    let from = if face == 5 && grid.last_turned { 63 - k } else { k };
                    picture.pixels[(row * 8 + k / 8) * picture.width + column * 8 + k % 8] =
                        cube.texels[face * 64 + from];
                }
            }
            assert_eq!(cube_in_picture(&picture), Some((cube.clone(), grid.layout)));

            if rows > 1 && columns > 1 {
                // Neighbouring texels of the cross are neighbours on the sphere: at most a texel's width apart.
                for k in 0..picture.pixels.len() - picture.width {
                    for next in [k + picture.width, k + 1] {
                        let (a, b) = (picture.pixels[k], picture.pixels[next]);
                        let blank = a == [0.5; 3] || b == [0.5; 3] || next == k + 1 && next % picture.width == 0;
                        let distance: f32 = (0..3).map(|c| (a[c] - b[c]).powi(2)).sum();
                        assert!(blank || distance < 0.3 * 0.3, "{} at {k}: {a:?} beside {b:?}", grid.layout);
                    }
                }
                // With something in the blank cells it is a picture that merely has this shape.
                picture.pixels[..8 * picture.width].iter_mut().enumerate().for_each(|(k, p)| p[0] = k as f32);
                assert_eq!(cube_in_picture(&picture), None);
            }
        }
        let map = Equirect { width: 16, height: 8, pixels: vec![[1.0; 3]; 128] };
        assert_eq!(cube_in_picture(&map), None);
    }
}
