//! A drawn picture, and how samples become its pixels: the same for every renderer. Nothing is drawn here.

/// A picture of linear radiance, Rec. 709. Row 0 is the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Radiance times alpha (premultiplied) and alpha, row by row.
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// A picture of nothing: radiance 0, alpha 0.
    pub fn clear(width: u32, height: u32) -> Picture {
        Picture { width, height, pixels: vec![[0.0; 4]; width as usize * height as usize] }
    }

    /// Writes a tile of samples into its pixels: each pixel is the plain mean of its `side` x `side` samples.
    /// `samples` has `tile.width * side` samples a row.
    pub fn resolve(&mut self, tile: Tile, side: u32, samples: &[[f32; 4]]) {
        let row = tile.width as usize * side as usize;
        let scale = 1.0 / f64::from(side * side);
        for y in 0..tile.height as usize {
            for x in 0..tile.width as usize {
                let mut sum = [0.0f64; 4];
                for line in 0..side as usize {
                    let start = (y * side as usize + line) * row + x * side as usize;
                    for sample in &samples[start..start + side as usize] {
                        for channel in 0..4 {
                            sum[channel] += f64::from(sample[channel]);
                        }
                    }
                }
                let at = (tile.y as usize + y) * self.width as usize + tile.x as usize + x;
                self.pixels[at] = sum.map(|channel| (channel * scale) as f32);
            }
        }
    }

    /// Copies a picture of a tile's size to the tile's place.
    pub fn put(&mut self, tile: Tile, part: &Picture) {
        for (y, row) in part.pixels.chunks_exact(tile.width as usize).enumerate() {
            let start = (tile.y as usize + y) * self.width as usize + tile.x as usize;
            self.pixels[start..start + row.len()].copy_from_slice(row);
        }
    }
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Cuts a picture into tiles of at most `edge` pixels a side, row by row.
pub fn tiles(width: u32, height: u32, edge: u32) -> Vec<Tile> {
    let edge = edge.max(1);
    let starts = |length: u32| (0..length).step_by(edge as usize);
    starts(height)
        .flat_map(|y| {
            starts(width).map(move |x| Tile { x, y, width: edge.min(width - x), height: edge.min(height - y) })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (width, height, edge) in [(1, 1, 1), (7, 5, 3), (8, 8, 8), (9, 2, 100), (5, 6, 1)] {
            let mut seen = vec![0; (width * height) as usize];
            for tile in tiles(width, height, edge) {
                assert!(tile.width <= edge && tile.height <= edge);
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        seen[(y * width + x) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&count| count == 1), "{width} x {height} by {edge}");
        }
    }

    #[test]
    fn a_part_goes_to_its_place() {
        let mut picture = Picture::clear(3, 3);
        let mut part = Picture::clear(2, 1);
        part.pixels[1] = [1.0; 4];
        picture.put(Tile { x: 1, y: 2, width: 2, height: 1 }, &part);
        assert_eq!(picture.pixels.iter().position(|pixel| pixel[0] == 1.0), Some(8));
        assert_eq!(picture.pixels.iter().filter(|pixel| pixel[0] == 1.0).count(), 1);
    }

    #[test]
    fn a_pixel_is_the_mean_of_its_samples() {
        let mut picture = Picture::clear(3, 2);
        let tile = Tile { x: 1, y: 1, width: 2, height: 1 };
        let samples = [1.0, 2.0, 10.0, 20.0, 3.0, 4.0, 30.0, 40.0].map(|x: f32| [x, -x, 0.0, 1.0]);
        picture.resolve(tile, 2, &samples);
        assert_eq!(picture.pixels[4], [2.5, -2.5, 0.0, 1.0]);
        assert_eq!(picture.pixels[5], [25.0, -25.0, 0.0, 1.0]);
        assert_eq!(picture.pixels.iter().filter(|pixel| pixel[3] != 0.0).count(), 2);
    }
}
