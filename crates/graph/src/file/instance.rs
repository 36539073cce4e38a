//! Instances: a material's file that names another one and the parameters in which it differs. What is read of it is the
//! whole document with these values set; images of the other file keep their places. What a value may be is what the other
//! material offers: its type, and the range where the parameter states one.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::read::material_from_json;
use super::{FileError, Loaded, load_as};
use crate::check::{MAX_PARAMETERS, words};
use crate::document::{Document, Graph, SocketRef};
use crate::library::Library;
use crate::resolve::resolve_types;
use crate::value::{SocketType, Value};

/// Most instances of instances.
pub const MAX_INSTANCE_DEPTH: usize = 32;
/// Largest file of an instance, in bytes: it holds numbers by name.
const MAX_INSTANCE_BYTES: usize = 256 << 10;
/// Most names of parameters that are told.
const MAX_NAMES: usize = 32;

/// A material's file: the material, or an instance of another one.
#[derive(Debug)]
pub(super) enum Material {
    Whole(Box<Document>),
    Instance(Instance),
}

/// An instance as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Of the format.
    pub version: u32,
    /// The other material's name when absent.
    pub name: Option<String>,
    /// The other material's file, from this one's folder.
    pub base: String,
    /// Parameters by name, in the order of the file.
    pub set: Vec<(String, Value)>,
    /// Fields of a newer version.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

impl Instance {
    /// The instance that stands for `now`: this one, which was read as `read`, with the values and the name of `now`. `None`
    /// when they differ in more than an instance can hold. Where things lie on the canvas makes no difference: an instance has
    /// no canvas of its own.
    pub fn changed(&self, read: &Document, now: &Document) -> Option<Instance> {
        let (mut instance, mut reached) = (self.clone(), read.clone());
        if now.name != read.name {
            instance.name = Some(now.name.clone());
            reached.name.clone_from(&now.name);
        }
        for parameter in &read.parameters {
            let socket = &parameter.socket;
            let Some(value) = now.graph.value(socket).filter(|value| read.graph.value(socket) != Some(value)) else {
                continue;
            };
            match instance.set.iter_mut().find(|(name, _)| *name == parameter.name) {
                Some((_, set)) => *set = value.clone(),
                None => instance.set.push((parameter.name.clone(), value.clone())),
            }
            let node = reached.graph.nodes.get_mut(&socket.node)?;
            node.values.insert(socket.socket.clone(), value.clone());
        }
        (off_canvas(reached) == off_canvas(now.clone())).then_some(instance)
    }
}

/// The document without what only says where things lie.
fn off_canvas(mut document: Document) -> Document {
    let graphs = document.groups.values_mut().map(|group| &mut group.graph).chain([&mut document.graph]);
    for Graph { layout, frames, comments, .. } in graphs {
        layout.clear();
        frames.clear();
        comments.clear();
    }
    document
}

/// Why an instance was not read.
#[derive(Debug, thiserror::Error)]
pub enum InstanceError {
    /// An instance is read from a file, for its base is found from there.
    #[error("this is an instance of `{base}`, which is found from its file's folder; open the file, or the base")]
    NoFolder {
        /// As written.
        base: String,
    },
    /// The base was not read.
    #[error("its base: {source}; `base` is the way from this file's folder to the material that it is an instance of")]
    Base {
        /// Why, with the file's name.
        source: Box<FileError>,
    },
    /// Instances of each other.
    #[error("it is an instance of itself, by way of {}; one of them needs a base that is a whole material", files.join(" -> "))]
    Cycle {
        /// The files, from this one to this one.
        files: Vec<String>,
    },
    /// The file is large.
    #[error("it is larger than {} KiB, too large for an instance, which only sets parameters", MAX_INSTANCE_BYTES >> 10)]
    TooLarge,
    /// A long row of instances.
    #[error("more than {MAX_INSTANCE_DEPTH} instances are based on each other; give it the whole material as base")]
    TooDeep,
    /// No such parameter.
    #[error("at set.{name}: the base offers no parameter of this name; {known}")]
    Unknown {
        /// As written.
        name: String,
        /// What there is.
        known: String,
    },
    /// The parameter's input is not there.
    #[error(
        "at set.{name}: in the base this parameter stands for `{socket}`, which is no input there; correct the base"
    )]
    NoSocket {
        /// As written.
        name: String,
        /// The input.
        socket: String,
    },
    /// A value of another type.
    #[error("at set.{name}: the value is {given}, but a {wanted} is wanted: write {example}")]
    Type {
        /// As written.
        name: String,
        /// What the value is.
        given: String,
        /// The type of the input.
        wanted: String,
        /// How to write it.
        example: String,
    },
    /// A value that the base does not offer.
    #[error("at set.{name}: {given} is out of the range that the base offers, {low} to {high}")]
    Range {
        /// As written.
        name: String,
        /// The component that is.
        given: f32,
        /// The least.
        low: f32,
        /// The greatest.
        high: f32,
    },
}

