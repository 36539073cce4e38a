//! Functions that a document brings along: WGSL of its user, read by the grammar of the library. It is hostile until it is
//! checked: nothing of it goes on that could hang, overflow or reach beyond its arguments.
//!
//! Allowed are functions, structs, constants and aliases without attributes, 64 KiB of them, that use WGSL's own
//! functions, each other, and the library's by their names there. Loops count to a number that stands in the text, and all of them together run at most
//! [`MAX_WORK`] times; so do those of all nodes that reach the surface (`check`). Textures are read with an explicit level or gradient, since a node may stand in a branch. The names get the
//! function's id as prefix, so that none shadows anything.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

use halfvector_shaders::{Item, ItemKind, Token, TokenKind, slice, tokens};

use super::loops::{whole_constants, work};
use super::signature::{SURFACE_STRUCT, Signatures, judge};
use super::{Source, borrowed, complaint, line_of, node};
use crate::document::is_name;
use crate::node_def::NodeDef;

/// Longest text, in bytes.
pub const MAX_BYTES: usize = 64 << 10;
/// Most turns of loops and calls in one evaluation of the node, and in those of all nodes of a material together.
pub const MAX_WORK: u64 = 1 << 16;
/// Longest array.
const MAX_ARRAY: u64 = 256;

/// What is wrong with a document's function, and where in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CodeError {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// What is wrong and what to do.
    pub message: String,
    /// The line, or of a long one what stands about the place.
    pub excerpt: String,
    /// Characters of the line in front of the excerpt.
    pub skipped: usize,
}

impl fmt::Display for CodeError {
    /// The message, and below it the line with a caret under the place.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let before = self.excerpt.chars().take(self.column - 1 - self.skipped);
        let margin: String = before.map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        write!(f, "line {}, column {}: {}\n    {}\n    {margin}^", self.line, self.column, self.message, self.excerpt)
    }
}

/// A function of a document that has passed.
#[derive(Clone, Debug, PartialEq)]
pub struct CustomFunction {
    /// The node that it is: `custom/<id>`.
    pub def: NodeDef,
    /// The text with the names that it has in a shader.
    pub source: String,
    /// Turns of loops and calls in one evaluation, at most [`MAX_WORK`]. A call of a function of the library that has loops counts 64.
    pub work: u64,
}

/// Reads a function of a document by its id. Answers are remembered, so that asking again costs nothing.
///
/// # Errors
/// The first thing that is wrong.
pub fn read_function(id: &str, text: &str) -> Result<Arc<CustomFunction>, CodeError> {
    type Known = HashMap<(String, String), Result<Arc<CustomFunction>, CodeError>>;
    static KNOWN: OnceLock<Mutex<Known>> = OnceLock::new();
    /// So many texts are remembered, all of them forgotten when there are more: typing makes a new one with each key.
    const MAX_KNOWN: usize = 512;
    let known = KNOWN.get_or_init(Mutex::default);
    let key = (id.to_string(), text.to_string());
    if let Some(answer) = known.lock().ok().and_then(|known| known.get(&key).cloned()) {
        return answer;
    }
    let answer = read(id, text).map(Arc::new);
    if let Ok(mut known) = known.lock() {
        if known.len() >= MAX_KNOWN {
            known.clear();
        }
        known.insert(key, answer.clone());
    }
    answer
}

