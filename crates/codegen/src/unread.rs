//! What a document's function holds and never reads: values that are made and not used, parameters of its helpers, and its own. They
//! are left out of its text, and with them all that is computed, bound and filled in for their sake. What is named and has no effect
//! all the same is found in `passes/idle.rs`.

use std::ops::Range;

use halfvector_shaders::{Item, ItemKind, Token, TokenKind, slice, tokens};

/// The source without what it never reads, and the places of the parameters that `function` has lost. A local of a parameter's name counts
/// as reading it.
pub(crate) fn without_unread(source: &str, function: &str) -> (String, Vec<usize>) {
    let mut text = source.to_owned();
    let before = parameters(&text, function);
    // Each turn makes the text shorter, and what it takes away may have been the last to read something else.
    while let Some(ranges) = unused_value(&text).or_else(|| unread_parameter(&text, function)) {
        for range in ranges.into_iter().rev() {
            text.replace_range(range, "");
        }
    }
    let left = parameters(&text, function);
    let unread = (0..before.len()).filter(|&place| !left.contains(&before[place])).collect();
    (text, unread)
}

/// The tokens of an item without comments, counted from the text's front.
fn code(text: &str, item: &Item) -> Vec<Token> {
    let all = tokens(&text[item.code_start..item.end]).into_iter().filter(|token| !token.kind.is_comment());
    all.map(|token| Token { start: item.code_start + token.start, end: item.code_start + token.end, ..token }).collect()
}

fn functions(text: &str) -> Vec<Item> {
    slice(text).unwrap_or_default().into_iter().filter(|item| item.kind == ItemKind::Fn).collect()
}

/// The names of a function's parameters.
fn parameters(text: &str, function: &str) -> Vec<String> {
    let items = functions(text);
    let Some(item) = items.iter().find(|item| item.name == function) else { return Vec::new() };
    let code = code(text, item);
    let parts = parts(text, &code, opening(text, &code, 0)).unwrap_or_default();
    parts.iter().map(|part| code[part.start].text(text).to_owned()).collect()
}

/// The first `(` from a token on.
fn opening(text: &str, code: &[Token], from: usize) -> usize {
    (from..code.len()).find(|&at| code[at].text(text) == "(").unwrap_or(code.len())
}

/// The tokens of each part between the commas of the bracket that opens at a token.
fn parts(text: &str, code: &[Token], open: usize) -> Option<Vec<Range<usize>>> {
    let (mut parts, mut first, mut depth, mut angles) = (Vec::new(), open + 1, 1_usize, 0_usize);
    for at in open + 1..code.len() {
        let word = code[at].text(text);
        match word {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            // Angle brackets of a type; a comparison among arguments has no comma behind it that would end it.
            "<" if is_template(text, code, at) => angles += 1,
            ">" => angles = angles.saturating_sub(1),
            _ => {}
        }
        if depth == 0 || (depth == 1 && angles == 0 && word == ",") {
            if at > first {
                parts.push(first..at);
            }
            first = at + 1;
        }
        if depth == 0 {
            return Some(parts);
        }
    }
    None
}

fn is_template(text: &str, code: &[Token], at: usize) -> bool {
    let before = at.checked_sub(1).map_or("", |before| code[before].text(text));
    ["vec", "mat", "array", "texture_", "bitcast"].iter().any(|head| before.starts_with(head))
}

/// How often a name stands among tokens, other than as a member.
fn count(text: &str, code: &[Token], name: &str) -> usize {
    let is = |at: usize| {
        let is_member = at > 0 && code[at - 1].text(text) == ".";
        code[at].kind == TokenKind::Identifier && code[at].text(text) == name && !is_member
    };
    (0..code.len()).filter(|&at| is(at)).count()
}

/// A `let` or a `const` of a function that nothing names, or `_ = ...;`.
fn unused_value(text: &str) -> Option<Vec<Range<usize>>> {
    functions(text).iter().find_map(|item| {
        let code = code(text, item);
        let word = |at: usize| code.get(at).map_or("", |token| token.text(text));
        (1..code.len()).find_map(|at| {
            let begins = matches!(word(at - 1), ";" | "{" | "}");
            let is_unused = match word(at) {
                "let" | "const" => count(text, &code, word(at + 1)) == 1,
                "_" => word(at + 1) == "=",
                _ => false,
            };
            let end = (at..code.len()).find(|&end| word(end) == ";")?;
            (begins && is_unused).then(|| vec![line(text, code[at].start..code[end].end)])
        })
    })
}

/// A range with the line break in front of it, where it fills a line.
fn line(text: &str, range: Range<usize>) -> Range<usize> {
    let front = text[..range.start].trim_end_matches([' ', '\t']);
    let is_alone = front.ends_with('\n') && text[range.end..].trim_start_matches([' ', '\t', '\r']).starts_with('\n');
    if is_alone { front.len() - 1..range.end } else { range }
}

