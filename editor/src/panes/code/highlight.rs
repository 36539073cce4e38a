//! Which parts of a shader's text are keywords, types, numbers, comments and calls. WGSL is cut by the shader library's own tokenizer;
//! the other languages, which look like C, by a plain one.

use std::ops::Range;

use halfvector_shaders::{TokenKind, tokens};

/// How a text is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::panes) enum Language {
    /// WGSL.
    Wgsl,
    /// GLSL, HLSL, MSL: near enough to C.
    OfC,
}

/// What a part of a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::panes) enum Kind {
    Keyword,
    Type,
    Number,
    Comment,
    Call,
    /// `@location`, `#version`, `[[stage_in]]`.
    Attribute,
}

/// A coloured part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::panes) struct Span {
    pub(in crate::panes) bytes: Range<usize>,
    pub(in crate::panes) kind: Kind,
}

const KEYWORDS: &[&str] = &[
    "alias",
    "break",
    "case",
    "cbuffer",
    "const",
    "constant",
    "continue",
    "default",
    "discard",
    "do",
    "else",
    "enable",
    "false",
    "flat",
    "fn",
    "for",
    "highp",
    "if",
    "in",
    "inout",
    "layout",
    "let",
    "loop",
    "lowp",
    "mediump",
    "namespace",
    "out",
    "override",
    "precision",
    "private",
    "register",
    "return",
    "smooth",
    "static",
    "struct",
    "switch",
    "thread",
    "true",
    "uniform",
    "using",
    "var",
    "void",
    "while",
];

const TYPES: &[&str] = &[
    "array", "bool", "char", "double", "f16", "f32", "float", "half", "i32", "int", "mat2x2f", "mat3x3f", "mat4x4f",
    "sampler", "u32", "uint",
];

/// Stems of type names that go on with digits and letters: `vec3f`, `float4x4`, `texture_2d`, `sampler2D`.
const STEMS: &[&str] =
    &["vec", "mat", "float", "int", "uint", "half", "bool", "texture", "sampler", "ivec", "uvec", "bvec"];

/// All coloured parts, in order.
pub(in crate::panes) fn highlight(text: &str, language: Language) -> Vec<Span> {
    match language {
        Language::Wgsl => of_wgsl(text),
        Language::OfC => of_c(text),
    }
}

fn of_wgsl(text: &str) -> Vec<Span> {
    let all = tokens(text);
    let mut spans = Vec::with_capacity(all.len() / 2);
    for (place, token) in all.iter().enumerate() {
        let kind = match token.kind {
            TokenKind::Number => Some(Kind::Number),
            kind if kind.is_comment() => Some(Kind::Comment),
            TokenKind::Identifier => {
                let is_attribute = place > 0 && all[place - 1].text(text) == "@";
                let is_called = all.get(place + 1).is_some_and(|next| next.text(text) == "(");
                if is_attribute { Some(Kind::Attribute) } else { word(token.text(text), is_called) }
            }
            _ => None,
        };
        spans.extend(kind.map(|kind| Span { bytes: token.start..token.end, kind }));
    }
    spans
}

fn of_c(text: &str) -> Vec<Span> {
    let bytes = text.as_bytes();
    let mut spans = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text[at..];
        let (length, kind) = if rest.starts_with("//") {
            (rest.find('\n').unwrap_or(rest.len()), Some(Kind::Comment))
        } else if rest.starts_with("/*") {
            (rest.find("*/").map_or(rest.len(), |end| end + 2), Some(Kind::Comment))
        } else if rest.starts_with('#') {
            (rest.find('\n').unwrap_or(rest.len()), Some(Kind::Attribute))
        } else if rest.starts_with("[[") {
            (rest.find("]]").map_or(2, |end| end + 2), Some(Kind::Attribute))
        } else if bytes[at].is_ascii_alphabetic() || bytes[at] == b'_' {
            let length = run(rest, |c| c.is_ascii_alphanumeric() || c == b'_');
            let is_called = text.as_bytes().get(at + length) == Some(&b'(');
            (length, word(&rest[..length], is_called))
        } else if bytes[at].is_ascii_digit() {
            (run(rest, |c| c.is_ascii_alphanumeric() || c == b'.'), Some(Kind::Number))
        } else {
            (rest.chars().next().map_or(1, char::len_utf8), None)
        };
        spans.extend(kind.map(|kind| Span { bytes: at..at + length, kind }));
        at += length;
    }
    spans
}

fn run(text: &str, belongs: impl Fn(u8) -> bool) -> usize {
    text.bytes().take_while(|byte| belongs(*byte)).count()
}

fn word(word: &str, is_called: bool) -> Option<Kind> {
    let is_type = || {
        TYPES.contains(&word)
            || STEMS.iter().any(|stem| {
                word.strip_prefix(stem).is_some_and(|rest| {
                    rest.starts_with(|c: char| c.is_ascii_digit() || c == '_')
                        && rest.len() <= 12
                        && !rest.contains("__")
                })
            })
    };
    if KEYWORDS.contains(&word) {
        Some(Kind::Keyword)
    } else if is_type() {
        Some(Kind::Type)
    } else if is_called {
        Some(Kind::Call)
    } else {
        None
    }
}
