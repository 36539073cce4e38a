//! `halfvector export`: the shader of a material, to take away.

use std::path::PathBuf;

use halfvector_codegen::target::{OutputFile, TARGETS, Target, export, target};
use halfvector_codegen::{CodegenError, Shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene, SceneMaterial};
use serde_json::json;

use crate::budget::{self, Asked, Chosen};
use crate::environment::{bake, load};
use crate::failure::Failure;
use crate::input::{self, Kind};
use crate::output::{check_place, note, print_json, write_files};

/// Writes the shader of a material, and its bindings, parameters and vertex inputs as JSON.
///
/// Without --scene it serves one directional light, no environment and no tone map; with --target web it is the page of
/// what `halfvector render` draws: a sphere under the environment `studio`.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:
  halfvector export examples/plain-dielectric.material.json --target wgsl -o out
  halfvector export examples/car-paint.material.json --target web -o page
  halfvector export examples/rusted-iron.material.json --target glsl -o out --max-error 0.1 --explain")]
pub(crate) struct ExportArgs {
    /// A material (*.material.json)
    #[arg(value_name = "DOC")]
    document: PathBuf,
    #[arg(long, value_name = "TARGET", value_parser = parse_target, help = target_help())]
    target: Wanted,
    /// The folder for the files; made when missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Serve this scene's lights, environment and tone map; with --target web draw it. The material takes the place of the
    /// scene's first one, unless the scene has it already
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    methods: super::methods::MethodChoice,
    /// Choose the cheapest measured method of Fresnel, visibility, DFG, irradiance and compensation with which the
    /// material stays within this error: rms over mean of linear radiance on the sphere under `studio`, against the reference. Terms
    /// named by --method keep theirs, and so does diffuse, whose methods are different materials
    #[arg(long, value_name = "E", value_parser = parse_error)]
    max_error: Option<f64>,
    /// Print as JSON what was left out of the shader, why and what that saves, and what --max-error chose
    #[arg(long)]
    explain: bool,
}

/// What is exported.
#[derive(Clone, Copy, Debug)]
enum Wanted {
    /// A shader.
    Code(&'static Target),
    /// A page with everything that it draws.
    Page,
}

/// Name of the page's target.
const PAGE: &str = "web";

/// What is written, and what is told of it.
struct Export {
    shader: Shader,
    files: Vec<OutputFile>,
    chosen: Option<Chosen>,
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
    let Export { shader, files, chosen } = match args.target {
        Wanted::Code(target) => code(args, &document, target)?,
        Wanted::Page => page(args, document)?,
    };
    let paths: Vec<_> = files.iter().map(|file| args.output.join(&file.name)).collect();
    paths.iter().try_for_each(|path| check_place(path))?;
    let together: Vec<_> = paths.iter().zip(&files).map(|(path, file)| (path.as_path(), &file.bytes[..])).collect();
    write_files(&together)?;
    paths.iter().for_each(|path| note(path.display()));
    if args.explain {
        print_json(&explanation(&shader, chosen.as_ref()))?;
    }
    Ok(0)
}

/// The shader in a language.
fn code(args: &ExportArgs, document: &Document, target: &Target) -> Result<Export, Failure> {
    let mut needs = match &args.scene {
        None => plain_needs(),
        Some(path) => {
            let scene = input::load_scene(path)?;
            halfvector_scene::needs(&scene, ShaderOutput::Display(scene.tone_map))
        }
    };
    args.methods.apply(&mut needs.methods);
    let chosen = choose(args, document, &target.needs(needs.clone()), &|needs| target.needs(needs))?;
    if let Some(chosen) = &chosen {
        needs.methods = chosen.methods.clone();
    }
    let shader = shader(args, document, &target.needs(needs), chosen.as_ref())?;
    let files = export(&shader, target, &file_stem(args)).map_err(|error| failed(args, error))?;
    Ok(Export { shader, files, chosen })
}

/// The methods that keep the error that was asked for.
fn choose(
    args: &ExportArgs,
    document: &Document,
    needs: &Needs,
    target: &dyn Fn(Needs) -> Needs,
) -> Result<Option<Chosen>, Failure> {
    let Some(max_error) = args.max_error else { return Ok(None) };
    input::refuse_errors(&args.document, document)?;
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document.clone(), input::folder(&args.document), &sphere)
        .map_err(|error| failed(args, error))?;
    let kept = args.methods.terms();
    let chosen = budget::choose(Asked { scene, needs, kept, target, max_error })
        .map_err(|failure| failure.at(&args.document))?;
    note(chosen.in_words());
    Ok(Some(chosen))
}

