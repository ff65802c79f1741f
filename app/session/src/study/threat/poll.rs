//! A threat table of the decision support tool, as its file has it.

use std::sync::Arc;

use endline_gear::{Diagnostic, Place, SourceText};
use serde::Deserialize;

/// The columns, in the tool's order.
pub(super) const COLUMNS: [&str; 5] = ["Rope", "RopeDiam", "TrawlLen", "BuoylineDevice", "Risk"];

/// A row.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Polled {
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
    /// The risk, 0 to 1.
    #[serde(rename = "Risk")]
    pub risk: f64,
}

/// A threat table.
#[derive(Clone, Debug, PartialEq)]
pub struct Poll {
    /// Its rows, in the file's order.
    pub rows: Vec<Polled>,
}

impl Poll {
    /// Reads a table; lines that begin with `#` are notes.
    /// Errors: every row that is none, at its line; a table without a column.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let help = "write rope, diameter in inches, traps, device and risk, such as 3/8in,0.375,12,NA,0.71";
        let failed = |error: &csv::Error| at_line(name, text, error, help);
        let headers = reader.headers().map_err(|error| vec![failed(&error)])?;
        let missing = COLUMNS.iter().find(|column| !headers.iter().any(|name| name == **column));
        if let Some(column) = missing {
            let help = "the columns are Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk";
            let message = format!("the table has no column `{column}`");
            return Err(vec![place(name, text, 0).error(message, help)]);
        }
        let (mut rows, mut problems) = (Vec::new(), Vec::new());
        for row in reader.deserialize::<Polled>() {
            match row {
                Ok(row) => rows.push(row),
                Err(error) => problems.push(failed(&error)),
            }
        }
        if problems.is_empty() { Ok(Self { rows }) } else { Err(problems) }
    }

    /// The row of a rope, device and length of trawl.
    pub(super) fn find(&self, key: (&str, &str, u64)) -> Option<&Polled> {
        self.rows.iter().find(|row| row.key() == key)
    }
}

/// The error of a row of a threat table, at its line.
pub(crate) fn at_line(name: &str, text: &str, error: &csv::Error, help: &str) -> Diagnostic {
    let byte = error.position().map_or(0, csv::Position::byte);
    let byte = usize::try_from(byte).unwrap_or_default().min(text.len());
    // A row begins after the notes and line ends before it.
    let rest = text.get(byte..).unwrap_or_default();
    let lines = rest.split_inclusive('\n');
    let is_no_row = |line: &&str| line.starts_with('#') || line.trim().is_empty();
    let before: usize = lines.take_while(is_no_row).map(str::len).sum();
    let message = format!("is no row of a threat table: {error}");
    place(name, text, byte + before).error(message, help)
}

fn place(name: &str, text: &str, byte: usize) -> Place {
    let source = Arc::new(SourceText { path: name.to_owned(), text: text.to_owned() });
    Place { source, span: byte..byte, field: String::new() }
}

impl Polled {
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
        let problems = Poll::read("poll.csv", text).unwrap_err();
        let lines: Vec<usize> = problems.iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [4, 5], "{problems:?}");
        let text = "Rope,RopeDiam,TrawlLen,Risk\n";
        let problems = Poll::read("poll.csv", text).unwrap_err();
        assert!(problems[0].message.contains("no column `BuoylineDevice`"), "{problems:?}");
    }
}
