//! The observations of a study as a page of Markdown: each beside the study's own share, with the verdict.

use std::fmt::Write;

use crate::study::open::Opened;
use crate::study::stats::{Agreement, Findings, ObservationFinding};

use super::inputs::simulated;

/// Observations of one study, held against its merged table.
#[must_use]
pub fn markdown(opened: &Opened, findings: &Findings) -> String {
    let mut text = format!("## {}\n\n", opened.study.name);
    let count = |wanted: Agreement| {
        findings.observations.iter().filter(|seen| seen.agreement == wanted).count()
    };
    // Writing to a text cannot fail.
    let _ = writeln!(
        text,
        "`{}`, {} encounters, program {}, study hash `{}`.\n{} observations: {} agree, {} miss, {} are not settled.\n",
        opened.study.id,
        findings.encounters,
        crate::VERSION,
        &findings.hash[..16],
        findings.observations.len(),
        count(Agreement::Agrees),
        count(Agreement::Misses),
        count(Agreement::Open),
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
        seen.notes.clone(),
    ];
    format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | "))
}
