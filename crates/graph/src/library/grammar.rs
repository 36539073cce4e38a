//! The doc comment of a node function: label, help, `@` lines and one `- name: help [default; range; unit]` line per argument.
//! It is strict: whatever does not fit is a problem with its line. It knows no types; `node` holds it against the signature.

use crate::value::ColorSpace;

/// A doc comment, read.
#[derive(Debug, Default)]
pub(super) struct NodeDoc {
    pub(super) label: String,
    pub(super) help: String,
    /// Empty when the comment names none.
    pub(super) id: String,
    /// Line of `@node`.
    pub(super) line: usize,
    pub(super) synonyms: Vec<String>,
    pub(super) arguments: Vec<ArgumentDoc>,
    /// Help of a plain result, and its line.
    pub(super) result: Option<(usize, String)>,
    /// Line and function name.
    pub(super) vertex: Option<(usize, String)>,
    /// Line and argument.
    pub(super) slopes: Vec<(usize, String)>,
    /// Line, term, method and function name.
    pub(super) methods: Vec<(usize, String, String, String)>,
    /// Line, output and function name.
    pub(super) outputs: Vec<(usize, String, String)>,
}

/// An argument's line.
#[derive(Debug)]
pub(super) struct ArgumentDoc {
    pub(super) line: usize,
    pub(super) name: String,
    pub(super) help: String,
    pub(super) default: DefaultDoc,
    /// None for none or an unlimited one.
    pub(super) range: Option<[f32; 2]>,
    pub(super) unit: String,
}

/// A default as written.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum DefaultDoc {
    Bool(bool),
    /// One to four numbers.
    Numbers(Vec<f32>),
    Context(String),
    Image(ColorSpace),
    Surface,
}

/// A line of a doc comment (number from 1, text after `/// `) that does not fit, and why.
pub(super) type Slip = (usize, String);

/// The lines of the `///` comments in `comment`, which starts in line `first`.
pub(super) fn doc_lines(comment: &str, first: usize) -> Vec<(usize, &str)> {
    comment
        .lines()
        .enumerate()
        .filter_map(|(i, line)| Some((first + i, line.trim_start().strip_prefix("///")?)))
        .map(|(i, line)| (i, line.strip_prefix(' ').unwrap_or(line).trim_end()))
        .collect()
}

/// Whether the lines say that the function is a node.
pub(super) fn is_node(lines: &[(usize, &str)]) -> bool {
    lines.iter().any(|(_, line)| line.starts_with("@node"))
}

/// Reads the lines of a node's doc comment.
pub(super) fn read(lines: &[(usize, &str)], slips: &mut Vec<Slip>) -> NodeDoc {
    let mut doc = NodeDoc::default();
    let mut help: Vec<&str> = Vec::new();
    let mut in_grammar = false;
    for (i, &(line, text)) in lines.iter().enumerate() {
        if text.starts_with('@') {
            in_grammar = true;
            directives(text, line, &mut doc, slips);
        } else if let Some(entry) = text.strip_prefix("- ").filter(|entry| in_grammar || is_entry(entry)) {
            in_grammar = true;
            let mut entry = entry.to_string();
            for (_, more) in lines[i + 1..].iter().take_while(|(_, more)| more.starts_with("  ")) {
                entry.push(' ');
                entry.push_str(more.trim());
            }
            argument(&entry, line, &mut doc, slips);
        } else if i == 0 {
            doc.label = text.into();
        } else if !in_grammar {
            if i == 1 && !text.is_empty() {
                slips.push((line, "the first line is the label; leave the second one empty".into()));
            }
            help.push(text);
        } else if !text.is_empty() && !text.starts_with("  ") {
            slips.push((line, "help stands above the lines with @ and -; here stands more text".into()));
        }
    }
    doc.help = help.join("\n").trim().into();
    let first = lines.first().map_or(1, |(line, _)| *line);
    if doc.label.is_empty() {
        slips.push((first, "the first line of the comment is the node's label; it is empty".into()));
    }
    if doc.help.is_empty() {
        slips.push((first, "the help is missing: what the node computes, below the label and an empty line".into()));
    }
    doc
}

/// Whether a `- ` line is an argument's: a name and a colon. Others, above the grammar, are lists in the help.
fn is_entry(entry: &str) -> bool {
    entry.split_once(':').is_some_and(|(name, _)| is_identifier(name))
}

