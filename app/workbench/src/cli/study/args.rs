//! The arguments of `endline study`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use endline_session::campaign::Shard;

use crate::cli::quantity;

#[derive(Debug, Subcommand)]
pub(in crate::cli) enum StudyCommand {
    /// Check a study and print its options, encounters, blocks, the first encounters drawn, and a forecast of its time and precision.
    Plan(PlanArgs),
    /// Run the blocks of a study that are missing; after an interruption, run the same command again. Processes that run at the same time share the blocks.
    Run(RunArgs),
    /// Print the progress of a study and the processes that work on it, on this machine or others.
    Status(StatusArgs),
    /// Write the jobs that run a study on a cluster, and hand them to its queue.
    Submit(SubmitArgs),
    /// Merge all blocks into table.parquet and table.csv.
    Merge(StudyArgs),
    /// Print the findings of a merged study and write report.html, report.csv, findings.json, strength.svg and a bundle.
    Report(ReportArgs),
    /// Print simulated shares beside those seen on real whales, as Markdown: of a merged study, or of all.
    Hindcast(HindcastArgs),
    /// Print the threats of a merged study beside those of NOAA's decision support tool, and write them in that tool's columns: by breaking strength as in its present version, or by rope, trawl and device as in that of 2019.
    Threat(ThreatArgs),
    /// Run one row of a study again and compare it with the table.
    Replay(ReplayArgs),
}

/// A study and its folder.
#[derive(Debug, Args)]
pub(in crate::cli) struct StudyArgs {
    /// Study file, or the id of a study in the gear library.
    #[arg(value_name = "STUDY")]
    pub(super) study: String,
    /// Folder of results [default: results/ followed by the study's id].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Number of encounters, in place of the number in its file. Encounters that are already in the folder of results are kept, so that
    /// the number can be increased later.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub(super) encounters: Option<u32>,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct HindcastArgs {
    /// A merged study. Without it, what is missing of every study with observations is run, and every case that belongs to the
    /// hindcast.
    #[arg(value_name = "STUDY")]
    pub(super) study: Option<String>,
    /// Folder of results of the study [default: results/ followed by its id], or the folder of these folders [default: results].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Compare results of STUDY that another version of the program, or another library, computed.
    #[arg(long, requires = "study")]
    pub(super) kept: bool,
    /// Number of encounters of each study, if its file has more.
    #[arg(long, value_name = "N", conflicts_with = "study", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) encounters: Option<u32>,
    /// Run at normal priority instead of low priority.
    #[arg(long, conflicts_with = "study")]
    pub(super) eager: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct PlanArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Run the first N encounters, and forecast time and precision from them; they are kept as the study's own.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub(super) first: Option<u32>,
    /// Number of threads for them [default: one for each core].
    #[arg(long, value_name = "N", requires = "first", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct RunArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Run only this part of the study, such as 2/7; the merged table does not depend on the parts.
    #[arg(long, value_name = "I/N", default_value = "1/1", value_parser = shard)]
    pub(super) shard: Shard,
    /// Number of threads [default: one for each core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Run at normal priority instead of low priority.
    #[arg(long)]
    pub(super) eager: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct StatusArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct SubmitArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Hand it to Slurm; docs/clusters.md describes how other queues take the same commands.
    #[arg(long, required = true)]
    pub(super) slurm: bool,
    /// Tasks of the job array that runs the encounters; each takes those that no other task runs.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) array: u32,
    /// Threads of each task.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) cpus: u16,
    /// Memory of each task, as sbatch takes it, such as 2G [default: the cluster's].
    #[arg(long, value_name = "SIZE", value_parser = word)]
    pub(super) memory: Option<String>,
    /// Time limit of each task, as sbatch takes it, such as 04:00:00 [default: the cluster's].
    #[arg(long, value_name = "TIME", value_parser = word)]
    pub(super) time: Option<String>,
    /// Account that is charged [default: the cluster's].
    #[arg(long, value_name = "NAME", value_parser = word)]
    pub(super) account: Option<String>,
    /// Partition of the cluster [default: the cluster's].
    #[arg(long, value_name = "NAME", value_parser = word)]
    pub(super) partition: Option<String>,
    /// Print the scripts without queueing them.
    #[arg(long)]
    pub(super) dry_run: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Draw the loads of a haul beside those on whales: a file that `endline haul ASSEMBLY --json` printed; may be given several
    /// times.
    #[arg(long, value_name = "FILE.json")]
    pub(super) haul: Vec<PathBuf>,
    /// Report results that another version of the program, or another library, computed. Name the study file that is kept beside them.
    #[arg(long)]
    pub(super) kept: bool,
    /// Print all tables after the answer, as --verbose does.
    #[arg(long)]
    pub(super) all: bool,
    /// Print the findings as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ThreatArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Event whose rate is the threat [default: the study's].
    #[arg(long, value_name = "EVENT")]
    pub(super) event: Option<String>,
    /// Curve of options with a strength, for the threat by breaking strength [default: that with the most strengths].
    #[arg(long, value_name = "NAME")]
    pub(super) curve: Option<String>,
    /// NOAA's threat by breaking strength [default: that of the gear library, of version 3.1].
    #[arg(long, value_name = "FILE.csv")]
    pub(super) model: Option<PathBuf>,
    /// NOAA's breaking strengths of lines by traps of a trawl [default: those of the gear library, of version 3.1].
    #[arg(long, value_name = "FILE.csv")]
    pub(super) strengths: Option<PathBuf>,
    /// Also compute the change of the mean threat by traps if each line that is stronger than this has this strength, such as "1700 lbf".
    #[arg(long, value_name = "FORCE", value_parser = quantity::force)]
    pub(super) cap: Option<f64>,
    /// Table of experts' opinion with the rows to be written, for options that name rows of the table of 2019 [default: that of the gear library].
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["curve", "model", "strengths", "cap"])]
    pub(super) poll: Option<PathBuf>,
    /// Write the table for the decision support tool; FILE-bands.csv beside it has the bands.
    #[arg(long, value_name = "FILE.csv")]
    pub(super) to: Option<PathBuf>,
    /// Print the table as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

