//! `endline run`: settle, step to the end, report, record.

use std::path::Path;
use std::process::ExitCode;

use endline_gear::RunRule;
use endline_session::recording::take_over::take_over;
use endline_session::{Prepared, Recording, Report, Run, RunOptions, prepare};

use super::args::RunArgs;
use super::progress::Progress;
use super::{Failure, host, output, picture, table};

/// Frames kept for choosing the picture, for each simulated second.
const FRAMES_HZ: f64 = 10.0;

pub(super) fn run(args: &RunArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let host = host::load();
    let recording = args.from.as_deref().map(Recording::load).transpose()?;
    let over = args.over.overrides().or(recording
        .as_ref()
        .map(|recording| recording.source.overrides.clone())
        .unwrap_or_default());
    let prepared = prepare(&args.scenario, library, &host, over)?;
    let mut run = started(args, recording.as_ref(), prepared)?;
    let progress = Progress::new("running");
    let tell = |step, steps| progress.at(step, steps);
    if args.until_over {
        run.to_end_or_over(&RunRule::default(), tell);
    } else {
        run.to_end(tell);
    }
    drop(progress);

    let report = Report::from_run(&run);
    if let Some(folder) = &args.out {
        save(&run, &report, folder)?;
    }
    output::print(&if args.json { report.json() + "\n" } else { table::summary(&report) })?;
    if let Some(stopped) = &report.stopped {
        return Err(Failure::failed(stopped));
    }
    Ok(ExitCode::SUCCESS)
}

/// The run at its start, or at the moment taken over from a recording.
fn started(
    args: &RunArgs,
    recording: Option<&Recording>,
    prepared: Prepared,
) -> Result<Run, Failure> {
    let frames_hz = if args.out.is_some() { FRAMES_HZ } else { 0.0 };
    let options = RunOptions { unsettled: args.unsettled, frames_hz };
    let (Some(recording), Some(at)) = (recording, args.at) else {
        return Ok(Run::new(prepared, options)?);
    };
    let unsettled = args.unsettled || recording.header.unsettled;
    let progress = Progress::new("replaying");
    let tell = |step, steps| progress.at(step, steps);
    Ok(take_over(recording, prepared, RunOptions { unsettled, ..options }, at, tell)?)
}

/// Writes `summary.json`, `recording.endline` and, where this build draws, `picture.png`.
fn save(run: &Run, report: &Report, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::failed(format!("{}: cannot be made: {error}", folder.display()))
    })?;
    let summary = folder.join("summary.json");
    endline_session::save::atomically(&summary, report.json().as_bytes()).map_err(|error| {
        Failure::failed(format!("{}: cannot be written: {error}", summary.display()))
    })?;
    run.recording().save(&folder.join("recording.endline"))?;
    picture::of_peak(run, report, &folder.join("picture.png"));
    Ok(())
}
