//! OpenEXR files of the kinds that cameras, renderers and compositors write.

use exr::prelude::*;
use halfvector_ibl::{Equirect, Source, load};
use std::io::Cursor;

const SIZE: (usize, usize) = (8, 4);

/// A ramp that tells the channel and the texel.
fn value(channel: usize, k: usize) -> f32 {
    (100 * channel + k) as f32
}

fn floats(channel: usize) -> FlatSamples {
    FlatSamples::F32((0..32).map(|k| value(channel, k)).collect())
}

fn layer(name: &str, encoding: Encoding, channels: Vec<(&str, FlatSamples)>) -> Layer<AnyChannels<FlatSamples>> {
    let list = channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect();
    Layer::new(SIZE, LayerAttributes::named(name), encoding, AnyChannels::sort(list))
}

fn file(layers: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(SIZE));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(attributes, SmallVec::from_vec(layers));
    image.write().non_parallel().to_buffered(&mut bytes).expect("written to memory");
    bytes.into_inner()
}

fn map(bytes: &[u8]) -> Equirect {
    match load(bytes, "x.exr").expect("sound").source {
        Source::Equirect(map) => map,
        Source::Levels(_) => panic!("a map was expected"),
    }
}

#[track_caller]
fn assert_ramps(bytes: &[u8]) {
    for (k, texel) in map(bytes).pixels.iter().enumerate() {
        assert_eq!(*texel, [value(0, k), value(1, k), value(2, k)], "texel {k}");
    }
}

#[test]
fn every_kind_of_sample_in_any_order() {
    let halves = FlatSamples::F16((0..32).map(|k| f16::from_f32(value(0, k))).collect());
    let integers = FlatSamples::U32((0..32).map(|k| value(1, k) as u32).collect());
    let channels = vec![("B", floats(2)), ("A", floats(5)), ("R", halves), ("G", integers), ("Z", floats(7))];
    assert_ramps(&file(vec![layer("x", Encoding::SMALL_LOSSLESS, channels)]));
}

#[test]
fn tiles_and_compressions() {
    let tiled = Blocks::Tiles(Vec2(3, 3));
    for (compression, blocks) in [
        (Compression::Uncompressed, tiled),
        (Compression::ZIP1, Blocks::ScanLines),
        (Compression::RLE, tiled),
        (Compression::PIZ, Blocks::ScanLines),
        (Compression::ZIP16, tiled),
    ] {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        assert_ramps(&file(vec![layer("x", encoding, vec![("R", floats(0)), ("G", floats(1)), ("B", floats(2))])]));
    }
}

/// The first part with colours; in it plain names before those of a layer, and all three from one layer.
#[test]
fn parts_and_layers() {
    let depth = layer("depth", Encoding::SMALL_LOSSLESS, vec![("Z", floats(3))]);
    let color = |name, first| {
        let channels = vec![("R", floats(first)), ("G", floats(first + 1)), ("B", floats(first + 2))];
        layer(name, Encoding::SMALL_LOSSLESS, channels)
    };
    assert_ramps(&file(vec![depth.clone(), color("beauty", 0), color("other", 4)]));
    let layers = vec![
        ("diffuse.R", floats(5)),
        ("view.R", floats(0)),
        ("view.G", floats(1)),
        ("view.B", floats(2)),
        ("zeta.G", floats(6)),
    ];
    assert_ramps(&file(vec![layer("x", Encoding::SMALL_LOSSLESS, layers)]));
    let error = load(&file(vec![depth]), "x.exr").expect_err("no colours").to_string();
    assert!(error.contains("channels") && error.contains("Z"), "{error}");
}

#[test]
fn grey_alone_is_grey() {
    let bytes = file(vec![layer("x", Encoding::SMALL_LOSSLESS, vec![("Y", floats(1))])]);
    assert_eq!(map(&bytes).pixels[5], [value(1, 5); 3]);
    let chroma = vec![("Y", floats(1)), ("RY", floats(2)), ("BY", floats(3))];
    load(&file(vec![layer("x", Encoding::SMALL_LOSSLESS, chroma)]), "x.exr").expect_err("chroma is no grey");
}

