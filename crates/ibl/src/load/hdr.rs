//! Radiance `.hdr`: flat, old and new run lengths, all eight orientations, RGBE and XYZE.
//!
//! Values are mantissa * 2^(exponent - 136), as nearly all programs read them. EXPOSURE and COLORCORR lines say by what
//! the values have been multiplied, so they are divided by it, and the user is told. PRIMARIES are told, not applied.

use super::{Fault, Limits, Picture, checked_texels, field};
use crate::equirect::Equirect;

/// The header is text; a file whose header goes on for longer is not one.
const MAX_HEADER: usize = 65536;

/// Larsson and Shakespeare 1998, "Rendering with Radiance", and the Radiance file format page (Ward).
pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<Picture, Fault> {
    let mut rest = bytes;
    let header = Header::parsed(&mut rest)?;
    let size = Size::parsed(line(&mut rest, bytes.len())?)?;
    let count = checked_texels(size.line_length as u64, size.lines as u64, limits)?;

    // Grows with what the file really holds: a header alone buys no memory.
    let mut texels: Vec<[u8; 4]> = Vec::new();
    while texels.len() < count {
        scan_line(&mut rest, &mut texels, size.line_length)?;
    }

    let (width, height) =
        if size.columns_first { (size.lines, size.line_length) } else { (size.line_length, size.lines) };
    let mut pixels = vec![[0.0; 3]; count];
    for (k, texel) in texels.iter().enumerate() {
        let (line, along) = (k / size.line_length, k % size.line_length);
        let (x, y) = if size.columns_first { (line, along) } else { (along, line) };
        let x = if size.from_right { width - 1 - x } else { x };
        let y = if size.from_bottom { height - 1 - y } else { y };
        pixels[y * width + x] = header.radiance(*texel);
    }
    Ok(Picture { map: Equirect { width, height, pixels }, low_dynamic_range: false, notes: header.notes() })
}

/// What the text before the resolution says.
struct Header {
    xyz: bool,
    /// By what the values have been multiplied, all EXPOSURE lines together.
    exposure: f32,
    /// The same by channel, all COLORCORR lines together.
    colorcorr: [f32; 3],
    /// Chromaticities of red, green, blue and white that are not Radiance's or Rec. 709's.
    other_primaries: bool,
}

impl Header {
    fn parsed(rest: &mut &[u8]) -> Result<Header, Fault> {
        let whole = rest.len();
        let mut header = Header { xyz: false, exposure: 1.0, colorcorr: [1.0; 3], other_primaries: false };
        line(rest, whole)?;
        loop {
            let text = line(rest, whole)?;
            if text.is_empty() {
                break;
            }
            let Some(equals) = text.iter().position(|&b| b == b'=') else { continue };
            let value = text[equals + 1..].trim_ascii();
            match &text[..equals] {
                b"FORMAT" => match value {
                    b"32-bit_rle_rgbe" => header.xyz = false,
                    b"32-bit_rle_xyze" => header.xyz = true,
                    other => {
                        let other = String::from_utf8_lossy(other).into_owned();
                        return Err(field("FORMAT", format!("{other} is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze")));
                    }
                },
                b"EXPOSURE" => header.exposure *= factors::<1>("EXPOSURE", value)?[0],
                b"COLORCORR" => {
                    let more = factors::<3>("COLORCORR", value)?;
                    header.colorcorr = std::array::from_fn(|c| header.colorcorr[c] * more[c]);
                }
                b"PRIMARIES" => header.other_primaries = !usual_primaries(factors::<8>("PRIMARIES", value)?),
                _ => {}
            }
        }
        let together = header.colorcorr.map(|c| c * header.exposure);
        if !together.iter().all(|x| x.is_normal()) {
            return Err(field("EXPOSURE", "with COLORCORR it is too large or small; the header is damaged"));
        }
        Ok(header)
    }

    /// The linear Rec. 709 colour of a texel.
    fn radiance(&self, texel: [u8; 4]) -> [f32; 3] {
        let c = decoded(texel);
        let c = std::array::from_fn(|i| c[i] / (self.exposure * self.colorcorr[i]));
        if self.xyz { rec709_from_xyz(c) } else { c }
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.exposure != 1.0 {
            notes
                .push(format!("EXPOSURE: the file's values were multiplied by {}; this is divided out", self.exposure));
        }
        if self.colorcorr != [1.0; 3] {
            let [r, g, b] = self.colorcorr;
            notes.push(format!("COLORCORR: the file's values were multiplied by {r} {g} {b}; this is divided out"));
        }
        if self.other_primaries {
            notes.push("PRIMARIES: they are not those of Rec. 709; the values are taken as Rec. 709".to_owned());
        }
        notes
    }
}

