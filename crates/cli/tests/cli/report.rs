//! `halfvector report`, interrupted.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{Folder, PLAIN};

/// Starts `report --quick` in a folder.
fn started(folder: &Folder, parts: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(["report", "--quick", "-o", "out"])
        .args(parts.iter().flat_map(|part| ["--only", part]))
        .current_dir(folder.0.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

fn interrupt(running: &Child) {
    let sent = Command::new("kill").args(["-INT", &running.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "the signal is sent");
}

/// What stands in a file as soon as it has these words.
fn text_with(path: &Path, words: &str) -> String {
    let begun = Instant::now();
    loop {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        if text.contains(words) {
            return text;
        }
        assert!(begun.elapsed() < Duration::from_secs(300), "{words:?} is not in {}: {text}", path.display());
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn json(folder: &Folder) -> Value {
    let text = std::fs::read_to_string(folder.path("out/report.json")).expect("a report");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn rows(report: &Value) -> &[Value] {
    report["rows"].as_array().map_or(&[], Vec::as_slice)
}

/// A folder stands where a file of the report would be: that is told before anything is measured.
#[test]
fn a_place_that_cannot_be_written_is_told_at_once() {
    for name in ["index.html", "mips.csv", "report.json"] {
        let folder = Folder::new();
        std::fs::create_dir_all(folder.path("out").join(name)).expect("a folder");
        let run = folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(1).says(name);
        assert!(!run.stderr.contains("mips: "), "{name}: {}", run.stderr);
    }
    // What stands there stays until there is something new.
    let folder = Folder::new();
    std::fs::create_dir(folder.path("out")).expect("a folder");
    folder.write("out/report.json", "kept");
    std::fs::create_dir(folder.path("out/mips.csv")).expect("a folder");
    folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(1);
    assert_eq!(std::fs::read_to_string(folder.path("out/report.json")).expect("it stays"), "kept");
}

/// A device in the place of a file, whose end is never reached, is told before anything is measured; so is an old report that would be
/// replaced, which stays.
#[cfg(unix)]
#[test]
fn what_is_no_file_or_would_be_lost_is_refused_at_once() {
    for name in ["report.json", "index.html", "mips.csv"] {
        let folder = Folder::new();
        std::fs::create_dir(folder.path("out")).expect("a folder");
        std::os::unix::fs::symlink("/dev/zero", folder.path("out").join(name)).expect("a link");
        let run = folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(1).says(name);
        assert!(run.stderr.contains("no regular file"), "{}", run.stderr);
    }
    let folder = Folder::new();
    folder.run(&["report", "--quick", "--only", "mips", "--compare", "/dev/zero", "-o", "out"]).ends(1);
    folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(0);
    let old = std::fs::read_to_string(folder.path("out/report.json")).expect("a report");
    let again = ["report", "--quick", "--only", "mips", "--compare", "out/../out/report.json", "-o", "out"];
    let run = folder.run(&again).ends(1);
    assert!(run.stderr.contains("would be replaced"), "{}", run.stderr);
    assert_eq!(std::fs::read_to_string(folder.path("out/report.json")).expect("it stays"), old);
}

/// An old report with what no run can have measured is refused with the place, the reason and a remedy, before anything is measured.
#[test]
fn an_impossible_old_report_is_refused_at_once() {
    let folder = Folder::new();
    folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(0);
    let old = std::fs::read_to_string(folder.path("out/report.json")).expect("a report");
    let with = |spoil: &dyn Fn(&mut Value)| {
        let mut report: Value = serde_json::from_str(&old).expect("JSON");
        spoil(&mut report);
        report.to_string()
    };
    let cases = [
        (with(&|report| report["rows"][1]["cost_ns"] = (-3.0).into()), "row 2 (normal_mips "),
        (with(&|report| report["rows"][0]["error_rms"] = (-1.0).into()), "error_rms is -1"),
        (with(&|report| report["rows"] = Value::Array(Vec::new())), "no part that was measured to its end"),
        (with(&|report| report["parts"] = Value::Array(Vec::new())), "no part that was measured to its end"),
        (with(&|report| report["rows"][0] = report["rows"][1].clone()), "is there twice"),
        (old.replacen("\"cost_ns\":", "\"cost_ns\":NaN,\"was\":", 1), "it is not a report: "),
        (old[..old.len() / 2].to_owned(), "it is not a report: "),
        ("{}".to_owned(), "it is not a report: "),
    ];
    for (text, why) in cases {
        folder.write("old.json", &text);
        let run = folder.run(&["report", "--quick", "--only", "mips", "-o", "new", "--compare", "old.json"]).ends(1);
        assert!(run.stderr.contains("old.json") && run.stderr.contains(why), "{why}: {}", run.stderr);
        assert!(!folder.path("new").exists(), "{why}");
    }
}

/// Killed in the middle of its only part, before anything of it was timed: what was judged is there, whole, and says what it lacks.
#[test]
fn a_killed_report_keeps_the_rows_of_a_part() {
    let folder = Folder::new();
    let mut running = started(&folder, &["ibl"]);
    text_with(&folder.path("out/index.html"), "</html>");
    running.kill().expect("it was still measuring");
    running.wait().expect("it ends");
    let report = json(&folder);
    assert_eq!(report["parts"], serde_json::json!([]));
    let rows = rows(&report);
    assert!(!rows.is_empty() && rows.len() < 16, "{report}");
    assert!(rows.iter().all(|row| row["error_rms"].is_number() && row["cost_batch_ns"].is_null()), "{report}");
    assert!(rows[0]["note"].as_str().is_some_and(|note| note.contains("the run was interrupted")), "{report}");
    assert!(report["nulls"].as_array().is_some_and(|nulls| !nulls.is_empty()), "{report}");
    let page = std::fs::read_to_string(folder.path("out/index.html")).expect("a page");
    assert!(page.ends_with("</html>\n") && page.contains("ibl (interrupted; "), "{page}");
    assert!(folder.path("out/ibl.csv").exists());
}

/// What a part left out before it was interrupted is kept with its reason, and told.
#[test]
fn an_interrupted_part_says_what_it_left_out() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("examples")).expect("a folder");
    folder.write("examples/a.material.json", "no document");
    // Enough of them to be still at it.
    for name in ["b", "c", "d", "e", "f", "g", "h", "i", "j", "k"] {
        folder.write(&format!("examples/{name}.material.json"), PLAIN);
    }
    let mut running = started(&folder, &["pictures"]);
    text_with(&folder.path("out/report.json"), "a.material");
    interrupt(&running);
    let mut said = String::new();
    running.stderr.take().expect("piped").read_to_string(&mut said).expect("text");
    assert_eq!(running.wait().expect("it ends").code(), Some(130), "{said}");
    assert!(said.contains("not measured: pictures: a.material: "), "{said}");
    let report = json(&folder);
    let left = report["left_out"].as_array().expect("a list");
    assert!(left.iter().any(|left| left["what"] == "a.material" && left["part"] == "pictures"), "{report}");
    assert_eq!(report["parts"], serde_json::json!([]));
}

/// A slower picture on the device and a larger error, both planted, are told with exit code 3, after the times were taken again.
#[test]
fn a_slower_device_and_a_larger_error_are_told() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("examples")).expect("a folder");
    folder.write("examples/a.material.json", PLAIN);
    let report =
        |more: &[&str]| folder.run(&[&["report", "--quick", "--only", "pictures", "-o", "out"], more].concat());
    report(&[]).ends(0);
    let mut old = json(&folder);
    if rows(&old).iter().all(|row| row["gpu_ns"].is_null()) {
        assert!(std::env::var("HALFVECTOR_REQUIRE_GPU").as_deref() != Ok("1"), "{old}");
        println!("skipped: no GPU");
        return;
    }
    for row in old["rows"].as_array_mut().expect("rows") {
        // Times of a busy machine: of these only the planted one is compared.
        row["cost_ns"] = Value::Null;
        let scaled = |figure: &Value, by: f64| Value::from(figure.as_f64().expect("a figure") * by);
        match row["method"].as_str() {
            Some("gpu") => row["gpu_ns"] = scaled(&row["gpu_ns"], 0.01),
            Some("preset report") => row["error_rms"] = scaled(&row["error_rms"], 0.5),
            _ => {}
        }
    }
    folder.write("old.json", &old.to_string());
    let run =
        report(&["--compare", "old.json"]).ends(3).says("pictures: measured again, for something seems to be slower");
    assert!(run.stdout.contains("slower: picture gpu: a pixel on the device takes"), "{}", run.stdout);
    assert!(run.stdout.contains("less accurate: picture preset report: rms error"), "{}", run.stdout);
    // What is found each time is told once.
    assert_eq!(run.stdout.matches("slower: ").count(), 1, "{}", run.stdout);
}

/// An interrupt while something is measured again ends the process that does it.
#[test]
fn an_interrupt_ends_what_is_measured_again() {
    let folder = Folder::new();
    folder.run(&["report", "--quick", "--only", "mips", "-o", "out"]).ends(0);
    let mut old = json(&folder);
    for row in old["rows"].as_array_mut().expect("rows") {
        row["cost_ns"] =
            Value::from(row["cost_ns"].as_f64().expect("a time") * if row["method"] == "lean" { 0.01 } else { 1.0 });
    }
    folder.write("old.json", &old.to_string());
    let mut running = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(["report", "--quick", "--only", "mips", "-o", "out", "--compare", "old.json"])
        .env("TMPDIR", folder.0.path())
        .current_dir(folder.0.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let again = folder.path(&format!("halfvector-report-again-{}", running.id()));
    let begun = Instant::now();
    while !again.join("said.txt").exists() {
        assert!(begun.elapsed() < Duration::from_secs(300), "nothing is measured again");
        std::thread::sleep(Duration::from_millis(5));
    }
    // It is about to be started, or was.
    std::thread::sleep(Duration::from_millis(200));
    interrupt(&running);
    let mut said = String::new();
    running.stderr.take().expect("piped").read_to_string(&mut said).expect("text");
    assert_eq!(running.wait().expect("it ends").code(), Some(130), "{said}");
    assert!(said.contains("interrupted: what is measured is kept in out: mips"), "{said}");
    // The other process would make its folder again.
    std::thread::sleep(Duration::from_millis(500));
    assert!(!again.exists(), "{}", again.display());
}

/// A Ctrl-C ends the command with a line that says which parts are kept, and where; their files are whole. CSV files of an older report
/// that this one has no part of are gone, others' files stay.
#[test]
fn an_interrupt_says_what_is_kept() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("out")).expect("a folder");
    let old = [("brdf.csv", "term,method,domain,error_max,error_rms\nd,ggx,all,0,0\n"), ("maps.csv", "town,map\n")];
    for (name, text) in old {
        std::fs::write(folder.path("out").join(name), text).expect("a file");
    }
    let mut running = Command::new(env!("CARGO_BIN_EXE_halfvector"))
        .args(["report", "--quick", "--only", "mips", "--only", "ibl", "-o"])
        .arg(folder.path("out"))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut said = BufReader::new(running.stderr.take().expect("piped"));
    let mut line = String::new();
    said.read_line(&mut line).expect("a line");
    assert!(line.starts_with("mips: "), "{line}");
    // The part of light goes on for many seconds.
    interrupt(&running);
    let mut rest = String::new();
    said.read_to_string(&mut rest).expect("text");
    let code = running.wait().expect("it ends").code();
    assert_eq!(code, Some(130), "{rest}");
    assert!(rest.contains("interrupted: what is measured is kept in") && rest.contains(": mips"), "{rest}");
    let report = std::fs::read_to_string(folder.path("out/report.json")).expect("a report");
    assert!(report.contains("\"parts\":[\"mips\"]"), "{report}");
    let there = |name: &str| folder.path("out").join(name).exists();
    assert_eq!(["brdf.csv", "maps.csv", "mips.csv"].map(there), [false, true, true]);
}
