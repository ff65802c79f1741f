//! How an option's runs end beside the baseline's in the same encounters, as a section of the report.

use crate::study::stats::{Change, Findings, OptionFinding};

use super::html::table;
use super::svg::escape;
use super::words::{outcome_words, percent_interval, rate};

/// The section; nothing where there is only the baseline.
pub(super) fn section(findings: &Findings) -> String {
    let others =
        findings.options.iter().enumerate().filter(|(index, _)| *index != findings.baseline);
    let rows: Vec<Vec<String>> = others.map(|(_, option)| row(option)).collect();
    if rows.is_empty() {
        return String::new();
    }
    let heads = [
        "option",
        "another outcome",
        "mean greatest tension",
        "another outcome, of those that touch",
        "mean greatest tension, of those that touch",
        "outcome with the baseline, and here",
    ];
    format!(
        "<h2>What the same encounters come to instead</h2>{}",
        table("Outcome and tension beside the baseline's, encounter by encounter", &heads, &rows)
    )
}

fn row(option: &OptionFinding) -> Vec<String> {
    let changes = &option.changes;
    let cells = [&changes.all, &changes.touching]
        .into_iter()
        .flat_map(|change| [rate(&change.outcome), tension(change)]);
    let kinds = changes.counts.iter().filter(|(one, other, _)| one != other);
    let kinds: Vec<String> = kinds
        .map(|(one, other, count)| {
            format!("{} to {}: {count}", outcome_words(one), outcome_words(other))
        })
        .collect();
    let kinds = if kinds.is_empty() { "the same in all".to_owned() } else { kinds.join("<br>") };
    [escape(&option.name)].into_iter().chain(cells).chain([kinds]).collect()
}

/// `104 N, +1.3 % [-0.2, 2.8]`.
fn tension(change: &Change) -> String {
    let (Some([_, own_n]), Some(more)) = (change.mean_tension_n, change.tension) else {
        return "none".into();
    };
    let interval = change.tension_interval.map_or_else(String::new, percent_interval);
    format!("{own_n:.0} N, {:+.1} % {interval}", 100.0 * more)
}
