//! What was worked on is found again, whatever has ended the window.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Options};

use super::files::{Place, click, folders_in, rename, wait_for};
use super::{open, settle};

/// Tells a test that it is the process that is to be killed.
const VICTIM: &str = "HALFVECTOR_TEST_VICTIM";

#[test]
fn unsaved_work_is_recovered_after_a_kill() {
    if let Some(folder) = std::env::var_os(VICTIM) {
        work_without_saving(Path::new(&folder));
    }
    let place = Place::new();
    let mut victim = working_victim("unsaved_work_is_recovered_after_a_kill", &place);
    // While it lives, its work is its own.
    let other = place.open_new();
    assert!(other.query_by_label("Recover").is_none());
    drop(other);
    victim.kill().unwrap();
    victim.wait().unwrap();
    let mut harness = place.open_new();
    click(&mut harness, "Recover");
    let session = harness.state().session();
    assert_eq!(session.document().name, "Never saved");
    assert!(session.is_unsaved());
    assert_eq!(session.file().map(|file| file.canonicalize().unwrap()), Some(place.file().canonicalize().unwrap()));
    assert_eq!(place.read().name, "Worn enamel", "the file is untouched until it is saved");
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Never saved");
    drop(harness);
    assert!(place.open_new().query_by_label("Recover").is_none());
}

/// What is left is told apart, put off and found again, and does not count as open.
#[test]
fn two_records_of_one_file_are_recovered_one_after_the_other() {
    let test = "two_records_of_one_file_are_recovered_one_after_the_other";
    if let Some(folder) = std::env::var_os(VICTIM) {
        work_without_saving(Path::new(&folder));
    }
    let place = Place::new();
    let mut victims = [working_victims(test, &place, 1), working_victims(test, &place, 2)];
    for victim in &mut victims {
        victim.kill().unwrap();
        victim.wait().unwrap();
    }
    let mut harness = place.open_new();
    assert_eq!(harness.query_all_by_label("Recover").count(), 2);
    let path = place.file().canonicalize().unwrap().display().to_string();
    assert_eq!(harness.query_all_by_label_contains(&path).count(), 2);
    assert_eq!(harness.query_all_by_label_contains("Never saved” instead of “Worn enamel").count(), 2);
    assert_eq!(harness.query_all_by_label_contains(" ago").count(), 2);
    // Put off, it stands in the menu.
    click(&mut harness, "Later");
    assert!(harness.query_by_label("Recover").is_none());
    click(&mut harness, "File");
    click(&mut harness, "Recover unsaved work…");
    harness.query_all_by_label("Recover").next().unwrap().click();
    harness.run_steps(3);
    settle(&mut harness);
    assert_eq!(harness.state().session().document().name, "Never saved");
    assert_eq!(harness.query_all_by_label("Recover").count(), 1, "the other one is still asked about");
    click(&mut harness, "Later");
    // The thread looks once a second who else has the file open: what is left is not open.
    let start = Instant::now();
    while start.elapsed() < Duration::from_millis(2600) {
        harness.step();
        assert!(harness.query_by_label_contains("open in another window").is_none());
        std::thread::sleep(Duration::from_millis(20));
    }
    // Whom the question whether to save makes hesitate loses nothing.
    click(&mut harness, "File");
    click(&mut harness, "Recover unsaved work…");
    click(&mut harness, "Recover");
    click(&mut harness, "Cancel");
    // The first one is saved; the second one began before that, and no other program has changed the file.
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    click(&mut harness, "File");
    click(&mut harness, "Recover unsaved work…");
    click(&mut harness, "Recover");
    settle(&mut harness);
    let strip = "The file was changed or saved after this work was left.";
    wait_for(&mut harness, "the strip", |harness| harness.query_by_label_contains(strip).is_some());
    assert!(harness.query_by_label_contains("another program").is_none());
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert!(harness.query_by_label_contains("Write over what was saved since?").is_some());
}

