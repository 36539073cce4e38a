//! WebP files that the encoder at hand does not write: lossy ones, animations; and animated PNG.

use halfvector_maps::{DecodeError, Limits, decode};
use image::{ExtendedColorType, ImageFormat};

use crate::decode::{crc32, file};

/// 16 x 12, lossy.
const LOSSY: &str = "\
    524946463c0000005745425056503820300000007001009d012a10000c000d406825b0027401750000feb4f3b03cf50641ff\
    7497b518ebd8bafcda2e322c4e51b0320000";
/// 2 x 2, two pictures.
const ANIMATED: &str = "\
    52494646a800000057454250565038580a00000002000000010000010000414e494d06000000000000000000414e4d463800\
    0000000000000000010000010000000000025650384c200000002f0140000017f0fbff495090b6010bdb9df98fe87850d8b6\
    0d0a8b8388fe471e414e4d463c000000000000000000010000010000000000005650384c230000002f01400000177089fb27\
    b4ab69db8049177fb6bde73ffca68282b40d58d4dd88fec70500";

fn bytes(digits: &str) -> Vec<u8> {
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.as_bytes().chunks(2).map(byte).collect()
}

/// The decoder takes zeros for the last bytes of a lossy file.
#[test]
fn lossy_files_are_read_whole_or_not_at_all() {
    let bytes = bytes(LOSSY);
    let whole = decode(&bytes, Limits::default()).unwrap();
    assert_eq!((whole.image().width(), whole.image().height()), (16, 12));
    for length in 0..bytes.len() {
        match decode(&bytes[..length], Limits::default()) {
            Ok(cut) => assert_eq!(cut.image(), whole.image(), "cut at {length} of {}", bytes.len()),
            Err(DecodeError::TooLarge { .. } | DecodeError::Unsupported { .. }) => panic!("cut at {length}"),
            Err(_) => {}
        }
    }
}

#[test]
fn animations_are_said() {
    let notes = |bytes: &[u8]| decode(bytes, Limits::default()).unwrap().into_data().notes.join("; ");
    assert!(notes(&bytes(ANIMATED)).contains("animation"));
    assert_eq!(notes(&bytes(LOSSY)), "");
    let mut png = file(ImageFormat::Png, ExtendedColorType::Rgb8);
    assert_eq!(notes(&png), "");
    // acTL, one frame, played once, behind the header.
    let chunk = [&b"acTL"[..], &1_u32.to_be_bytes(), &1_u32.to_be_bytes()].concat();
    let chunk = [&8_u32.to_be_bytes()[..], &chunk, &crc32(&chunk).to_be_bytes()].concat();
    png.splice(33..33, chunk);
    assert!(notes(&png).contains("animation"));
}
