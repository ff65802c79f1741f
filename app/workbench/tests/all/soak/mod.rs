//! Random sessions of the window with faults, killed at random moments, and checks of what they leave.
//!
//! | file | content |
//! |---|---|
//! | `session` | a separate process that gives random commands and edits until it is killed |
//! | `fault` | faults |
//! | `journal` | the report of a session, and what may be lost |
//!
//! After each session: no file is truncated, the library opens, no edit older than 30 s is lost, memory is bounded, the session did not
//! hang and did not end by itself. The suite runs one session per fault; `cargo xtask soak --hours N` runs for hours, with a seed from
//! the clock.
#![cfg(unix)]

mod fault;
mod journal;
mod session;

use std::fmt;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use endline_gear::Document;
use endline_session::edit::Documents;
use endline_session::edit::recovery::Autosave;

use crate::common::{Folder, add_study};
use crate::search::add_observation;
use fault::Fault;
use journal::Journal;

/// Seed of the suite, always the same, so that a failure is reproducible.
const SEED: u64 = 20_261_127;
/// Sessions on one library, each on what the previous one left, before a fresh library is used.
const ON_ONE: u64 = 10;
/// A session without output for this time hangs.
const HANGS: Duration = Duration::from_secs(120);
/// Greatest memory of a session [MB].
const MOST_MB: u64 = 2000;

/// Pseudorandom numbers (linear congruential generator MMIX by Knuth).
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end.max(1)
    }
}

/// Sessions of a soak.
struct Soak {
    seed: u64,
    /// Time after which no session starts.
    until: Option<Instant>,
    /// Greatest number of sessions.
    sessions: u64,
    /// Greatest duration of a session [s].
    longest_s: usize,
}

/// Result of a soak.
#[derive(Default)]
struct Report {
    sessions: u64,
    commands: u64,
    edits: u64,
    kept: u64,
    most_mb: u64,
    wrong: Vec<String>,
}

#[test]
fn random_sessions_with_faults_lose_and_break_nothing() {
    let hours: Option<f64> =
        std::env::var("ENDLINE_SOAK_HOURS").ok().and_then(|hours| hours.parse().ok());
    let soak = hours.map_or(
        Soak { seed: SEED, until: None, sessions: Fault::ALL.len() as u64, longest_s: 2 },
        |hours| Soak {
            seed: std::time::UNIX_EPOCH.elapsed().map_or(SEED, |since| since.as_nanos() as u64),
            until: Some(Instant::now() + Duration::from_secs_f64(hours * 3600.0)),
            sessions: u64::MAX,
            longest_s: 40,
        },
    );
    let report = soak.run();
    println!("{report}");
    assert!(report.wrong.is_empty(), "{report}");
    assert!(report.commands > 0 && report.edits > 0, "{report}");
}

impl Soak {
    fn run(&self) -> Report {
        let mut report = Report::default();
        let mut folder = None;
        for number in 0..self.sessions {
            if self.until.is_some_and(|until| Instant::now() > until) {
                break;
            }
            if number % ON_ONE == 0 {
                folder = None;
            }
            let folder = folder.get_or_insert_with(|| {
                let folder = Folder::new(&format!("soak-{number}"));
                add_study(&folder);
                add_observation(&folder);
                folder
            });
            let fault = Fault::ALL[number as usize % Fault::ALL.len()];
            let seed = self.seed.wrapping_add(number);
            let wrong = self.session(&folder.0, seed, fault, &mut report);
            report.sessions += 1;
            report.wrong.extend(
                wrong
                    .into_iter()
                    .map(|what| format!("session {number}, seed {seed}, {fault:?}: {what}")),
            );
        }
        report
    }

