//! The observations of studies as a page of Markdown: each beside the study's own share, with the verdict; and measured gear.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::cases::{Outcome, outcome};
use crate::study::prepared::PreparedStudy;
use crate::study::stats::{Agreement, Findings, ObservationFinding};

use super::inputs::simulated;

/// All that can be held against observations: studies with what they found, and cases with the row that each answers.
pub fn page(studies: &[(PreparedStudy, Findings)], cases: &[(String, Outcome)]) -> String {
    let seen = studies.iter().flat_map(|(_, findings)| &findings.observations);
    // Several observations may belong to one row: `B2-mouth` and `B2-tail`.
    let row = |id: &str| id.split('-').next().unwrap_or(id).to_owned();
    let rows: BTreeSet<String> = seen
        .filter(|seen| seen.simulated.is_some() && seen.by_construction.is_none())
        .map(|seen| row(&seen.id))
        .chain(cases.iter().map(|(id, _)| row(id)))
        .collect();
    let rows: Vec<String> = rows.into_iter().collect();
    let mut text =
        format!("Rows compared with a simulated figure: {} ({}).\n\n", rows.len(), rows.join(", "));
    for (opened, findings) in studies {
        text += &markdown(opened, findings);
        text.push('\n');
    }
    text + &of_cases(cases)
}

fn of_cases(cases: &[(String, Outcome)]) -> String {
    let mut text = "## Measured gear\n\n| id | case | source | compared | observed | simulated | tolerance | verdict |\n|---|---|---|---|---|---|---|---|\n".to_owned();
    for (row, outcome) in cases {
        for verdict in &outcome.verdicts {
            let cells = [
                row.clone(),
                outcome.name.clone(),
                outcome.source.clone(),
                verdict.name.clone(),
                outcome::value(verdict.expected, verdict.unit),
                outcome::value(verdict.got, verdict.unit),
                outcome::limit(verdict),
                if verdict.passed { "agrees" } else { "misses" }.to_owned(),
            ];
            text += &line(&cells);
        }
    }
    text
}

/// Observations of one study, held against its merged table.
pub fn markdown(opened: &PreparedStudy, findings: &Findings) -> String {
    let mut text = format!("## {}\n\n", opened.study.name);
    let count = |wanted: Agreement| {
        findings.observations.iter().filter(|seen| seen.agreement == wanted).count()
    };
    // Writing to a text cannot fail.
    let _ = writeln!(
        text,
        "`{}`, {}, program {}, study hash `{}`.\n{} observations: {} agree, {} miss, {} are not settled, {} are decided by construction and test nothing.\n",
        opened.study.id,
        findings.extent(),
        findings.version,
        &findings.hash[..16],
        findings.observations.len(),
        count(Agreement::Agrees),
        count(Agreement::Misses),
        count(Agreement::Open),
        count(Agreement::ByConstruction),
    );
    text += "| id | seen | source | counted | observed | simulated | verdict | notes |\n|---|---|---|---|---|---|---|---|\n";
    for seen in &findings.observations {
        text += &row(seen);
    }
    text
}

fn row(seen: &ObservationFinding) -> String {
    let cells = [
        seen.id.clone(),
        seen.says.clone(),
        seen.source.clone(),
        seen.counted.clone(),
        format!("{:.0} to {:.0} %", 100.0 * seen.observed.low, 100.0 * seen.observed.high),
        simulated(seen).replace('\u{a0}', " "),
        seen.agreement.words().to_owned()
            + if seen.registered { "" } else { ", added after the first run" },
        notes(seen),
    ];
    line(&cells)
}

/// What decides the result beforehand, if anything does, and the notes.
fn notes(seen: &ObservationFinding) -> String {
    let reason = seen.by_construction.iter().chain([&seen.notes]).filter(|text| !text.is_empty());
    reason.cloned().collect::<Vec<_>>().join("; ")
}

/// A line of a table in Markdown.
fn line(cells: &[String]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
    format!("| {} |\n", cells.join(" | "))
}
