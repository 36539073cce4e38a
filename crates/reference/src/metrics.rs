//! How different two pictures are: root mean square, relative error, FLIP; with the pictures' own noise taken out where
//! it is known.

mod difference;
mod flip;
mod noise;
mod palette;

pub use difference::{Difference, Scores, difference, scores};
pub use flip::{FLIP_PIXELS_PER_DEGREE, Flip, FlipOptions, Noisy, flip_hdr, flip_ldr, flip_of_noise};
pub use noise::{Beyond, CleanSquares, NoisyError, beyond_noise, noisy_error, surroundings};
pub use palette::magma;
