//! `endline study threat`: the threat table of a merged study, for NOAA's decision support tool.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::{StudyEvent, hint};
use endline_session::study::folder::Folder;
use endline_session::study::threat::{Filled, How, Poll, Threat, Threats, as_own, with_bands};
use endline_session::study::{PreparedStudy, merge};
use endline_session::{Error, json, locate, save};

use super::args::ThreatArgs;
use super::{folder_of, open};
use crate::cli::{Failure, output};

/// The tool's own table in the gear library.
const POLL: &str = "cases/tables/noaa-dst-buoyline-risk.csv";

pub(super) fn threat(args: &ThreatArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let poll = read_poll(args, library)?;
    let event = event(args, &opened)?;
    let folder = Folder::open(&folder_of(&args.at, &opened), &opened)?;
    let table = merge::load(&opened, &folder)?;
    let threats = Threats::of(&opened, &table, &event, Some(&poll)).map_err(Failure::usage)?;
    if let Some(to) = &args.to {
        write(to, &threats.fill(&poll), poll.rows.len())?;
    }
    output::print(&if args.json { json::line(&threats) + "\n" } else { words(&threats) })?;
    Ok(ExitCode::SUCCESS)
}

fn read_poll(args: &ThreatArgs, library: Option<&Path>) -> Result<Poll, Failure> {
    let file = match &args.poll {
        Some(file) => file.clone(),
        None => locate::library(None, library).map_err(Failure::failed)?.join(POLL),
    };
    let text = endline_gear::read::text(&file).map_err(Error::on(&file, "cannot be read"))?;
    let poll = Poll::read(&file.display().to_string(), &text);
    Ok(poll.map_err(Error::Diagnostics)?)
}

fn event(args: &ThreatArgs, opened: &PreparedStudy) -> Result<StudyEvent, Failure> {
    let Some(name) = &args.event else { return Ok(opened.study.event.clone()) };
    StudyEvent::find(name).ok_or_else(|| {
        let known: Vec<String> = StudyEvent::all().iter().map(StudyEvent::name).collect();
        let hint = hint(name, known.iter().map(String::as_str));
        Failure::usage(format!("--event {name}: there is no such event; {hint}"))
    })
}

/// Writes the table that the tool reads and the one with bands.
fn write(to: &Path, rows: &[Filled<'_>], of: usize) -> Result<(), Failure> {
    let stem = to.file_stem().unwrap_or_default().to_string_lossy();
    let beside: PathBuf = to.with_file_name(format!("{stem}-bands.csv"));
    let [own, bands] = [as_own(rows), with_bands(rows)].map(|table| table.map_err(Failure::failed));
    for (file, table) in [(to, own?), (&beside, bands?)] {
        save::atomically(file, &table).map_err(Error::on(file, "cannot be written"))?;
    }
    let simulated = rows.iter().filter(|row| row.how == How::Simulated).count();
    output::note(&format!(
        "wrote {} of {of} rows to {} and their bands to {}: {simulated} simulated, the others between them or held; {} left out, which the study says nothing of",
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
        None => "\nthe study and the poll share no rows in an order\n".to_owned(),
        Some(tau) => {
            let band = tau.interval.map_or_else(
                || "no band: most samples have no order".to_owned(),
                |band| format!("95 % by chance {:.2} to {:.2}", band.low, band.high),
            );
            format!(
                "\nKendall's tau against the poll {:.2} ({band}), {} rows, {} pairs tied here\n",
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