/// Reads a material, or an instance with all that it is based on.
pub(super) fn load(path: &Path) -> Result<Loaded, FileError> {
    let (material, bytes) = load_as(path, material_from_json)?;
    let instance = match material {
        Material::Whole(document) => return Ok(Loaded { document: *document, bytes, instance: None }),
        Material::Instance(instance) => instance,
    };
    let in_file = |path: &Path, why: InstanceError| FileError::InFile {
        path: path.into(),
        source: Box::new(FileError::Instance(why)),
    };
    let base_of = |path: &Path, instance: &Instance| path.parent().unwrap_or(Path::new("")).join(&instance.base);
    if bytes.len() > MAX_INSTANCE_BYTES {
        return Err(in_file(path, InstanceError::TooLarge));
    }
    // From the file that was asked for to the one that is a whole material.
    let mut seen = HashSet::from([real(path)]);
    let mut next = base_of(path, &instance);
    let asked = instance.clone();
    let mut chain = vec![(path.to_path_buf(), instance)];
    let mut document = loop {
        let (user, _) = &chain[chain.len() - 1];
        if !seen.insert(real(&next)) {
            let files = chain.iter().map(|(path, _)| path).chain([&next]).map(|path| path.display().to_string());
            return Err(in_file(path, InstanceError::Cycle { files: files.collect() }));
        }
        if chain.len() >= MAX_INSTANCE_DEPTH {
            return Err(in_file(path, InstanceError::TooDeep));
        }
        let (material, bytes) = stored(&next)
            .and_then(|()| load_as(&next, material_from_json))
            .map_err(|source| in_file(user, InstanceError::Base { source: Box::new(source) }))?;
        match material {
            Material::Whole(document) => break *document,
            Material::Instance(_) if bytes.len() > MAX_INSTANCE_BYTES => {
                return Err(in_file(&next, InstanceError::TooLarge));
            }
            Material::Instance(instance) => {
                let base = base_of(&next, &instance);
                chain.push((next, instance));
                next = base;
            }
        }
    };
    join(&mut document, chain, in_file)?;
    Ok(Loaded { document, bytes, instance: Some(asked) })
}

/// Makes of a whole material what a row of instances, the outermost first, stands for. What an outer one says counts.
fn join(
    document: &mut Document,
    chain: Vec<(PathBuf, Instance)>,
    in_file: impl Fn(&Path, InstanceError) -> FileError,
) -> Result<(), FileError> {
    let offers = offers(document);
    let mut values: HashMap<SocketRef, Value> = HashMap::new();
    let (mut name, mut unknown) = (None, serde_json::Map::new());
    // The way from the outermost file's folder to that of the file at hand.
    let mut way: Option<String> = None;
    for (path, instance) in chain {
        document.version = document.version.max(instance.version);
        name = name.or(instance.name);
        for (key, value) in instance.unknown {
            unknown.entry(key).or_insert(value);
        }
        for (name, value) in instance.set {
            let (socket, mut value) = fitting(&offers, document, name, value).map_err(|why| in_file(&path, why))?;
            move_image(&mut value, way.as_deref());
            values.entry(socket).or_insert(value);
        }
        if let Some((folder, _)) = instance.base.rsplit_once(['/', '\\']) {
            way = Some(
                way.filter(|_| !is_absolute(&instance.base))
                    .map_or(folder.to_string(), |way| format!("{way}/{folder}")),
            );
        }
    }
    let graphs = document.groups.values_mut().map(|group| &mut group.graph).chain([&mut document.graph]);
    let nodes = graphs.flat_map(|graph: &mut Graph| graph.nodes.values_mut());
    nodes.flat_map(|node| node.values.values_mut()).for_each(|value| move_image(value, way.as_deref()));
    for (socket, value) in values {
        if let Some(node) = document.graph.nodes.get_mut(&socket.node) {
            node.values.insert(socket.socket, value);
        }
    }
    document.name = name.unwrap_or(std::mem::take(&mut document.name));
    document.unknown.extend(unknown);
    Ok(())
}

