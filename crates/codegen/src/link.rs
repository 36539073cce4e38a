//! The linker: which items of the library a shader reaches, and their text in it. Items are whole; names are exchanged
//! only for generic nodes (`T`, and a suffix) and for the methods of a term.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::{Arc, Mutex, OnceLock};

use halfvector_graph::document::{Document, function_of};
use halfvector_graph::library::custom::read_function;
use halfvector_graph::method::Methods;
use halfvector_graph::value::Type;
use halfvector_shaders::{Item, ItemKind, SliceError, TokenKind, emit, generic_types, slice, tokens};

use crate::blend;
use crate::cost::{Instructions, of_function};
use crate::passes::eval;
use crate::passes::idle::{Effects, effects};
use crate::passes::reduce::{Reduced, reduce};
use crate::unread::without_unread;

/// Functions of the vertex stage that entry points call; the other files of `entry/` are whole shaders.
const TRANSFORM_FILE: &str = "entry/transform.wgsl";

/// Terms whose methods are functions of one signature: the linker exchanges the names. The other terms are chosen where
/// the shading is put together.
const EXCHANGED_TERMS: [&str; 5] = ["d", "v", "fresnel", "diffuse", "normal_decode"];

/// Functions that follow a chosen method: what writes the texels of a normal map has to be what reads them.
const FOLLOWERS: [(&str, &str, &str); 3] = [
    ("normal_from_texel_snorm", "texel_from_normal", "texel_from_normal_snorm"),
    ("normal_from_texel_snorm", "tilt_from_texel", "normal_from_texel_snorm"),
    ("normal_from_texel_two_channel", "tilt_from_texel", "normal_from_texel_two_channel"),
];

/// The items of a library by name, and what was found out about them.
pub(crate) struct Index {
    files: Vec<SourceFile>,
    items: Vec<IndexItem>,
    by_name: HashMap<String, usize>,
    /// By function of the document: places of the parameters that it was written with and does without here.
    unread: HashMap<String, Vec<usize>>,
    /// By function that reads pictures: its twin that blends their texels by arithmetic.
    blended: HashMap<String, String>,
    compiled: Mutex<HashMap<Instance, Option<Arc<Compiled>>>>,
}

#[derive(Clone)]
struct SourceFile {
    path: Cow<'static, str>,
    source: Cow<'static, str>,
    generic: bool,
}

#[derive(Clone)]
struct IndexItem {
    file: usize,
    item: Item,
    inline: Option<Inline>,
}

/// An item, with what `T` is when its file is generic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Instance {
    item: usize,
    generic: Option<Type>,
}

/// The expression of a function that is nothing but one built-in expression.
#[derive(Clone, Debug)]
pub(crate) struct Inline {
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug)]
enum Piece {
    Text(String),
    Parameter(usize),
    Generic,
}

/// A function that naga has read, for folding.
pub(crate) struct Compiled {
    callable: Option<eval::Callable>,
    /// What it does, with what it calls.
    pub(crate) cost: Instructions,
    /// The function and what it calls.
    module: naga::Module,
    function: naga::Handle<naga::Function>,
    /// Member names of the returned struct; empty for a plain value.
    pub(crate) members: Vec<String>,
}

impl Compiled {
    pub(crate) fn evaluate(&self, arguments: &[eval::Number]) -> Option<eval::Value> {
        self.callable.as_ref()?.call(arguments)
    }

    /// What of its arguments has an effect on what it gives.
    pub(crate) fn effects(&self) -> Effects {
        effects(&self.module, self.function)
    }

    /// What it gives where some of its arguments are known.
    pub(crate) fn reduced(&self, known: &[Option<Vec<f32>>]) -> Option<Reduced> {
        reduce(&self.module, &self.module.functions[self.function], known)
    }
}

/// An item in the shader.
pub(crate) struct Linked<'i> {
    pub(crate) path: &'i str,
    pub(crate) text: String,
}

