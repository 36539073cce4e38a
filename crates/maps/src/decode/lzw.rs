//! LZW as TIFF has it: TIFF 6.0 (1992), section 13. Here because the TIFF reader refuses sound tiles: it takes codes that
//! end where its buffer is full for damage.

use weezl::decode::Decoder;
use weezl::{BitOrder, LzwStatus};

/// Appends what the codes stand for, `length` bytes. Whether there were so many: fewer where the codes end early or mean
/// nothing.
pub(super) fn expand(codes: &[u8], length: usize, out: &mut Vec<u8>) -> bool {
    let begin = out.len();
    out.resize(begin + length, 0);
    let (mut codes, mut rest) = (codes, &mut out[begin..]);
    let mut decoder = Decoder::with_tiff_size_switch(BitOrder::Msb, 8);
    while !rest.is_empty() {
        let step = decoder.decode_bytes(codes, rest);
        let is_still = step.consumed_in == 0 && step.consumed_out == 0;
        (codes, rest) = (&codes[step.consumed_in..], &mut rest[step.consumed_out..]);
        if is_still || !matches!(step.status, Ok(LzwStatus::Ok)) {
            break;
        }
    }
    rest.is_empty()
}
