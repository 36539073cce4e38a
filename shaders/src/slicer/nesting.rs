//! Brackets: which are open where, and how many.

use super::{Fault, MAX_NESTING, MAX_OPERATORS, SliceErrorKind};
use crate::token::{Token, TokenKind};

/// A bracket that is open.
struct Open {
    /// `(`, `[` or `{`.
    sign: char,
    start: usize,
    /// Whether `;` may stand in it: the header of a `for`.
    is_header: bool,
}

/// Refuses brackets that do not match, and what would make a recursive parser overflow its stack.
pub(super) fn refuse_depth(source: &str, code: &[Token]) -> Result<(), Fault> {
    let mut open: Vec<Open> = Vec::new();
    let mut operators = 0;
    // Length of the chain of `else` at each depth of `{`.
    let mut chains = vec![0_usize];
    for (index, token) in code.iter().enumerate() {
        let word = token.text(source);
        let before = index.checked_sub(1).map(|before| code[before]);
        if let Some(missing) = open.last().and_then(|open| missing_before(open, word)) {
            return Err((SliceErrorKind::Unclosed(missing), before.map_or(token.start, |before| before.end)));
        }
        match word {
            "(" | "[" | "{" => {
                let sign = word.chars().next().unwrap_or_default();
                let is_header = before.is_some_and(|before| before.text(source) == "for");
                open.push(Open { sign, start: token.start, is_header });
                if open.len() > MAX_NESTING {
                    return Err((SliceErrorKind::TooDeep, token.start));
                }
                if sign == '{' {
                    operators = 0;
                    chains.push(0);
                }
            }
            ")" | "]" | "}" => {
                if open.pop().is_none_or(|open| closing(open.sign).to_string() != word) {
                    return Err((SliceErrorKind::Unbalanced, token.start));
                }
                if word == "}" {
                    operators = 0;
                    chains.pop();
                    let goes_on = code.get(index + 1).is_some_and(|next| next.text(source) == "else");
                    if let (false, Some(chain)) = (goes_on, chains.last_mut()) {
                        *chain = 0;
                    }
                }
            }
            ";" => operators = 0,
            "else" => {
                if let Some(chain) = chains.last_mut() {
                    *chain += 1;
                    if *chain > MAX_NESTING {
                        return Err((SliceErrorKind::TooDeep, token.start));
                    }
                }
            }
            "," | "." | ":" | "@" => {}
            _ if token.kind == TokenKind::Punctuation => {
                operators += 1;
                if operators > MAX_OPERATORS {
                    return Err((SliceErrorKind::TooDeep, token.start));
                }
            }
            _ => {}
        }
    }
    match open.last() {
        Some(open) => Err((SliceErrorKind::Unfinished, open.start)),
        None => Ok(()),
    }
}

fn closing(open: char) -> char {
    match open {
        '(' => ')',
        '[' => ']',
        _ => '}',
    }
}

/// The bracket that is missing where a word stands that cannot stand in the innermost open one.
fn missing_before(open: &Open, word: &str) -> Option<char> {
    let is_out_of_place = match word {
        ";" => !open.is_header,
        "let" => !open.is_header,
        "{" | "}" | "return" | "if" | "else" | "for" | "switch" | "fn" => true,
        ")" | "]" => closing(open.sign).to_string() != word,
        _ => false,
    };
    (open.sign != '{' && is_out_of_place).then(|| closing(open.sign))
}
