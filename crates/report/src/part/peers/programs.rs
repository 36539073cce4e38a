//! Programs that are called: Python with Mitsuba and with MaterialX, a compiler of GLSL, an optimiser of SPIR-V. What does not work
//! says why, in words that end a sentence.

use std::path::Path;
use std::process::{Command, Stdio};

use super::super::shaders::counted;

/// Mitsuba's rates.
const MITSUBA: &str = include_str!("../../../peers/mitsuba_rates.py");

/// MaterialX's shader.
const MATERIAL_X: &str = include_str!("../../../peers/materialx_shader.py");

/// What MaterialX's generator made.
pub(super) struct Generated {
    pub(super) version: String,
    pub(super) milliseconds: f64,
    /// Of the fragment stage, optimised.
    pub(super) instructions: u64,
}

/// Runs a program to its end: what it printed.
fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output =
        command.stdin(Stdio::null()).output().map_err(|error| format!("{name} could not be started ({error})"))?;
    if output.status.success() {
        return String::from_utf8(output.stdout).map_err(|_| format!("{name} printed what is no text"));
    }
    // The last line of a Python program that fails says why.
    let said = String::from_utf8_lossy(&output.stderr);
    let why = said.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("no reason given");
    let short: String = why.trim().chars().take(200).collect();
    Err(format!("{name} ended with {}: {short}", output.status))
}

fn python(script: &str, argument: &str) -> Result<serde_json::Value, String> {
    let text = output(Command::new("python3").args(["-c", script, argument]))?;
    serde_json::from_str(&text).map_err(|error| format!("python3 printed something else: {error}"))
}

fn number(value: &serde_json::Value, name: &str) -> Result<f64, String> {
    value[name].as_f64().filter(|x| *x > 0.0).ok_or_else(|| format!("python3 printed no {name}"))
}

fn text(value: &serde_json::Value, name: &str) -> Result<String, String> {
    value[name].as_str().map(str::to_owned).ok_or_else(|| format!("python3 printed no {name}"))
}

/// Mitsuba's version, and its evaluations in millions a second.
pub(super) fn mitsuba_rate(rounds: usize) -> Result<(String, f64), String> {
    let found = python(MITSUBA, &rounds.to_string())?;
    Ok((text(&found, "version")?, number(&found, "evaluations")?))
}

/// MaterialX's generator.
pub(super) fn generated() -> Result<Generated, String> {
    let found = python(MATERIAL_X, "")?;
    let (version, shader) = (text(&found, "version")?, text(&found, "shader")?);
    let instructions = in_folder(|folder| {
        let (source, spirv) = (folder.join("m.frag"), folder.join("m.spv"));
        write(&source, shader.as_bytes())?;
        output(Command::new("glslangValidator").arg("-V").arg(&source).arg("-o").arg(&spirv))?;
        optimised(folder, &spirv)
    })?;
    Ok(Generated { version, milliseconds: number(&found, "milliseconds")?, instructions })
}

/// Instructions of a fragment stage in SPIR-V after spirv-opt -O.
pub(super) fn optimised_instructions(spirv: &[u8]) -> Result<u64, String> {
    in_folder(|folder| {
        let path = folder.join("ours.spv");
        write(&path, spirv)?;
        optimised(folder, &path)
    })
}

fn optimised(folder: &Path, spirv: &Path) -> Result<u64, String> {
    let small = folder.join("small.spv");
    output(Command::new("spirv-opt").arg("-O").arg(spirv).arg("-o").arg(&small))?;
    let bytes = std::fs::read(&small).map_err(|error| format!("spirv-opt wrote nothing ({error})"))?;
    let words: Vec<u32> = bytes.as_chunks::<4>().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
    counted(&words).ok_or_else(|| "spirv-opt wrote something else".to_owned())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| format!("{} could not be written ({error})", path.display()))
}

/// Work in a folder of its own that is gone afterwards.
fn in_folder<T>(work: impl FnOnce(&Path) -> Result<T, String>) -> Result<T, String> {
    let folder = std::env::temp_dir().join(format!("halfvector-report-shader-{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|error| format!("{} could not be made ({error})", folder.display()))?;
    let result = work(&folder);
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_work_says_why() {
        let absent = output(&mut Command::new("no-such-program")).expect_err("no program");
        assert!(absent.starts_with("no-such-program could not be started ("), "{absent}");
        if Command::new("python3").arg("--version").output().is_err() {
            println!("skipped: no python3");
            return;
        }
        let failed = python("import no_such_module", "").expect_err("no module");
        assert!(failed.contains("No module named 'no_such_module'"), "{failed}");
        assert_eq!(python("print('{}')", "").map(|value| number(&value, "x").is_err()), Ok(true));
    }
}
