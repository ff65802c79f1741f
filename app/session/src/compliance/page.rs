//! The sheet as HTML: the data of `assets/report/compliance.html`, with numbered citations.

use askama::Template;
use endline_sim::model::BodyRole;

use crate::page::{Cell, Citations, Line, STYLE, Table};
use crate::rules::{RuleResult, Verdict};
use crate::settled::{LineShape, PartStrength};
use crate::units::{METRES_PER_FATHOM, METRES_PER_NAUTICAL_MILE, N_PER_LBF};

use super::{ComplianceSheet, ThreatOfGear, drawing};

/// Greatest number of parts in a list; a sentence names the others.
const MOST_PARTS: usize = 14;

/// Tension below which a line is slack [N].
const SLACK_N: f64 = 0.5;

/// All that the page shows: the template takes tables and words from these, and escapes texts; figures are markup.
#[derive(Template)]
#[template(path = "compliance.html")]
struct Page<'a> {
    sheet: &'a ComplianceSheet,
    rules: Table,
    not_checked: Vec<(String, String)>,
    strength: Table,
    citations: Vec<String>,
}

/// A threat in words.
pub(super) struct Threat {
    says: String,
    pub(super) source: String,
}

pub(super) fn html(sheet: &ComplianceSheet) -> Result<String, askama::Error> {
    let mut citations = Citations::default();
    let rules = rules(sheet, &mut citations);
    let not_checked = not_checked(sheet, &mut citations);
    let strength = strength(&sheet.rest[1].shape.strengths, &mut citations);
    Page { sheet, rules, not_checked, strength, citations: citations.listed() }.render()
}

pub(super) fn where_and_when(sheet: &ComplianceSheet) -> String {
    let depth_m = sheet.rules.depth_m;
    let usual = if sheet.rules.depth_is_usual { ", taken because none was given" } else { "" };
    let distance = match sheet.fishing.distance_m {
        Some(distance_m) => format!("{:.1} nmi from shore", distance_m / METRES_PER_NAUTICAL_MILE),
        None => "distance from shore not given".to_owned(),
    };
    format!(
        "{}, {}, {distance}, {depth_m:.1} m ({:.0} fathoms) of water{usual}",
        sheet.area,
        sheet.fishing.on,
        depth_m / METRES_PER_FATHOM
    )
}

/// The verdict of the sheet.
fn verdict(sheet: &ComplianceSheet) -> String {
    let binding = |verdict: Verdict| -> Vec<&RuleResult> {
        sheet.rules.with(verdict).filter(|rule| rule.binding).collect()
    };
    let named = |rule: &&RuleResult| format!("{} ({})", rule.asks.trim_end_matches('.'), rule.rule);
    let fails = binding(Verdict::Fail);
    let (met, unknown) = (binding(Verdict::Pass).len(), binding(Verdict::CannotBeChecked).len());
    let open = match unknown {
        1 => "one binding rule".to_owned(),
        several => format!("{several} binding rules"),
    };
    let mut text = match fails.as_slice() {
        [] if unknown > 0 => {
            format!("No verdict yet: {open} cannot be checked. It meets the {met} that could be.")
        }
        [] => "It meets every binding rule.".to_owned(),
        [one] => format!("It fails one binding rule: {}.", named(one)),
        several => {
            let names: Vec<String> = several.iter().map(named).collect();
            format!("It fails {} binding rules: {}.", several.len(), names.join("; "))
        }
    };
    if unknown > 0 && !fails.is_empty() {
        text += &format!(" Further, {open} cannot be checked.");
    }
    for says in &sheet.rules.uncovered {
        text += &format!(" Note: {says}.");
    }
    text
}

pub(super) fn force(newtons: f64) -> String {
    format!("{:.0} lbf ({:.2} kN)", newtons / N_PER_LBF, newtons / 1000.0)
}

/// Lines at slack and at running tide that are taut in one of these seas.
fn taut(sheet: &ComplianceSheet) -> Vec<[&LineShape; 2]> {
    let [slack, running] = sheet.rest.each_ref().map(|rest| &rest.shape.lines);
    let bears = |line: &LineShape| line.end_a_tension_N.max(line.end_b_tension_N) >= SLACK_N;
    let both = slack.iter().zip(running).map(|(slack, running)| [slack, running]);
    both.filter(|lines| lines.iter().any(|line| bears(line))).collect()
}

/// Tensions at both ends of lines, in both seas.
fn tensions(sheet: &ComplianceSheet) -> Table {
    let ends =
        |line: &LineShape| format!("{:.0}, {:.0} N", line.end_a_tension_N, line.end_b_tension_N);
    let row = |[slack, running]: [&LineShape; 2]| {
        let length = format!("{:.1} m", slack.length_m);
        [slack.id.clone(), length, ends(slack), ends(running)].map(Cell::from).into()
    };
    let rows = taut(sheet).into_iter().take(MOST_PARTS).map(row).collect();
    let headings = ["Line", "Length", "Slack", "Running"];
    Table::new("Tension at the ends of lines at rest", &headings, rows)
}