    /// Runs one session and returns what is wrong after it.
    fn session(&self, root: &Path, seed: u64, fault: Fault, report: &mut Report) -> Vec<String> {
        let data = root.join("data");
        let mut dice = Dice(seed);
        let mut child = began(root, seed, fault);
        let output = lines(&mut child);
        let life = Duration::from_millis(1000 + dice.below(1000 * self.longest_s) as u64);
        let (journal, mut wrong) = watched(&mut child, &output, life, root, fault, &mut dice);
        fault.end(root);
        report.commands += journal.commands;
        report.edits += journal.edits;
        report.most_mb = report.most_mb.max(journal.most_mb);
        if journal.most_mb > MOST_MB {
            wrong.push(format!("it used {} MB", journal.most_mb));
        }
        let left = Autosave::in_folder(data).left_behind();
        let kept = left.first().map(|(_, kept)| &kept.texts);
        report.kept += u64::from(kept.is_some());
        if fault.allows_recovery_files() {
            wrong.extend(journal.lost(kept));
        }
        wrong.extend(truncated(root));
        wrong
    }
}

/// Starts a session as a separate process.
fn began(root: &Path, seed: u64, fault: Fault) -> Child {
    let mut command = fault.command(&std::env::current_exe().unwrap(), root);
    command
        .args(["soak::session::role_of_a_session_process", "--exact", "--nocapture"])
        .env(session::ROOT, root)
        .env(session::SEED, seed.to_string())
        .env(session::FAULT, fault.name())
        .env("XDG_DATA_HOME", root.join("home"))
        .env("XDG_CACHE_HOME", root.join("home"))
        .env("RUST_BACKTRACE", "0")
        .stdout(Stdio::piped())
        .stderr(std::fs::File::create(root.join("said")).unwrap());
    command.spawn().unwrap()
}

/// Output of a session, line by line.
fn lines(child: &mut Child) -> Receiver<String> {
    let out = BufReader::new(child.stdout.take().unwrap());
    let (sender, output) = channel();
    std::thread::spawn(move || {
        out.lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
    });
    output
}

/// Lets a session run with its fault, then kills it. Returns its journal and what is wrong with its end.
fn watched(
    child: &mut Child,
    output: &Receiver<String>,
    life: Duration,
    root: &Path,
    fault: Fault,
    dice: &mut Dice,
) -> (Journal, Vec<String>) {
    let (mut journal, mut wrong) = (Journal::default(), Vec::new());
    let (mut begun, mut heard) = (None, Instant::now());
    loop {
        while let Ok(line) = output.recv_timeout(Duration::from_millis(100)) {
            heard = Instant::now();
            if journal.take(&line) {
                begun.get_or_insert(heard);
            }
        }
        fault.strike(root, dice);
        if child.try_wait().unwrap().is_some() {
            let said = std::fs::read_to_string(root.join("said")).unwrap_or_default();
            let last: Vec<&str> = said.lines().rev().take(6).collect();
            wrong.push(format!("it ended by itself after {}: {last:?}", journal.last));
            break;
        }
        if heard.elapsed() > HANGS {
            wrong.push(format!("it hangs after {}", journal.last));
            break;
        }
        if begun.is_some_and(|begun: Instant| begun.elapsed() > life) {
            break;
        }
    }
    // A session that has ended cannot be killed.
    let _ = child.kill();
    child.wait().unwrap();
    while let Ok(line) = output.recv_timeout(Duration::from_millis(200)) {
        journal.take(&line);
    }
    (journal, wrong)
}

/// Truncated files of the library, and whether the library opens.
fn truncated(root: &Path) -> Vec<String> {
    let mut wrong = Vec::new();
    for folder in std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()) {
        for file in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let file: PathBuf = file.path();
            if file.extension().is_some_and(|ending| ending == "toml") {
                let text = std::fs::read_to_string(&file).unwrap_or_default();
                if text.is_empty() || Document::parse(&text).is_err() {
                    wrong.push(format!("{} is truncated", file.display()));
                }
            }
        }
    }
    if let Err(error) = Documents::open(root, &session::scenario(root)) {
        wrong.push(format!("the library does not open: {error}"));
    }
    wrong
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} sessions, {} commands, {} edits, {} recovery files, peak memory {} MB, {} wrong",
            self.sessions,
            self.commands,
            self.edits,
            self.kept,
            self.most_mb,
            self.wrong.len()
        )?;
        self.wrong.iter().try_for_each(|wrong| writeln!(f, "  {wrong}"))
    }
}
