//! `endline study threat`: the threat tables of a merged study, for NOAA's decision support tool.
//!
//! Options that name rows of the table of 2019 give that table; options with a strength on a curve give the threat by breaking strength,
//! beside NOAA's present model.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::{Diagnostic, StudyEvent, hint};
use endline_session::study::folder::Folder;
use endline_session::study::threat::{
    ExpertTable, Filled, How, LineStrengthTable, NoaaModel, Origin, StrengthThreat,
    StrengthThreatTable, StrengthThreats, Threat, ThreatRange, Threats, TrawlThreat, as_own,
    curves, with_bands,
};
use endline_session::study::{PreparedStudy, merge};
use endline_session::{Error, json, locate, save};

use super::args::ThreatArgs;
use super::{folder_of, open};
use crate::cli::{Failure, output, table};

/// The experts' table of 2019 in the gear library.
const EXPERTS: &str = "cases/tables/noaa-dst-buoyline-risk.csv";

pub(super) fn threat(args: &ThreatArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let opened = open(&args.at, library)?;
    let names_rows = opened.study.options.iter().any(|option| option.threat.row().is_some());
    if args.poll.is_some() || (names_rows && !args.is_by_strength()) {
        of_2019(args, &opened, library)
    } else {
        by_strength(args, &opened, library)
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
    let table = merge::load(&folder)?;
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

/// NOAA's strengths of lines by traps, V3.1, in the gear library.
const LINES: &str = "cases/tables/noaa-dst-strength-by-traps.csv";

/// Numbers of traps that are printed; JSON has all.
const PRINTED_TRAPS: [u64; 9] = [1, 2, 5, 10, 15, 20, 30, 45, 60];

pub(super) fn by_strength(
    args: &ThreatArgs,
    opened: &PreparedStudy,
    library: Option<&Path>,
) -> Result<ExitCode, Failure> {
    let threats =
        read(args.model.as_deref(), StrengthThreatTable::FILE, library, StrengthThreatTable::read)?;
    let lines = read(args.strengths.as_deref(), LINES, library, LineStrengthTable::read)?;
    let curve = curve(args, opened)?;
    let event = event(args, opened)?;
    let folder = Folder::open(&folder_of(&args.at, opened), opened)?;
    let runs = merge::load(&folder)?;
    let noaa = NoaaModel { threats: &threats, lines: &lines, cap_n: args.cap };
    let found = StrengthThreats::of(opened, &runs, &event, curve, noaa).map_err(Failure::usage)?;
    if let Some(to) = &args.to {
        write_by_strength(to, &found)?;
    }
    output::print(&if args.json { json::line(&found) + "\n" } else { words_by_strength(&found) })?;
    Ok(ExitCode::SUCCESS)
}

/// The curve of the command line, or that with the most strengths.
fn curve<'a>(args: &ThreatArgs, opened: &'a PreparedStudy) -> Result<Option<&'a str>, Failure> {
    let known = curves(&opened.study);
    let Some(name) = &args.curve else {
        return known.first().copied().ok_or_else(|| {
            Failure::usage(format!(
                "{}: no option names a row of a threat table, and no two options of a curve have a strength; write strength = \"1700 lbf\" in options for the threat by breaking strength, or threat = {{ rope = \"3/8in\", diameter = \"3/8 in\", traps = 12, device = \"NA\" }} for the table of 2019",
                opened.study.id
            ))
        });
    };
    let found = known.iter().copied().find(|curve| *curve == Some(name.as_str()));
    found.ok_or_else(|| {
        let names: Vec<String> = known.iter().flatten().map(|curve| format!("`{curve}`")).collect();
        let which = if names.is_empty() {
            "the study has none; write curve = \"whole rope\" and a strength in its options".into()
        } else {
            format!("those with two strengths are {}", names.join(", "))
        };
        Failure::usage(format!("--curve {name}: there is no such curve; {which}"))
    })
}

fn write_by_strength(to: &Path, threats: &StrengthThreats) -> Result<(), Failure> {
    let beside = write_both(to, threats.as_own(), threats.with_bands())?;
    let rows = threats.strengths.len();
    let simulated = threats.simulated();
    output::note(&format!(
        "wrote {rows} strengths to {} and their bands to {}: {simulated} simulated, {} interpolated; omitted {} strengths of the model outside the simulated ones",
        to.display(),
        beside.display(),
        rows - simulated,
        threats.omitted_lbf.len()
    ));
    Ok(())
}

