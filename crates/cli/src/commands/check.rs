//! `halfvector check`: everything that is wrong with documents.

use std::path::{Path, PathBuf};

use halfvector_codegen::{CodegenError, Cost, Fold, Instructions, NodeCost, Shader};
use halfvector_graph::check::{Problem, Severity, node_label};
use halfvector_graph::document::Document;
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};
use halfvector_reference::{Finding, Precision, Stability};
use halfvector_scene::{ImageStore, Scene, SceneMaterial};
use serde_json::json;

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
    /// wrong; what jumps (floor, checker) is listed apart
    #[arg(long)]
    stability: bool,
    /// With --stability: also in f16, for targets that compute in half precision
    #[arg(long, requires = "stability")]
    f16: bool,
    /// Also estimates what each node and the whole shader cost under one directional light: instructions by class, reads of
    /// textures, bytes of uniforms. Of many nodes the 20 costliest are listed; --format json has all
    #[arg(long)]
    cost: bool,
    /// How problems are written
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Format {
    /// One line each
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

/// What --stability found in a file.
struct Judged {
    file: PathBuf,
    stability: Stability,
    /// The same in f16, where that was asked for.
    half: Option<Stability>,
}

/// What --cost found in a file.
struct Costed {
    file: PathBuf,
    cost: Cost,
    /// The labels of the cost's nodes, in its order.
    labels: Vec<String>,
}

/// Most nodes whose cost is listed as text.
const MOST_COSTED: usize = 20;

/// Runs the command.
pub(crate) fn run(args: &CheckArgs) -> Result<u8, Failure> {
    let mut found = Vec::new();
    let mut judged = Vec::new();
    let mut costed = Vec::new();
    let mut unreadable = false;
    for path in &args.documents {
        match materials(path) {
            Ok(materials) => {
                for material in &materials {
                    let mut problems = problems(material);
                    let sound = problems.iter().all(|problem| problem.severity != Severity::Error);
                    if args.stability && sound {
                        match stability(material, args.f16) {
                            Ok((stability, half)) => judged.push(Judged { file: path.clone(), stability, half }),
                            Err(message) => problems.push(of_document(message)),
                        }
                    }
                    if args.cost && sound {
                        match estimate(&material.document) {
                            Ok(cost) => {
                                let labels = labels(&material.document, &cost.nodes);
                                costed.push(Costed { file: path.clone(), cost, labels });
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
                    found.push(Found { file: path.clone(), problem: of_document(failure.to_string()) });
                }
            }
        }
    }
    match args.format {
        Format::Text => {
            let mut lines: Vec<_> = found.iter().map(|f| format!("{}: {}", f.file.display(), f.problem)).collect();
            for Judged { file, stability, half } in &judged {
                for (number, stability) in std::iter::once(("f32", stability)).chain(half.iter().map(|s| ("f16", s))) {
                    lines.extend(stability.unstable.iter().map(|f| finding_line(file, "unstable", number, f)));
                    lines.extend(stability.edges.iter().map(|f| finding_line(file, "edge", number, f)));
                }
            }
            lines.extend(costed.iter().flat_map(cost_lines));
            if !unreadable && lines.is_empty() {
                lines.push("no problems".to_owned());
            }
            print(&lines.join("\n"))?;
        }
        Format::Json => {
            let mut result = json!({ "problems": found.iter().map(as_json).collect::<Vec<_>>() });
            if args.stability {
                let in_f32 = judged.iter().map(|j| (j.file.as_path(), &j.stability));
                stability_json(in_f32, "f32", &mut result);
                if args.f16 {
                    let in_f16 = judged.iter().filter_map(|j| Some((j.file.as_path(), j.half.as_ref()?)));
                    stability_json(in_f16, "f16", &mut result["f16"]);
                }
            }
            if args.cost {
                result["cost"] = costed.iter().map(cost_json).collect();
            }
            print_json(&result)?;
        }
    }
    let has_error = found.iter().any(|f| f.problem.severity == Severity::Error)
        || judged.iter().any(|j| std::iter::once(&j.stability).chain(&j.half).any(|s| !s.unstable.is_empty()));
    Ok(match (unreadable, has_error) {
        (true, _) => WRONG_INPUT,
        (false, true) => FOUND,
        (false, false) => 0,
    })
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

/// Writes the lists `unstable` and `edges` of what was judged in an arithmetic.
fn stability_json<'s>(
    judged: impl Iterator<Item = (&'s Path, &'s Stability)> + Clone,
    number: &str,
    result: &mut serde_json::Value,
) {
    let all = |of: fn(&Stability) -> &Vec<Finding>| -> Vec<serde_json::Value> {
        let each = |(file, stability)| of(stability).iter().map(move |f| finding_json(file, number, f));
        judged.clone().flat_map(each).collect()
    };
    result["unstable"] = all(|stability| &stability.unstable).into();
    result["edges"] = all(|stability| &stability.edges).into();
}

/// One row of the table: file, kind, node and output, both results, where. `number`: what was judged, f32 or f16.
fn finding_line(file: &Path, kind: &str, number: &str, finding: &Finding) -> String {
    let Finding { node, label, output, narrow, exact, input, not_finite, underflows, beyond_f16 } = finding;
    let place: Vec<String> = input.iter().map(|(name, x)| format!("{name} = {x}")).collect();
    let mut line = format!(
        "{}: {kind}: `{label}` ({node}.{output}): {number} gives {narrow}, exact is {exact}, {:.3e} apart, at {}",
        file.display(),
        finding.error(),
        if place.is_empty() { "its constants".to_owned() } else { place.join(", ") }
    );
    let below = format!("below {number}'s range");
    for (count, what) in
        [(not_finite, "infinite or no number"), (underflows, below.as_str()), (beyond_f16, "beyond f16's range")]
    {
        if *count > 0 {
            line += &format!("; {what} at {count} points");
        }
    }
    line
}

fn finding_json(file: &Path, number: &str, finding: &Finding) -> serde_json::Value {
    let Finding { node, label, output, narrow, exact, input, not_finite, underflows, beyond_f16 } = finding;
    // JSON has no infinity and no NaN: null.
    json!({
        "file": file.display().to_string(),
        "node": node,
        "node_label": label,
        "output": output,
        number: narrow,
        "f64": exact,
        "error": finding.error(),
        "input": input.iter().map(|(name, x)| (name.clone(), json!(x))).collect::<serde_json::Map<_, _>>(),
        "not_finite": not_finite,
        "underflows": underflows,
        "beyond_f16": beyond_f16,
    })
}

/// Runs a material's nodes in f32 and f64, and in f16 where that is asked for.
fn stability(material: &SceneMaterial, f16: bool) -> Result<(Stability, Option<Stability>), String> {
    let mut scene = Scene { materials: vec![material.clone()], ..Scene::default() };
    scene.load_images().map_err(|error| error.to_string())?;
    let judge = |precision| halfvector_reference::stability(&scene, 0, precision).map_err(|error| error.to_string());
    Ok((judge(Precision::Single)?, f16.then(|| judge(Precision::Half)).transpose()?))
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
    let Costed { file, cost, labels } = costed;
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
    let mut nodes: Vec<_> = cost.nodes.iter().zip(labels).collect();
    nodes.sort_by_key(|(node, _)| std::cmp::Reverse(node.instructions.total()));
    let others = nodes.split_off(nodes.len().min(MOST_COSTED));
    lines.extend(nodes.into_iter().map(|(node, label)| {
        let NodeCost { node, instructions, per_turn: is_per_turn } = node;
        format!("{file}: cost: `{label}` ({node}): {}{}", classes(*instructions), per_turn(*is_per_turn))
    }));
    if !others.is_empty() {
        let sum = others.iter().map(|(node, _)| u64::from(node.instructions.total())).sum::<u64>();
        let (count, nodes) = (others.len(), if others.len() == 1 { "node" } else { "nodes" });
        lines.push(format!(
            "{file}: cost: {count} {nodes} more: {sum} instructions together; `--format json` lists all of them"
        ));
    }
    lines
}

fn cost_json(costed: &Costed) -> serde_json::Value {
    let Costed { file, cost, labels } = costed;
    let nodes = cost.nodes.iter().zip(labels).map(|(node, label)| {
        json!({ "node": node.node, "label": label, "instructions": node.instructions,
            "total": node.instructions.total(), "per_turn": node.per_turn })
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
