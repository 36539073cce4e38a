//! OpenEXR: half, float or integer channels in any order, scan lines or tiles, every compression that the `exr` crate
//! knows (DWAB too), the first suitable part of several.
//!
//! Suitable is a flat part with R, G and B, or with Y alone as grey; a layer or view may stand before the name
//! ("left.R"). Other channels, parts and resolution levels are not kept in memory. Chromaticities are told, not
//! applied. Strips of levels that `save::exr` wrote are read back as levels.

use super::layout::levels_in_strip;
use super::{Content, Fault, Limits, Picture, StoredLevels, StoredLobe, checked_texels, field, roughness_list};
use crate::equirect::Equirect;
use crate::ktx2::KEY_ROUGHNESS;
use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::lines::LineRef;
use exr::block::reader::ChunksReader;
use exr::meta::attribute::{AttributeValue, Chromaticities, EnvironmentMap, SampleType};
use exr::meta::header::Header;
use exr::prelude::{Vec2, f16};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A file that claims more texels than this for each of its bytes is lying: the densest coding that the format has,
/// constant blocks of DWA in turn deflated, stays below.
const MAX_TEXELS_PER_BYTE: usize = 65536;

/// Reads the bytes of an OpenEXR file.
fn read_part(bytes: &[u8], limits: Limits) -> Result<Content, Fault> {
    check_windows(bytes)?;
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(|why| explained(why, "header"))?;
    reader.headers().iter().try_for_each(|header| check_header(header, bytes.len(), limits))?;
    let (part, channels) = suitable_part(reader.headers())?;
    let header = &reader.headers()[part];
    let notes = checked_attributes(header)?;
    let list = header.channels.clone();
    let roughness = stored_roughness(header);
    let (width, height) = (header.layer_size.width(), header.layer_size.height());
    let count = checked_texels(width as u64, height as u64, limits)?;

    let mut missing = BTreeMap::new();
    let mut chunks = reader
        .filter_chunks(false, |_, _, block| {
            let wanted = block.layer == part && block.level == Vec2(0, 0);
            if wanted {
                missing.insert((block.pixel_position.y(), block.pixel_position.x()), block.pixel_size);
            }
            wanted
        })
        .map_err(|why| explained(why, "offset tables"))?;
    let mut twice = None;
    // Only when the first block is sound: a header alone buys no memory.
    let mut pixels: Vec<[f32; 3]> = Vec::new();
    while let Some(chunk) = chunks.read_next_chunk() {
        let chunk = chunk.map_err(|why| explained(why, "pixels"))?;
        let name = name_of_block(&chunk, chunks.headers()).map_err(|why| explained(why, "pixels"))?;
        if is_empty(&chunk) {
            return Err(field("pixels", format!("{name}: there are no bytes for them; the file is damaged")));
        }
        let block = UncompressedBlock::decompress_chunk(chunk, chunks.meta_data(), false)
            .map_err(|why| explained(why, &format!("pixels, {name}")))?;
        let Vec2(x, y) = block.index.pixel_position;
        // An offset may lead to a chunk of another part or level; then one of this is missing in the end.
        if block.index.layer != part || block.index.level != Vec2(0, 0) {
            continue;
        }
        if missing.remove(&(y, x)).is_none() {
            twice = Some(name);
        }
        pixels.resize(count, [0.0; 3]);
        for line in block.lines(&list) {
            let Vec2(x, y) = line.location.position;
            let start = y * width + x;
            let target = pixels
                .get_mut(start..start + line.location.sample_count)
                .ok_or_else(|| field("pixels", "a block lies outside of the data window; the file is damaged"))?;
            for c in (0..3).filter(|&c| channels[c] == line.location.channel) {
                read_line(&line, list.list[channels[c]].sample_type, target, c)?;
            }
        }
    }
    if let Some(((y, x), size)) = missing.pop_first() {
        let gone = name_of_area(Vec2(x, y), size, width);
        let twice = twice.map(|name| format!(", {name} twice")).unwrap_or_default();
        return Err(field("pixels", format!("{gone} missing{twice}; the file is damaged, save or copy it again")));
    }
    let map = Equirect { width, height, pixels };
    let Some(text) = roughness else {
        return Ok(Content::Picture(Picture { map, low_dynamic_range: false, notes }));
    };
    let wrong = |why| field(KEY_ROUGHNESS, why);
    let roughness = roughness_list(&text, text.split(',').count()).map_err(wrong)?;
    let levels = levels_in_strip(&map, roughness.len())
        .ok_or_else(|| wrong(format!("{} levels do not fit a strip of {width} x {height}", roughness.len())))?;
    Ok(Content::Levels(
        StoredLevels { levels, lobe: StoredLobe::Ggx(roughness), slope: Vec::new(), irradiance_sh: None },
        notes,
    ))
}