/// What stands for what: the default's function of a term, and the chosen method's; and what follows from it.
pub(crate) fn exchanged(methods: &Methods) -> BTreeMap<&'static str, &'static str> {
    let mut exchanged: BTreeMap<_, _> = EXCHANGED_TERMS
        .iter()
        .filter_map(|name| {
            let default = halfvector_graph::method::term(name)?.methods.first()?.function?;
            let chosen = methods.get(name).function?;
            (default != chosen).then_some((default, chosen))
        })
        .collect();
    for (method, default, follower) in FOLLOWERS {
        if exchanged.values().any(|chosen| *chosen == method) {
            exchanged.insert(default, follower);
        }
    }
    exchanged
}

impl Clone for Index {
    fn clone(&self) -> Index {
        let compiled = self.compiled.lock().map(|compiled| compiled.clone()).unwrap_or_default();
        Index {
            files: self.files.clone(),
            items: self.items.clone(),
            by_name: self.by_name.clone(),
            unread: self.unread.clone(),
            blended: self.blended.clone(),
            compiled: Mutex::new(compiled),
        }
    }
}

impl Index {
    /// The index of the shader library's files, made once.
    pub(crate) fn standard() -> &'static Index {
        static STANDARD: OnceLock<Index> = OnceLock::new();
        STANDARD.get_or_init(|| {
            // The files are embedded and tests slice them: this cannot fail in a build that passed.
            Index::new(halfvector_shaders::FILES)
                .unwrap_or_else(|e| panic!("the embedded shader library is wrong: {e}"))
        })
    }

    fn new(files: &[halfvector_shaders::File]) -> Result<Index, SliceError> {
        let mut index = Index {
            files: Vec::new(),
            items: Vec::new(),
            by_name: HashMap::new(),
            unread: HashMap::new(),
            blended: HashMap::new(),
            compiled: Mutex::new(HashMap::new()),
        };
        let files = || files.iter().filter(|f| !f.path.starts_with("entry/") || f.path == TRANSFORM_FILE);
        // An environment has no slope that anybody asks for.
        for file in files().filter(|f| f.path != blend::FILE && !f.path.starts_with("ibl/")) {
            index.blended.extend(blend::twins(file.source)?);
        }
        for file in files() {
            let source = blend::with_twins(file.source, &index.blended)?;
            index.add(file.path.into(), source)?;
        }
        index.inline(0);
        Ok(index)
    }

    /// The library's index with the functions that a document brings along and has nodes of, where it has any.
    pub(crate) fn of(document: &Document) -> Cow<'static, Index> {
        let used: BTreeSet<&str> = document.graph.nodes.values().filter_map(|node| function_of(&node.node)).collect();
        let texts = used.into_iter().filter_map(|id| Some((id, document.functions.get(id)?)));
        // What is wrong with them is told by the document's check, which comes first.
        let sound: Vec<_> = texts.filter_map(|(id, text)| Some((id, read_function(id, text).ok()?))).collect();
        let standard = Index::standard();
        if sound.is_empty() {
            return Cow::Borrowed(standard);
        }
        let mut index = standard.clone();
        let first = index.items.len();
        for (id, function) in sound {
            let name = &function.def.function.name;
            let (source, unread) = without_unread(&function.source, name);
            // Checked before, as all that a document brings: there is no error here.
            let Ok(twins) = blend::twins(&source) else { break };
            index.unread.extend(twins.get(name).map(|twin| (twin.clone(), unread.clone())));
            index.unread.insert(name.clone(), unread);
            index.blended.extend(twins);
            let Ok(source) = blend::with_twins(&source, &index.blended) else { break };
            if index.add(format!("custom/{id}").into(), source.into_owned().into()).is_err() {
                break;
            }
        }
        index.inline(first);
        Cow::Owned(index)
    }

    fn add(&mut self, path: Cow<'static, str>, source: Cow<'static, str>) -> Result<(), SliceError> {
        let generic = generic_types(&source).is_some();
        for item in slice(&source)? {
            // `alias T` stands for the type only while the library file is read by itself.
            if generic && item.kind == ItemKind::Alias && item.name == "T" {
                continue;
            }
            self.by_name.insert(item.name.clone(), self.items.len());
            self.items.push(IndexItem { file: self.files.len(), item, inline: None });
        }
        self.files.push(SourceFile { path, source, generic });
        Ok(())
    }

    /// Recognises the functions, from a number on, that are one expression.
    fn inline(&mut self, first: usize) {
        for number in first..self.items.len() {
            self.items[number].inline = self.inline_of(number);
        }
    }

    /// Whether the library has an item of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.by_name.contains_key(name)
    }

    /// The name of a function of the library as the library has it; none of one that a document brings along.
    pub(crate) fn name_in_library(name: &str) -> Option<&'static str> {
        let standard = Index::standard();
        let (name, number) = standard.by_name.get_key_value(name)?;
        (standard.items[*number].item.kind == ItemKind::Fn).then_some(name.as_str())
    }

    /// The twin of a function that blends texels by arithmetic; none of one that reads no picture.
    pub(crate) fn blended(&self, function: &str) -> Option<&str> {
        self.blended.get(function).map(String::as_str)
    }

    /// Places of the arguments that a function is not given, though its node has inputs for them: it does not read them.
    pub(crate) fn unread(&self, function: &str) -> &[usize] {
        self.unread.get(function).map_or(&[], Vec::as_slice)
    }

    /// Whether a function is one that the document brings along.
    pub(crate) fn is_of_document(&self, function: &str) -> bool {
        self.unread.contains_key(function)
    }

    /// A function by its name in the library.
    pub(crate) fn instance(&self, name: &str, generic: Option<Type>) -> Option<Instance> {
        let item = *self.by_name.get(name)?;
        let generic = if self.files[self.items[item].file].generic { generic } else { None };
        Some(Instance { item, generic })
    }

    /// An item's name in the shader.
    pub(crate) fn name(&self, instance: Instance) -> String {
        let name = &self.items[instance.item].item.name;
        match instance.generic {
            Some(ty) => format!("{name}_{}", ty.wgsl()),
            None => name.clone(),
        }
    }

    /// The expression of a function that is one built-in expression, with `arguments` in the place of its parameters.
    pub(crate) fn inlined(&self, instance: Instance, arguments: &[String]) -> Option<String> {
        let inline = self.items[instance.item].inline.as_ref()?;
        let mut text = String::new();
        for piece in &inline.pieces {
            match piece {
                Piece::Text(piece) => text.push_str(piece),
                Piece::Generic => text.push_str(instance.generic?.wgsl()),
                Piece::Parameter(index) => {
                    let argument = arguments.get(*index)?;
                    if argument.starts_with('-') {
                        text.push('(');
                        text.push_str(argument);
                        text.push(')');
                    } else {
                        text.push_str(argument);
                    }
                }
            }
        }
        Some(text)
    }

    /// All that `roots` reach, in order of files and items.
    pub(crate) fn reach(&self, roots: &BTreeSet<Instance>, exchanged: &BTreeMap<&str, &str>) -> BTreeSet<Instance> {
        let mut reached = roots.clone();
        let mut open: Vec<Instance> = roots.iter().copied().collect();
        while let Some(instance) = open.pop() {
            let this = &self.items[instance.item];
            for name in &this.item.dependencies {
                let name = exchanged.get(name.as_str()).copied().unwrap_or(name);
                let Some(&item) = self.by_name.get(name) else { continue };
                let generic = if self.items[item].file == this.file { instance.generic } else { None };
                let next = Instance { item, generic };
                if reached.insert(next) {
                    open.push(next);
                }
            }
        }
        reached
    }

    /// The text of an item in the shader, its doc comments turned into plain ones.
    pub(crate) fn text(&self, instance: Instance, exchanged: &BTreeMap<&str, &str>) -> Linked<'_> {
        let this = &self.items[instance.item];
        let file = &self.files[this.file];
        let text = emit(&file.source, &this.item, |name| {
            if let Some(generic) = instance.generic {
                if name == "T" {
                    return Some(generic.wgsl().to_owned());
                }
                if let Some(&item) = self.by_name.get(name)
                    && self.items[item].file == this.file
                {
                    return Some(format!("{name}_{}", generic.wgsl()));
                }
            }
            exchanged.get(name).map(|n| (*n).to_owned())
        });
        Linked { path: &file.path, text }
    }

    /// A function as naga reads it, for folding; `None` when naga does not take it by itself. Kept for the next time.
    pub(crate) fn compiled(&self, instance: Instance) -> Option<Arc<Compiled>> {
        let known = self.compiled.lock().ok().and_then(|cache| cache.get(&instance).cloned());
        if let Some(known) = known {
            return known;
        }
        let compiled = self.compile(instance).map(Arc::new);
        if let Ok(mut cache) = self.compiled.lock() {
            cache.insert(instance, compiled.clone());
        }
        compiled
    }

    fn compile(&self, instance: Instance) -> Option<Compiled> {
        let none = BTreeMap::new();
        let mut source = String::new();
        for part in self.reach(&BTreeSet::from([instance]), &none) {
            source.push_str(&self.text(part, &none).text);
            source.push('\n');
        }
        let module = naga::front::wgsl::parse_str(&source).ok()?;
        let name = self.name(instance);
        let (handle, body) = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(&name))?;
        let members = match body.result.as_ref().map(|r| &module.types[r.ty].inner) {
            Some(naga::TypeInner::Struct { members, .. }) => {
                members.iter().map(|m| m.name.clone().unwrap_or_default()).collect()
            }
            _ => Vec::new(),
        };
        let callable = eval::Callable::new(&module, body);
        Some(Compiled { members, callable, cost: of_function(&module, handle), function: handle, module })
    }

    /// Recognises `fn f(a: A, b: B) -> C { return <expression>; }` whose expression names nothing of the library.
    fn inline_of(&self, number: usize) -> Option<Inline> {
        /// Longer expressions read better as a function.
        const MAX_TOKENS: usize = 12;
        let IndexItem { file, item, .. } = &self.items[number];
        if item.kind != ItemKind::Fn {
            return None;
        }
        let source = &self.files[*file].source[item.code_start..item.end];
        let all: Vec<_> = tokens(source).into_iter().filter(|t| !t.kind.is_comment()).collect();
        let text = |index: usize| all.get(index).map_or("", |t| t.text(source));
        let open = (0..all.len()).find(|&i| text(i) == "{")?;
        if text(open + 1) != "return" {
            return None;
        }
        let end = (open + 2..all.len()).find(|&i| text(i) == ";")?;
        if text(end + 1) != "}" || end + 2 != all.len() || end - open > MAX_TOKENS + 2 {
            return None;
        }
        let header = (0..open).find(|&i| text(i) == "(")?;
        let parameters: Vec<&str> =
            (header + 1..open).filter(|&i| text(i + 1) == ":" && text(i) != ":").map(text).collect();
        let mut pieces = vec![Piece::Text(String::new())];
        let mut before = all[open + 2].start;
        for (index, token) in all.iter().enumerate().take(end).skip(open + 2) {
            let word = token.text(source);
            let gap = &source[before..token.start];
            before = token.end;
            if gap.contains('\n') || gap.contains("/*") {
                return None;
            }
            pieces.push(Piece::Text(gap.to_owned()));
            let is_name = token.kind == TokenKind::Identifier && text(index - 1) != ".";
            pieces.push(match parameters.iter().position(|p| *p == word) {
                Some(parameter) if is_name => Piece::Parameter(parameter),
                _ if is_name && word == "T" && self.files[*file].generic => Piece::Generic,
                _ if is_name && self.by_name.contains_key(word) => return None,
                _ => Piece::Text(word.to_owned()),
            });
        }
        Some(Inline { pieces })
    }
}
