//! `endline study status`: the progress of a study and the processes that work on it; the progress bar of `study run`.

use std::io::IsTerminal;
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use endline_session::campaign::{Count, Progress, Worker, workers};
use endline_session::study::folder::Folder;
use indicatif::{ProgressBar, ProgressStyle};
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
    // Printing the status must not begin a study.
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

/// Time between two lines where there is no terminal.
const BETWEEN: Duration = Duration::from_secs(30);

/// Shows blocks done and the time left.
pub(super) struct Bar {
    bar: Option<ProgressBar>,
    noted: Mutex<Instant>,
}

impl Bar {
    pub(super) fn new() -> Self {
        let shows = std::io::stderr().is_terminal() && output::is_shown(output::Verbosity::Notes);
        let bar = shows.then(|| {
            let bar = ProgressBar::new(0).with_message("encounters");
            if let Ok(style) =
                ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}%  {eta_precise} left")
            {
                bar.set_style(style);
            }
            bar
        });
        Self { bar, noted: Mutex::new(Instant::now()) }
    }

    pub(super) fn at(&self, progress: &Progress) {
        let Count { done, total, .. } = progress.blocks;
        if let Some(bar) = &self.bar {
            let others = progress.elsewhere;
            let message = match others {
                0 => "encounters".to_owned(),
                _ => format!("encounters, {others} of them run by other processes"),
            };
            bar.set_message(message);
            bar.set_length(u64::from(total));
            bar.set_position(u64::from(done));
            return;
        }
        let mut noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        if noted.elapsed() < BETWEEN && done < total {
            return;
        }
        *noted = Instant::now();
        let left = match (progress.left(), progress.left_range()) {
            _ if done == total => String::new(),
            (Some(left), Some([low, high])) => {
                format!(", {} left [{}, {}]", duration(left), duration(low), duration(high))
            }
            (Some(left), None) => format!(", {} left", duration(left)),
            (None, _) => String::new(),
        };
        let waits = match progress.elsewhere {
            0 => String::new(),
            others => {
                format!("; {others} are run by other processes, and none is left for this one")
            }
        };
        output::note(&format!("{done} of {total} blocks of encounters{left}{waits}"));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn duration(left: Duration) -> String {
    let minutes = left.as_secs() / 60;
    match minutes {
        0 => format!("{} s", left.as_secs()),
        1..60 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}
