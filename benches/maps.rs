//! Decoding a 4k RGBA map with its mip chain, against the crate `image` decoding it alone and one pass over the memory of
//! each level. `cargo bench -p halfvector-benches --bench maps`; the last lines are medians of interleaved runs.

use std::hint::black_box;
use std::io::Cursor;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use halfvector_maps::{ColorSpace, Image, Limits, MapKind, decode, smaller_levels};
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

fn decoded_with_levels(bytes: &[u8]) -> (Image, Vec<Image>) {
    let image = decoded(bytes);
    let levels = smaller_levels(&image, ColorSpace::Srgb, MapKind::Color);
    (image, levels)
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
    group.finish();
    ratio(&bytes);
}

/// Interleaved, so that a machine that slows down slows all of them.
fn ratio(bytes: &[u8]) {
    let mut times = [Vec::new(), Vec::new(), Vec::new()];
    let mut timed = |slot: usize, work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        times[slot].push(start.elapsed().as_secs_f64());
    };
    for _ in 0..9 {
        timed(0, &mut || drop(black_box(decoded_with_levels(bytes))));
        timed(1, &mut || drop(black_box(decode_alone(bytes))));
        timed(2, &mut || drop(black_box(memory_passes())));
    }
    let [ours, theirs, passes] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    println!("decode + levels {ours:.3} s; image's decode {theirs:.3} s, a pass over each level {passes:.3} s");
    println!("ratio to decode + passes: {:.2}; the goal is 1.2", ours / (theirs + passes));
}

criterion_group!(benches, maps);
criterion_main!(benches);
