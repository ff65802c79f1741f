//! `endline run`: settle, step to the end, report, record.

use std::path::Path;
use std::process::ExitCode;

use endline_session::{Report, Run, RunOptions, prepare};

use super::args::RunArgs;
use super::progress::Progress;
use super::{Failure, host, output, picture, table};

/// Frames kept for choosing the picture, for each simulated second.
const FRAMES_HZ: f64 = 10.0;

pub(super) fn run(args: &RunArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let host = host::load();
    let prepared = prepare(&args.scenario, library, &host, args.over.overrides())?;
    let frames_hz = if args.out.is_some() { FRAMES_HZ } else { 0.0 };
    let mut run = Run::new(prepared, RunOptions { unsettled: args.unsettled, frames_hz })?;
    let progress = Progress::new("running");
    run.to_end(|step, steps| progress.at(step, steps));
    drop(progress);

    let report = Report::of(&run);
    if let Some(folder) = &args.out {
        save(&run, &report, folder)?;
    }
    output::print(&if args.json { report.json() + "\n" } else { table::summary(&report) })?;
    if let Some(stopped) = &report.stopped {
        return Err(Failure::failed(stopped));
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes `summary.json`, `recording.endline` and, where this build draws, `picture.png`.
fn save(run: &Run, report: &Report, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::failed(format!("{}: cannot be made: {error}", folder.display())))?;
    let summary = folder.join("summary.json");
    endline_session::save::atomically(&summary, report.json().as_bytes())
        .map_err(|error| Failure::failed(format!("{}: cannot be written: {error}", summary.display())))?;
    run.recording().save(&folder.join("recording.endline"))?;
    picture::of_peak(run, report, &folder.join("picture.png"));
    Ok(())
}
