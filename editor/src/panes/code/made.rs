//! A shader as a target's text: made off the window's thread, with all that drawing it takes.

use std::sync::Arc;

use halfvector_codegen::target::{export, target};
use halfvector_codegen::{Fold, Shader, shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput};
use halfvector_scene::{Scene, needs};

use crate::panes::code::highlight::{Language, Span, highlight};
use crate::panes::code::lines::{Line, lines};
use crate::stage::Stage;

/// A shader that is wanted.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) document: Arc<Document>,
    pub(super) target: &'static str,
    pub(super) needs: Needs,
}

/// A shader, or why there is none.
#[derive(Debug)]
pub(super) struct Made {
    pub(super) target: &'static str,
    pub(super) result: Result<Ready, String>,
}

/// A text that is ready to be drawn.
#[derive(Debug)]
pub(super) struct Ready {
    pub(super) shader: Shader,
    /// The target's text files, one after the other; empty when they are no text.
    pub(super) text: Arc<str>,
    /// Size of all files.
    pub(super) bytes: usize,
    pub(super) lines: Vec<Line>,
    /// Coloured parts in order.
    pub(super) spans: Vec<Span>,
    /// What is said in the text's place.
    pub(super) note: Option<String>,
}

impl Ready {
    /// The target's files under another name.
    pub(super) fn files(&self, target_name: &str, name: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
        let target = target(target_name).ok_or_else(|| format!("there is no target {target_name}"))?;
        let files = export(&self.shader, target, name).map_err(|error| error.to_string())?;
        Ok(files.into_iter().map(|file| (file.name, file.bytes)).collect())
    }
}

/// One directional light, no environment, no tone map.
pub(super) fn plain_needs() -> Needs {
    Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    }
}

/// What the viewport shows.
pub(crate) fn needs_of(stage: &Stage) -> Needs {
    let scene = Scene {
        lights: stage.lights(),
        environment: stage.environment.clone(),
        environment_rotation: stage.environment_rotation,
        methods: stage.methods.clone(),
        ..Scene::default()
    };
    needs(&scene, ShaderOutput::Display(stage.tone_map))
}

/// Makes the shader.
pub(super) fn make(job: Job) -> Made {
    Made { target: job.target, result: ready(&job) }
}

fn ready(job: &Job) -> Result<Ready, String> {
    let target = target(job.target).ok_or_else(|| format!("there is no target {}", job.target))?;
    let needs = target.needs(job.needs.clone());
    let shader = shader(&job.document, Library::standard(), &needs, Fold::Export).map_err(|error| error.to_string())?;
    let files = export(&shader, target, "material").map_err(|error| error.to_string())?;
    let bytes = files.iter().map(|file| file.bytes.len()).sum();
    let shown = || files.iter().filter(|file| !file.name.ends_with(".json"));
    let texts: Vec<&str> = shown().filter_map(|file| std::str::from_utf8(&file.bytes).ok()).collect();
    let is_text = texts.len() == shown().count() && !texts.iter().any(|text| text.contains('\0'));
    let note = (!is_text).then(|| {
        let list = shown().map(|file| format!("{}, {} bytes", file.name, file.bytes.len()));
        format!(
            "This target is not text: {}. Export it to look at it with a disassembler.",
            list.collect::<Vec<_>>().join("; ")
        )
    });
    let text: Arc<str> = if is_text { texts.join("\n").into() } else { "".into() };
    let language = if job.target == "wgsl" { Language::Wgsl } else { Language::OfC };
    let spans = highlight(&text, language);
    // Segments speak of the WGSL itself.
    let segments = if *text == *shader.wgsl { shader.segments.as_slice() } else { &[] };
    Ok(Ready { lines: lines(&text, segments), spans, bytes, note, text, shader })
}
