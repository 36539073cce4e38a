//! JPEG files: any bytes are an image within the limits or an error.
#![no_main]

mod decode;

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|data: &[u8]| -> Corpus {
    if data.starts_with(b"\xff\xd8\xff") { decode::check(data) } else { Corpus::Reject }
});