/// Refuses what need not end, such as a pipe: nobody chose it but the file.
fn stored(path: &Path) -> Result<(), FileError> {
    let refused = |source| FileError::Read { path: path.into(), source };
    let about = fs::metadata(path).map_err(refused)?;
    if about.is_file() { Ok(()) } else { Err(refused(io::Error::other("it is no file that is stored"))) }
}

/// A file by which it is known again; as it is written where it is not there.
fn real(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.into())
}

/// Names a picture from the folder that `way` starts from, where it was named from the one that it leads to.
fn move_image(value: &mut Value, way: Option<&str>) {
    if let (Value::Image(image), Some(way)) = (value, way)
        && !image.file.is_empty()
        && !is_absolute(&image.file)
    {
        image.file = format!("{way}/{}", image.file);
    }
}

fn is_absolute(file: &str) -> bool {
    file.starts_with(['/', '\\']) || file.as_bytes().get(1) == Some(&b':')
}

/// What a parameter of the base takes.
struct Offer {
    socket: SocketRef,
    range: Option<[f32; 2]>,
    /// None when the input is not there.
    ty: Option<SocketType>,
}

/// The parameters of a material by name; of equal names the first. A value that fits leaves all types as they are, so they hold
/// for instances of instances, too.
fn offers(document: &Document) -> HashMap<String, Offer> {
    let library = Library::standard().of(document);
    let types = resolve_types(&document.graph, &library);
    let mut offers = HashMap::new();
    for parameter in &document.parameters {
        let socket = &parameter.socket;
        let ty = types.get(&socket.node).and_then(|types| types.input(&socket.socket));
        let offer = Offer { socket: socket.clone(), range: parameter.range, ty };
        offers.entry(parameter.name.clone()).or_insert(offer);
    }
    offers
}

/// The input that a parameter stands for, and the value if it may have it.
fn fitting(
    offers: &HashMap<String, Offer>,
    document: &Document,
    name: String,
    value: Value,
) -> Result<(SocketRef, Value), InstanceError> {
    let Some(Offer { socket, range, ty }) = offers.get(&name) else { return Err(unknown(document, name)) };
    let Some(ty) = *ty else { return Err(InstanceError::NoSocket { name, socket: socket.to_string() }) };
    let numbers = match (ty, &value) {
        (SocketType::Texture, Value::Image(_)) => Some(Vec::new()),
        (SocketType::Value(ty), value) => value.components_as(ty).filter(|c| c.iter().all(|x| x.is_finite())),
        _ => None,
    };
    let Some(numbers) = numbers else {
        let (wanted, example) = (words::socket_type(ty).into(), words::example(ty).into());
        return Err(InstanceError::Type { name, given: words::value(&value), wanted, example });
    };
    if let Some([low, high]) = *range
        && let Some(given) = numbers.into_iter().find(|x| !(low..=high).contains(x))
    {
        return Err(InstanceError::Range { name, given, low, high });
    }
    Ok((socket.clone(), value))
}

fn unknown(document: &Document, name: String) -> InstanceError {
    let names = || document.parameters.iter().take(MAX_PARAMETERS).map(|parameter| parameter.name.as_str());
    let known = match words::nearest(&name, names()) {
        Some(likely) => format!("did you mean `{likely}`?"),
        None if document.parameters.is_empty() => "it offers none: make inputs of it parameters first".into(),
        None => {
            let told: Vec<&str> = names().take(MAX_NAMES).collect();
            let more = document.parameters.len() - told.len();
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            format!("it offers {}{more}", told.join(", "))
        }
    };
    InstanceError::Unknown { name, known }
}
