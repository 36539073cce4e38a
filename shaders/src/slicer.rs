//! Cuts WGSL into its module-scope items, each with the comments above it and the names that it refers to, so that a
//! linker can take just the items that a shader reaches.
//!
//! It follows scopes (parameters, `let`, `var`, `const`, `for`) and so knows which words are local; it knows no types and
//! checks nothing else: naga does. It is safe on hostile text: no recursion, no panic, and text whose nesting would
//! overflow a recursive parser is refused.

mod nesting;
mod references;

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use crate::token::{Token, TokenKind, is_line_break, tokens};
use nesting::refuse_depth;
use references::references;

/// What an item declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ItemKind {
    /// `fn`
    Fn,
    /// `struct`
    Struct,
    /// `const`
    Const,
    /// `alias`
    Alias,
    /// `var` or `override`: entry-point files only, never a node.
    Var,
}

/// A module-scope declaration with the comments directly above it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// What it declares.
    pub kind: ItemKind,
    /// Its name.
    pub name: String,
    /// First byte of the comments directly above, or of the item when there are none.
    pub start: usize,
    /// First byte of the item itself, attributes included.
    pub code_start: usize,
    /// One past the last byte, with a comment that ends the same line.
    pub end: usize,
    /// The bytes of the name where it is declared.
    pub name_range: Range<usize>,
    /// The bytes of each word in the item that is neither keyword, member, parameter nor local, in order: types,
    /// functions and constants, its own and WGSL's.
    pub references: Vec<Range<usize>>,
    /// The distinct words at [`Item::references`], sorted. A linker intersects them with the items that it knows.
    pub dependencies: Vec<String>,
}

/// Why a text could not be sliced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SliceError {
    /// What was met.
    pub kind: SliceErrorKind,
    /// Where: a byte of the text.
    pub offset: usize,
    /// Where: line, from 1.
    pub line: usize,
}

/// What the slicer met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SliceErrorKind {
    /// A word or sign that begins no item.
    NotAnItem(String),
    /// An item without a name.
    NoName,
    /// An item or comment that does not end.
    Unfinished,
    /// A closing bracket without its opening one.
    Unbalanced,
    /// A `(` or `[` that is open where a statement ends or begins: the bracket that is missing there.
    Unclosed(char),
    /// More nested brackets than [`MAX_NESTING`], more operators in a statement than [`MAX_OPERATORS`], or a longer
    /// chain of `else` than [`MAX_NESTING`].
    TooDeep,
}

impl fmt::Display for SliceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: ", self.line)?;
        match &self.kind {
            SliceErrorKind::NotAnItem(found) => {
                write!(f, "expected `fn`, `struct`, `const`, `alias` or `var`, found `{found}`")
            }
            SliceErrorKind::NoName => write!(f, "expected a name after the keyword"),
            SliceErrorKind::Unfinished => write!(f, "what begins here does not end; is a bracket or `;` missing?"),
            SliceErrorKind::Unbalanced => write!(f, "this bracket was not opened"),
            SliceErrorKind::Unclosed(missing) => write!(f, "a `{missing}` is missing here"),
            SliceErrorKind::TooDeep => write!(f, "nested too deeply; name a part of it with `let`"),
        }
    }
}

impl std::error::Error for SliceError {}

/// Most brackets that may be open at once. Parsers recurse, and a page of `((((` must not overflow their stack.
pub const MAX_NESTING: usize = 64;

/// Most operators in one statement. Parsers make a tree as deep as `x+x+x+...` is long.
pub const MAX_OPERATORS: usize = 256;

