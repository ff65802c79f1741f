//! A program killed with SIGKILL at random moments of an editing script: no file is broken, little is lost, and it is offered back.
#![cfg(all(feature = "gui", unix))]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use endline_gear::Document;
use endline_session::edit::Documents;
use endline_session::edit::recovery::{Autosave, UnsavedEdits};

use crate::common::Folder;

/// Seconds of the script for each real one: what takes half a minute at work takes three seconds here, which a busy disk needs at times
/// to write one file for good.
const HASTE: f64 = 10.0;
/// Edits lost at most [s of the script].
const LOST_S: f64 = 30.0;
/// Programs killed, so many at a time.
const KILLS: [usize; 2] = [10, 5];
/// Tells this test that it is the program to be killed.
const ROLE: &str = "ENDLINE_TEST_EDITS";

/// The two files that the script edits, and their field.
const FILES: [&str; 2] = ["ropes/sink-3-8.toml", "ropes/nylon-1-2.toml"];
const FIELD: &str = "strength";

/// A library of two ropes and the scenario that uses one: small, so that an edit is quick.
fn small_library(folder: &Folder, root: &Path) {
    for file in FILES.into_iter().chain([
        "friction/sink.toml",
        "friction/nylon.toml",
        "scenarios/reference-a-pendulum.toml",
    ]) {
        std::fs::create_dir_all(root.join(file).parent().unwrap()).unwrap();
        std::fs::copy(folder.0.join(file), root.join(file)).unwrap();
    }
}

/// The script: an edit, now and then saved, kept as the window keeps them; each told in a log before it is made.
fn edit_until_killed(root: &Path) {
    let mut documents =
        Documents::open(root, &root.join("scenarios/reference-a-pendulum.toml")).unwrap();
    // A folder that is not there yet, as on a new user's first day.
    let mut autosave = Autosave::in_folder(root.join("data"));
    let mut log =
        std::fs::OpenOptions::new().append(true).create(true).open(root.join("log")).unwrap();
    let start = Instant::now();
    let first = std::fs::read_to_string(root.join("log")).unwrap().lines().count();
    for edit in first.. {
        let file = FILES[edit % 2];
        writeln!(log, "{edit} {:.3}", start.elapsed().as_secs_f64() * HASTE).unwrap();
        documents.set(file, FIELD, &format!("{} lbf", 1000 + edit)).unwrap();
        autosave.keep(&documents, start.elapsed().as_secs_f64() * HASTE);
        if edit % 150 == 149 {
            documents.save().unwrap();
        }
        std::thread::sleep(Duration::from_millis(15));
    }
}

/// The number of the edit that a text holds; none where it holds the figure as shipped.
fn edit_in(text: &str) -> Option<usize> {
    let strength = Document::parse(text).unwrap().get(FIELD).unwrap();
    strength
        .strip_suffix(" lbf")
        .filter(|number| !number.contains(','))?
        .parse::<usize>()
        .ok()?
        .checked_sub(1000)
}

