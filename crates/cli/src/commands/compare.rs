//! `halfvector compare`: how different two pictures are.

use std::path::{Path, PathBuf};

use halfvector_maps::color::linear_from_srgb;
use halfvector_reference::metrics::{Difference, FlipOptions, difference, flip_hdr, flip_ldr, magma};
use image::{ExtendedColorType, ImageEncoder};

use crate::failure::Failure;
use crate::output::{check_place, note, print, print_json, write_file};
use crate::picture_file::{PictureFormat, parse_picture_file};

/// Says how different a picture is from a reference: FLIP, root mean square, relative error.
///
/// Two .png files are compared as they are shown, two files of .exr or .hdr as radiance. FLIP is how different they look in
/// turns, 0 to 1: of display values (Andersson et al. 2020), or of radiance at all exposures at which the reference shows
/// anything (2021). RMSE and relative error are of the numbers in the files: sRGB codes over 255, or radiance.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:
  halfvector compare mine.exr reference.exr -o difference.png --format json")]
pub(crate) struct CompareArgs {
    /// The picture: .png, .exr or .hdr
    #[arg(value_name = "A")]
    picture: PathBuf,
    /// What it is compared with: the same kind of file, of the same size
    #[arg(value_name = "B")]
    reference: PathBuf,
    /// Writes FLIP of each pixel as a .png: black for none, over purple and orange, to pale yellow for 1
    #[arg(short, long, value_name = "HEATMAP")]
    output: Option<PathBuf>,
    /// How the figures are written
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Format {
    /// One figure a line
    #[default]
    Text,
    /// One JSON object
    Json,
}

/// A picture's numbers, and what they are.
struct Pixels {
    width: usize,
    height: usize,
    /// As the file has them, times alpha.
    numbers: Vec<[f64; 3]>,
    /// Whether they are sRGB codes over 255.
    displayed: bool,
}

/// Runs the command.
pub(crate) fn run(args: &CompareArgs) -> Result<u8, Failure> {
    if let Some(path) = &args.output {
        if parse_picture_file(&path.to_string_lossy()).map(|file| file.format) != Ok(PictureFormat::Png) {
            return Err(Failure::usage("the heat map is a .png file").at(path).try_to("a name that ends in .png"));
        }
        check_place(path)?;
    }
    let (test, reference) = (read(&args.picture)?, read(&args.reference)?);
    let differ = |why: String, remedy| {
        Err(Failure::input("the pictures cannot be compared").at(&args.reference).because(why).try_to(remedy))
    };
    if test.displayed != reference.displayed {
        return differ(
            "one file holds display values, the other radiance".to_owned(),
            "two .png files, or two files of .exr or .hdr",
        );
    }
    if (test.width, test.height) != (reference.width, reference.height) {
        return differ(
            format!(
                "it has {} x {} pixels, and {} has {} x {}",
                reference.width,
                reference.height,
                args.picture.display(),
                test.width,
                test.height
            ),
            "pictures of the same size",
        );
    }
    let errors = if test.displayed {
        let light =
            |pixels: &Pixels| -> Vec<[f64; 3]> { pixels.numbers.iter().map(|p| linear_from_srgb(*p)).collect() };
        flip_ldr(&light(&reference), &light(&test), test.width, FlipOptions::default())
    } else {
        flip_hdr(&reference.numbers, &test.numbers, test.width, FlipOptions::default())
    };
    let flip = Flip {
        kind: if test.displayed { "ldr" } else { "hdr" },
        mean: errors.iter().sum::<f64>() / errors.len() as f64,
        largest: errors.iter().copied().fold(0.0, f64::max),
    };
    let numbers = difference(&test.numbers, &reference.numbers, None);
    if let Some(path) = &args.output {
        write_file(path, &heat_map(&errors, test.width, path)?)?;
        note(format_args!("{}: FLIP of each pixel", path.display()));
    }
    match args.format {
        Format::Text => print(&text(&flip, &numbers))?,
        Format::Json => print_json(&json(&flip, &numbers, &test))?,
    }
    Ok(0)
}

/// FLIP of all pixels.
struct Flip {
    kind: &'static str,
    mean: f64,
    largest: f64,
}

fn text(flip: &Flip, numbers: &Difference) -> String {
    format!(
        "FLIP ({})       mean {:.6}  largest {:.6}\nRMSE             {:.6e}\nrelative error   {:.6e}\nmean difference  \
         {:+.4} %\nlargest          {:.6e}",
        flip.kind.to_uppercase(),
        flip.mean,
        flip.largest,
        numbers.rmse,
        numbers.relative,
        100.0 * numbers.mean_relative,
        numbers.largest
    )
}

fn json(flip: &Flip, numbers: &Difference, pixels: &Pixels) -> serde_json::Value {
    serde_json::json!({
        "width": pixels.width,
        "height": pixels.height,
        "flip": {"kind": flip.kind, "mean": flip.mean, "largest": flip.largest},
        "rmse": numbers.rmse,
        "relative": numbers.relative,
        "mean_relative": numbers.mean_relative,
        "largest": numbers.largest,
    })
}

fn read(path: &Path) -> Result<Pixels, Failure> {
    let failed = |why: String| {
        Failure::input("the picture could not be read").at(path).because(why).try_to("a .png, .exr or .hdr file")
    };
    let format = parse_picture_file(&path.to_string_lossy()).map_err(failed)?.format;
    let image = image::open(path).map_err(|error| failed(error.to_string()))?;
    let (width, height) = (image.width() as usize, image.height() as usize);
    let displayed = format == PictureFormat::Png;
    let numbers: Vec<[f64; 3]> = image
        .into_rgba32f()
        .pixels()
        .map(|pixel| {
            let [r, g, b, a] = pixel.0.map(f64::from);
            // A PNG's colour is not multiplied by its alpha yet.
            let alpha = if displayed { a } else { 1.0 };
            [r * alpha, g * alpha, b * alpha]
        })
        .collect();
    if let Some(i) = numbers.iter().position(|pixel| !pixel.iter().all(|x| x.is_finite())) {
        return Err(Failure::input("a picture with numbers that are not finite cannot be compared")
            .at(path)
            .because(format!("the first is at column {}, row {}", i % width, i / width))
            .try_to("another picture"));
    }
    Ok(Pixels { width, height, numbers, displayed })
}

fn heat_map(errors: &[f64], width: usize, path: &Path) -> Result<Vec<u8>, Failure> {
    let codes: Vec<u8> = errors.iter().flat_map(|error| magma(*error)).collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(&codes, width as u32, (errors.len() / width) as u32, ExtendedColorType::Rgb8)
        .map_err(|error| Failure::input("the heat map could not be coded").at(path).because(error))?;
    Ok(bytes)
}