/// Cuts a text into its items, in order. `enable`, `requires` and `diagnostic` are refused: the shader that an item is
/// linked into decides those.
pub fn slice(source: &str) -> Result<Vec<Item>, SliceError> {
    let all = tokens(source);
    let fail = |kind, offset: usize| SliceError { kind, offset, line: line_of(source, offset) };
    if let Some(open) = all.iter().find(|t| is_unclosed_comment(t, source)) {
        return Err(fail(SliceErrorKind::Unfinished, open.start));
    }
    let code: Vec<Token> = all.iter().copied().filter(|t| !t.kind.is_comment()).collect();
    refuse_depth(source, &code).map_err(|(kind, offset)| fail(kind, offset))?;

    let mut items: Vec<Item> = Vec::new();
    let mut at = 0;
    while at < code.len() {
        if code[at].text(source) == ";" {
            at += 1;
            continue;
        }
        let (mut item, next) = item_at(source, &code, at).map_err(|(kind, offset)| fail(kind, offset))?;
        item.start = comments_above(source, &all, item.start);
        item.end = comment_beside(source, &all, item.end);
        items.push(item);
        at = next;
    }
    Ok(items)
}

/// The types that `T` stands for in a file of a generic node: the words after `//! T =`, between `|`.
/// `None` for a file that is not generic.
pub fn generic_types(source: &str) -> Option<Vec<&str>> {
    let list = source.lines().map_while(|l| l.strip_prefix("//!")).find_map(|l| l.trim().strip_prefix("T ="))?;
    Some(list.split('|').map(str::trim).collect())
}

type Fault = (SliceErrorKind, usize);

fn is_unclosed_comment(token: &Token, source: &str) -> bool {
    let text = token.text(source);
    token.kind.is_comment() && text.starts_with("/*") && {
        // The tokenizer ends a block comment at its own `*/` unless the text ran out.
        token.end == source.len() && !closes(text)
    }
}

fn closes(comment: &str) -> bool {
    let inner = comment.as_bytes();
    let (mut depth, mut at) = (0_usize, 0);
    while at + 1 < inner.len() {
        match &inner[at..at + 2] {
            b"/*" => {
                depth += 1;
                at += 2;
            }
            b"*/" => {
                depth -= 1;
                at += 2;
            }
            _ => at += 1,
        }
    }
    depth == 0
}

/// The item whose first token is `code[first]`, without comments, and the index of the token after it.
fn item_at(source: &str, code: &[Token], first: usize) -> Result<(Item, usize), Fault> {
    let text = |index: usize| code.get(index).map_or("", |t| t.text(source));
    let after_attributes = skip_attributes(source, code, first);
    let keyword = after_attributes;
    let kind = match text(keyword) {
        "fn" => ItemKind::Fn,
        "struct" => ItemKind::Struct,
        "const" => ItemKind::Const,
        "alias" => ItemKind::Alias,
        "var" | "override" => ItemKind::Var,
        _ => {
            let found = code.get(keyword).copied().unwrap_or(code[first]);
            return Err((SliceErrorKind::NotAnItem(found.text(source).to_owned()), found.start));
        }
    };
    let name = skip_template(source, code, keyword + 1);
    let name_token = match code.get(name) {
        Some(token) if token.kind == TokenKind::Identifier => *token,
        _ => return Err((SliceErrorKind::NoName, code[keyword].start)),
    };
    let last = match kind {
        ItemKind::Fn | ItemKind::Struct => block_end(source, code, name + 1),
        ItemKind::Const | ItemKind::Alias | ItemKind::Var => {
            (name + 1..code.len()).find(|&index| matches!(text(index), ";" | "{" | "}")).filter(|&i| text(i) == ";")
        }
    }
    .ok_or((SliceErrorKind::Unfinished, code[keyword].start))?;

    let attributes = references(source, &code[first..keyword], ItemKind::Const);
    // A var's template list stands between keyword and name: address spaces, no names of ours.
    let references: Vec<Range<usize>> =
        attributes.into_iter().chain(references(source, &code[name + 1..=last], kind)).collect();
    let dependencies: BTreeSet<&str> = references.iter().map(|r| &source[r.clone()]).collect();
    let item = Item {
        kind,
        name: name_token.text(source).to_owned(),
        start: code[first].start,
        code_start: code[first].start,
        end: code[last].end,
        name_range: name_token.start..name_token.end,
        dependencies: dependencies.into_iter().map(str::to_owned).collect(),
        references,
    };
    Ok((item, last + 1))
}

