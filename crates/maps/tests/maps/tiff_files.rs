//! TIFF files that few writers make: palettes, grey floats, few bits, BigTIFF, profiles.

use std::io::Cursor;

use halfvector_maps::{Channels, Decoded, Limits, Texels, decode};
use tiff::encoder::{Rational, TiffEncoder, colortype};
use tiff::tags::Tag;

fn decoded(bytes: &[u8]) -> Decoded {
    decode(bytes, Limits::default()).unwrap()
}

/// A file of one strip of raw bytes, written field by field: tag, type (3 SHORT, 4 LONG), values.
fn raw_tiff(big_endian: bool, strip: &[u8], fields: &[(u16, u16, &[u32])]) -> Vec<u8> {
    let short = |x: u32| if big_endian { (x as u16).to_be_bytes() } else { (x as u16).to_le_bytes() };
    let long = |x: u32| if big_endian { x.to_be_bytes() } else { x.to_le_bytes() };
    let strip_fields: [(u16, u16, &[u32]); 2] = [(273, 4, &[8]), (279, 4, &[strip.len() as u32])];
    let is_tiled = fields.iter().any(|field| field.0 == 324);
    let strip_fields = strip_fields.into_iter().filter(|_| !is_tiled);
    let mut fields: Vec<_> = fields.iter().copied().chain(strip_fields).collect();
    fields.sort_by_key(|field| field.0);
    let directory = 8 + strip.len() + strip.len() % 2;
    let mut values_at = directory + 2 + 12 * fields.len() + 4;
    let mut bytes = Vec::from(if big_endian { b"MM" } else { b"II" });
    bytes.extend(short(42));
    bytes.extend(long(directory as u32));
    bytes.extend(strip);
    bytes.resize(directory, 0);
    bytes.extend(short(fields.len() as u32));
    let mut values = Vec::new();
    for (tag, kind, numbers) in fields {
        bytes.extend(short(u32::from(tag)));
        bytes.extend(short(u32::from(kind)));
        bytes.extend(long(numbers.len() as u32));
        let mut field: Vec<u8> = Vec::new();
        for &number in numbers {
            if kind == 3 { field.extend(short(number)) } else { field.extend(long(number)) }
        }
        if field.len() <= 4 {
            field.resize(4, 0);
            bytes.extend(field);
        } else {
            bytes.extend(long(values_at as u32));
            values_at += field.len();
            values.extend(field);
        }
    }
    bytes.extend(long(0));
    bytes.extend(values);
    bytes
}

/// A palette of 4 colours, 4 bits an index, rows of 3 texels padded to 2 bytes; both byte orders. Palettes of 8 bits make
/// 8-bit images, finer ones 16-bit ones.
#[test]
fn palettes_are_read() {
    for big_endian in [false, true] {
        let file = |map: &[u32]| {
            raw_tiff(
                big_endian,
                &[0x01, 0x20, 0x3f, 0x00],
                &[
                    (256, 3, &[3]),
                    (257, 3, &[2]),
                    (258, 3, &[4]),
                    (259, 3, &[1]),
                    (262, 3, &[3]),
                    (277, 3, &[1]),
                    (278, 3, &[2]),
                    (320, 3, map),
                ],
            )
        };
        let mut map = [0_u32; 48];
        for (i, rgb) in [[255, 0, 0], [0, 255, 0], [0, 0, 255], [10, 20, 30]].iter().enumerate() {
            (0..3).for_each(|k| map[16 * k + i] = rgb[k] * 257);
        }
        let image = decoded(&file(&map)).into_data().image;
        assert_eq!((image.width(), image.height(), image.channels()), (3, 2, Channels::Rgb));
        let row = |a, b, c| [a, b, c];
        let want = [
            row([255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]),
            row([10, 20, 30, 255], [0, 0, 0, 255], [255, 0, 0, 255]),
        ];
        assert_eq!(image.texels(), &Texels::U8(want.concat()));
        map[0] = 65_000;
        let Texels::U16(texels) = decoded(&file(&map)).into_data().image.into_texels() else {
            panic!("16 bits expected")
        };
        assert_eq!(texels[0], [65_000, 0, 0, 65_535]);
    }
}

