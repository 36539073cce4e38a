//! The files that the fuzz targets in `tests/fuzz` begin with.

use std::io::Cursor;

use halfvector_maps::{Limits, decode};
use image::ImageFormat;
use tiff::encoder::{TiffEncoder, colortype};

use crate::decode::{KINDS, file};

/// One small file of each kind, and with a profile where a format has one, each of which decodes: written into `decode_FORMAT/` of
/// `$HALFVECTOR_CORPUS`, where that names a folder.
#[test]
fn fuzz_corpus() {
    // Tests run in their package's folder; a relative path is meant from the project's root.
    let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let corpus = std::env::var_os("HALFVECTOR_CORPUS").map(|folder| root.join(folder));
    let write = |format: &str, name: &str, bytes: &[u8]| {
        decode(bytes, Limits::default()).unwrap_or_else(|error| panic!("{format} {name}: {error}"));
        let Some(corpus) = &corpus else { return };
        let folder = corpus.join(format!("decode_{format}"));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(name), bytes).unwrap();
    };
    for (format, color) in KINDS {
        let name = match format {
            ImageFormat::Jpeg => "jpeg",
            other => other.extensions_str()[0],
        };
        write(name, &format!("{color:?}"), &file(format, color));
    }
    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new(&mut bytes).unwrap().write_image::<colortype::Gray32Float>(2, 1, &[0.5, 2.0]).unwrap();
    write("tiff", "grey_float", &bytes.into_inner());
    let icc = moxcms::ColorProfile::new_display_p3().encode().unwrap();
    for (format, bytes) in crate::profiles::with_profile(&[[200, 100, 50]; 3], &icc) {
        write(format, "profile", &bytes);
    }
}
