//! `endline study status`: how far a study is, and which processes work on it.

use std::path::Path;
use std::process::ExitCode;

use endline_session::campaign::{Worker, workers};
use endline_session::study::folder::Folder;
use schemars::JsonSchema;
use serde::Serialize;

use super::args::StatusArgs;
use super::{folder_of, open};
use crate::cli::table::columns;
use crate::cli::{Failure, output};

/// Name of the schema of `--json`.
pub(in crate::cli) const SCHEMA: &str = "endline.study_status/1";

/// How a study stands.
#[derive(JsonSchema, Serialize)]
pub(in crate::cli) struct Status {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// Id of the study.
    study: String,
    /// Folder of its results.
    folder: String,
    /// Encounters that are written.
    done: usize,
    /// Encounters of the study.
    encounters: u64,
    /// Processes that work on it, or have ended at work.
    processes: Vec<Process>,
}

/// A process at work on a study.
#[derive(JsonSchema, Serialize)]
struct Process {
    /// Name of its machine.
    machine: String,
    /// The machine's number of the process.
    pid: u32,
    /// Encounters that it runs.
    runs: Vec<u32>,
    /// Time since it was last seen at work [s].
    silent_s: f64,
    /// Whether it has ended, so that others run its encounters.
    has_ended: bool,
}

impl From<Worker> for Process {
    fn from(worker: Worker) -> Self {
        Self {
            machine: worker.machine,
            pid: worker.pid,
            runs: worker.blocks.into_iter().collect(),
            silent_s: worker.silent.as_secs_f64(),
            has_ended: worker.has_ended,
        }
    }
}

pub(super) fn status(args: &StatusArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let path = folder_of(&args.at, &opened);
    // To look must not begin a study.
    let (done, processes) = if path.join("study.json").is_file() {
        let folder = Folder::open(&path, &opened)?;
        (folder.written()?.range(..folder.blocks()).count(), workers(&path)?)
    } else {
        (0, Vec::new())
    };
    let status = Status {
        schema: SCHEMA,
        study: opened.study.id.clone(),
        folder: path.display().to_string(),
        done,
        encounters: opened.study.encounters,
        processes: processes.into_iter().map(Process::from).collect(),
    };
    output::print(&if args.json { json(&status) } else { words(&status) })?;
    Ok(ExitCode::SUCCESS)
}

fn json(status: &Status) -> String {
    serde_json::to_string_pretty(status).unwrap_or_default() + "\n"
}

fn words(status: &Status) -> String {
    let Status { study, folder, done, encounters, processes, .. } = status;
    let mut text = format!("{study}: {done} of {encounters} encounters are done in {folder}\n");
    if processes.is_empty() {
        return text + "no process is at work on it\n";
    }
    let mut rows =
        vec![["machine", "process", "encounters", "last seen"].map(String::from).to_vec()];
    rows.extend(processes.iter().map(|process| {
        let ended = if process.has_ended { ", has ended; others run its encounters" } else { "" };
        let runs: Vec<String> = process.runs.iter().map(u32::to_string).collect();
        vec![
            process.machine.clone(),
            process.pid.to_string(),
            runs.join(" "),
            format!("{:.0} s ago{ended}", process.silent_s),
        ]
    }));
    text += &columns(&rows);
    text
}