/// An error at a byte of the text.
pub(super) fn error_at(text: &str, at: usize, message: impl Into<String>) -> CodeError {
    let at = (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let line = text[start..].lines().next().unwrap_or("");
    // A line may be as long as the text: what stands around the place is enough.
    const SHOWN: usize = 120;
    let column = text[start..at].chars().count();
    let skipped = column.saturating_sub(SHOWN / 2);
    CodeError {
        line: line_of(text, at),
        column: column + 1,
        message: message.into(),
        excerpt: line
            .chars()
            .skip(skipped)
            .take(SHOWN)
            .map(|c| if c.is_control() && c != '\t' { ' ' } else { c })
            .collect(),
        skipped,
    }
}

fn read(id: &str, text: &str) -> Result<CustomFunction, CodeError> {
    let fail = |at: usize, message: String| Err(error_at(text, at, message));
    if !is_name(id) || id.bytes().any(|b| b.is_ascii_uppercase()) {
        return fail(0, "the function's id is small letters, digits and _, first a letter".into());
    }
    if text.len() > MAX_BYTES {
        return fail(MAX_BYTES, format!("the text is longer than {} KiB", MAX_BYTES >> 10));
    }
    let items = slice(text).map_err(|error| {
        let (at, message) = complaint::of_slicer(text, &error);
        error_at(text, at, message)
    })?;
    let code: Vec<Token> = tokens(text).into_iter().filter(|token| !token.kind.is_comment()).collect();
    refuse_items(text, &items)?;
    refuse_words(text, &code, &items)?;
    refuse_structs_in_structs(text, &code, &items)?;
    let work = work(text, &items, &code)?;
    if halfvector_shaders::generic_types(text).is_some() {
        return fail(0, "a function of a document has fixed types; leave out `//! T =`".into());
    }
    let library = borrowed::reached(text, &items).map_err(|(range, message)| error_at(text, range.start, message))?;
    let bare = without_comments(text);
    let signatures =
        judge(&format!("{bare}\n{library}"), text.len()).map_err(|(at, message)| error_at(text, at, message))?;
    let main = main_function(id, text, &items)?;
    let derivative = code.iter().find(|token| takes_derivative(token.text(text), &items, &signatures));
    let derivative = derivative.map(|token| token.start);
    let work = work.get(main.as_str()).copied().unwrap_or(1);
    let names = new_names(id, &items, &main);
    let source = renamed(text, &items, &names);
    let signatures = signatures.renamed(|name| names.get(name).cloned());
    let (path, mut problems) = (format!("nodes/custom/{id}.wgsl"), Vec::new());
    let file = Source::read(&path, &source, &mut problems);
    let mut defs =
        file.map(|file| node::read_nodes(&file, &signatures, &mut Vec::new(), &mut problems)).unwrap_or_default();
    if let Some(problem) = problems.first() {
        let line = text.split_inclusive('\n').take(problem.line.saturating_sub(1)).map(str::len).sum();
        return fail(line, problem.message.clone());
    }
    let (Some(mut def), true) = (defs.pop(), defs.is_empty()) else {
        return fail(0, format!("write `/// @node custom/{id}` above the function that is the node"));
    };
    def.file = format!("custom/{id}");
    if def.function.implicit_derivatives {
        let at =
            derivative.or_else(|| items.iter().find(|item| item.name == main).map(|item| item.code_start)).unwrap_or(0);
        return fail(
            at,
            "it compares neighbouring pixels, which fails in a branch: read textures with textureSampleLevel or textureSampleGrad, take no derivatives, and of the library's nodes call the form of the vertex stage, such as `node_procedural_wave_vertex`".into(),
        );
    }
    Ok(CustomFunction { def, source, work })
}

/// The text with blanks for comments that are no docs: naga drops the docs after them. Each byte stays where it is.
fn without_comments(text: &str) -> String {
    let mut bare = String::with_capacity(text.len());
    let mut at = 0;
    for token in tokens(text) {
        if matches!(token.kind, TokenKind::LineComment | TokenKind::BlockComment | TokenKind::ModuleComment) {
            bare.push_str(&text[at..token.start]);
            bare.extend(token.text(text).bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
            at = token.end;
        }
    }
    bare.push_str(&text[at..]);
    bare
}

fn refuse_items(text: &str, items: &[Item]) -> Result<(), CodeError> {
    if items.is_empty() {
        return Err(error_at(text, 0, "there is no function"));
    }
    let mut names = HashSet::new();
    for item in items {
        if item.kind == ItemKind::Var {
            return Err(error_at(
                text,
                item.code_start,
                "a node has no variables, bindings or overrides of its own; make it an argument, or a `const`",
            ));
        }
        if item.name == "T" {
            return Err(error_at(
                text,
                item.name_range.start,
                "`T` is the library's name for any type; choose another name",
            ));
        }
        // A type of another meaning would say of a counter what it is not.
        if is_of_wgsl(&item.name) {
            let message = format!("`{}` is a type of WGSL; choose another name", item.name);
            return Err(error_at(text, item.name_range.start, message));
        }
        if item.name == SURFACE_STRUCT {
            return Err(error_at(
                text,
                item.name_range.start,
                "`Surface` is the library's name for what a material is; choose another name",
            ));
        }
        if !names.insert(item.name.as_str()) {
            return Err(error_at(text, item.name_range.start, format!("`{}` stands twice", item.name)));
        }
    }
    Ok(())
}

/// Whether it is the name of one of WGSL's own types.
fn is_of_wgsl(name: &str) -> bool {
    let numbered = |head: &str| name.strip_prefix(head).is_some_and(|rest| rest.starts_with(['2', '3', '4']));
    matches!(name, "bool" | "f16" | "f32" | "f64" | "i32" | "i64" | "u32" | "u64" | "array" | "atomic" | "ptr")
        || ["vec", "mat"].into_iter().any(numbered)
}

/// Refuses what reaches beyond arguments and results, and what need not end.
fn refuse_words(text: &str, code: &[Token], items: &[Item]) -> Result<(), CodeError> {
    let (aliases, numbers) = (aliases(text, code, items), whole_constants(text, items));
    let word = |i: usize| code.get(i).map_or("", |token| token.text(text));
    for (i, token) in code.iter().enumerate() {
        let message = match token.text(text) {
            "@" => "attributes such as entry points and bindings are no part of a node; leave it out",
            "loop" | "while" => "a loop that need not end; write `for (var i = 0; i < 8; i++)`",
            "discard" => "a node gives values and cannot discard; feed the surface's opacity instead",
            "ptr" | "atomic" | "override" => "a node works on values only; leave it out",
            "&" if takes_address(text, code, i) => "`&` makes a pointer, and a node works on values only; leave it out",
            word if word.ends_with("Barrier") => "a node has no others to wait for; leave it out",
            name if is_of_some_devices(name) => "not every device has this type; there are f32, i32, u32 and bool",
            name if word(i + 1) == "(" && reaches_beyond(name) && items.iter().all(|item| item.name != name) => {
                "this reaches beyond the values of a node: its neighbours, memory or rays; leave it out"
            }
            "array" if word(i + 1) == "<" => {
                let number = |i: usize| numbers.get(&code.get(i)?.start).copied();
                if let Some(message) = array_problem(&word, &aliases, &number, i) {
                    message
                } else {
                    continue;
                }
            }
            // Of what is inferred nobody knows the size: four of four of four ... fill the memory in a few lines.
            "array" if word(i + 1) == "(" => "write the array's type: `array<f32, 3>(1.0, 2.0, 3.0)`",
            _ => continue,
        };
        // `x.loop` is no loop, but WGSL has no such member either.
        return Err(error_at(text, token.start, message));
    }
    Ok(())
}

/// Whether the `&` at `i` stands in front of a value: it follows no value, or is a third one behind `&&`.
fn takes_address(text: &str, code: &[Token], i: usize) -> bool {
    let before = |i: usize| i.checked_sub(1).and_then(|i| code.get(i));
    let mut first = i;
    while before(first).is_some_and(|token| token.text(text) == "&" && token.end == code[first].start) {
        first -= 1;
    }
    let follows_value = before(first).is_some_and(|token| match token.kind {
        TokenKind::Identifier => !matches!(token.text(text), "return" | "case"),
        kind => kind == TokenKind::Number || matches!(token.text(text), ")" | "]"),
    });
    if follows_value { i - first == 2 } else { true }
}

/// Whether it is the name of a type of 16 or 64 bits.
fn is_of_some_devices(word: &str) -> bool {
    let is_half = |word: &str| word.starts_with(['2', '3', '4']) && word.ends_with('h');
    matches!(word, "f16" | "f64" | "i16" | "u16" | "i64" | "u64")
        || word.strip_prefix("vec").or_else(|| word.strip_prefix("mat")).is_some_and(is_half)
}

/// Whether it is a function beyond the text's own that compares neighbouring pixels.
fn takes_derivative(word: &str, items: &[Item], signatures: &Signatures) -> bool {
    let is_of_wgsl = matches!(word, "textureSample" | "textureSampleBias")
        || ["dpdx", "dpdy", "fwidth"].into_iter().any(|head| word.starts_with(head));
    (is_of_wgsl || signatures.takes_derivatives(word)) && items.iter().all(|item| item.name != word)
}

/// Whether it is one of WGSL's functions that work on more than values.
fn reaches_beyond(word: &str) -> bool {
    ["subgroup", "quad", "atomic", "workgroup", "rayQuery", "coop"]
        .into_iter()
        .any(|head| word.strip_prefix(head).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_uppercase())))
        || matches!(word, "textureStore" | "textureBarrier" | "arrayLength")
}

