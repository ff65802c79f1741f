//! The table of instruction counts and the page of its history.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::Outcome;
use crate::workspace::Workspace;

/// The table: a line for each time that it was written.
const TABLE: &str = "gear-library/benches/instructions.csv";
/// The page of its history.
const PAGE: &str = "docs/speed.md";
/// The part of the page that is written from the table begins here.
const MARK: &str = "<!-- written by `cargo xtask instructions --write` -->";

/// Counts of all sections at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub date: String,
    /// Name and version of the compiler.
    pub compiler: String,
    /// Why the counts changed.
    pub reason: String,
    /// Instructions of a simulated second, by section.
    pub counts: Vec<(String, f64)>,
}

/// All rows, the oldest first.
pub struct Table {
    rows: Vec<Row>,
}

impl Table {
    /// Reads the table of the repository; a missing file is an empty table.
    /// Errors: when the file has a line that cannot be read.
    pub fn read(workspace: &Workspace) -> Outcome<Self> {
        let path = workspace.root.join(TABLE);
        match std::fs::read_to_string(&path) {
            Ok(text) => Self::parse(&text),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                Ok(Self { rows: Vec::new() })
            }
            Err(error) => Err(format!("cannot read {}: {error}", path.display())),
        }
    }

    /// Each line: date, compiler, reason, section, millions of instructions of a simulated second.
    fn parse(text: &str) -> Outcome<Self> {
        let mut rows: Vec<Row> = Vec::new();
        for (number, line) in text.lines().enumerate().skip(1) {
            let fields: Vec<&str> = line.split(',').collect();
            let [date, compiler, reason, section, millions] = fields[..] else {
                return Err(format!("{TABLE}:{}: expected five fields", number + 1));
            };
            let count = millions.parse::<f64>().map_err(|error| {
                format!("{TABLE}:{}: millions: {millions:?}: {error}", number + 1)
            })?;
            let count = (section.to_owned(), 1e6 * count);
            match rows.last_mut() {
                Some(row) if row.date == date && row.reason == reason => row.counts.push(count),
                _ => rows.push(Row {
                    date: date.to_owned(),
                    compiler: compiler.to_owned(),
                    reason: reason.to_owned(),
                    counts: vec![count],
                }),
            }
        }
        Ok(Self { rows })
    }

    /// The row that counts are compared with.
    pub fn last(&self) -> Option<&Row> {
        self.rows.last()
    }

    /// Adds a row; commas of its reason would end a field.
    pub fn add(&mut self, mut row: Row) {
        row.reason = row.reason.replace([',', '\n'], ";");
        self.rows.push(row);
    }

    /// The last count of a section.
    fn count(&self, section: &str) -> Option<f64> {
        let counts = &self.last()?.counts;
        counts.iter().find(|(name, _)| name == section).map(|(_, count)| *count)
    }

    /// What is wrong with the counts of a row: a section that is more expensive or cheaper than the tolerance allows, or new.
    pub fn complaints(&self, row: &Row, tolerance: f64) -> Vec<String> {
        let missing = self
            .last()
            .into_iter()
            .flat_map(|last| &last.counts)
            .filter(|(section, _)| row.counts.iter().all(|(other, _)| other != section));
        let missing =
            missing.map(|(section, _)| format!("{section}: in the table, but not counted"));
        let changed = row.counts.iter().filter_map(|(section, count)| {
            let Some(before) = self.count(section) else {
                return Some(format!("{section}: has no count in {TABLE}"));
            };
            let change = count / before - 1.0;
            let percent = 100.0 * change.abs();
            match change {
                _ if change > tolerance => {
                    Some(format!("{section}: {percent:.1} % more instructions than in {TABLE}"))
                }
                _ if change < -tolerance => Some(format!(
                    "{section}: {percent:.1} % fewer instructions than in {TABLE}; write the table, so that this gain lasts"
                )),
                _ => None,
            }
        });
        missing.chain(changed).collect()
    }

    /// The counts of a row beside the last of the table, for a terminal.
    pub fn comparison(&self, row: &Row) -> String {
        let mut text = "million instructions of a simulated second, without copies\n".to_owned();
        text += "section            table        now   change\n";
        for (section, count) in &row.counts {
            let before = self.count(section);
            let (table, change) = before.map_or(("-".to_owned(), "-".to_owned()), |before| {
                (millions(before), format!("{:+.2} %", 100.0 * (count / before - 1.0)))
            });
            let _ =
                writeln!(text, "{section:<14} {table:>9}  {:>9}  {change:>7}", millions(*count));
        }
        text
    }

    /// Writes the table and its page.
    /// Errors: when a file cannot be written, or the page has no mark.
    pub fn write(&self, workspace: &Workspace) -> Outcome {
        let mut text = "date,compiler,reason,section,millions\n".to_owned();
        for row in &self.rows {
            for (section, count) in &row.counts {
                let Row { date, compiler, reason, .. } = row;
                let _ = writeln!(text, "{date},{compiler},{reason},{section},{}", millions(*count));
            }
        }
        put(workspace.root.join(TABLE), &text)?;
        let path = workspace.root.join(PAGE);
        let page = std::fs::read_to_string(&path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let (head, _) = page.split_once(MARK).ok_or(format!("{PAGE} has no line {MARK}"))?;
        put(path, &format!("{head}{MARK}\n\n{}", self.history()))
    }

    /// The history as Markdown: a column for each row, the oldest first, with the change since the first.
    fn history(&self) -> String {
        let (Some(first), Some(last)) = (self.rows.first(), self.last()) else {
            return String::new();
        };
        let numbers: Vec<String> = (1..=self.rows.len()).map(|number| number.to_string()).collect();
        let mut text = format!("| section | {} | last / first |\n", numbers.join(" | "));
        let _ = writeln!(text, "|---|{}---|", "---|".repeat(self.rows.len()));
        for (section, now) in &last.counts {
            let count = |row: &Row| {
                row.counts.iter().find(|(name, _)| name == section).map(|(_, count)| *count)
            };
            let cells: Vec<String> =
                self.rows.iter().map(|row| count(row).map(millions).unwrap_or_default()).collect();
            let share = count(first).map(|then| format!("{:.2}", now / then)).unwrap_or_default();
            let _ = writeln!(text, "| {section} | {} | {share} |", cells.join(" | "));
        }
        text += "\n| row | date | compiler | reason |\n|---|---|---|---|\n";
        for (number, Row { date, compiler, reason, .. }) in numbers.iter().zip(&self.rows) {
            let _ = writeln!(text, "| {number} | {date} | {compiler} | {reason} |");
        }
        text
    }
}