/// 1, 2 and 4 bits of grey are spread over 0..255.
#[test]
fn few_bits_are_read() {
    for (bits, strip, want) in [
        (1, vec![0b1010_0000], [255, 0, 255]),
        (2, vec![0b1100_0100], [255, 0, 85]),
        (4, vec![0xf0, 0x50], [255, 0, 85]),
    ] {
        let file = raw_tiff(
            false,
            &strip,
            &[
                (256, 3, &[3]),
                (257, 3, &[1]),
                (258, 3, &[bits]),
                (259, 3, &[1]),
                (262, 3, &[1]),
                (277, 3, &[1]),
                (278, 3, &[1]),
            ],
        );
        let image = decoded(&file).into_data().image;
        assert_eq!(image.channels(), Channels::Grey);
        assert_eq!(image.texels(), &Texels::U8(want.map(|c| [c, c, c, 255]).to_vec()), "{bits} bits");
    }
}

/// Grey floats of 32 and 64 bits keep their values, bad ones are made finite; BigTIFF too.
#[test]
fn grey_floats_are_read() {
    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new(&mut bytes)
        .unwrap()
        .write_image::<colortype::Gray32Float>(2, 2, &[0.25, -3.5, f32::NAN, f32::NEG_INFINITY])
        .unwrap();
    let grey = |v: f32| [v, v, v, 1.0];
    let image = decoded(&bytes.into_inner()).into_data().image;
    assert_eq!(image.texels(), &Texels::F32(vec![grey(0.25), grey(-3.5), grey(0.0), grey(-65504.0)]));

    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new_big(&mut bytes).unwrap().write_image::<colortype::Gray64Float>(2, 1, &[0.25, 1e300]).unwrap();
    let image = decoded(&bytes.into_inner()).into_data().image;
    assert_eq!(image.texels(), &Texels::F32(vec![grey(0.25), grey(65504.0)]));
}

/// Colour types that are not read are named.
#[test]
fn other_types_are_refused() {
    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new(&mut bytes).unwrap().write_image::<colortype::CMYK8>(1, 1, &[1, 2, 3, 4]).unwrap();
    let error = decode(&bytes.into_inner(), Limits::default()).unwrap_err().to_string();
    assert!(error.contains("TIFF image: the colour type CMYK"), "{error}");
    let fields: [(u16, u16, &[u32]); 6] =
        [(256, 3, &[1]), (257, 3, &[1]), (258, 3, &[8]), (259, 3, &[1]), (262, 3, &[1]), (277, 3, &[1])];
    let file = |order: u32| raw_tiff(false, &[7], &[&fields[..], &[(266, 3, &[order])]].concat());
    assert_eq!(decoded(&file(1)).into_data().image.texels(), &Texels::U8(vec![[7, 7, 7, 255]]));
    let error = decode(&file(2), Limits::default()).unwrap_err().to_string();
    assert!(error.contains("FillOrder 2"), "{error}");
}

/// Where the fields of a file are written.
type Tags<'a, 'b> = tiff::encoder::DirectoryEncoder<'a, &'b mut Cursor<Vec<u8>>, tiff::encoder::TiffKindStandard>;

/// An ICC profile, and primaries without one; a transfer table is refused.
#[test]
fn profiles_are_heard() {
    let with = |write: &dyn Fn(&mut Tags<'_, '_>)| {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
        let mut image = encoder.new_image::<colortype::RGB8>(1, 1).unwrap();
        write(image.encoder());
        image.write_data(&[200, 100, 50]).unwrap();
        bytes.into_inner()
    };
    let icc = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    let file = with(&|tags| tags.write_tag(Tag::Unknown(34_675), icc.as_slice()).unwrap());
    let notes = decoded(&file).into_color().unwrap().notes;
    assert!(notes[0].contains("Display P3"), "{notes:?}");

    let ratio = |n| Rational { n, d: 1000 };
    let p3 = [680, 320, 265, 690, 150, 60].map(ratio);
    let file = with(&|tags| tags.write_tag(Tag::Unknown(319), &p3[..]).unwrap());
    let notes = decoded(&file).into_color().unwrap().notes;
    assert!(notes[0].contains("PrimaryChromaticities"), "{notes:?}");

    let file = with(&|tags| tags.write_tag(Tag::Unknown(301), &[0_u16; 768][..]).unwrap());
    assert!(decoded(&file).into_color().unwrap_err().to_string().contains("TransferFunction"));
}

