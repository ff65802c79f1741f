//! The threat table of NOAA's decision support tool of 2019: a poll of experts by rope, length of trawl and device.

use endline_gear::Diagnostic;
use serde::Deserialize;

use super::reading::TableFile;

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
