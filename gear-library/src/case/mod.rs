//! Validation cases: a scenario, readings of it, and their expected values.
//!
//! Case files are in `cases/`, their reference tables in `cases/tables/`. The session runs a case, and `endline validate`
//! prints the result. With `[haul]` the gear is hauled from its first buoy; with `[rows]` the scenario is modified and solved
//! for each row of a table. The format is described in `docs/gear-format.md`.

mod check;
mod table;

use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry::{self, Confidence};
use crate::fields::{Fields, Problems, Provenance, Range, id_of, read_file, read_value};
use crate::limits;
use crate::tree::{Content, Node};
use crate::units::Quantity;

pub use check::{Check, Limit, Measure};
pub use table::Table;

/// A case as read.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Its purpose and the reasons of its tolerances; may be empty.
    pub notes: String,
    /// Heading of its group.
    pub group: String,
    /// Source of the expected values.
    pub source: String,
    /// Confidence in them.
    pub confidence: Confidence,
    /// The file itself.
    pub place: Place,
    /// Id of its scenario: a file of `scenarios/`.
    pub scenario: At<String>,
    /// Fields that override the scenario, by dotted path.
    pub set: Vec<(At<String>, String)>,
    /// Whether it is also run at half the step.
    pub halve_step: bool,
    /// Whether it is also run at half the segment length.
    pub halve_segment: bool,
    /// Whether it is fast enough for the quick tests.
    pub quick: bool,
    /// Its row of the hindcast: an observation of real gear or whales that was not used for a fit.
    pub hindcast: Option<String>,
    /// Haul of the gear, if any; the scenario then defines gear, sea and step.
    pub haul: Option<CaseHaul>,
    /// Times of the readings.
    pub samples: Samples,
    /// Id of the table of expected readings: columns `t` [s] and one by each probe's id, SI.
    pub table: Option<At<String>>,
    /// Comparisons.
    pub checks: Vec<Check>,
}

/// Times of the readings.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// The gear at rest.
    Rest,
    /// At the times of the table.
    Table,
    /// Regular intervals of the run [s].
    Every(f64),
    /// Each row of measurements, at rest or in a run.
    Rows(Box<Rows>),
}

impl Case {
    /// Reads a case's text; `name` is its path as shown in messages.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        read_file(name, text, |node, problems| Self::from_node(name, node, problems))
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "case", problems);
        check_provenance(&fields, &file);
        let group = fields
            .need_text("group", "write the heading of its group, such as \"Reference problems\"");
        let scenario = fields
            .need_text("scenario", "write the id of a scenario, such as \"reference-a-pendulum\"");
        let set = choices(&fields, "set");
        let halve = words(&fields, "halve", &["step", "segment"]);
        let quick = fields.flag("quick").unwrap_or(false);
        let hindcast = fields.text("hindcast").map(|row| row.value);
        let table = fields.text("table");
        let samples = samples(&fields, table.is_some());
        check_halving(samples.as_ref(), &halve, problems);
        let haul = fields.inside("haul", read_haul);
        if haul.is_some() && !matches!(samples, Some(Samples::Every(_)) | None) {
            fields.missing("every", "a [haul] is sampled at intervals: write every = \"0.1 s\"");
        }
        let checks = fields.each("check", check::read);
        if fields.tables("check").is_empty() {
            fields.missing("check", "write the comparisons under [[check]]");
        }
        fields.finish();
        let halves = |knob: &str| halve.iter().any(|word| word.value == knob);
        Some(Self {
            id: id_of(path),
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

/// Checks that the expected values have a source and a confidence.
fn check_provenance(fields: &Fields<'_>, file: &Provenance) {
    let help = "write the source of the expected values, and whether they are measured, catalogue, derived or estimate";
    if file.source.is_none() {
        fields.missing("source", help);
    }
    if file.confidence.is_none() {
        fields.missing("confidence", help);
    }
}

/// Reports a halved step or segment with `[rows]`.
fn check_halving(samples: Option<&Samples>, halve: &[At<String>], problems: &Problems) {
    if let (Some(Samples::Rows(rows)), [knob, ..]) = (samples, halve) {
        let message = format!("`{}` cannot be halved with [rows]", knob.value);
        let help = format!("remove `halve`, or [rows] by `{}`", rows.by.value);
        problems.push(knob.place.error(message, help));
    }
}

/// `at = "rest"` or `"table"`, `every = "0.1 s"`, or `[rows]`.
fn samples(fields: &Fields<'_>, has_table: bool) -> Option<Samples> {
    let at = fields.word("at", &["rest", "table"]);
    let every = fields.value("every", Quantity::Time, Range::Positive);
    let rows = fields.inside("rows", read_rows);
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
                fields.problems().push(
                    node.place.error(message, "write the value in quotes, as in the scenario"),
                );
            }
        }
    }
    choices
}

/// A list of texts, or one text, from the `allowed` words, if any.
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
            fields.refuse(item.place.error(
                format!("this is not a value of `{key}`"),
                format!("expected a list {choice}"),
            ))
        }
    };
    items.iter().filter_map(word).collect()
}

