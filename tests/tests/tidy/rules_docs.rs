//! docs/rules.md lists the facts, the rules that ship, and what they say about the shipped assemblies.
//!
//! `ENDLINE_WRITE_DOCS=1 cargo test -p endline-tests --test tidy rules_docs` writes the tables anew.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::fmt::Write;
use std::fs;

use endline_gear::units::{Quantity, parse};
use endline_gear::{Date, Kind, Library, Sources};
use endline_session::PluginHost;
use endline_session::plugins::Hook;
use endline_session::rules::facts::{About, FACTS};
use endline_session::rules::{Fishing, Packs, RuleSheet, Verdict, check, of_library};
use endline_tests::root;

const DOCUMENT: &str = "docs/rules.md";

/// Where the shipped assemblies are checked: area and distance from shore.
const PLACES: [(&str, &str); 4] =
    [("me-b", "5 nmi"), ("ma-lma-1", "1 nmi"), ("lma-3", "60 nmi"), ("gulf-snow-crab", "20 nmi")];

/// The depth for which they are built [m].
const DEPTH_M: f64 = 25.0;

fn facts() -> String {
    let mut text = String::from("| fact | what it is | of | meaning |\n|---|---|---|---|\n");
    for fact in FACTS {
        let about = match fact.about {
            About::Fishing => "the call",
            About::Gear => "gear",
            About::Endline => "endline",
            About::Groundline => "groundline",
            About::Unsaid => "never known",
        };
        writeln!(text, "| `{}` | {} | {about} | {} |", fact.name, fact.kind.noun(), fact.help)
            .unwrap();
    }
    text
}

fn rules(packs: &Packs) -> String {
    let mut text = String::from(
        "| rule | asks | in force | standing, confidence | citation |\n|---|---|---|---|---|\n",
    );
    for (_, rule) in packs.rules() {
        let from = rule.from.map_or("unknown".to_owned(), |from| from.to_string());
        let until = rule.until.map_or(String::new(), |until| format!(" to {until}"));
        let (standing, confidence) = (rule.standing.word(), rule.confidence.word());
        let (id, asks, cite) = (&rule.id.value, &rule.asks, &rule.cite);
        writeln!(text, "| `{id}` | {asks} | {from}{until} | {standing}, {confidence} | {cite} |")
            .unwrap();
    }
    text
}

fn assemblies(packs: &Packs) -> String {
    let library = Library::read(&Sources::from_folder(&root().join("gear-library")).unwrap()).0;
    let mut host = PluginHost::empty();
    endline_gear_types::all().into_iter().for_each(|gear| host.add(Hook::Gear(gear)).unwrap());
    let mut text = String::from("| assembly |");
    PLACES.iter().for_each(|(area, distance)| write!(text, " `{area}`, {distance} |").unwrap());
    text += &format!("\n|---|{}\n", "---|".repeat(PLACES.len()));
    for id in library.ids(Kind::Assembly) {
        let gear = of_library(id, Some(DEPTH_M), &library, &host)
            .unwrap_or_else(|error| panic!("{id}: {error}"));
        let cell = |(area, distance): &(&str, &str)| {
            let fishing = Fishing {
                area: (*area).to_owned(),
                on: Date::parse("2024-06-01").unwrap(),
                depth_m: Some(DEPTH_M),
                distance_m: Some(parse(distance, Quantity::Length).unwrap()),
                traps: None,
            };
            report(&check(&gear, packs, &fishing).unwrap())
        };
        let cells: Vec<String> = PLACES.iter().map(cell).collect();
        writeln!(text, "| `{id}` | {} |", cells.join(" | ")).unwrap();
    }
    text
}

fn report(sheet: &RuleSheet) -> String {
    let count = |verdict| sheet.with(verdict).count();
    let fails: Vec<String> =
        sheet.with(Verdict::Fail).map(|rule| format!("`{}`", rule.rule)).collect();
    let fails =
        if fails.is_empty() { String::new() } else { format!(", fails {}", fails.join(" ")) };
    let unchecked = count(Verdict::CannotBeChecked);
    let net = if sheet.uncovered.is_empty() { "" } else { "; no gillnet rule" };
    format!("passes {}{fails}; {unchecked} not checked{net}", count(Verdict::Pass))
}

/// The document with a table put between its marks.
fn with_table(document: &str, name: &str, table: &str) -> String {
    let (start, end) = (format!("<!-- {name} -->"), format!("<!-- end of {name} -->"));
    let (before, rest) =
        document.split_once(&start).unwrap_or_else(|| panic!("{DOCUMENT} lacks {start}"));
    let (_, after) = rest.split_once(&end).unwrap_or_else(|| panic!("{DOCUMENT} lacks {end}"));
    format!("{before}{start}\n{table}{end}{after}")
}

#[test]
fn the_document_has_the_facts_the_rules_and_the_shipped_assemblies() {
    let packs = Packs::open(Some(&root().join("gear-library")), &[])
        .unwrap_or_else(|error| panic!("{error}"));
    let path = root().join(DOCUMENT);
    let document = fs::read_to_string(&path).unwrap();
    let tables = [("facts", facts()), ("rules", rules(&packs)), ("assemblies", assemblies(&packs))];
    let fresh =
        tables.iter().fold(document.clone(), |text, (name, table)| with_table(&text, name, table));
    if std::env::var_os("ENDLINE_WRITE_DOCS").is_some() {
        fs::write(&path, &fresh).unwrap();
        return;
    }
    let first = document.lines().zip(fresh.lines()).find(|(old, new)| old != new);
    assert_eq!(
        document, fresh,
        "{DOCUMENT} is out of date, first at {first:?}; the head of tests/tests/tidy/rules_docs.rs says how to write it anew"
    );
}
