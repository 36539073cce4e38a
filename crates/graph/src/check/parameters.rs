//! Problems of the parameters that a material offers.

use super::{Checker, Severity, counts, nodes};
use crate::document::{Parameter, is_name};
use crate::node_def::Default;
use crate::value::SocketType;

pub(super) fn check(checker: &mut Checker) {
    let document = checker.document;
    let names = counts(document.parameters.iter().map(|parameter| parameter.name.as_str()));
    for (name, count) in names.iter().filter(|(_, count)| **count > 1) {
        let message = format!("{count} parameters are named `{name}`; give each its own name");
        checker.of_document(Severity::Error, message);
    }
    for parameter in &document.parameters {
        one(checker, parameter);
    }
}

fn one(checker: &mut Checker, parameter: &Parameter) {
    let name = &parameter.name;
    let (node, socket) = (parameter.socket.node.as_str(), parameter.socket.socket.as_str());
    if !is_name(name) {
        let message = format!(
            "the parameter `{name}` needs a name of letters, digits and _, first a letter (its label may be anything)"
        );
        checker.of_document(Severity::Error, message);
    }
    if parameter.range.is_some_and(|[lo, hi]| !(lo.is_finite() && hi.is_finite() && lo < hi)) {
        let message = format!("the range of the parameter `{name}` needs two finite numbers, the smaller one first");
        checker.of_document(Severity::Error, message);
    }
    let Some(set) = checker.document.graph.nodes.get(node) else {
        let message = format!(
            "the parameter `{name}` sets `{}`, but there is no such node; remove the parameter",
            parameter.socket
        );
        checker.of_document(Severity::Error, message);
        return;
    };
    // An unknown definition is reported with its node.
    let Some(def) = checker.library.get(&set.node) else { return };
    let Some(input) = def.inputs.iter().find(|input| input.name == socket) else {
        let message = format!("the parameter `{name}` sets it, but {}", nodes::no_input(checker, def, socket));
        return checker.wrong(node, Some(socket), message);
    };
    let mut say = |message: String| checker.wrong(node, Some(socket), message);
    if !matches!(input.ty, SocketType::Value(_) | SocketType::Generic) {
        return say(format!(
            "the parameter `{name}` sets it, but only numbers, vectors and switches can be parameters"
        ));
    }
    if let (Default::Context(context), None) = (&input.default, set.values.get(socket)) {
        say(format!(
            "the parameter `{name}` sets it, but without a value the input reads `{context}`; set a value first"
        ));
        return;
    }
    if let Some(from) = checker.wiring.incoming(node, socket) {
        let message =
            format!("the parameter `{name}` sets it, but it is fed by {from}; remove the link or the parameter");
        return checker.wrong(node, Some(socket), message);
    }
    if !checker.live.contains(node) {
        checker.warn(
            node,
            Some(socket),
            format!("the parameter `{name}` has no effect: the node does not reach the surface"),
        );
    }
}
