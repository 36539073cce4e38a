//! The node library: node definitions read from WGSL files. A function whose doc comment says `@node` is a node; its sockets, types,
//! defaults and help come from its signature (read by naga) and its doc comment (`grammar`).
//!
//! All files are parsed as one module, since WGSL knows no imports and the library's names are unique over all files. The
//! `T` of a generic file gets a name of its own there; the module is parsed for two of `T`'s types, and what differs is generic.
//! Nothing is validated beyond naga's parser and no text is kept: the code generator links from the same files.

mod borrowed;
mod complaint;
pub mod custom;
mod explain;
mod grammar;
mod loops;
mod node;
pub(crate) mod own;
mod signature;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, OnceLock};

use halfvector_shaders::{Item, ItemKind, TokenKind, tokens};

use crate::document::{Document, Group};
use crate::node_def::NodeDef;
use crate::value::Type;
pub use signature::CAPABILITIES;
use signature::Signatures;

/// The nodes that a graph can be made of. Cloning is cheap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// The shipped nodes, then those of a document, then those of a group's inside.
    layers: Vec<Arc<BTreeMap<String, NodeDef>>>,
}

/// What is wrong with the files of a library: everything that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LibraryError {
    /// In the order of the files; at least one.
    pub problems: Vec<LibraryProblem>,
}

/// Something wrong in a file of a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LibraryProblem {
    /// Path of the file below the library's root.
    pub file: String,
    /// From 1.
    pub line: usize,
    /// What is wrong and what is wanted.
    pub message: String,
}

impl fmt::Display for LibraryProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.message)
    }
}

impl fmt::Display for LibraryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.problems.iter().map(LibraryProblem::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for LibraryError {}

impl Library {
    /// The nodes of the shader library that this program ships, parsed once.
    pub fn standard() -> &'static Library {
        static STANDARD: OnceLock<Library> = OnceLock::new();
        STANDARD.get_or_init(|| {
            let files: Vec<(&str, &str)> = halfvector_shaders::FILES.iter().map(|f| (f.path, f.source)).collect();
            // The files are embedded and a test parses them: this cannot fail in a build that passed.
            Library::parse(&files).unwrap_or_else(|e| panic!("the embedded shader library is wrong:\n{e}"))
        })
    }

    /// Reads the nodes of WGSL files, given as (path, text). Paths are relative to the library's root; files under `entry/` are templates of
    /// entry points and hold no nodes.
    pub fn parse(files: &[(&str, &str)]) -> Result<Library, LibraryError> {
        let mut problems = Vec::new();
        let sources: Vec<Source> = files
            .iter()
            .filter(|(path, _)| !path.starts_with("entry/"))
            .filter_map(|(path, text)| Source::read(path, text, &mut problems))
            .collect();
        if !problems.is_empty() {
            return Err(LibraryError { problems });
        }
        let signatures = Signatures::read(&sources).map_err(|problem| LibraryError { problems: vec![problem] })?;
        let mut nodes: BTreeMap<String, NodeDef> = BTreeMap::new();
        let mut taken = Vec::new();
        for source in &sources {
            for def in node::read_nodes(source, &signatures, &mut taken, &mut problems) {
                if let Some(first) = nodes.get(&def.id) {
                    let message = format!("the node `{}` stands in {} already", def.id, first.file);
                    problems.push(LibraryProblem { file: source.path.into(), line: 1, message });
                } else {
                    nodes.insert(def.id.clone(), def);
                }
            }
        }
        node::refuse_forgotten(&sources, &taken, &mut problems);
        if problems.is_empty() { Ok(Library { layers: vec![Arc::new(nodes)] }) } else { Err(LibraryError { problems }) }
    }

    /// The node with this id, such as `math/mix`.
    pub fn get(&self, id: &str) -> Option<&NodeDef> {
        self.layers.iter().rev().find_map(|layer| layer.get(id))
    }

    /// All nodes: the shipped ones in order of id, then those of a document.
    pub fn iter(&self) -> impl Iterator<Item = &NodeDef> {
        self.layers.iter().flat_map(|layer| layer.values())
    }

    /// This library with the nodes that a document brings along: its groups, and its functions as far as they are sound. For the document's top level.
    pub fn of(&self, document: &Document) -> Library {
        let functions = document.functions.iter().filter_map(|(id, text)| custom::read_function(id, text).ok());
        let functions = functions.map(|function| function.def.clone());
        self.with(document.groups.iter().map(|(id, group)| own::group(id, group)).chain(functions))
    }

    /// A library that [`Library::of`] gave, with the nodes of a group's inside: [`GROUP_INPUT`](crate::document::GROUP_INPUT) and
    /// [`GROUP_OUTPUT`](crate::document::GROUP_OUTPUT).
    pub fn inside(&self, group: &Group) -> Library {
        self.with(own::inside(group).into_iter())
    }

    /// This library and some nodes more; of equal ids the new one counts.
    pub(crate) fn with(&self, defs: impl Iterator<Item = NodeDef>) -> Library {
        let layer: BTreeMap<String, NodeDef> = defs.map(|def| (def.id.clone(), def)).collect();
        let mut library = self.clone();
        if !layer.is_empty() {
            library.layers.push(Arc::new(layer));
        }
        library
    }
}