fn began(root: &Path) -> Child {
    let program = std::env::current_exe().unwrap();
    let exact = ["killed::the_script_as_a_program_of_its_own", "--exact", "--nocapture"];
    Command::new(program)
        .args(exact)
        .env(ROLE, root)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Kills one program after a while, and looks at what it left; answers what is wrong.
fn kill_one(root: &Path, after: Duration) -> String {
    let before = std::fs::read_to_string(root.join("log")).unwrap_or_default().lines().count();
    let mut child = began(root);
    let patience = Instant::now() + Duration::from_secs(60);
    // The clock starts with the first edit.
    while std::fs::read_to_string(root.join("log")).unwrap_or_default().lines().count() <= before {
        assert!(Instant::now() < patience, "the script does not begin");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(after);
    child.kill().unwrap();
    child.wait().unwrap();
    let wrong = looked_at(root, before);
    for (file, _) in Autosave::in_folder(root.join("data")).left_behind() {
        std::fs::remove_file(file).unwrap();
    }
    wrong
}

/// Files whole, edits kept or saved not long ago, and those kept offered back.
fn looked_at(root: &Path, first: usize) -> String {
    let mut wrong = String::new();
    let log = std::fs::read_to_string(root.join("log")).unwrap();
    let times: Vec<f64> =
        log.lines().skip(first).filter_map(|line| line.split_once(' ')?.1.parse().ok()).collect();
    let left = Autosave::in_folder(root.join("data")).left_behind();
    let offered: Option<&UnsavedEdits> = left.first().map(|(_, kept)| kept);
    let mut newest = None;
    for file in FILES {
        let text = std::fs::read_to_string(root.join(file)).unwrap();
        if Document::parse(&text).is_err() || !text.contains("# ") {
            let _ = writeln!(wrong, "{file} is broken");
        }
        let kept = offered.and_then(|kept| kept.texts.get(file)?.as_deref()).and_then(edit_in);
        newest = newest.max(edit_in(&text)).max(kept);
    }
    // Saved or kept before this program began: nothing of its own was kept yet.
    let kept_s =
        newest.and_then(|edit| times.get(edit.checked_sub(first)?).copied()).unwrap_or(0.0);
    let lost_s = times.last().copied().unwrap_or(0.0) - kept_s;
    if lost_s > LOST_S {
        let _ = writeln!(wrong, "edits of {lost_s:.1} s are lost, of {:?} s", times.last());
    }
    if Documents::open(root, &root.join("scenarios/reference-a-pendulum.toml")).is_err() {
        let _ = writeln!(wrong, "the library does not open");
    }
    wrong
}

#[test]
fn the_script_as_a_program_of_its_own() {
    if let Some(root) = std::env::var_os(ROLE) {
        edit_until_killed(&PathBuf::from(root));
    }
}

#[test]
fn fifty_programs_killed_amid_edits_break_no_file_and_lose_little() {
    let folder = Folder::new("fifty-kills");
    let wrong: Vec<String> = std::thread::scope(|scope| {
        let work = |which: usize| {
            let root = folder.0.join(format!("killed-{which}"));
            small_library(&folder, &root);
            // Moments spread over the script by the golden ratio, each its own.
            let moment = move |kill: usize| ((which * KILLS[1] + kill) as f64 * 0.618_034).fract();
            (0..KILLS[1])
                .map(|kill| kill_one(&root, Duration::from_secs_f64(0.05 + 6.0 * moment(kill))))
                .collect::<String>()
        };
        let threads: Vec<_> = (0..KILLS[0]).map(|which| scope.spawn(move || work(which))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(wrong.iter().all(String::is_empty), "{wrong:?}");
}

#[test]
fn edits_kept_by_a_killed_program_come_back_whole() {
    let folder = Folder::new("one-kill");
    let root = folder.0.join("killed");
    small_library(&folder, &root);
    let mut child = began(&root);
    // Long enough for one keeping, whatever the machine: wait for its file.
    let kept = || {
        std::fs::read_dir(root.join("data"))
            .into_iter()
            .flatten()
            .flatten()
            .any(|entry| entry.file_name().to_string_lossy().ends_with(".json"))
    };
    let patience = Instant::now() + Duration::from_secs(60);
    while !kept() {
        assert!(Instant::now() < patience, "nothing is kept");
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = Autosave::in_folder(root.join("data")).left_behind();
    let (_, offered) = left.first().expect("the edits are offered");
    let mut documents = Documents::open(&offered.root, &offered.scenario).unwrap();
    documents
        .restore(offered.texts.iter().map(|(path, text)| (path.clone(), text.clone())).collect());
    assert!(
        FILES.iter().any(|file| offered.texts.contains_key(*file) && documents.is_unsaved(file)),
        "they are unsaved edits again"
    );
    assert!(documents.undo() && documents.unsaved().is_empty(), "one undo takes them back");
}
