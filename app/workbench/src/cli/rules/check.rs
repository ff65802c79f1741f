//! `endline rules check`: an assembly under every rule.

use std::path::Path;
use std::process::ExitCode;

use endline_session::json;
use endline_session::rules::{RuleResult, RuleSheet, Verdict, assembly, check};

use super::args::CheckArgs;
use crate::cli::{Failure, host, output};

/// Measured values shown of a rule; all are in the JSON.
const MOST_SHOWN: usize = 6;

/// Exit code 1 where a rule that binds fails.
pub(super) fn check_rules(args: &CheckArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let fished = &args.fished;
    let (packs, fishing) = fished.open(library)?;
    let gear = assembly(&fished.assembly, fished.depth, library, &host::load())?;
    let sheet = check(&gear, &packs, &fishing)?;
    output::print(&if args.json {
        json::indented(&sheet) + "\n"
    } else {
        words(&sheet, args.brief)
    })?;
    Ok(if sheet.fails_binding() { ExitCode::from(1) } else { ExitCode::SUCCESS })
}

/// The assembly, the area and the day.
pub(super) fn head(sheet: &RuleSheet) -> String {
    let usual = if sheet.depth_is_usual { ", taken because --depth is not given" } else { "" };
    let mut text = format!(
        "{} in {} on {}, assembled for {} m of water{usual}\n\n",
        sheet.assembly, sheet.area, sheet.on, sheet.depth_m
    );
    for says in &sheet.uncovered {
        text += &format!("note: {says}\n\n");
    }
    text
}

fn words(sheet: &RuleSheet, brief: bool) -> String {
    let mut text = head(sheet);
    let shown = |rule: &&RuleResult| !brief || rule.verdict != Verdict::NotApplicable;
    text += &sheet.rules.iter().filter(shown).map(one).collect::<String>();
    let counts = sheet.counts;
    let advice = match counts.fail - counts.fail_binding {
        0 => String::new(),
        advice => format!(" ({advice} of them advice that does not bind)"),
    };
    text + &format!(
        "\n{} pass, {} fail{advice}, {} do not apply, {} cannot be checked\n",
        counts.pass, counts.fail, counts.not_applicable, counts.cannot_be_checked
    )
}

fn one(rule: &RuleResult) -> String {
    let mut text = format!(
        "{:17}  {:26}  {}{}\n",
        rule.verdict.words(),
        rule.rule,
        rule.asks,
        standing(rule.standing, rule.confidence)
    );
    let indent = " ".repeat(19);
    if !rule.why.is_empty() {
        text += &format!("{indent}{}\n", rule.why);
    }
    for measured in rule.measured.iter().take(MOST_SHOWN) {
        let part =
            if measured.part.is_empty() { String::new() } else { format!("{}: ", measured.part) };
        let fails = if measured.holds { "" } else { " (not met)" };
        text += &format!("{indent}{part}{}{fails}\n", measured.says);
    }
    if rule.measured.len() > MOST_SHOWN {
        text += &format!("{indent}and {} more\n", rule.measured.len() - MOST_SHOWN);
    }
    if rule.verdict == Verdict::Fail {
        text += &format!("{indent}fix: {}\n{indent}{}\n", rule.remedy, rule.cite);
    }
    text
}

/// Caveats: that a rule does not bind, or that it was not verified.
fn standing(standing: &str, confidence: &str) -> String {
    match (standing, confidence) {
        ("law", "estimate") => " (not verified)".to_owned(),
        ("law", _) => String::new(),
        (other, "estimate") => format!(" ({other}, not verified)"),
        (other, _) => format!(" ({other})"),
    }
}
