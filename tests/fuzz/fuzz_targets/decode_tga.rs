//! TGA files: any bytes are an image within the limits or an error.
#![no_main]

mod decode;

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|data: &[u8]| -> Corpus {
    if matches!(data, [_, 0 | 1, 1..=3 | 9..=11, ..]) { decode::check(data) } else { Corpus::Reject }
});
