//! Every node gives finite numbers: at its defaults, over its soft ranges and their ends, in f32; what is plain arithmetic over the whole
//! domain of 1e8 too.

use halfvector_graph::library::Library;
use halfvector_graph::node_def::{Default, NodeDef};
use halfvector_graph::value::{SocketType, Type};

use super::run::Node;

/// Rows tried for each node and type.
const ROWS: usize = 200;

/// An evenly spread number in 0..1 for a row and a column.
fn spread(row: usize, column: usize) -> f32 {
    const STEPS: [f64; 6] =
        [0.618_033_988_7, 0.754_877_666_2, 0.569_840_290_9, 0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9];
    let step = STEPS[column % STEPS.len()] + 0.037 * (column / STEPS.len()) as f64;
    (row as f64 * step).fract() as f32
}

fn types(def: &NodeDef) -> Vec<Type> {
    if def.generic.is_empty() { vec![Type::F32] } else { def.generic.clone() }
}

/// Rows over the soft ranges: their ends first, then what lies within.
fn soft_rows(node: &Node) -> Vec<Vec<f32>> {
    let mut rows = vec![node.defaults()];
    let inputs: Vec<_> = node.def.inputs.iter().filter(|i| i.ty != SocketType::Texture).collect();
    for row in 0..ROWS {
        let mut values = Vec::new();
        let mut column = 0;
        for (input, width) in inputs.iter().zip(&node.widths) {
            let whole = matches!(input.ty, SocketType::Value(Type::I32 | Type::Bool));
            let [low, high] = match (input.range, &input.default, input.ty) {
                (_, _, SocketType::Value(Type::Bool)) => [0.0, 1.0],
                (Some(range), ..) => range,
                (None, Default::Context(name), _) if name.starts_with("uv") => [-2.0, 3.0],
                (None, Default::Context(_), _) => [-1.0, 1.0],
                _ => [-4.0, 4.0],
            };
            for _ in 0..*width {
                let t = match row {
                    0 => 0.0,
                    1 => 1.0,
                    2 => 0.5,
                    _ if row < 40 => spread(row, column).round(),
                    _ => spread(row, column),
                };
                let x = low + (high - low) * t;
                values.push(if whole { x.round() } else { x });
                column += 1;
            }
        }
        rows.push(values);
    }
    rows
}

/// Rows of numbers at the ends of the domain and around 0.
fn wild_rows(node: &Node) -> Vec<Vec<f32>> {
    const WILD: [f32; 12] = [0.0, 1.0, -1.0, 1e8, -1e8, 1e-8, -1e-8, 1e-38, 0.5, -0.0, 90.0, 3.0];
    let count: usize = node.widths.iter().sum();
    (0..ROWS)
        .map(|row| (0..count).map(|c| WILD[(row * (2 * c + 1) + c * c + row / 12 * c) % WILD.len()]).collect())
        .collect()
}

#[test]
fn every_node_is_finite() {
    let mut failures = Vec::new();
    let mut tried = 0;
    for def in Library::standard().iter().filter(|def| !def.id.starts_with("surface/")) {
        let arithmetic = ["math/", "vector/", "color/", "input/"].iter().any(|c| def.id.starts_with(c));
        for ty in types(def) {
            for vertex in [false, true] {
                if vertex && def.vertex_function.is_none() {
                    continue;
                }
                let node = Node::of(def, ty, vertex);
                let mut rows = soft_rows(&node);
                // Refract takes unit directions.
                if arithmetic && def.id != "vector/refract" {
                    rows.extend(wild_rows(&node));
                }
                tried += 1;
                for (row, found) in rows.iter().zip(node.call::<f32>(&rows)) {
                    if found.iter().any(|x| !x.is_finite()) {
                        failures.push(format!("{} of {ty:?}, vertex {vertex}: {found:?} at {row:?}", def.id));
                        break;
                    }
                }
            }
        }
    }
    println!("{tried} functions on {ROWS} rows or more");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The ends of f32 and what lies around 0.
const EXTREMES: [f32; 14] =
    [0.0, -0.0, 1e-38, -1e-38, 1e-45, 1.0, -1.0, 0.3, 3e9, -3e9, 1e38, -1e38, f32::MAX, f32::MIN];

/// Rows of extremes: each component alone with the others at their defaults, then all at once.
fn extreme_rows(node: &Node) -> Vec<Vec<f32>> {
    let mut rows = Vec::new();
    let defaults = node.defaults();
    for component in 0..defaults.len() {
        for x in EXTREMES {
            let mut row = defaults.clone();
            row[component] = x;
            rows.push(row);
        }
    }
    for row in 0..ROWS {
        rows.push(
            (0..defaults.len())
                .map(|c| EXTREMES[(row * (2 * c + 1) + c * c + row / 14 * c) % EXTREMES.len()])
                .collect(),
        );
    }
    rows
}

/// Whatever finite numbers come into a pattern, a number comes out: positions and scales at the ends of f32, whose product
/// overflows, and pixels that are as wide. Elsewhere what is too large for f32 is infinite, as in all arithmetic, and a shader's
/// end guards its colour; how many nodes that is is told. What is no number comes out as it likes, but it comes out.
#[test]
fn patterns_are_finite_for_every_finite_input() {
    let (mut failures, mut overflows) = (Vec::new(), std::collections::BTreeMap::<&str, usize>::new());
    for def in Library::standard().iter().filter(|def| !def.id.starts_with("surface/")) {
        let category = def.id.split('/').next().unwrap_or_default();
        for ty in types(def) {
            for vertex in [false, true] {
                if vertex && def.vertex_function.is_none() {
                    continue;
                }
                let node = Node::of(def, ty, vertex);
                let rows = extreme_rows(&node);
                let wide = vec![f32::MAX; node.defaults().len()];
                node.call::<f32>(&[f32::NAN, f32::INFINITY].map(|x| vec![x; wide.len()]));
                let found = [node.call::<f32>(&rows), node.run::<f32>(&rows, Some((&wide, &wide)))];
                let mut all = found.iter().flat_map(|found| rows.iter().zip(found));
                let Some((row, found)) = all.find(|(_, found)| found.iter().any(|x| !x.is_finite())) else {
                    continue;
                };
                if category == "procedural" {
                    failures.push(format!("{} of {ty:?}, vertex {vertex}: {found:?} at {row:?}", def.id));
                } else {
                    *overflows.entry(category).or_default() += 1;
                }
            }
        }
    }
    println!("functions that give what is no finite number for some finite ones, by category: {overflows:?}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
