//! What has been seen so far: sums over the samples of each pixel, and the picture with its standard error.

/// Sums over the samples of one pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pixel {
    /// Radiance times alpha, and alpha.
    sum: [f64; 4],
    /// Squares of the radiance.
    square: [f64; 3],
}

impl Pixel {
    pub(crate) fn add(&mut self, radiance: [f64; 3], alpha: f64) {
        for (i, x) in radiance.into_iter().enumerate() {
            self.sum[i] += x;
            self.square[i] += x * x;
        }
        self.sum[3] += alpha;
    }
}

/// A picture of linear radiance, Rec. 709, with what is known of its noise. Row 0 is the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Paths traced for each pixel.
    pub samples: u64,
    /// Radiance times alpha (premultiplied) and alpha, row by row.
    pub pixels: Vec<[f64; 4]>,
    /// Standard error of each channel of radiance: from the spread of the pixel's own samples, which are independent. 0
    /// for fewer than two samples.
    pub standard_error: Vec<[f64; 3]>,
}

impl Picture {
    pub(crate) fn new(width: u32, height: u32, samples: u64, film: &[Pixel]) -> Picture {
        let n = samples.max(1) as f64;
        let error = |pixel: &Pixel, i: usize| {
            let mean = pixel.sum[i] / n;
            let variance = (pixel.square[i] / n - mean * mean).max(0.0);
            if samples < 2 { 0.0 } else { (variance / (n - 1.0)).sqrt() }
        };
        Picture {
            width,
            height,
            samples,
            pixels: film.iter().map(|pixel| pixel.sum.map(|x| x / n)).collect(),
            standard_error: film.iter().map(|pixel| std::array::from_fn(|i| error(pixel, i))).collect(),
        }
    }

    /// The radiance without alpha.
    pub fn radiance(&self) -> Vec<[f64; 3]> {
        self.pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
    }
}
