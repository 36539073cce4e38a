//! What goes together: whether a link can be made, and in words why not. Types are decided by the graph's own rules.

use halfvector_graph::docs::capitalised;
use halfvector_graph::document::{Link, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::operation::can_connect;
use halfvector_graph::value::{SocketType, Type};

use super::sheet::{Card, Row};
use crate::session::Session;

/// An end of a wire that looks for the other one.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Loose {
    /// From an output, of this type.
    Output(SocketRef, SocketType),
    /// From an input: what it takes, with the types of its `T` when it is generic.
    Input(SocketRef, Vec<SocketType>),
}

/// Whether a value of a type can stand where another is wanted.
pub(super) fn fits(given: SocketType, wanted: SocketType) -> bool {
    match (given, wanted) {
        (SocketType::Value(given), SocketType::Value(wanted)) => given.converts_to(wanted),
        (SocketType::Surface, SocketType::Surface) => true,
        _ => false,
    }
}

/// The types that a socket can have.
pub(super) fn candidates(ty: SocketType, is_generic: bool, generic: &[Type]) -> Vec<SocketType> {
    if is_generic { generic.iter().map(|ty| SocketType::Value(*ty)).collect() } else { vec![ty] }
}

impl Loose {
    /// The socket that the wire is fixed to.
    pub(super) fn socket(&self) -> &SocketRef {
        match self {
            Loose::Output(socket, _) | Loose::Input(socket, _) => socket,
        }
    }

    /// The type whose colour the wire has.
    pub(super) fn ty(&self) -> SocketType {
        match self {
            Loose::Output(_, ty) => *ty,
            Loose::Input(_, types) => types.first().copied().unwrap_or(SocketType::Generic),
        }
    }

    /// Whether types go together, whatever else is wired.
    fn takes(&self, types: &[SocketType]) -> bool {
        match self {
            Loose::Output(_, given) => types.iter().any(|wanted| fits(*given, *wanted)),
            Loose::Input(_, wanted) => types.iter().any(|given| wanted.iter().any(|wanted| fits(*given, *wanted))),
        }
    }

    /// Whether the wire could end at a socket of a card.
    pub(super) fn fits_row(&self, card: &Card, row: &Row) -> bool {
        let wanted = match self {
            Loose::Output(..) => super::sheet::Side::Input,
            Loose::Input(..) => super::sheet::Side::Output,
        };
        row.side == wanted
            && card.id != self.socket().node
            && match self {
                Loose::Output(..) => self.takes(&candidates(row.ty, row.is_generic, &card.generic)),
                Loose::Input(..) => self.takes(&[row.ty]),
            }
    }

    /// The first socket of a definition that the wire could end at.
    pub(super) fn socket_of<'d>(&self, def: &'d NodeDef) -> Option<&'d str> {
        let takes = |ty: SocketType| self.takes(&candidates(ty, ty == SocketType::Generic, &def.generic));
        match self {
            Loose::Output(..) => def.inputs.iter().find(|input| takes(input.ty)).map(|input| input.name.as_str()),
            Loose::Input(..) => def.outputs.iter().find(|output| takes(output.ty)).map(|output| output.name.as_str()),
        }
    }

    /// The link to another socket.
    pub(super) fn link(&self, other: SocketRef) -> Link {
        match self {
            Loose::Output(socket, _) => Link::new(socket.clone(), other),
            Loose::Input(socket, _) => Link::new(other, socket.clone()),
        }
    }
}

/// Why a link cannot be made; none when it can.
pub(super) fn refusal(session: &Session, link: &Link) -> Option<String> {
    let can = can_connect(session.document(), Library::standard(), session.group(), &link.from, &link.to);
    can.err().map(|why| sentence(&why.0))
}

/// A reason as a sentence of its own.
pub(super) fn sentence(message: &str) -> String {
    capitalised(message) + "."
}

/// The first input that takes a type and the first output that gives another one: a way through a node.
pub(super) fn through(def: &NodeDef, given: SocketType, wanted: SocketType) -> Option<(&str, &str)> {
    let types = |ty: SocketType| candidates(ty, ty == SocketType::Generic, &def.generic);
    let input = def.inputs.iter().find(|input| types(input.ty).iter().any(|ty| fits(given, *ty)))?;
    let output = def.outputs.iter().find(|output| {
        // A generic output gives what came in, when that is one of its types.
        if output.ty == SocketType::Generic && input.ty == SocketType::Generic && types(output.ty).contains(&given) {
            return fits(given, wanted);
        }
        types(output.ty).iter().any(|ty| fits(*ty, wanted))
    })?;
    Some((&input.name, &output.name))
}
