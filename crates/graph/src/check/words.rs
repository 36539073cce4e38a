//! Words for problems: types and values as people say them, and the name that was probably meant.

use crate::value::{SocketType, Type, Value};

/// A label without line breaks and other control characters.
pub(crate) fn one_line(label: &str) -> String {
    label.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Names of a ring, the first one again at its end; of a long one just its start.
pub(crate) fn ring(labels: &[String]) -> String {
    const SHOWN: usize = 8;
    let mut text: Vec<String> =
        labels.iter().take(SHOWN).map(|label| format!("\u{201c}{}\u{201d}", one_line(label))).collect();
    if labels.len() > SHOWN {
        text.push(format!("{} more", labels.len() - SHOWN));
    }
    text.extend(text.first().cloned());
    text.join(" -> ")
}

/// What a socket takes.
pub(crate) fn socket_type(ty: SocketType) -> &'static str {
    match ty {
        SocketType::Value(ty) => ty.wgsl(),
        SocketType::Generic => "T",
        SocketType::Texture => "picture",
        SocketType::Surface => "surface",
    }
}

/// How to write a value of a type.
pub(crate) fn example(ty: SocketType) -> &'static str {
    match ty {
        SocketType::Value(Type::Bool) => "true or false",
        SocketType::Value(Type::I32) => "a whole number from -2147483648 to 2147483647, such as 3",
        SocketType::Value(Type::F32) => "a number, such as 0.5",
        SocketType::Value(Type::Vec2) => "two numbers, such as [0.5, 0.5]",
        SocketType::Value(Type::Vec3) => "three numbers, such as [0.5, 0.5, 0.5]",
        SocketType::Value(Type::Vec4) => "four numbers, such as [0.5, 0.5, 0.5, 1]",
        SocketType::Generic => "a number",
        SocketType::Texture => "a picture, such as {\"file\": \"rust.png\", \"color_space\": \"srgb\"}",
        SocketType::Surface => "nothing: it takes a link only",
    }
}

/// What a value is.
pub(crate) fn value(value: &Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        // As an f64 it has all its digits; of a very large one nobody counts them.
        Value::Number(x) if x.fract() == 0.0 && x.abs() < 1e12 => format!("the number {}", f64::from(*x)),
        Value::Number(x) => format!("the number {x:?}"),
        Value::Integer(x) => format!("the number {x}"),
        Value::Decimal { exact, .. } => format!("the number {exact:?}"),
        Value::Vec2(_) => "two numbers".into(),
        Value::Vec3(_) => "three numbers".into(),
        Value::Vec4(_) => "four numbers".into(),
        Value::Image(_) => "a picture".into(),
    }
}

/// What is lost when `from` stands where `to` is wanted, and what helps.
pub(crate) fn refusal(from: SocketType, to: SocketType) -> &'static str {
    use Type::{Bool, F32, I32};
    match (from, to) {
        (_, SocketType::Texture) => "a picture is set on the node, not linked",
        (SocketType::Surface, _) => "a surface goes into a node that mixes surfaces, or is the end of the material",
        (_, SocketType::Surface) => "link the output of a surface node",
        (SocketType::Value(Bool), _) => "a switch is no number; let it choose between two values with a select node",
        (_, SocketType::Value(Bool)) => "a number is no switch; compare it with another one first",
        (SocketType::Value(F32), SocketType::Value(I32)) => "the fraction would be lost; round it first",
        (SocketType::Value(from), SocketType::Value(to)) if from.components() > to.components() => {
            "components would be lost; take those that you need with a node that separates them"
        }
        (SocketType::Value(_), SocketType::Value(_)) => {
            "components are missing; put them together with a node that combines them"
        }
        _ => "these do not go together",
    }
}

/// The candidate that `name` was probably meant to be: at most a third of it differs.
pub(crate) fn nearest<'c>(name: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    if name.len() > 64 {
        return None;
    }
    // As much as the lengths differ at least.
    let is_near = |candidate: &&str| candidate.len().abs_diff(name.len()) * 3 <= name.len().max(candidate.len());
    let best = candidates
        .filter(is_near)
        .map(|candidate| (distance(name, candidate), candidate))
        // Of two as near, the one that is written on or cut off.
        .min_by_key(|(distance, candidate)| (*distance, !name.starts_with(candidate) && !candidate.starts_with(name)));
    best.filter(|(distance, candidate)| *distance * 3 <= name.len().max(candidate.len()))
        .map(|(_, candidate)| candidate)
}

/// How many characters must be put in, taken out or exchanged. Levenshtein 1966, "Binary codes capable of correcting deletions,
/// insertions, and reversals".
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let exchanged = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = exchanged.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_found_and_strangers_are_not() {
        let names = ["metallic", "perceptual_roughness", "base_color"];
        assert_eq!(nearest("base_colour", names.into_iter()), Some("base_color"));
        assert_eq!(nearest("metalic", names.into_iter()), Some("metallic"));
        assert_eq!(nearest("height", names.into_iter()), None);
        assert_eq!(distance("kitten", "sitting"), 3);
    }
}
