//! The report of a study: one HTML file with its figures inside, the numbers as CSV and JSON, and a bundle that reproduces it.

mod figures;
pub mod hauled;
mod held;
pub mod hindcast;
mod inputs;
mod page;
mod results;
mod words;

use std::fs;
use std::path::{Path, PathBuf};

use endline_gear::names;
pub use words::{NOT_FOLLOWED, lowest};

use crate::error::Error;
use crate::json;
use crate::page::svg;
use crate::save::atomically;

use hauled::HauledLoad;

use super::folder::Folder;
use super::prepared::PreparedStudy;
use super::stats::{Findings, OptionFinding, Paired, Rate};
use super::threat::StrengthThreatTable;
use crate::table::{Column, Table};

/// Other figures on the axis of strength, beside the shares of parting on whales.
#[derive(Default)]
struct Beside<'a> {
    /// Loads of hauls.
    hauls: &'a [HauledLoad],
    /// NOAA's threat by breaking strength.
    threats: Option<StrengthThreatTable>,
}

/// Writes `report.html`, `report.csv`, `findings.json`, `strength.svg` (the figure of shares by strength, if there is one) and the folder
/// `bundle`; returns the path of the page. Hauls and NOAA's threat, if the library has it, are drawn on the axis of strength. Kept results
/// of another program have no bundle, because the present library did not give their rows.
/// Errors: where the folder cannot be written, or NOAA's table cannot be read.
pub fn write(
    opened: &PreparedStudy,
    folder: &Folder,
    findings: &Findings,
    hauls: &[HauledLoad],
) -> Result<PathBuf, Error> {
    let beside = Beside { hauls, threats: StrengthThreatTable::of_library(&opened.root)? };
    let page = folder.path.join("report.html");
    let html = page::html(opened, findings, &beside).map_err(Error::on(&page, "cannot be made"))?;
    let figure = held::curves(&findings.strength_curves, &beside).map(svg::standalone);
    let files = [
        (page.clone(), Some(html)),
        (folder.path.join("report.csv"), Some(numbers(findings).csv())),
        (folder.path.join("findings.json"), Some(json::line(findings) + "\n")),
        (folder.path.join("strength.svg"), figure),
    ];
    for (file, text) in files.into_iter().filter_map(|(file, text)| Some((file, text?))) {
        atomically(&file, text.as_bytes()).map_err(Error::on(&file, "cannot be written"))?;
    }
    if findings.hash == opened.hash {
        write_bundle(opened, &folder.path.join("bundle"))?;
    }
    Ok(page)
}

/// An event of an option: its rate, and its comparison with the baseline.
type Counted<'a> = (&'a OptionFinding, &'a str, &'a Rate, &'a Paired);

/// Every rate and comparison as a table: a row for each option and event.
fn numbers(findings: &Findings) -> Table {
    let mut rows: Vec<Counted<'_>> = Vec::new();
    for option in &findings.options {
        for ((event, rate), (_, paired)) in option.rates.iter().zip(&option.against) {
            rows.push((option, event, rate, paired));
        }
    }
    let texts = |of: fn(&Counted<'_>) -> String| Column::Text(rows.iter().map(of).collect());
    let counts = |of: fn(&Counted<'_>) -> u64| {
        let whole = |row| i64::try_from(of(row)).unwrap_or(i64::MAX);
        Column::Whole(rows.iter().map(whole).collect())
    };
    let reals = |of: fn(&Counted<'_>) -> Option<f64>| {
        let finite = |row| of(row).filter(|number| number.is_finite());
        Column::Real(rows.iter().map(finite).collect())
    };
    let columns = [
        ("option", texts(|(option, ..)| option.id.clone())),
        ("event", texts(|(_, event, ..)| (*event).to_owned())),
        ("hits", counts(|(_, _, rate, _)| rate.hits)),
        ("runs", counts(|(_, _, rate, _)| rate.runs)),
        ("invalid", counts(|(option, ..)| option.invalid)),
        ("resolution_looks", counts(|(option, ..)| option.resolution.all)),
        ("resolution_missed", counts(|(option, ..)| option.resolution.missed)),
        ("rate", reals(|(_, _, rate, _)| Some(rate.rate))),
        ("rate_low", reals(|(_, _, rate, _)| Some(rate.interval.low))),
        ("rate_high", reals(|(_, _, rate, _)| Some(rate.interval.high))),
        ("difference", reals(|(.., paired)| Some(paired.difference))),
        ("difference_low", reals(|(.., paired)| Some(paired.difference_interval.low))),
        ("difference_high", reals(|(.., paired)| Some(paired.difference_interval.high))),
        ("ratio", reals(|(.., paired)| paired.ratio)),
        ("ratio_low", reals(|(.., paired)| Some(paired.ratio_interval?.low))),
        ("ratio_high", reals(|(.., paired)| Some(paired.ratio_interval?.high))),
        ("probability_fewer", reals(|(.., paired)| Some(paired.fewer))),
        ("mcnemar", reals(|(.., paired)| Some(paired.mcnemar))),
    ];
    Table { columns: columns.map(|(name, column)| (name.to_owned(), column)).into() }
}

/// Commands that reproduce a report, in the folder above the bundle.
const COMMANDS: &str = "endline study run bundle/study.toml --library bundle/gear-library --out again\n\
    endline study merge bundle/study.toml --library bundle/gear-library --out again";

/// Writes the bundle: the folder that reproduces a study, with its file, scenario and library as they were.
fn write_bundle(opened: &PreparedStudy, folder: &Path) -> Result<(), Error> {
    let library = folder.join("gear-library");
    let named = &opened.study.scenario.value;
    let scenario = match named.ends_with(".toml") {
        true => folder.join(named),
        false => library.join("scenarios").join(format!("{named}.toml")),
    };
    // A library is known by these two folders, whatever is in them.
    for needed in ["ropes", "scenarios"] {
        let path = library.join(needed);
        fs::create_dir_all(&path).map_err(Error::on(&path, "cannot be made"))?;
    }
    put(&folder.join("study.toml"), opened.text.as_bytes())?;
    // Reading a study makes sure of it; nothing is ever written elsewhere than here.
    if named.ends_with(".toml") && !names::stays_below(named) {
        return Err(Error::at(folder, format!("the scenario {named:?} leads out of the bundle")));
    }
    put(&scenario, opened.options[opened.baseline].scenario.text().as_bytes())?;
    for (path, text) in opened.sources.iter() {
        put(&library.join(path), text.as_bytes())?;
    }
    for (path, bytes) in opened.sources.meshes() {
        put(&library.join(path), bytes)?;
    }
    put(&folder.join("README.txt"), readme(opened).as_bytes())
}

fn readme(opened: &PreparedStudy) -> String {
    format!(
        "{}\n\nStudy hash {}, seed {}, Endline {}.\nIn the folder above this one:\n\n{COMMANDS}\n\nThe table has the same bytes where program and plugins are the same.\n",
        opened.study.name,
        opened.hash,
        opened.study.seed,
        crate::VERSION
    )
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(Error::on(parent, "cannot be made"))?;
    atomically(path, bytes).map_err(Error::on(path, "cannot be written"))
}
