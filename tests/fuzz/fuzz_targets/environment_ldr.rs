//! Ordinary images as environments: any bytes that no other format claims are an environment within the limits or an error.
#![no_main]

mod environment;

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|data: &[u8]| -> Corpus {
    let others: [&[u8]; 5] = [b"#?", b"HDRE", b"ERDH", b"\x76\x2f\x31\x01", b"\xabKTX"];
    if others.iter().any(|other| data.starts_with(other)) { Corpus::Reject } else { environment::check(data, b"") }
});
