//! OpenEXR: half, float or integer channels in any order, every compression that the `exr` crate knows (DWAB too).
//!
//! The first flat layer with R, G and B, or Y alone as grey; other channels are ignored, chromaticities too.

use super::{Fault, Limits, checked_texels, field};
use crate::equirect::Equirect;
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, read as reader};
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A file that claims more texels than this for each of its bytes is lying: the densest coding that the format has,
/// constant blocks of DWA in turn deflated, stays below.
const MAX_TEXELS_PER_BYTE: usize = 65536;

/// Reads the bytes of an OpenEXR file.
fn read_layer(bytes: &[u8], limits: Limits) -> Result<Equirect, Fault> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(explained)?;
    for header in &meta.headers {
        let size = header.layer_size;
        let count = checked_texels(size.width() as u64, size.height() as u64, limits)?;
        if count / MAX_TEXELS_PER_BYTE > bytes.len() {
            let (width, height) = (size.width(), size.height());
            return Err(field(
                "dataWindow",
                format!("{width} x {height} texels do not fit a file of {} bytes", bytes.len()),
            ));
        }
        if header.channels.list.len() > 64 {
            return Err(field("channels", "more than 64 of them; save red, green and blue alone"));
        }
    }
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(explained)?;
    let layer = image.layer_data;
    let (width, height) = (layer.size.width(), layer.size.height());
    let count = checked_texels(width as u64, height as u64, limits)?;

    let channels = &layer.channel_data.list;
    // "R", or the last part of a name with a view or layer before it, such as "left.R".
    let named = |wanted: &str| {
        let name_is = |whole: bool, name: &str| {
            let name = if whole { name } else { name.rsplit('.').next().unwrap_or(name) };
            name.eq_ignore_ascii_case(wanted)
        };
        let find = |whole| channels.iter().find(|channel| name_is(whole, &channel.name.to_string()));
        find(true).or_else(|| find(false))
    };
    let chosen = match (named("R"), named("G"), named("B"), named("Y"), named("RY")) {
        (Some(r), Some(g), Some(b), ..) => [r, g, b],
        (None, None, None, Some(y), None) => [y, y, y],
        _ => {
            let names: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
            let names = names.join(", ");
            return Err(field("channels", format!("R, G and B are needed, or Y alone, and there are: {names}")));
        }
    };
    let mut pixels = vec![[0.0; 3]; count];
    for (c, channel) in chosen.into_iter().enumerate() {
        if channel.sample_data.len() != count {
            let name = channel.name.to_string();
            return Err(field(
                "channels",
                format!("{name} has fewer samples than the layer; save it without subsampling"),
            ));
        }
        for (pixel, value) in pixels.iter_mut().zip(channel.sample_data.values_as_f32()) {
            pixel[c] = value;
        }
    }
    Ok(Equirect { width, height, pixels })
}

/// The reader below is another's and reads hostile bytes: a panic inside it must stay one file's error.
pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<Equirect, Fault> {
    catch_unwind(AssertUnwindSafe(|| read_layer(bytes, limits)))
        .unwrap_or_else(|_| Err(field("pixels", "the decoder gave up on them; the file is damaged")))
}

fn explained(error: exr::error::Error) -> Fault {
    match error {
        exr::error::Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Fault::Truncated("its header or pixels".to_owned())
        }
        exr::error::Error::NotSupported(what) => {
            field("content", format!("{what} cannot be read; save as a flat, plain file"))
        }
        other => field("content", format!("{other}; the file is damaged, save or copy it again")),
    }
}