/// The N positive numbers of a line of the header.
fn factors<const N: usize>(name: &str, text: &[u8]) -> Result<[f32; N], Fault> {
    let numbers = std::str::from_utf8(text).ok().and_then(|text| {
        let numbers: Option<Vec<f32>> = text
            .split_ascii_whitespace()
            .map(|word| word.parse().ok().filter(|x: &f32| x.is_normal() && *x > 0.0))
            .collect();
        numbers?.try_into().ok()
    });
    numbers.ok_or_else(|| {
        let text = String::from_utf8_lossy(&text[..text.len().min(60)]).into_owned();
        field(name, format!("\"{text}\" is not {N} number{} above 0", if N == 1 { "" } else { "s" }))
    })
}

/// Rec. 709 primaries (ITU-R BT.709-6), or Radiance's own, which are as good as the same.
fn usual_primaries([rx, ry, gx, gy, bx, by, ..]: [f32; 8]) -> bool {
    let near = |a: f32, b: f32| (a - b).abs() < 0.015;
    near(rx, 0.64) && near(ry, 0.33) && near(gx, 0.295) && near(gy, 0.6) && near(bx, 0.15) && near(by, 0.06)
}

/// The next line of the header, without its end.
fn line<'a>(rest: &mut &'a [u8], whole: usize) -> Result<&'a [u8], Fault> {
    let text = *rest;
    let Some(end) = text.iter().take(MAX_HEADER).position(|&b| b == b'\n') else {
        return Err(if text.len() >= MAX_HEADER || whole - text.len() > MAX_HEADER {
            field("header", "it does not end; is this a Radiance file?")
        } else {
            Fault::Truncated("its header".to_owned())
        });
    };
    *rest = &text[end + 1..];
    Ok(text[..end].strip_suffix(b"\r").unwrap_or(&text[..end]))
}

/// The resolution line, such as "-Y 512 +X 1024": the first axis counts lines, the second texels along a line.
struct Size {
    lines: usize,
    line_length: usize,
    /// Lines are columns.
    columns_first: bool,
    from_right: bool,
    from_bottom: bool,
}

impl Size {
    fn parsed(text: &[u8]) -> Result<Size, Fault> {
        let wrong = || {
            let text = String::from_utf8_lossy(&text[..text.len().min(60)]).into_owned();
            field("resolution", format!("\"{text}\" is not of the form \"-Y height +X width\""))
        };
        let text = std::str::from_utf8(text).map_err(|_| wrong())?;
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let &[major, lines, minor, line_length] = words.as_slice() else { return Err(wrong()) };
        let number = |word: &str| word.parse::<u32>().map(|n| n as usize).map_err(|_| wrong());
        let (columns_first, vertical, horizontal) = match (major, minor) {
            ("-Y" | "+Y", "-X" | "+X") => (false, major, minor),
            ("-X" | "+X", "-Y" | "+Y") => (true, minor, major),
            _ => return Err(wrong()),
        };
        Ok(Size {
            lines: number(lines)?,
            line_length: number(line_length)?,
            columns_first,
            from_right: horizontal == "-X",
            // +Y points up, so lines that follow +Y start at the bottom.
            from_bottom: vertical == "+Y",
        })
    }
}

/// Reads one line's texels on to `texels`, in whichever of the three codings it is.
fn scan_line(rest: &mut &[u8], texels: &mut Vec<[u8; 4]>, length: usize) -> Result<(), Fault> {
    let number = texels.len() / length;
    let ended = || Fault::Truncated(format!("line {number} of its pixels"));
    let first = *rest.first_chunk::<4>().ok_or_else(ended)?;
    // Radiance writes lines of these lengths alone in the new coding, and no texel of its own starts with (2, 2, < 128).
    let new_style = (8..0x8000).contains(&length) && first[..2] == [2, 2] && first[2] < 128;
    if !new_style {
        return old_line(rest, texels, length);
    }
    let stated = usize::from(first[2]) << 8 | usize::from(first[3]);
    if stated != length {
        return Err(field(
            "resolution",
            format!(
                "lines of {length} texels, where line {number} says that it has {stated}; one of the two is damaged"
            ),
        ));
    }
    let mut data = &rest[4..];
    let start = texels.len();
    // Each component's runs give at most 127 texels for two bytes: no file can ask for more than 64 times its length.
    if data.len() < 4 * 2 * length.div_ceil(127) {
        return Err(ended());
    }
    texels.resize(start + length, [0; 4]);
    for component in 0..4 {
        let mut x = 0;
        while x < length {
            let &[code, value] = data.first_chunk::<2>().ok_or_else(ended)?;
            let run = if code > 128 { usize::from(code - 128) } else { usize::from(code) };
            if run == 0 || run > length - x {
                return Err(field(
                    format!("run lengths of line {number}"),
                    format!("a run of {run} at texel {x} of {length}; the file is damaged"),
                ));
            }
            let target = &mut texels[start + x..start + x + run];
            if code > 128 {
                target.iter_mut().for_each(|texel| texel[component] = value);
                data = &data[2..];
            } else {
                let values = data.get(1..1 + run).ok_or_else(ended)?;
                target.iter_mut().zip(values).for_each(|(texel, value)| texel[component] = *value);
                data = &data[1 + run..];
            }
            x += run;
        }
    }
    *rest = data;
    Ok(())
}

