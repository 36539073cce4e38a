//! What each reader of environments must keep, whatever the bytes: no panic, the limits, values that light can have. Not a
//! target itself.

use halfvector_ibl::{Limits, MAX_RADIANCE, Source, load_within};
use libfuzzer_sys::Corpus;
use std::sync::Once;

/// Small, so that a run is quick.
const LIMITS: Limits = Limits { max_texels: 1 << 18, max_edge: 2048 };

/// Reads bytes that start with a format's signature.
pub fn check(data: &[u8], signature: &[u8]) -> Corpus {
    if !data.starts_with(signature) {
        return Corpus::Reject;
    }
    // libFuzzer's hook ends the process at every panic, also at those of other people's decoders that are turned into an
    // error. Without it a panic that leaves this function still ends the run.
    static CATCHABLE: Once = Once::new();
    CATCHABLE.call_once(|| drop(std::panic::take_hook()));
    let Ok(environment) = load_within(data, "fuzz", LIMITS) else { return Corpus::Keep };
    let sound = |texels: &[[f32; 3]]| {
        assert!(texels.len() as u64 <= LIMITS.max_texels);
        assert!(texels.as_flattened().iter().all(|x| (0.0..=MAX_RADIANCE).contains(x)));
    };
    match &environment.source {
        Source::Equirect(map) => {
            assert_eq!(map.pixels.len(), map.width * map.height);
            sound(&map.pixels);
        }
        Source::Levels(stored) => stored.levels.iter().for_each(|level| {
            assert_eq!(level.texels.len(), 6 * level.size * level.size);
            sound(&level.texels);
        }),
    }
    Corpus::Keep
}
