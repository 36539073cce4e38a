//! The command line as a user meets it: each command, each kind of mistake, its exit code and its words.
//! Pictures need a GPU (a software one will do): without one those parts are skipped with a printed line, and fail when
//! `HALFVECTOR_REQUIRE_GPU=1`.

#[path = "cli/bake.rs"]
mod bake;
#[path = "cli/budget.rs"]
mod budget;
#[path = "cli/compare.rs"]
mod compare;
#[path = "cli/reference.rs"]
mod reference;
#[cfg(unix)]
#[path = "cli/report.rs"]
mod report;
#[path = "cli/window.rs"]
mod window;

use std::path::{Path, PathBuf};
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
        ("--samples", "0", "1..=1048576"),
        ("--samples", "many", "invalid digit"),
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

#[test]
fn check_tells_all_problems() {
    let folder = Folder::new();
    folder.write(
        "bad.material.json",
        r#"{"halfvector": 1, "name": "bad", "nodes": {
            "surface": {"node": "surface/surface", "label": "Skin", "values": {"metallic": [1, 2], "shine": 3}},
            "what": {"node": "math/nothing"}},
          "links": [{"from": "what.out", "to": "surface.base_color"}]}"#,
    );
    let sound = folder.run(&["check", "plain.material.json"]).ends(0);
    assert_eq!(sound.stdout.trim(), "no problems");
    let empty = folder.run(&["check", "plain.material.json", "--format", "json"]).ends(0).json();
    assert_eq!(empty, serde_json::json!({ "problems": [] }));

    let text = folder.run(&["check", "plain.material.json", "bad.material.json"]).ends(3).stdout;
    for words in ["bad.material.json", "Skin", "metallic", "shine", "math/nothing"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let run = folder.run(&["check", "bad.material.json", "--format", "json"]).ends(3);
    let problems = run.json();
    let problems = problems["problems"].as_array().expect("a list");
    assert!(problems.len() >= 3, "{problems:?}");
    assert!(problems.iter().any(|p| p["node"] == "surface" && p["node_label"] == "Skin" && p["socket"] == "metallic"));

    folder.write("cut.material.json", "{");
    let cut = folder.run(&["check", "cut.material.json", "bad.material.json", "--format", "json"]).ends(1);
    assert!(cut.json()["problems"].as_array().is_some_and(|list| list.len() > problems.len()));
}

/// What is said of many nodes alike is said of some, and the others are counted.
#[test]
fn equal_warnings_are_summed_up() {
    let folder = Folder::new();
    let dead: String = (0..49_000).map(|i| format!(r#","dead{i}": {{"node": "math/sin"}}"#)).collect();
    folder.write(
        "dead.material.json",
        &format!(
            r#"{{"halfvector": 1, "name": "dead", "nodes": {{"surface": {{"node": "surface/surface"}}{dead}}}, "links": []}}"#
        ),
    );
    let text = folder.run(&["check", "--cost", "dead.material.json"]).ends(0).stdout;
    let lines: Vec<_> = text.lines().filter(|line| line.contains("warning: ")).collect();
    assert_eq!(lines.len(), 22, "{text}");
    assert!(lines[20].contains("there are 39000 more warnings"), "{text}");
    assert!(lines[21].contains("of 9980 nodes more: the node does not reach the surface"), "{text}");
    let all = folder.run(&["check", "dead.material.json", "--format", "json"]).ends(0).json();
    assert_eq!(all["problems"].as_array().map(Vec::len), Some(10_001));
}

/// Constants that compute no number are told at their node, like every other problem.
#[test]
fn a_constant_that_is_no_number_is_told_at_its_node() {
    let folder = Folder::new();
    folder.write(
        "log.material.json",
        r#"{"halfvector": 1, "name": "log", "nodes": {"surface": {"node": "surface/surface"},
            "part": {"node": "math/multiply", "label": "Part", "values": {"a": 1e38, "b": 1e38}}},
          "links": [{"from": "part.out", "to": "surface.metallic"}]}"#,
    );
    let text = folder.run(&["check", "log.material.json"]).ends(3).stdout;
    assert_eq!(text.matches("error: ").count(), 1, "{text}");
    assert!(text.starts_with("log.material.json: error: \u{201c}Part\u{201d} (part): "), "{text}");
    let json = folder.run(&["check", "--format", "json", "log.material.json"]).ends(3).json();
    assert!(json["problems"][0]["node"] == "part" && json["problems"][0]["node_label"] == "Part", "{json}");
}