/// A file of the library, cut into items.
struct Source<'t> {
    path: &'t str,
    text: &'t str,
    items: Vec<Item>,
    /// The types of `T`; empty for a file that is not generic.
    generic: Vec<Type>,
}

impl<'t> Source<'t> {
    fn read(path: &'t str, text: &'t str, problems: &mut Vec<LibraryProblem>) -> Option<Source<'t>> {
        let before = problems.len();
        let mut problem = |line, message| problems.push(LibraryProblem { file: path.into(), line, message });
        let items = match halfvector_shaders::slice(text) {
            Ok(items) => items,
            Err(e) => {
                problem(e.line, e.to_string());
                return None;
            }
        };
        let generic = match halfvector_shaders::generic_types(text) {
            None => Vec::new(),
            Some(names) => match generic_types(&names) {
                Ok(types) => types,
                Err(message) => {
                    problem(1, message);
                    Vec::new()
                }
            },
        };
        let alias = items.iter().find(|item| item.kind == ItemKind::Alias && item.name == "T");
        match (alias, generic.is_empty()) {
            (None, false) => problem(1, "a generic file needs `alias T = ...;` with one of its types".into()),
            (Some(alias), true) => problem(
                line_of(text, alias.code_start),
                "`alias T` is for generic files; begin the file with `//! T = f32 | vec3f`, or name the alias otherwise".into(),
            ),
            _ => {}
        }
        (problems.len() == before).then_some(Source { path, text, items, generic })
    }

    /// The text with `T` named `name` and standing for `ty`, and without comments that are no docs (naga drops the docs after them).
    /// Lines stay where they are.
    fn with_generic(&self, name: &str, ty: Option<Type>) -> String {
        let mut edits: Vec<(std::ops::Range<usize>, String)> = tokens(self.text)
            .iter()
            .filter(|t| matches!(t.kind, TokenKind::LineComment | TokenKind::BlockComment | TokenKind::ModuleComment))
            .map(|t| (t.start..t.end, "\n".repeat(t.text(self.text).matches('\n').count())))
            .collect();
        if let Some(ty) = ty {
            for item in &self.items {
                if item.kind == ItemKind::Alias && item.name == "T" {
                    edits.push((item.name_range.clone(), name.into()));
                    edits.extend(item.references.iter().map(|range| (range.clone(), ty.wgsl().into())));
                } else {
                    let uses = item.references.iter().filter(|range| &self.text[(*range).clone()] == "T");
                    edits.extend(uses.map(|range| (range.clone(), name.into())));
                }
            }
        }
        edits.sort_by_key(|(range, _)| range.start);
        let mut out = String::with_capacity(self.text.len());
        let mut at = 0;
        for (range, with) in edits {
            out.push_str(&self.text[at..range.start]);
            out.push_str(&with);
            at = range.end;
        }
        out.push_str(&self.text[at..]);
        out
    }
}

/// The types that `T` may be, narrowest first.
fn generic_types(names: &[&str]) -> Result<Vec<Type>, String> {
    let mut types = Vec::new();
    for name in names {
        match Type::from_wgsl(name) {
            Some(ty) if types.contains(&ty) => return Err(format!("`{name}` stands twice in the list of T")),
            Some(ty) => types.push(ty),
            None => return Err(format!("T cannot be `{name}`; it is bool, i32, f32, vec2f, vec3f or vec4f")),
        }
    }
    if types.len() < 2 || !types.is_sorted_by_key(|ty| ty.components()) {
        return Err("T needs two types or more, narrowest first, such as `//! T = f32 | vec3f`".into());
    }
    Ok(types)
}

/// The line, from 1, of a byte of a text.
fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}
