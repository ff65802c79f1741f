//! `endline validate`: cases run and judged; a table, JSON, or the document with its plots.

mod document;
mod plot;

use std::path::Path;
use std::process::ExitCode;

use endline_session::cases::{Cases, Convergence, Effort, Outcome, Verdict, outcome};
use schemars::JsonSchema;
use serde::Serialize;

use super::args::ValidateArgs;
use super::{Failure, host, output};
use crate::cli::table::columns;

/// Name and version of the JSON form.
pub(super) const SCHEMA: &str = "endline.validate/1";

/// The JSON of the command.
#[derive(JsonSchema, Serialize)]
pub(super) struct Report<'a> {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// Version of Endline.
    version: &'static str,
    /// Whether all cases have passed.
    passed: bool,
    /// The cases, in order of id.
    cases: &'a [Outcome],
}

pub(super) fn validate(args: &ValidateArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let cases = Cases::open(library)?;
    let outcomes = outcomes(args, &cases)?;
    let missed = outcomes.iter().filter(|outcome| !outcome.passed).count();
    if args.json {
        output::print(&json(&outcomes, missed))?;
    }
    if let Some(file) = &args.write {
        document::write(&outcomes, file).map_err(Failure::failed)?;
    }
    if missed == 0 {
        Ok(ExitCode::SUCCESS)
    } else {
        Err(Failure::failed(format!("{missed} of {} cases have not passed", outcomes.len())))
    }
}

/// Runs the cases asked for, or all; prints each when it is done.
fn outcomes(args: &ValidateArgs, cases: &Cases) -> Result<Vec<Outcome>, Failure> {
    let host = host::load();
    let ids = if args.cases.is_empty() { cases.ids()? } else { args.cases.clone() };
    let effort = if args.plain { Effort::Plain } else { Effort::Halved };
    let mut outcomes = Vec::new();
    for id in &ids {
        let outcome = cases.run(&cases.load(id)?, effort, &host)?;
        if !args.json {
            output::print(&words(&outcome))?;
        }
        outcomes.push(outcome);
    }
    Ok(outcomes)
}

fn json(outcomes: &[Outcome], missed: usize) -> String {
    let report = Report {
        schema: SCHEMA,
        version: endline_session::VERSION,
        passed: missed == 0,
        cases: outcomes,
    };
    // Structs of numbers and strings always serialise.
    serde_json::to_string(&report).unwrap_or_default() + "\n"
}

/// The case and its verdicts.
fn words(outcome: &Outcome) -> String {
    let word = if outcome.passed { "passed" } else { "NOT PASSED" };
    let mut text = format!("{}: {} ({word})\n", outcome.id, outcome.name);
    if let Some(stopped) = &outcome.stopped {
        text += &format!("  {stopped}\n");
    }
    let heading = [
        "",
        "expected",
        "got",
        "error",
        "tolerance",
        "",
        "half step",
        "order",
        "half segment",
        "order",
    ];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    rows.extend(outcome.verdicts.iter().map(row));
    text + &columns(&rows)
}

fn row(verdict: &Verdict) -> Vec<String> {
    let half = |finer: Option<Convergence>| {
        finer.map_or_else(String::new, |finer| outcome::error(verdict, finer.error_at_half))
    };
    let order = |finer: Option<Convergence>| finer.map_or_else(String::new, order);
    vec![
        format!("  {}", verdict.name),
        outcome::value(verdict.expected, verdict.unit),
        outcome::value(verdict.got, verdict.unit),
        outcome::error(verdict, verdict.error),
        outcome::limit(verdict),
        if verdict.passed { "ok".into() } else { "MISSED".into() },
        half(verdict.step),
        order(verdict.step),
        half(verdict.segment),
        order(verdict.segment),
    ]
}

/// An order of convergence; a dash where the readings do not differ.
fn order(finer: Convergence) -> String {
    finer.order.map_or_else(|| "-".into(), |order| format!("{order:.1}"))
}
