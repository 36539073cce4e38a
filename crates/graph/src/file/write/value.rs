//! Values as JSON text, in one line each.

use std::fmt::Write;
use std::io;

use serde::Serialize;
use serde_json::ser::Formatter;
use serde_json::{Map, Value as Plain};

use crate::document::Rect;
use crate::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

pub(super) fn value_json(value: &Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Number(x) => number(*x),
        Value::Integer(x) => x.to_string(),
        // With an exponent where that is shorter.
        Value::Decimal { exact, .. } => format!("{exact:?}"),
        Value::Vec2(v) => numbers(v),
        Value::Vec3(v) => numbers(v),
        Value::Vec4(v) => numbers(v),
        Value::Image(image) => image_json(image),
    }
}

fn image_json(image: &ImageRef) -> String {
    let color_space = match image.color_space {
        ColorSpace::Srgb => "srgb",
        ColorSpace::Linear => "linear",
    };
    let mut out = format!("{{\"file\": {}, \"color_space\": \"{color_space}\"", quoted(&image.file));
    for (name, wrap) in [("wrap_u", image.wrap_u), ("wrap_v", image.wrap_v)] {
        let wrap = match wrap {
            Wrap::Repeat => continue,
            Wrap::Clamp => "clamp",
            Wrap::Mirror => "mirror",
        };
        let _ = write!(out, ", \"{name}\": \"{wrap}\"");
    }
    if image.filter == Filter::Nearest {
        out.push_str(", \"filter\": \"nearest\"");
    }
    out.push('}');
    out
}

/// A value that this version does not know, with the writer's own spacing.
pub(super) fn plain_json(value: &Plain) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Spaced);
    // Writing to memory does not fail; without spaces it is the same value.
    match value.serialize(&mut serializer) {
        Ok(()) => String::from_utf8(bytes).unwrap_or_else(|_| value.to_string()),
        Err(_) => value.to_string(),
    }
}

/// Everything in one line, with a space after each `,` and `:`.
struct Spaced;

impl Formatter for Spaced {
    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { writer.write_all(b", ") }
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { writer.write_all(b", ") }
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

pub(super) fn quoted(text: &str) -> String {
    Plain::from(text).to_string()
}

pub(super) fn numbers(numbers: &[f32]) -> String {
    let items: Vec<String> = numbers.iter().map(|x| number(*x)).collect();
    format!("[{}]", items.join(", "))
}

/// The shortest digits that read back as the same number. JSON has no infinities: they, and NaN, are written as texts, so that an
/// unsound document survives saving and `check` still sees it.
pub(super) fn number(x: f32) -> String {
    if x.is_nan() {
        return "\"nan\"".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "\"inf\"".into() } else { "\"-inf\"".into() };
    }
    let magnitude = x.abs();
    // Fewer digits would be those of another whole number: it reads back as that one.
    if x.fract() == 0.0 && (16_777_216.0..=2_147_483_648.0).contains(&magnitude) {
        return f64::from(x).to_string();
    }
    if magnitude == 0.0 || (1e-6..1e9).contains(&magnitude) { format!("{x}") } else { format!("{x:e}") }
}

pub(super) fn rect(rect: &Rect) -> String {
    let ([x, y], [width, height]) = (rect.position, rect.size);
    numbers(&[x, y, width, height])
}

pub(super) fn push_unknown(fields: &mut Vec<String>, unknown: &Map<String, Plain>, known: &[&str]) {
    for (key, value) in unknown {
        if !known.contains(&key.as_str()) {
            fields.push(format!("{}: {}", quoted(key), plain_json(value)));
        }
    }
}
