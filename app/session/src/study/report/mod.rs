//! The report of a study: one HTML file with its figures inside, the numbers as CSV and JSON, and a bundle that reproduces it.

mod bundle;
pub(crate) mod cell;
mod changed;
mod curves;
mod figures;
pub mod hauled;
mod held;
pub mod hindcast;
mod inputs;
mod page;
mod results;
pub(crate) mod svg;
mod words;

pub(crate) use page::STYLE;
use std::path::PathBuf;
pub use words::lowest;

use crate::error::Error;
use crate::save::atomically;

use hauled::HauledLoad;

use super::folder::Folder;
use super::open::Opened;
use super::stats::Findings;
use super::table::{Cell, Row, Table};

/// Writes `report.html`, `report.csv`, `findings.json` and the folder `bundle`; answers where the page is. Hauls stand beside what
/// parts on whales.
///
/// # Errors
/// Where the folder cannot be written.
pub fn write(
    opened: &Opened,
    folder: &Folder,
    findings: &Findings,
    hauls: &[HauledLoad],
) -> Result<PathBuf, Error> {
    let page = folder.path.join("report.html");
    let html = page::html(opened, findings, hauls)
        .map_err(|error| Error::at(&page, format!("cannot be made: {error}")))?;
    let files = [
        (page.clone(), html),
        (folder.path.join("report.csv"), numbers(findings).csv()),
        (folder.path.join("findings.json"), findings.json() + "\n"),
    ];
    for (file, text) in files {
        atomically(&file, text.as_bytes())
            .map_err(|error| Error::at(&file, format!("cannot be written: {error}")))?;
    }
    bundle::write(opened, &folder.path.join("bundle"))?;
    Ok(page)
}

/// Every rate and comparison as a table: a row for each option and event.
fn numbers(findings: &Findings) -> Table {
    let mut rows: Vec<Row> = Vec::new();
    for option in &findings.options {
        for ((event, rate), (_, paired)) in option.rates.iter().zip(&option.against) {
            let real = |value: f64| Cell::Real(Some(value));
            let whole = |count: u64| Cell::Whole(i64::try_from(count).unwrap_or(i64::MAX));
            rows.push(vec![
                ("option".into(), Cell::Text(option.id.clone())),
                ("event".into(), Cell::Text(event.clone())),
                ("hits".into(), whole(rate.hits)),
                ("runs".into(), whole(rate.runs)),
                ("invalid".into(), whole(option.invalid)),
                ("resolution_looks".into(), whole(option.resolution.all)),
                ("resolution_missed".into(), whole(option.resolution.missed)),
                ("rate".into(), real(rate.rate)),
                ("rate_low".into(), real(rate.interval.low)),
                ("rate_high".into(), real(rate.interval.high)),
                ("difference".into(), real(paired.difference)),
                ("difference_low".into(), real(paired.difference_interval.low)),
                ("difference_high".into(), real(paired.difference_interval.high)),
                ("ratio".into(), Cell::Real(paired.ratio)),
                (
                    "ratio_low".into(),
                    Cell::Real(paired.ratio_interval.map(|interval| interval.low)),
                ),
                (
                    "ratio_high".into(),
                    Cell::Real(paired.ratio_interval.map(|interval| interval.high)),
                ),
                ("probability_fewer".into(), real(paired.fewer)),
                ("mcnemar".into(), real(paired.mcnemar)),
            ]);
        }
    }
    Table::of(rows)
}
