//! A case's outcome for a terminal.

use endline_session::cases::{Convergence, Outcome, Verdict, words};

use crate::cli::table::columns;

/// The case and its verdicts.
pub(super) fn told(outcome: &Outcome) -> String {
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
        finer.map_or_else(String::new, |finer| words::error(verdict, finer.error_at_half))
    };
    let order = |finer: Option<Convergence>| finer.map_or_else(String::new, order);
    vec![
        format!("  {}", verdict.name),
        words::value(verdict.expected, verdict.unit),
        words::value(verdict.got, verdict.unit),
        words::error(verdict, verdict.error),
        words::limit(verdict),
        if verdict.passed { "ok".into() } else { "MISSED".into() },
        half(verdict.step),
        order(verdict.step),
        half(verdict.segment),
        order(verdict.segment),
    ]
}

/// An order of convergence; a dash where the readings do not differ.
pub(super) fn order(finer: Convergence) -> String {
    finer.order.map_or_else(|| "-".into(), |order| format!("{order:.1}"))
}
