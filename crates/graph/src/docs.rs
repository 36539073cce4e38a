//! The library and the methods as documents: Markdown for people, JSON for programs.

use std::fmt::Write;

use serde_json::{Value as Json, json};

use crate::figures::{error_in_words, figure};
use crate::library::Library;
use crate::method::{Method, TERMS};
use crate::node_def::{Default, Input, NodeDef};
use crate::value::{ColorSpace, SocketType, Value};

/// All nodes, by category, with sockets, defaults, ranges and help.
pub fn nodes_markdown(library: &Library) -> String {
    let mut out = String::from(
        "# Nodes\n\nGenerated from the doc comments under `shaders/nodes/`. A node is a WGSL function; `T` stands for the widest type that comes into the node.\nPatterns are averaged over the pixel, so that they do not alias.\n",
    );
    let mut category = "";
    for def in library.iter() {
        let own = def.id.split('/').next().unwrap_or("");
        if own != category {
            category = own;
            let example = format!("nodes/{category}.material.json");
            let _ = write!(out, "\n## {category}\n\nAll of them at work: [{example}](../examples/{example}).\n");
        }
        node_markdown(def, &mut out);
    }
    out
}

fn node_markdown(def: &NodeDef, out: &mut String) {
    let _ = write!(out, "\n### {}\n\n`{}`", def.label, def.id);
    if !def.generic.is_empty() {
        let types: Vec<&str> = def.generic.iter().map(|ty| ty.wgsl()).collect();
        let _ = write!(out, ", T = {}", types.join(", "));
    }
    if !def.synonyms.is_empty() {
        let _ = write!(out, "; also: {}", def.synonyms.join(", "));
    }
    let _ = write!(out, "\n\n{}\n", help_markdown(&def.help));
    if !def.inputs.is_empty() {
        out.push_str("\n| input | type | default | range | unit | |\n|---|---|---|---|---|---|\n");
        for input in &def.inputs {
            let range = input.range.map_or(String::new(), |[lo, hi]| format!("{lo} to {hi}"));
            let _ = writeln!(
                out,
                "| `{}` | {} | {} | {range} | {} | {} |",
                input.name,
                type_name(input.ty),
                default_text(&input.default),
                input.unit,
                cell(&input.help)
            );
        }
    }
    out.push_str("\n| output | type | |\n|---|---|---|\n");
    for output in &def.outputs {
        let _ = writeln!(out, "| `{}` | {} | {} |", output.name, type_name(output.ty), cell(&output.help));
    }
}

/// Help with its indented lines, equations, in a block of their own: Markdown would run them together.
fn help_markdown(help: &str) -> String {
    let mut out = String::new();
    let mut in_block = false;
    for line in help.lines() {
        let equation = line.strip_prefix("  ");
        if equation.is_some() != in_block {
            out.push_str(if in_block { "```\n\n" } else { "\n```text\n" });
            in_block = !in_block;
        }
        let _ = writeln!(out, "{}", equation.unwrap_or(line));
    }
    if in_block {
        out.push_str("```\n");
    }
    out.trim().into()
}

/// Text for a cell of a table: a bar would end it.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

fn type_name(ty: SocketType) -> &'static str {
    match ty {
        SocketType::Value(ty) => ty.wgsl(),
        SocketType::Generic => "T",
        SocketType::Texture => "picture",
        SocketType::Surface => "surface",
    }
}

fn default_text(default: &Default) -> String {
    match default {
        Default::Value(Value::Bool(b)) => b.to_string(),
        Default::Value(value) => {
            let numbers: Vec<String> = value.components().unwrap_or(&[]).iter().map(f32::to_string).collect();
            numbers.join(", ")
        }
        Default::Context(name) => format!("`{name}`"),
        Default::Image(ColorSpace::Srgb) => "a picture, sRGB".into(),
        Default::Image(ColorSpace::Linear) => "a picture, linear".into(),
        Default::Surface => "a surface".into(),
    }
}

