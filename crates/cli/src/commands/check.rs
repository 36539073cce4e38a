//! `halfvector check`: everything that is wrong with documents.

mod measured;
mod stability;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use halfvector_codegen::{CodegenError, Cost, Fold, Instructions, NodeCost, Shader};
use halfvector_graph::check::{Problem, Severity, node_label};
use halfvector_graph::document::Document;
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};
use halfvector_scene::{ImageStore, SceneMaterial};
use serde_json::json;

use crate::commands::check::measured::{Measured, Meter, Nanoseconds};
use crate::commands::check::stability::Judged;
use crate::failure::{FOUND, Failure, WRONG_INPUT};
use crate::input::{self, Kind};
use crate::output::{note, print, print_json};

/// Lists every problem of documents, with node, socket, reason and remedy.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:
  halfvector check examples/*.material.json --format json
  halfvector check --stability examples/unstable/cancellation.material.json
  halfvector check --stability --f16 examples/car-paint.material.json
  halfvector check --cost examples/rusted-iron.material.json

Exit code 3 when there is an error or, with --stability, something unstable, 1 when a file cannot be read, 0 when there are only warnings or nothing.")]
pub(crate) struct CheckArgs {
    /// Materials (*.material.json) or scenes (*.scene.json), whose materials are checked
    #[arg(value_name = "DOC", required = true)]
    documents: Vec<PathBuf>,
    /// Also runs each node in f32 and in f64 over the points and parameters that it may meet, and lists those that f32 gets
    /// wrong or that give no finite number; what jumps (floor, checker) is listed apart
    #[arg(long)]
    stability: bool,
    /// With --stability: also in f16, for targets that compute in half precision
    #[arg(long, requires = "stability")]
    f16: bool,
    /// Also estimates what each node and the whole shader cost under one directional light: instructions by class, reads of
    /// textures, bytes of uniforms. Where a device has timestamps (a software one, too) the time of a pixel is measured as well,
    /// and of each node what holding its outputs saves. Of many nodes the 20 costliest are listed; --format json has all
    #[arg(long)]
    cost: bool,
    /// How problems are written
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Format {
    /// A line for each problem, tables of what --stability finds
    #[default]
    Text,
    /// One JSON object
    Json,
}

/// A problem in a file.
struct Found {
    file: PathBuf,
    problem: Problem,
}

/// What --cost found in a file.
struct Costed {
    file: PathBuf,
    cost: Cost,
    /// The labels of the cost's nodes, in its order.
    labels: Vec<String>,
    /// By the device, or why not.
    measured: Result<Measured, String>,
}

/// Most nodes whose cost is listed as text, and measured.
const MOST_COSTED: usize = 20;

/// Most equal problems of a file that are listed as text.
const MOST_EQUAL: usize = 20;

/// Runs the command.
pub(crate) fn run(args: &CheckArgs) -> Result<u8, Failure> {
    let mut found = Vec::new();
    let mut judged = Vec::new();
    let mut costed = Vec::new();
    let mut meter = None;
    let mut unreadable = false;
    for path in &args.documents {
        match materials(path) {
            Ok(materials) => {
                for material in &materials {
                    let mut problems = problems(material);
                    let sound = problems.iter().all(|problem| problem.severity != Severity::Error);
                    if args.stability && sound {
                        match Judged::new(path, material, args.f16) {
                            Ok(found) => judged.push(found),
                            Err(message) => problems.push(of_document(message)),
                        }
                    }
                    if args.cost && sound {
                        match estimate(&material.document) {
                            Ok(cost) => {
                                let labels = labels(&material.document, &cost.nodes);
                                let meter = meter.get_or_insert_with(Meter::open);
                                let measured = meter.measure(material, &cost.nodes, MOST_COSTED);
                                costed.push(Costed { file: path.clone(), cost, labels, measured });
                            }
                            Err(more) => problems.extend(more),
                        }
                    }
                    found.extend(problems.into_iter().map(|problem| Found { file: path.clone(), problem }));
                }
            }
            Err(failure) => {
                unreadable = true;
                note(&failure);
                // As text the failure has been told; the JSON object holds everything.
                if args.format == Format::Json {
                    found.push(Found { file: path.clone(), problem: of_document(failure.line()) });
                }
            }
        }
    }
    match args.format {
        Format::Text => {
            let mut lines = problem_lines(&found);
            let is_sound = lines.is_empty() && !judged.iter().any(Judged::is_unstable);
            lines.extend(judged.iter().flat_map(Judged::lines));
            lines.extend(costed.iter().flat_map(cost_lines));
            if !unreadable && is_sound && costed.is_empty() {
                let all = lines.is_empty();
                let text = if all { "no problems" } else { "no problems: edges are where a node jumps, and are none" };
                lines.push(text.to_owned());
            }
            print(&lines.join("\n"))?;
        }
        Format::Json => {
            let mut result = json!({ "problems": found.iter().map(as_json).collect::<Vec<_>>() });
            if args.stability {
                stability::json(&judged, args.f16, &mut result);
            }
            if args.cost {
                result["cost"] = costed.iter().map(cost_json).collect();
            }
            print_json(&result)?;
        }
    }
    let has_error =
        found.iter().any(|f| f.problem.severity == Severity::Error) || judged.iter().any(Judged::is_unstable);
    Ok(match (unreadable, has_error) {
        (true, _) => WRONG_INPUT,
        (false, true) => FOUND,
        (false, false) => 0,
    })
}

/// A line for each problem; those that say the same of more than [`MOST_EQUAL`] nodes of a file are counted from there on.
fn problem_lines(found: &[Found]) -> Vec<String> {
    let mut counts = HashMap::new();
    let mut lines = Vec::new();
    let same = |f: &Found| (f.file.clone(), f.problem.severity, f.problem.message.clone());
    for f in found {
        let count = counts.entry(same(f)).or_insert(0_usize);
        *count += 1;
        if *count <= MOST_EQUAL {
            lines.push(format!("{}: {}", f.file.display(), f.problem));
        }
    }
    for f in found {
        if let Some(more) =
            counts.remove(&same(f)).and_then(|count| count.checked_sub(MOST_EQUAL)).filter(|more| *more > 0)
        {
            let (file, message) = (f.file.display(), &f.problem.message);
            let severity = if f.problem.severity == Severity::Error { "error" } else { "warning" };
            let nodes = if more == 1 { "node" } else { "nodes" };
            lines.push(format!(
                "{file}: {severity}: of {more} {nodes} more: {message}; `--format json` lists all of them"
            ));
        }
    }
    lines
}

fn as_json(found: &Found) -> serde_json::Value {
    let Problem { severity, group, node, node_label, socket, message } = &found.problem;
    json!({
        "file": found.file.display().to_string(),
        "severity": severity,
        "group": group,
        "node": node,
        "node_label": node_label,
        "socket": socket,
        "message": message,
    })
}

/// The materials of a file.
fn materials(path: &Path) -> Result<Vec<SceneMaterial>, Failure> {
    let directory = input::folder(path).to_owned();
    match input::kind(path)? {
        Kind::Material => Ok(vec![SceneMaterial { document: input::material(path)?, directory }]),
        Kind::Scene | Kind::Model => Ok(input::load_scene(path)?.materials),
    }
}

/// What is wrong with a material: what the document says of itself, then its images, then its shader.
fn problems(material: &SceneMaterial) -> Vec<Problem> {
    let document = &material.document;
    let mut problems = halfvector_graph::check::check(document, Library::standard());
    if problems.iter().any(|problem| problem.severity == Severity::Error) {
        return problems;
    }
    let mut images = ImageStore::default();
    if let Err(error) = images.load(std::slice::from_ref(material)) {
        problems.push(of_document(error.to_string()));
    }
    problems.extend(halfvector_scene::normal_map_problems(material, &images));
    for text in images.notes() {
        note(format_args!("note: {text}"));
    }
    if let Err(more) = shader(document) {
        problems.extend(more);
    }
    problems
}

/// What a material costs under one directional light.
fn estimate(document: &Document) -> Result<Cost, Vec<Problem>> {
    let needs = Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    halfvector_codegen::cost(&made(document, &needs)?).map_err(|error| vec![of_document(error.to_string())])
}

/// The total and one line for each of the dearest nodes, the dearest first.
fn cost_lines(costed: &Costed) -> Vec<String> {
    let Costed { file, cost, labels, measured } = costed;
    let classes = |i: Instructions| {
        format!(
            "{} instructions ({} arithmetic, {} transcendental, {} choices, {} texture reads)",
            i.total(),
            i.arithmetic,
            i.transcendental,
            i.choices,
            i.samples
        )
    };
    let per_turn = |is: bool| if is { "; loops that end by a value count once" } else { "" };
    let file = file.display();
    let mut lines = vec![format!(
        "{file}: cost, estimated: each pixel {}, each vertex {}; {} bytes of uniforms{}",
        classes(cost.fragment),
        cost.vertex.total(),
        cost.uniform_bytes,
        per_turn(cost.per_turn)
    )];
    lines.push(match measured {
        Ok(Measured { device, is_software, whole, .. }) => {
            let software = if *is_software { ", a software device" } else { "" };
            let nodes = "; of a node: what is saved when its outputs are held and what only it reads goes";
            let nodes = if cost.nodes.is_empty() { "" } else { nodes };
            format!("{file}: cost, measured: each pixel {} on {device}{software}{nodes}", in_words(whole))
        }
        Err(why) => format!("{file}: cost, not measured: {why}"),
    });
    let node_times = |at: usize| match measured.as_ref().ok().and_then(|measured| measured.nodes.get(at)) {
        Some(Ok(time)) => format!("; measured {}", in_words(time)),
        Some(Err(why)) => format!("; not measured: {why}"),
        None => String::new(),
    };
    let mut nodes: Vec<_> = cost.nodes.iter().zip(labels).enumerate().collect();
    nodes.sort_by_key(|(_, (node, _))| std::cmp::Reverse(node.instructions.total()));
    let others = nodes.split_off(nodes.len().min(MOST_COSTED));
    lines.extend(nodes.into_iter().map(|(at, (node, label))| {
        let NodeCost { node, instructions, per_turn: is_per_turn } = node;
        let (classes, per_turn) = (classes(*instructions), per_turn(*is_per_turn));
        format!("{file}: cost: `{label}` ({node}): {classes}{per_turn}{}", node_times(at))
    }));
    if !others.is_empty() {
        let sum = others.iter().map(|(_, (node, _))| u64::from(node.instructions.total())).sum::<u64>();
        let (count, nodes) = (others.len(), if others.len() == 1 { "node" } else { "nodes" });
        lines.push(format!(
            "{file}: cost: {count} {nodes} more: {sum} instructions together; `--format json` lists all of them"
        ));
    }
    lines
}

/// A time with its spread.
fn in_words(time: &Nanoseconds) -> String {
    format!("{:.2} ns (spread {:.2})", time.median, time.spread)
}

fn cost_json(costed: &Costed) -> serde_json::Value {
    let Costed { file, cost, labels, measured } = costed;
    let nodes = cost.nodes.iter().zip(labels).enumerate().map(|(at, (node, label))| {
        let time = measured.as_ref().map_err(String::as_str).and_then(|measured| match measured.nodes.get(at) {
            Some(Ok(time)) => Ok(time),
            Some(Err(why)) => Err(why.as_str()),
            None => Err("it was left out"),
        });
        json!({ "node": node.node, "label": label, "instructions": node.instructions,
            "total": node.instructions.total(), "per_turn": node.per_turn,
            "measured": time.ok().map(|time| json!({ "ns": time.median, "spread": time.spread })),
            "not_measured": time.err() })
    });
    let whole = measured.as_ref().ok().map(|measured| {
        let Measured { device, is_software, whole, .. } = measured;
        json!({ "device": device, "software": is_software, "ns": whole.median, "spread": whole.spread })
    });
    json!({
        "file": file.display().to_string(),
        "estimated": true,
        "fragment": cost.fragment,
        "fragment_total": cost.fragment.total(),
        "vertex": cost.vertex,
        "vertex_total": cost.vertex.total(),
        "uniform_bytes": cost.uniform_bytes,
        "per_turn": cost.per_turn,
        "measured": whole,
        "not_measured": measured.as_ref().err(),
        "nodes": nodes.collect::<Vec<_>>(),
    })
}

/// The labels of nodes; in a group after the group's.
fn labels(document: &Document, nodes: &[NodeCost]) -> Vec<String> {
    match flatten(document, Library::standard()) {
        Ok(flat) => nodes.iter().map(|node| node_label(&flat.document.graph, &flat.library, &node.node)).collect(),
        Err(_) => nodes.iter().map(|node| node.node.clone()).collect(),
    }
}

fn of_document(message: String) -> Problem {
    Problem { severity: Severity::Error, group: None, node: None, node_label: None, socket: None, message }
}

/// Makes and validates the shader for one light of each kind and an environment.
fn shader(document: &Document) -> Result<(), Vec<Problem>> {
    let needs = Needs {
        directional_lights: 1,
        point_lights: 1,
        spot_lights: 1,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    let shader = made(document, &needs)?;
    halfvector_codegen::validate(&shader).map(|_| ()).map_err(|error| vec![of_document(error.to_string())])
}

/// The shader of a material, or what is wrong with it: each problem by itself.
fn made(document: &Document, needs: &Needs) -> Result<Shader, Vec<Problem>> {
    halfvector_codegen::shader(document, Library::standard(), needs, Fold::Export).map_err(|error| match error {
        CodegenError::Problems(problems) => problems,
        other => vec![of_document(other.to_string())],
    })
}
