//! `halfvector compare`: how different two pictures are.

use std::path::{Path, PathBuf};

use halfvector_maps::color::linear_from_srgb;
use halfvector_reference::metrics::{
    Beyond, Difference, FlipOptions, Noisy, beyond_noise, difference, flip_hdr, flip_ldr, flip_of_noise, magma,
    surroundings,
};
use image::{ExtendedColorType, ImageEncoder};

use crate::failure::Failure;
use crate::output::{check_place, note, print, print_json, write_file};
use crate::picture_file::{Noise, PictureFormat, noise, parse_picture_file};
use crate::reference::roughness;

/// Says how different a picture is from a reference: FLIP, root mean square, relative error.
///
/// Two .png files are compared as they are shown, two files of .exr or .hdr as radiance. FLIP is how different they look in
/// turns, 0 to 1: of display values (Andersson et al. 2020), or of radiance at all exposures at which the reference shows
/// anything (2021). RMSE and relative error are of the numbers in the files: sRGB codes over 255, or radiance.
///
/// An .exr of --backend reference holds the standard error of each pixel. RMSE and relative error are then what noise does not
/// explain, 0 where chance may explain all, with a bound that they hardly pass and the figure as it is with noise. (Relative is then
/// to the mean of the pixels around: a noisy pixel does not tell how bright it is.) The mean difference has its standard error; a
/// mean that chance does not explain counts in both errors, though each pixel's noise hides it. It is said what FLIP such noise alone
/// has: of a mean no larger than that noise may be all, and the other figures tell more. Two of the same --seed have noise in
/// common, and of a single path noise is not known: nothing is taken off then, and it is said.
///
/// FLIP of radiance looks at negative numbers as black, as a display shows them. (NVIDIA's program sends them through its tone
/// curve, where large ones become white.) Largest, RMSE and relative error count them as they are.
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
    /// Writes FLIP of each pixel as a .png: black for none, over purple and orange, to pale yellow for 1. Missing folders are made
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
    alpha: Vec<f64>,
    /// Standard error of each number, where the file has it.
    noise: Option<Noise>,
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
    let shared_seed = shared_seed(&test, &reference);
    if let Some(seed) = shared_seed {
        note(format_args!(
            "note: both pictures were drawn with --seed {seed}: their noise is not independent, and nothing is taken off; draw one \
             with another seed"
        ));
    }
    for (path, pixels) in [(&args.picture, &test), (&args.reference, &reference)] {
        let negative = pixels.numbers.as_flattened().iter().filter(|x| **x < 0.0).count();
        if negative > 0 {
            note(format_args!(
                "note: {}: {negative} numbers are negative; FLIP looks at them as black",
                path.display()
            ));
        }
    }
    let mut is_unknown = false;
    for (path, pixels) in [(&args.picture, &test), (&args.reference, &reference)] {
        let Some(own) = &pixels.noise else { continue };
        if own.errors.is_none() {
            is_unknown = true;
            note(format_args!(
                "note: {}: drawn with one path for each pixel: its noise is not known, and nothing is taken off; draw it with --samples 16 \
                 or more",
                path.display()
            ));
        } else if let Some(rough) = own.samples.and_then(roughness) {
            note(format_args!("note: {}: {rough}", path.display()));
        }
    }
    let noise = if shared_seed.is_some() || is_unknown { None } else { combined(&test, &reference) };
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
    let flip = Flip {
        kind: if test.displayed { "ldr" } else { "hdr" },
        mean: mean(&errors),
        largest: errors.iter().copied().fold(0.0, f64::max),
        of_noise: noise.as_ref().map(|_| {
            mean(&flip_of_noise(flip_hdr, noisy(&test), noisy(&reference), reference.width, FlipOptions::default()))
        }),
    };
    let numbers = Numbers {
        difference: difference(&test.numbers, &reference.numbers, None),
        is_black: reference.numbers.as_flattened().iter().sum::<f64>() <= 0.0,
        noise: noise.map(|noise| KnownNoise::of(&test, &reference, &noise)),
        shared_seed,
        alpha: AlphaDifference::of(&test.alpha, &reference.alpha),
    };
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
    /// Mean of what noise of the known standard errors alone has.
    of_noise: Option<f64>,
}

