//! The command line as a user meets it: each command, each kind of mistake, its exit code and its words.
//! Pictures need a GPU (a software one will do): without one those parts are skipped with a printed line, and fail when
//! `HALFVECTOR_REQUIRE_GPU=1`.

#[path = "cli/bake.rs"]
mod bake;
#[path = "cli/budget.rs"]
mod budget;
#[path = "cli/check.rs"]
mod check;
#[path = "cli/compare.rs"]
mod compare;
#[path = "cli/reference.rs"]
mod reference;
#[path = "cli/render.rs"]
mod render;
#[cfg(unix)]
#[path = "cli/report.rs"]
mod report;
#[path = "cli/window.rs"]
mod window;

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

const PLAIN: &str = r#"{"halfvector": 1, "name": "plain",
  "nodes": {"surface": {"node": "surface/surface", "values": {"base_color": [0.5, 0.2, 0.1]}}},
  "links": [],
  "parameters": [
    {"name": "base_color", "socket": "surface.base_color"},
    {"name": "metallic", "socket": "surface.metallic"}
  ]}"#;

/// A folder with a plain material in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        let folder = Folder(tempfile::tempdir().expect("a folder"));
        folder.write("plain.material.json", PLAIN);
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("written");
    }

    fn run(&self, arguments: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_halfvector"))
            .args(arguments)
            .current_dir(self.0.path())
            // No test opens a window.
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .stdin(Stdio::null())
            .output()
            .expect("the program starts");
        Run::new(arguments, &output)
    }

    /// Names of the files in the folder, sorted.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("the folder");
        let mut names: Vec<_> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

/// What a run said and how it ended.
struct Run {
    command: String,
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    fn new(arguments: &[&str], output: &Output) -> Run {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let run = Run {
            command: arguments.join(" "),
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        };
        assert!(!run.stderr.contains("panicked"), "{}: {}", run.command, run.stderr);
        run
    }

    #[track_caller]
    fn ends(self, code: i32) -> Run {
        assert_eq!(self.code, Some(code), "{}\n{}\n{}", self.command, self.stdout, self.stderr);
        self
    }

    #[track_caller]
    fn says(self, words: &str) -> Run {
        assert!(self.stderr.contains(words), "{}: `{words}` is not in\n{}", self.command, self.stderr);
        self
    }

    #[track_caller]
    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|e| panic!("{}: {e} in\n{}", self.command, self.stdout))
    }

    /// Whether the run failed for want of a GPU; then a line is printed.
    fn lacks_gpu(&self) -> bool {
        let lacks = self.code == Some(1) && self.stderr.contains("no GPU was found");
        if lacks {
            assert!(std::env::var("HALFVECTOR_REQUIRE_GPU").as_deref() != Ok("1"), "{}", self.stderr);
            assert!(self.stderr.contains("mesa-vulkan-drivers"));
            println!("skipped: {} needs a GPU", self.command);
        }
        lacks
    }
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new();
    for command in ["", "render", "export", "check", "compare", "bake", "nodes", "methods", "report"] {
        let arguments: Vec<_> = [command, "--help"].into_iter().filter(|a| !a.is_empty()).collect();
        let help = folder.run(&arguments).ends(0).stdout;
        assert!(help.contains("Example") && help.contains("halfvector"), "{command}: {help}");
    }
    folder.run(&["paint"]).ends(2);
    folder.run(&["--version"]).ends(0);
}

