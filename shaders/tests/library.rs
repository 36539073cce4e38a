//! The whole library against naga and against its own rules: every file is listed, validates with what it depends on,
//! has its functions documented, and gives the slicer's dependencies as naga sees them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use halfvector_shaders::{FILES, File, Item, ItemKind, SliceError, emit, generic_types, slice, tokens};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// An item and the file that it stands in.
struct Entry {
    file: &'static File,
    item: Item,
}

/// Files with entry points are whole shaders; their names need not be unlike another's.
fn is_entry(file: &File) -> bool {
    let is_entry_point = |item: &Item| {
        let code = &file.source[item.code_start..];
        ["@vertex", "@fragment", "@compute"].iter().any(|stage| code.starts_with(stage))
    };
    items(file).iter().any(is_entry_point)
}

fn items(file: &File) -> Vec<Item> {
    slice(file.source).unwrap_or_else(|e| panic!("{}: {e}", file.path))
}

/// Every item that can be linked, by name; the aliases `T` of generic nodes are left out, they are never linked.
fn index() -> BTreeMap<String, Entry> {
    let mut index = BTreeMap::new();
    for file in FILES.iter().filter(|f| !is_entry(f)) {
        for item in items(file) {
            if item.kind == ItemKind::Alias && item.name == "T" && generic_types(file.source).is_some() {
                continue;
            }
            let name = item.name.clone();
            let other = index.insert(name.clone(), Entry { file, item });
            assert!(other.is_none(), "`{name}` stands in {} and in {}", file.path, other.unwrap().file.path);
        }
    }
    index
}

/// The text of a file's items with everything that they reach; `T` becomes `generic`.
fn linked(file: &File, generic: Option<&str>, index: &BTreeMap<String, Entry>) -> String {
    let own = items(file);
    let is_t = |item: &Item| generic.is_some() && item.name == "T";
    let own: Vec<Item> = own.into_iter().filter(|item| !is_t(item)).collect();
    let rename = |name: &str| generic.filter(|_| name == "T").map(str::to_owned);
    let mut text: String = own.iter().map(|item| emit(file.source, item, rename) + "\n").collect();
    let mut done: BTreeSet<&str> = own.iter().map(|item| item.name.as_str()).collect();
    let mut todo: Vec<&str> = own.iter().flat_map(|item| &item.dependencies).map(String::as_str).collect();
    while let Some(name) = todo.pop() {
        let Some(entry) = index.get(name) else { continue };
        if done.insert(name) {
            text += &(emit(entry.file.source, &entry.item, |_| None) + "\n");
            todo.extend(entry.item.dependencies.iter().map(String::as_str));
        }
    }
    text
}

fn validated(what: &str, source: &str) -> naga::Module {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{what}: {}", e.emit_to_string(source)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{what}: {}", e.emit_to_string(source)));
    module
}

#[test]
fn every_file_is_listed_once_and_sorted() {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("a folder of the library") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    walk(root, &mut found);
    let mut found: Vec<String> = found
        .iter()
        .map(|path| path.strip_prefix(root).expect("below the root").to_string_lossy().replace('\\', "/"))
        // What stands there is put in front of the library's text, and is none of it.
        .filter(|path| !path.starts_with("src/"))
        .collect();
    found.sort();
    let listed: Vec<&str> = FILES.iter().map(|f| f.path).collect();
    assert_eq!(listed, found, "the list in src/lib.rs (left) and the folder (right) differ");
}

#[test]
fn every_file_validates_with_what_it_depends_on() {
    let index = index();
    for file in FILES {
        match generic_types(file.source) {
            None => drop(validated(file.path, &linked(file, None, &index))),
            Some(types) => {
                // As it stands, with its own alias, and for each type.
                validated(file.path, &linked(file, None, &index));
                for ty in types {
                    validated(&format!("{} for {ty}", file.path), &linked(file, Some(ty), &index));
                }
            }
        }
    }
}