impl ThreatArgs {
    /// Whether an argument is for the threat by breaking strength alone.
    pub(super) fn is_by_strength(&self) -> bool {
        [self.curve.is_some(), self.model.is_some(), self.strengths.is_some(), self.cap.is_some()]
            .contains(&true)
    }
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ReplayArgs {
    #[command(flatten)]
    pub(super) at: StudyArgs,
    /// Number of the encounter, from 0.
    #[arg(long, value_name = "I")]
    pub(super) row: u32,
    /// Id of the option [default: the baseline].
    #[arg(long, value_name = "ID")]
    pub(super) option: Option<String>,
    /// Folder for the row's scenario, recording, summary and picture.
    #[arg(long, value_name = "DIR")]
    pub(super) to: Option<PathBuf>,
    /// Print the run's summary as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

pub(in crate::cli) fn shard(text: &str) -> Result<Shard, String> {
    let parts = text
        .split_once('/')
        .and_then(|(part, of)| Some((part.parse::<u32>().ok()?, of.parse::<u32>().ok()?)));
    let fits = parts.filter(|(part, of)| (1..=*of).contains(part));
    fits.map(|(part, of)| Shard { part: part - 1, of })
        .ok_or_else(|| "expected a part such as 2/7: the second of seven".into())
}

/// A word of a directive, which needs no quotation.
fn word(text: &str) -> Result<String, String> {
    let fits = |letter: char| letter.is_ascii_alphanumeric() || "-_.:,+@".contains(letter);
    if !text.is_empty() && text.chars().all(fits) {
        return Ok(text.to_owned());
    }
    Err("expected letters, digits and - _ . : , + @ alone".into())
}
