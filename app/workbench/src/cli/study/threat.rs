//! `endline study threat`: the threat tables of a merged study, for NOAA's decision support tool.
//!
//! Options that name rows of the table of 2019 give that table (here); options with a strength on a curve give the threat by breaking
//! strength, beside NOAA's present model (`threat_strength.rs`).

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::{Diagnostic, StudyEvent, hint};
use endline_session::study::folder::Folder;
use endline_session::study::threat::{
    ExpertTable, Filled, How, Threat, Threats, as_own, with_bands,
};
use endline_session::study::{PreparedStudy, merge};
use endline_session::{Error, json, locate, save};

use super::args::ThreatArgs;
use super::{folder_of, open, threat_strength};
use crate::cli::{Failure, output};

/// The experts' table of 2019 in the gear library.
const EXPERTS: &str = "cases/tables/noaa-dst-buoyline-risk.csv";

pub(super) fn threat(args: &ThreatArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let names_rows = opened.study.options.iter().any(|option| option.threat.row().is_some());
    if args.poll.is_some() || (names_rows && !args.is_by_strength()) {
        of_2019(args, &opened, library)
    } else {
        threat_strength::by_strength(args, &opened, library)
    }
}

fn of_2019(
    args: &ThreatArgs,
    opened: &PreparedStudy,
    library: Option<&Path>,
) -> Result<ExitCode, Failure> {
    let experts = read(args.poll.as_deref(), EXPERTS, library, ExpertTable::read)?;
    let event = event(args, opened)?;
    let folder = Folder::open(&folder_of(&args.at, opened), opened)?;
    let table = merge::load(opened, &folder)?;
    let threats = Threats::of(opened, &table, &event, Some(&experts)).map_err(Failure::usage)?;
    if let Some(to) = &args.to {
        write(to, &threats.fill(&experts), experts.rows.len())?;
    }
    output::print(&if args.json { json::line(&threats) + "\n" } else { words(&threats) })?;
    Ok(ExitCode::SUCCESS)
}

/// Reads a table of the tool from a file, or from that of the gear library.
pub(super) fn read<T>(
    file: Option<&Path>,
    bundled: &str,
    library: Option<&Path>,
    table: impl Fn(&str, &str) -> Result<T, Vec<Diagnostic>>,
) -> Result<T, Failure> {
    let file = match file {
        Some(file) => file.to_owned(),
        None => locate::library(None, library).map_err(Failure::failed)?.join(bundled),
    };
    let text = endline_gear::read::text(&file).map_err(Error::on(&file, "cannot be read"))?;
    Ok(table(&file.display().to_string(), &text).map_err(Error::Diagnostics)?)
}

/// The event whose rate is the threat: that of the command line, or the study's.
pub(super) fn event(args: &ThreatArgs, opened: &PreparedStudy) -> Result<StudyEvent, Failure> {
    let Some(name) = &args.event else { return Ok(opened.study.event.clone()) };
    StudyEvent::find(name).ok_or_else(|| {
        let known: Vec<String> = StudyEvent::all().iter().map(StudyEvent::name).collect();
        let hint = hint(name, known.iter().map(String::as_str));
        Failure::usage(format!("--event {name}: there is no such event; {hint}"))
    })
}

/// Writes the table that the tool reads, and the one with bands as `FILE-bands.csv`. Returns the path of the latter.
pub(super) fn write_both(
    to: &Path,
    own: Result<Vec<u8>, String>,
    bands: Result<Vec<u8>, String>,
) -> Result<PathBuf, Failure> {
    let stem = to.file_stem().unwrap_or_default().to_string_lossy();
    let beside = to.with_file_name(format!("{stem}-bands.csv"));
    for (file, table) in [(to, own), (&beside, bands)] {
        let table = table.map_err(Failure::failed)?;
        save::atomically(file, &table).map_err(Error::on(file, "cannot be written"))?;
    }
    Ok(beside)
}

fn write(to: &Path, rows: &[Filled<'_>], of: usize) -> Result<(), Failure> {
    let beside = write_both(to, as_own(rows), with_bands(rows))?;
    let simulated = rows.iter().filter(|row| row.how == How::Simulated).count();
    output::note(&format!(
        "wrote {} of {of} rows to {} and their bands to {}: {simulated} simulated, the others interpolated or constant beyond the longest trawl; {} omitted, of ropes and devices that were not simulated",
        rows.len(),
        to.display(),
        beside.display(),
        of - rows.len()
    ));
    Ok(())
}

fn words(threats: &Threats) -> String {
    let mut text = format!(
        "risk: rate of `{}` given an encounter; bands of 95 % by chance, and by the assumed priors\n\n{:<8} {:>8} {:>6} {:<20} {:>8}  {:<18} {:<18} {:>6}\n",
        threats.event, "rope", "inches", "traps", "device", "risk", "chance", "priors", "runs"
    );
    threats.rows.iter().for_each(|row| text += &line(row));
    text += &match &threats.tau {
        None => "\nthe study and the experts' table of 2019 share no rows in an order\n".to_owned(),
        Some(tau) => {
            let band = tau.interval.map_or_else(
                || "no band: most samples have no order".to_owned(),
                |band| format!("95 % by chance {:.2} to {:.2}", band.low, band.high),
            );
            format!(
                "\nKendall's tau against the experts' table of 2019 {:.2} ({band}), {} rows, {} pairs tied here\n",
                tau.tau, tau.rows, tau.ties
            )
        }
    };
    text
}

fn line(row: &Threat) -> String {
    let Threat { rope, diameter_in, traps, device, rate, .. } = row;
    let priors = row.by_priors();
    let mut text = String::new();
    let band = |low: f64, high: f64| format!("{low:.4} to {high:.4}");
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "{rope:<8} {diameter_in:>8.4} {traps:>6} {device:<20} {:>8.4}  {:<18} {:<18} {:>6}",
        rate.rate,
        band(rate.interval.low, rate.interval.high),
        band(priors.low, priors.high),
        rate.runs
    );
    text
}
