//! What is said of a text that cannot be cut into functions, structs, constants and aliases.

use halfvector_shaders::{SliceError, SliceErrorKind};

use super::habits::no_item;
use super::{Complaint, word_at};

/// What the slicer has against a text.
pub(in super::super) fn of_slicer(text: &str, error: &SliceError) -> Complaint {
    let at = error.offset;
    let message = error.to_string();
    let plain = message.split_once(": ").map_or(message.as_str(), |(_, message)| message).to_owned();
    match &error.kind {
        SliceErrorKind::NotAnItem(found) if found == "#" => {
            let word = text.get(at + 1..).map_or("", |rest| word_at(rest, rest.len() - rest.trim_start().len()));
            (at, no_item(&format!("#{word}")).unwrap_or(plain))
        }
        SliceErrorKind::NotAnItem(found) => (at, no_item(found).unwrap_or(plain)),
        SliceErrorKind::Unfinished => made_in_braces(text, at).unwrap_or((at, plain)),
        _ => (at, plain),
    }
}

/// `const A = { ... }` and `const A = array<f32, 2>{ ... }`.
fn made_in_braces(text: &str, at: usize) -> Option<Complaint> {
    let rest = text.get(at..)?.strip_prefix("const")?;
    let brace = rest.find(['{', ';', '}']).filter(|brace| rest[*brace..].starts_with('{'))?;
    let (_, value) = rest[..brace].split_once('=')?;
    let told = match value.trim() {
        "" => "a value is made by its type: `vec3f(...)`, `array<f32, 2>(...)` or a struct's name".into(),
        made => format!("a value is made in round brackets: `{made}(...)`"),
    };
    Some((at + "const".len() + brace, told))
}
