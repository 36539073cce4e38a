//! `halfvector report`, interrupted.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use super::Folder;

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
    let sent = Command::new("kill").args(["-INT", &running.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "the signal is sent");
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
