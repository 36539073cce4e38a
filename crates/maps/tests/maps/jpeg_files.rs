//! JPEG files of which a part is not there: their decoder fills it with grey and does not tell.

use std::io::Cursor;

use halfvector_maps::{Channels, DecodeError, Limits, decode};
use image::codecs::jpeg::JpegEncoder;

/// 21 x 19, progressive, chroma at half the size, restarts: what the encoder at hand does not write.
const PROGRESSIVE: &str = "
    ffd8ffe000104a46494600010100000100010000ffdb004300140e0f120f0d14121012171514181e32211e1c1c1e3d2c2e243249404c4b47
    404645505a736250556d5645466488656d777b8182814e608d978c7d96737e817cffdb0043011517171e1a1e3b21213b7c5346537c7c7c7c
    7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7c7cffc20011080013001503
    012200021101031101ffc4001800010101010100000000000000000000000003040205ffc400170101010101000000000000000000000000
    02000103ffdd00040002ffda000c03010002100310000001d118402f4584efffd0449f438eff00ffc4001810010101010100000000000000
    000000000100022131ffda000801010001050235cd68bfffd0350f3fffd1d30dffd23cd5ffd32fffc4001911000203010000000000000000
    00000000000302213222ffda0008010301013f016af922ba3fffd06e4864ffc4001911000301010100000000000000000000000001030212
    51ffda0008010201013f01c490e4bc3fffd0c146fb67ffc4001510010100000000000000000000000000001000ffda0008010100063f023f
    ffd03fffd13fffd23fffd3bfffc4001810010101010100000000000000000000000100113141ffda0008010100013f21266abfffd02cf26b
    ffd14d9b2fffd22406f2ffd3065fffda000c030100020003000000105fdfffd0701fffc40018110003010100000000000000000000000000
    01112131ffda0008010301013f105c8b9d3fffd07c9c0fffc40018110101000300000000000000000000000001001161b1ffda0008010201
    013f1039bb227fffd06f2300dfffc4001d1000020202030100000000000000000000000111213141516171f0ffda0008010100013f103181
    b3ffd0fbcc825c9fffd1f2fb356d9fffd281a582569b3fffd3495248ffd9
";

fn progressive() -> Vec<u8> {
    let digits: Vec<u8> = PROGRESSIVE.bytes().filter(u8::is_ascii_hexdigit).collect();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.chunks(2).map(byte).collect()
}

fn sequential(width: u32, height: u32, quality: u8) -> Vec<u8> {
    let picture =
        image::RgbImage::from_fn(width, height, |x, y| image::Rgb([x * 9, x * y, 255 - y * 7].map(|c| c as u8)));
    let mut bytes = Cursor::new(Vec::new());
    JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(&picture).unwrap();
    bytes.into_inner()
}

/// The file up to `length`, and the end marker.
fn cut(bytes: &[u8], length: usize) -> Vec<u8> {
    [&bytes[..length], &[0xff, 0xd9]].concat()
}

fn scan_start(bytes: &[u8]) -> usize {
    bytes.windows(2).position(|w| w == [0xff, 0xda]).unwrap() + 2
}

#[test]
fn whole_files_are_read_without_a_word() {
    for size in 1..24 {
        for quality in [1, 60, 100] {
            let decoded = decode(&sequential(size, 25 - size, quality), Limits::default()).unwrap();
            assert!(decoded.into_data().notes.is_empty());
        }
    }
    let decoded = decode(&progressive(), Limits::default()).unwrap();
    assert_eq!((decoded.image().width(), decoded.image().channels()), (21, Channels::Rgb));
    assert!(decoded.into_data().notes.is_empty());
}

/// However late its scan ends, the file is refused.
#[test]
fn scans_that_end_early_are_refused() {
    let bytes = sequential(21, 19, 80);
    for length in scan_start(&bytes)..bytes.len() - 2 {
        let error = decode(&cut(&bytes, length), Limits::default()).unwrap_err();
        assert!(matches!(error, DecodeError::Damaged { .. } | DecodeError::Truncated { .. }), "{length}: {error}");
    }
    let error = decode(&cut(&bytes, bytes.len() - 3), Limits::default()).unwrap_err();
    assert!(error.to_string().contains("a scan ends before all of the image is in it"), "{error}");
}

/// A progressive file is refused unless the cut lies between two of its scans: that is the whole image, coarser, and said.
#[test]
fn progressive_files_tell_what_is_not_there() {
    let bytes = progressive();
    let (mut refused, mut coarse) = (0, 0);
    for length in scan_start(&bytes)..bytes.len() - 2 {
        match decode(&cut(&bytes, length), Limits::default()) {
            Ok(decoded) => {
                let notes = decoded.into_color().unwrap().notes.join("");
                assert!(notes.contains("the last scans"), "cut at {length}: {notes}");
                coarse += 1;
            }
            Err(DecodeError::Damaged { .. } | DecodeError::Truncated { .. }) => refused += 1,
            Err(error) => panic!("cut at {length}: {error}"),
        }
    }
    assert!(coarse > 0 && refused > 10 * coarse, "{refused} refused, {coarse} coarse");
}

/// Bits that are no code: a table of one short code, and a scan that begins with another.
#[test]
fn bits_without_a_code_are_refused() {
    let mut bytes = sequential(8, 8, 50);
    let start = bytes.windows(2).position(|w| w == [0xff, 0xda]).unwrap();
    let data = start + 2 + usize::from(u16::from_be_bytes([bytes[start + 2], bytes[start + 3]]));
    // All ones are a code in no table; FF is stuffed.
    bytes.splice(data..data, [0xff, 0x00, 0xff, 0x00, 0xff, 0x00]);
    assert!(matches!(decode(&bytes, Limits::default()), Err(DecodeError::Damaged { format: "JPEG", .. })));
}