/// Whether a chunk says that it has no bytes. Some of the decoders below make that black.
fn is_empty(chunk: &Chunk) -> bool {
    match &chunk.compressed_block {
        CompressedBlock::ScanLine(block) => block.compressed_pixels_le.is_empty(),
        CompressedBlock::Tile(block) => block.compressed_pixels_le.is_empty(),
        CompressedBlock::DeepScanLine(_) | CompressedBlock::DeepTile(_) => false,
    }
}

/// Which rows, and of tiles which columns, a chunk says that it holds.
fn name_of_block(chunk: &Chunk, headers: &[Header]) -> exr::error::Result<String> {
    let header = &headers[chunk.layer_index];
    let place = header.get_block_data_indices(&chunk.compressed_block)?;
    let area = header.get_absolute_block_pixel_coordinates(place)?;
    Ok(name_of_area(area.position.to_usize("position")?, area.size, header.layer_size.width()))
}

/// Rows counted from 0 at the top, with columns where it is not all of them.
fn name_of_area(Vec2(x, y): Vec2<usize>, size: Vec2<usize>, width: usize) -> String {
    let span = |name: &str, first: usize, count: usize| match count {
        1 => format!("{name} {first}"),
        _ => format!("{name}s {first} to {}", first + count - 1),
    };
    let rows = span("row", y, size.height());
    if size.width() == width { rows } else { format!("{} of {rows}", span("column", x, size.width())) }
}

/// The text that says that the picture is a strip of levels.
fn stored_roughness(header: &Header) -> Option<String> {
    let mut attributes = header.own_attributes.other.iter();
    attributes.find_map(|(name, value)| match value {
        AttributeValue::Text(text) if *name == *KEY_ROUGHNESS => Some(text.to_string()),
        _ => None,
    })
}

/// Puts one channel of a line into component `c` of its pixels.
fn read_line(line: &LineRef<'_>, kind: SampleType, target: &mut [[f32; 3]], c: usize) -> Result<(), Fault> {
    fn put<T: exr::io::Data>(
        line: &LineRef<'_>,
        target: &mut [[f32; 3]],
        c: usize,
        value: impl Fn(T) -> f32,
    ) -> Result<(), Fault> {
        for (pixel, sample) in target.iter_mut().zip(line.read_samples::<T>()) {
            pixel[c] = value(sample.map_err(|why| explained(why, "pixels"))?);
        }
        Ok(())
    }
    match kind {
        SampleType::F16 => put(line, target, c, f16::to_f32),
        SampleType::F32 => put(line, target, c, |x: f32| x),
        SampleType::U32 => put(line, target, c, |x: u32| x as f32),
    }
}

/// Refuses windows that hold nothing or overflow, which the decoder takes as others: it exchanges their corners.
///
/// The header's attributes follow one another: name and type, each with a NUL, a length of four bytes, the value. What
/// is not so is the decoder's to name.
fn check_windows(bytes: &[u8]) -> Result<(), Fault> {
    // Behind the magic number and the version.
    let mut rest = bytes.get(8..).unwrap_or_default();
    let text = |rest: &mut &[u8]| -> Option<String> {
        let end = rest.iter().take(256).position(|&byte| byte == 0)?;
        let found = String::from_utf8_lossy(&rest[..end]).into_owned();
        *rest = &rest[end + 1..];
        Some(found)
    };
    // A header ends with an empty name; of several headers the last is followed by another.
    let is_one_part = bytes.get(5).is_none_or(|flags| flags & 0x10 == 0);
    let mut before = String::new();
    while let Some(name) = text(&mut rest) {
        if name.is_empty() && (is_one_part || before.is_empty()) {
            break;
        }
        before = name;
        if before.is_empty() {
            continue;
        }
        let Some((kind, length)) = text(&mut rest).zip(rest.split_first_chunk::<4>()) else { break };
        let (length, after) = (u32::from_le_bytes(*length.0) as usize, length.1);
        let Some((value, after)) = after.split_at_checked(length) else { break };
        rest = after;
        if kind == "box2i" && length == 16 && ["dataWindow", "displayWindow"].contains(&before.as_str()) {
            let number = |i: usize| i64::from(i32::from_le_bytes(std::array::from_fn(|k| value[4 * i + k])));
            let [x_min, y_min, x_max, y_max] = [0, 1, 2, 3].map(number);
            let told = format!("from ({x_min}, {y_min}) to ({x_max}, {y_max})");
            if x_max < x_min || y_max < y_min {
                return Err(field(before, format!("{told} it holds nothing; save the file again")));
            }
            let most = i64::from(i32::MAX / 2);
            if [x_min, y_min, x_max, y_max].iter().any(|x| x.abs() >= most) {
                return Err(field(before, format!("{told} is more than a file can hold; save the file again")));
            }
        }
    }
    Ok(())
}

