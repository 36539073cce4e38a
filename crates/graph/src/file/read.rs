//! Text to document.

mod graph;
mod group;
mod value;

use serde_json::{Map, Value as Plain};

use super::instance::{Instance, InstanceError, Material};
use super::{FileError, GroupFile, MAX_BYTES};
use crate::FORMAT_VERSION;
use crate::document::{AlphaMode, Document, Parameter, SocketRef, SurfaceSettings};
use crate::json::{self, Json, Member, Spanned};
use graph::GraphReader;
use value::{choice, lines, list, members_of, number, object, pair, socket, socket_value, text, text_of};

pub(super) use graph::link_of_plain;

/// Reads a document. A document that makes no sense is read all the same (see `check`); one that is not in the format is refused, with
/// line, column and field. In a document of a newer version, what cannot be understood is kept instead.
///
/// # Errors
/// An instance is refused, too: its base is found from its file, so [`super::load`] reads it.
pub fn from_json(text: &str) -> Result<Document, FileError> {
    match material_from_json(text)? {
        Material::Whole(document) => Ok(*document),
        Material::Instance(instance) => Err(InstanceError::NoFolder { base: instance.base }.into()),
    }
}

/// Reads a material's file, which may be an instance.
pub(super) fn material_from_json(text: &str) -> Result<Material, FileError> {
    parsed(text, read_material)
}

/// Reads a group's file; as strict as [`from_json`].
pub fn group_from_json(text: &str) -> Result<GroupFile, FileError> {
    parsed(text, read_group_file)
}

/// Most bytes of all of a document's functions together: each is parsed when the document is opened.
const MAX_FUNCTION_BYTES: usize = 256 << 10;