/// The words at which the types behind aliases begin, by the aliases' names.
fn aliases<'t>(text: &str, code: &[Token], items: &'t [Item]) -> HashMap<&'t str, usize> {
    let named = items.iter().filter(|item| item.kind == ItemKind::Alias);
    // The name, and `=` behind it.
    named
        .map(|item| (item.name.as_str(), code.partition_point(|token| token.start < item.name_range.end) + 1))
        .filter(|(_, at)| code.get(at - 1).is_some_and(|token| token.text(text) == "="))
        .collect()
}

/// The place behind a type that an array may hold and that begins at word `i`, by whatever name.
fn element_end<'t>(word: &impl Fn(usize) -> &'t str, aliases: &HashMap<&str, usize>, i: usize) -> Option<usize> {
    const SCALARS: [&str; 4] = ["f32", "i32", "u32", "bool"];
    const VECTORS: [&str; 9] = ["vec2f", "vec3f", "vec4f", "vec2i", "vec3i", "vec4i", "vec2u", "vec3u", "vec4u"];
    let (mut at, mut end) = (i, None);
    // An alias may be one of an alias; of those in a ring nothing is said here.
    for _ in 0..=aliases.len() {
        if let Some(behind) = aliases.get(word(at)) {
            (at, end) = (*behind, end.or(Some(at + 1)));
            continue;
        }
        if SCALARS.contains(&word(at)) || VECTORS.contains(&word(at)) {
            return end.or(Some(at + 1));
        }
        let is_vector = matches!(word(at), "vec2" | "vec3" | "vec4") && word(at + 1) == "<" && word(at + 3) == ">";
        return (is_vector && SCALARS.contains(&behind_aliases(word, aliases, at + 2))).then(|| end.unwrap_or(at + 4));
    }
    None
}

