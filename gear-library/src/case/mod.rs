//! The validation case: a scenario, what is read of it, and what it should read, as data.
//!
//! A case file lies in `cases/` and its reference tables in `cases/tables/`. The session runs it; the program's
//! `endline validate` prints what came of it. The format is described in `docs/gear-format.md`.

mod check;
mod hauled;
mod rows;
mod table;

use crate::confidence::Confidence;
use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry;
use crate::fields::{Fields, Problems, Provenance, Range, read_value};
use crate::tree::{self, Content, Node};
use crate::units::Quantity;

pub use check::{Check, Limit, Measure};
pub use hauled::CaseHaul;
pub use rows::Rows;
pub use table::Table;

/// A case as read.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// What it is for, and why a tolerance is as it is; may be empty.
    pub notes: String,
    /// Heading it stands under.
    pub group: String,
    /// Where the expected values come from.
    pub source: String,
    /// How well they are known.
    pub confidence: Confidence,
    /// The file itself.
    pub place: Place,
    /// Id of its scenario: a file of `scenarios/`.
    pub scenario: At<String>,
    /// Fields over the scenario's, by dotted path.
    pub set: Vec<(At<String>, String)>,
    /// Whether it is run at half the step too.
    pub halve_step: bool,
    /// Whether it is run at half the segment too.
    pub halve_segment: bool,
    /// Whether it is cheap enough for the everyday tests.
    pub quick: bool,
    /// Row of the hindcast that it answers: what was seen on real gear or whales, and nothing was fitted to.
    pub hindcast: Option<String>,
    /// How the gear is hauled, where it is; the scenario then gives gear, sea and step.
    pub haul: Option<CaseHaul>,
    /// When readings are taken.
    pub samples: Samples,
    /// Id of the table of expected readings: columns `t` [s] and one by each probe's id, SI.
    pub table: Option<At<String>>,
    /// What is compared.
    pub checks: Vec<Check>,
}

/// When readings are taken.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Once, of the gear at rest.
    Rest,
    /// At the times of the table.
    Table,
    /// All through the run, at this interval [s].
    Every(f64),
    /// Of the gear at rest or under way, for each row of measurements anew.
    Rows(Box<Rows>),
}

impl Case {
    /// Reads a case's text; `name` is its path as shown in messages.
    ///
    /// # Errors
    /// Everything wrong with it that can be seen without its scenario and table.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let problems = Problems::default();
        let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
        let case = Self::from_node(name, &node, &problems);
        match case {
            Some(case) if !problems.any_error() => Ok(case),
            _ => Err(problems.into_sorted()),
        }
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "case", problems);
        check_provenance(&fields, &file);
        let group = fields.need_text(
            "group",
            "write the heading it belongs under, such as \"Reference problems\"",
        );
        let scenario = fields
            .need_text("scenario", "write the id of a scenario, such as \"reference-a-pendulum\"");
        let set = choices(&fields, "set");
        let halve = words(&fields, "halve", &["step", "segment"]);
        let quick = fields.flag("quick").unwrap_or(false);
        let hindcast = fields.text("hindcast").map(|row| row.value);
        let table = fields.text("table");
        let samples = samples(&fields, table.is_some());
        check_halving(samples.as_ref(), &halve, problems);
        let haul = fields.table("haul").map(|haul| hauled::read(&haul));
        if haul.is_some() && !matches!(samples, Some(Samples::Every(_)) | None) {
            fields.missing("every", "a [haul] is sampled all along: write every = \"0.1 s\"");
        }
        let checks: Vec<Check> =
            fields.tables("check").iter().filter_map(|node| check::read(node, problems)).collect();
        if fields.tables("check").is_empty() {
            fields.missing("check", "write what is compared under [[check]]");
        }
        fields.finish();
        let halves = |knob: &str| halve.iter().any(|word| word.value == knob);
        Some(Self {
            id: path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml").to_owned(),
            name,
            notes,
            group: group?.value,
            source: file.source?,
            confidence: file.confidence?,
            place: node.place.clone(),
            scenario: scenario?,
            set,
            halve_step: halves("step"),
            halve_segment: halves("segment"),
            quick,
            hindcast,
            haul,
            samples: samples?,
            table,
            checks,
        })
    }
}

