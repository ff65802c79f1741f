//! The document of all cases: tables by group, convergence, plots; all generated.

use std::fmt::Write;
use std::path::Path;

use endline_session::cases::{Convergence, Outcome, Verdict, outcome};
use endline_session::save;

use super::plot;

/// Where the plots lie, from the document.
const PICTURES: &str = "pictures/validation";

const HEAD: &str = "# Validation

This page compares results of Endline with known values: reference problems, measured gear and conserved quantities.
`endline validate --write docs/validation.md` writes this page and its plots from the case files in `gear-library/cases`; edit those files, not this page.

A case is a text file that names a scenario, the compared quantities, the expected values and their source (docs/gear-format.md).
`endline validate` runs all cases, and `endline validate CASE` runs one.
\"Expected\" is 0 if the result itself is a difference: an RMS distance, or a share gained or lost.
The order of convergence follows from the results at full, half and quarter step or segment length; it needs no exact answer.
A dash means that they do not differ.
";

/// Writes the document and a plot beside it for each case that has curves or points.
pub(super) fn write(outcomes: &[Outcome], file: &Path) -> Result<(), String> {
    let folder = file.parent().unwrap_or(Path::new("")).join(PICTURES);
    let place = |path: &Path, reason: String| format!("{}: {reason}", path.display());
    std::fs::create_dir_all(&folder).map_err(|error| place(&folder, error.to_string()))?;
    for outcome in outcomes {
        if let Some(picture) = plot::picture(outcome)? {
            let path = folder.join(format!("{}.svg", outcome.id));
            save::atomically(&path, picture.as_bytes())
                .map_err(|error| place(&path, error.to_string()))?;
        }
    }
    save::atomically(file, document(outcomes).as_bytes())
        .map_err(|error| place(file, error.to_string()))
}

fn document(outcomes: &[Outcome]) -> String {
    let mut whole = HEAD.to_owned();
    whole += &format!("\n{}\n", verdict_of_all(outcomes));
    let mut groups: Vec<&str> = Vec::new();
    for outcome in outcomes {
        if !groups.contains(&outcome.group.as_str()) {
            groups.push(&outcome.group);
        }
    }
    for group in groups {
        let own: Vec<&Outcome> = outcomes.iter().filter(|outcome| outcome.group == group).collect();
        // Writing into a String cannot fail.
        let _ = write!(whole, "\n## {group}\n\n{}{}", verdicts(&own), convergence(&own));
        for outcome in own {
            whole += &section(outcome);
        }
    }
    whole
}

fn verdict_of_all(outcomes: &[Outcome]) -> String {
    let missed: Vec<&str> = outcomes
        .iter()
        .filter(|outcome| !outcome.passed)
        .map(|outcome| outcome.id.as_str())
        .collect();
    if missed.is_empty() {
        return format!("All {} cases pass.", outcomes.len());
    }
    format!(
        "{} of {} cases pass; not within their tolerance: {}.",
        outcomes.len() - missed.len(),
        outcomes.len(),
        missed.join(", ")
    )
}

fn verdicts(outcomes: &[&Outcome]) -> String {
    let mut table = "| case | compared | expected | result | error | tolerance | |\n|---|---|---|---|---|---|---|\n".to_owned();
    for outcome in outcomes {
        for verdict in &outcome.verdicts {
            let passed = if verdict.passed { "ok" } else { "**missed**" };
            let expected = outcome::value(verdict.expected, verdict.unit);
            let (got, error) =
                (outcome::value(verdict.got, verdict.unit), outcome::error(verdict, verdict.error));
            let limit = outcome::limit(verdict);
            let _ = writeln!(
                table,
                "| {} | {} | {expected} | {got} | {error} | {limit} | {passed} |",
                outcome.id, verdict.name
            );
        }
        if let Some(stopped) = &outcome.stopped {
            let _ = writeln!(
                table,
                "| {} | {} | | | | | **missed** |",
                outcome.id,
                stopped.replace('\n', " ")
            );
        }
    }
    table
}

/// What halving changes, where any case of the group does it.
fn convergence(outcomes: &[&Outcome]) -> String {
    let mut rows = String::new();
    for outcome in outcomes {
        for verdict in outcome
            .verdicts
            .iter()
            .filter(|verdict| verdict.step.is_some() || verdict.segment.is_some())
        {
            let (half_step, order_step) = halved(verdict, verdict.step);
            let (half_segment, order_segment) = halved(verdict, verdict.segment);
            let whole = outcome::error(verdict, verdict.error);
            let name = &verdict.name;
            let _ = writeln!(
                rows,
                "| {} | {name} | {whole} | {half_step} | {order_step} | {half_segment} | {order_segment} |",
                outcome.id
            );
        }
    }
    if rows.is_empty() {
        return rows;
    }
    let heading = "\n| case | compared | error | at half the step | order in time | at half the segment | order in space |\n";
    format!("{heading}|---|---|---|---|---|---|---|\n{rows}")
}

fn halved(verdict: &Verdict, finer: Option<Convergence>) -> (String, String) {
    finer.map_or_else(Default::default, |finer| {
        (outcome::error(verdict, finer.error_at_half), super::order(finer))
    })
}

fn section(outcome: &Outcome) -> String {
    let mut whole = format!("\n### {}: {}\n\n", outcome.id, outcome.name);
    if !outcome.notes.is_empty() {
        whole += &format!("{}\n", outcome.notes);
    }
    let _ = writeln!(
        whole,
        "Scenario `gear-library/scenarios/{}.toml`, {} segments, step {} s. Expected values: {} ({}).",
        outcome.scenario, outcome.segments, outcome.step_s, outcome.source, outcome.confidence
    );
    if !outcome.curves.is_empty() || !outcome.points.is_empty() {
        let _ = writeln!(
            whole,
            "\n![{}: simulated and expected]({PICTURES}/{}.svg)",
            outcome.name, outcome.id
        );
    }
    whole
}
