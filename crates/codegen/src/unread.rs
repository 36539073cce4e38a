//! What a document's function holds and never reads: values that are made and not used, parameters of its helpers, and its own. They
//! are left out of its text, and with them all that is computed, bound and filled in for their sake. What is named and has no effect
//! all the same is found in `passes/idle.rs`.

use std::collections::HashMap;
use std::ops::Range;

use halfvector_shaders::{Item, ItemKind, Token, TokenKind, slice, tokens};

/// Most turns that take something away; a text that needs more keeps the rest.
const MAX_TURNS: usize = 64;

/// The source without what it never reads, and the places of the parameters that `function` has lost. A local of a parameter's name counts
/// as reading it.
pub(crate) fn without_unread(source: &str, function: &str) -> (String, Vec<usize>) {
    let mut text = source.to_owned();
    let before = parameters(&text, function);
    for _ in 0..MAX_TURNS {
        let unused = unused_values(&text);
        // What a turn takes away may have been the last to read something else.
        let ranges = if unused.is_empty() { unread_parameters(&text, function) } else { Some(unused) };
        let Some(ranges) = ranges else { break };
        let mut left = String::with_capacity(text.len());
        let mut at = 0;
        for range in ranges {
            left.push_str(&text[at..range.start]);
            at = range.end;
        }
        left.push_str(&text[at..]);
        text = left;
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

/// How often each name stands among tokens, other than as a member.
fn counts<'t>(text: &'t str, code: &[Token]) -> HashMap<&'t str, usize> {
    let mut counts = HashMap::new();
    for (at, token) in code.iter().enumerate() {
        let is_member = at > 0 && code[at - 1].text(text) == ".";
        if token.kind == TokenKind::Identifier && !is_member {
            *counts.entry(token.text(text)).or_default() += 1;
        }
    }
    counts
}

/// Each `let` and `const` of a function that nothing names, and each `_ = ...;`, in order.
fn unused_values(text: &str) -> Vec<Range<usize>> {
    let mut unused = Vec::new();
    for item in functions(text) {
        let code = code(text, &item);
        let mut counts = counts(text, &code);
        let word = |at: usize| code.get(at).map_or("", |token| token.text(text));
        let mut end = code.len();
        // From the end on: what one of them names is used once less.
        for at in (1..code.len()).rev() {
            if word(at) == ";" {
                end = at;
            }
            let begins = matches!(word(at - 1), ";" | "{" | "}");
            let is_unused = match word(at) {
                "let" | "const" => counts.get(word(at + 1)) == Some(&1),
                "_" => word(at + 1) == "=",
                _ => false,
            };
            if begins && is_unused && end < code.len() {
                for (name, count) in self::counts(text, &code[at..end]) {
                    if let Some(all) = counts.get_mut(name) {
                        *all -= count;
                    }
                }
                unused.push(line(text, code[at].start..code[end].end));
            }
        }
    }
    unused.sort_by_key(|range| range.start);
    unused
}

/// A range with the line break in front of it, where it fills a line.
fn line(text: &str, range: Range<usize>) -> Range<usize> {
    let front = text[..range.start].trim_end_matches([' ', '\t']);
    let is_alone = front.ends_with('\n') && text[range.end..].trim_start_matches([' ', '\t', '\r']).starts_with('\n');
    if is_alone { front.len() - 1..range.end } else { range }
}

/// The parameters of one function that it does not name after its head; of a helper with the arguments of all calls. In order.
fn unread_parameters(text: &str, main: &str) -> Option<Vec<Range<usize>>> {
    let items = slice(text).unwrap_or_default();
    functions(text).iter().find_map(|item| {
        let own = code(text, item);
        let open = opening(text, &own, 0);
        let parameters = parts(text, &own, open)?;
        let close = parameters.last().map_or(open, |last| last.end);
        let read = counts(text, &own[close..]);
        let is_read = |part: &Range<usize>| read.contains_key(own[part.start].text(text));
        let places: Vec<usize> = (0..parameters.len()).filter(|&place| !is_read(&parameters[place])).collect();
        if places.is_empty() {
            return None;
        }
        let mut ranges = without_parts(text, &own, &parameters, &places);
        let callers = items.iter().filter(|caller| item.name != main && caller.dependencies.contains(&item.name));
        for caller in callers {
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
                    ranges.extend(without_parts(text, &code, &arguments, &places));
                }
            }
        }
        ranges.sort_by_key(|range| range.start);
        // A call among the arguments of another one of the same function stays, and both with it.
        let is_apart = ranges.windows(2).all(|pair| pair[0].end <= pair[1].start);
        is_apart.then_some(ranges)
    })
}

/// The bytes of some parts with the commas that go with them, in order.
fn without_parts(text: &str, code: &[Token], parts: &[Range<usize>], places: &[usize]) -> Vec<Range<usize>> {
    let is_left = |place: usize| !places.contains(&place);
    let mut ranges = Vec::new();
    let mut place = 0;
    while place < parts.len() {
        if is_left(place) {
            place += 1;
            continue;
        }
        // A row of them, up to the next that stays; where none does, from behind the one before.
        let end = (place..parts.len()).find(|&next| is_left(next)).unwrap_or(parts.len());
        let start = code[parts[place].start].start;
        let last = &parts[end - 1];
        ranges.push(match (parts.get(end), place.checked_sub(1)) {
            (Some(next), _) => start..code[next.start].start,
            (None, Some(before)) => code[parts[before].end - 1].end..code[last.end - 1].end,
            // A comma behind the last one.
            (None, None) if code[last.end].text(text) == "," => start..code[last.end].end,
            (None, None) => start..code[last.end - 1].end,
        });
        place = end;
    }
    ranges
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

    /// However much is unread, it takes no time worth speaking of.
    #[test]
    fn a_hostile_text_ends() {
        let chain: String = (1..3000).map(|i| format!("let a{i} = a{};\n", i - 1)).collect();
        let (text, unread) = without_unread(&format!("fn f(a0: f32, b: f32) -> f32 {{\n{chain}return b;\n}}"), "f");
        assert_eq!((text.as_str(), unread), ("fn f(b: f32) -> f32 {\nreturn b;\n}", vec![0]));
        let helpers: String = (0..1000).map(|i| format!("fn g{i}(a: f32, b: f32) -> f32 {{ return b; }}\n")).collect();
        let calls: String = (0..1000).map(|i| format!("s += g{i}(x, s);\n")).collect();
        let start = std::time::Instant::now();
        without_unread(&format!("{helpers}fn f(x: f32) -> f32 {{\nvar s = 0.0;\n{calls}return s;\n}}"), "f");
        // Far below on a quiet machine.
        assert!(start.elapsed() < std::time::Duration::from_secs(20), "{:?}", start.elapsed());
    }
}
