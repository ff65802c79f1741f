//! The table of changes: how an option's runs end beside the baseline's in the same encounters.

use crate::study::stats::{Change, Findings, OptionFinding};

use super::words::{outcome_words, percent_interval, rate};
use crate::page::cell::{Cell, Table};

/// The table; `None` where there is only the baseline.
pub(super) fn table(findings: &Findings) -> Option<Table> {
    let headings = [
        "option",
        "another outcome",
        "mean greatest tension",
        "another outcome, of those that touch",
        "mean greatest tension, of those that touch",
        "outcome with the baseline, and with the option",
    ];
    let rows: Vec<Vec<Cell>> = findings.others().map(row).collect();
    let caption = "Outcome and tension beside the baseline's, encounter by encounter";
    (!rows.is_empty()).then(|| Table::new(caption, &headings, rows))
}

fn row(option: &OptionFinding) -> Vec<Cell> {
    let changes = &option.changes;
    let cells = [&changes.all, &changes.touching]
        .into_iter()
        .flat_map(|change| [rate(&change.outcome).into(), tension(change).into()]);
    [Cell::from(&option.name)].into_iter().chain(cells).chain([kinds(option)]).collect()
}

/// `entangled to shed: 4`, a line for each kind of change.
fn kinds(option: &OptionFinding) -> Cell {
    let changed = option.changes.counts.iter().filter(|(one, other, _)| one != other);
    let lines: Vec<String> = changed
        .map(|(one, other, count)| {
            format!("{} to {}: {count}", outcome_words(one), outcome_words(other))
        })
        .collect();
    if lines.is_empty() { "equal in all encounters".into() } else { Cell::lines(lines) }
}

/// `104 N, +1.3 % [-0.2, 2.8]`.
fn tension(change: &Change) -> String {
    let (Some([_, own_n]), Some(more)) = (change.mean_tension_n, change.tension) else {
        return "none".into();
    };
    let interval = change.tension_interval.map_or_else(String::new, percent_interval);
    format!("{own_n:.0} N, {:+.1} % {interval}", 100.0 * more)
}
