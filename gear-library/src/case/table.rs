//! A table of a case: reference readings or measurements, as comma-separated values with a heading row.
//!
//! Lines that begin with `#` are remarks, such as the source.

use crate::diagnostic::{Diagnostic, hint};

/// A table as read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    name: String,
    heading: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a table's text; `name` is its path as shown in messages.
    pub fn read(name: &str, text: &str) -> Result<Self, Box<Diagnostic>> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let wrong = |error: &csv::Error| {
            let help = "expected a heading row and rows with as many cells, separated by commas; remarks begin with #";
            Box::new(Diagnostic::of_file(name, error.to_string(), help))
        };
        let cells =
            |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let heading = cells(reader.headers().map_err(|error| wrong(&error))?);
        let rows: Result<Vec<_>, _> =
            reader.records().map(|record| record.map(|record| cells(&record))).collect();
        Ok(Self { name: name.to_owned(), heading, rows: rows.map_err(|error| wrong(&error))? })
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// A cell's text.
    pub fn text(&self, row: usize, column: &str) -> Result<&str, Box<Diagnostic>> {
        let Some(index) = self.heading.iter().position(|name| name == column) else {
            let help = hint(column, self.heading.iter().map(String::as_str));
            return Err(Box::new(Diagnostic::of_file(
                &self.name,
                format!("there is no column `{column}`"),
                help,
            )));
        };
        let cell = self.rows.get(row).and_then(|cells| cells.get(index)).map(String::as_str);
        cell.ok_or_else(|| {
            Box::new(Diagnostic::of_file(
                &self.name,
                format!("there is no row {}", row + 1),
                "the table is shorter",
            ))
        })
    }

    /// A cell's number.
    pub fn number(&self, row: usize, column: &str) -> Result<f64, Box<Diagnostic>> {
        let text = self.text(row, column)?;
        let number = text.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| {
            let message = format!("row {}: `{text}` in column `{column}` is not a number", row + 1);
            Box::new(Diagnostic::of_file(
                &self.name,
                message,
                "expected a finite decimal number in SI",
            ))
        })
    }

    /// A column's numbers.
    pub fn column(&self, column: &str) -> Result<Vec<f64>, Box<Diagnostic>> {
        (0..self.len()).map(|row| self.number(row, column)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# from the book of tables, p. 1\nt, end x\n1, 2.5\n2, four\n";

    #[test]
    fn remarks_and_blanks_are_skipped() {
        let table = Table::read("a.csv", TEXT).unwrap();
        assert_eq!(table.len(), 2);
        assert_eq!(table.number(0, "end x"), Ok(2.5));
        assert_eq!(table.column("t"), Ok(vec![1.0, 2.0]));
    }

    #[test]
    fn problems_name_row_and_column() {
        let table = Table::read("a.csv", TEXT).unwrap();
        let message = table.column("end x").unwrap_err().to_string();
        assert!(
            message.contains("a.csv") && message.contains("row 2") && message.contains("`four`"),
            "{message}"
        );
        assert!(table.column("end y").unwrap_err().help.contains("end x"));
        assert!(
            Table::read("a.csv", "a,b\n1\n").unwrap_err().message.contains("line"),
            "a short row"
        );
    }
}
