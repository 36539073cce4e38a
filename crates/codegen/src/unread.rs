//! Parameters that a document's function takes and never reads: they are left out of it, and with them all that is computed, bound
//! and filled in for their sake.

use halfvector_shaders::{ItemKind, Token, TokenKind, slice, tokens};

/// The source without the parameters that `function` does not name after its head, and their places. A local of the same name counts
/// as reading it.
pub(crate) fn without_unread(source: &str, function: &str) -> (String, Vec<usize>) {
    let whole = || (source.to_owned(), Vec::new());
    let items = slice(source).unwrap_or_default();
    let Some(item) = items.iter().find(|item| item.kind == ItemKind::Fn && item.name == function) else {
        return whole();
    };
    let text = &source[item.code_start..item.end];
    let all: Vec<Token> = tokens(text).into_iter().filter(|token| !token.kind.is_comment()).collect();
    let word = |at: usize| all.get(at).map_or("", |token| token.text(text));
    let Some(open) = (0..all.len()).find(|&at| word(at) == "(") else { return whole() };
    // (first, one past the last) token of each parameter
    let (mut parameters, mut first, mut depth, mut close) = (Vec::new(), open + 1, 1usize, open);
    for at in open + 1..all.len() {
        match word(at) {
            "(" | "<" => depth += 1,
            ")" | ">" => depth -= 1,
            _ => {}
        }
        if depth == 0 || (depth == 1 && word(at) == ",") {
            if at > first {
                parameters.push((first, at));
            }
            first = at + 1;
        }
        if depth == 0 {
            close = at;
            break;
        }
    }
    let reads = |name: &str| {
        (close + 1..all.len())
            .any(|at| all[at].kind == TokenKind::Identifier && word(at) == name && word(at - 1) != ".")
    };
    let is_read = |(first, _): &(usize, usize)| reads(word(*first));
    let unread: Vec<usize> = (0..parameters.len()).filter(|&place| !is_read(&parameters[place])).collect();
    if close == open || unread.is_empty() {
        return whole();
    }
    let kept = parameters.iter().filter(|parameter| is_read(parameter));
    let kept: Vec<&str> = kept.map(|(first, end)| &text[all[*first].start..all[*end - 1].end]).collect();
    let (head, tail) = (item.code_start + all[open].end, item.code_start + all[close].start);
    (format!("{}{}{}", &source[..head], kept.join(", "), &source[tail..]), unread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_read_is_left_out() {
        let source = "fn g(a: f32) -> f32 { return a; }\nfn f(a: f32, t: texture_2d<f32>, b: f32, // b\n  s: sampler, c: vec2f,) -> f32 {\n    // b\n    return g(c.b);\n}\n";
        let (text, unread) = without_unread(source, "f");
        assert_eq!(unread, [0, 1, 2, 3]);
        let expected = "fn g(a: f32) -> f32 { return a; }\nfn f(c: vec2f) -> f32 {\n    // b\n    return g(c.b);\n}\n";
        assert_eq!(text, expected);
        assert_eq!(without_unread(source, "g"), (source.to_owned(), vec![]));
        let shadowed = "fn f(a: f32) -> f32 { { let a = 1.0; return a; } }";
        assert_eq!(without_unread(shadowed, "f").1, [] as [usize; 0]);
        let none = "fn f(a: f32) -> f32 { return 1.0; }";
        assert_eq!(without_unread(none, "f"), ("fn f() -> f32 { return 1.0; }".to_owned(), vec![0]));
    }
}
