//! `endline study`: plan, run, status, submit, merge, report, hindcast, threat, replay.

pub(super) mod args;
mod hindcast;
pub(super) mod status;
mod submit;
mod threat;
mod words;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use endline_session::campaign::{Control, Count, Pace, pool};
use endline_session::study::folder::Folder;
use endline_session::study::report::hauled::HauledLoad;
use endline_session::study::stats::Findings;
use endline_session::study::{PreparedStudy, REPLAY_HZ, batch, forecast, merge, report};
use endline_session::{json, locate, save};

use self::args::{PlanArgs, ReplayArgs, ReportArgs, RunArgs, StudyArgs, StudyCommand};
use self::status::Bar;
use super::interrupt::Interrupt;
use super::output::Verbosity;
use super::{Failure, host, output, picture, table};

/// Runs a study command.
pub(super) fn study(command: &StudyCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match command {
        StudyCommand::Plan(args) => plan(args, library),
        StudyCommand::Run(args) => run(args, library),
        StudyCommand::Status(args) => status::status(args, library),
        StudyCommand::Submit(args) => submit::submit(args, library),
        StudyCommand::Merge(args) => merged(args, library),
        StudyCommand::Report(args) => reported(args, library),
        StudyCommand::Hindcast(args) => hindcast::hindcast(args, library),
        StudyCommand::Threat(args) => threat::threat(args, library),
        StudyCommand::Replay(args) => replay(args, library),
    }
}

fn plan(args: &PlanArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let path = folder_of(&args.at, &opened);
    let threads = args.threads.map_or_else(all_cores, usize::from);
    let (forecast, interrupted) = match args.first {
        Some(first) => {
            let folder = Folder::open(&path, &opened)?;
            let watched =
                |control: &Control| forecast::of_first(&opened, &folder, first, threads, control);
            let (forecast, interrupt) = with_progress(watched)?;
            (Some(forecast), interrupt.exit_code())
        }
        // Printing the plan must not begin a study.
        None if path.join("study.json").is_file() => {
            let folder = Folder::open(&path, &opened)?;
            (Some(forecast::of_stored(&opened, &folder, &Pace::default())?), None)
        }
        None => (None, None),
    };
    output::print(&if args.json {
        opened.plan_json(forecast.as_ref()) + "\n"
    } else {
        words::plan(&opened) + &words::forecast(&opened, forecast.as_ref(), threads)
    })?;
    Ok(interrupted.unwrap_or(ExitCode::SUCCESS))
}

fn run(args: &RunArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let folder = Folder::open(&folder_of(&args.at, &opened), &opened)?;
    if !args.eager {
        lower_priority();
    }
    let threads = args.threads.map_or_else(all_cores, usize::from);
    let (progress, interrupt) =
        with_progress(|control| batch::run(&opened, &folder, args.shard, threads, control))?;
    if let Some(code) = interrupt.exit_code() {
        let Count { done, total, .. } = progress.blocks;
        output::warn(&format!(
            "interrupted: {done} of {total} encounters are kept in {}; the same command continues from them",
            folder.path.display()
        ));
        return Ok(code);
    }
    output::print(&words::ran(&opened, &folder, progress.blocks))?;
    Ok(ExitCode::SUCCESS)
}

/// Runs encounters with a bar of progress that disappears at the end; a signal cancels them.
fn with_progress<T>(
    work: impl FnOnce(&Control) -> Result<T, endline_session::Error>,
) -> Result<(T, Interrupt), Failure> {
    let bar = Bar::new();
    let control = Arc::new(Control::new(move |progress| bar.at(progress)));
    let (interrupt, watched) = (Interrupt::watch(), Arc::downgrade(&control));
    interrupt.on_asked(move || {
        if let Some(control) = watched.upgrade() {
            control.cancel();
        }
    });
    Ok((work(&control)?, interrupt))
}

fn merged(args: &StudyArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(args, library)?;
    let folder = Folder::open(&folder_of(args, &opened), &opened)?;
    let table = merge::merge(&opened, &folder)?;
    merge::save(&opened, &folder, &table)?;
    output::print(&format!(
        "{} rows in {}\n",
        table.rows().len(),
        folder.path.join("table.parquet").display()
    ))?;
    Ok(ExitCode::SUCCESS)
}