fn words_by_strength(threats: &StrengthThreats) -> String {
    let StrengthThreats { event, curve, options, reference_lbf, .. } = threats;
    let on_curve = curve.as_ref().map_or_else(String::new, |name| format!(", curve `{name}`"));
    let mut text = format!(
        "threat: rate of `{event}` given an encounter{on_curve}, {} simulated strengths; 95 % by chance\n\
         NOAA: threat by breaking strength of the decision support tool, with the bounds of its three curves\n\
         relative: over the value at {reference_lbf:.0} lbf; * interpolated\n\n",
        options.len()
    );
    let headings = ["strength", "simulated", "", "NOAA", "", "overlap"];
    let relative = ["relative", "", "NOAA", "", "overlap"];
    let mut rows = vec![headings.iter().chain(&relative).map(ToString::to_string).collect()];
    rows.extend(threats.strengths.iter().map(strength_row));
    text += &table::columns(&rows);
    if threats.strengths.iter().any(|row| row.relative.is_none()) {
        text += &format!(
            "relative: none, because the event does not occur at {reference_lbf:.0} lbf in encounters that are valid with every strength\n"
        );
    }
    if let Some(rate) = threats.unbreakable {
        let range =
            ThreatRange { threat: rate.rate, lower: rate.interval.low, upper: rate.interval.high };
        let [threat, interval] = share(range);
        text += &format!("rope that cannot part: {threat} {interval}\n");
    }
    if !threats.omitted_lbf.is_empty() {
        text += &format!(
            "{} strengths of NOAA's table are outside the simulated ones and have no simulated threat\n",
            threats.omitted_lbf.len()
        );
    }
    text + "\n" + &trawls(threats)
}

fn strength_row(row: &StrengthThreat) -> Vec<String> {
    let mark = if row.origin == Origin::Interpolated { " *" } else { "" };
    let mut cells = vec![format!("{:.0} lbf{mark}", row.strength_lbf)];
    cells.extend(share(row.simulated));
    cells.extend(share(row.noaa));
    cells.push(yes_or_no(row.overlaps));
    match &row.relative {
        Some(relative) => {
            cells.extend(share(relative.simulated));
            cells.extend(share(relative.noaa));
            cells.push(yes_or_no(relative.overlaps));
        }
        None => cells.push("none".to_owned()),
    }
    cells
}

/// Mean threats by traps, as a table.
fn trawls(threats: &StrengthThreats) -> String {
    let all = threats.trawls.len();
    let is_printed =
        |trawl: &&TrawlThreat| all <= PRINTED_TRAPS.len() || PRINTED_TRAPS.contains(&trawl.traps);
    let shown: Vec<&TrawlThreat> = threats.trawls.iter().filter(is_printed).collect();
    let mut text = "mean over NOAA's strengths of lines by traps of the trawl".to_owned();
    if let Some(cap_lbf) = threats.cap_lbf {
        text += &format!(", and its change if each stronger line has {cap_lbf:.0} lbf");
    }
    text += "\noutside: share of lines outside the simulated strengths; they count with the nearest one\n\n";
    let mut headings = vec!["traps", "mean", "outside", "simulated", "", "NOAA", ""];
    if threats.cap_lbf.is_some() {
        headings.extend(["change", "", "NOAA", ""]);
    }
    let mut rows = vec![headings.into_iter().map(str::to_owned).collect()];
    rows.extend(shown.iter().map(|trawl| trawl_row(trawl)));
    text += &table::columns(&rows);
    if shown.len() < all {
        text += &format!("{} of {all} numbers of traps; --json has all\n", shown.len());
    }
    text
}

fn trawl_row(trawl: &TrawlThreat) -> Vec<String> {
    let outside = 100.0 * (trawl.weaker_share + trawl.stronger_share);
    let mut cells = vec![
        trawl.traps.to_string(),
        format!("{:.0} lbf", trawl.mean_strength_lbf),
        format!("{outside:.0} %"),
    ];
    cells.extend(share(trawl.simulated));
    cells.extend(share(trawl.noaa));
    if let Some(capped) = &trawl.capped {
        let none = || ["none".to_owned(), String::new()];
        cells.extend(capped.simulated_change.map_or_else(none, percent));
        cells.extend(percent(capped.noaa_change));
    }
    cells
}

/// A threat and its range.
fn share(range: ThreatRange) -> [String; 2] {
    let ThreatRange { threat, lower, upper } = range;
    [format!("{threat:.4}"), format!("[{lower:.4}, {upper:.4}]")]
}

/// A change and its range.
fn percent(range: ThreatRange) -> [String; 2] {
    let [change, lower, upper] =
        [range.threat, range.lower, range.upper].map(|change| 100.0 * change);
    [format!("{change:+.0} %"), format!("[{lower:+.0}, {upper:+.0}]")]
}

fn yes_or_no(is_it: bool) -> String {
    if is_it { "yes" } else { "no" }.to_owned()
}
