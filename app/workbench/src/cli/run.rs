//! `endline run` and `endline settle`: settle, step to the end, report, record.

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use endline_gear::RunRule;
use endline_session::recording::replay::take_over;
use endline_session::settled::SettledShape;
use endline_session::{Prepared, Recording, Report, Run, RunOptions, json};
use endline_sim::settle as find_rest;

use super::args::{RunArgs, SettleArgs};
use super::interrupt::{self, Interrupt};
use super::output::{Progress, Verbosity};
use super::{Failure, host, output, picture, player, table};

/// The recording's name in the folder of results.
const RECORDING: &str = "recording.endline";

/// Frames kept for choosing the picture, for each simulated second.
const FRAMES_HZ: f64 = 10.0;

pub(super) fn run(args: &RunArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    if let (Some(from), Some(folder)) = (&args.from, &args.out) {
        output::not_its_own_input(from, &folder.join(RECORDING))?;
    }
    let host = host::load();
    let recording = args.from.as_deref().map(Recording::load).transpose()?;
    let over = args.over.overrides().or(recording
        .as_ref()
        .map(|recording| recording.source.overrides.clone())
        .unwrap_or_default());
    let prepared = player::prepared(&args.scenario, library, &host, (over, &args.over.set))?;
    let mut run = started(args, recording.as_ref(), prepared)?;
    let interrupt = Interrupt::watch();
    to_end(args, &mut run, &interrupt);

    let report = Report::from_run(&run);
    // A summary is not lost with a recording that cannot be kept.
    let kept = args.out.as_ref().map_or(Ok(()), |folder| save(&run, &report, folder));
    output::print(&printed(args, &report))?;
    kept?;
    if let Some(code) = interrupt.exit_code() {
        output::warn(&how_to_continue(args, &run));
        return Ok(code);
    }
    if let Some(stopped) = &report.stopped {
        return Err(Failure::failed(stopped));
    }
    Ok(ExitCode::SUCCESS)
}

/// The report as JSON, as a headline, or with all figures.
fn printed(args: &RunArgs, report: &Report) -> String {
    if args.json {
        json::line(report) + "\n"
    } else if args.all || output::is_shown(Verbosity::Details) {
        table::summary(report)
    } else {
        table::headline(report) + "\nAll figures: the same command with --all, or with --json.\n"
    }
}

/// To the end, until it is over where that is asked for, or to an interrupt.
fn to_end(args: &RunArgs, run: &mut Run, interrupt: &Interrupt) {
    let progress = Progress::new("running");
    let rule = RunRule::default();
    run.to_end_until(|run| {
        progress.at(run.state().step, run.steps_in_all());
        if interrupt.is_asked() {
            run.give_up("it was interrupted");
            return true;
        }
        args.until_over && run.is_time_to_look() && run.is_over(&rule)
    });
}

/// The command that continues an interrupted run.
fn how_to_continue(args: &RunArgs, run: &Run) -> String {
    let time_s = run.state().time_s;
    match &args.out {
        Some(folder) => {
            let recording = folder.join(RECORDING).display().to_string();
            let again = interrupt::command_line(&[
                ("--from", &recording),
                ("--at", &format!("{time_s:.6}s")),
                ("--out", &format!("{}-2", folder.display())),
            ]);
            format!("interrupted at {time_s:.2} s; to continue from there: {again}")
        }
        None => format!(
            "interrupted at {time_s:.2} s, and no recording is kept; with --out DIR the run could continue from there"
        ),
    }
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
    let report = |step, steps| progress.at(step, steps);
    Ok(take_over(recording, prepared, RunOptions { unsettled, ..options }, at, report)?)
}

/// Writes `summary.json`, `recording.endline` and, where this build draws, `picture.png`.
fn save(run: &Run, report: &Report, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::failed(format!("{}: cannot be made: {error}", folder.display()))
    })?;
    let summary = folder.join("summary.json");
    endline_session::save::atomically(&summary, json::line(&report).as_bytes()).map_err(
        |error| Failure::failed(format!("{}: cannot be written: {error}", summary.display())),
    )?;
    run.save_recording(&folder.join(RECORDING))?;
    picture::of_peak(run, report, &folder.join("picture.png"));
    Ok(())
}

pub(super) fn settle(args: &SettleArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let over = args.over.overrides();
    let prepared =
        player::prepared(&args.scenario, library, &host::load(), (over, &args.over.set))?;
    let start = Instant::now();
    let settled = find_rest(&prepared.model);
    let shape = SettledShape::of(&prepared, &settled, start.elapsed().as_secs_f64());
    output::print(&if args.json { json::line(&shape) + "\n" } else { table::settled(&shape) })?;
    if settled.converged {
        return Ok(ExitCode::SUCCESS);
    }
    Err(Failure::failed(format!(
        "found no rest in {} passes: {}",
        settled.trace_n.len(),
        settled.why()
    )))
}
