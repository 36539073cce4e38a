//! `halfvector check`: everything that is wrong with documents.

use std::path::{Path, PathBuf};

use halfvector_codegen::Fold;
use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};
use halfvector_scene::{ImageStore, SceneMaterial};
use serde_json::json;

use crate::failure::{FOUND, Failure, WRONG_INPUT};
use crate::input::{self, Kind};
use crate::output::{note, print, print_json};

/// Lists every problem of documents, with node, socket, reason and remedy.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:
  halfvector check examples/*.material.json --format json

Exit code 3 when there is an error, 1 when a file cannot be read, 0 when there are only warnings or nothing.")]
pub(crate) struct CheckArgs {
    /// Materials (*.material.json) or scenes (*.scene.json), whose materials are checked
    #[arg(value_name = "DOC", required = true)]
    documents: Vec<PathBuf>,
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

/// Runs the command.
pub(crate) fn run(args: &CheckArgs) -> Result<u8, Failure> {
    let mut found = Vec::new();
    let mut unreadable = false;
    for path in &args.documents {
        match materials(path) {
            Ok(materials) => {
                let problems = materials.iter().flat_map(problems);
                found.extend(problems.map(|problem| Found { file: path.clone(), problem }));
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
        Format::Text if !unreadable && found.is_empty() => print("no problems")?,
        Format::Text => {
            let lines: Vec<_> = found.iter().map(|f| format!("{}: {}", f.file.display(), f.problem)).collect();
            print(&lines.join("\n"))?;
        }
        Format::Json => print_json(&json!({ "problems": found.iter().map(as_json).collect::<Vec<_>>() }))?,
    }
    let has_error = found.iter().any(|f| f.problem.severity == Severity::Error);
    Ok(match (unreadable, has_error) {
        (true, _) => WRONG_INPUT,
        (false, true) => FOUND,
        (false, false) => 0,
    })
}

fn as_json(found: &Found) -> serde_json::Value {
    let Problem { severity, node, node_label, socket, message } = &found.problem;
    json!({
        "file": found.file.display().to_string(),
        "severity": severity,
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
    if let Err(message) = shader(document) {
        problems.push(of_document(message));
    }
    problems
}

fn of_document(message: String) -> Problem {
    Problem { severity: Severity::Error, node: None, node_label: None, socket: None, message }
}

/// Makes and validates the shader for one light of each kind and an environment.
fn shader(document: &Document) -> Result<(), String> {
    let needs = Needs {
        directional_lights: 1,
        point_lights: 1,
        spot_lights: 1,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    let shader = halfvector_codegen::shader(document, Library::standard(), &needs, Fold::Export)
        .map_err(|error| error.to_string())?;
    halfvector_codegen::validate(&shader).map(|_| ()).map_err(|error| error.to_string())
}
