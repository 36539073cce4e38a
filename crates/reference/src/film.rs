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
    /// Standard error of each channel of radiance: from the spread of the pixel's own samples, which are independent. None for fewer
    /// than two samples, which have no spread. Of n samples it is itself known to a share of about 1 / sqrt(2 n - 2): 71 % of two, 18 % of
    /// sixteen.
    pub standard_error: Option<Vec<[f64; 3]>>,
}

impl Picture {
    pub(crate) fn new(width: u32, height: u32, samples: u64, film: &[Pixel]) -> Picture {
        let n = samples.max(1) as f64;
        let error = |pixel: &Pixel, i: usize| {
            let mean = pixel.sum[i] / n;
            let variance = (pixel.square[i] / n - mean * mean).max(0.0);
            (variance / (n - 1.0)).sqrt()
        };
        let errors = || film.iter().map(|pixel| std::array::from_fn(|i| error(pixel, i))).collect();
        Picture {
            width,
            height,
            samples,
            pixels: film.iter().map(|pixel| pixel.sum.map(|x| x / n)).collect(),
            standard_error: (samples > 1).then(errors),
        }
    }

    /// The standard error as a share of the light, of all pixels together: 0.01 is noise of a hundredth. None where there is no standard
    /// error, or no light.
    pub fn noise(&self) -> Option<f64> {
        let noise: f64 = self.standard_error.as_ref()?.as_flattened().iter().sum();
        let light: f64 = self.pixels.iter().flat_map(|pixel| &pixel[..3]).sum();
        (light > 0.0).then_some(noise / light)
    }

    /// The radiance without alpha.
    pub fn radiance(&self) -> Vec<[f64; 3]> {
        self.pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
    }
}
