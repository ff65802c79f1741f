//! `endline rules fix`: edits by which an assembly would comply.

use std::path::Path;
use std::process::ExitCode;

use endline_gear::{Document, Setting};
use endline_session::json;
use endline_session::rules::Verdict;
use endline_session::rules::remedy::{Asked, Proposal, Remedies, Remedy, remedies};
use endline_session::source::AssemblyFile;

use super::args::FixArgs;
use super::check::head;
use super::write_new;
use crate::cli::{Failure, host, output};

/// Fields shown of an edit; all are in the JSON.
const MOST_SHOWN: usize = 8;

/// Exit code 0 wherever proposals could be searched for: `check` has the verdicts.
pub(super) fn fix(args: &FixArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let (packs, fishing) = args.fished.open(library)?;
    let file = AssemblyFile::open(&args.fished.assembly, library)?;
    let asked = Asked { id: &file.id, text: &file.text, sources: &file.sources };
    let remedies = remedies(asked, &packs, &fishing, &host::load())?;
    output::print(&if args.json { json::indented(&remedies) + "\n" } else { words(&remedies) })?;
    if let Some(named) = &args.write {
        let edit = chosen(&remedies, args.take)?;
        let path = write_new(named, &file.root, "assemblies", &renamed(edit)?)?;
        output::note(&format!("written to {}", path.display()));
    }
    Ok(ExitCode::SUCCESS)
}

/// The proposal of a number, or all edits together.
fn chosen(remedies: &Remedies, number: Option<usize>) -> Result<&Proposal, Failure> {
    let Some(number) = number else {
        let none = "nothing is written: no edit meets a rule that binds";
        return remedies.all.as_ref().ok_or_else(|| Failure::failed(none));
    };
    let count = remedies.numbered().count();
    let found = number.checked_sub(1).and_then(|index| remedies.numbered().nth(index));
    found.map(|(_, edit)| edit).ok_or_else(|| {
        Failure::usage(format!("--take {number}: the proposals have the numbers 1 to {count}"))
    })
}

/// The edited text under a name of its own.
fn renamed(edit: &Proposal) -> Result<String, Failure> {
    let mut document = Document::parse(&edit.text).map_err(Failure::failed)?;
    let name = document.get("name").unwrap_or_default();
    document.put("name", &Setting::text(&format!("{name} (fixed)"))).map_err(Failure::failed)?;
    Ok(document.text())
}

fn words(remedies: &Remedies) -> String {
    let mut text = head(&remedies.before);
    let mut number = 0;
    for rule in &remedies.rules {
        text += &of_rule(remedies, rule);
        for edit in &rule.proposals {
            number += 1;
            text += &of_edit(&format!("{number:>3}."), edit);
        }
        text.push('\n');
    }
    if remedies.rules.iter().all(|rule| rule.verdict != Verdict::Fail) {
        return text + "Nothing fails.\n";
    }
    match &remedies.all {
        Some(all) => text + &of_edit("All rules that bind, one edit after another:\n    ", all),
        None => text + "No edit meets a rule that binds.\n",
    }
}

/// The rule, the measured values, and why there is no edit.
fn of_rule(remedies: &Remedies, rule: &Remedy) -> String {
    let Some(result) = remedies.before.rules.iter().find(|one| one.rule == rule.rule) else {
        return String::new();
    };
    let advice = if rule.binding { String::new() } else { format!(" ({})", result.standing) };
    let mut text =
        format!("{:17}  {:26}  {}{advice}\n", rule.verdict.words(), rule.rule, result.asks);
    let measured = result.measured.iter().filter(|one| !one.holds).take(2);
    for one in measured {
        let part = if one.part.is_empty() { String::new() } else { format!("{}: ", one.part) };
        text += &format!("{:19}{part}{} (not met)\n", "", one.says);
    }
    if !rule.why_none.is_empty() {
        text += &format!("{:19}no edit meets it: {}\n", "", rule.why_none);
    }
    text
}

fn of_edit(lead: &str, edit: &Proposal) -> String {
    let mut text = format!("{lead} {}\n", edit.says);
    for change in edit.changes.iter().take(MOST_SHOWN) {
        let or_none = |value: &Option<String>| value.clone().unwrap_or_else(|| "none".to_owned());
        let (before, after) = (or_none(&change.before), or_none(&change.after));
        text += &format!("       {}: {before} -> {after}\n", change.field);
    }
    if edit.changes.len() > MOST_SHOWN {
        text += &format!("       and {} more fields\n", edit.changes.len() - MOST_SHOWN);
    }
    let list = |rules: &[String]| {
        if rules.is_empty() { "nothing".to_owned() } else { rules.join(" ") }
    };
    text + &format!(
        "       passes {}; breaks {}; still fails {}; {:.0} % of the rope is replaced\n",
        list(&edit.passes),
        list(&edit.breaks),
        list(&edit.still_fails),
        100.0 * edit.rope_share
    )
}
