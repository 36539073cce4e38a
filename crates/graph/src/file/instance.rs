//! Instances: a material's file that names another one and the parameters in which it differs. What is read of it is the
//! whole document with these values set; images of the other file keep their places. What a value may be is what the other
//! material offers: its type, and the range where the parameter states one.

use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::read::material_from_json;
use super::{FileError, Loaded, load_as};
use crate::check::words;
use crate::document::{Document, Graph};
use crate::library::Library;
use crate::resolve::resolve_types;
use crate::value::{SocketType, Value};

/// Most instances of instances.
pub const MAX_INSTANCE_DEPTH: usize = 32;

/// A material's file: the material, or an instance of another one.
#[derive(Debug)]
pub(super) enum Material {
    Whole(Box<Document>),
    Instance(Instance),
}

/// An instance as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The other material's name when absent.
    pub name: Option<String>,
    /// The other material's file, from this one's folder.
    pub base: String,
    /// Parameters by name, in the order of the file.
    pub set: Vec<(String, Value)>,
    /// Whether the file is of a newer version: it may say more, which would be lost if it were written.
    pub is_newer: bool,
}

impl Instance {
    /// The instance that stands for `now`: this one, which was read as `read`, with the values and the name of `now`. `None`
    /// when they differ in more than an instance can hold, or when this one is of a newer version. Where things lie on the
    /// canvas makes no difference: an instance has no canvas of its own.
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
        (!self.is_newer && off_canvas(reached) == off_canvas(now.clone())).then_some(instance)
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
    #[error("it is an instance of itself, by way of {}; one of them needs a base that is a whole material", files.join(" \u{2192} "))]
    Cycle {
        /// The files, from this one to this one.
        files: Vec<String>,
    },
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
        let (material, _) = stored(&next)
            .and_then(|()| load_as(&next, material_from_json))
            .map_err(|source| in_file(user, InstanceError::Base { source: Box::new(source) }))?;
        match material {
            Material::Whole(document) => break *document,
            Material::Instance(instance) => {
                let base = base_of(&next, &instance);
                chain.push((next, instance));
                next = base;
            }
        }
    };
    for (path, instance) in chain.into_iter().rev() {
        rebase(&mut document, &instance.base);
        set(&mut document, instance).map_err(|why| in_file(&path, why))?;
    }
    Ok(Loaded { document, bytes, instance: Some(asked) })
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

/// Images that are named from the base's folder, named from the instance's.
fn rebase(document: &mut Document, base: &str) {
    let Some((folder, _)) = base.rsplit_once(['/', '\\']) else { return };
    let graphs = document.groups.values_mut().map(|group| &mut group.graph).chain([&mut document.graph]);
    let values =
        graphs.flat_map(|graph: &mut Graph| graph.nodes.values_mut()).flat_map(|node| node.values.values_mut());
    for value in values {
        if let Value::Image(image) = value {
            let is_absolute = image.file.starts_with(['/', '\\']) || image.file.as_bytes().get(1) == Some(&b':');
            if !image.file.is_empty() && !is_absolute {
                image.file = format!("{folder}/{}", image.file);
            }
        }
    }
}

/// Sets what an instance changes.
fn set(document: &mut Document, instance: Instance) -> Result<(), InstanceError> {
    if let Some(name) = instance.name {
        document.name = name;
    }
    let library = Library::standard().of(document);
    // A value that fits leaves all types as they are.
    let types = resolve_types(&document.graph, &library);
    let mut fitting = Vec::with_capacity(instance.set.len());
    for (name, value) in instance.set {
        let Some(parameter) = document.parameters.iter().find(|parameter| parameter.name == name) else {
            return Err(unknown(document, name));
        };
        let (socket, range) = (parameter.socket.clone(), parameter.range);
        let Some(ty) = types.get(&socket.node).and_then(|types| types.input(&socket.socket)) else {
            return Err(InstanceError::NoSocket { name, socket: socket.to_string() });
        };
        let numbers = match (ty, &value) {
            (SocketType::Texture, Value::Image(_)) => Some(Vec::new()),
            (SocketType::Value(ty), value) => value.components_as(ty).filter(|c| c.iter().all(|x| x.is_finite())),
            _ => None,
        };
        let Some(numbers) = numbers else {
            let (wanted, example) = (words::socket_type(ty).into(), words::example(ty).into());
            return Err(InstanceError::Type { name, given: words::value(&value), wanted, example });
        };
        if let Some([low, high]) = range
            && let Some(given) = numbers.into_iter().find(|x| !(low..=high).contains(x))
        {
            return Err(InstanceError::Range { name, given, low, high });
        }
        fitting.push((socket, value));
    }
    for (socket, value) in fitting {
        if let Some(node) = document.graph.nodes.get_mut(&socket.node) {
            node.values.insert(socket.socket, value);
        }
    }
    Ok(())
}

fn unknown(document: &Document, name: String) -> InstanceError {
    let names: Vec<&str> = document.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let known = match words::nearest(&name, names.iter().copied()) {
        Some(likely) => format!("did you mean `{likely}`?"),
        None if names.is_empty() => "it offers none: make inputs of it parameters first".into(),
        None => format!("it offers {}", names.join(", ")),
    };
    InstanceError::Unknown { name, known }
}
