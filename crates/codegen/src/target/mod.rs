//! What a shader can be taken home as: one list of targets, one file each.
//!
//! Every target's vertex stage writes positions in that target's own clip space, given a `clip_from_world` made for it:
//! nothing is flipped on the way.

mod bevy;
mod glsl;
mod hlsl;
mod json;
mod msl;
mod spirv;
mod wgsl;

use halfvector_graph::needs::Needs;

use crate::{Shader, ValidationError, validate};

/// A form of shader.
pub struct Target {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, for people.
    pub help: &'static str,
    needs: fn(Needs) -> Needs,
    write: fn(&Source<'_>, &str) -> Result<Vec<OutputFile>, ExportError>,
}

/// All targets, in the order shown.
pub const TARGETS: &[Target] =
    &[wgsl::TARGET, glsl::TARGET, glsl::TARGET_ES, hlsl::TARGET, msl::TARGET, spirv::TARGET, bevy::TARGET];

/// The target with this name.
pub fn target(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|t| t.name == name)
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name, without folder.
    pub name: String,
    /// What stands in it.
    pub bytes: Vec<u8>,
}

/// Why a shader could not be exported.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExportError {
    /// The shader is no valid WGSL.
    #[error(transparent)]
    Invalid(#[from] ValidationError),
    /// naga cannot write it in this target's language.
    #[error("this shader cannot be written as {target}: {message}")]
    Backend {
        /// The target's name.
        target: &'static str,
        /// naga's words.
        message: String,
    },
}

/// What the targets read.
struct Source<'s> {
    shader: &'s Shader,
    valid: &'s crate::Valid,
}

impl Target {
    /// What a shader for this target is made for, in the place of what a scene needs: where the target is an engine with
    /// lights of its own it serves those.
    pub fn needs(&self, needs: Needs) -> Needs {
        (self.needs)(needs)
    }
}

/// A shader as files: the code, one file for each stage where the target wants that, and `NAME.json` with bindings,
/// parameters and vertex inputs; for an engine its plug-in. The shader was made for what [`Target::needs`] gives.
///
/// # Errors
/// The shader is not valid, or the target's language cannot express it.
pub fn export(shader: &Shader, target: &Target, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let valid = validate(shader)?;
    (target.write)(&Source { shader, valid: &valid }, name)
}

impl std::fmt::Debug for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Target").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Source<'_> {
    /// The two stages with their entry points and file endings.
    const STAGES: [(naga::ShaderStage, &'static str, &'static str); 2] =
        [(naga::ShaderStage::Vertex, "vs_main", "vert"), (naga::ShaderStage::Fragment, "fs_main", "frag")];

    /// One stage alone, without what only the other one uses.
    fn stage(&self, stage: naga::ShaderStage, target: &'static str) -> Result<crate::Valid, ExportError> {
        let mut module = self.valid.module.clone();
        module.entry_points.retain(|entry| entry.stage == stage);
        naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
        let info = crate::validate::validate_module(&module)
            .map_err(|(message, _)| ExportError::Backend { target, message })?;
        Ok(crate::Valid { module, info })
    }
}

fn file(name: String, bytes: impl Into<Vec<u8>>) -> OutputFile {
    OutputFile { name, bytes: bytes.into() }
}

/// The needs of a scene as they are.
fn same(needs: Needs) -> Needs {
    needs
}
