//! Mistakes that people make in functions of a document: each is told in words of WGSL, with a caret at what is to be changed.

use halfvector_shaders::tokens;
use proptest::prelude::*;

use crate::library::custom::{CodeError, read_function};

/// A function of the body `body`, and items beside it.
fn text(body: &str, beside: &str) -> String {
    format!(
        "/// Test\n///\n/// A test.\n/// @node custom/test\n/// - x: a [0.5; 0..1]\n/// - n: b [3; 0..9]\n/// - c: c [0.5; 0..1]\nfn f(x: f32, n: i32, c: vec3f) -> vec3f {{\n{body}\n}}\n{beside}"
    )
}

/// Words of the parser that is used, and of what is made inside of it, that no user has written.
const FOREIGN: [&str; 26] = [
    "naga",
    "Abstract",
    "Expression",
    "expression",
    "Scalar",
    "Sint",
    "Uint",
    "Float",
    "Handle",
    "Some(",
    "None",
    "argument #",
    "utomatic conversion",
    "identifier",
    "initializer",
    "operand",
    "overload",
    "selector",
    "literal",
    "<f32>`, but",
    "vec2<f32>",
    "vec3<f32>",
    "vec4<f32>",
    "is invalid",
    "Capabilities",
    "internal",
];

fn is_in_the_users_words(error: &CodeError) {
    // What stands between backquotes is written by the user, or to be.
    let said: String = error.message.split('`').step_by(2).collect();
    let foreign = FOREIGN.into_iter().find(|word| said.contains(word));
    assert_eq!(foreign, None, "{error}");
    let number = said.split('[').skip(1).find(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    assert_eq!(number, None, "{error}");
}

/// `mistakes.txt`: a body, with `@@` and what stands beside it, and the mark at which the caret is to be; below it what is said.
#[test]
fn mistakes_are_told_in_the_users_words() {
    let lines: Vec<&str> = include_str!("mistakes.txt").lines().collect();
    assert!(lines.len() >= 2 * 300);
    let wrong: Vec<String> =
        lines.chunks(2).filter_map(|pair| refused_otherwise(pair[0], pair[1].trim_start())).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), lines.len() / 2, wrong.join("\n"));
}

/// How a mistake is told if not as wanted.
fn refused_otherwise(mistake: &str, wanted: &str) -> Option<String> {
    let (body, beside) = mistake.split_once(" @@ ").unwrap_or((mistake, ""));
    let marked = text(body, beside).replace("\\n", "\n");
    let at = marked.find('\u{25b6}')?;
    let sound = marked.replace('\u{25b6}', "");
    let line = 1 + sound[..at].matches('\n').count();
    let column = 1 + sound[..at].rsplit('\n').next()?.chars().count();
    let error = match read_function("test", &sound) {
        Ok(_) => return Some(format!("{mistake}\n    is taken")),
        Err(error) => error,
    };
    is_in_the_users_words(&error);
    let is_so = (error.line, error.column, error.message.as_str()) == (line, column, wanted);
    (!is_so).then(|| format!("{mistake}\n    wanted: line {line}, column {column}: {wanted}\n    {error}"))
}

/// A function of all kinds of statements.
const SOUND: &str = "let a = pow(abs(c), vec3f(2.2));\nvar k = mix(a, vec3f(x), 0.5) * f32(n);\nfor (var i = 0; i < 3; i++) { k += a[i] * c; }\nif x > 0.5 && n == 2 { k.x = g(k.yz, n); } else { return -k; }\nlet m = mat3x3f(a, c, k);\nlet s = S(x, array<f32, 2>(1.0, x));\nreturn select(k, m * c, x < s.v[1]) + dot(a, c);";
const BESIDE: &str =
    "struct S { u: f32, v: array<f32, 2> }\nfn g(v: vec2f, n: i32) -> f32 { return length(v) + f32(n % 2); }\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Whatever is done to one word of a text: if it is refused, then in the user's words and at a place of the text.
    #[test]
    fn a_text_with_one_word_changed_is_told_so(at in 0_usize..1000, with in 0_usize..24) {
        const WORDS: [&str; 24] = [
            "", " ", "x", "n", "c", "true", "1.0", "2u", "1e50", "[7]", "(", ")", "{", "}", ";", ",", ".", "+", "=", "vec2f", "float", "sin",
            "let", "return",
        ];
        let sound = text(SOUND, BESIDE);
        let body = sound.find("{\n").unwrap_or(0);
        let code: Vec<_> = tokens(&sound[body..]);
        let token = code[at % code.len()];
        let (start, end) = (body + token.start, body + token.end);
        // Some words are put in front of another one, and not in its place.
        let end = if at % 2 == 0 { end } else { start };
        let changed = format!("{} {} {}", &sound[..start], WORDS[with], &sound[end..]);
        if let Err(error) = read_function("test", &changed) {
            is_in_the_users_words(&error);
            prop_assert!(error.line <= changed.lines().count() + 1, "{error}");
        }
    }
}

/// Arrays of vectors by each of their names, and of a length that is a constant.
#[test]
fn arrays_by_other_names_are_taken() {
    let beside = "alias V = vec2<f32>;\nalias W = V;\nconst N = 2;\nconst M: u32 = 3u;\nconst K = array<vec3<f32>, N>(vec3f(1.0), vec3f(0.5));\n                  struct S { a: array<W, M>, b: V, c: array<vec4<i32>, 2> }\nfn g(a: array<V, N>) -> f32 { return a[1].x; }\n";
    let body = "var s: S; s.a[0] = c.xy; let d = array<W, N>(c.xy, s.b);\nvar e: array<vec2<bool>, 2>; var h: array<f32, M>;\nreturn K[1] * g(d) + h[0];";
    read_function("test", &text(body, beside)).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn the_text_that_is_changed_is_sound() {
    read_function("test", &text(SOUND, BESIDE)).unwrap_or_else(|error| panic!("{error}"));
}

/// The column of a long line counts from the line's front, though only what stands about the place is shown.
#[test]
fn the_column_of_a_long_line_is_its_own() {
    let body = format!("return c + {}y;", "0.0 + ".repeat(40));
    let error = read_function("test", &text(&body, "")).expect_err("no y");
    assert_eq!(error.column, 1 + body.find('y').unwrap_or(0), "{error}");
    let shown = error.to_string();
    let caret = shown.lines().last().unwrap_or_default().chars().count();
    assert_eq!(shown.lines().nth(1).and_then(|line| line.chars().nth(caret - 1)), Some('y'), "{shown}");
}