/// A chunk without bytes, one given twice and one left out are named by their rows, and for tiles by their columns.
#[test]
fn chunks_come_once_each() {
    let plain = |compression, blocks| {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        file(vec![layer("x", encoding, vec![("R", floats(0)), ("G", floats(1)), ("B", floats(2))])])
    };
    let error = |bytes: &[u8]| load(bytes, "x.exr").map(|_| ()).expect_err("refused").to_string();
    let number = |bytes: &mut Vec<u8>, at: usize, value: i32| bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());

    // Four chunks of a row each: y, the number of bytes, 96 bytes; their offsets stand before the first.
    let rows = plain(Compression::Uncompressed, Blocks::ScanLines);
    let chunk = |k: usize| rows.len() - (4 - k) * (8 + 96);
    let table = chunk(0) - 4 * 8;
    let mut one_again = rows.clone();
    number(&mut one_again, chunk(2), 1);
    assert!(error(&one_again).contains("pixels: row 2 missing, row 1 twice"), "{}", error(&one_again));
    let mut same_offset = rows.clone();
    same_offset.copy_within(table..table + 8, table + 8);
    assert!(error(&same_offset).contains("row 1 missing, row 0 twice"), "{}", error(&same_offset));

    // A tile's place and level are four numbers.
    let tiles = plain(Compression::Uncompressed, Blocks::Tiles(Vec2(4, 4)));
    let last = tiles.len() - (20 + 4 * 4 * 12);
    let mut one_again = tiles.clone();
    number(&mut one_again, last, 0);
    let told = "columns 4 to 7 of rows 0 to 3 missing, columns 0 to 3 of rows 0 to 3 twice";
    assert!(error(&one_again).contains(told), "{}", error(&one_again));

    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ] {
        let mut bytes = plain(compression, Blocks::ScanLines);
        // The first chunk starts where the first offset, the only number of its size, points to.
        let first = (0..bytes.len() - 8)
            .find(|&at| {
                let offset = u64::from_le_bytes(std::array::from_fn(|i| bytes[at + i])) as usize;
                at > 200 && (at + 8..at + 8 * 4 + 1).contains(&offset)
            })
            .map(|at| bytes[at] as usize | (bytes[at + 1] as usize) << 8)
            .expect("a table of offsets");
        number(&mut bytes, first + 4, 0);
        let error = error(&bytes);
        assert!(error.contains("pixels: row") && error.contains("no bytes"), "{compression:?}: {error}");
    }
}

/// What would be read wrongly is refused by the name of its attribute.
#[test]
fn crops_and_cubes_are_refused() {
    let plain = || layer("x", Encoding::SMALL_LOSSLESS, vec![("R", floats(0)), ("G", floats(1)), ("B", floats(2))]);
    let written = |image: Image<Layer<AnyChannels<FlatSamples>>>| {
        let mut bytes = Cursor::new(Vec::new());
        image.write().non_parallel().to_buffered(&mut bytes).expect("written to memory");
        load(&bytes.into_inner(), "x.exr").map(|_| ()).expect_err("refused").to_string()
    };
    let mut cropped = Image::from_layer(plain());
    cropped.attributes.display_window = IntegerBounds::from_dimensions((16, 8));
    assert!(written(cropped).contains("dataWindow"));
    let mut cube = Image::from_layer(plain());
    cube.layer_data.attributes.environment_map = Some(attribute::EnvironmentMap::Cube);
    assert!(written(cube).contains("envmap"));
}

/// Windows that hold nothing, or more than numbers can count, are named; the decoder would exchange their corners.
#[test]
fn windows_of_no_size() {
    let color =
        |name| layer(name, Encoding::SMALL_LOSSLESS, vec![("R", floats(0)), ("G", floats(1)), ("B", floats(2))]);
    for bytes in [file(vec![color("x")]), file(vec![color("a"), color("b")])] {
        for name in ["dataWindow", "displayWindow"] {
            let start = format!("{name}\0box2i\0\x10\0\0\0").into_bytes();
            let places = bytes.windows(start.len()).enumerate().filter(|(_, window)| **window == *start);
            for (at, _) in places {
                for (corners, what) in [
                    ([0, 0, -1, 3], "holds nothing"),
                    ([0, 0, 7, -1], "holds nothing"),
                    ([5, 0, 4, 3], "holds nothing"),
                    ([0, 0, i32::MAX, 3], "more than a file can hold"),
                    ([i32::MIN, 0, i32::MAX, 3], "more than a file can hold"),
                ] {
                    let mut lying = bytes.clone();
                    for (i, corner) in corners.into_iter().enumerate() {
                        lying[at + start.len() + 4 * i..][..4].copy_from_slice(&i32::to_le_bytes(corner));
                    }
                    let error = load(&lying, "x.exr").map(|_| ()).expect_err(what).to_string();
                    assert!(error.contains(&format!("{name}: ")) && error.contains(what), "{error}");
                }
            }
        }
    }
}