/// A line of plain texels, among which (1, 1, 1, n) repeats the one before n times, and directly after another such code
/// n * 256 times, and so on.
fn old_line(rest: &mut &[u8], texels: &mut Vec<[u8; 4]>, length: usize) -> Result<(), Fault> {
    let start = texels.len();
    let number = start / length;
    let mut shift = 0;
    while texels.len() < start + length {
        let texel = *rest.first_chunk::<4>().ok_or_else(|| Fault::Truncated(format!("line {number} of its pixels")))?;
        *rest = &rest[4..];
        if texel[..3] == [1, 1, 1] {
            let wrong =
                |reason: &str| field(format!("run lengths of line {number}"), format!("{reason}; the file is damaged"));
            let last = *texels.last().ok_or_else(|| wrong("a repetition of nothing"))?;
            let run = if shift < 32 { usize::from(texel[3]) << shift } else { usize::MAX };
            if run > start + length - texels.len() {
                return Err(wrong("a run goes beyond its line"));
            }
            texels.resize(texels.len() + run, last);
            shift += 8;
        } else {
            texels.push(texel);
            shift = 0;
        }
    }
    Ok(())
}

/// The three numbers of a texel: mantissa * 2^(exponent - 136), exponent 0 is black.
fn decoded([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let scale = (f32::from(exponent) - 136.0).exp2();
    [r, g, b].map(|x| f32::from(x) * scale)
}

/// CIE XYZ of Radiance's equal-energy white to linear Rec. 709 (ITU-R BT.709-6 primaries), each row scaled so that
/// X = Y = Z gives grey.
fn rec709_from_xyz([x, y, z]: [f32; 3]) -> [f32; 3] {
    const M: [[f32; 3]; 3] =
        [[3.240_970, -1.537_383, -0.498_611], [-0.969_244, 1.875_968, 0.041_555], [0.055_630, -0.203_977, 1.056_972]];
    M.map(|row| (row[0] * x + row[1] * y + row[2] * z) / row.iter().sum::<f32>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(bytes: &[u8]) -> Result<Equirect, String> {
        picture(bytes).map(|picture| picture.map)
    }

    fn picture(bytes: &[u8]) -> Result<Picture, String> {
        read(bytes, Limits::default()).map_err(|fault| match fault {
            Fault::Field(field, reason) => format!("{field}: {reason}"),
            Fault::Truncated(field) => format!("truncated: {field}"),
            Fault::TooLarge { .. } => "too large".to_owned(),
            Fault::Image(error) => error.to_string(),
        })
    }

    fn file(resolution: &str, data: &[u8]) -> Vec<u8> {
        with_header("", resolution, data)
    }

    fn with_header(header: &str, resolution: &str, data: &[u8]) -> Vec<u8> {
        let start = b"#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n";
        [start, header.as_bytes(), b"\n", resolution.as_bytes(), b"\n", data].concat()
    }

    /// What the header says was multiplied in is divided out again, and told.
    #[test]
    fn exposures_are_divided_out() {
        let read = |header| picture(&with_header(header, "-Y 1 +X 1", &[16, 32, 64, 136]));
        let plain = read("EXPOSURE= 1.0\nSOFTWARE=x\n").unwrap();
        assert_eq!((plain.map.pixels[0], plain.notes.len()), ([16.0, 32.0, 64.0], 0));
        let changed = read("EXPOSURE=2\nCOLORCORR=1 2 4\nEXPOSURE=4\nPRIMARIES=.7 .3 .17 .8 .13 .05 .3 .3\n").unwrap();
        assert_eq!(changed.map.pixels[0], [2.0, 2.0, 2.0]);
        assert_eq!(changed.notes.len(), 3, "{:?}", changed.notes);
        for wrong in ["EXPOSURE=0\n", "EXPOSURE=two\n", "EXPOSURE=1e-30\nEXPOSURE=1e-30\n"] {
            assert!(read(wrong).err().is_some_and(|error| error.starts_with("EXPOSURE")), "{wrong}");
        }
        assert!(read("COLORCORR=1 1\n").err().is_some_and(|error| error.starts_with("COLORCORR")));
        // Grey stays grey when the file holds X, Y and Z.
        let xyz = with_header("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1", &[64, 64, 64, 136]);
        assert!(pixels(&xyz).unwrap().pixels[0].iter().all(|x| (x - 64.0).abs() < 1e-3));
    }

    /// Each orientation says where its first texel lies and which way the second is.
    #[test]
    fn orientations() {
        let texels: Vec<u8> = (0..6u8).flat_map(|i| [i * 16, 0, 0, 136]).collect();
        for (resolution, size, first, second) in [
            ("-Y 2 +X 3", (3, 2), (0, 0), (1, 0)),
            ("-Y 2 -X 3", (3, 2), (2, 0), (1, 0)),
            ("+Y 2 +X 3", (3, 2), (0, 1), (1, 1)),
            ("+Y 2 -X 3", (3, 2), (2, 1), (1, 1)),
            ("+X 2 -Y 3", (2, 3), (0, 0), (0, 1)),
            ("-X 2 -Y 3", (2, 3), (1, 0), (1, 1)),
            ("+X 2 +Y 3", (2, 3), (0, 2), (0, 1)),
            ("-X 2 +Y 3", (2, 3), (1, 2), (1, 1)),
        ] {
            let map = pixels(&file(resolution, &texels)).unwrap();
            assert_eq!((map.width, map.height), size, "{resolution}");
            let at = |(x, y): (usize, usize)| map.pixels[y * map.width + x][0];
            assert_eq!((at(first), at(second)), (0.0, 16.0), "{resolution}");
        }
    }

    #[test]
    fn both_run_lengths() {
        let mut new = vec![2, 2, 0, 9];
        new.extend([128 + 9, 128]);
        new.extend([3, 1, 2, 3, 128 + 6, 7]);
        new.extend([128 + 9, 0, 128 + 9, 136]);
        let map = pixels(&file("-Y 1 +X 9", &new)).unwrap();
        assert_eq!(map.pixels[0], [128.0, 1.0, 0.0]);
        assert_eq!(map.pixels[8], [128.0, 7.0, 0.0]);
        let old = [9, 8, 7, 137, 1, 1, 1, 3, 5, 5, 5, 135];
        let map = pixels(&file("-Y 1 +X 5", &old)).unwrap();
        assert_eq!(
            map.pixels,
            [[18.0, 16.0, 14.0], [18.0, 16.0, 14.0], [18.0, 16.0, 14.0], [18.0, 16.0, 14.0], [2.5; 3]]
        );
    }

    /// A line too short for the new coding may start with its code; a texel of a long one may, but for its third byte.
    #[test]
    fn texels_like_a_code() {
        let short = pixels(&file("-Y 1 +X 2", &[2, 2, 0, 136, 2, 2, 2, 136])).unwrap();
        assert_eq!(short.pixels, [[2.0, 2.0, 0.0], [2.0; 3]]);
        let long = pixels(&file("-Y 1 +X 9", &[2, 2, 128, 136].repeat(9))).unwrap();
        assert_eq!(long.pixels, [[2.0, 2.0, 128.0]; 9]);
    }

    #[test]
    fn lies_are_named() {
        for (bytes, part) in [
            (file("-Y 4000000000 +X 4000000000", &[]), "too large"),
            (file("-Y 0 +X 4", &[]), "size"),
            (file("-Y 4 +X -4", &[]), "resolution"),
            (file("-Y 4 +Y 4", &[]), "resolution"),
            (file("-Y 1 +X 4", &[0; 15]), "truncated: line 0"),
            (
                file("-Y 1 +X 9", &[2, 2, 0, 9, 128 + 10, 0, 128 + 9, 0, 128 + 9, 0, 128 + 9, 0]),
                "run lengths of line 0",
            ),
            (file("-Y 1 +X 4", &[1, 1, 1, 4]), "run lengths of line 0"),
            (
                file("-Y 1 +X 9", &[2, 2, 4, 0, 128 + 9, 0]),
                "resolution: lines of 9 texels, where line 0 says that it has 1024",
            ),
            (b"#?RADIANCE\nFORMAT=jpeg\n\n".to_vec(), "FORMAT"),
            (b"#?RADIANCE".to_vec(), "truncated: its header"),
            (vec![b'#'; 70000], "header"),
        ] {
            let error = pixels(&bytes).unwrap_err();
            assert!(error.contains(part), "{error} should name {part}");
        }
    }
}
