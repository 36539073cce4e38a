//! Text to document.

use serde_json::{Map, Value as Plain};

use super::{FileError, MAX_BYTES};
use crate::FORMAT_VERSION;
use crate::document::{AlphaMode, Document, Link, Node, Parameter, SocketRef, SurfaceSettings};
use crate::json::{self, Json, Member, Spanned};
use crate::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

/// Reads a document. A document that makes no sense is read all the same (see `check`); one that is not in the format is refused, with
/// line, column and field. In a document of a newer version, what cannot be understood is kept instead.
pub fn from_json(text: &str) -> Result<Document, FileError> {
    if text.len() > MAX_BYTES {
        return Err(FileError::TooLarge);
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let root = json::parse(text).map_err(|e| {
        let (line, column) = json::line_and_column(text, e.at);
        FileError::Syntax { line, column, message: e.message }
    })?;
    read_document(root).map_err(|e| {
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

fn read_document(root: Spanned) -> Result<Document, Wrong> {
    let at = root.at;
    let members = object(root, "the document")?;
    let version = match members.iter().find(|m| m.key == "halfvector").map(|m| &m.value) {
        None => {
            return wrong(
                at,
                "the document",
                "the field `halfvector` with the format's version is missing; \
                 write \"halfvector\": 1 first if this is a material",
            );
        }
        Some(Spanned { json: Json::Number(digits), .. }) if digits.parse::<u32>().is_ok_and(|v| v > 0) => {
            digits.parse::<u32>().unwrap_or(FORMAT_VERSION)
        }
        Some(other) => return wrong(other.at, "halfvector", "the format's version is a whole number from 1 on"),
    };
    let mut reader = Reader { newer: version > FORMAT_VERSION, unknown: Map::new() };
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
            "nodes" => {
                nodes_seen = true;
                reader.nodes(&mut document, value)?;
            }
            "links" => reader.links(&mut document, value)?,
            "parameters" => reader.parameters(&mut document, value)?,
            "surface" => reader.surface(&mut document, value)?,
            "layout" => reader.layout(&mut document, value)?,
            _ => {
                reader.unknown.insert(key, value.json.into_plain());
            }
        }
    }
    if !nodes_seen {
        return wrong(
            at,
            "the document",
            "the field `nodes` is missing; is this a material? (a scene is another kind of file)",
        );
    }
    document.unknown = reader.unknown;
    Ok(document)
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

    fn nodes(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        for Member { at, key, value } in object(value, "nodes")? {
            let place = format!("nodes.{key}");
            let members = match value.json {
                Json::Object(members) => members,
                other if self.newer => {
                    self.keep_in_object("nodes", key, other.into_plain());
                    continue;
                }
                other => return wrong(value.at, &place, format!("a node is an object, not {}", other.kind())),
            };
            let kind = members.iter().find(|m| m.key == "node").map(|m| &m.value.json);
            if self.newer && !matches!(kind, Some(Json::String(_))) {
                self.keep_in_object("nodes", key, Json::Object(members).into_plain());
                continue;
            }
            if kind.is_none() {
                return wrong(
                    at,
                    &place,
                    "the field `node` is missing; it names the node's kind, such as \"math/mix\"",
                );
            }
            let node = self.node(members, &place)?;
            document.nodes.insert(key, node);
        }
        Ok(())
    }

    fn node(&self, members: Vec<Member>, place: &str) -> Result<Node, Wrong> {
        let mut node = Node::new("");
        for Member { key, value, .. } in members {
            let place = format!("{place}.{key}");
            match (key.as_str(), value.json) {
                ("node", Json::String(kind)) => node.node = kind,
                ("label", Json::String(label)) => node.label = Some(label),
                ("values", Json::Object(values)) => self.values(&mut node, values, &place)?,
                ("label" | "values", other) if self.newer => {
                    node.unknown.insert(key, other.into_plain());
                }
                ("node" | "label", other) => {
                    return wrong(value.at, &place, format!("a text in \" is needed, not {}", other.kind()));
                }
                ("values", other) => {
                    return wrong(
                        value.at,
                        &place,
                        format!("an object of values by input is needed, not {}", other.kind()),
                    );
                }
                (_, other) => {
                    node.unknown.insert(key, other.into_plain());
                }
            }
        }
        Ok(node)
    }

    fn values(&self, node: &mut Node, members: Vec<Member>, place: &str) -> Result<(), Wrong> {
        let mut kept = Map::new();
        for Member { key, value, .. } in members {
            match socket_value(&value, &format!("{place}.{key}")) {
                Ok(value) => {
                    node.values.insert(key, value);
                }
                Err(_) if self.newer => {
                    kept.insert(key, value.json.into_plain());
                }
                Err(e) => return Err(e),
            }
        }
        if !kept.is_empty() {
            node.unknown.insert("values".into(), Plain::Object(kept));
        }
        Ok(())
    }

    fn links(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        for (i, item) in list(value, "links")?.into_iter().enumerate() {
            match read_link(&item, &format!("links[{i}]")) {
                Ok((link, extra)) => {
                    document.links.push(link);
                    if extra {
                        self.keep_in_list("links", item.json.into_plain());
                    }
                }
                Err(_) if self.newer => self.keep_in_list("links", item.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
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

    fn layout(&mut self, document: &mut Document, value: Spanned) -> Result<(), Wrong> {
        let members = match value.json {
            Json::Object(members) => members,
            other => {
                return wrong(
                    value.at,
                    "layout",
                    format!("an object of positions by node is needed, not {}", other.kind()),
                );
            }
        };
        for Member { key, value, .. } in members {
            match pair(&value, &format!("layout.{key}")) {
                Ok(position) => {
                    document.layout.insert(key, position);
                }
                Err(_) if self.newer => self.keep_in_object("layout", key, value.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }
}

fn object(value: Spanned, place: &str) -> Result<Vec<Member>, Wrong> {
    match value.json {
        Json::Object(members) => Ok(members),
        other => wrong(value.at, place, format!("an object {{...}} is needed, not {}", other.kind())),
    }
}

fn list(value: Spanned, place: &str) -> Result<Vec<Spanned>, Wrong> {
    match value.json {
        Json::Array(items) => Ok(items),
        other => wrong(value.at, place, format!("a list [...] is needed, not {}", other.kind())),
    }
}

fn text(value: Spanned, place: &str) -> Result<String, Wrong> {
    match value.json {
        Json::String(s) => Ok(s),
        other => wrong(value.at, place, format!("a text in \" is needed, not {}", other.kind())),
    }
}

fn members_of<'v>(value: &'v Spanned, place: &str) -> Result<&'v [Member], Wrong> {
    match &value.json {
        Json::Object(members) => Ok(members),
        other => wrong(value.at, place, format!("an object {{...}} is needed, not {}", other.kind())),
    }
}

fn text_of<'v>(value: &'v Spanned, place: &str) -> Result<&'v str, Wrong> {
    match &value.json {
        Json::String(s) => Ok(s),
        other => wrong(value.at, place, format!("a text in \" is needed, not {}", other.kind())),
    }
}

fn number(value: &Spanned, place: &str) -> Result<f32, Wrong> {
    match &value.json {
        // Straight to f32: through f64 it could be rounded twice.
        Json::Number(digits) => Ok(digits.parse().unwrap_or(f32::NAN)),
        Json::String(s) if s == "nan" => Ok(f32::NAN),
        Json::String(s) if s == "inf" => Ok(f32::INFINITY),
        Json::String(s) if s == "-inf" => Ok(f32::NEG_INFINITY),
        other => wrong(value.at, place, format!("a number is needed, not {}", other.kind())),
    }
}

fn pair(value: &Spanned, place: &str) -> Result<[f32; 2], Wrong> {
    match &value.json {
        Json::Array(items) if items.len() == 2 => Ok([number(&items[0], place)?, number(&items[1], place)?]),
        _ => wrong(value.at, place, "two numbers are needed, such as [0, 1]"),
    }
}

fn socket_value(value: &Spanned, place: &str) -> Result<Value, Wrong> {
    match &value.json {
        Json::Bool(b) => Ok(Value::Bool(*b)),
        Json::Number(_) | Json::String(_) => Ok(Value::Number(number(value, place)?)),
        Json::Array(items) => {
            let numbers: Vec<f32> = items.iter().map(|item| number(item, place)).collect::<Result<_, _>>()?;
            match *numbers.as_slice() {
                [x, y] => Ok(Value::Vec2([x, y])),
                [x, y, z] => Ok(Value::Vec3([x, y, z])),
                [x, y, z, w] => Ok(Value::Vec4([x, y, z, w])),
                _ => wrong(value.at, place, format!("a vector has 2, 3 or 4 numbers, not {}", numbers.len())),
            }
        }
        Json::Object(_) => Ok(Value::Image(read_image(value, place)?)),
        Json::Null => {
            wrong(value.at, place, "a value is a number, true or false, a list of 2 to 4 numbers or an image, not null")
        }
    }
}

fn read_image(value: &Spanned, place: &str) -> Result<ImageRef, Wrong> {
    let mut file = None;
    let mut color_space = None;
    let (mut wrap_u, mut wrap_v, mut filter) = (Wrap::default(), Wrap::default(), Filter::default());
    for Member { at, key, value } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "file" => file = Some(text_of(value, place)?.to_string()),
            "color_space" => {
                color_space =
                    Some(choice(value, place, &[("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)])?);
            }
            "wrap_u" => wrap_u = choice(value, place, WRAPS)?,
            "wrap_v" => wrap_v = choice(value, place, WRAPS)?,
            "filter" => filter = choice(value, place, &[("linear", Filter::Linear), ("nearest", Filter::Nearest)])?,
            _ => return wrong(*at, place, "an image has the fields file, color_space, wrap_u, wrap_v and filter"),
        }
    }
    match (file, color_space) {
        (Some(file), Some(color_space)) => Ok(ImageRef { file, color_space, wrap_u, wrap_v, filter }),
        (None, _) => wrong(value.at, place, "the image's field `file` is missing"),
        (_, None) => wrong(
            value.at,
            place,
            "the image's field `color_space` is missing: \"srgb\" for colours, \"linear\" for everything else",
        ),
    }
}

const WRAPS: &[(&str, Wrap)] = &[("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp), ("mirror", Wrap::Mirror)];

fn choice<T: Copy>(value: &Spanned, place: &str, choices: &[(&str, T)]) -> Result<T, Wrong> {
    let given = text_of(value, place)?;
    match choices.iter().find(|(name, _)| *name == given) {
        Some((_, choice)) => Ok(*choice),
        None => {
            let names: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            wrong(value.at, place, format!("\"{given}\" is none of {}", names.join(", ")))
        }
    }
}

fn socket(value: &Spanned, place: &str) -> Result<SocketRef, Wrong> {
    let written = text_of(value, place)?;
    match SocketRef::parse(written) {
        Some(socket) => Ok(socket),
        None => wrong(value.at, place, format!("\"{written}\" names no socket; write it as \"node.socket\"")),
    }
}

/// A link, and whether the object has further fields.
fn read_link(value: &Spanned, place: &str) -> Result<(Link, bool), Wrong> {
    let (mut from, mut to, mut extra) = (None, None, false);
    for Member { key, value, .. } in members_of(value, place)? {
        match key.as_str() {
            "from" => from = Some(socket(value, &format!("{place}.from"))?),
            "to" => to = Some(socket(value, &format!("{place}.to"))?),
            _ => extra = true,
        }
    }
    match (from, to) {
        (Some(from), Some(to)) => Ok((Link { from, to }, extra)),
        (None, _) => wrong(value.at, place, "the link's field `from` is missing: the output, as \"node.socket\""),
        (_, None) => wrong(value.at, place, "the link's field `to` is missing: the input, as \"node.socket\""),
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

/// Reads a field of the surface settings; false when there is no such field.
fn read_surface_field(surface: &mut SurfaceSettings, key: &str, value: &Spanned) -> Result<bool, Wrong> {
    let place = &format!("surface.{key}");
    match key {
        "alpha_mode" => {
            let modes = [("opaque", AlphaMode::Opaque), ("mask", AlphaMode::Mask), ("blend", AlphaMode::Blend)];
            surface.alpha_mode = choice(value, place, &modes)?;
        }
        "alpha_cutoff" => surface.alpha_cutoff = number(value, place)?,
        "double_sided" => match value.json {
            Json::Bool(b) => surface.double_sided = b,
            _ => return wrong(value.at, place, format!("true or false is needed, not {}", value.json.kind())),
        },
        _ => return Ok(false),
    }
    Ok(true)
}

/// The link that a kept object stands for; none when it was not understood.
pub(super) fn link_of_plain(raw: &Plain) -> Option<Link> {
    let spanned = json::parse(&raw.to_string()).ok()?;
    read_link(&spanned, "").ok().map(|(link, _)| link)
}

/// Name and socket of the parameter that a kept object stands for; none when it was not understood.
pub(super) fn parameter_key_of_plain(raw: &Plain) -> Option<(String, SocketRef)> {
    let spanned = json::parse(&raw.to_string()).ok()?;
    read_parameter(&spanned, "").ok().map(|(parameter, _)| (parameter.name, parameter.socket))
}