/// The word `i`, or the one that it is another name for.
fn behind_aliases<'t>(word: &impl Fn(usize) -> &'t str, aliases: &HashMap<&str, usize>, i: usize) -> &'t str {
    let mut at = i;
    for _ in 0..=aliases.len() {
        match aliases.get(word(at)) {
            Some(behind) => at = *behind,
            None => break,
        }
    }
    word(at)
}

/// What is wrong with the array type whose name is word `i`.
fn array_problem<'t>(
    word: &impl Fn(usize) -> &'t str,
    aliases: &HashMap<&str, usize>,
    number: &impl Fn(usize) -> Option<u64>,
    i: usize,
) -> Option<&'static str> {
    let Some(end) = element_end(word, aliases, i + 2) else {
        return Some("an array holds f32, i32, u32, bool or vectors such as vec3f");
    };
    let size = integer(word(end + 1)).or_else(|| number(end + 1));
    let closes = word(end + 2) == ">" || (word(end + 2) == "," && word(end + 3) == ">");
    match size.filter(|_| word(end) == "," && closes) {
        Some(size) if size <= MAX_ARRAY => None,
        _ => Some(
            "an array has a number of elements that stands in its type, at most 256: `array<f32, 8>`, or `array<f32, N>` with `const N = 8;`",
        ),
    }
}

