//! A real window on a display without a screen (Xvfb), driven by xdotool as a person's keys and mouse would. Skipped with a
//! printed line where either is not installed.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::Folder;

/// A process that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A display of its own, and its name.
fn display() -> Option<(Running, String)> {
    let started = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1440x900x24", "-nolisten", "tcp"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let Ok(mut server) = started else {
        println!("skipped: Xvfb is not installed");
        return None;
    };
    if Command::new("xdotool").arg("version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_err() {
        println!("skipped: xdotool is not installed");
        drop(Running(server));
        return None;
    }
    let mut number = String::new();
    let out = server.stdout.take().expect("its output is piped");
    BufReader::new(out).read_line(&mut number).expect("the display's number");
    Some((Running(server), format!(":{}", number.trim())))
}

fn xdotool(display: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new("xdotool").args(arguments).env("DISPLAY", display).output().expect("xdotool runs");
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(120), "{what} does not come");
        std::thread::sleep(Duration::from_millis(100));
    }
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_default()
}

#[test]
fn a_window_is_driven_by_mouse_and_keys() {
    let Some((_server, display)) = display() else { return };
    let folder = Folder::new();
    let mut command = Command::new(env!("CARGO_BIN_EXE_halfvector"));
    command.args(["edit", "plain.material.json"]).current_dir(folder.path("")).env("DISPLAY", &display);
    for variable in ["HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_RUNTIME_DIR"] {
        command.env(variable, folder.path(""));
    }
    command.env_remove("WAYLAND_DISPLAY").stdin(Stdio::null()).stderr(Stdio::piped());
    let mut program = Running(command.spawn().expect("the program starts"));

    let window = wait_for("the window", || {
        let found = xdotool(&display, &["search", "--onlyvisible", "--name", "Halfvector"]);
        if let Some(status) = program.0.try_wait().expect("its state") {
            let mut said = String::new();
            let mut out = program.0.stderr.take().expect("its errors are piped");
            std::io::Read::read_to_string(&mut out, &mut said).expect("text");
            panic!("the program ended with {status}: {said}");
        }
        found.filter(|id| !id.is_empty())
    });
    // Without a window manager nobody else gives it the keys.
    xdotool(&display, &["windowfocus", "--sync", &window]).expect("the window takes the keys");
    let do_it = |arguments: &[&str]| {
        xdotool(&display, arguments).unwrap_or_else(|| panic!("xdotool {arguments:?}"));
        std::thread::sleep(Duration::from_millis(400));
    };

    // Space over the graph opens the palette; the first node found is added, and saved. Keys that come before the window
    // draws its first frame are lost, so that this is tried again.
    let file = folder.path("plain.material.json");
    wait_for("the new node in the file", || {
        do_it(&["mousemove", "200", "200"]);
        do_it(&["key", "Escape"]);
        do_it(&["key", "space"]);
        do_it(&["type", "voronoi"]);
        do_it(&["key", "Return"]);
        do_it(&["key", "ctrl+s"]);
        text(&file).contains("voronoi").then_some(())
    });
    // Undone and saved, the file has its nodes of before.
    wait_for("the node to go again", || {
        do_it(&["key", "ctrl+z"]);
        do_it(&["key", "ctrl+s"]);
        (!text(&file).contains("voronoi")).then_some(())
    });
    assert!(text(&file).contains("surface/surface"));

    do_it(&["key", "ctrl+q"]);
    let status = wait_for("the end", || program.0.try_wait().expect("its state"));
    assert!(status.success(), "{status}");
}