/// TIFF 6.0 (1992), section 13, as its pseudocode has it.
fn lzw(bytes: &[u8]) -> Vec<u8> {
    let (mut packed, mut word, mut bits) = (Vec::new(), 0_u32, 0);
    let mut write = |code: usize, width: u32| {
        (word, bits) = (word << width | code as u32, bits + width);
        while bits >= 8 {
            bits -= 8;
            packed.push((word >> bits) as u8);
        }
    };
    let mut strings: Vec<Vec<u8>> = Vec::new();
    let width = |strings: &[Vec<u8>]| (strings.len() as u32 + 258).ilog2() + 1;
    let code = |strings: &[Vec<u8>], string: &[u8]| match string {
        [byte] => Some(usize::from(*byte)),
        _ => strings.iter().position(|s| s == string).map(|at| at + 258),
    };
    write(256, 9);
    let mut string = Vec::new();
    for &byte in bytes {
        let longer = [&string[..], &[byte]].concat();
        if code(&strings, &longer).is_some() {
            string = longer;
            continue;
        }
        write(code(&strings, &string).unwrap(), width(&strings));
        strings.push(longer);
        if strings.len() + 258 == 4094 {
            write(256, 12);
            strings.clear();
        }
        string = vec![byte];
    }
    write(code(&strings, &string).unwrap(), width(&strings));
    strings.push(Vec::new());
    write(257, width(&strings));
    write(0, 7);
    packed
}

/// Tiles of flat areas and of grain packed by LZW, whose codes may end just where a row does: the decoder at hand takes such
/// for damage.
#[test]
fn tiles_packed_by_lzw_are_read() {
    const SIZE: [usize; 2] = [100, 70];
    let values = [
        |_: usize, _: usize| 128_u8,
        |x: usize, y: usize| if x < 40 && y < 30 { (x * 73 + y * 151) as u8 ^ (x * y) as u8 } else { 128 },
        |x: usize, y: usize| (x + y) as u8,
    ];
    for (value, side) in values.into_iter().flat_map(|value| [16, 32, 64].map(|side| (value, side))) {
        let [columns, rows] = SIZE.map(|n| n.div_ceil(side));
        let tile = |i: usize| -> Vec<u8> {
            let [x, y] = [i % columns * side, i / columns * side];
            (0..side * side).map(|k| value(x + k % side, y + k / side)).collect()
        };
        let tiles: Vec<_> = (0..columns * rows).map(|i| lzw(&tile(i))).collect();
        let places: Vec<_> = tiles.iter().scan(8, |at, t| Some(std::mem::replace(at, *at + t.len()) as u32)).collect();
        let lengths: Vec<_> = tiles.iter().map(|tile| tile.len() as u32).collect();
        for big_endian in [false, true] {
            let mut file = raw_tiff(
                big_endian,
                &tiles.concat(),
                &[
                    (256, 3, &[SIZE[0] as u32]),
                    (257, 3, &[SIZE[1] as u32]),
                    (258, 3, &[8]),
                    (259, 3, &[5]),
                    (262, 3, &[1]),
                    (277, 3, &[1]),
                    (322, 3, &[side as u32]),
                    (323, 3, &[side as u32]),
                    (324, 4, &places),
                    (325, 3, &lengths),
                ],
            );
            let want: Vec<_> =
                (0..SIZE[0] * SIZE[1]).map(|k| value(k % SIZE[0], k / SIZE[0])).map(|c| [c, c, c, 255]).collect();
            assert_eq!(decoded(&file).into_data().image.texels(), &Texels::U8(want), "tiles of {side}");
            // Codes that are not there.
            let last = *places.last().unwrap() as usize;
            file[last + 1..last + lengths[lengths.len() - 1] as usize].fill(0xff);
            assert!(decode(&file, Limits::default()).is_err(), "tiles of {side}");
        }
    }
}

/// A turned image, and one of two, are read as they stand, and said.
#[test]
fn what_is_passed_over_is_said() {
    let fields: [(u16, u16, &[u32]); 6] =
        [(256, 3, &[1]), (257, 3, &[1]), (258, 3, &[8]), (259, 3, &[1]), (262, 3, &[1]), (277, 3, &[1])];
    let notes = |bytes: &[u8]| decoded(bytes).into_data().notes.join("; ");
    let plain = raw_tiff(false, &[7], &fields);
    assert_eq!(notes(&plain), "");
    assert!(notes(&raw_tiff(false, &[7], &[&fields[..], &[(274, 3, &[6])]].concat())).contains("orientation"));
    // The place of the next directory is the last number of a file whose fields are all short: the same once more.
    let mut two = plain.clone();
    let at = two.len() - 4;
    two[at..].copy_from_slice(&(plain.len() as u32).to_le_bytes());
    two.extend_from_slice(&plain[10..]);
    assert!(notes(&two).contains("several images"), "{}", notes(&two));
}