/// A count in millions, with digits enough to compare it within a small part of the tolerance.
fn millions(count: f64) -> String {
    let decimals = if count < 1e7 { 3 } else { 1 };
    format!("{:.decimals$}", 1e-6 * count)
}

fn put(path: PathBuf, text: &str) -> Outcome {
    std::fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::{Row, Table};

    const TEXT: &str = "date,compiler,reason,section,millions\n2026-01-01,rustc 1,first,far,50.0\n2026-01-01,rustc 1,first,fine,600.0\n\
                        2026-01-02,rustc 1,second,far,40.0\n2026-01-02,rustc 1,second,fine,500.0\n";

    fn row(counts: &[(&str, f64)]) -> Row {
        Row {
            date: "2026-01-03".to_owned(),
            compiler: "rustc 1".to_owned(),
            reason: "third".to_owned(),
            counts: counts.iter().map(|(name, count)| ((*name).to_owned(), 1e6 * count)).collect(),
        }
    }

    #[test]
    fn counts_are_compared_with_the_last_row() {
        let table = Table::parse(TEXT).unwrap();
        assert_eq!(table.complaints(&row(&[("far", 40.7), ("fine", 491.0)]), 0.02), [""; 0]);
        let complaints = table.complaints(&row(&[("far", 40.9), ("fine", 489.0)]), 0.02);
        assert!(complaints[0].starts_with("far: 2.2 % more"), "{complaints:?}");
        assert!(complaints[1].starts_with("fine: 2.2 % fewer"), "{complaints:?}");
        let complaints = table.complaints(&row(&[("far", 40.0), ("new", 1.0)]), 0.02);
        assert_eq!(complaints.len(), 2, "{complaints:?}");
    }

    #[test]
    fn the_page_has_a_column_for_each_row() {
        let mut table = Table::parse(TEXT).unwrap();
        table.add(row(&[("far", 20.0), ("fine", 1.3343)]));
        let page = table.history();
        assert!(page.contains("| far | 50.0 | 40.0 | 20.0 | 0.40 |"), "{page}");
        assert!(page.contains("| fine | 600.0 | 500.0 | 1.334 |"), "{page}");
        assert!(page.contains("| 3 | 2026-01-03 | rustc 1 | third |"), "{page}");
    }

    #[test]
    fn a_line_with_a_wrong_field_is_an_error() {
        let error = Table::parse("head\n2026-01-01,rustc 1,first,far,many\n").err().unwrap();
        assert!(error.contains("instructions.csv:2: millions: \"many\""), "{error}");
    }
}
