//! A browser without a window, driven through its debugging pipe: Chromium, where it is installed.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::required;

/// How long an answer or a page may take: a software device draws, on a machine that has other work.
const PATIENCE: Duration = Duration::from_secs(90);

/// Set where the pictures that a browser's are held against are drawn by the device that the browser draws with.
const ONE_DEVICE: &str = "HALFVECTOR_ONE_DEVICE";

/// Drivers of the software device that Chromium brings.
const DRIVERS: [&str; 3] = [
    "/usr/lib/chromium/vk_swiftshader_icd.json",
    "/usr/lib/chromium-browser/vk_swiftshader_icd.json",
    "/opt/google/chrome/vk_swiftshader_icd.json",
];

/// Whether both pictures of a comparison come from one device: then nothing but the text can make them differ.
pub(crate) fn on_one_device() -> bool {
    required(ONE_DEVICE)
}

/// The comparisons with browsers again, wgpu drawing with the browser's own device: what differs on two devices is the devices', and
/// on one of them nothing does. In another process, since a driver is chosen when a process begins.
#[test]
fn on_the_browsers_own_device_the_pictures_are_the_same() {
    let Some(driver) = DRIVERS.iter().find(|driver| Path::new(driver).exists()) else {
        println!("skipped: no browser has brought a device that wgpu can draw with");
        return;
    };
    if on_one_device() {
        return;
    }
    let output = Command::new(std::env::current_exe().expect("this program"))
        .args([
            "--nocapture",
            "--exact",
            "web::a_browser_draws_what_wgpu_draws",
            "drawn::glsl_es_draws_what_wgsl_draws",
        ])
        .env(ONE_DEVICE, "1")
        .env("VK_DRIVER_FILES", driver)
        .env("VK_ICD_FILENAMES", driver)
        .output()
        .expect("it runs again");
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    println!("{said}");
    assert!(output.status.success(), "on one device the pictures differ");
    assert!(said.contains("2 passed"), "not both comparisons ran");
}

/// A running browser with a page. It ends when this is dropped.
pub(crate) struct Browser {
    process: Child,
    input: ChildStdin,
    answers: Receiver<Value>,
    last: u64,
    session: Option<String>,
    _profile: tempfile::TempDir,
}

impl Browser {
    /// A browser with a software device for WebGPU, or none with a printed line. `HALFVECTOR_REQUIRE_BROWSER=1`: none is a
    /// failure.
    pub(crate) fn open() -> Option<Browser> {
        if Command::new("chromium").arg("--version").stderr(Stdio::null()).output().is_err() {
            assert!(!required("HALFVECTOR_REQUIRE_BROWSER"), "chromium is not installed");
            println!("skipped: chromium is not installed");
            return None;
        }
        let profile = tempfile::tempdir().expect("a folder");
        // The pipe is file descriptors 3 and 4.
        let script = "exec chromium --headless --no-sandbox --disable-dev-shm-usage --enable-unsafe-webgpu \
             --use-webgpu-adapter=swiftshader --user-data-dir=\"$0\" --remote-debugging-pipe 3<&0 4>&1 >/dev/null 2>&1";
        let mut process = Command::new("sh")
            .args(["-c", script])
            .arg(profile.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        let input = process.stdin.take().expect("its input");
        let mut output = std::io::BufReader::new(process.stdout.take().expect("its output"));
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            let mut message = Vec::new();
            let mut byte = [0];
            while output.read_exact(&mut byte).is_ok() {
                if byte[0] != 0 {
                    message.push(byte[0]);
                    continue;
                }
                let read = serde_json::from_slice(&message).expect("JSON from the browser");
                message.clear();
                if sender.send(read).is_err() {
                    return;
                }
            }
        });
        Some(Browser { process, input, answers, last: 0, session: None, _profile: profile })
    }

    /// Opens a page and waits until it says that it is done (`data-state` of its root); what it then says of itself:
    /// the value of a JavaScript expression.
    pub(crate) fn page(&mut self, path: &Path, fragment: &str, expression: &str) -> Value {
        self.session = None;
        let url = format!("file://{}#{fragment}", path.display());
        let target = self.ask("Target.createTarget", json!({ "url": url }))["targetId"].clone();
        let attached = self.ask("Target.attachToTarget", json!({ "targetId": target, "flatten": true }));
        self.session = Some(attached["sessionId"].as_str().expect("a session").to_owned());
        let started = Instant::now();
        while self.value("document.documentElement.dataset.state") != "done" {
            assert!(started.elapsed() < PATIENCE, "the page is not done");
            std::thread::sleep(Duration::from_millis(50));
        }
        self.value(expression)
    }

    fn value(&mut self, expression: &str) -> Value {
        let asked = json!({ "expression": expression, "returnByValue": true });
        self.ask("Runtime.evaluate", asked)["result"]["value"].take()
    }

    fn ask(&mut self, method: &str, parameters: Value) -> Value {
        self.last += 1;
        let mut message = json!({ "id": self.last, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.input.write_all(format!("{message}\0").as_bytes()).expect("the browser listens");
        loop {
            let mut answer = self.answers.recv_timeout(PATIENCE).expect("the browser answers");
            if answer["id"] == self.last {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may have gone by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
