//! Fields of a document: their shapes, with line and place where they are wrong.

use super::{Wrong, wrong};
use crate::document::{Rect, SocketRef};
use crate::json::{Json, Member, Spanned};
use crate::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

pub(super) fn object(value: Spanned, place: &str) -> Result<Vec<Member>, Wrong> {
    match value.json {
        Json::Object(members) => Ok(members),
        other => wrong(value.at, place, format!("an object {{...}} is needed, not {}", other.kind())),
    }
}

pub(super) fn list(value: Spanned, place: &str) -> Result<Vec<Spanned>, Wrong> {
    match value.json {
        Json::Array(items) => Ok(items),
        other => wrong(value.at, place, format!("a list [...] is needed, not {}", other.kind())),
    }
}

pub(super) fn text(value: Spanned, place: &str) -> Result<String, Wrong> {
    match value.json {
        Json::String(s) => Ok(s),
        other => wrong(value.at, place, format!("a text in \" is needed, not {}", other.kind())),
    }
}

pub(super) fn members_of<'v>(value: &'v Spanned, place: &str) -> Result<&'v [Member], Wrong> {
    match &value.json {
        Json::Object(members) => Ok(members),
        other => wrong(value.at, place, format!("an object {{...}} is needed, not {}", other.kind())),
    }
}

pub(super) fn text_of<'v>(value: &'v Spanned, place: &str) -> Result<&'v str, Wrong> {
    match &value.json {
        Json::String(s) => Ok(s),
        other => wrong(value.at, place, format!("a text in \" is needed, not {}", other.kind())),
    }
}

pub(super) fn number(value: &Spanned, place: &str) -> Result<f32, Wrong> {
    match &value.json {
        // Straight to f32: through f64 it could be rounded twice.
        Json::Number(digits) => Ok(digits.parse().unwrap_or(f32::NAN)),
        Json::String(s) if s == "nan" => Ok(f32::NAN),
        Json::String(s) if s == "inf" => Ok(f32::INFINITY),
        Json::String(s) if s == "-inf" => Ok(f32::NEG_INFINITY),
        other => wrong(value.at, place, format!("a number is needed, not {}", other.kind())),
    }
}

pub(super) fn pair(value: &Spanned, place: &str) -> Result<[f32; 2], Wrong> {
    match &value.json {
        Json::Array(items) if items.len() == 2 => Ok([number(&items[0], place)?, number(&items[1], place)?]),
        _ => wrong(value.at, place, "two numbers are needed, such as [0, 1]"),
    }
}

pub(super) fn socket_value(value: &Spanned, place: &str) -> Result<Value, Wrong> {
    match &value.json {
        Json::Bool(b) => Ok(Value::Bool(*b)),
        Json::Number(digits) => Ok(Value::from_digits(digits).unwrap_or(Value::Number(f32::NAN))),
        Json::String(_) => Ok(Value::Number(number(value, place)?)),
        Json::Array(items) => {
            let numbers: Vec<f32> = items.iter().map(|item| number(item, place)).collect::<Result<_, _>>()?;
            match *numbers.as_slice() {
                [x, y] => Ok(Value::Vec2([x, y])),
                [x, y, z] => Ok(Value::Vec3([x, y, z])),
                [x, y, z, w] => Ok(Value::Vec4([x, y, z, w])),
                _ => wrong(value.at, place, format!("a vector has 2, 3 or 4 numbers, not {}", numbers.len())),
            }
        }
        Json::Object(_) => Ok(Value::Image(read_image(value, place)?)),
        Json::Null => {
            wrong(value.at, place, "a value is a number, true or false, a list of 2 to 4 numbers or an image, not null")
        }
    }
}

fn read_image(value: &Spanned, place: &str) -> Result<ImageRef, Wrong> {
    let mut file = None;
    let mut color_space = None;
    let (mut wrap_u, mut wrap_v, mut filter) = (Wrap::default(), Wrap::default(), Filter::default());
    for Member { at, key, value } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "file" => file = Some(text_of(value, place)?.to_string()),
            "color_space" => {
                color_space =
                    Some(choice(value, place, &[("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)])?);
            }
            "wrap_u" => wrap_u = choice(value, place, WRAPS)?,
            "wrap_v" => wrap_v = choice(value, place, WRAPS)?,
            "filter" => filter = choice(value, place, &[("linear", Filter::Linear), ("nearest", Filter::Nearest)])?,
            _ => return wrong(*at, place, "an image has the fields file, color_space, wrap_u, wrap_v and filter"),
        }
    }
    match (file, color_space) {
        (Some(file), Some(color_space)) => Ok(ImageRef { file, color_space, wrap_u, wrap_v, filter }),
        (None, _) => wrong(value.at, place, "the image's field `file` is missing"),
        (_, None) => wrong(
            value.at,
            place,
            "the image's field `color_space` is missing: \"srgb\" for colours, \"linear\" for everything else",
        ),
    }
}

const WRAPS: &[(&str, Wrap)] = &[("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp), ("mirror", Wrap::Mirror)];

pub(super) fn choice<T: Copy>(value: &Spanned, place: &str, choices: &[(&str, T)]) -> Result<T, Wrong> {
    let given = text_of(value, place)?;
    match choices.iter().find(|(name, _)| *name == given) {
        Some((_, choice)) => Ok(*choice),
        None => {
            let names: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            wrong(value.at, place, format!("\"{given}\" is none of {}", names.join(", ")))
        }
    }
}

pub(super) fn socket(value: &Spanned, place: &str) -> Result<SocketRef, Wrong> {
    let written = text_of(value, place)?;
    match SocketRef::parse(written) {
        Some(socket) => Ok(socket),
        None => wrong(value.at, place, format!("\"{written}\" names no socket; write it as \"node.socket\"")),
    }
}

/// Four numbers: a corner, width and height.
pub(super) fn rect(value: &Spanned, place: &str) -> Result<Rect, Wrong> {
    match &value.json {
        Json::Array(items) if items.len() == 4 => {
            let [x, y, width, height] = [0, 1, 2, 3].map(|i| number(&items[i], place));
            Ok(Rect { position: [x?, y?], size: [width?, height?] })
        }
        _ => wrong(value.at, place, "four numbers are needed: x, y, width and height, such as [0, 0, 300, 200]"),
    }
}

/// A colour as `#rrggbb`.
pub(super) fn color(value: &Spanned, place: &str) -> Result<[u8; 3], Wrong> {
    let written = text_of(value, place)?;
    let digits = written.strip_prefix('#').filter(|d| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit()));
    match digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
        Some(number) => {
            let [_, r, g, b] = number.to_be_bytes();
            Ok([r, g, b])
        }
        None => wrong(value.at, place, format!("\"{written}\" is no colour; write it as \"#rrggbb\"")),
    }
}

/// A text of several lines: a list of them, or one text.
pub(super) fn lines(value: &Spanned, place: &str) -> Result<String, Wrong> {
    match &value.json {
        Json::Array(lines) => {
            let lines: Vec<&str> = lines.iter().map(|line| text_of(line, place)).collect::<Result<_, _>>()?;
            Ok(lines.join("\n"))
        }
        _ => text_of(value, place).map(str::to_string),
    }
}
