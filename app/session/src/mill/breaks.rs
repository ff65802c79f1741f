//! Breaks from a table.

use std::sync::Arc;

use endline_gear::units::{self, Quantity};
use endline_gear::{Diagnostic, Place, SourceText};

/// Column of the table that is read.
const COLUMN: &str = "break";

/// Reads the column `break` of a CSV table, a force with its unit in each row [N]; other columns are the mill's own.
///
/// # Errors
/// Every row that holds no force above zero, at its place; a table without the column.
pub fn read_breaks(name: &str, text: &str) -> Result<Vec<f64>, Vec<Diagnostic>> {
    let source = Arc::new(SourceText { path: name.to_owned(), text: text.to_owned() });
    let whole = Place { source: Arc::clone(&source), span: 0..0, field: COLUMN.to_owned() };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let failed = |error: csv::Error| {
        let at = error.position().map_or(0, csv::Position::byte);
        let at = usize::try_from(at).unwrap_or_default();
        let place = Place { span: at..at, ..whole.clone() };
        place.error(format!("is no row of the table: {error}"), "write as many values as columns")
    };
    let column = reader.headers().map_err(|error| vec![failed(error)])?.iter().position(is_column);
    let Some(column) = column else {
        let help = "write `break` above the column, and forces below, such as \"1,650 lbf\"";
        return Err(vec![whole.error("the table has no column `break`", help)]);
    };
    let (mut breaks, mut problems) = (Vec::new(), Vec::new());
    for row in reader.records() {
        match row.map(|row| force(&row, column, &whole)) {
            Ok(Ok(newtons)) => breaks.push(newtons),
            Ok(Err(problem)) => problems.push(*problem),
            Err(error) => problems.push(failed(error)),
        }
    }
    if problems.is_empty() { Ok(breaks) } else { Err(problems) }
}

fn is_column(name: &str) -> bool {
    name == COLUMN
}

/// The force of a row [N].
fn force(row: &csv::StringRecord, column: usize, whole: &Place) -> Result<f64, Box<Diagnostic>> {
    let text = row.get(column).unwrap_or_default();
    let at = row.position().map_or(0, csv::Position::byte);
    let at = usize::try_from(at).unwrap_or_default();
    let rest = whole.source.text.get(at..).unwrap_or_default();
    let line = rest.trim_start_matches(['\r', '\n']);
    let start = at + (rest.len() - line.len()) + line.find(text).unwrap_or_default();
    let place = Place { span: start..start + text.len(), ..whole.clone() };
    match units::parse(text, Quantity::Force) {
        Ok(newtons) if newtons > 0.0 => Ok(newtons),
        Ok(_) => {
            Err(Box::new(place.error(format!("`{text}` is no break"), "a rope breaks above zero")))
        }
        Err(error) => Err(Box::new(place.error(error.message, error.help))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_are_read_with_their_units_and_mistakes_stand_at_their_rows() {
        let table = "sample,break\n1,\"1,650 lbf\"\n2,7.5 kN\n";
        let breaks = read_breaks("mill.csv", table).unwrap();
        assert!((breaks[0] - 1650.0 * 4.448_221_615_260_5).abs() < 1e-6 && breaks.len() == 2);
        assert!((breaks[1] - 7500.0).abs() < 1e-9);
        let wrong = "sample,break\n1,1650\n2,\"1,700 lb\"\n3,0 N\n4\n5,1700 lbf\n";
        let problems = read_breaks("mill.csv", wrong).unwrap_err();
        let places: Vec<(usize, usize)> =
            problems.iter().map(|problem| (problem.line, problem.column)).collect();
        assert_eq!(places, [(2, 3), (3, 4), (4, 3), (5, 1)], "{problems:?}");
        assert!(problems[0].message.contains("has no unit"), "{problems:?}");
        assert!(problems[1].message.contains("unit of a mass"), "{problems:?}");
        let none = read_breaks("mill.csv", "a,b\n1,2\n").unwrap_err();
        assert!(none[0].message.contains("no column `break`") && none[0].line == 1);
    }
}