fn is_identifier(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// Reads the `@` words of a line.
fn directives(text: &str, line: usize, doc: &mut NodeDoc, slips: &mut Vec<Slip>) {
    for directive in text.split('@').skip(1) {
        let (word, rest) = directive.split_once(char::is_whitespace).unwrap_or((directive, ""));
        let words: Vec<&str> = rest.split_whitespace().collect();
        let mut slip = |message: &str| slips.push((line, message.into()));
        match (word, words.as_slice()) {
            ("node", [id]) if !doc.id.is_empty() => slip(&format!("`@node {id}`: the function is a node already")),
            ("node", [id]) => {
                doc.line = line;
                doc.id = (*id).into();
                if !is_id(id) {
                    slip("a node's id is `category/name` of small letters, digits and _");
                }
            }
            ("node", _) => slip("write `@node category/name`"),
            ("also", []) => slip("write `@also word, word`"),
            ("also", _) => {
                for synonym in rest.split(',').map(str::trim) {
                    if synonym.is_empty() || doc.synonyms.iter().any(|s| s == synonym) {
                        slip("`@also` has an empty word or the same one twice");
                    } else {
                        doc.synonyms.push(synonym.into());
                    }
                }
            }
            ("vertex", [function]) if doc.vertex.is_none() => doc.vertex = Some((line, (*function).into())),
            ("vertex", _) => slip("write `@vertex function`, once"),
            ("slope", [argument]) => doc.slopes.push((line, (*argument).into())),
            ("slope", _) => slip("write `@slope argument`"),
            ("method", [choice, function]) => match choice.split_once('=') {
                Some((term, method)) => doc.methods.push((line, term.into(), method.into(), (*function).into())),
                None => slip("write `@method term=method function`"),
            },
            ("method", _) => slip("write `@method term=method function`"),
            ("output", [output, function]) => doc.outputs.push((line, (*output).into(), (*function).into())),
            ("output", _) => slip("write `@output name function`"),
            _ => slip(&format!("`@{word}` is unknown; there are @node, @also, @vertex, @slope, @method and @output")),
        }
    }
}

fn is_id(id: &str) -> bool {
    let is_part = |part: &str| {
        part.starts_with(|c: char| c.is_ascii_lowercase())
            && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
    };
    id.split_once('/').is_some_and(|(category, name)| is_part(category) && is_part(name))
}

/// Reads `name: help [default; range; unit]`, or `return: help`.
fn argument(entry: &str, line: usize, doc: &mut NodeDoc, slips: &mut Vec<Slip>) {
    let mut slip = |message: String| slips.push((line, message));
    let Some((name, rest)) = entry.split_once(':').filter(|(name, _)| is_identifier(name)) else {
        return slip("write `- name: help [default; lo..hi; unit]`".into());
    };
    let rest = rest.trim();
    if name == "return" {
        if doc.result.replace((line, rest.into())).is_some() {
            slip("`return` stands twice".into());
        }
        return;
    }
    if doc.arguments.iter().any(|a| a.name == name) {
        return slip(format!("`{name}` stands twice"));
    }
    let bracket = rest.strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    let Some((help, bracket)) = bracket else {
        return slip(format!("the default of `{name}` is missing: end the line with [default; lo..hi; unit]"));
    };
    let mut parts = bracket.split(';').map(str::trim);
    let default = match default(parts.next().unwrap_or("")) {
        Ok(default) => default,
        Err(message) => return slip(format!("`{name}`: {message}")),
    };
    let mut parsed =
        ArgumentDoc { line, name: name.into(), help: help.trim().into(), default, range: None, unit: String::new() };
    if parsed.help.is_empty() {
        slip(format!("the help of `{name}` is missing"));
    }
    let mut range_seen = false;
    for part in parts {
        match part.split_once("..") {
            Some((lo, hi)) if !range_seen => match (bound(lo), bound(hi)) {
                (Some(lo), Some(hi)) if lo < hi => {
                    range_seen = true;
                    parsed.range = (lo.is_finite() || hi.is_finite()).then_some([lo, hi]);
                }
                _ => slip(format!("`{part}` is no range; write `lo..hi` with lo below hi, such as 0..1 or 0..inf")),
            },
            None if parsed.unit.is_empty() && !part.is_empty() => parsed.unit = part.into(),
            _ => slip(format!("`{part}` is too much: in the brackets stand default, range and unit, parted by ;")),
        }
    }
    doc.arguments.push(parsed);
}

fn bound(text: &str) -> Option<f32> {
    match text.trim() {
        "inf" => Some(f32::INFINITY),
        "-inf" => Some(f32::NEG_INFINITY),
        number => finite(number),
    }
}

fn finite(text: &str) -> Option<f32> {
    // Rust also reads words such as `inf` and `nan`: digits only.
    let digits = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    text.parse().ok().filter(|x: &f32| digits && x.is_finite())
}

fn default(text: &str) -> Result<DefaultDoc, String> {
    let unknown = || {
        format!(
            "`{text}` is no default; write a number, numbers parted by commas, true, false, `context NAME`, `image srgb`, `image linear` or `surface`"
        )
    };
    match text.split_whitespace().collect::<Vec<_>>().as_slice() {
        ["true"] => return Ok(DefaultDoc::Bool(true)),
        ["false"] => return Ok(DefaultDoc::Bool(false)),
        ["context", name] => return Ok(DefaultDoc::Context((*name).into())),
        ["image", "srgb"] => return Ok(DefaultDoc::Image(ColorSpace::Srgb)),
        ["image", "linear"] => return Ok(DefaultDoc::Image(ColorSpace::Linear)),
        ["surface"] => return Ok(DefaultDoc::Surface),
        _ => {}
    }
    let numbers: Vec<f32> = text.split(',').map(|n| finite(n.trim())).collect::<Option<_>>().ok_or_else(unknown)?;
    if numbers.len() <= 4 { Ok(DefaultDoc::Numbers(numbers)) } else { Err(unknown()) }
}
