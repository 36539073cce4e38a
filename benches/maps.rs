//! Decoding a 4k RGBA map with its mip chain, against the crate `image` decoding it alone and one pass over the memory of
//! each level. `cargo bench -p halfvector-benches --bench maps`; the last lines are medians of interleaved runs.

use std::hint::black_box;
use std::io::Cursor;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use halfvector_maps::lost_length::Rule;
use halfvector_maps::{Channels, ColorSpace, Image, Limits, MapKind, Texels};
use halfvector_maps::{adjusted_roughness, decode, smaller_levels};
use image::ImageFormat;

const SIDE: u32 = 4096;

/// A picture that compresses like a texture: broad shades, some grain.
fn file() -> Vec<u8> {
    let mut state = 1_u32;
    let texels = image::RgbaImage::from_fn(SIDE, SIDE, |x, y| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let grain = (state >> 29) as u8;
        let shade = |t: u32| ((t >> 5) as u8) / 2 + grain;
        image::Rgba([shade(x + y), shade(3 * x), shade(2 * y), 255 - grain])
    });
    let mut bytes = Cursor::new(Vec::new());
    image::DynamicImage::ImageRgba8(texels).write_to(&mut bytes, ImageFormat::Png).expect("PNG takes RGBA");
    bytes.into_inner()
}

fn decoded(bytes: &[u8]) -> Image {
    decode(bytes, Limits::default()).and_then(|d| d.into_color()).expect("the file is sound").image
}

fn with_levels(image: Image, color_space: ColorSpace, kind: MapKind) -> (Image, Vec<Image>) {
    let levels = smaller_levels(&image, color_space, kind);
    (image, levels)
}

/// One roughness for the whole map, to be widened by the normals' spread.
fn one_roughness() -> Image {
    Image::new(1, 1, Channels::Grey, Texels::U8(vec![[90, 90, 90, 255]])).expect("one texel")
}

/// What the goal allows beside 1.2 decodes: each level's bytes written once, to fresh memory.
fn memory_passes() -> Vec<Vec<u8>> {
    (1..=SIDE.ilog2()).map(|level| vec![0x55; 4 * (SIDE as usize >> level).pow(2)]).collect()
}

fn decode_alone(bytes: &[u8]) -> image::DynamicImage {
    image::load_from_memory_with_format(bytes, ImageFormat::Png).expect("the file is sound")
}

fn maps(c: &mut Criterion) {
    let bytes = file();
    let image = decoded(&bytes);
    let mut group = c.benchmark_group("maps 4k RGBA");
    group.sample_size(10).measurement_time(Duration::from_secs(6)).warm_up_time(Duration::from_secs(1));
    group.bench_function("decode", |b| b.iter(|| decoded(&bytes)));
    group.bench_function("levels, sRGB", |b| b.iter(|| smaller_levels(&image, ColorSpace::Srgb, MapKind::Color)));
    group.bench_function("levels, data", |b| b.iter(|| smaller_levels(&image, ColorSpace::Linear, MapKind::Data)));
    group.bench_function("levels, normals", |b| b.iter(|| smaller_levels(&image, ColorSpace::Linear, MapKind::Normal)));
    let roughness = one_roughness();
    group.bench_function("levels, lost length", |b| b.iter(|| adjusted_roughness(&roughness, &image, Rule::default())));
    group.finish();
    ratio(&bytes);
}

/// Interleaved, so that a machine that slows down slows all of them.
fn ratio(bytes: &[u8]) {
    let roughness = one_roughness();
    let mut runs: [(&str, &mut dyn FnMut()); 6] = [
        ("image's decode", &mut || drop(black_box(decode_alone(bytes)))),
        ("a pass over each level", &mut || drop(black_box(memory_passes()))),
        ("decode + levels of a colour map", &mut || {
            drop(black_box(with_levels(decoded(bytes), ColorSpace::Srgb, MapKind::Color)));
        }),
        ("decode + levels of a packed map", &mut || {
            drop(black_box(with_levels(decoded(bytes), ColorSpace::Linear, MapKind::Data)));
        }),
        ("decode + levels of a normal map", &mut || {
            drop(black_box(with_levels(decoded(bytes), ColorSpace::Linear, MapKind::Normal)));
        }),
        ("the same + levels of roughness", &mut || {
            let (image, levels) = with_levels(decoded(bytes), ColorSpace::Linear, MapKind::Normal);
            drop(black_box((adjusted_roughness(&roughness, &image, Rule::default()), image, levels)));
        }),
    ];
    let mut times = [const { Vec::new() }; 6];
    for _ in 0..9 {
        for ((_, run), times) in runs.iter_mut().zip(&mut times) {
            let start = Instant::now();
            run();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let medians = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    for ((name, _), median) in runs.iter().zip(medians) {
        println!("{name:<32} {median:.3} s, {:.2} of decode + passes", median / (medians[0] + medians[1]));
    }
    println!("the goal is 1.2");
}

criterion_group!(benches, maps);
criterion_main!(benches);
