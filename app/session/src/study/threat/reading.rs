//! Tables of the decision support tool read from CSV, with each fault at its line; the table of 2019, a poll of experts by rope, length of
//! trawl and device.

use std::sync::Arc;

use endline_gear::{Diagnostic, Place, SourceText};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A CSV file that is read: its name as shown in messages, its text, and how a row is written.
pub(super) struct TableFile<'a> {
    /// Name of the file.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
    /// Columns that it must have.
    pub columns: &'a [&'a str],
    /// The remedy for a row that cannot be read, such as an example of a row.
    pub help: &'a str,
}

impl TableFile<'_> {
    /// Reads all rows, each with the offset of its first byte; lines that begin with `#` are notes.
    /// Errors: every row that cannot be read, at its line; a missing column; a table without a row.
    pub fn rows<R: DeserializeOwned>(&self) -> Result<Vec<(usize, R)>, Vec<Diagnostic>> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(self.text.as_bytes());
        let failed = |error: &csv::Error| at_line(self.name, self.text, error, self.help);
        let headers = reader.headers().map_err(|error| vec![failed(&error)])?.clone();
        let missing =
            self.columns.iter().find(|column| !headers.iter().any(|name| name == **column));
        if let Some(column) = missing {
            let help = format!("the columns are {}", self.columns.join(","));
            let message = format!("the table has no column `{column}`");
            return Err(vec![place(self.name, self.text, 0, "").error(message, help)]);
        }
        let (mut rows, mut problems) = (Vec::new(), Vec::new());
        for record in reader.records() {
            let read = record.and_then(|record| {
                let byte = record.position().map_or(0, csv::Position::byte);
                Ok((byte, record.deserialize::<R>(Some(&headers))?))
            });
            match read {
                Ok((byte, row)) => rows.push((begin_of_row(self.text, byte), row)),
                Err(error) => problems.push(failed(&error)),
            }
        }
        if rows.is_empty() && problems.is_empty() {
            problems
                .push(place(self.name, self.text, 0, "").error("the table has no row", self.help));
        }
        if problems.is_empty() { Ok(rows) } else { Err(problems) }
    }

    /// An error about a column of the row that begins at a byte.
    pub fn error(&self, byte: usize, column: &str, message: impl Into<String>) -> Diagnostic {
        let message = format!("is no row of a threat table: column `{column}`: {}", message.into());
        place(self.name, self.text, byte, column).error(message, self.help)
    }
}

/// The error of a row of a threat table, at its line, with the column if it is known.
pub(crate) fn at_line(name: &str, text: &str, error: &csv::Error, help: &str) -> Diagnostic {
    let byte = begin_of_row(text, error.position().map_or(0, csv::Position::byte));
    let (column, cause) = match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => {
            let field = err.field().and_then(|field| usize::try_from(field).ok());
            (field.and_then(|field| column(text, field)), err.kind().to_string())
        }
        _ => (None, error.to_string()),
    };
    let of_column = column.as_ref().map_or_else(String::new, |name| format!("column `{name}`: "));
    let message = format!("is no row of a threat table: {of_column}{cause}");
    place(name, text, byte, &column.unwrap_or_default()).error(message, help)
}

/// Offset of a row, given that of the notes and line ends before it.
fn begin_of_row(text: &str, byte: u64) -> usize {
    let byte = usize::try_from(byte).unwrap_or_default().min(text.len());
    let rest = text.get(byte..).unwrap_or_default();
    let is_no_row = |line: &&str| line.starts_with('#') || line.trim().is_empty();
    byte + rest.split_inclusive('\n').take_while(is_no_row).map(str::len).sum::<usize>()
}

/// The name of a column, from 0.
fn column(text: &str, index: usize) -> Option<String> {
    let names = text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty())?;
    Some(names.split(',').nth(index)?.trim().trim_matches('"').to_owned())
}

fn place(name: &str, text: &str, byte: usize, field: &str) -> Place {
    let source = Arc::new(SourceText { path: name.to_owned(), text: text.to_owned() });
    Place { source, span: byte..byte, field: field.to_owned() }
}

/// The columns, in the tool's order.
pub(super) const COLUMNS: [&str; 5] = ["Rope", "RopeDiam", "TrawlLen", "BuoylineDevice", "Risk"];

/// A row of the table of 2019.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct ExpertRow {
    /// Rope, such as `3/8in` or `1,700`.
    #[serde(rename = "Rope")]
    pub rope: String,
    /// Its diameter [in].
    #[serde(rename = "RopeDiam")]
    pub diameter_in: f64,
    /// Traps of the trawl.
    #[serde(rename = "TrawlLen")]
    pub traps: u64,
    /// Device in the endline, or `NA`.
    #[serde(rename = "BuoylineDevice")]
    pub device: String,
    /// The risk in the experts' opinion, 0 to 1.
    #[serde(rename = "Risk")]
    pub risk: f64,
}

/// The experts' table of 2019, or another in its columns.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpertTable {
    /// Its rows, in the file's order.
    pub rows: Vec<ExpertRow>,
}

impl ExpertTable {
    /// Reads a table; lines that begin with `#` are notes.
    /// Errors: every row that cannot be read, at its line; a missing column.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let help = "write rope, diameter in inches, traps, device and risk, such as 3/8in,0.375,12,NA,0.71";
        let rows = TableFile { name, text, columns: &COLUMNS, help }.rows()?;
        Ok(Self { rows: rows.into_iter().map(|(_, row)| row).collect() })
    }

    /// The row of a rope, device and length of trawl.
    pub(super) fn find(&self, key: (&str, &str, u64)) -> Option<&ExpertRow> {
        self.rows.iter().find(|row| row.key() == key)
    }
}

impl ExpertRow {
    /// Its key: rope, device, traps.
    pub(super) fn key(&self) -> (&str, &str, u64) {
        (&self.rope, &self.device, self.traps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_stand_at_their_lines_all_at_once() {
        let text = "# a note\nRope,RopeDiam,TrawlLen,BuoylineDevice,Risk\n\"1,700\",0.25,3,NA,0.48\n3/8in,thick,3,NA,0.6\n3/8in,0.375,7.5,NA,0.6\n";
        let problems = ExpertTable::read("poll.csv", text).unwrap_err();
        let places: Vec<(usize, &str)> =
            problems.iter().map(|problem| (problem.line, problem.field.as_str())).collect();
        assert_eq!(places, [(4, "RopeDiam"), (5, "TrawlLen")], "{problems:?}");
        let text = "Rope,RopeDiam,TrawlLen,Risk\n";
        let problems = ExpertTable::read("poll.csv", text).unwrap_err();
        assert!(problems[0].message.contains("no column `BuoylineDevice`"), "{problems:?}");
    }
}