fn slack_lines(sheet: &ComplianceSheet) -> String {
    let (all, shown) = (sheet.rest[0].shape.lines.len(), taut(sheet).len().min(MOST_PARTS));
    match all - shown {
        0 => String::new(),
        1 => "One more line lies slack.".to_owned(),
        more if shown < MOST_PARTS => format!("{more} more lines lie slack."),
        more => format!("{more} more lines are not listed."),
    }
}

/// The bodies of the gear, in one sentence.
pub(super) fn bodies(sheet: &ComplianceSheet) -> String {
    let bodies = &sheet.rest[0].prepared.model.spec.bodies;
    let mut counted: Vec<(&str, BodyRole, usize)> = Vec::new();
    for body in bodies {
        let item = if body.item.is_empty() { body.id.as_str() } else { body.item.as_str() };
        match counted.iter_mut().find(|(known, ..)| *known == item) {
            Some((.., count)) => *count += 1,
            None => counted.push((item, body.role, 1)),
        }
    }
    let words = counted.iter().map(|(item, _, count)| format!("{count} × {item}"));
    words.collect::<Vec<_>>().join(", ")
}

/// Rules with a verdict, failures first.
fn rules(sheet: &ComplianceSheet, citations: &mut Citations) -> Table {
    let order = [Verdict::Fail, Verdict::Pass];
    let rows = order.into_iter().flat_map(|verdict| sheet.rules.with(verdict));
    let rows = rows.map(|rule| rule_row(rule, citations)).collect();
    let headings = ["Rule", "Verdict", "Measured, and the limit", "Source"];
    Table::new("Rules that apply and were checked", &headings, rows)
}

fn rule_row(rule: &RuleResult, citations: &mut Citations) -> Vec<Cell> {
    let standing = if rule.binding { String::new() } else { rule.standing.to_owned() };
    let said = said(rule);
    let fix = (rule.verdict == Verdict::Fail).then(|| format!("Fix: {}", rule.remedy));
    let name = [rule.asks.clone(), rule.rule.clone(), standing];
    vec![
        Cell::lines(name.into_iter().filter(|line| !line.is_empty())),
        rule.verdict.words().to_uppercase().into(),
        Cell::lines(said.into_iter().take(4).chain(fix)),
        citations.cell(&rule.cite, rule.confidence),
    ]
}

/// Measured values with their limits; parts of the same value share a line.
fn said(rule: &RuleResult) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, &str)> = Vec::new();
    for measured in &rule.measured {
        let part = Some(measured.part.as_str()).filter(|part| !part.is_empty());
        match groups.iter_mut().find(|(_, says)| *says == measured.says) {
            Some((parts, _)) => parts.extend(part),
            None => groups.push((part.into_iter().collect(), &measured.says)),
        }
    }
    let line = |(parts, says): (Vec<&str>, &str)| match parts.as_slice() {
        [] => says.to_owned(),
        [first, .., last] if parts.len() > 3 => {
            format!("{first} to {last}, {} parts: {says}", parts.len())
        }
        few => format!("{}: {says}", few.join(", ")),
    };
    groups.into_iter().map(line).collect()
}

/// Rules that apply and cannot be checked, with the reason.
fn not_checked(sheet: &ComplianceSheet, citations: &mut Citations) -> Vec<(String, String)> {
    let row = |rule: &RuleResult| {
        let asks = rule.asks.trim_end_matches('.');
        (rule.rule.clone(), format!("{asks} {}", citations.mark(&rule.cite)))
    };
    sheet.rules.with(Verdict::CannotBeChecked).map(row).collect()
}

fn not_applicable(sheet: &ComplianceSheet) -> String {
    let count = sheet.rules.with(Verdict::NotApplicable).count();
    format!(
        "{count} more rules do not apply here, on that day, or to this gear; endline rules check says why."
    )
}

/// Parts alike are listed once.
fn distinct(strengths: &[PartStrength]) -> Vec<(&PartStrength, usize)> {
    let mut found: Vec<(&PartStrength, usize)> = Vec::new();
    for part in strengths {
        let alike = |(known, _): &&mut (&PartStrength, usize)| {
            known.item == part.item && known.factors == part.factors && known.stated == part.stated
        };
        match found.iter_mut().find(alike) {
            Some((_, count)) => *count += 1,
            None => found.push((part, 1)),
        }
    }
    found
}

