//! Problems of single nodes: names, definitions, values, and nodes that reach nothing.

use super::{Checker, Severity, Told, words};
use crate::document::{GROUP_INPUT, GROUP_OUTPUT, Node, NodeId, function_of, group_of, is_name};
use crate::node_def::{Default, Input, NodeDef};
use crate::value::{ImageRef, SocketType, Value};

pub(super) fn check(checker: &mut Checker) {
    let graph = checker.graph;
    for (id, node) in &graph.nodes {
        name(checker, id, node);
        let Some(def) = checker.library.get(&node.node) else {
            unknown_definition(checker, id, node);
            continue;
        };
        for (socket, value) in &node.values {
            match def.inputs.iter().find(|input| input.name == *socket) {
                Some(input) => set_value(checker, id, input, value),
                None => unknown_value(checker, id, def, socket),
            }
        }
        for input in &def.inputs {
            missing(checker, id, node, input);
        }
        if checker.is_used && !checker.live.contains(id.as_str()) {
            // The inputs of a group are there whether it reads them or not.
            if node.node != GROUP_INPUT {
                let end = if checker.group.is_some() { "the group's outputs" } else { "the surface" };
                let message = || format!("the node does not reach {end} and is left out; link it or remove it");
                checker.warn(id, None, Told(message));
            }
        }
    }
}

fn name(checker: &mut Checker, id: &NodeId, node: &Node) {
    if !is_name(id) {
        checker.at(
            Severity::Error,
            id,
            None,
            "the node's id is no name; use letters, digits and _, first a letter (its label may be anything)",
        );
    }
    if node.label.as_ref().is_some_and(|label| label.chars().any(char::is_control)) {
        checker.warn(id, None, "the label has line breaks or control characters; they are shown as spaces");
    }
    for field in node.unknown.keys() {
        let message = format!(
            "the node's field `{field}` has parts that this program does not know; they are kept when it saves"
        );
        checker.warn(id, None, message);
    }
}

fn unknown_definition(checker: &mut Checker, id: &str, node: &Node) {
    let library = checker.library;
    let search = checker.findings.may_search();
    if let Some(group) = group_of(&node.node) {
        let known = library.iter().filter_map(|def| group_of(&def.id));
        let remedy = match if search { words::nearest(group, known) } else { None } {
            Some(likely) => format!("did you mean `group/{likely}`?"),
            None => "import it, or remove the node.".into(),
        };
        let message = format!("there is no group `{group}` in this document; {remedy}");
        return checker.wrong(id, None, message);
    }
    if let Some(function) = function_of(&node.node) {
        // What is wrong with a function is told with it.
        if !checker.document.functions.contains_key(function) {
            let message = format!("there is no function `{function}` in this document; write it, or remove the node");
            checker.wrong(id, None, message);
        }
        return;
    }
    if node.node == GROUP_INPUT || node.node == GROUP_OUTPUT {
        return checker.wrong(id, None, format!("`{}` stands inside groups only; remove the node", node.node));
    }
    let word = node.node.rsplit('/').next().unwrap_or("");
    let synonym = || library.iter().find(|def| def.synonyms.iter().any(|s| s == word)).map(|def| def.id.as_str());
    let likely = if search {
        words::nearest(&node.node, library.iter().map(|def| def.id.as_str())).or_else(synonym)
    } else {
        None
    };
    let remedy = match likely {
        Some(likely) => format!("did you mean `{likely}`?"),
        None => "`halfvector nodes` lists those that there are.".into(),
    };
    checker.wrong(
        id,
        None,
        format!(
            "there is no node `{}` in the library; {remedy} The node is kept when the document is saved.",
            node.node
        ),
    );
}

fn unknown_value(checker: &mut Checker, id: &str, def: &NodeDef, socket: &str) {
    let message = format!("a value is set on `{socket}`, but {}", no_input(checker, def, socket));
    checker.wrong(id, Some(socket), message);
}

/// Says that there is no such input, and what there is.
pub(super) fn no_input(checker: &mut Checker, def: &NodeDef, socket: &str) -> String {
    let names = || def.inputs.iter().map(|input| input.name.as_str());
    if !checker.findings.may_search() {
        return format!("`{}` has no such input", def.id);
    }
    match words::nearest(socket, names()) {
        Some(likely) => format!("`{}` has no such input; did you mean `{likely}`?", def.id),
        None if def.inputs.is_empty() => format!("`{}` has no inputs", def.id),
        None => format!("`{}` has no such input; it has {}", def.id, names().collect::<Vec<_>>().join(", ")),
    }
}

fn set_value(checker: &mut Checker, id: &str, input: &Input, value: &Value) {
    let socket = Some(input.name.as_str());
    if value.components().is_some_and(|components| components.iter().any(|x| !x.is_finite())) {
        checker.wrong(id, socket, "the value is no finite number; set another one, or remove it to get the default");
        return;
    }
    let ty = checker.types.get(id).map_or(input.ty, |types| types.resolved(input.ty));
    match (ty, value) {
        (SocketType::Texture, Value::Image(image)) => picture(checker, id, input, image),
        (SocketType::Value(ty), value) if value.components_as(ty).is_some() => {}
        (ty, value) => {
            let because =
                if input.ty == SocketType::Generic { " (the widest that comes into the node decides)" } else { "" };
            let message = format!(
                "the value is {}, but a {} is wanted{because}: write {}",
                words::value(value),
                words::socket_type(ty),
                words::example(ty)
            );
            checker.wrong(id, socket, message);
        }
    }
}

fn picture(checker: &mut Checker, id: &str, input: &Input, image: &ImageRef) {
    let file = image.file.as_str();
    let is_absolute = file.starts_with(['/', '\\']) || file.as_bytes().get(1) == Some(&b':');
    if file.is_empty() {
        checker.wrong(id, Some(&input.name), "no picture is chosen: its file name is empty");
    } else if is_absolute {
        let message = format!(
            "the picture {file} is named from the root of this disk and will be missing on others; name it from the document's folder"
        );
        checker.warn(id, Some(&input.name), message);
    }
}

/// A picture or a surface that has no default.
fn missing(checker: &mut Checker, id: &str, node: &Node, input: &Input) {
    let message = match (&input.default, node.values.get(&input.name)) {
        (Default::Image(_), None) => "no picture is chosen; set one",
        // A value that is set on a surface is told as such.
        (Default::Surface, None) => "no surface comes in; link the output of a surface node",
        _ => return,
    };
    if checker.wiring.incoming(id, &input.name).is_none() {
        checker.wrong(id, Some(&input.name), message);
    }
}