/// Expected values have a source and a confidence.
fn check_provenance(fields: &Fields<'_>, file: &Provenance) {
    let help = "say where the expected values come from, and whether they are measured, derived or estimate";
    if file.source.is_none() {
        fields.missing("source", help);
    }
    if file.confidence.is_none() {
        fields.missing("confidence", help);
    }
}

/// With `[rows]` neither step nor segment is halved.
fn check_halving(samples: Option<&Samples>, halve: &[At<String>], problems: &Problems) {
    if let (Some(Samples::Rows(rows)), [knob, ..]) = (samples, halve) {
        let message = format!("`{}` cannot be halved with [rows]", knob.value);
        let help = format!("take `halve` out, or [rows] by `{}`", rows.by.value);
        problems.push(knob.place.error(message, help));
    }
}

/// `at = "rest"` or `"table"`, `every = "0.1 s"`, or `[rows]`.
fn samples(fields: &Fields<'_>, has_table: bool) -> Option<Samples> {
    let at = fields.word("at", &["rest", "table"]);
    let every = fields.value("every", Quantity::Time, Range::Positive);
    let rows = fields.table("rows").map(|rows| rows::read(&rows));
    match (at.as_ref().map(|at| at.value.as_str()), every, rows) {
        (Some("rest"), None, None) => Some(Samples::Rest),
        (Some(_), None, None) if has_table => Some(Samples::Table),
        (None, Some(every), None) => Some(Samples::Every(every.value)),
        (None, None, Some(rows)) => Some(Samples::Rows(Box::new(rows?))),
        _ => {
            fields.missing("at", "write at = \"rest\", at = \"table\" with a `table`, every = \"0.1 s\", or [rows]; one of them");
            None
        }
    }
}

/// A table of texts by key, such as `[set]`.
fn choices(fields: &Fields<'_>, key: &'static str) -> Vec<(At<String>, String)> {
    let Some(table) = fields.table(key) else { return Vec::new() };
    let mut choices = Vec::new();
    for (field, place, node) in table.rest() {
        match &node.content {
            Content::Text(text) => {
                choices.push((At { value: field.clone(), place: place.clone() }, text.clone()))
            }
            other => {
                let message = format!("`{field}` is {}, not a text", other.noun());
                fields.problems().push(node.place.error(
                    message,
                    "write the value in quotes, as it would stand in the scenario",
                ));
            }
        }
    }
    choices
}

/// A list of texts, or one text; with `allowed` each is one of a few words.
fn words(fields: &Fields<'_>, key: &'static str, allowed: &[&str]) -> Vec<At<String>> {
    let Some(node) = fields.get(key) else { return Vec::new() };
    let items = match &node.content {
        Content::List(items) => items.iter().collect(),
        _ => vec![node],
    };
    let word = |item: &&Node| match &item.content {
        Content::Text(text) if allowed.is_empty() || allowed.contains(&text.as_str()) => {
            Some(At { value: text.clone(), place: item.place.clone() })
        }
        _ => {
            let choice = if allowed.is_empty() {
                "texts in quotes".to_owned()
            } else {
                format!("of {}", allowed.join(", "))
            };
            fields.problems().push(item.place.error(
                format!("this is no value of `{key}`"),
                format!("expected a list {choice}"),
            ));
            None
        }
    };
    items.iter().filter_map(word).collect()
}

/// A number, or a text with a unit of length, force or another quantity that a probe reads.
fn reading(node: &Node, problems: &Problems) -> Option<f64> {
    let quantities = [Quantity::Length, Quantity::Force, Quantity::Speed];
    let known = |text: &str| {
        quantities.into_iter().find(|quantity| crate::units::parse(text, *quantity).is_ok())
    };
    let quantity = match &node.content {
        Content::Text(text) => known(text).unwrap_or(Quantity::Force),
        _ => Quantity::Ratio,
    };
    read_value(node, quantity, Range::Any, problems).map(|value| value.value)
}
