//! `halfvector export`: the shader of a material, to take away.

use std::path::PathBuf;

use halfvector_codegen::target::{TARGETS, Target, export, target};
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput};
use serde_json::json;

use crate::failure::Failure;
use crate::input::{self, Kind};
use crate::output::{check_place, note, print_json, write_file};

/// Writes the shader of a material, and its bindings, parameters and vertex inputs as JSON.
///
/// Without --scene it serves one directional light, no environment and no tone map.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:
  halfvector export examples/plain-dielectric.material.json --target wgsl -o out")]
pub(crate) struct ExportArgs {
    /// A material (*.material.json)
    #[arg(value_name = "DOC")]
    document: PathBuf,
    /// The shading language
    #[arg(long, value_name = "TARGET", value_parser = parse_target)]
    target: &'static Target,
    /// The folder for the files; made when missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Serve this scene's lights, environment and tone map
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    methods: super::methods::MethodChoice,
    /// Print what was left out of the shader, and why, as JSON
    #[arg(long)]
    explain: bool,
}

/// Runs the command.
pub(crate) fn run(args: &ExportArgs) -> Result<u8, Failure> {
    if args.output.exists() && !args.output.is_dir() {
        return Err(Failure::input("the files cannot be written there").at(&args.output).because("it is not a folder"));
    }
    if input::kind(&args.document)? != Kind::Material {
        return Err(Failure::input("only materials can be exported")
            .at(&args.document)
            .because("it is a scene or model")
            .try_to("a *.material.json file, with --scene for the scene that it stands in"));
    }
    let document = input::material(&args.document)?;
    input::refuse_errors(&args.document, &document)?;
    let mut needs = match &args.scene {
        None => plain_needs(),
        Some(path) => {
            let scene = input::load_scene(path)?;
            halfvector_scene::needs(&scene, ShaderOutput::Display(scene.tone_map))
        }
    };
    args.methods.apply(&mut needs.methods);
    let failed = |error: &dyn std::fmt::Display| {
        Failure::input("no shader could be made of the material").at(&args.document).because(error)
    };
    let shader = halfvector_codegen::shader(&document, Library::standard(), &needs, Fold::Export)
        .map_err(|error| failed(&error))?;
    let files = export(&shader, args.target, &file_stem(args)).map_err(|error| failed(&error))?;
    let paths: Vec<_> = files.iter().map(|file| args.output.join(&file.name)).collect();
    paths.iter().try_for_each(|path| check_place(path))?;
    for (file, path) in files.iter().zip(&paths) {
        write_file(path, &file.bytes)?;
        note(path.display());
    }
    if args.explain {
        print_json(&explanation(&shader))?;
    }
    Ok(0)
}

/// What a shader serves that is made for no scene: one directional light.
pub(crate) fn plain_needs() -> Needs {
    Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    }
}

/// The name of the files: the document's, without `.material.json`.
fn file_stem(args: &ExportArgs) -> String {
    let name = args.document.file_name().map_or_else(|| "material".into(), |name| name.to_string_lossy().into_owned());
    let name = name.strip_suffix(".json").unwrap_or(&name);
    name.strip_suffix(".material").unwrap_or(name).to_owned()
}

fn explanation(shader: &Shader) -> serde_json::Value {
    let dropped: Vec<_> =
        shader.dropped.iter().map(|dropped| json!({ "what": dropped.what, "why": dropped.why })).collect();
    json!({ "dropped": dropped })
}

fn parse_target(text: &str) -> Result<&'static Target, String> {
    target(text).ok_or_else(|| {
        let names: Vec<_> = TARGETS.iter().map(|target| target.name).collect();
        format!("the targets are {}", names.join(", "))
    })
}
