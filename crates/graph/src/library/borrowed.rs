//! What a document's function takes of the shipped library: functions, structs and constants by their names there, with all that they
//! need. Functions of generic files have no one name and cannot be called.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::ops::Range;
use std::sync::OnceLock;

use halfvector_shaders::{FILES, Item, ItemKind, generic_types, slice, tokens};

/// An item of the library.
struct Known {
    /// Index of its file, and of it there.
    place: (usize, usize),
    /// Without the comments above it.
    text: &'static str,
    dependencies: Vec<String>,
    kind: ItemKind,
    is_generic: bool,
}

/// The library's items by name.
fn known() -> &'static HashMap<String, Known> {
    static KNOWN: OnceLock<HashMap<String, Known>> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let files = FILES.iter().enumerate().filter(|(_, file)| !file.path.starts_with("entry/"));
        let items = files.flat_map(|(i, file)| {
            let is_generic = generic_types(file.source).is_some();
            // The files are embedded and tests slice them.
            let items = slice(file.source).unwrap_or_default();
            items.into_iter().enumerate().map(move |(k, item)| {
                let Item { kind, name, code_start, end, dependencies, .. } = item;
                let text = &file.source[code_start..end];
                (name, Known { place: (i, k), text, dependencies, kind, is_generic })
            })
        });
        // `T` is each generic file's own.
        items.filter(|(name, _)| name != "T").collect()
    })
}

/// Whether the library has a function of this name.
pub(super) fn is_function(name: &str) -> bool {
    known().get(name).is_some_and(|known| known.kind == ItemKind::Fn)
}

/// Whether a function of the library has a loop, itself or in what it calls.
pub(super) fn loops(name: &str) -> bool {
    static LOOPING: OnceLock<HashSet<&'static str>> = OnceLock::new();
    let looping = LOOPING.get_or_init(|| {
        let is_loop = |text: &str| {
            let code = tokens(text).into_iter().filter(|token| !token.kind.is_comment());
            code.map(|token| token.text(text)).any(|word| matches!(word, "for" | "loop" | "while"))
        };
        let own = known().iter().filter(|(_, known)| known.kind == ItemKind::Fn && is_loop(known.text));
        let mut looping: HashSet<&str> = own.map(|(name, _)| name.as_str()).collect();
        loop {
            let calls = |known: &Known| known.dependencies.iter().any(|name| looping.contains(name.as_str()));
            let more: Vec<&str> = known()
                .iter()
                .filter(|(name, known)| !looping.contains(name.as_str()) && calls(known))
                .map(|(name, _)| name.as_str())
                .collect();
            if more.is_empty() {
                return looping;
            }
            looping.extend(more);
        }
    });
    looping.contains(name)
}

/// The names of the library's functions that can be called.
pub(super) fn functions() -> impl Iterator<Item = &'static str> {
    let callable = known().iter().filter(|(_, known)| known.kind == ItemKind::Fn && !known.is_generic);
    callable.map(|(name, _)| name.as_str())
}

/// The library's items that a text of these items reaches, as text; empty where it reaches none.
///
/// # Errors
/// Where it names a generic function, or what the text's names hide is needed, and why it cannot.
pub(super) fn reached(text: &str, items: &[Item]) -> Result<String, (Range<usize>, String)> {
    let own: HashSet<&str> = items.iter().map(|item| item.name.as_str()).collect();
    let mut open: Vec<&str> = Vec::new();
    for range in items.iter().flat_map(|item| &item.references) {
        let name = &text[range.clone()];
        match known().get(name).filter(|_| !own.contains(name)) {
            Some(known) if known.is_generic => {
                let message = format!(
                    "the library's `{name}` works on any type, so it has no one name to call; WGSL's own functions do the same, or wire its node before this one"
                );
                return Err((range.clone(), message));
            }
            Some(_) => open.push(name),
            None => {}
        }
    }
    let mut wanted = BTreeSet::new();
    while let Some(name) = open.pop() {
        if let Some(item) = known().get(name)
            && wanted.insert((item.place, item.text))
        {
            for needed in &item.dependencies {
                if let Some(clash) = items.iter().find(|item| item.name == *needed) {
                    let message = format!(
                        "the library has its own `{needed}`, which its `{name}` needs, and that is called here; give yours another name"
                    );
                    return Err((clash.code_start..clash.end, message));
                }
                open.push(needed);
            }
        }
    }
    Ok(wanted.into_iter().map(|(_, text)| format!("{text}\n")).collect())
}
