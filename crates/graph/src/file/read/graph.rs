//! The sections of a graph: nodes, links, and the view.

use serde_json::{Map, Value as Plain};

use super::value::{color, list, members_of, object, pair, rect, socket, socket_value, text_of};
use super::{Wrong, wrong};
use crate::document::{Comment, Frame, Graph, Link, Node};
use crate::json::{self, Json, Member, Spanned};

/// Reads the sections of one graph.
pub(super) struct GraphReader {
    /// Whether the file was written by a newer version: what is not understood is kept.
    newer: bool,
    /// Of the graph in the document, such as `groups.rust.`; empty at the top.
    prefix: String,
    /// What was read so far.
    pub(super) graph: Graph,
}

impl GraphReader {
    pub(super) fn new(newer: bool, prefix: String) -> GraphReader {
        GraphReader { newer, prefix, graph: Graph::default() }
    }

    /// Reads a section, or gives it back when it is none of a graph's.
    pub(super) fn section(&mut self, key: &str, value: Spanned) -> Result<Option<Spanned>, Wrong> {
        match key {
            "nodes" => self.nodes(value)?,
            "links" => self.links(value)?,
            "layout" => self.layout(value)?,
            "frames" => self.frames(value)?,
            "comments" => self.comments(value)?,
            _ => return Ok(Some(value)),
        }
        Ok(None)
    }

    fn place(&self, field: &str) -> String {
        format!("{}{field}", self.prefix)
    }

    fn keep_in_object(&mut self, section: &str, key: String, raw: Plain) {
        let entry = self.graph.unknown.entry(section).or_insert_with(|| Plain::Object(Map::new()));
        if let Plain::Object(map) = entry {
            map.insert(key, raw);
        }
    }

    /// The members of a section; none when it was kept, since a newer version gave it another shape.
    fn members_or_keep(&mut self, section: &str, value: Spanned) -> Result<Option<Vec<Member>>, Wrong> {
        if self.newer && !matches!(value.json, Json::Object(_)) {
            self.graph.unknown.insert(section.into(), value.json.into_plain());
            return Ok(None);
        }
        object(value, &self.place(section)).map(Some)
    }

    fn keep_in_list(&mut self, section: &str, raw: Plain) {
        let entry = self.graph.unknown.entry(section).or_insert_with(|| Plain::Array(Vec::new()));
        if let Plain::Array(list) = entry {
            list.push(raw);
        }
    }

    fn nodes(&mut self, value: Spanned) -> Result<(), Wrong> {
        for Member { at, key, value } in object(value, &self.place("nodes"))? {
            let place = self.place(&format!("nodes.{key}"));
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
            self.graph.nodes.insert(key, node);
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

    fn links(&mut self, value: Spanned) -> Result<(), Wrong> {
        for (i, item) in list(value, &self.place("links"))?.into_iter().enumerate() {
            match read_link(&item, &self.place(&format!("links[{i}]"))) {
                Ok((link, extra)) => {
                    self.graph.links.push(link);
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

    fn layout(&mut self, value: Spanned) -> Result<(), Wrong> {
        let members = match value.json {
            Json::Object(members) => members,
            other => {
                return wrong(
                    value.at,
                    &self.place("layout"),
                    format!("an object of positions by node is needed, not {}", other.kind()),
                );
            }
        };
        for Member { key, value, .. } in members {
            match pair(&value, &self.place(&format!("layout.{key}"))) {
                Ok(position) => {
                    self.graph.layout.insert(key, position);
                }
                Err(_) if self.newer => self.keep_in_object("layout", key, value.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }

    fn frames(&mut self, value: Spanned) -> Result<(), Wrong> {
        let Some(members) = self.members_or_keep("frames", value)? else { return Ok(()) };
        for Member { key, value, .. } in members {
            match read_frame(&value, &self.place(&format!("frames.{key}"))) {
                Ok(frame) => {
                    self.graph.frames.insert(key, frame);
                }
                Err(_) if self.newer => self.keep_in_object("frames", key, value.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }

    fn comments(&mut self, value: Spanned) -> Result<(), Wrong> {
        let Some(members) = self.members_or_keep("comments", value)? else { return Ok(()) };
        for Member { key, value, .. } in members {
            match read_comment(&value, &self.place(&format!("comments.{key}"))) {
                Ok(comment) => {
                    self.graph.comments.insert(key, comment);
                }
                Err(_) if self.newer => self.keep_in_object("comments", key, value.json.into_plain()),
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }
}

const NO_RECT: &str = "the field `rect` is missing: x, y, width and height, such as [0, 0, 300, 200]";

fn read_frame(value: &Spanned, place: &str) -> Result<Frame, Wrong> {
    let (mut frame, mut placed) = (Frame::default(), false);
    for Member { key, value, .. } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "title" => frame.title = text_of(value, place)?.into(),
            "color" => frame.color = Some(color(value, place)?),
            "rect" => {
                frame.rect = rect(value, place)?;
                placed = true;
            }
            _ => {
                frame.unknown.insert(key.clone(), value.json.clone().into_plain());
            }
        }
    }
    if placed { Ok(frame) } else { wrong(value.at, place, NO_RECT) }
}

fn read_comment(value: &Spanned, place: &str) -> Result<Comment, Wrong> {
    let (mut comment, mut placed) = (Comment::default(), false);
    for Member { key, value, .. } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "text" => comment.text = text_of(value, place)?.into(),
            "rect" => {
                comment.rect = rect(value, place)?;
                placed = true;
            }
            _ => {
                comment.unknown.insert(key.clone(), value.json.clone().into_plain());
            }
        }
    }
    if placed { Ok(comment) } else { wrong(value.at, place, NO_RECT) }
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

/// The link that a kept object stands for; none when it was not understood.
pub(in crate::file) fn link_of_plain(raw: &Plain) -> Option<Link> {
    let spanned = json::parse(&raw.to_string()).ok()?;
    read_link(&spanned, "").ok().map(|(link, _)| link)
}
