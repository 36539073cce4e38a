//! The rows of a card: which sockets of a node are shown, in which order, and what each shows of its value.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_graph::document::Graph;
use halfvector_graph::node_def::{Default as InputDefault, Input, NodeDef, REROUTE};
use halfvector_graph::resolve::NodeTypes;
use halfvector_graph::value::{SocketType, Type, Value};

use super::sheet::{Field, HEADER, REROUTE_SIZE, ROW, Row, Side, shown};

/// Inputs that a card shows at once; of more only those that are used, and the first of them.
const INPUTS_SHOWN: usize = 14;
const INPUTS_FIRST: usize = 8;

/// The rows of a node: its outputs, its inputs, and what unfolds those that are not used.
pub(super) fn rows_of(
    types: &NodeTypes<'_>,
    values: &BTreeMap<String, Value>,
    has_colors: bool,
    is_wired: impl Fn(&str) -> bool,
    is_used: impl Fn(&str) -> bool,
    is_unfolded: bool,
) -> Vec<Row> {
    let NodeDef { inputs, outputs, .. } = types.def;
    let mut rows = Vec::with_capacity(inputs.len() + outputs.len());
    let mut y = HEADER + ROW / 2.0 + 3.0;
    let mut next = |rows: &mut Vec<Row>, mut row: Row| {
        row.y = y;
        y += ROW;
        rows.push(row);
    };
    for output in outputs {
        let row = Row {
            side: Side::Output,
            name: output.name.clone(),
            label: output.label.clone().unwrap_or_else(|| shown(&output.name)),
            ty: types.resolved(output.ty),
            is_generic: output.ty == SocketType::Generic,
            y: HEADER / 2.0,
            is_wired: is_wired(&output.name),
            help: output.help.clone(),
            field: Field::None,
        };
        // The only output sits at the title.
        if outputs.len() == 1 { rows.push(row) } else { next(&mut rows, row) }
    }
    let folds = inputs.len() > INPUTS_SHOWN;
    let mut hidden = 0;
    for (place, input) in inputs.iter().enumerate() {
        let is_wired = is_wired(&input.name);
        if folds && !is_unfolded && place >= INPUTS_FIRST && !is_used(&input.name) {
            hidden += 1;
            continue;
        }
        let ty = types.resolved(input.ty);
        let row = Row {
            side: Side::Input,
            name: input.name.clone(),
            label: input.label.clone().unwrap_or_else(|| shown(&input.name)),
            ty,
            is_generic: input.ty == SocketType::Generic,
            y: 0.0,
            is_wired,
            help: input.help.clone(),
            field: match is_wired {
                true => Field::None,
                false => {
                    let is_color = input.unit == "color" || (has_colors && input.ty == SocketType::Generic);
                    field(input, ty, is_color, values.get(&input.name))
                }
            },
        };
        next(&mut rows, row);
    }
    if types.def.id == REROUTE {
        for row in &mut rows {
            row.y = REROUTE_SIZE.y / 2.0;
            row.field = Field::None;
        }
    }
    if folds {
        let name = if is_unfolded { "show fewer".to_owned() } else { format!("{hidden} more") };
        let row = Row {
            side: Side::Fold,
            label: name.clone(),
            name,
            ty: SocketType::Generic,
            is_generic: false,
            y: 0.0,
            is_wired: false,
            help: "Shows or hides the inputs that are not used.".into(),
            field: Field::None,
        };
        if is_unfolded || hidden > 0 {
            next(&mut rows, row);
        }
    }
    rows
}

/// Rows of a node without a definition: what the document says of it.
pub(super) fn rows_of_unknown(graph: &Graph, id: &str) -> Vec<Row> {
    let outputs: BTreeSet<&str> =
        graph.links.iter().filter(|link| link.from.node == id).map(|link| link.from.socket.as_str()).collect();
    let inputs: BTreeSet<&str> =
        graph.links.iter().filter(|link| link.to.node == id).map(|link| link.to.socket.as_str()).collect();
    let all =
        outputs.into_iter().map(|name| (Side::Output, name)).chain(inputs.into_iter().map(|name| (Side::Input, name)));
    all.enumerate()
        .map(|(i, (side, name))| Row {
            side,
            name: name.to_owned(),
            label: shown(name),
            ty: SocketType::Generic,
            is_generic: false,
            y: HEADER + 3.0 + ROW * (i as f32 + 0.5),
            is_wired: true,
            help: String::new(),
            field: Field::None,
        })
        .collect()
}

fn field(input: &Input, ty: SocketType, is_color: bool, set: Option<&Value>) -> Field {
    let value = match (set, &input.default) {
        (Some(value), _) => value,
        (None, InputDefault::Value(value)) => value,
        (None, InputDefault::Context(name)) => return Field::Note(shown(name)),
        (None, InputDefault::Image(_)) => return Field::Note("no picture".into()),
        (None, InputDefault::Surface) => return Field::Note("no surface".into()),
    };
    if let Value::Image(image) = value {
        let name = image.file.rsplit(['/', '\\']).next().unwrap_or(&image.file);
        return Field::Note(name.to_owned());
    }
    let SocketType::Value(ty) = ty else { return Field::None };
    // What does not fit is shown as it is; the problems say what is wrong.
    let Some(parts) = value.components_as(ty).or_else(|| value.components().map(<[f32]>::to_vec)) else {
        return Field::None;
    };
    match (ty, parts.as_slice()) {
        (Type::Bool, [x]) => Field::Switch(*x != 0.0),
        (_, [x]) => {
            Field::Number { value: *x, range: input.range, is_whole: ty == Type::I32, unit: input.unit.clone() }
        }
        (Type::Vec3, [r, g, b]) if is_color => Field::Color([*r, *g, *b]),
        (_, parts) => Field::Vector(parts.to_vec()),
    }
}
