//! PNG files: any bytes are an image within the limits or an error.
#![no_main]

mod decode;

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|data: &[u8]| -> Corpus {
    if data.starts_with(b"\x89PNG\r\n\x1a\n") { decode::check(data) } else { Corpus::Reject }
});
