//! `endline validate`: cases run and judged; a table, JSON, or the document with its plots.

mod document;
mod plot;
mod text;

use std::path::Path;
use std::process::ExitCode;

use endline_session::cases::{Cases, Effort, Outcome};
use schemars::JsonSchema;
use serde::Serialize;

use super::args::ValidateArgs;
use super::{Failure, host, output};

/// Name and version of the JSON form.
pub(super) const SCHEMA: &str = "endline.validate/1";

/// What `--json` prints.
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

/// Runs the cases asked for, or all; each is told as it is done.
fn outcomes(args: &ValidateArgs, cases: &Cases) -> Result<Vec<Outcome>, Failure> {
    let host = host::load();
    let ids = if args.cases.is_empty() { cases.ids()? } else { args.cases.clone() };
    let effort = if args.plain { Effort::Plain } else { Effort::Halved };
    let mut outcomes = Vec::new();
    for id in &ids {
        let outcome = cases.run(&cases.load(id)?, effort, &host)?;
        if !args.json {
            output::print(&text::told(&outcome))?;
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