fn parsed<T>(text: &str, read: impl FnOnce(Spanned) -> Result<T, Wrong>) -> Result<T, FileError> {
    if text.len() > MAX_BYTES {
        return Err(FileError::TooLarge);
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let root = json::parse(text).map_err(|e| {
        let (line, column) = json::line_and_column(text, e.at);
        FileError::Syntax { line, column, message: e.message }
    })?;
    read(root).map_err(|e| {
        let (line, column) = json::line_and_column(text, e.at);
        FileError::Shape { line, column, place: e.place, message: e.message }
    })
}

/// A wrong field.
struct Wrong {
    at: usize,
    place: String,
    message: String,
}

fn wrong<T>(at: usize, place: &str, message: impl Into<String>) -> Result<T, Wrong> {
    Err(Wrong { at, place: place.into(), message: message.into() })
}

fn read_material(root: Spanned) -> Result<Material, Wrong> {
    let at = root.at;
    let members = object(root, "the document")?;
    let version = version(&members, at)?;
    if members.iter().any(|member| member.key == "base") {
        return read_instance(members, version > FORMAT_VERSION).map(Material::Instance);
    }
    read_document(members, version, at).map(|document| Material::Whole(Box::new(document)))
}

/// An instance. Of a newer version only what is understood is taken.
fn read_instance(members: Vec<Member>, newer: bool) -> Result<Instance, Wrong> {
    let mut instance = Instance { name: None, base: String::new(), set: Vec::new(), is_newer: newer };
    for Member { at, key, value } in members {
        match key.as_str() {
            "halfvector" => {}
            "name" => instance.name = Some(text(value, "name")?),
            "base" => {
                let at = value.at;
                instance.base = text(value, "base")?;
                if instance.base.is_empty() {
                    return wrong(at, "base", "it names no file; write the way from this file's folder to a material");
                }
            }
            "set" => {
                for Member { key, value, .. } in object(value, "set")? {
                    let set = socket_value(&value, &format!("set.{key}"))?;
                    instance.set.push((key, set));
                }
            }
            _ if newer => {}
            _ => {
                return wrong(
                    at,
                    &key,
                    "an instance has the fields name, base and set; leave this out, or leave out `base` for a material of its own",
                );
            }
        }
    }
    Ok(instance)
}

fn read_document(members: Vec<Member>, version: u32, at: usize) -> Result<Document, Wrong> {
    let mut reader = Reader { newer: version > FORMAT_VERSION, unknown: Map::new() };
    let mut graph = GraphReader::new(reader.newer, String::new());
    let mut document = Document::new("");
    document.version = version;
    let mut nodes_seen = false;
    for Member { key, value, .. } in members {
        match key.as_str() {
            "halfvector" => {}
            "name" => match text(value, "name") {
                Ok(name) => document.name = name,
                Err(e) => return Err(e),
            },
            "parameters" => reader.parameters(&mut document, value)?,
            "surface" => reader.surface(&mut document, value)?,
            "groups" => reader.groups(&mut document, value)?,
            "functions" => reader.functions(&mut document, value)?,
            _ => {
                nodes_seen |= key == "nodes";
                if let Some(value) = graph.section(&key, value)? {
                    reader.unknown.insert(key, value.json.into_plain());
                }
            }
        }
    }
    if !nodes_seen {
        return wrong(
            at,
            "the document",
            "the field `nodes` is missing; is this a material? (a scene is another kind of file; an instance of another material names it as `base`)",
        );
    }
    document.graph = graph.graph;
    document.unknown = reader.unknown;
    Ok(document)
}

fn version(members: &[Member], at: usize) -> Result<u32, Wrong> {
    match members.iter().find(|m| m.key == "halfvector").map(|m| &m.value) {
        None => wrong(
            at,
            "the document",
            "the field `halfvector` with the format's version is missing; \
             write \"halfvector\": 1 first if this is a material",
        ),
        Some(Spanned { json: Json::Number(digits), .. }) if digits.parse::<u32>().is_ok_and(|v| v > 0) => {
            Ok(digits.parse::<u32>().unwrap_or(FORMAT_VERSION))
        }
        Some(other) => wrong(other.at, "halfvector", "the format's version is a whole number from 1 on"),
    }
}

/// A group's file. Of a newer version only what is understood is taken: nothing is written back to it.
fn read_group_file(root: Spanned) -> Result<GroupFile, Wrong> {
    let at = root.at;
    let members = object(root, "the file")?;
    let mut reader = Reader { newer: version(&members, at)? > FORMAT_VERSION, unknown: Map::new() };
    let mut document = Document::new("");
    let mut group = None;
    for Member { key, value, .. } in members {
        match key.as_str() {
            "group" => group = Some(text(value, "group")?),
            "groups" => reader.groups(&mut document, value)?,
            "functions" => reader.functions(&mut document, value)?,
            _ => {}
        }
    }
    match group {
        Some(group) if document.groups.contains_key(&group) => {
            Ok(GroupFile { group, groups: document.groups, functions: document.functions })
        }
        Some(group) => wrong(at, "groups", format!("the group `{group}`, which the file is about, is missing")),
        None => wrong(at, "the file", "the field `group` is missing; it names the group that the file is about"),
    }
}

struct Reader {
    /// Whether the file was written by a newer version: what is not understood is kept.
    newer: bool,
    /// Becomes [`Document::unknown`].
    unknown: Map<String, Plain>,
}

impl Reader {
    fn keep_in_object(&mut self, section: &str, key: String, raw: Plain) {
        let entry = self.unknown.entry(section).or_insert_with(|| Plain::Object(Map::new()));
        if let Plain::Object(map) = entry {
            map.insert(key, raw);
        }
    }

    fn keep_in_list(&mut self, section: &str, raw: Plain) {
        let entry = self.unknown.entry(section).or_insert_with(|| Plain::Array(Vec::new()));
        if let Plain::Array(list) = entry {
            list.push(raw);
        }
    }

    fn parameters(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        for (i, item) in list(value, "parameters")?.into_iter().enumerate() {
            match read_parameter(&item, &format!("parameters[{i}]")) {
                Ok((parameter, extra)) => {
                    document.parameters.push(parameter);
                    if extra {
                        self.keep_in_list("parameters", item.json.into_plain());
                    }
                }
                Err(_) if self.newer => self.keep_in_list("parameters", item.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }

    fn surface(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        let members = match value.json {
            Json::Object(members) => members,
            other if self.newer => {
                self.unknown.insert("surface".into(), other.into_plain());
                return Ok(());
            }
            other => return wrong(value.at, "surface", format!("an object is needed, not {}", other.kind())),
        };
        for Member { key, value, .. } in members {
            match read_surface_field(&mut document.surface, &key, &value) {
                Ok(true) => {}
                Err(e) if !self.newer => return Err(e),
                Ok(false) | Err(_) => self.keep_in_object("surface", key, value.json.into_plain()),
            }
        }
        Ok(())
    }

    fn functions(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        if self.newer && !matches!(value.json, Json::Object(_)) {
            self.unknown.insert("functions".into(), value.json.into_plain());
            return Ok(());
        }
        let at = value.at;
        let mut bytes: usize = document.functions.values().map(String::len).sum();
        for Member { key, value, .. } in object(value, "functions")? {
            match lines(&value, &format!("functions.{key}")) {
                Ok(text) => {
                    bytes += text.len();
                    if bytes > MAX_FUNCTION_BYTES {
                        let most = MAX_FUNCTION_BYTES >> 10;
                        return wrong(
                            at,
                            "functions",
                            format!("together they are longer than {most} KiB; make them shorter"),
                        );
                    }
                    document.functions.insert(key, text);
                }
                Err(_) if self.newer => self.keep_in_object("functions", key, value.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }

    fn groups(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        if self.newer && !matches!(value.json, Json::Object(_)) {
            self.unknown.insert("groups".into(), value.json.into_plain());
            return Ok(());
        }
        for Member { key, value, .. } in object(value, "groups")? {
            // Of a newer version's group that is not understood nothing is lost.
            let kept = if self.newer { Some(value.json.clone().into_plain()) } else { None };
            match (group::read(value, &format!("groups.{key}"), self.newer), kept) {
                (Ok(group), _) => {
                    document.groups.insert(key, group);
                }
                (Err(_), Some(raw)) => self.keep_in_object("groups", key, raw),
                (Err(e), None) => return Err(e),
            }
        }
        Ok(())
    }
}

/// A parameter, and whether the object has further fields.
fn read_parameter(value: &Spanned, place: &str) -> Result<(Parameter, bool), Wrong> {
    let (mut name, mut input, mut label, mut range, mut extra) = (None, None, None, None, false);
    for Member { key, value, .. } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "name" => name = Some(text_of(value, place)?.to_string()),
            "socket" => input = Some(socket(value, place)?),
            "label" => label = Some(text_of(value, place)?.to_string()),
            "range" => range = Some(pair(value, place)?),
            _ => extra = true,
        }
    }
    match (name, input) {
        (Some(name), Some(socket)) => Ok((Parameter { name, label, socket, range }, extra)),
        (None, _) => wrong(value.at, place, "the parameter's field `name` is missing"),
        (_, None) => wrong(value.at, place, "the parameter's field `socket` is missing: the input, as \"node.socket\""),
    }
}

fn boolean(value: &Spanned, place: &str) -> Result<bool, Wrong> {
    match value.json {
        Json::Bool(b) => Ok(b),
        _ => wrong(value.at, place, format!("true or false is needed, not {}", value.json.kind())),
    }
}

/// Reads a field of the surface settings; false when there is no such field.
fn read_surface_field(surface: &mut SurfaceSettings, key: &str, value: &Spanned) -> Result<bool, Wrong> {
    let place = &format!("surface.{key}");
    match key {
        "alpha_mode" => {
            let modes = [("opaque", AlphaMode::Opaque), ("mask", AlphaMode::Mask), ("blend", AlphaMode::Blend)];
            surface.alpha_mode = choice(value, place, &modes)?;
        }
        "alpha_cutoff" => surface.alpha_cutoff = number(value, place)?,
        "double_sided" => surface.double_sided = boolean(value, place)?,
        "thin_walled" => surface.thin_walled = boolean(value, place)?,
        _ => return Ok(false),
    }
    Ok(true)
}

/// Name and socket of the parameter that a kept object stands for; none when it was not understood.
pub(super) fn parameter_key_of_plain(raw: &Plain) -> Option<(String, SocketRef)> {
    let spanned = json::parse(&raw.to_string()).ok()?;
    read_parameter(&spanned, "").ok().map(|(parameter, _)| (parameter.name, parameter.socket))
}
