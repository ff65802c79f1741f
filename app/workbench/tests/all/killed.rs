//! A process killed with SIGKILL at random moments of an editing script breaks no file and loses few edits, and the rest is recovered.
#![cfg(all(feature = "gui", unix))]

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use endline_gear::Document;
use endline_session::edit::Documents;
use endline_session::edit::recovery::{Autosave, UnsavedEdits};

use crate::common::Folder;

/// Script time per real time: half a minute takes three seconds, which a busy disk may need to write one file.
const HASTE: f64 = 10.0;
/// Greatest age of lost edits [s of script time].
const LOST_S: f64 = 30.0;
/// Number of processes killed, and how many run at the same time.
const KILLS: [usize; 2] = [10, 5];
/// Environment variable that makes the test below the process to be killed.
const ROLE: &str = "ENDLINE_TEST_EDITS";

/// The two files that the script edits, and their field.
const FILES: [&str; 2] = ["ropes/sink-3-8.toml", "ropes/nylon-1-2.toml"];
const FIELD: &str = "strength";

/// Makes a small library of two ropes and a scenario that uses one, so that an edit is fast.
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

/// The script: edits, sometimes saved, with recovery files as in the window. Each edit is logged before it is made.
fn edit_until_killed(root: &Path) {
    let mut documents =
        Documents::open(root, &root.join("scenarios/reference-a-pendulum.toml")).unwrap();
    // A folder that does not exist yet, as at the first start.
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

/// Number of the edit that a text contains; `None` for the original figure.
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
    let exact = ["killed::role_of_the_script_process", "--exact", "--nocapture"];
    Command::new(program)
        .args(exact)
        .env(ROLE, root)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Starts and kills one process, and returns the errors in the files that it left.
fn kill_one(root: &Path, after: Duration) -> String {
    let before = std::fs::read_to_string(root.join("log")).unwrap_or_default().lines().count();
    let mut child = began(root);
    let patience = Instant::now() + Duration::from_secs(60);
    // Time starts with the first edit.
    while std::fs::read_to_string(root.join("log")).unwrap_or_default().lines().count() <= before {
        assert!(Instant::now() < patience, "the script does not start");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(after);
    child.kill().unwrap();
    child.wait().unwrap();
    let wrong = check(root, before);
    for (file, _) in Autosave::in_folder(root.join("data")).left_behind() {
        std::fs::remove_file(file).unwrap();
    }
    wrong
}

/// Checks that files are complete and that recent edits are in a file or recovery file.
fn check(root: &Path, first: usize) -> String {
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
    // The edit is from before this process, which had not written a recovery file yet.
    let kept_s =
        newest.and_then(|edit| times.get(edit.checked_sub(first)?).copied()).unwrap_or(0.0);
    let lost_s = times.last().copied().unwrap_or(0.0) - kept_s;
    if lost_s > LOST_S {
        let _ = writeln!(wrong, "edits of {lost_s:.1} s are lost of {:?} s", times.last());
    }
    if Documents::open(root, &root.join("scenarios/reference-a-pendulum.toml")).is_err() {
        let _ = writeln!(wrong, "the library does not open");
    }
    wrong
}

#[test]
fn role_of_the_script_process() {
    if let Some(root) = std::env::var_os(ROLE) {
        edit_until_killed(&PathBuf::from(root));
    }
}

#[test]
fn fifty_processes_killed_while_editing_break_no_file_and_lose_few_edits() {
    let folder = Folder::new("fifty-kills");
    let wrong: Vec<String> = std::thread::scope(|scope| {
        let work = |which: usize| {
            let root = folder.0.join(format!("killed-{which}"));
            small_library(&folder, &root);
            // Moments spread over the script by the golden ratio.
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
fn edits_of_a_killed_process_are_recovered_completely() {
    let folder = Folder::new("one-kill");
    let root = folder.0.join("killed");
    small_library(&folder, &root);
    let mut child = began(&root);
    // Waits for the first recovery file.
    let kept = || {
        std::fs::read_dir(root.join("data"))
            .into_iter()
            .flatten()
            .flatten()
            .any(|entry| entry.file_name().to_string_lossy().ends_with(".json"))
    };
    let patience = Instant::now() + Duration::from_secs(60);
    while !kept() {
        assert!(Instant::now() < patience, "no recovery file");
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = Autosave::in_folder(root.join("data")).left_behind();
    let (_, offered) = left.first().expect("no edits to recover");
    let mut documents = Documents::open(&offered.root, &offered.scenario).unwrap();
    documents
        .restore(offered.texts.iter().map(|(path, text)| (path.clone(), text.clone())).collect());
    assert!(
        FILES.iter().any(|file| offered.texts.contains_key(*file) && documents.is_unsaved(file)),
        "they are unsaved edits"
    );
    assert!(documents.undo() && documents.unsaved().is_empty(), "one undo reverts them");
}
