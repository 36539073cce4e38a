//! Radiance files: any bytes are an environment within the limits or an error.
#![no_main]

mod environment;

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|data: &[u8]| -> Corpus { environment::check(data, b"#?") });