/// What the numbers say.
struct Numbers {
    difference: Difference,
    /// Nothing is relative to a reference without light.
    is_black: bool,
    noise: Option<KnownNoise>,
    /// What both pictures' noise was drawn with, where that is the same.
    shared_seed: Option<u64>,
    alpha: AlphaDifference,
}

/// What is known of the noise of a difference.
struct KnownNoise {
    /// Root mean square of the standard errors.
    rms: f64,
    rmse: Beyond,
    relative: Beyond,
    /// Standard error of the mean difference, relative as it is.
    of_mean: f64,
}

impl KnownNoise {
    fn of(test: &Pixels, reference: &Pixels, noise: &[[f64; 3]]) -> KnownNoise {
        let smooth = reference.noise.as_ref().map(|_| surroundings(&reference.numbers, reference.width));
        let brightness = smooth.as_deref().unwrap_or(&reference.numbers);
        let [rmse, relative] = beyond_noise(&test.numbers, &reference.numbers, noise, brightness);
        let variance: f64 = noise.as_flattened().iter().map(|s| s * s).sum();
        // The channels of a pixel err together: a path brings its noise to all of them.
        let of_sum: f64 = noise.iter().map(|error| error.iter().sum::<f64>().powi(2)).sum();
        let light: f64 = reference.numbers.as_flattened().iter().sum();
        let of_mean = if light > 0.0 { of_sum.sqrt() / light } else { 0.0 };
        KnownNoise { rms: (variance / (3 * noise.len().max(1)) as f64).sqrt(), rmse, relative, of_mean }
    }
}

/// How alpha differs, which the other figures do not look at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct AlphaDifference {
    pixels: usize,
    largest: f64,
}

impl AlphaDifference {
    fn of(test: &[f64], reference: &[f64]) -> AlphaDifference {
        let differences = test.iter().zip(reference).map(|(a, b)| (a - b).abs());
        differences.fold(AlphaDifference::default(), |all, d| AlphaDifference {
            pixels: all.pixels + usize::from(d > 0.0),
            largest: all.largest.max(d),
        })
    }
}

/// The seed of two noisy pictures, when it is the same.
fn shared_seed(test: &Pixels, reference: &Pixels) -> Option<u64> {
    let seed = |pixels: &Pixels| pixels.noise.as_ref().and_then(|noise| noise.seed);
    seed(test).filter(|of_test| seed(reference) == Some(*of_test))
}

/// The standard error of the difference of two pictures of independent noise, as far as their files know it.
fn combined(test: &Pixels, reference: &Pixels) -> Option<Vec<[f64; 3]>> {
    let errors = |pixels: &Pixels| pixels.noise.as_ref()?.errors.clone();
    match (errors(test), errors(reference)) {
        (Some(a), Some(b)) => Some(a.iter().zip(&b).map(|(a, b)| std::array::from_fn(|c| a[c].hypot(b[c]))).collect()),
        (one, other) => one.or(other),
    }
}

/// A picture and what its file knows of its noise.
fn noisy(pixels: &Pixels) -> Noisy<'_> {
    let errors = pixels.noise.as_ref().and_then(|noise| noise.errors.as_deref());
    Noisy { pixels: &pixels.numbers, standard_error: errors.unwrap_or_default() }
}