fn reported(args: &ReportArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let hauls: Vec<HauledLoad> =
        args.haul.iter().map(|file| HauledLoad::read(file)).collect::<Result<_, _>>()?;
    let opened = open(&args.at, library)?;
    let folder = stored(&args.at, args.kept, &opened)?;
    let table = merge::load(&folder)?;
    let findings = Findings::of(&opened, &table, &folder);
    let page = report::write(&opened, &folder, &findings, &hauls)?;
    output::note(&format!("the report is {}", page.display()));
    output::print(&if args.json {
        json::line(&findings) + "\n"
    } else {
        words::findings(&opened, &findings, args.all || output::is_shown(Verbosity::Details))
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Runs a row again; where the study was merged, its hash must be that of the table.
fn replay(args: &ReplayArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    if u64::from(args.row) >= opened.study.encounters {
        return Err(Failure::usage(format!(
            "--row {}: the study has encounters 0 to {}",
            args.row,
            opened.study.encounters - 1
        )));
    }
    let option = args.option.as_deref().map_or(Ok(opened.baseline), |id| opened.option(id))?;
    let frames_hz = if args.to.is_some() { REPLAY_HZ } else { 0.0 };
    let path = folder_of(&args.at, &opened);
    // A replay must not begin a study, and needs its results only where the study adapts.
    let encounter = if path.join("study.json").is_file() {
        opened.encounter(&Folder::open(&path, &opened)?, args.row)?
    } else {
        opened.first_stage(args.row)?
    };
    let played = opened.play(option, &encounter, frames_hz)?;
    if let Some(to) = &args.to {
        save_run(to, &played)?;
    }
    output::print(&if args.json {
        json::line(&played.report) + "\n"
    } else {
        table::summary(&played.report)
    })?;
    compare(args, &opened, option, &played.report.state_hash)
}

pub(super) fn save_run(to: &Path, played: &endline_session::study::Played) -> Result<(), Failure> {
    std::fs::create_dir_all(to)
        .map_err(|error| Failure::failed(format!("{}: cannot be made: {error}", to.display())))?;
    let texts = [
        ("scenario.toml", &played.run.prepared().source.scenario),
        ("summary.json", &json::line(&played.report)),
    ];
    for (name, text) in texts {
        let file = to.join(name);
        save::atomically(&file, text.as_bytes()).map_err(|error| {
            Failure::failed(format!("{}: cannot be written: {error}", file.display()))
        })?;
    }
    played.run.save_recording(&to.join("recording.endline"))?;
    picture::of_peak(&played.run, &played.report, &to.join("picture.png"));
    Ok(())
}

fn compare(
    args: &ReplayArgs,
    opened: &PreparedStudy,
    option: usize,
    hash: &str,
) -> Result<ExitCode, Failure> {
    let folder = Folder::open(&folder_of(&args.at, opened), opened)?;
    let Ok(runs) = merge::load(&folder) else { return Ok(ExitCode::SUCCESS) };
    match runs.find(&opened.options[option].id, args.row) {
        Some(recorded) if recorded.state_hash != hash => Err(Failure::failed(format!(
            "the run ends in state {hash}, the table has {}: another program ran the study",
            recorded.state_hash
        ))),
        Some(_) => {
            output::note("the run ends in the state that the table has");
            Ok(ExitCode::SUCCESS)
        }
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Opens a study by its file or its id in the gear library.
fn open(args: &StudyArgs, library: Option<&Path>) -> Result<PreparedStudy, Failure> {
    let path = locate::named(&args.study, "studies", library).map_err(Failure::failed)?;
    let mut opened = PreparedStudy::open(&path, library, &host::load())?;
    if let Some(encounters) = args.encounters {
        opened.study.encounters = encounters.into();
    }
    Ok(opened)
}

fn folder_of(args: &StudyArgs, opened: &PreparedStudy) -> PathBuf {
    args.out.clone().unwrap_or_else(|| Path::new("results").join(&opened.study.id))
}

/// The folder of results of a study; with `kept`, one whose rows another program or library may have computed.
fn stored(args: &StudyArgs, kept: bool, opened: &PreparedStudy) -> Result<Folder, Failure> {
    let path = folder_of(args, opened);
    Ok(if kept { Folder::open_kept(&path, opened)? } else { Folder::open(&path, opened)? })
}

/// A thread for each core.
pub(super) fn all_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Lowers the priority of this process.
pub(super) fn lower_priority() {
    if let Err(error) = pool::try_lower_priority() {
        output::note(&format!("runs at ordinary priority: {error}"));
    }
}
