//! A group: its interface and its graph.

use super::graph::GraphReader;
use super::value::{choice, list, members_of, object, pair, socket_value, text, text_of};
use super::{Wrong, wrong};
use crate::document::{Group, GroupInput, GroupOutput};
use crate::json::{Json, Member, Spanned};
use crate::node_def::Default as InputDefault;
use crate::value::{ColorSpace, SocketType, Type, Value};

/// Reads a group; `place` is its place in the file.
pub(super) fn read(value: Spanned, place: &str, newer: bool) -> Result<Group, Wrong> {
    let at = value.at;
    let mut reader = GraphReader::new(newer, format!("{place}."));
    let mut group = Group::default();
    let mut nodes_seen = false;
    for Member { key, value, .. } in object(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "label" => group.interface.label = text(value, place)?,
            "help" => group.interface.help = text(value, place)?,
            "inputs" => {
                for (i, item) in list(value, place)?.into_iter().enumerate() {
                    group.interface.inputs.push(input(&item, &format!("{place}[{i}]"))?);
                }
            }
            "outputs" => {
                for (i, item) in list(value, place)?.into_iter().enumerate() {
                    group.interface.outputs.push(output(&item, &format!("{place}[{i}]"))?);
                }
            }
            _ => {
                nodes_seen |= key == "nodes";
                if let Some(value) = reader.section(&key, value)? {
                    group.unknown.insert(key, value.json.into_plain());
                }
            }
        }
    }
    if !nodes_seen {
        return wrong(at, place, "the group's field `nodes` is missing");
    }
    group.graph = reader.graph;
    Ok(group)
}

const TYPES: &[(&str, SocketType)] = &[
    ("f32", SocketType::Value(Type::F32)),
    ("vec2f", SocketType::Value(Type::Vec2)),
    ("vec3f", SocketType::Value(Type::Vec3)),
    ("vec4f", SocketType::Value(Type::Vec4)),
    ("bool", SocketType::Value(Type::Bool)),
    ("i32", SocketType::Value(Type::I32)),
    ("texture", SocketType::Texture),
];

fn input(value: &Spanned, place: &str) -> Result<GroupInput, Wrong> {
    let mut input = GroupInput::new("", Type::F32, Value::Number(0.0));
    let (mut named, mut typed, mut default) = (false, false, None);
    for Member { key, value, .. } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "name" => {
                input.name = text_of(value, place)?.into();
                named = true;
            }
            "type" => {
                input.ty = choice(value, place, TYPES)?;
                typed = true;
            }
            "label" => input.label = Some(text_of(value, place)?.into()),
            "default" => default = Some(InputDefault::Value(socket_value(value, place)?)),
            "context" => default = Some(InputDefault::Context(text_of(value, place)?.into())),
            "color_space" => {
                let space = choice(value, place, &[("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)])?;
                default = Some(InputDefault::Image(space));
            }
            "range" => input.range = Some(pair(value, place)?),
            "unit" => input.unit = text_of(value, place)?.into(),
            "help" => input.help = text_of(value, place)?.into(),
            _ => {
                input.unknown.insert(key.clone(), value.json.clone().into_plain());
            }
        }
    }
    if !named || !typed {
        return wrong(value.at, place, "a group's input has the fields `name` and `type`");
    }
    input.default = match (default, input.ty) {
        (Some(default), _) => default,
        (None, SocketType::Texture) => InputDefault::Image(ColorSpace::Srgb),
        (None, _) => InputDefault::Value(Value::Number(0.0)),
    };
    Ok(input)
}

fn output(value: &Spanned, place: &str) -> Result<GroupOutput, Wrong> {
    let mut output = GroupOutput::new("", Type::F32);
    let (mut named, mut typed) = (false, false);
    for Member { key, value, .. } in members_of(value, place)? {
        let place = &format!("{place}.{key}");
        match key.as_str() {
            "name" => {
                output.name = text_of(value, place)?.into();
                named = true;
            }
            "type" => {
                output.ty = match (choice(value, place, TYPES)?, &value.json) {
                    (SocketType::Value(ty), Json::String(_)) => ty,
                    _ => return wrong(value.at, place, "a group gives no textures; sample them inside"),
                };
                typed = true;
            }
            "label" => output.label = Some(text_of(value, place)?.into()),
            "help" => output.help = text_of(value, place)?.into(),
            _ => {
                output.unknown.insert(key.clone(), value.json.clone().into_plain());
            }
        }
    }
    if named && typed {
        Ok(output)
    } else {
        wrong(value.at, place, "a group's output has the fields `name` and `type`")
    }
}