#[test]
fn what_others_made_of_the_file_since_a_kill_is_not_overwritten_by_recovered_work() {
    if let Some(folder) = std::env::var_os(VICTIM) {
        work_without_saving(Path::new(&folder));
    }
    let place = Place::new();
    let test = "what_others_made_of_the_file_since_a_kill_is_not_overwritten_by_recovered_work";
    let mut victim = working_victim(test, &place);
    victim.kill().unwrap();
    victim.wait().unwrap();
    let mut theirs = place.read();
    theirs.name = "Theirs".to_owned();
    halfvector_graph::file::save(&place.file(), &theirs).unwrap();
    let mut harness = place.open_new();
    click(&mut harness, "Recover");
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Theirs");
    click(&mut harness, "Cancel");
    wait_for(&mut harness, "the offer", |harness| harness.query_by_label("Reload").is_some());
    assert_eq!(harness.state().session().document().name, "Never saved");
    click(&mut harness, "Keep mine");
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Never saved");
}

/// A process that works without saving, once there is a record of its work.
fn working_victim(test: &str, place: &Place) -> Child {
    working_victims(test, place, 1)
}

/// One more process that works without saving, once there are so many records.
fn working_victims(test: &str, place: &Place, count: usize) -> Child {
    let victim = victim(test, place.folder.path());
    let records = || {
        let files = std::fs::read_dir(place.folder.path().join("recovery")).into_iter().flatten().flatten();
        // What is being written has another name until it is whole.
        let whole = files.filter(|file| file.path().extension().is_some_and(|extension| extension == "json"));
        let texts = whole.filter_map(|file| std::fs::read_to_string(file.path()).ok());
        texts.filter(|text| text.contains("Never saved")).count()
    };
    let start = Instant::now();
    while records() < count {
        assert!(start.elapsed() < Duration::from_secs(120), "no record is written");
        std::thread::sleep(Duration::from_millis(20));
    }
    victim
}

fn work_without_saving(folder: &Path) -> ! {
    let document = Some(folder.join("enamel.material.json"));
    let mut harness = open(Options { document, folders: folders_in(folder), ..Options::default() });
    harness.state_mut().act(rename("Never saved"));
    loop {
        harness.step();
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Starts this test in a process of its own, which goes another way there.
fn victim(test: &str, folder: &Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &format!("editor::recovery::{test}"), "--nocapture"])
        .env(VICTIM, folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn killed_while_saving_loses_nothing() {
    if let Some(folder) = std::env::var_os(VICTIM) {
        save_for_ever(&Path::new(&folder).join("enamel.material.json"));
    }
    let place = Place::new();
    for kill in 0..100_u64 {
        let mut victim = victim("killed_while_saving_loses_nothing", place.folder.path());
        let mut lines = BufReader::new(victim.stdout.take().unwrap()).lines();
        // The harness' own words stand in front.
        let mut said =
            || lines.by_ref().map_while(Result::ok).find_map(|line| line.strip_prefix("saved ")?.parse::<u64>().ok());
        let mut last = said().unwrap();
        // Another moment each time: a save takes about a millisecond.
        std::thread::sleep(Duration::from_micros(kill * 37 % 2000));
        victim.kill().unwrap();
        victim.wait().unwrap();
        while let Some(number) = said() {
            last = number;
        }
        let document = place.read();
        let number: u64 = document.name.parse().unwrap();
        assert!(number == last || number == last + 1, "{last} was saved, {number} is there");
        assert_eq!(document.name, document.parameters[0].label.clone().unwrap(), "half of a document");
    }
}

/// Saves one document after the other, and says which one is done.
fn save_for_ever(path: &Path) -> ! {
    let mut document = halfvector_graph::file::load(path).unwrap();
    for number in 0_u64.. {
        document.name = number.to_string();
        document.parameters[0].label = Some(number.to_string());
        halfvector_graph::file::save(path, &document).unwrap();
        println!("saved {number}");
    }
    unreachable!("there is no end of numbers")
}