/// A page with the scene, or with what `render` draws of the bare material.
fn page(args: &ExportArgs, document: Document) -> Result<Export, Failure> {
    let mut scene = match &args.scene {
        None => input::scene(&args.document, None)?,
        Some(path) => {
            let mut scene = input::load_scene(path)?;
            wear(&mut scene, &document, args)?;
            scene
        }
    };
    scene.name.clone_from(&document.name);
    args.methods.apply(&mut scene.methods);
    scene.notes.iter().for_each(|text| note(format_args!("note: {text}")));
    let needs = halfvector_scene::needs(&scene, ShaderOutput::Radiance);
    let chosen = choose(args, &document, &needs, &|needs| needs)?;
    if let Some(chosen) = &chosen {
        scene.methods = chosen.methods.clone();
    }
    let needs = Needs { methods: scene.methods.clone(), ..needs };
    let shader = shader(args, &document, &needs, chosen.as_ref())?;
    let loaded = load(&scene.environment)?;
    let environment = loaded.map(|loaded| bake(&scene, &loaded));
    let text = halfvector_web::page(&scene, environment.as_ref()).map_err(|error| failed(args, error))?;
    let files = vec![OutputFile { name: "index.html".to_owned(), bytes: text.into_bytes() }];
    Ok(Export { shader, files, chosen })
}

/// Puts the material in the place of the scene's first one, unless the scene has it.
fn wear(scene: &mut Scene, document: &Document, args: &ExportArgs) -> Result<(), Failure> {
    if scene.materials.iter().any(|material| material.document == *document) {
        return Ok(());
    }
    let material = SceneMaterial { document: document.clone(), directory: input::folder(&args.document).to_owned() };
    match scene.materials.first_mut() {
        Some(first) => *first = material,
        None => scene.materials.push(material),
    }
    scene
        .load_images()
        .map_err(|error| Failure::input("an image could not be loaded").at(&args.document).because(error))
}

fn shader(args: &ExportArgs, document: &Document, needs: &Needs, chosen: Option<&Chosen>) -> Result<Shader, Failure> {
    let remarks = chosen.map_or_else(Vec::new, Chosen::remarks);
    halfvector_codegen::explained(document, Library::standard(), needs, &remarks).map_err(|error| match error {
        CodegenError::Problems(errors) => input::has_errors(&args.document, document, &errors),
        error => failed(args, error),
    })
}

fn failed(args: &ExportArgs, error: impl std::fmt::Display) -> Failure {
    Failure::input("no shader could be made of the material").at(&args.document).because(error)
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

fn explanation(shader: &Shader, chosen: Option<&Chosen>) -> serde_json::Value {
    let dropped: Vec<_> = shader
        .dropped
        .iter()
        .map(|dropped| json!({ "what": dropped.what, "why": dropped.why, "instructions": dropped.instructions }))
        .collect();
    let nodes: Vec<_> = shader
        .dropped_nodes
        .iter()
        .map(|node| {
            json!({ "node": node.node, "label": node.label, "why": node.why, "instructions": node.instructions })
        })
        .collect();
    let slopes: Vec<_> = shader
        .slope_reads
        .iter()
        .map(|read| json!({ "node": read.node, "label": read.label, "why": read.why, "instructions": read.instructions }))
        .collect();
    let saved: u64 = shader.dropped_nodes.iter().filter_map(|node| node.instructions).map(u64::from).sum();
    let methods: serde_json::Map<_, _> =
        shader.methods.iter().map(|(term, method)| ((*term).to_owned(), json!(method))).collect();
    let mut explanation = json!({
        "dropped": dropped,
        "instructions_are": "what each thing alone would add to both stages, and what each node's function does, estimated on the text as `check --cost` does",
        "dropped_nodes": nodes,
        "dropped_nodes_instructions": saved,
        "slope_reads": slopes,
        "methods": methods,
    });
    if let Ok(cost) = halfvector_codegen::cost(shader) {
        explanation["instructions"] = json!({ "vertex": cost.vertex.total(), "fragment": cost.fragment.total() });
    }
    if let Some(chosen) = chosen {
        explanation["budget"] = chosen.json();
    }
    explanation
}

/// An error that can be asked for.
fn parse_error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error.is_finite() && error > 0.0 => Ok(error),
        _ => Err("an error is a number over 0, such as 0.05 for 5 %".to_owned()),
    }
}

fn target_help() -> String {
    let languages: Vec<_> = TARGETS.iter().map(|target| target.name).filter(|name| *name != "bevy").collect();
    format!(
        "The shading language: {}; or bevy: a material plug-in; or web: one page, index.html, that draws itself with WebGPU and needs \
         no network",
        languages.join(", ")
    )
}

fn parse_target(text: &str) -> Result<Wanted, String> {
    if text == PAGE {
        return Ok(Wanted::Page);
    }
    target(text).map(Wanted::Code).ok_or_else(|| {
        let names: Vec<_> = TARGETS.iter().map(|target| target.name).chain([PAGE]).collect();
        format!("the targets are {}", names.join(", "))
    })
}
