//! Tables of the decision support tool read from CSV, with each fault at its line.

use std::sync::Arc;

use endline_gear::{Diagnostic, Place, SourceText};
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