#[test]
fn wrong_usage_ends_with_2_before_any_work() {
    let folder = Folder::new();
    let render = |more: &[&str]| {
        let mut arguments = vec!["render", "plain.material.json"];
        arguments.extend(more);
        folder.run(&arguments).ends(2)
    };
    render(&[]).says("--output");
    render(&["-o", "a.jpg"]).says(".png, .exr or .hdr");
    for (option, value, words) in [
        ("--size", "0x4", "WIDTHxHEIGHT"),
        ("--size", "100000x100000", "smaller size"),
        ("--samples", "0", "a whole number from 1 to 1048576"),
        ("--samples", "many", "a whole number from 1 to 1048576"),
        ("--backend", "abacus", "gpu, cpu and reference"),
        ("--light", "candle:1", "candle"),
        ("--tone-map", "sepia", "pbr-neutral"),
        ("--background", "blue", "R,G,B"),
        ("--exposure", "inf", "not finite"),
        ("--env-rotation", "north", "not a number"),
        ("--method", "v=square", "correlated"),
        ("--method", "w=x", "no term"),
        ("--method", "v", "TERM=NAME"),
        ("--preset", "best", "report"),
        ("--set", "metallic", "PARAMETER=VALUE"),
        ("--mesh", "teapot", "shaderball"),
    ] {
        render(&["-o", "a.png", option, value]).says(words);
    }
    render(&["-o", "a.exr", "--method", "encode=report"]).says("encode=srgb");
    folder.run(&["export", "plain.material.json", "--target", "cobol", "-o", "x"]).ends(2).says("spirv");
    folder.run(&["check"]).ends(2);
    folder.run(&["nodes", "--format", "xml"]).ends(2);
    assert_eq!(folder.names(), ["plain.material.json"]);
}

#[test]
fn wrong_input_ends_with_1_and_says_where() {
    let folder = Folder::new();
    folder.write("broken.material.json", "{\"halfvector\": 1,\n  \"nodes\": {");
    folder.write("list.json", "[]");
    folder.write("other.json", "{\"a\": 1}");
    folder.write(
        "lost.scene.json",
        r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "material": "gone.material.json"}]}"#,
    );
    folder.write("wrong.scene.json", r#"{"halfvector": 1, "objects": [{"mesh": "teapot"}]}"#);
    folder.write("bad.glb", "glTF");
    folder.write("bad.hdr", "#?RADIANCE\nnonsense");
    folder.write(
        "unknown.material.json",
        r#"{"halfvector": 1, "nodes": {"surface": {"node": "surface/surface", "values": {"metallic": "shiny"}}}, "links": []}"#,
    );
    folder.write("empty.material.json", r#"{"halfvector": 1, "nodes": {}, "links": []}"#);
    let before = folder.names();
    for (input, words) in [
        ("missing.material.json", "missing.material.json"),
        ("broken.material.json", "line 2"),
        ("list.json", "neither a material nor a scene"),
        ("other.json", "neither `nodes`"),
        ("lost.scene.json", "gone.material.json"),
        ("wrong.scene.json", "teapot"),
        ("bad.glb", "bad.glb"),
        ("unknown.material.json", "metallic"),
        ("empty.material.json", "surface"),
        #[cfg(target_os = "linux")]
        ("/dev/zero", "too large"),
        (".", "could not be read"),
    ] {
        let run = folder.run(&["render", input, "-o", "a.png"]).ends(1).says(words).says("error: ");
        assert!(run.stdout.is_empty());
    }
    let render = |more: &[&str]| {
        let mut arguments = vec!["render", "plain.material.json", "-o", "a.png", "--size", "8x8"];
        arguments.extend(more);
        folder.run(&arguments)
    };
    render(&["--set", "shine=1"]).ends(1).says("base_color, metallic");
    render(&["--set", "metallic=1,2"]).ends(1).says("1 number");
    render(&["--mesh", "gone.glb"]).ends(1).says("gone.glb");
    folder.run(&["render", "plain.material.json", "-o", "plain.material.json/a.png"]).ends(1).says("not a folder");
    render(&["--env", "gone.hdr"]).ends(1).says("gone.hdr");
    render(&["--env", "bad.hdr"]).ends(1).says("bad.hdr");
    folder.run(&["export", "wrong.scene.json", "--target", "wgsl", "-o", "x"]).ends(1).says("only materials");
    folder.run(&["export", "plain.material.json", "--target", "wgsl", "-o", "list.json"]).ends(1).says("not a folder");
    assert_eq!(folder.names(), before, "nothing is written");
}

/// Names from documents reach the terminal as text, never as commands to it.
#[test]
fn a_terminal_is_sent_no_commands() {
    let folder = Folder::new();
    let esc = "\\u001b[2J\\u0007\\u009b1m\\u202e";
    let code = format!("[\"fn f(x: f32) -> f32 {{ // {esc}\", \"return 1; /* {esc} */ $ }}\"]");
    folder.write(
        "bad.material.json",
        &format!(
            r#"{{"halfvector": 1, "name": "{esc}",
              "nodes": {{"n{esc}": {{"node": "math/{esc}", "label": "a{esc}\\nplain.material.json: error: forged"}},
                "f\\nplain.material.json: error: forged": {{"node": "custom/f"}},
                "image": {{"node": "textures/image", "values": {{"image": {{"file": "/{esc}.png", "color_space": "srgb"}}}}}},
                "surface": {{"node": "surface/surface", "values": {{"{esc}": 1}}}}}},
              "functions": {{"f": {code}}},
              "links": [{{"from": "image.{esc}", "to": "surface.{esc}"}}], "{esc}": 1}}"#
        ),
    );
    folder.write("text.material.json", &format!("{{\"halfvector\": 1, \"nodes\": {{\"{esc}\": 1}}, \"links\": []}}"));
    let image = r#"{"halfvector": 1, "nodes": {"image": {"node": "textures/image", "values": {"image": {"file": "FILE", "color_space": "srgb"}}},
        "surface": {"node": "surface/surface"}}, "links": [{"from": "image.color", "to": "surface.base_color"}]}"#;
    folder.write("lost.material.json", &image.replace("FILE", &format!("{esc}.png")));
    let named = "\u{1b}[31m\u{202e}.material.json";
    #[cfg(unix)]
    folder.write(named, "{");
    for file in ["bad.material.json", "text.material.json", "lost.material.json", named] {
        for arguments in [
            &["check", file][..],
            &["check", file, "--format", "json"],
            &["export", file, "--target", "wgsl", "-o", "x"],
        ] {
            let run = folder.run(arguments);
            assert!(run.code != Some(0) || arguments[0] == "export", "{}", run.stdout);
            for text in [&run.stdout, &run.stderr] {
                let is_obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
                assert!(!text.contains(is_obeyed), "{arguments:?}: {text:?}");
                assert!(!text.lines().any(|line| line.starts_with("plain.material.json")), "{arguments:?}: {text}");
            }
        }
    }
    let problems = folder.run(&["check", "bad.material.json", "--format", "json"]).json();
    let nodes: Vec<&str> =
        problems["problems"].as_array().expect("a list").iter().filter_map(|p| p["node"].as_str()).collect();
    assert!(nodes.contains(&"n\u{1b}[2J\u{7}\u{9b}1m\u{202e}"), "a reader of the JSON has the names: {nodes:?}");
}