/// The value of a decimal integer literal.
pub(super) fn integer(word: &str) -> Option<u64> {
    word.trim_end_matches(['i', 'u']).parse().ok()
}

/// The size of a struct of structs of structs grows beyond all bounds.
fn refuse_structs_in_structs(text: &str, code: &[Token], items: &[Item]) -> Result<(), CodeError> {
    let word = |i: usize| code.get(i).map_or("", |token| token.text(text));
    let aliases = aliases(text, code, items);
    let is_large = |item: &&Item| match item.kind {
        ItemKind::Struct => true,
        // Another name for a number or a vector hides no struct.
        ItemKind::Alias => aliases.get(item.name.as_str()).is_none_or(|at| element_end(&word, &aliases, *at).is_none()),
        _ => false,
    };
    let types: HashSet<&str> = items.iter().filter(is_large).map(|item| item.name.as_str()).collect();
    for item in items.iter().filter(|item| item.kind == ItemKind::Struct) {
        let inner = item.references.iter().find(|range| types.contains(&text[(*range).clone()]));
        if let Some(range) = inner {
            return Err(error_at(text, range.start, "a struct has numbers, vectors, matrices and arrays as members"));
        }
    }
    Ok(())
}

/// The name of the function that is the node.
fn main_function(id: &str, text: &str, items: &[Item]) -> Result<String, CodeError> {
    let wanted = format!("write `/// @node custom/{id}` above the function that is the node");
    let mut main = None;
    for item in items.iter().filter(|item| item.kind == ItemKind::Fn) {
        let mut at = item.start;
        for line in text[item.start..item.code_start].split_inclusive('\n') {
            let said = line.trim_start().strip_prefix("///").map(str::trim_start);
            if let Some(rest) = said.and_then(|line| line.strip_prefix("@node")) {
                if main.is_some() {
                    return Err(error_at(text, at, "one function is the node; leave out this `@node`"));
                }
                if rest.split_whitespace().next() != Some(&format!("custom/{id}")) {
                    return Err(error_at(text, at, wanted));
                }
                main = Some(item.name.clone());
            }
            at += line.len();
        }
    }
    main.ok_or_else(|| error_at(text, 0, wanted))
}

/// The names that the items have in a shader, by those in the text. The number of an id's underscores stands before it, where it has
/// any, so that `b_c` of `a` and `c` of `a_b` differ.
fn new_names<'i>(id: &str, items: &'i [Item], main: &str) -> HashMap<&'i str, String> {
    let underscores = id.matches('_').count();
    let prefix = if underscores == 0 { format!("custom_{id}") } else { format!("custom{underscores}_{id}") };
    let new = |item: &'i Item| {
        let name = if item.name == main { format!("node_custom_{id}") } else { format!("{prefix}_{}", item.name) };
        (item.name.as_str(), name)
    };
    items.iter().map(new).collect()
}

/// The text with other names of its items; lines stay where they are.
fn renamed(text: &str, items: &[Item], new: &HashMap<&str, String>) -> String {
    let mut places: Vec<_> = items
        .iter()
        .flat_map(|item| item.references.iter().chain([&item.name_range]))
        .filter_map(|range| Some((range.clone(), new.get(&text[range.clone()])?)))
        .collect();
    places.sort_by_key(|(range, _)| range.start);
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (range, name) in places {
        out.push_str(&text[at..range.start]);
        out.push_str(name);
        at = range.end;
    }
    out.push_str(&text[at..]);
    out
}
