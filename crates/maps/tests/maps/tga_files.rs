//! TGA files, written here byte by byte: every depth, palettes, runs, corners; alpha only where the header has bits for it.

use crate::decode::decode;
use halfvector_maps::{Channels, DecodeError, Image, Limits, Texels};

/// A header of a picture of 2 x 2: type, bits, flags; and a palette's first index, length and bits of an entry.
fn header(image_type: u8, bits: u8, flags: u8, [first, length, entry]: [u8; 3]) -> Vec<u8> {
    vec![0, u8::from(length > 0), image_type, first, 0, length, 0, entry, 0, 0, 0, 0, 2, 0, 2, 0, bits, flags]
}

const NO_PALETTE: [u8; 3] = [0; 3];
/// The first row stored is the uppermost.
const FROM_TOP: u8 = 0x20;
const FROM_RIGHT: u8 = 0x10;

fn file(header: Vec<u8>, data: &[u8]) -> Vec<u8> {
    [&header, data].concat()
}

fn read(bytes: &[u8]) -> Image {
    decode(bytes, Limits::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn texels(image: &Image) -> &[[u8; 4]] {
    let Texels::U8(texels) = image.texels() else { panic!("eight bits") };
    texels
}

/// 15 and 16 bits: 0, 31 and what lies between become 0, 255 and the nearest; the sixteenth bit is alpha where the header
/// says so.
#[test]
fn five_bits_a_colour() {
    let words: Vec<u8> = [0x7c00_u16, 0x03e0, 0x801f, 0x8210].iter().flat_map(|word| word.to_le_bytes()).collect();
    let opaque = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [0, 132, 132, 255]];
    for (bits, attributes) in [(15, 0), (15, 1), (16, 0)] {
        let image = read(&file(header(2, bits, FROM_TOP | attributes, NO_PALETTE), &words));
        assert_eq!((texels(&image), image.channels()), (&opaque[..], Channels::Rgb), "{bits} bits, {attributes}");
    }
    let image = read(&file(header(2, 16, FROM_TOP | 1, NO_PALETTE), &words));
    let clear = [[255, 0, 0, 0], [0, 255, 0, 0], [0, 0, 255, 255], [0, 132, 132, 255]];
    assert_eq!((texels(&image), image.channels()), (&clear[..], Channels::Rgba));
}

/// The fourth byte is alpha by the header's word alone, and a note says when it is not.
#[test]
fn a_fourth_byte_is_alpha_where_the_header_says_so() {
    let data: Vec<u8> = (0..4).flat_map(|k| [3, 2, 1, 10 * k]).collect();
    let with_alpha = read(&file(header(2, 32, FROM_TOP | 8, NO_PALETTE), &data));
    assert_eq!((texels(&with_alpha)[2], with_alpha.channels()), ([1, 2, 3, 20], Channels::Rgba));
    let bytes = file(header(2, 32, FROM_TOP, NO_PALETTE), &data);
    let without = halfvector_maps::decode(&bytes, Limits::default()).unwrap().into_data();
    assert_eq!((texels(&without.image)[2], without.image.channels()), ([1, 2, 3, 255], Channels::Rgb));
    assert!(without.notes.iter().any(|note| note.contains("fourth byte")), "{:?}", without.notes);
}

/// The four corners that a file may begin at.
#[test]
fn rows_and_columns_run_as_the_flags_say() {
    for (flags, order) in
        [(FROM_TOP, [0, 1, 2, 3]), (0, [2, 3, 0, 1]), (FROM_TOP | FROM_RIGHT, [1, 0, 3, 2]), (FROM_RIGHT, [3, 2, 1, 0])]
    {
        let image = read(&file(header(3, 8, flags, NO_PALETTE), &[0, 1, 2, 3]));
        assert_eq!(texels(&image).iter().map(|texel| texel[0]).collect::<Vec<_>>(), order, "{flags:#x}");
    }
    let image = read(&file(header(3, 16, FROM_TOP | 8, NO_PALETTE), &[5, 6, 7, 8, 9, 10, 11, 12]));
    assert_eq!((texels(&image)[1], image.channels()), ([7, 7, 7, 8], Channels::GreyAlpha));
}

/// Palettes of every depth, from any first index; an index outside of them is damage.
#[test]
fn palettes() {
    let entries: [(u8, u8, &[u8]); 4] =
        [(15, 0, &[0x00, 0x7c]), (16, 0, &[0x00, 0x7c]), (24, 0, &[0, 0, 255]), (32, 8, &[0, 0, 255, 255])];
    for (bits, attributes, red) in entries {
        let black = vec![0; red.len()];
        let data = [red, &black, &[7, 8, 8, 7]].concat();
        let image = read(&file(header(1, 8, FROM_TOP | attributes, [7, 2, bits]), &data));
        assert_eq!(texels(&image)[0], [255, 0, 0, 255], "{bits}");
        assert_eq!(texels(&image)[1][..3], [0; 3], "{bits}");
        for outside in [6, 9] {
            let data = [red, &black, &[7, 8, 8, outside]].concat();
            let error = decode(&file(header(1, 8, attributes, [7, 2, bits]), &data), Limits::default()).unwrap_err();
            assert!(error.to_string().contains("palette"), "{error}");
        }
    }
    // Indices of two bytes.
    let image = read(&file(header(1, 16, FROM_TOP, [0, 2, 24]), &[9, 9, 9, 4, 4, 4, 1, 0, 0, 0, 1, 0, 0, 0]));
    assert_eq!(texels(&image).iter().map(|texel| texel[0]).collect::<Vec<_>>(), [4, 9, 4, 9]);
}

/// Runs and raw packets, over the ends of rows too; one that goes on after the last texel is damage, and none is the end.
#[test]
fn runs() {
    let packed = |data: &[u8]| file(header(11, 8, FROM_TOP, NO_PALETTE), data);
    let image = read(&packed(&[0x82, 7, 0x00, 9]));
    assert_eq!(texels(&image).iter().map(|texel| texel[0]).collect::<Vec<_>>(), [7, 7, 7, 9]);
    let error = |data: &[u8]| decode(&packed(data), Limits::default()).unwrap_err();
    assert!(matches!(error(&[0x84, 7]), DecodeError::Damaged { .. }));
    assert!(matches!(error(&[0x82, 7]), DecodeError::Truncated { .. }));
    assert!(matches!(error(&[0x02, 7, 7]), DecodeError::Truncated { .. }));
}

#[test]
fn what_is_not_read_is_named() {
    let message = |header: Vec<u8>| decode(&file(header, &[0; 64]), Limits::default()).unwrap_err().to_string();
    assert!(message(header(3, 1, 0, NO_PALETTE)).contains("black and white of 1 bit"));
    assert!(message(header(2, 24, 0x40, NO_PALETTE)).contains("interleaved"));
    assert!(message(header(2, 32, 4, NO_PALETTE)).contains("colour of 32 bits, 4 of them for attributes"));
    assert!(message(header(2, 8, 0, NO_PALETTE)).contains("colour of 8 bits"));
    assert!(message(header(3, 16, 0, NO_PALETTE)).contains("grey of 16 bits"));
    assert!(message(header(1, 24, 0, [0, 2, 24])).contains("palette indices of 24 bits"));
}