/// All terms and their methods.
pub fn methods_markdown() -> String {
    let mut out = String::from(
        "# Methods\n\nChosen with `--method TERM=NAME`; the first of each term is the default. Errors are rms, as measured; times on the CPU are \
         beside the default's; instructions are those of one plain shader's fragment stage with the method. What was measured, and \
         how, stands in docs/accuracy.md.\n",
    );
    for term in TERMS {
        let _ = write!(
            out,
            "\n## {}\n\n{}. The report uses `{}`.\n\n| method | error | time | instructions | source |\n|---|---|---|---|---|\n",
            term.name,
            capitalised(term.help),
            term.report
        );
        for method in term.methods {
            let figure = figure(term.name, method.name);
            let error = figure.map_or(String::new(), error_in_words);
            let time = figure.and_then(|figure| figure.time_beside_default);
            let time = time.map_or(String::new(), |time| format!("{time:.2}"));
            let instructions = figure.and_then(|figure| figure.instructions);
            let instructions = instructions.map_or(String::new(), |count| count.to_string());
            let source = cell(method.source);
            let _ = writeln!(out, "| `{}` | {error} | {time} | {instructions} | {source} |", method.name);
        }
    }
    out
}

/// A text with a capital letter first.
pub fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

/// `{"nodes": [{"id", "label", "help", "synonyms", "generic", "inputs", "outputs", "file"}]}`, in order of id. Numbers without
/// bound in a range are null.
pub fn nodes_json(library: &Library) -> Json {
    let nodes: Vec<Json> = library
        .iter()
        .map(|def| {
            let outputs: Vec<Json> = def
                .outputs
                .iter()
                .map(|output| json!({"name": output.name, "type": type_name(output.ty), "help": output.help}))
                .collect();
            json!({
                "id": def.id,
                "label": def.label,
                "help": def.help,
                "synonyms": def.synonyms,
                "generic": def.generic.iter().map(|ty| ty.wgsl()).collect::<Vec<_>>(),
                "inputs": def.inputs.iter().map(input_json).collect::<Vec<_>>(),
                "outputs": outputs,
                "file": def.file,
            })
        })
        .collect();
    json!({ "nodes": nodes })
}

fn input_json(input: &Input) -> Json {
    let default = match &input.default {
        Default::Value(Value::Bool(b)) => json!(b),
        Default::Value(Value::Number(x)) => json!(x),
        Default::Value(value) => json!(value.components()),
        Default::Context(name) => json!({ "context": name }),
        Default::Image(space) => json!({ "image": space }),
        Default::Surface => Json::Null,
    };
    json!({
        "name": input.name,
        "type": type_name(input.ty),
        "default": default,
        "range": input.range,
        "unit": input.unit,
        "help": input.help,
    })
}

/// `{"methods": [{"term", "help", "default", "report", "methods": [{"name", "source", "figures"}]}]}`; figures are null where
/// the method was not measured, else `{"error_rms", "error_max", "unit", "time_beside_default", "instructions", "gpu_ns",
/// "bytes", "inputs"}`; see [`crate::figures::Figure`].
pub fn methods_json() -> Json {
    let terms: Vec<Json> = TERMS
        .iter()
        .map(|term| {
            let methods: Vec<Json> =
                term.methods.iter().map(|method| method_json(term.name, method)).collect();
            json!({"term": term.name, "help": term.help, "default": term.methods[0].name, "report": term.report, "methods": methods})
        })
        .collect();
    json!({ "methods": terms })
}

fn method_json(term: &str, method: &Method) -> Json {
    let figures = figure(term, method.name).map(|figure| {
        json!({
            "error_rms": figure.error_rms, "error_max": figure.error_max, "unit": figure.unit,
            "time_beside_default": figure.time_beside_default, "instructions": figure.instructions, "gpu_ns": figure.gpu_ns, "bytes": figure.bytes, "inputs": figure.inputs,
        })
    });
    json!({"name": method.name, "source": method.source, "figures": figures})
}

#[cfg(test)]
mod tests {
    use super::help_markdown;

    #[test]
    fn equations_stand_in_blocks() {
        assert_eq!(help_markdown("Two lines\nof text."), "Two lines\nof text.");
        assert_eq!(help_markdown("With T:\n  u = 1\n  v = 2\nheld."), "With T:\n\n```text\nu = 1\nv = 2\n```\n\nheld.");
        assert_eq!(help_markdown("A:\n  u = 1"), "A:\n\n```text\nu = 1\n```");
    }
}