/// Refuses sizes that the file cannot hold and more channels than pictures have.
fn check_header(header: &Header, file_bytes: usize, limits: Limits) -> Result<(), Fault> {
    let (width, height) = (header.layer_size.width(), header.layer_size.height());
    let count = checked_texels(width as u64, height as u64, limits)?;
    if count / MAX_TEXELS_PER_BYTE > file_bytes {
        return Err(field("dataWindow", format!("{width} x {height} texels do not fit a file of {file_bytes} bytes")));
    }
    if header.channels.list.len() > 64 {
        return Err(field("channels", "more than 64 of them; save red, green and blue alone"));
    }
    Ok(())
}

/// The first part that holds colours, and the places of red, green and blue in its list of channels.
fn suitable_part(headers: &[Header]) -> Result<(usize, [usize; 3]), Fault> {
    let flat = |header: &&Header| !header.deep;
    if let Some(found) = headers
        .iter()
        .enumerate()
        .filter(|(_, header)| flat(header))
        .find_map(|(part, header)| colour_channels(header).map(|channels| (part, channels)))
    {
        return Ok(found);
    }
    if !headers.iter().any(|header| flat(&header)) {
        return Err(field("type", "there is only deep data; save the picture flattened"));
    }
    let names: Vec<String> =
        headers.iter().flat_map(|header| &header.channels.list).map(|channel| channel.name.to_string()).collect();
    Err(field("channels", format!("R, G and B are needed, or Y alone, and there are: {}", names.join(", "))))
}

/// Where R, G and B stand, or Y three times.
fn colour_channels(header: &Header) -> Option<[usize; 3]> {
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    // Plain names first, then those of the first layer or view that has all three.
    let mut prefixes = vec![""];
    for name in &names {
        let prefix = &name[..name.rfind('.').map_or(0, |dot| dot + 1)];
        if !prefixes.contains(&prefix) {
            prefixes.push(prefix);
        }
    }
    let place = |prefix: &str, wanted: &str| {
        names.iter().position(|name| name.strip_prefix(prefix).is_some_and(|rest| rest.eq_ignore_ascii_case(wanted)))
    };
    prefixes.iter().find_map(|prefix| match [place(prefix, "R"), place(prefix, "G"), place(prefix, "B")] {
        [Some(r), Some(g), Some(b)] => Some([r, g, b]),
        // With RY and BY beside it, Y is no grey but part of a colour.
        [None, None, None] if place(prefix, "RY").is_none() => place(prefix, "Y").map(|y| [y; 3]),
        _ => None,
    })
}

/// Refuses what would be read wrongly; gives what its owner may not expect.
fn checked_attributes(header: &Header) -> Result<Vec<String>, Fault> {
    if let Some(channel) = header.channels.list.iter().find(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(field("channels", format!("{} is subsampled; save it at full resolution", channel.name)));
    }
    if header.own_attributes.environment_map == Some(EnvironmentMap::Cube) {
        return Err(field("envmap", "OpenEXR's own cube layout is not read; convert it to latlong"));
    }
    let window = header.shared_attributes.display_window.size;
    if window != header.layer_size {
        let (wide, high) = (header.layer_size.width(), header.layer_size.height());
        return Err(field(
            "dataWindow",
            format!(
                "{wide} x {high} is not the displayWindow of {} x {}; save the whole map, without crop or overscan",
                window.width(),
                window.height()
            ),
        ));
    }
    let mut notes = Vec::new();
    if header.shared_attributes.chromaticities.is_some_and(|found| !is_rec709(&found)) {
        notes.push("its chromaticities are not those of Rec. 709; the values are taken as Rec. 709".to_owned());
    }
    Ok(notes)
}

/// ITU-R BT.709-6 primaries; the white point is not looked at.
fn is_rec709(found: &Chromaticities) -> bool {
    let near = |a: Vec2<f32>, x: f32, y: f32| (a.0 - x).abs() < 0.01 && (a.1 - y).abs() < 0.01;
    near(found.red, 0.64, 0.33) && near(found.green, 0.30, 0.60) && near(found.blue, 0.15, 0.06)
}

/// The reader below is another's and reads hostile bytes: a panic inside it must stay one file's error.
pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<Content, Fault> {
    catch_unwind(AssertUnwindSafe(|| read_part(bytes, limits)))
        .unwrap_or_else(|_| Err(field("pixels", "the decoder gave up on them; the file is damaged")))
}

/// What the decoder found wrong with a part of the file. It says the end of the file in these words.
fn explained(error: exr::error::Error, part: &str) -> Fault {
    match error {
        exr::error::Error::Invalid(what) if what == "reference to missing bytes" => {
            Fault::Truncated(format!("its {part}"))
        }
        exr::error::Error::NotSupported(what) => {
            field(part, format!("{what} cannot be read; save as a flat, plain file"))
        }
        other => field(part, format!("{other}; the file is damaged, save or copy it again")),
    }
}