/// A number, or a text with the unit of a quantity of a probe.
fn reading(node: &Node, problems: &Problems) -> Option<f64> {
    let quantities = [Quantity::Length, Quantity::Force, Quantity::Speed, Quantity::Time];
    let known = |text: &str| {
        quantities.into_iter().find(|quantity| crate::units::parse(text, *quantity).is_ok())
    };
    let quantity = match &node.content {
        Content::Text(text) => known(text).unwrap_or(Quantity::Force),
        _ => Quantity::Ratio,
    };
    read_value(node, quantity, Range::Any, problems).map(|value| value.value)
}

/// The haul of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseHaul {
    /// Speed of the hauler; `None` for the default [m/s].
    pub speed_m_s: Option<f64>,
    /// Height of the block over the sea surface; `None` for the default [m].
    pub block_m: Option<f64>,
    /// Number of traps aboard at the end; `None` for all.
    pub aboard: Option<u64>,
}

/// Reads `[haul]`.
fn read_haul(fields: &Fields<'_>) -> CaseHaul {
    let value = |key, quantity, range| fields.value(key, quantity, range).map(|value| value.value);
    CaseHaul {
        speed_m_s: value("speed", Quantity::Speed, Range::Between(0.01, 5.0)),
        block_m: value("height", Quantity::Length, Range::Between(0.0, 20.0)),
        aboard: fields.count("aboard", &limits::TRAPS).map(|count| count.value),
    }
}

/// The rows of a table, the fields that each sets, and the compared values.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Column of the group of a row, such as a set of gear.
    pub by: At<String>,
    /// The groups, in order.
    pub groups: Vec<String>,
    /// Column and least value that select rows.
    pub least: Option<(At<String>, f64)>,
    /// Id of the probe.
    pub read: At<String>,
    /// Start of the average of a run [s]; `None` for the gear at rest.
    pub mean_from_s: Option<f64>,
    /// Column of the measurements [SI].
    pub measured: At<String>,
    /// Fields that override the scenario, with `{column}`, `{-column}` or `{column/column}` for numbers of the row.
    pub set: Vec<(At<String>, String)>,
}

/// Reads `[rows]`; `None` if a required field is missing, which is reported.
fn read_rows(fields: &Fields<'_>) -> Option<Rows> {
    let by = fields.need_text("by", "write the column of the set of gear");
    let groups = groups(fields);
    let least_of = fields.text("least_of");
    let least = fields.value("least", Quantity::Ratio, Range::Any);
    let read = fields.need_text("read", "write the id of a probe");
    let mean_from = fields.value("mean_from", Quantity::Time, Range::NotNegative);
    let measured = fields.need_text("measured", "write the column of the measurements");
    let set = choices(fields, "set");
    let least = least_of.zip(least.map(|least| least.value));
    let mean_from_s = mean_from.map(|from| from.value);
    Some(Rows {
        by: by?,
        groups: groups?,
        least,
        read: read?,
        mean_from_s,
        measured: measured?,
        set,
    })
}

/// Numbers or texts.
fn groups(fields: &Fields<'_>) -> Option<Vec<String>> {
    let Some(node) = fields.get("groups") else {
        fields.missing("groups", "write the values of the column `by`, such as [16, 18]");
        return None;
    };
    let Content::List(items) = &node.content else {
        return fields.refuse(node.place.error("`groups` is not a list", "write [16, 18]"));
    };
    let text = |content: &Content| match content {
        Content::Number(number) => Some(number.to_string()),
        Content::Text(text) => Some(text.clone()),
        _ => None,
    };
    items.iter().map(|item| text(&item.content)).collect()
}

impl Rows {
    /// The rows of a table that belong to a group.
    pub fn of_group(&self, table: &Table, group: &str) -> Result<Vec<usize>, Box<Diagnostic>> {
        let mut rows = Vec::new();
        for row in 0..table.len() {
            let high = match &self.least {
                Some((column, least)) => table.number(row, &column.value)? >= *least,
                None => true,
            };
            if high && table.text(row, &self.by.value)? == group {
                rows.push(row);
            }
        }
        Ok(rows)
    }

    /// The fields of a row, with its numbers inserted.
    pub fn fields(
        &self,
        table: &Table,
        row: usize,
    ) -> Result<Vec<(String, String)>, Box<Diagnostic>> {
        self.set
            .iter()
            .map(|(field, text)| Ok((field.value.clone(), filled(text, table, row)?)))
            .collect()
    }
}

/// A text with `{column}`, `{-column}` and `{column/column}` replaced by a row's numbers.
fn filled(text: &str, table: &Table, row: usize) -> Result<String, Box<Diagnostic>> {
    let mut whole = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (inside, behind) = after.split_once('}').unwrap_or((after, ""));
        whole += before;
        let (sign, name) = inside.strip_prefix('-').map_or((1.0, inside), |name| (-1.0, name));
        let number = match name.split_once('/') {
            Some((above, below)) => table.number(row, above)? / table.number(row, below)?,
            None => table.number(row, name)?,
        };
        whole += &(sign * number).to_string();
        rest = behind;
    }
    Ok(whole + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rows_numbers_fill_a_text() {
        let table = Table::read("t.csv", "mass,length\n3,60\n").unwrap();
        assert_eq!(filled("{mass} kg", &table, 0).unwrap(), "3 kg");
        assert_eq!(filled("{-length} m", &table, 0).unwrap(), "-60 m");
        assert_eq!(filled("{mass/length} kg/m", &table, 0).unwrap(), "0.05 kg/m");
        assert!(filled("{width} m", &table, 0).is_err());
    }
}
