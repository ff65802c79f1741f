//! The tables of inputs, and of the sensitivity of the result to them.

use endline_gear::{Prior, StudyOption};

use crate::settled::PartStrength;
use crate::study::prepared::PreparedStudy;
use crate::study::stats::{
    ClaimFinding, Findings, InputFinding, ObservationFinding, OptionFinding,
};

use super::words::{force, percent_interval, points, rate};
use crate::page::{Cell, Line, Table};

/// Claims and whether their sign holds; `None` where the study makes none.
pub(super) fn claims(findings: &Findings) -> Option<Table> {
    let row = |claim: &ClaimFinding| {
        let says = vec![Line::Plain(claim.says.clone()), Line::Small(claim.source.clone())];
        vec![
            Cell { lines: says },
            Cell::lines([claim.more.clone(), rate(&claim.more_rate)]),
            Cell::lines([claim.less.clone(), rate(&claim.less_rate)]),
            points(claim.difference, claim.interval).into(),
            format!("{:.3}", claim.adjusted).into(),
            Cell::lines(
                [claim.verdict.words().to_owned()].into_iter().chain(later(claim.registered)),
            ),
        ]
    };
    let among = format!("p among {} claims (Holm)", findings.claims.len());
    let headings =
        ["claim", "should be more", "should be less", "difference", among.as_str(), "result"];
    let rows: Vec<Vec<Cell>> = findings.claims.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new("Whether the sign holds", &headings, rows))
}

/// Shares seen on real whales beside the study's own; `None` where the study names none.
pub(super) fn observations(findings: &Findings) -> Option<Table> {
    let row = |seen: &ObservationFinding| {
        let says = vec![Line::Plain(seen.says.clone()), Line::Small(seen.source.clone())];
        vec![
            Cell { lines: says },
            Cell::from(&seen.counted),
            percent_interval(seen.observed).into(),
            simulated(seen).into(),
            Cell::lines(
                [seen.agreement.words().to_owned()].into_iter().chain(later(seen.registered)),
            ),
            Cell::lines(seen.by_construction.iter().chain([&seen.notes]).cloned()),
        ]
    };
    let headings = ["seen", "counted", "observed, %", "simulated", "result", "notes"];
    let rows: Vec<Vec<Cell>> = findings.observations.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new("The study's shares beside those seen", &headings, rows))
}

/// The note on a claim or observation that was not in the study before its first run.
fn later(registered: bool) -> Option<String> {
    (!registered).then(|| "added after the first run".to_owned())
}

/// `77.4 % [60.2, 88.6], 24 of 31`.
pub(super) fn simulated(seen: &ObservationFinding) -> String {
    let counts = format!("{} of {}", seen.hits, seen.runs);
    seen.simulated.map_or_else(
        || format!("none: {counts}"),
        |share| format!("{:.1} % {}, {counts}", 100.0 * share, percent_interval(seen.interval)),
    )
}

/// Rates by parts of each input.
pub(super) fn sensitivity(findings: &Findings) -> Table {
    let row = |input: &InputFinding| {
        let parts = input.parts.iter().map(|part| format!("{}: {}", part.name, rate(&part.rate)));
        let best =
            if input.same_best { "one option has or shares it in every part" } else { "changes" };
        let explains = Cell::lines(input.sobol.words());
        vec![Cell::from(&input.words), Cell::lines(parts), explains, best.into()]
    };
    Table::new(
        "Sensitivity and rank",
        &[
            "input",
            "rate by part",
            "explains of the variance alone (Sobol index)",
            "option with the lowest rate",
        ],
        findings.inputs.iter().map(row).collect(),
    )
}

/// How encounters are drawn.
pub(super) fn priors(opened: &PreparedStudy) -> Table {
    let row = |prior: &Prior| {
        let tag = Cell { lines: vec![Line::Tag(prior.confidence.word())] };
        let proposal =
            prior.proposal.as_ref().map(|law| format!("drawn mostly from {}", law.words()));
        let laws = Cell::lines([prior.law.words()].into_iter().chain(proposal));
        vec![prior.words().into(), laws, tag, Cell::from(&prior.source)]
    };
    Table::new(
        "How encounters are drawn",
        &["quantity", "distribution", "confidence", "source"],
        opened.study.priors.iter().map(row).collect(),
    )
}

/// Delivered strength of the lines and weak links of each option.
pub(super) fn strengths(findings: &Findings) -> Table {
    let line = |strength: &PartStrength| {
        let [least, most] = strength.nine_of_ten_N;
        Line::Plain(format!(
            "{}: {}, nine pieces of ten {least:.0} to {most:.0} N; {} of {} {} ({})",
            strength.part,
            force(strength.delivered_N),
            force(strength.stated.value),
            strength.item,
            strength.product(),
            strength.confidence,
        ))
    };
    let row = |option: &OptionFinding| {
        let lines = option.strengths.iter().map(line).collect();
        vec![Cell::from(&option.name), Cell { lines }]
    };
    Table::new(
        "Delivered strength of each option's gear: what its source states, times what making up and wear leave",
        &["option", "lines and weak links"],
        findings.options.iter().map(row).collect(),
    )
}

/// The fields that each option sets in the baseline scenario.
pub(super) fn settings(opened: &PreparedStudy) -> Table {
    let row = |option: &StudyOption| {
        let set = option.settings.iter().map(|setting| {
            Line::Code(format!("{} = {}", setting.field.value, setting.value.written()))
        });
        vec![Cell::from(&option.name), Cell { lines: set.collect() }]
    };
    Table::new(
        "Options as differences from the baseline",
        &["option", "what is set"],
        opened.study.options.iter().map(row).collect(),
    )
}