/// The functions that a function calls, by naga: callees of call expressions and statements.
fn calls(module: &naga::Module, function: &naga::Function) -> BTreeSet<String> {
    fn walk(block: &naga::Block, found: &mut Vec<naga::Handle<naga::Function>>) {
        for statement in block {
            match statement {
                naga::Statement::Call { function, .. } => found.push(*function),
                naga::Statement::Block(inner) => walk(inner, found),
                naga::Statement::If { accept, reject, .. } => {
                    walk(accept, found);
                    walk(reject, found);
                }
                naga::Statement::Switch { cases, .. } => cases.iter().for_each(|case| walk(&case.body, found)),
                naga::Statement::Loop { body, continuing, .. } => {
                    walk(body, found);
                    walk(continuing, found);
                }
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    walk(&function.body, &mut found);
    found.into_iter().filter_map(|handle| module.functions[handle].name.clone()).collect()
}

#[test]
fn dependencies_are_nagas_calls() {
    let index = index();
    let functions: BTreeSet<&str> =
        index.iter().filter(|(_, e)| e.item.kind == ItemKind::Fn).map(|(name, _)| name.as_str()).collect();
    let mut compared = 0;
    for file in FILES.iter().filter(|f| !is_entry(f)) {
        let module = validated(file.path, &linked(file, None, &index));
        for (_, function) in module.functions.iter() {
            let name = function.name.as_deref().expect("a named function");
            let sliced: BTreeSet<String> = index[name]
                .item
                .dependencies
                .iter()
                .filter(|dependency| functions.contains(dependency.as_str()))
                .cloned()
                .collect();
            assert_eq!(sliced, calls(&module, function), "{name} in {}: slicer (left), naga (right)", file.path);
            compared += 1;
        }
    }
    assert!(compared >= functions.len(), "{compared} of {} functions compared", functions.len());
}

/// Names that would hide one of WGSL's own everywhere.
fn is_of_wgsl(name: &str) -> bool {
    naga::keywords::wgsl::RESERVED.contains(&name) || naga::keywords::wgsl::BUILTIN_IDENTIFIERS.contains(&name)
}

#[test]
fn no_name_hides_one_of_wgsls() {
    for file in FILES {
        for item in items(file) {
            assert!(!is_of_wgsl(&item.name), "{}: `{}` is a name of WGSL's", file.path, item.name);
        }
        // Arguments, members and locals: `name :`, and what follows let, var or const.
        let code: Vec<&str> =
            tokens(file.source).iter().filter(|t| !t.kind.is_comment()).map(|t| t.text(file.source)).collect();
        for pair in code.windows(2) {
            let declared = match pair {
                [name, ":"] if *name != "default" => name,
                ["let" | "var" | "const", name] => name,
                _ => continue,
            };
            assert!(!is_of_wgsl(declared), "{}: `{declared}` hides a name of WGSL's", file.path);
        }
    }
}

#[test]
fn every_function_and_struct_says_what_it_is() {
    for file in FILES.iter().filter(|f| !is_entry(f)) {
        for item in items(file) {
            let documented = item.start < item.code_start;
            let needed = matches!(item.kind, ItemKind::Fn | ItemKind::Struct);
            assert!(documented || !needed, "{}: no comment above `{}`", file.path, item.name);
        }
    }
}

/// (id, function) of every node, by its `@node` line.
fn nodes() -> Vec<(String, String, &'static File)> {
    let mut nodes = Vec::new();
    for file in FILES {
        for item in items(file) {
            let comment = &file.source[item.start..item.code_start];
            for id in comment.lines().filter_map(|l| l.split_once("@node ").map(|(_, rest)| rest)) {
                let id = id.split_whitespace().next().unwrap_or("").to_owned();
                nodes.push((id, item.name.clone(), file));
            }
        }
    }
    nodes
}

#[test]
fn nodes_are_named_by_their_id_and_stand_in_their_folder() {
    let nodes = nodes();
    for (id, function, file) in &nodes {
        assert_eq!(*function, format!("node_{}", id.replace('/', "_")), "{}", file.path);
        let category = id.split('/').next().unwrap_or("");
        assert!(file.path.starts_with(&format!("nodes/{category}/")), "{id} stands in {}", file.path);
    }
    let ids: BTreeSet<&String> = nodes.iter().map(|(id, ..)| id).collect();
    assert_eq!(ids.len(), nodes.len(), "a node id stands twice");
    assert!(ids.len() >= 70, "{} nodes", ids.len());
}

#[test]
fn a_generic_file_holds_one_function() {
    for file in FILES.iter().filter(|f| generic_types(f.source).is_some()) {
        let items = items(file);
        let shape: Vec<(ItemKind, bool)> = items.iter().map(|i| (i.kind, i.name == "T")).collect();
        assert_eq!(shape, [(ItemKind::Alias, true), (ItemKind::Fn, false)], "{}", file.path);
    }
}

/// A small deterministic generator (Steele, Lea, Flood 2014, SplitMix64), so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}

#[test]
fn any_text_is_sliced_or_refused() {
    const PIECES: [&str; 48] = [
        "fn",
        "struct",
        "const",
        "alias",
        "var",
        "override",
        "let",
        "for",
        "if",
        "else",
        "f",
        "T",
        "x",
        "é",
        "名",
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        "<",
        ">",
        "@",
        "@builtin(",
        ";",
        ":",
        ",",
        ".",
        "=",
        "->",
        "1",
        "1.e",
        "0x",
        ".5",
        "//",
        "///",
        "//!",
        "/*",
        "*/",
        "/**/",
        "/**",
        "\n",
        "\r\n",
        "\u{2028}",
        " ",
        "\u{0}",
        "\u{1f600}",
    ];
    let mut random = Random(1);
    let (mut sliced, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let length = random.below(40);
        let text: String = (0..length).map(|_| PIECES[random.below(PIECES.len())]).collect();
        check_any(&text, &mut sliced, &mut refused);
    }
    // Sound files with a piece cut out, put in, or the end cut off.
    for file in FILES {
        for _ in 0..40 {
            let mut text: Vec<char> = file.source.chars().collect();
            let at = random.below(text.len());
            match random.below(3) {
                0 => drop(text.drain(at..(at + random.below(20)).min(text.len()))),
                1 => drop(text.splice(at..at, PIECES[random.below(PIECES.len())].chars()).collect::<Vec<_>>()),
                _ => text.truncate(at),
            }
            check_any(&text.into_iter().collect::<String>(), &mut sliced, &mut refused);
        }
    }
    assert!(sliced > 100 && refused > 100, "{sliced} sliced, {refused} refused: the texts test only one way");
}

fn check_any(text: &str, sliced: &mut usize, refused: &mut usize) {
    let mut end = 0;
    for token in tokens(text) {
        assert!(text[end..token.start].chars().all(|c| c.is_whitespace() || matches!(c, '\u{200e}' | '\u{200f}')));
        assert!(token.start < token.end);
        end = token.end;
    }
    match slice(text) {
        Ok(items) => {
            *sliced += 1;
            let mut end = 0;
            for item in &items {
                assert!(end <= item.start && item.start <= item.code_start && item.code_start < item.end, "{text:?}");
                assert_eq!(text[item.name_range.clone()], item.name);
                let same = emit(text, item, |_| None);
                assert!(same.ends_with(&text[item.code_start..item.end]), "{text:?}");
                end = item.end;
            }
        }
        Err(SliceError { offset, line, .. }) => {
            *refused += 1;
            assert!(offset <= text.len() && line >= 1);
        }
    }
}
