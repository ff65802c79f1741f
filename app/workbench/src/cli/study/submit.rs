//! `endline study submit`: the jobs that run a study on a cluster under Slurm, and merge and report it then.
//!
//! Every task of the array runs `endline study run` on the same folder; leases share the encounters among them. A task that is
//! preempted, fails or reaches its time limit costs the encounters in progress, and the others, or the next submission, run them.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use endline_session::study::folder::Folder;
use endline_session::{locate, save, shell};

use super::args::SubmitArgs;
use super::{folder_of, open};
use crate::cli::{Failure, output};

/// How long before its time limit a task is asked to end [s].
const WARNING_S: u32 = 60;

/// The parts of the jobs.
struct Jobs<'a> {
    args: &'a SubmitArgs,
    /// Id of the study.
    id: &'a str,
    /// This program, quoted for a shell.
    program: String,
    /// Study, library and folder of results, as arguments of a command.
    at: String,
    /// Folder of results.
    folder: &'a Path,
}

pub(super) fn submit(args: &SubmitArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let folder = absolute(&folder_of(&args.at, &opened))?;
    let program = std::env::current_exe()
        .map_err(|error| Failure::failed(format!("cannot find this program's file: {error}")))?;
    let jobs = Jobs {
        args,
        id: &opened.study.id,
        program: shell::path(&program),
        at: arguments(args, library, &folder)?,
        folder: &folder,
    };
    let (run, report) = (jobs.run(), jobs.report());
    if args.dry_run {
        output::print(&format!("{run}\n{report}"))?;
        return Ok(ExitCode::SUCCESS);
    }
    // A folder of another study is refused before anything is queued.
    Folder::open(&folder, &opened)?;
    let run = queue(&written(&folder.join("slurm-run.sh"), &run)?, &[])?;
    let after = format!("--dependency=afterany:{run}");
    let report = queue(&written(&folder.join("slurm-report.sh"), &report)?, &[&after])?;
    output::print(&format!(
        "job {run}: {} tasks run {} encounters; job {report} then merges and reports them\n\
         next: endline study status {}\n\
         where all tasks were ended too soon, job {report} lists what is missing, and the same command queues it\n",
        args.array, opened.study.encounters, jobs.at
    ))?;
    Ok(ExitCode::SUCCESS)
}

impl Jobs<'_> {
    /// The script of the array that runs the encounters.
    fn run(&self) -> String {
        let SubmitArgs { array, cpus, memory, time, .. } = self.args;
        let mut lines = self.head("run", "slurm-%A-%a.log");
        lines.push(format!("#SBATCH --array=1-{array}"));
        lines.push(format!("#SBATCH --cpus-per-task={cpus}"));
        lines.extend(memory.iter().map(|memory| format!("#SBATCH --mem={memory}")));
        lines.extend(time.iter().map(|time| format!("#SBATCH --time={time}")));
        lines.push(format!("#SBATCH --signal=B:TERM@{WARNING_S}"));
        lines.push("#SBATCH --requeue".into());
        lines.push("#SBATCH --open-mode=append".into());
        let Self { program, at, .. } = self;
        lines.push(format!("exec {program} study run {at} --threads {cpus} --eager"));
        lines.join("\n") + "\n"
    }

    /// The script that merges and reports them.
    fn report(&self) -> String {
        let mut lines = self.head("report", "slurm-%j.log");
        let Self { program, at, .. } = self;
        lines.push(format!("{program} study merge {at} && {program} study report {at}"));
        lines.join("\n") + "\n"
    }

    /// The head of both scripts.
    fn head(&self, what: &str, log: &str) -> Vec<String> {
        let SubmitArgs { account, partition, .. } = self.args;
        // Slurm takes a percent sign in this path for the beginning of a number of the job.
        let log = self.folder.join(log).display().to_string();
        let mut lines =
            vec!["#!/bin/sh".to_owned(), format!("#SBATCH --job-name=endline-{what}-{}", self.id)];
        lines.push(format!("#SBATCH --output=\"{log}\""));
        lines.extend(account.iter().map(|account| format!("#SBATCH --account={account}")));
        lines.extend(partition.iter().map(|partition| format!("#SBATCH --partition={partition}")));
        lines
    }
}

/// Study, library and folder of results by their whole paths, as tasks may begin elsewhere.
fn arguments(args: &SubmitArgs, library: Option<&Path>, folder: &Path) -> Result<String, Failure> {
    let study = locate::named(&args.at.study, "studies", library).map_err(Failure::failed)?;
    let root = locate::library(Some(&study), library).map_err(Failure::failed)?;
    let library = absolute(&root)?;
    let encounters = args.at.encounters.map(|count| format!(" --encounters {count}"));
    Ok(format!(
        "{} --library {} --out {}{}",
        shell::path(&absolute(&study)?),
        shell::path(&library),
        shell::path(folder),
        encounters.unwrap_or_default()
    ))
}

fn absolute(path: &Path) -> Result<PathBuf, Failure> {
    std::path::absolute(path)
        .map_err(|error| Failure::failed(format!("{}: {error}", path.display())))
}

fn written(file: &Path, script: &str) -> Result<PathBuf, Failure> {
    save::atomically(file, script.as_bytes()).map_err(|error| {
        Failure::failed(format!("{}: cannot be written: {error}", file.display()))
    })?;
    Ok(file.to_path_buf())
}

/// Hands a script to Slurm; the number of its job.
fn queue(script: &Path, options: &[&str]) -> Result<String, Failure> {
    let output = Command::new("sbatch").arg("--parsable").args(options).arg(script).output();
    let line = format!("sbatch {}", shell::path(script));
    let output = output.map_err(|error| {
        Failure::failed(format!(
            "sbatch cannot be started: {error}; where Slurm is, run `{line}`, or see the scripts with --dry-run"
        ))
    })?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        return Err(Failure::failed(format!("`{line}` failed: {}", why.trim())));
    }
    // Of several clusters, the number is followed by the name of one.
    let printed = String::from_utf8_lossy(&output.stdout);
    Ok(printed.trim().split(';').next().unwrap_or_default().to_owned())
}
