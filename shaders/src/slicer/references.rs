//! The words of an item that refer to module scope or to WGSL itself.

use std::ops::Range;

use super::{ItemKind, skip_attributes, skip_template};
use crate::token::{Token, TokenKind};

/// Words that are part of WGSL's grammar and name nothing.
const KEYWORDS: [&str; 24] = [
    "alias",
    "break",
    "case",
    "const",
    "const_assert",
    "continue",
    "continuing",
    "default",
    "discard",
    "else",
    "enable",
    "false",
    "fn",
    "for",
    "if",
    "let",
    "loop",
    "override",
    "return",
    "struct",
    "switch",
    "true",
    "var",
    "while",
];

/// Attributes whose argument is a word of WGSL's and no name.
const WORD_ATTRIBUTES: [&str; 4] = ["builtin", "interpolate", "diagnostic", "blend_src"];

/// Names declared in a block, or in a `for` header and valid in its block.
#[derive(Default)]
struct Scope<'s> {
    names: Vec<&'s str>,
    is_for: bool,
}

/// The words in the tokens after an item's name that refer to module scope or to WGSL itself.
pub(super) fn references(source: &str, code: &[Token], kind: ItemKind) -> Vec<Range<usize>> {
    let text = |index: usize| code.get(index).map_or("", |t| t.text(source));
    let mut found = Vec::new();
    let mut scopes = vec![Scope::default()];
    // A local is known from the end of its own statement: `let x = x(1.0);` calls a function x.
    let mut pending: Option<&str> = None;
    let (mut parentheses, mut braces) = (0_usize, 0_usize);
    let mut at = 0;
    while at < code.len() {
        let token = &code[at];
        let word = token.text(source);
        match word {
            "@" => {
                let name = text(at + 1);
                at = if WORD_ATTRIBUTES.contains(&name) { skip_attributes(source, code, at) } else { at + 2 };
                continue;
            }
            "(" => parentheses += 1,
            ")" => parentheses = parentheses.saturating_sub(1),
            "{" => {
                braces += 1;
                scopes.push(Scope::default());
            }
            "}" => {
                braces = braces.saturating_sub(1);
                scopes.pop();
                while scopes.last().is_some_and(|s| s.is_for) {
                    scopes.pop();
                }
                pending = None;
            }
            ";" => {
                if let (Some(name), Some(scope)) = (pending.take(), scopes.last_mut()) {
                    scope.names.push(name);
                }
            }
            "for" => scopes.push(Scope { names: Vec::new(), is_for: true }),
            "let" | "const" | "var" if kind == ItemKind::Fn => {
                let name = skip_template(source, code, at + 1);
                pending = code.get(name).filter(|t| t.kind == TokenKind::Identifier).map(|t| t.text(source));
                at = name + 1;
                continue;
            }
            _ if token.kind == TokenKind::Identifier && !KEYWORDS.contains(&word) => {
                let member = at > 0 && text(at - 1) == ".";
                let declares = text(at + 1) == ":"
                    && match kind {
                        ItemKind::Fn => braces == 0 && parentheses == 1,
                        ItemKind::Struct => braces == 1 && parentheses == 0,
                        ItemKind::Const | ItemKind::Alias | ItemKind::Var => false,
                    };
                if declares && kind == ItemKind::Fn {
                    scopes[0].names.push(word);
                }
                let local = scopes.iter().any(|s| s.names.contains(&word));
                if !member && !declares && !local {
                    found.push(token.start..token.end);
                }
            }
            _ => {}
        }
        at += 1;
        if scopes.is_empty() {
            scopes.push(Scope::default());
        }
    }
    found
}