/// The index after `@name` and `@name(...)` repeated, from `at`.
fn skip_attributes(source: &str, code: &[Token], mut at: usize) -> usize {
    let text = |index: usize| code.get(index).map_or("", |t| t.text(source));
    while text(at) == "@" {
        at += 2;
        if text(at) == "(" {
            let mut depth = 0_usize;
            while at < code.len() {
                match text(at) {
                    "(" => depth += 1,
                    ")" => depth -= 1,
                    _ => {}
                }
                at += 1;
                if depth == 0 {
                    break;
                }
            }
        }
    }
    at
}

/// The index after `<...>` at `at`, or `at`.
fn skip_template(source: &str, code: &[Token], at: usize) -> usize {
    if code.get(at).is_none_or(|t| t.text(source) != "<") {
        return at;
    }
    (at..code.len()).find(|&index| code[index].text(source) == ">").map_or(code.len(), |close| close + 1)
}

/// The index of the `}` that closes the first `{` from `at`; `None` when a `;` comes before it.
fn block_end(source: &str, code: &[Token], at: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (index, token) in code.iter().enumerate().skip(at) {
        match token.text(source) {
            "{" => depth += 1,
            "}" => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(index);
                }
            }
            ";" if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

/// Where the comments begin that stand directly above `start`: no blank line between, no code on their lines.
fn comments_above(source: &str, all: &[Token], start: usize) -> usize {
    let mut first = start;
    let before = all.partition_point(|t| t.start < start);
    for (index, token) in all[..before].iter().enumerate().rev() {
        let is_own = token.kind.is_comment() && token.kind != TokenKind::ModuleComment;
        let blank_line = line_breaks(&source[token.end..first]) > 1;
        let beside_code = index > 0
            && !all[index - 1].kind.is_comment()
            && line_breaks(&source[all[index - 1].end..token.start]) == 0;
        if !is_own || blank_line || beside_code {
            break;
        }
        first = token.start;
    }
    first
}

/// The end of a line comment on the line where an item ends, or `end`.
fn comment_beside(source: &str, all: &[Token], end: usize) -> usize {
    let after = all.partition_point(|t| t.start < end);
    match all.get(after) {
        Some(token) if token.kind == TokenKind::LineComment && line_breaks(&source[end..token.start]) == 0 => token.end,
        _ => end,
    }
}

/// Number of line breaks; `\r\n` is one.
fn line_breaks(text: &str) -> usize {
    text.chars().filter(|&c| is_line_break(c)).count() - text.matches("\r\n").count()
}

fn line_of(source: &str, offset: usize) -> usize {
    1 + line_breaks(source.get(..offset).unwrap_or(source))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(source: &str) -> Item {
        let mut items = slice(source).expect("a sound text");
        assert_eq!(items.len(), 1, "{items:?}");
        items.remove(0)
    }

    #[test]
    fn items_with_their_comments() {
        let source = "//! file\n// head of the file\n\n// about A\nconst A = 1.0; // beside A\nalias V = vec3f;\n\n\
                      /// about S\n/// more\nstruct S {\n    /// m\n    a: V, @align(16) b: array<f32, N>,\n};\n/* f */ \
                      @must_use fn f(a: S) -> f32 { return a.b[0]; }";
        let items = slice(source).unwrap();
        let found: Vec<(ItemKind, &str, &str)> =
            items.iter().map(|i| (i.kind, i.name.as_str(), &source[i.start..i.start + 10])).collect();
        assert_eq!(
            found,
            [
                (ItemKind::Const, "A", "// about A"),
                (ItemKind::Alias, "V", "alias V = "),
                (ItemKind::Struct, "S", "/// about "),
                (ItemKind::Fn, "f", "/* f */ @m"),
            ]
        );
        assert!(source[items[0].start..items[0].end].ends_with("// beside A"));
        assert_eq!(items[2].dependencies, ["N", "V", "array", "f32"]);
        assert_eq!(items[3].dependencies, ["S", "f32"]);
        assert_eq!(&source[items[3].code_start..items[3].code_start + 9], "@must_use");
    }

    #[test]
    fn locals_are_no_dependencies_and_shadow_in_order() {
        let item = one("fn f(p: f32, g: vec3f) -> f32 {\n\
             let h = h(p) + g.k;\n\
             for (var i = 0; i < N; i++) { let inner = h; if (i > 1) { break; } }\n\
             { let luminance = 1.0; }\n\
             return luminance(vec3f(h)) + inner(i);\n}");
        assert_eq!(item.dependencies, ["N", "f32", "h", "i", "inner", "luminance", "vec3f"]);
        let source = "fn f(x: f32) -> f32 { let h = h(x); return h + h(1.0); }";
        let words: Vec<&str> = one(source).references.iter().map(|r| &source[r.clone()]).collect();
        assert_eq!(words, ["f32", "f32", "h"], "after its declaration the local h hides the function h");
    }

    #[test]
    fn constants_use_what_their_value_names() {
        assert_eq!(one("const TWO_PI: f32 = 2.0 * PI;").dependencies, ["PI", "f32"]);
        assert_eq!(one("@group(0) @binding(B) var<uniform> u: View;").dependencies, ["B", "View"]);
        assert_eq!(
            one("@vertex fn v(@builtin(vertex_index) i: u32) -> @builtin(position) P {}").dependencies,
            ["P", "u32"]
        );
    }

    #[test]
    fn faults_name_their_line() {
        let fault = |source: &str| slice(source).map(|_| ()).unwrap_err();
        assert_eq!(fault("fn f() {}\nenable f16;").kind, SliceErrorKind::NotAnItem("enable".into()));
        assert_eq!(fault("\nfn f() {}\nenable f16;").line, 3);
        assert_eq!(fault("fn f() {").kind, SliceErrorKind::Unfinished);
        assert_eq!(fault("fn f();").kind, SliceErrorKind::Unfinished);
        assert_eq!(fault("fn f() )").kind, SliceErrorKind::Unbalanced);
        for (text, missing, offset) in [
            ("fn f() { a(b; }", ')', 12),
            ("fn f() { a(b\n}", ')', 12),
            ("fn f() { a[b\n  return c; }", ']', 12),
            ("fn f() { if (a { } }", ')', 14),
            ("fn f() { a(b[0); }", ']', 14),
            ("fn f() { for (var i = 0; i < 3; i++ { } }", ')', 35),
        ] {
            let fault = fault(text);
            assert_eq!((fault.kind, fault.offset), (SliceErrorKind::Unclosed(missing), offset), "{text}");
        }
        assert_eq!(fault("fn () {}").kind, SliceErrorKind::NoName);
        assert_eq!(fault("/* /* */").kind, SliceErrorKind::Unfinished);
        assert_eq!(fault("@").kind, SliceErrorKind::NotAnItem("@".into()));
        assert!(slice("/* a */").unwrap().is_empty());
    }

    #[test]
    fn depth_is_bounded() {
        let nested = |n: usize| format!("const A = {}1{};", "(".repeat(n), ")".repeat(n));
        assert!(slice(&nested(MAX_NESTING)).is_ok());
        assert_eq!(slice(&nested(MAX_NESTING + 1)).unwrap_err().kind, SliceErrorKind::TooDeep);
        // The `=` is an operator too.
        let sum = |n: usize| format!("const A = 1{};", "+1".repeat(n));
        assert!(slice(&sum(MAX_OPERATORS - 1)).is_ok());
        assert_eq!(slice(&sum(MAX_OPERATORS)).unwrap_err().kind, SliceErrorKind::TooDeep);
        let chain = |n: usize| format!("fn f() {{ if a {{ }} {} }}", "else if a { } ".repeat(n));
        assert!(slice(&chain(MAX_NESTING)).is_ok());
        assert_eq!(slice(&chain(MAX_NESTING + 1)).unwrap_err().kind, SliceErrorKind::TooDeep);
        // Many in a row are no chain.
        let row = format!("fn f() {{ {} }}", "if a { } else { } ".repeat(10 * MAX_NESTING));
        assert!(slice(&row).is_ok());
    }

    #[test]
    fn generic_header() {
        assert_eq!(generic_types("//! T = f32 | vec2f\nalias T = vec2f;").unwrap(), ["f32", "vec2f"]);
        assert_eq!(generic_types("// T = f32"), None);
    }
}