/// Delivered strength of each kind of part.
fn strength(strengths: &[PartStrength], citations: &mut Citations) -> Table {
    let row = |(part, count): (&PartStrength, usize)| {
        let more = if count > 1 { format!("and {} alike", count - 1) } else { String::new() };
        let [least, most] = part.nine_of_ten_N;
        let name = [part.part.clone(), more].into_iter().filter(|line| !line.is_empty());
        vec![
            Cell::lines(name),
            part.item.clone().into(),
            Cell::lines([force(part.stated.value), part.product()]),
            force(part.delivered_N).into(),
            format!("{:.0} to {:.0} lbf", least / N_PER_LBF, most / N_PER_LBF).into(),
            citations.cell(&part.stated.source, part.confidence),
        ]
    };
    let rows = distinct(strengths).into_iter().take(MOST_PARTS).map(row).collect();
    let headings = [
        "Part",
        "Rope or link",
        "Stated, and what is left of it",
        "Delivers",
        "Nine of ten",
        "Source",
    ];
    Table::new("Delivered strength along the line", &headings, rows)
}

fn left_out(strengths: &[PartStrength]) -> String {
    let kinds = distinct(strengths).len();
    if kinds <= MOST_PARTS {
        String::new()
    } else {
        format!("{} more kinds of parts are not listed.", kinds - MOST_PARTS)
    }
}

/// Loads of the haul, and the margin to parting.
fn haul(sheet: &ComplianceSheet) -> String {
    let haul = match &sheet.haul {
        Ok(haul) => haul,
        Err(why) => return format!("Not hauled: {why}."),
    };
    let mut text = format!(
        "At most {} at the hauler, with {} of its traps and anchors off the seabed.",
        force(haul.peak_N),
        haul.hanging
    );
    if let Some(place) = &haul.nearest {
        text += &format!(
            " Nearest to parting comes {}: {}, {:.0} % of the {} that it delivers.",
            place.part,
            force(place.tension_N),
            100.0 * place.used,
            force(place.delivered_N)
        );
    }
    text + &format!(" Something parts in a haul with probability {}.", probability(haul.parts))
}

pub(super) fn probability(share: f64) -> String {
    if share < 1e-4 { "below 0.0001".to_owned() } else { format!("{share:.4}") }
}

/// Conditions of the haul.
fn haul_source(sheet: &ComplianceSheet) -> String {
    let Ok(haul) = &sheet.haul else { return String::new() };
    format!(
        "Simulated: {:.1} m/s over a block {:.1} m above the water, tide {:.2} m/s, waves of {:.1} m; {} of {} traps aboard in {:.0} s. docs/hauling.md has sources and limits.",
        haul.speed_m_s,
        haul.block_m,
        haul.tide_m_s,
        haul.sea_m,
        haul.traps_aboard,
        haul.traps,
        haul.time_s
    )
}

pub(super) fn threat(found: &ThreatOfGear) -> Threat {
    let row = &found.row;
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    Threat {
        says: format!(
            "Of encounters with such an endline {} % end with the whale held fast; {} to {} % by chance, over {} runs; {} to {} % over the levels of what is assumed. The greatest risk in the table is {} %.",
            percent(row.risk),
            percent(row.low),
            percent(row.high),
            row.runs,
            percent(row.priors_low),
            percent(row.priors_high),
            percent(found.greatest)
        ),
        source: format!(
            "Row {} rope, {} traps, device {} of {} ({}): the nearest to this gear.",
            row.rope, row.traps, row.device, found.file, row.how
        ),
    }
}

/// Limits of the page.
pub(super) fn unknown(sheet: &ComplianceSheet) -> Vec<String> {
    let estimates = sheet
        .rules
        .rules
        .iter()
        .filter(|rule| rule.confidence == "estimate" && rule.verdict != Verdict::NotApplicable);
    let estimates: Vec<&str> = estimates.map(|rule| rule.rule.as_str()).collect();
    let mut lines = vec![
        "How often whales meet this gear, and how often they turn away before they touch it.".to_owned(),
        "Friction of rope on living whales, and what whales do when they feel rope: neither was measured.".to_owned(),
        "Marks, colours and how inserts are made up: the assembly does not describe them.".to_owned(),
    ];
    if !estimates.is_empty() {
        lines.push(format!(
            "The wording of these rules was not verified: {}.",
            estimates.join(", ")
        ));
    }
    if sheet.threat.is_none() {
        lines.push(
            "What an encounter with this gear does to a whale: no threat table was given."
                .to_owned(),
        );
    }
    lines
}

/// The command that reproduces the page.
pub(super) fn command(sheet: &ComplianceSheet) -> String {
    let fishing = &sheet.fishing;
    let mut words = format!(
        "endline sheet {} --area {} --on {} --tide \"{} m/s\"",
        sheet.id, fishing.area, fishing.on, sheet.tide_m_s
    );
    let lengths = [("depth", fishing.depth_m), ("distance", fishing.distance_m)];
    for (name, metres) in lengths.into_iter().filter_map(|(name, metres)| Some((name, metres?))) {
        words += &format!(" --{name} \"{metres} m\"");
    }
    if let Some(traps) = fishing.traps {
        words += &format!(" --traps {traps}");
    }
    if let Some(threat) = &sheet.threat {
        words += &format!(" --threat {}", threat.file);
    }
    words
}
