//! The report as one HTML file, its figures inside: the data of `assets/report/study.html`.

use askama::Template;

use crate::study::prepared::PreparedStudy;
use crate::study::stats::{Findings, answer};

use super::hauled::HauledLoad;
use super::words::event_words;
use super::{bundle, figures, held, inputs, results};
use crate::page::STYLE;
use crate::page::{Line, Table};

/// All that the page shows. The template escapes texts; `style` and fields that end in `figure` are markup.
#[derive(Template)]
#[template(path = "study.html")]
struct Page<'a> {
    style: &'static str,
    id: &'a str,
    name: &'a str,
    notes: &'a str,
    scenario: &'a str,
    baseline: &'a str,
    answer: Vec<String>,
    counts: Counts,
    rates: Vec<Table>,
    rates_figure: String,
    bands: Table,
    compared: Vec<Table>,
    forest_figure: String,
    forest_caption: String,
    changes: Option<Table>,
    survival: Table,
    survival_figure: String,
    tensions: Table,
    tensions_figure: String,
    break_away_figure: Option<String>,
    hauled: bool,
    regions: Table,
    claims: Option<Table>,
    observations: Option<Table>,
    sensitivity: Option<Sensitivity>,
    priors: Table,
    strengths: Table,
    settings: Table,
    again: Again<'a>,
}

/// Numbers of encounters and runs.
struct Counts {
    options: usize,
    encounters: u64,
    runs: u64,
    invalid: u64,
    undecided: u64,
}

/// Sensitivity of the result to inputs.
struct Sensitivity {
    figure: String,
    caption: String,
    table: Table,
}

/// How to reproduce the report.
struct Again<'a> {
    version: &'static str,
    commands: &'static str,
    hash: &'a str,
    seed: u64,
    plugins: String,
}

/// The page as HTML.
/// Errors: where the template cannot be filled in.
pub(super) fn html(
    opened: &PreparedStudy,
    findings: &Findings,
    hauls: &[HauledLoad],
) -> Result<String, askama::Error> {
    Page::of(opened, findings, hauls).render()
}

impl<'a> Page<'a> {
    fn of(opened: &'a PreparedStudy, findings: &'a Findings, hauls: &[HauledLoad]) -> Self {
        let study = &opened.study;
        Self {
            style: STYLE,
            id: &study.id,
            name: &study.name,
            notes: &study.notes,
            scenario: &study.scenario.value,
            baseline: &opened.options[opened.baseline].name,
            answer: answer(findings, &findings.event),
            counts: Counts::of(findings),
            rates: results::rates(findings),
            rates_figure: figures::rates(findings),
            bands: results::bands(findings),
            compared: results::compared(findings),
            forest_figure: figures::forest(findings),
            forest_caption: forest_caption(findings),
            changes: results::changes(findings),
            survival: held::table(findings),
            survival_figure: held::figure(findings),
            tensions: results::tensions(findings),
            tensions_figure: figures::tensions(findings),
            break_away_figure: figures::break_away(findings, hauls),
            hauled: !hauls.is_empty(),
            regions: results::regions(findings),
            claims: inputs::claims(findings),
            observations: inputs::observations(findings),
            sensitivity: sensitivity(findings),
            priors: inputs::priors(opened),
            strengths: inputs::strengths(findings),
            settings: inputs::settings(opened),
            again: Again::of(opened, findings),
        }
    }
}

impl Counts {
    fn of(findings: &Findings) -> Self {
        let options = &findings.options;
        Self {
            options: options.len(),
            encounters: findings.encounters,
            runs: findings.encounters * options.len() as u64,
            invalid: options.iter().map(|option| option.invalid).sum(),
            undecided: options.iter().map(|option| option.undecided).sum(),
        }
    }
}

impl<'a> Again<'a> {
    fn of(opened: &PreparedStudy, findings: &'a Findings) -> Self {
        let plugins = opened.options[opened.baseline].prepared.plugins.iter();
        let plugins: Vec<String> =
            plugins.map(|plugin| format!("{} {}", plugin.id, plugin.version)).collect();
        Self {
            version: crate::VERSION,
            commands: bundle::COMMANDS,
            hash: &findings.hash,
            seed: opened.study.seed,
            plugins: plugins.join(", "),
        }
    }
}

fn forest_caption(findings: &Findings) -> String {
    format!(
        "Rate of \"{}\" less that of the baseline, in percentage points, on the same encounters. \
         Left of the line: fewer than with the baseline.",
        event_words(&findings.event)
    )
}

/// `None` where no input has parts to compare.
fn sensitivity(findings: &Findings) -> Option<Sensitivity> {
    let caption = format!(
        "Rate of \"{}\" with the baseline, by the lower and upper half of each input or by its levels. \
         The words at a bar's ends name the parts with the least and the greatest rate. \
         The result depends much on an input with a wide bar.",
        event_words(&findings.event)
    );
    let figure = figures::tornado(findings)?;
    Some(Sensitivity { figure, caption, table: inputs::sensitivity(findings) })
}