/// A parameter that its function does not name after its head; of a helper with the arguments of all calls.
fn unread_parameter(text: &str, main: &str) -> Option<Vec<Range<usize>>> {
    let items = slice(text).unwrap_or_default();
    functions(text).iter().find_map(|item| {
        let own = code(text, item);
        let open = opening(text, &own, 0);
        let parameters = parts(text, &own, open)?;
        let close = parameters.last().map_or(open, |last| last.end);
        let place = parameters.iter().position(|part| count(text, &own[close..], own[part.start].text(text)) == 0)?;
        let mut ranges = vec![with_comma(text, &own, &parameters, place)];
        if item.name == main {
            return Some(ranges);
        }
        for caller in &items {
            let code = code(text, caller);
            for at in 1..code.len() {
                let is_call = code[at].text(text) == item.name
                    && code.get(at + 1).is_some_and(|next| next.text(text) == "(")
                    && !matches!(code[at - 1].text(text), "fn" | ".");
                if is_call {
                    let arguments = parts(text, &code, at + 1)?;
                    if arguments.len() != parameters.len() {
                        return None;
                    }
                    ranges.push(with_comma(text, &code, &arguments, place));
                }
            }
        }
        ranges.sort_by_key(|range| range.start);
        // A call among the arguments of another one goes with it.
        let is_apart = ranges.windows(2).all(|pair| pair[0].end <= pair[1].start);
        is_apart.then_some(ranges)
    })
}

/// The bytes of a part with the comma that goes with it.
fn with_comma(text: &str, code: &[Token], parts: &[Range<usize>], place: usize) -> Range<usize> {
    let part = &parts[place];
    let (start, end) = (code[part.start].start, code[part.end - 1].end);
    match (parts.get(place + 1), place.checked_sub(1)) {
        (Some(next), _) => start..code[next.start].start,
        (None, Some(before)) => code[parts[before].end - 1].end..end,
        // A comma behind the last one.
        (None, None) if code[part.end].text(text) == "," => start..code[part.end].end,
        (None, None) => start..end,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_read_is_left_out() {
        let source = "fn g(a: f32) -> f32 { return a; }\nfn f(a: f32, t: texture_2d<f32>, b: f32, // b\n  s: sampler, c: vec2f,) -> f32 {\n    // b\n    return g(c.b);\n}\n";
        let (text, unread) = without_unread(source, "f");
        assert_eq!(unread, [0, 1, 2, 3]);
        let expected = "fn g(a: f32) -> f32 { return a; }\nfn f(c: vec2f,) -> f32 {\n    // b\n    return g(c.b);\n}\n";
        assert_eq!(text, expected);
        let shadowed = "fn f(a: f32) -> f32 { { let a = 1.0; return a; } }";
        assert_eq!(without_unread(shadowed, "f").1, [] as [usize; 0]);
        let none = "fn f(a: f32) -> f32 { return 1.0; }";
        assert_eq!(without_unread(none, "f"), ("fn f() -> f32 { return 1.0; }".to_owned(), vec![0]));
    }

    #[test]
    fn what_only_leads_to_what_is_not_read_is_left_out() {
        let left = |source: &str| without_unread(source, "f");
        // A helper that ignores it, one behind another, with a call in an argument.
        let source = "fn g(a: f32, b: f32) -> f32 { return h(b, a) + a; }\nfn h(b: f32, a: f32) -> f32 { return a; }\nfn f(a: f32, b: f32) -> f32 { return g(min(a, 1.0), max(b, a)); }";
        let (text, unread) = left(source);
        assert_eq!(unread, [1]);
        assert!(text.contains("h(a) + a") && text.contains("g(min(a, 1.0))") && !text.contains("b: f32"), "{text}");
        // Values that nothing uses, one by way of the other.
        let source = "fn f(a: f32, b: vec2<f32>) -> f32 {\n    let c = b.x;\n    let d = c * 2.0;\n    _ = b;\n    const K = 1.0;\n    return a;\n}";
        assert_eq!(left(source), ("fn f(a: f32) -> f32 {\n    return a;\n}".to_owned(), vec![1]));
        // A type with a comma is one part.
        let source = "fn g(a: array<f32, 2>, b: f32) -> f32 { return a[0]; }\nfn f(a: f32, b: f32) -> f32 { return g(array<f32, 2>(a, 1.0), b); }";
        let (text, unread) = left(source);
        assert_eq!(unread, [1]);
        assert!(text.contains("g(array<f32, 2>(a, 1.0))"), "{text}");
        // What is read stays, and so does a call in the same call's argument until that is seen to.
        for same in [
            "fn f(a: f32, b: f32) -> f32 { let c = b; return a + c; }",
            "fn f(a: f32, b: f32) -> f32 { var c = a; c = b; return c; }",
            "fn g(a: f32, b: f32) -> f32 { return b; }\nfn f(a: f32) -> f32 { return g(1.0, g(2.0, a)); }",
        ] {
            let (text, unread) = left(same);
            assert!(unread.is_empty(), "{text}");
        }
    }
}