/// A link to a node that is not there is no shader without what it was to feed.
#[test]
fn a_link_to_nothing_is_an_error() {
    let folder = Folder::new();
    folder.write(
        "slip.material.json",
        r#"{"halfvector": 1, "name": "slip", "nodes": {"surface": {"node": "surface/surface"},
            "grain": {"node": "procedural/value_noise_2d"}},
          "links": [{"from": "grain.out", "to": "surfcae.metallic"}]}"#,
    );
    let text = folder.run(&["check", "slip.material.json"]).ends(3).stdout;
    assert!(text.contains("error: surfcae, metallic: a link from grain.out leads to `surfcae.metallic`"), "{text}");
    folder.run(&["export", "slip.material.json", "--target", "wgsl", "-o", "x"]).ends(1).says("surfcae.metallic");
    assert!(!folder.path("x").exists(), "nothing is written");
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
    let of = |schema: u32, parts: &str| {
        let text = format!(
            r#"{{"schema": {schema}, "machine": "m", "date": "2026-01-01", "effort": "quick", "parts": [{parts}], "rows": []}}"#
        );
        folder.write("old.json", &text);
    };
    of(7, "");
    compared("old.json").says("its layout is version 7; this program reads version 1");
    of(1, r#""brdf""#);
    compared("old.json").says("it holds brdf; measured would be mips");
    folder.run(&["report", "--only", "paint", "-o", "out"]).ends(2).says("paint");
    folder.write("file", "");
    folder.run(&["report", "--quick", "--only", "mips", "-o", "file"]).ends(1).says("file");
    assert!(!folder.path("out").exists());
}

