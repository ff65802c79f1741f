//! `endline study threat` of options with a strength: the threat by breaking strength, beside NOAA's present model.

use std::path::Path;
use std::process::ExitCode;

use endline_session::json;
use endline_session::study::folder::Folder;
use endline_session::study::threat::{
    LineStrengthTable, NoaaModel, Origin, StrengthThreat, StrengthThreatTable, StrengthThreats,
    ThreatRange, TrawlThreat, curves,
};
use endline_session::study::{PreparedStudy, merge};

use super::args::ThreatArgs;
use super::folder_of;
use super::threat::{event, read, write_both};
use crate::cli::{Failure, output, table};

/// NOAA's threat by breaking strength, V3.1, in the gear library.
const THREATS: &str = "cases/tables/noaa-dst-threat-by-strength.csv";

/// NOAA's strengths of lines by traps, V3.1, in the gear library.
const LINES: &str = "cases/tables/noaa-dst-strength-by-traps.csv";

/// Numbers of traps that are printed; JSON has all.
const PRINTED_TRAPS: [u64; 9] = [1, 2, 5, 10, 15, 20, 30, 45, 60];

pub(super) fn by_strength(
    args: &ThreatArgs,
    opened: &PreparedStudy,
    library: Option<&Path>,
) -> Result<ExitCode, Failure> {
    let threats = read(args.model.as_deref(), THREATS, library, StrengthThreatTable::read)?;
    let lines = read(args.strengths.as_deref(), LINES, library, LineStrengthTable::read)?;
    let curve = curve(args, opened)?;
    let event = event(args, opened)?;
    let folder = Folder::open(&folder_of(&args.at, opened), opened)?;
    let runs = merge::load(opened, &folder)?;
    let noaa = NoaaModel { threats: &threats, lines: &lines, cap_n: args.cap };
    let found = StrengthThreats::of(opened, &runs, &event, curve, noaa).map_err(Failure::usage)?;
    if let Some(to) = &args.to {
        write(to, &found)?;
    }
    output::print(&if args.json { json::line(&found) + "\n" } else { words(&found) })?;
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

fn write(to: &Path, threats: &StrengthThreats) -> Result<(), Failure> {
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

fn words(threats: &StrengthThreats) -> String {
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
