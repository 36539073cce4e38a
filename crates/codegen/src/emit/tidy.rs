//! Takes out of a line what changes nothing: factors of 1 and summands of 0, where literals came to stand in the text of a function
//! that is one expression, or in the arguments of a lobe.

use std::ops::Range;

use halfvector_shaders::{Token, TokenKind, tokens};

/// The line without `x * 1.0`, `1.0 * x`, `x / 1.0`, `x + 0.0`, `x - 0.0`, `0.0 + x` and `mix` at 0 and 1, and without brackets that have become idle.
pub(crate) fn without_identities(line: &str) -> String {
    let mut line = line.to_owned();
    let mut has_changed = false;
    // Each turn makes the line shorter.
    while let Some(ranges) =
        idle(&line).or_else(|| end_of_mix(&line)).or_else(|| if has_changed { idle_brackets(&line) } else { None })
    {
        for range in ranges.into_iter().rev() {
            line.replace_range(range, "");
        }
        has_changed = true;
    }
    line
}

/// The code of a line, without comments.
fn code(line: &str) -> Vec<Token> {
    tokens(line).into_iter().filter(|token| !token.kind.is_comment()).collect()
}

/// A factor or summand that changes nothing, with its operator.
fn idle(line: &str) -> Option<Vec<Range<usize>>> {
    if !line.contains("1.0") && !line.contains("0.0") {
        return None;
    }
    let code = code(line);
    let word = |at: usize| code.get(at).map_or("", |token| token.text(line));
    let before = |at: usize, back: usize| at.checked_sub(back).map_or("", word);
    (0..code.len()).find_map(|at| {
        let (sign, next) = (before(at, 1), word(at + 1));
        let ends_before = |from: usize| code[from - 1].end..code[at].end;
        match word(at) {
            "1.0" if matches!(sign, "*" | "/") => Some(ends_before(at - 1)),
            "1.0" if next == "*" && sign != "/" && sign != "%" => Some(code[at].start..code.get(at + 2)?.start),
            "0.0"
                if matches!(sign, "+" | "-")
                    && ends_value(&code, line, at.checked_sub(2)?)
                    && !matches!(next, "*" | "/" | "%") =>
            {
                Some(ends_before(at - 1))
            }
            "0.0" if next == "+" && matches!(sign, "(" | "," | "=" | "return") => {
                Some(code[at].start..code.get(at + 2)?.start)
            }
            _ => None,
        }
        .map(|range| vec![range])
    })
}

/// What of a `mix` at 0 or 1 is not the side that it is.
fn end_of_mix(line: &str) -> Option<Vec<Range<usize>>> {
    if !line.contains("mix(") {
        return None;
    }
    let code = code(line);
    let word = |at: usize| code.get(at).map_or("", |token| token.text(line));
    (0..code.len()).filter(|&at| word(at) == "mix" && word(at + 1) == "(").find_map(|at| {
        let (mut depth, mut commas) = (0_usize, Vec::new());
        let close = (at + 1..code.len()).find(|&at| {
            match word(at) {
                "(" => depth += 1,
                ")" => depth -= 1,
                "," if depth == 1 => commas.push(at),
                _ => {}
            }
            depth == 0
        })?;
        let &[first, second] = commas.as_slice() else { return None };
        let weight = if second + 2 == close { word(second + 1) } else { "" };
        let rest = match weight {
            "0.0" => code[first].start..code[close].start,
            "1.0" => code[at + 2].start..code[first + 1].start,
            _ => return None,
        };
        let name = code[at].start..code[at].end;
        let weight = code[second].start..code[close].start;
        Some(if rest.end > weight.start { vec![name, rest] } else { vec![name, rest, weight] })
    })
}

/// Whether a value ends with a token.
fn ends_value(code: &[Token], line: &str, at: usize) -> bool {
    let word = code[at].text(line);
    matches!(word, ")" | "]")
        || code[at].kind == TokenKind::Number
        || code[at].kind == TokenKind::Identifier && word != "return"
}

/// Brackets about a single name or number, or about all of a value.
fn idle_brackets(line: &str) -> Option<Vec<Range<usize>>> {
    let code = code(line);
    let word = |at: usize| code.get(at).map_or("", |token| token.text(line));
    (0..code.len()).filter(|&at| word(at) == "(").find_map(|open| {
        // The brackets of a call stay.
        let is_call = open > 0 && (ends_value(&code, line, open - 1) || word(open - 1) == ">");
        let mut depth = 0_usize;
        let close = (open..code.len()).find(|&at| {
            match word(at) {
                "(" => depth += 1,
                ")" => depth -= 1,
                _ => {}
            }
            depth == 0
        })?;
        let inner = open + 1..close;
        let is_plain = inner.clone().all(|at| code[at].kind != TokenKind::Punctuation || word(at) == ".");
        let is_all = open > 0 && word(open - 1) == "=" && word(close + 1) == ";";
        let is_idle = !is_call && !inner.is_empty() && (is_plain || is_all);
        is_idle.then(|| vec![code[open].start..code[open].end, code[close].start..code[close].end])
    })
}

#[cfg(test)]
mod tests {
    use super::without_identities;

    #[test]
    fn what_changes_nothing_is_taken_out() {
        for (from, to) in [
            ("let a = (b.r - 0.0) * c; // D * 1.0", "let a = b.r * c; // D * 1.0"),
            ("let a = (b - c) * 1.0;", "let a = b - c;"),
            ("let a = b + (2.0 * c - 1.0) * 1.0;", "let a = b + (2.0 * c - 1.0);"),
            ("let a = f(b * 1.0, 1.0, 0.0 + c);", "let a = f(b, 1.0, c);"),
            ("let a = b / 1.0 / 1.0 + 0.0;", "let a = b;"),
            ("let a = 1.0 * b - 1.0 * c;", "let a = b - c;"),
            ("let a = b - vec3f(c) * 1.0 * d;", "let a = b - vec3f(c) * d;"),
            ("let a = b / 1.0 * c;", "let a = b * c;"),
            ("return 0.0 + f(a) - 0.0;", "return f(a);"),
            ("let a = mix(b, b + vec3f(1.0, 2.0, 3.0), 1.0);", "let a = b + vec3f(1.0, 2.0, 3.0);"),
            ("let a = mix(b, f(c, d), 0.0) * mix(b, c + d, 1.0);", "let a = b * (c + d);"),
        ] {
            assert_eq!(without_identities(from), to);
        }
        for same in [
            "let a = b + 0.0 * c;",
            "let a = 0.0 - c;",
            "let a = vec3f(0.0, 1.0, -0.0);",
            "let a = 1.0 / b;",
            "let a = b * 1.05 + 0.05;",
            "let a = f(-0.0, 1.0);",
            "let a = (b) * c;",
            "// a * 1.0",
            "let a = b % 1.0 * c;",
            "let a = mix(b, c, vec3f(1.0));",
            "let a = mix(b, c, 1.0 - d);",
        ] {
            assert_eq!(without_identities(same), same);
        }
    }
}