/// Killed in the middle of its second part: the first is there, whole.
#[test]
fn an_interrupted_report_keeps_what_it_has_measured() {
    let folder = Folder::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(["report", "--quick", "--only", "mips", "--only", "ibl", "-o", "out"])
        .current_dir(folder.0.path())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let page = folder.path("out/index.html");
    let begun = std::time::Instant::now();
    while !page.exists() && begun.elapsed().as_secs() < 300 {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    child.kill().expect("it was still measuring");
    child.wait().expect("it ends");
    let text = std::fs::read_to_string(folder.path("out/report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["parts"], serde_json::json!(["mips"]));
    assert!(report["rows"].as_array().is_some_and(|rows| !rows.is_empty()), "{text}");
    assert!(std::fs::read_to_string(page).expect("a page").ends_with("</html>\n"), "the page is whole");
    assert!(!folder.path("out/ibl.csv").exists(), "the second part was not done");
}

#[test]
fn render_writes_each_format_and_leaves_nothing_else() {
    let folder = Folder::new();
    let options = ["--size", "12x8", "--samples", "3", "--env", "white", "--set", "metallic=1"];
    for name in ["a.png", "deep/er/a.exr", "a.hdr"] {
        let mut arguments = vec!["render", "plain.material.json", "-o", name];
        arguments.extend(options);
        let run = folder.run(&arguments);
        if run.lacks_gpu() {
            return;
        }
        let run = run.ends(0).says("4 are taken instead of 3");
        assert!(run.stdout.is_empty());
        let picture = image::open(folder.path(name)).expect("a picture");
        assert_eq!((picture.width(), picture.height()), (12, 8));
    }
    assert_eq!(folder.names(), ["a.hdr", "a.png", "deep", "plain.material.json"]);
}

#[test]
fn alpha_is_straight_in_a_png() {
    let folder = Folder::new();
    let arguments = [
        "render",
        "plain.material.json",
        "-o",
        "a.png",
        "--size",
        "16x16",
        "--env",
        "white",
        "--background",
        "none",
        "--set",
        "base_color=1,1,1",
        "--tone-map",
        "none",
    ];
    let run = folder.run(&arguments);
    if run.lacks_gpu() {
        return;
    }
    run.ends(0);
    let picture = image::open(folder.path("a.png")).expect("a picture").into_rgba8();
    assert_eq!(picture.get_pixel(0, 0).0, [0; 4]);
    assert_eq!(picture.get_pixel(8, 8)[3], 255);
    let edge = picture.pixels().find(|p| (20..235).contains(&p[3])).expect("a pixel that is partly covered");
    assert!(edge[0] > 200, "the colour is not darkened by the coverage: {edge:?}");
}

#[test]
fn without_a_display_the_start_material_is_drawn() {
    let folder = Folder::new();
    let run = folder.run(&[]).says("there is no display");
    assert!(folder.path("out/example.wgsl").is_file());
    if run.lacks_gpu() {
        return;
    }
    run.ends(0);
    let picture = image::open(folder.path("out/example.png")).expect("a picture");
    assert!(picture.width() >= 256);
}

/// Runs the program with no GPU to be found.
fn without_a_driver(folder: &Folder, arguments: &[&str]) -> Run {
    let nowhere = Path::new("/nonexistent");
    let output = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(arguments)
        .current_dir(folder.0.path())
        .env("VK_DRIVER_FILES", nowhere)
        .env("VK_ICD_FILENAMES", nowhere)
        .env("WGPU_BACKEND", "vulkan")
        .output()
        .expect("the program starts");
    Run::new(arguments, &output)
}

#[test]
fn without_a_gpu_the_cpu_draws_and_says_so() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let folder = Folder::new();
    let render = ["render", "plain.material.json", "--env", "white", "--size", "16x16", "-o"];
    without_a_driver(&folder, &[&render[..], &["gpu.png", "--backend", "gpu"]].concat())
        .ends(1)
        .says("mesa-vulkan-drivers")
        .says("--backend cpu");
    assert_eq!(folder.names(), ["plain.material.json"]);
    without_a_driver(&folder, &[&render[..], &["auto.png"]].concat())
        .ends(0)
        .says("drawn on the CPU")
        .says("mesa-vulkan-drivers");
    folder.run(&[&render[..], &["cpu.png", "--backend", "cpu"]].concat()).ends(0).says("drawn by the CPU");
    let bytes = |name: &str| std::fs::read(folder.path(name)).expect("a picture");
    assert_eq!(bytes("auto.png"), bytes("cpu.png"));
}

#[test]
fn the_cost_of_nodes_is_told() {
    let folder = Folder::new();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    std::fs::copy(examples.join("custom-wgsl.material.json"), folder.path("own.material.json")).expect("copied");
    let text = folder.run(&["check", "--cost", "own.material.json"]).ends(0).stdout;
    assert!(text.contains("cost, estimated: each pixel ") && text.contains("`Tartan` (tartan): "), "{text}");
    let json = folder.run(&["check", "--cost", "--format", "json", "own.material.json"]).ends(0).json();
    let cost = &json["cost"][0];
    let node = &cost["nodes"].as_array().expect("nodes")[0];
    assert!(node["node"] == "colors" || node["node"] == "tartan", "{node}");
    assert!(cost["fragment_total"].as_u64() > node["total"].as_u64(), "{cost}");
    assert!(cost["per_turn"].is_boolean() && node["per_turn"].is_boolean(), "{cost}");

    // Of many nodes the costliest are listed.
    let sine = |i: usize| format!(r#""n{i}": {{"node": "math/sin"}}"#);
    let link = |i: usize| format!(r#"{{"from": "n{i}.out", "to": "n{}.x"}}"#, i + 1);
    folder.write(
        "many.material.json",
        &format!(
            r#"{{"halfvector": 1, "name": "many", "nodes": {{"grain": {{"node": "procedural/value_noise_2d"}},
                "surface": {{"node": "surface/surface"}}, {}}},
              "links": [{}, {{"from": "grain.out", "to": "n0.x"}}, {{"from": "n29.out", "to": "surface.metallic"}}]}}"#,
            (0..30).map(sine).collect::<Vec<_>>().join(","),
            (0..29).map(link).collect::<Vec<_>>().join(",")
        ),
    );
    let text = folder.run(&["check", "--cost", "many.material.json"]).ends(0).stdout;
    assert_eq!(text.lines().count(), 22, "{text}");
    assert!(text.contains("(grain): ") && text.contains("cost: 11 nodes more: 11 instructions together"), "{text}");
    let json = folder.run(&["check", "--cost", "--format", "json", "many.material.json"]).ends(0).json();
    assert_eq!(json["cost"][0]["nodes"].as_array().map(Vec::len), Some(31));
}

