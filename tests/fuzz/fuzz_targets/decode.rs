//! What each reader of textures must keep, whatever the bytes: no panic, the limits, sound texels. Not a target itself.

use halfvector_maps::{ColorSpace, Limits, MapKind, Texels, decode, smaller_levels};
use libfuzzer_sys::Corpus;
use std::sync::Once;

/// Small, so that a run is quick.
const LIMITS: Limits = Limits { max_width: 2048, max_height: 2048, max_texels: 1 << 20, max_bytes: 1 << 25 };

/// Decodes, reads as colour and as data, and makes the levels of what is small.
pub fn check(data: &[u8]) -> Corpus {
    // libFuzzer's hook ends the process at every panic, also at those of other people's decoders that `decode` turns into
    // an error. Without it a panic that leaves this function still ends the run.
    static CATCHABLE: Once = Once::new();
    CATCHABLE.call_once(|| drop(std::panic::take_hook()));
    let Ok(decoded) = decode(data, LIMITS) else { return Corpus::Keep };
    let image = decoded.clone().into_data().image;
    let texels = u64::from(image.width()) * u64::from(image.height());
    assert!(texels <= LIMITS.max_texels && image.width() <= LIMITS.max_width && image.height() <= LIMITS.max_height);
    if let Texels::F32(texels) = image.texels() {
        assert!(texels.as_flattened().iter().all(|c| c.is_finite()));
    }
    if texels <= 1 << 12 {
        let color = decoded.into_color().map_or(image, |noted| noted.image);
        let last = smaller_levels(&color, ColorSpace::Srgb, MapKind::Color).pop();
        assert!(last.is_none_or(|level| (level.width(), level.height()) == (1, 1)));
    }
    Corpus::Keep
}
