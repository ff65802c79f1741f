//! The report as one HTML file, its figures inside: the data of `assets/report/study.html`.

use askama::Template;

use crate::study::prepared::PreparedStudy;
use crate::study::stats::{Findings, OptionFinding, answer, observed, resolution};

use super::Beside;
use super::words::event_words;
use super::{COMMANDS, figures, held, inputs, results};
use crate::page::{Line, STYLE};

/// All that the page shows: the template takes tables, figures and names from these. It escapes texts; figures are markup.
#[derive(Template)]
#[template(path = "study.html")]
struct Page<'a> {
    opened: &'a PreparedStudy,
    findings: &'a Findings,
    beside: &'a Beside<'a>,
    /// The event by which options are ranked, in words.
    event: String,
    /// Runs that are invalid.
    invalid: u64,
    /// Runs that were too short for a final outcome.
    undecided: u64,
    /// The plugins, with their versions.
    plugins: String,
}

/// The page as HTML.
/// Errors: where the template cannot be filled in.
pub(super) fn html(
    opened: &PreparedStudy,
    findings: &Findings,
    beside: &Beside<'_>,
) -> Result<String, askama::Error> {
    let count = |of: fn(&OptionFinding) -> u64| findings.options.iter().map(of).sum();
    let plugins = opened.options[opened.baseline].prepared.plugins.iter();
    let plugins: Vec<String> =
        plugins.map(|plugin| format!("{} {}", plugin.id, plugin.version)).collect();
    Page {
        opened,
        findings,
        beside,
        event: event_words(&findings.event),
        invalid: count(|option| option.invalid),
        undecided: count(|option| option.undecided),
        plugins: plugins.join(", "),
    }
    .render()
}

fn forest_caption(event: &str) -> String {
    format!(
        "Rate of \"{event}\" less that of the baseline, in percentage points, on the same encounters. \
         Left of the line: fewer than with the baseline."
    )
}

fn tornado_caption(event: &str) -> String {
    format!(
        "Rate of \"{event}\" with the baseline, by the lower and upper half of each input or by its levels. \
         The words at a bar's ends name the parts with the least and the greatest rate. \
         The result depends much on an input with a wide bar."
    )
}
