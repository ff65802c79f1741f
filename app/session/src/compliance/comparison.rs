//! Several gears beside each other on one page: the data of `assets/report/comparison.html`.
//!
//! Each column repeats the text of a gear's own sheet.

use askama::Template;

use crate::error::Error;
use crate::page::{Cell, Line, STYLE, Table};
use crate::rules::{RuleResult, Verdict};
use crate::settled::{LineShape, PartStrength, SettledShape};
use crate::units::N_PER_LBF;

use super::page::{bodies, command, force, probability, threat, unknown, where_and_when};
use super::{ComplianceSheet, drawing};

/// Height above the seabed of rope that a whale near the seabed meets [m].
const CLEAR_M: f64 = 1.0;

/// All that the page shows: the template takes tables and words from these, and escapes texts; figures are markup.
#[derive(Template)]
#[template(path = "comparison.html")]
struct Page<'a> {
    sheets: &'a [ComplianceSheet],
    title: String,
    where_and_when: String,
}

/// The page that compares gears, in their order.
pub fn comparison(sheets: &[ComplianceSheet]) -> Result<String, Error> {
    let [first, _, ..] = sheets else {
        return Err(Error::Message("a comparison needs two gears or more".to_owned()));
    };
    let names: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
    Page { sheets, title: names.join("; "), where_and_when: where_and_when(first) }
        .render()
        .map_err(|error| Error::Message(format!("the comparison: {error}")))
}

/// The answer of a row for a gear.
type Answer = fn(&ComplianceSheet) -> Cell;

/// A row for each question, a column for each gear.
fn table(sheets: &[ComplianceSheet]) -> Table {
    let questions: [(&str, Answer); 7] = [
        ("Made of", |sheet| bodies(sheet).into()),
        ("Rope more than 1 m above the seabed", rope_above_the_seabed),
        ("Binding rules", binding_rules),
        ("Weakest part", weakest),
        ("Greatest pull at the hauler", pull),
        ("Probability that a haul parts something", parts),
        ("Encounters that end with the whale held fast", held_fast),
    ];
    let row = |(question, answer): (&str, Answer)| {
        std::iter::once(question.into()).chain(sheets.iter().map(answer)).collect()
    };
    let headings: Vec<&str> =
        std::iter::once("").chain(sheets.iter().map(|sheet| sheet.name.as_str())).collect();
    Table::new("The same questions to each", &headings, questions.map(row).into())
}

fn rope_above_the_seabed(sheet: &ComplianceSheet) -> Cell {
    let depth_m = sheet.rules.depth_m;
    let [slack, running] =
        sheet.rest.each_ref().map(|rest| above_the_seabed_m(&rest.shape, depth_m));
    Cell::lines([
        format!("{slack:.1} m at slack tide"),
        format!("{running:.1} m at {:.2} m/s", sheet.tide_m_s),
    ])
}

/// Length of rope of which both ends of a segment are clear of the seabed [m].
pub(super) fn above_the_seabed_m(shape: &SettledShape, depth_m: f64) -> f64 {
    let clear = |place: &[f64; 3]| place[2] + depth_m > CLEAR_M;
    let of_line = |line: &LineShape| -> f64 {
        let pairs = line.position_m.iter().zip(line.position_m.iter().skip(1));
        pairs.filter(|(a, b)| clear(a) && clear(b)).map(|(a, b)| apart_m(*a, *b)).sum()
    };
    shape.lines.iter().map(of_line).sum()
}

fn apart_m(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn binding_rules(sheet: &ComplianceSheet) -> Cell {
    let ids = |verdict: Verdict| -> Vec<&str> {
        let binding = sheet.rules.with(verdict).filter(|rule: &&RuleResult| rule.binding);
        binding.map(|rule| rule.rule.as_str()).collect()
    };
    let fails = ids(Verdict::Fail);
    let mut lines = vec![format!("{} met, {} failed", ids(Verdict::Pass).len(), fails.len())];
    lines.extend((!fails.is_empty()).then(|| format!("FAILS {}", fails.join(", "))));
    let open = ids(Verdict::CannotBeChecked).len();
    lines.extend((open > 0).then(|| format!("{open} cannot be checked")));
    lines.extend(sheet.rules.uncovered.iter().cloned());
    Cell::lines(lines)
}

/// The part of least delivered strength at running tide.
fn weakest_of(sheet: &ComplianceSheet) -> Option<&PartStrength> {
    let parts = sheet.rest[1].shape.strengths.iter();
    parts.min_by(|one, other| one.delivered_N.total_cmp(&other.delivered_N))
}

fn weakest(sheet: &ComplianceSheet) -> Cell {
    let Some(part) = weakest_of(sheet) else { return "no part has a strength".into() };
    let [least, most] = part.nine_of_ten_N.map(|force_n| force_n / N_PER_LBF);
    Cell::lines([
        format!("{}, {}", part.part, part.item),
        format!("delivers {}", force(part.delivered_N)),
        format!("nine of ten {least:.0} to {most:.0} lbf"),
    ])
}

fn pull(sheet: &ComplianceSheet) -> Cell {
    match &sheet.haul {
        Err(why) => format!("not hauled: {why}").into(),
        Ok(haul) => {
            let near = haul.nearest.as_ref().map(|place| {
                format!("{:.0} % of what {} delivers", 100.0 * place.used, place.part)
            });
            Cell::lines(std::iter::once(force(haul.peak_N)).chain(near))
        }
    }
}

fn parts(sheet: &ComplianceSheet) -> Cell {
    sheet.haul.as_ref().map_or("-".to_owned(), |haul| probability(haul.parts)).into()
}

fn held_fast(sheet: &ComplianceSheet) -> Cell {
    let Some(found) = &sheet.threat else { return "no threat table was given".into() };
    let row = &found.row;
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    Cell::lines([
        format!("{} %", percent(row.risk)),
        format!("{} to {} by chance", percent(row.low), percent(row.high)),
        format!("{} to {} by assumptions", percent(row.priors_low), percent(row.priors_high)),
    ])
}

/// Sources of the figures.
fn sources(sheets: &[ComplianceSheet]) -> Vec<String> {
    let mut lines = Vec::new();
    for sheet in sheets {
        if let Some(part) = weakest_of(sheet) {
            let stated = &part.stated.source;
            lines.push(format!("{}, weakest part: {stated} ({})", sheet.name, part.confidence));
        }
        if let Some(found) = &sheet.threat {
            lines.push(format!("{}, threat: {}", sheet.name, threat(found).source));
        }
    }
    lines.push(
        "Rules, drawings and hauls: each gear's own sheet, made by the command below it."
            .to_owned(),
    );
    lines
}

/// Limits of the page, each listed once.
fn not_known(sheets: &[ComplianceSheet]) -> Vec<String> {
    let mut lines = Vec::new();
    for line in sheets.iter().flat_map(unknown) {
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}