fn text(flip: &Flip, numbers: &Numbers) -> String {
    let Difference { rmse, relative, mean_relative, largest } = numbers.difference;
    let relative_to_light =
        |text: String| if numbers.is_black { "none: the reference is black".to_owned() } else { text };
    let figure = |plain: f64, beyond: Option<Beyond>| match beyond {
        None => format!("{plain:.6e}"),
        Some(Beyond { error, at_most, with_noise }) if error > 0.0 => {
            format!("{error:.6e} beyond noise, at most {at_most:.3e}; {with_noise:.3e} with it")
        }
        Some(Beyond { at_most, with_noise, .. }) => {
            format!("at most {at_most:.6e}: chance may explain all of {with_noise:.3e}")
        }
    };
    let known = numbers.noise.as_ref();
    let of_mean = known.map(|noise| format!(", of noise +-{:.4} %", 100.0 * noise.of_mean)).unwrap_or_default();
    let mean = relative_to_light(format!("{:+.4} %{of_mean}", 100.0 * mean_relative));
    let relative = relative_to_light(figure(relative, known.map(|noise| noise.relative)));
    let rmse = figure(rmse, known.map(|noise| noise.rmse));
    let mut text = format!(
        "FLIP ({})       mean {:.6}  largest {:.6}\nRMSE             {rmse}\nrelative error   {relative}\nmean difference  \
         {mean}\nlargest          {largest:.6e}",
        flip.kind.to_uppercase(),
        flip.mean,
        flip.largest,
    );
    if let (Some(noise), Some(of_noise)) = (known, flip.of_noise) {
        text += &format!(
            "\nstandard error   {:.6e}, taken off RMSE and relative error\nFLIP of noise    mean {of_noise:.6}: of a FLIP no larger noise \
             may be all",
            noise.rms
        );
    }
    let AlphaDifference { pixels, largest } = numbers.alpha;
    if pixels > 0 {
        text += &format!(
            "\nalpha            differs in {pixels} pixels by up to {largest:.6}, which no other figure counts"
        );
    }
    text
}

fn json(flip: &Flip, numbers: &Numbers, pixels: &Pixels) -> serde_json::Value {
    let Difference { rmse, relative, mean_relative, largest } = numbers.difference;
    let relative_to_light = |x: f64| (!numbers.is_black).then_some(x);
    let known = numbers.noise.as_ref();
    let error = |plain: f64, beyond: Option<Beyond>| beyond.map_or(plain, |beyond| beyond.error);
    let at_most = |beyond: fn(&KnownNoise) -> Beyond| known.map(|noise| beyond(noise).at_most);
    serde_json::json!({
        "width": pixels.width,
        "height": pixels.height,
        "flip": {"kind": flip.kind, "mean": flip.mean, "largest": flip.largest, "of_noise": flip.of_noise},
        "rmse": error(rmse, known.map(|noise| noise.rmse)),
        "rmse_at_most": at_most(|noise| noise.rmse),
        "rmse_with_noise": known.map(|noise| noise.rmse.with_noise),
        "relative": relative_to_light(error(relative, known.map(|noise| noise.relative))),
        "relative_at_most": at_most(|noise| noise.relative).and_then(relative_to_light),
        "relative_with_noise": known.map(|noise| noise.relative.with_noise).and_then(relative_to_light),
        "mean_relative": relative_to_light(mean_relative),
        "mean_relative_standard_error": known.map(|noise| noise.of_mean).and_then(relative_to_light),
        "largest": largest,
        "standard_error": known.map(|noise| noise.rms),
        "shared_seed": numbers.shared_seed,
        "alpha": {"pixels": numbers.alpha.pixels, "largest": numbers.alpha.largest},
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
    let image = image.into_rgba32f();
    let alpha = image.pixels().map(|pixel| f64::from(pixel.0[3])).collect();
    let numbers: Vec<[f64; 3]> = image
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
    let noise = if format == PictureFormat::Exr { noise(path) } else { Ok(None) };
    let fits = |noise: Option<Noise>| match noise {
        Some(Noise { errors: Some(errors), .. }) if errors.len() != numbers.len() => {
            Err("its standard errors are of a picture of another size".to_owned())
        }
        noise => Ok(noise),
    };
    let noise = noise.and_then(fits).map_err(|why| {
        Failure::input("the noise of a picture could not be read").at(path).because(why).try_to(
            "the file as --backend reference writes it, or one without the channels error.R, error.G and error.B",
        )
    })?;
    Ok(Pixels { width, height, numbers, alpha, noise, displayed })
}

fn heat_map(errors: &[f64], width: usize, path: &Path) -> Result<Vec<u8>, Failure> {
    let codes: Vec<u8> = errors.iter().flat_map(|error| magma(*error)).collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(&codes, width as u32, (errors.len() / width) as u32, ExtendedColorType::Rgb8)
        .map_err(|error| Failure::input("the heat map could not be coded").at(path).because(error))?;
    Ok(bytes)
}
