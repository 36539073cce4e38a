//! What leaves the program: text on stdout, files that are there whole or not at all, progress on a terminal.

use std::borrow::Cow;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::Failure;

/// Prints a text and a line break on stdout. A reader that has gone away (`| head`) is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    print_whole(&harmless(text, |c| c.escape_unicode().to_string()))
}

/// Prints a JSON value on stdout.
pub(crate) fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    // Such characters stand in texts alone, where JSON has an escape for them.
    print_whole(&harmless(&format!("{value:#}"), |c| format!("\\u{:04x}", u32::from(c))))
}

/// Tells the user something beside the result, on stderr.
pub(crate) fn note(text: impl std::fmt::Display) {
    let text = text.to_string();
    // Nobody is left to tell when stderr is closed.
    let _ = writeln!(std::io::stderr(), "{}", harmless(&text, |c| c.escape_unicode().to_string()));
}

/// A text that a terminal shows and does not obey: names in documents and of files may hold whatever somebody put there. Escaped are control
/// characters but line breaks and tabs, and what turns the direction of writing or breaks lines unseen.
fn harmless(text: &str, escaped: impl Fn(char) -> String) -> Cow<'_, str> {
    let is_obeyed = |c: char| {
        let is_control = c.is_control() && !matches!(c, '\n' | '\t');
        let turns =
            matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        is_control || turns || matches!(c, '\u{2028}' | '\u{2029}')
    };
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    text.chars().map(|c| if is_obeyed(c) { escaped(c) } else { c.to_string() }).collect()
}

fn print_whole(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", text.trim_end_matches('\n')).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::input("the result could not be printed").because(error))
        }
        _ => Ok(()),
    }
}

/// Refuses a place for a file before any work is done: a folder of that name, or something else in a folder's place.
pub(crate) fn check_place(path: &Path) -> Result<(), Failure> {
    let refused = |why: String| Err(Failure::input("the result cannot be written there").at(path).because(why));
    if path.is_dir() {
        return refused("a folder has this name".to_owned());
    }
    for above in path.ancestors().skip(1).filter(|above| !above.as_os_str().is_empty()) {
        if above.is_dir() {
            return Ok(());
        }
        if above.exists() {
            return refused(format!("{} is not a folder", above.display()));
        }
    }
    Ok(())
}

/// Writes a file whole: under another name in the same folder first, then renamed. Missing folders are made.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_files(&[(path, bytes)])
}

/// Writes files that belong together as [`write_file`] does: all, or none.
pub(crate) fn write_files(files: &[(&Path, &[u8])]) -> Result<(), Failure> {
    let failed = |path: &Path, error: std::io::Error| {
        Failure::input("the file could not be written")
            .at(path)
            .because(error)
            .try_to("another folder, or one with more space or other permissions")
    };
    for (path, _) in files {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder).map_err(|error| failed(path, error))?;
    }
    halfvector_graph::file::replace_all(files).map_err(|(k, error)| failed(files[k].0, error))
}

/// A progress bar on stderr; nothing when stderr is not a terminal.
pub(crate) fn progress(what: &str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {percent} % {elapsed}") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(what.to_owned());
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_obeys_no_text() {
        let hostile = "a\u{1b}]0;x\u{7} \u{9b}1m\r \u{202e}b\u{2066}\nc\td \u{2028}";
        let text = harmless(hostile, |c| c.escape_unicode().to_string());
        assert_eq!(text, "a\\u{1b}]0;x\\u{7} \\u{9b}1m\\u{d} \\u{202e}b\\u{2066}\nc\td \\u{2028}");
        assert!(matches!(harmless("錆\n\u{e9}", |_| String::new()), Cow::Borrowed(_)));
    }

    #[test]
    fn a_file_is_replaced_whole_and_nothing_else_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("new/result.txt");
        check_place(&path).expect("a free place");
        write_file(&path, b"one").expect("written");
        write_file(&path, b"two").expect("replaced");
        assert_eq!(std::fs::read(&path).expect("readable"), b"two");
        assert_eq!(std::fs::read_dir(folder.path().join("new")).expect("the folder").count(), 1);
        check_place(&path.join("below")).expect_err("a file is no folder");
        check_place(folder.path()).expect_err("a folder is no file");
    }
}