#[test]
fn lists_are_one_json_object() {
    let folder = Folder::new();
    let nodes = folder.run(&["nodes", "--format", "json"]).ends(0);
    let list = nodes.json();
    assert!(list["nodes"].as_array().expect("a list").len() >= 60);
    assert!(list["nodes"][0]["id"].is_string() && list["nodes"][0]["label"].is_string());
    assert!(nodes.stderr.is_empty());
    let methods = folder.run(&["methods", "--format", "json"]).ends(0).json();
    assert!(methods["methods"].as_array().is_some_and(|list| !list.is_empty()));
    for command in ["nodes", "methods"] {
        assert!(folder.run(&[command]).ends(0).stdout.starts_with("# "));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(["nodes", "--format", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    Run::new(&["nodes | true"], &output).ends(0);
}

#[test]
fn export_writes_each_target() {
    let folder = Folder::new();
    for (target, names) in [
        ("wgsl", vec!["plain.json", "plain.wgsl"]),
        ("glsl", vec!["plain.frag", "plain.json", "plain.vert"]),
        ("glsl-es", vec!["plain.frag", "plain.json", "plain.vert"]),
        ("hlsl", vec!["plain.hlsl", "plain.json"]),
        ("msl", vec!["plain.json", "plain.metal"]),
        ("spirv", vec!["plain.frag.spv", "plain.json", "plain.vert.spv"]),
    ] {
        folder.run(&["export", "plain.material.json", "--target", target, "-o", target]).ends(0);
        let entries = std::fs::read_dir(folder.path(target)).expect("the folder");
        let mut found: Vec<_> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        found.sort();
        assert_eq!(found, names, "{target}");
    }
    let wgsl = std::fs::read_to_string(folder.path("wgsl/plain.wgsl")).expect("the shader");
    assert!(wgsl.contains("fn fs_main") && !wgsl.contains("texture_cube"), "{wgsl}");

    folder.write(
        "lit.scene.json",
        r#"{"halfvector": 1, "objects": [{"mesh": "sphere", "material": "plain.material.json"}], "environment": "studio"}"#,
    );
    let arguments =
        ["export", "plain.material.json", "--target", "wgsl", "-o", "lit", "--scene", "lit.scene.json", "--explain"];
    let explained = folder.run(&arguments).ends(0).json();
    assert!(explained["dropped"].as_array().is_some_and(|list| !list.is_empty()), "{explained}");
    let lit = std::fs::read_to_string(folder.path("lit/plain.wgsl")).expect("the shader");
    assert!(lit.contains("texture_cube"), "{lit}");
}

#[test]
fn a_report_is_compared_with_an_older_one() {
    let folder = Folder::new();
    let report = |more: &[&str]| folder.run(&[&["report", "--quick", "--only", "mips", "-o", "out"], more].concat());
    report(&[]).ends(0).says("index.html");
    let text = |name: &str| std::fs::read_to_string(folder.path(name)).expect("written");
    assert!(text("out/index.html").contains("<svg") && text("out/mips.csv").starts_with("term,method,"));
    let mut old: serde_json::Value = serde_json::from_str(&text("out/report.json")).expect("JSON");
    let measured = old.clone();
    // Times of a busy machine: none is compared.
    for row in old["rows"].as_array_mut().expect("rows") {
        row["cost_ns"] = serde_json::Value::Null;
    }
    folder.write("old.json", &old.to_string());
    report(&["--compare", "old.json"]).ends(0);
    old["rows"][0]["error_rms"] = 1e-3.into();
    // A hundredth of what any machine takes, and the yardstick stays: this is slower however busy the machine is.
    for key in ["cost_ns", "cost_spread", "yardstick_ns"] {
        old["rows"][0][key] = measured["rows"][0][key].clone();
    }
    old["rows"][0]["cost_ns"] = (1e-2 * measured["rows"][0]["cost_ns"].as_f64().expect("a time")).into();
    old["rows"][1] = measured["rows"][1].clone();
    old["rows"][2] = measured["rows"][2].clone();
    folder.write("old.json", &old.to_string());
    let run = report(&["--compare", "old.json"]).ends(3).says("mips: measured again").says("figures that are worse: 2");
    assert!(run.stderr.contains("(1 of at most 5 times, about ") && run.stderr.contains(" more)"), "{}", run.stderr);
    assert!(run.stdout.contains("less accurate: normal_mips"), "{}", run.stdout);
    assert!(run.stdout.contains("slower: normal_mips unchanged: one call takes"), "{}", run.stdout);
}

#[test]
fn what_cannot_be_compared_is_told_before_anything_is_measured() {
    let folder = Folder::new();
    let compared =
        |name: &str| folder.run(&["report", "--quick", "--only", "mips", "-o", "out", "--compare", name]).ends(1);
    folder.write("old.json", "{}");
    compared("old.json").says("it is not a report");
    compared("missing.json").says("cannot be read");
    compared(".").says("cannot be read");
    let of = |schema: u32, parts: &str, rows: &str| {
        let text = format!(
            r#"{{"schema": {schema}, "machine": "m", "date": "2026-01-01", "effort": "quick", "parts": [{parts}], "rows": [{rows}]}}"#
        );
        folder.write("old.json", &text);
    };
    of(7, "", "");
    compared("old.json").says("its layout is version 7; this program reads version 1");
    of(1, r#""brdf""#, r#"{"part": "brdf", "term": "d", "method": "ggx", "domain": "all"}"#);
    compared("old.json").says("it holds brdf; measured would be mips");
    of(1, r#""mips""#, "");
    compared("old.json").says("it holds no part that was measured to its end");
    folder.run(&["report", "--only", "paint", "-o", "out"]).ends(2).says("paint");
    folder.write("file", "");
    folder.run(&["report", "--quick", "--only", "mips", "-o", "file"]).ends(1).says("file");
    assert!(!folder.path("out").exists());
}