#[test]
fn what_f32_gets_wrong_is_found_and_named() {
    let folder = Folder::new();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/unstable");
    std::fs::copy(examples.join("cancellation.material.json"), folder.path("wrong.material.json")).expect("copied");
    let run = folder.run(&["check", "--stability", "plain.material.json"]).ends(0);
    assert_eq!(run.stdout, "no problems\n");
    let steps = r#"{"halfvector": 1, "name": "Steps", "nodes": {"checker": {"node": "procedural/checker"}, "surface": {"node": "surface/surface"}},
        "links": [{"from": "checker.out", "to": "surface.metallic"}]}"#;
    std::fs::write(folder.path("steps.material.json"), steps).expect("written");
    let run = folder.run(&["check", "--stability", "steps.material.json"]).ends(0);
    assert!(
        run.stdout.starts_with("steps.material.json: edges") && run.stdout.contains("\nno problems: edges are"),
        "{}",
        run.stdout
    );
    folder.run(&["check", "wrong.material.json"]).ends(0);
    let run = folder.run(&["check", "--stability", "wrong.material.json"]).ends(3);
    assert!(run.stdout.starts_with("wrong.material.json: unstable in f32:\n  node "), "{}", run.stdout);
    assert!(run.stdout.contains("\n  `Back again`  culprit.out  "), "{}", run.stdout);
    // Only what the node reads.
    let place = run.stdout.lines().find(|line| line.starts_with("    at ")).unwrap_or_default();
    assert!(place.starts_with("    at uv0.x = ") && !place.contains(','), "{}", run.stdout);
    let run = folder.run(&["check", "--stability", "--format", "json", "wrong.material.json"]).ends(3);
    let json = run.json();
    assert_eq!(json["unstable"][0]["node"], "culprit");
    assert!(json["edges"].is_array() && json["problems"].is_array() && json["f16"].is_null());
    let run = folder.run(&["check", "--stability", "--f16", "--format", "json", "wrong.material.json"]).ends(3);
    let json = run.json();
    // A million is too large for f16: it goes wrong a node earlier. JSON has no infinity.
    let half = &json["f16"]["unstable"][0];
    assert!(half["node"] == "far" && half["f16"].is_null() && half["not_finite"].as_u64() > Some(0), "{json}");
    assert!(json["f16"]["edges"].is_array());
    let run = folder.run(&["check", "--stability", "--f16", "wrong.material.json"]).ends(3);
    assert!(run.stdout.contains("unstable in f32") && run.stdout.contains("unstable in f16"), "{}", run.stdout);
    folder.run(&["check", "--f16", "wrong.material.json"]).ends(2);
    // A message of a file that cannot be read is one line.
    std::fs::write(folder.path("cut.material.json"), "{\n").expect("written");
    let json = folder.run(&["check", "--format", "json", "cut.material.json"]).ends(1).json();
    let message = json["problems"][0]["message"].as_str().unwrap_or_default();
    assert!(message.contains("line 2") && !message.contains('\n'), "{json}");
    let run = folder.run(&["check", "--stability", "--format", "json", "steps.material.json"]).ends(0);
    let edge = &run.json()["edges"][0];
    assert!(edge["node"] == "checker" && edge["from"] != edge["to"] && edge["input"].is_object(), "{edge}");
}
