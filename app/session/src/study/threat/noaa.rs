//! The threat model of NOAA's decision support tool since V2.1: threat by breaking strength, and strengths of lines by traps of a trawl.
//!
//! The tool multiplies lines by the threat of their strength, and compares sums. Its threat is a logistic curve fitted to the strengths of
//! ropes taken off right whales. The columns `Threat_Lower` and `Threat_Upper` are two more curves, which the tool runs as models of their
//! own; at most strengths the curve named `Threat_Lower` is the greater one (see the notes of the file). The bounds here are therefore the
//! least and the greatest of the three curves.
//! Source: function_DecisionSupportTool_V3.1.0.R and its inputs, github.com/ALoMiller/DecisionSupportToolApp (2021).

use std::path::Path;

use endline_gear::Diagnostic;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Error;

use super::interpolation::{Strengths, combined};
use super::reading::TableFile;

/// Columns of a table of threat by strength, in the tool's order.
pub(super) const THREAT_COLUMNS: [&str; 4] =
    ["RopeStrength", "Threat", "Threat_Lower", "Threat_Upper"];

/// Columns of a table of strengths by traps, in the tool's order.
const STRENGTH_COLUMNS: [&str; 3] = ["GearPerString_Applied", "RopeStrength", "Prop_Strength"];

/// Greatest deviation from 1 of the sum of the shares of a trawl; the source rounds them to 1e-6.
const ROUNDING: f64 = 0.01;

/// A threat with its bounds.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct ThreatRange {
    /// The threat, 0 to 1; for a relative threat, its share of that at the reference.
    pub threat: f64,
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

impl ThreatRange {
    /// Whether two ranges have a value in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.lower <= other.upper && other.lower <= self.upper
    }

    /// Of the values of the tool's three curves, the threat first.
    pub(super) fn of_curves(curves: [f64; 3]) -> Self {
        let [lower, upper] = [f64::min, f64::max].map(|of| curves.into_iter().fold(curves[0], of));
        Self { threat: curves[0], lower, upper }
    }
}

#[derive(Deserialize)]
struct ThreatRow {
    #[serde(rename = "RopeStrength")]
    strength_lbf: f64,
    #[serde(rename = "Threat")]
    threat: f64,
    #[serde(rename = "Threat_Lower")]
    lower: f64,
    #[serde(rename = "Threat_Upper")]
    upper: f64,
}

/// NOAA's threat by breaking strength.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthThreatTable {
    strengths: Strengths,
    /// Values of `Threat`, `Threat_Lower` and `Threat_Upper` at each strength.
    curves: Vec<[f64; 3]>,
}

impl StrengthThreatTable {
    /// Its file in the gear library.
    pub const FILE: &str = "cases/tables/noaa-dst-threat-by-strength.csv";

    /// Reads the table of a gear library; `None` if it has none.
    /// Errors: as [`read`](Self::read), and a file that cannot be read.
    pub fn of_library(root: &Path) -> Result<Option<Self>, Error> {
        let file = root.join(Self::FILE);
        if !file.is_file() {
            return Ok(None);
        }
        let text = endline_gear::read::text(&file).map_err(Error::on(&file, "cannot be read"))?;
        Ok(Some(Self::read(&file.display().to_string(), &text)?))
    }

    /// Reads a table with the columns `RopeStrength` [lbf], `Threat`, `Threat_Lower` and `Threat_Upper`; lines that begin with `#` are notes.
    /// Errors: every row that cannot be read or has a value out of its range, at its line; a missing column; strengths that do not ascend.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let help = "write breaking strength in lbf, threat and its two bounds from 0 to 1, in ascending order of strength, such as 1700,0.070,0.370,0.017";
        let file = TableFile { name, text, columns: &THREAT_COLUMNS, help };
        let rows: Vec<(usize, ThreatRow)> = file.rows()?;
        let mut problems = Vec::new();
        let mut before_lbf = 0.0;
        for (byte, row) in &rows {
            let strength_lbf = row.strength_lbf;
            if !(strength_lbf > before_lbf && strength_lbf.is_finite()) {
                let message = format!("{strength_lbf} is not above {before_lbf}");
                problems.push(file.error(*byte, THREAT_COLUMNS[0], message));
            }
            before_lbf = strength_lbf;
            for (column, value) in
                THREAT_COLUMNS[1..].iter().zip([row.threat, row.lower, row.upper])
            {
                problems.extend(outside_zero_to_one(&file, *byte, column, value));
            }
        }
        let strengths = Strengths::new(rows.iter().map(|(_, row)| row.strength_lbf).collect());
        let curves = rows.iter().map(|(_, row)| [row.threat, row.lower, row.upper]).collect();
        match strengths {
            Some(strengths) if problems.is_empty() => Ok(Self { strengths, curves }),
            _ => Err(problems),
        }
    }

    /// Its strengths [lbf], ascending.
    pub fn strengths_lbf(&self) -> &[f64] {
        self.strengths.all()
    }

    /// Whether a strength [lbf] lies within the table.
    pub fn contains(&self, strength_lbf: f64) -> bool {
        self.strengths.contains(strength_lbf)
    }

    /// The threat at a strength [lbf], with its bounds.
    pub fn range(&self, strength_lbf: f64) -> ThreatRange {
        ThreatRange::of_curves(self.at(strength_lbf))
    }

    /// Values of `Threat`, `Threat_Lower` and `Threat_Upper` at a strength [lbf]; linear between rows, constant outside the table.
    pub(super) fn at(&self, strength_lbf: f64) -> [f64; 3] {
        self.combined(&self.strengths.coefficients(strength_lbf))
    }

    /// Means of the three columns over the lines of a trawl. With a cap [lbf], each stronger line has the strength of the cap.
    pub(super) fn of_lines(&self, lines: &[LineShare], cap_lbf: Option<f64>) -> [f64; 3] {
        self.combined(&self.strengths.of_lines(lines, cap_lbf))
    }

    fn combined(&self, coefficients: &[f64]) -> [f64; 3] {
        [0, 1, 2].map(|curve| combined(coefficients, self.curves.iter().map(|row| row[curve])))
    }
}

#[derive(Deserialize)]
struct StrengthRow {
    #[serde(rename = "GearPerString_Applied")]
    traps: u64,
    #[serde(rename = "RopeStrength")]
    strength_lbf: f64,
    #[serde(rename = "Prop_Strength")]
    share: f64,
}

/// The share of lines with a breaking strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineShare {
    /// Breaking strength [lbf].
    pub strength_lbf: f64,
    /// Share of the lines, 0 to 1.
    pub share: f64,
}

/// The lines of trawls with a number of traps.
#[derive(Clone, Debug, PartialEq)]
pub struct TrawlLines {
    /// Traps of the trawl.
    pub traps: u64,
    /// Its lines by breaking strength; the shares sum to 1 but for rounding.
    pub lines: Vec<LineShare>,
}

/// NOAA's distribution of the breaking strengths of lines, by traps of the trawl.
#[derive(Clone, Debug, PartialEq)]
pub struct LineStrengthTable {
    /// By number of traps, ascending.
    pub trawls: Vec<TrawlLines>,
}

impl LineStrengthTable {
    /// Reads a table with the columns `GearPerString_Applied` (traps), `RopeStrength` [lbf] and `Prop_Strength` (share); lines that begin
    /// with `#` are notes.
    /// Errors: every row that cannot be read or has a value out of its range, at its line; a missing column; a strength that is listed
    /// twice for a trawl; shares of a trawl that do not sum to 1, at its first row.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let help = "write traps, breaking strength in lbf and the share of lines from 0 to 1, such as 10,1700,0.061; the shares of a number of traps sum to 1";
        let file = TableFile { name, text, columns: &STRENGTH_COLUMNS, help };
        let mut rows: Vec<(usize, StrengthRow)> = file.rows()?;
        let mut problems = Vec::new();
        for (byte, row) in &rows {
            if row.traps == 0 {
                problems.push(file.error(*byte, STRENGTH_COLUMNS[0], "0 is not above 0"));
            }
            if !(row.strength_lbf > 0.0 && row.strength_lbf.is_finite()) {
                let message = format!("{} is not above 0", row.strength_lbf);
                problems.push(file.error(*byte, STRENGTH_COLUMNS[1], message));
            }
            problems.extend(outside_zero_to_one(&file, *byte, STRENGTH_COLUMNS[2], row.share));
        }
        // A stable sort keeps the first row of a trawl in front of a second one of the same strength.
        rows.sort_by(|(_, one), (_, other)| {
            one.traps.cmp(&other.traps).then(one.strength_lbf.total_cmp(&other.strength_lbf))
        });
        let mut trawls = Vec::new();
        for rows in rows.chunk_by(|(_, one), (_, other)| one.traps == other.traps) {
            problems.extend(faults_of_trawl(&file, rows));
            let lines = rows
                .iter()
                .map(|(_, row)| LineShare { strength_lbf: row.strength_lbf, share: row.share });
            trawls.push(TrawlLines { traps: rows[0].1.traps, lines: lines.collect() });
        }
        if problems.is_empty() { Ok(Self { trawls }) } else { Err(problems) }
    }
}

/// Faults of the rows of one trawl, by strength: a strength listed twice, shares that do not sum to 1.
fn faults_of_trawl(file: &TableFile<'_>, rows: &[(usize, StrengthRow)]) -> Vec<Diagnostic> {
    let twice = rows
        .windows(2)
        .filter(|pair| pair[0].1.strength_lbf.total_cmp(&pair[1].1.strength_lbf).is_eq());
    let mut faults: Vec<Diagnostic> = twice
        .map(|pair| {
            let (byte, row) = &pair[1];
            let message = format!("{} is listed twice for {} traps", row.strength_lbf, row.traps);
            file.error(*byte, STRENGTH_COLUMNS[1], message)
        })
        .collect();
    let sum: f64 = rows.iter().map(|(_, row)| row.share).sum();
    if (sum - 1.0).abs() > ROUNDING {
        let first = rows.iter().map(|(byte, _)| *byte).min().unwrap_or_default();
        let message = format!("the shares of {} traps sum to {sum:.3}, not to 1", rows[0].1.traps);
        faults.push(file.error(first, STRENGTH_COLUMNS[2], message));
    }
    faults
}

impl TrawlLines {
    /// Mean breaking strength [lbf].
    pub fn mean_strength_lbf(&self) -> f64 {
        let all: f64 = self.lines.iter().map(|line| line.share).sum();
        self.lines.iter().map(|line| line.strength_lbf * line.share / all).sum()
    }

    /// Share of the lines whose strength [lbf] meets a condition.
    pub fn share_of(&self, meets: impl Fn(f64) -> bool) -> f64 {
        let all: f64 = self.lines.iter().map(|line| line.share).sum();
        let found = self.lines.iter().filter(|line| meets(line.strength_lbf));
        // The sum of an empty list of floats is -0.
        found.fold(0.0, |sum, line| sum + line.share / all)
    }
}

fn outside_zero_to_one(
    file: &TableFile<'_>,
    byte: usize,
    column: &str,
    value: f64,
) -> Option<Diagnostic> {
    let is_inside = (0.0..=1.0).contains(&value);
    (!is_inside).then(|| file.error(byte, column, format!("{value} is not from 0 to 1")))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The table of the gear library with a name.
    fn bundled(name: &str) -> String {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../gear-library/cases/tables/");
        std::fs::read_to_string(format!("{folder}{name}")).unwrap()
    }

    pub(crate) fn threats() -> StrengthThreatTable {
        StrengthThreatTable::read("t.csv", &bundled("noaa-dst-threat-by-strength.csv")).unwrap()
    }

    pub(crate) fn lines() -> LineStrengthTable {
        LineStrengthTable::read("l.csv", &bundled("noaa-dst-strength-by-traps.csv")).unwrap()
    }

    fn places(problems: &[Diagnostic]) -> Vec<(usize, &str)> {
        problems.iter().map(|problem| (problem.line, problem.field.as_str())).collect()
    }

    #[test]
    fn faults_of_a_threat_stand_at_their_lines_with_the_column() {
        let head = "# note\nRopeStrength,Threat,Threat_Lower,Threat_Upper\n";
        let read = |rows: &str| StrengthThreatTable::read("t.csv", &format!("{head}{rows}"));
        let problems = read("500,0.04,much,0.01\n600,0.05,0.3,0.01\n700,0.06\n").unwrap_err();
        assert_eq!(places(&problems), [(3, "Threat_Lower"), (5, "")], "{problems:?}");
        assert!(problems[0].message.contains("no row of a threat table: column `Threat_Lower`"));
        let problems = read("500,0.04,0.3,0.01\n500,1.05,0.3,0.01\n").unwrap_err();
        assert_eq!(places(&problems), [(4, "RopeStrength"), (4, "Threat")], "{problems:?}");
        assert!(problems[0].help.contains("ascending order of strength"), "{problems:?}");
        let problems = StrengthThreatTable::read("t.csv", "RopeStrength,Threat\n").unwrap_err();
        assert!(problems[0].message.contains("no column `Threat_Lower`"), "{problems:?}");
        assert!(read("").unwrap_err()[0].message.contains("no row"));
    }

    #[test]
    fn faults_of_a_distribution_stand_at_their_lines_with_the_column() {
        let head = "GearPerString_Applied,RopeStrength,Prop_Strength\n";
        let read = |rows: &str| LineStrengthTable::read("l.csv", &format!("{head}{rows}"));
        let problems = read("1,700,0.5\n1,700,0.5\n0,700,1\n2,800,0.9\n3,-5,1\n").unwrap_err();
        let mut found = places(&problems);
        found.sort_unstable();
        let expected = [
            (3, "RopeStrength"),
            (4, "GearPerString_Applied"),
            (5, "Prop_Strength"),
            (6, "RopeStrength"),
        ];
        assert_eq!(found, expected, "{problems:?}");
        let sum = problems.iter().find(|problem| problem.line == 5).unwrap();
        assert!(sum.message.contains("the shares of 2 traps sum to 0.900"), "{sum:?}");
        assert_eq!(places(&read("1.5,700,1\n").unwrap_err()), [(2, "GearPerString_Applied")]);
    }

    /// The curve is logit P = -3.5385 + 0.00056036 S/lbf, which its source does not state, to the digits of the file.
    #[test]
    fn the_bundled_threat_is_a_logistic_curve_of_strength() {
        let table = threats();
        assert_eq!(table.strengths_lbf().len(), 106);
        for strength_lbf in table.strengths_lbf() {
            let expected = 1.0 / (1.0 + (3.538_45 - 5.603_61e-4 * strength_lbf).exp());
            let [threat, ..] = table.at(*strength_lbf);
            assert!((threat - expected).abs() < 1e-4, "{strength_lbf}: {threat}, {expected}");
        }
        // The curve that the source names lower is the greater one below 6,400 lbf, and the lesser one above.
        let range = ThreatRange::of_curves(table.at(1700.0));
        assert_eq!(range, ThreatRange { threat: 0.07006, lower: 0.01670, upper: 0.37044 });
        let [_, named_lower, named_upper] = table.at(6400.0);
        assert!(named_lower < named_upper);
    }

    /// Means by traps: 1,939 lbf for a single and 5,418 lbf for 45 traps.
    #[test]
    fn the_bundled_lines_of_every_trawl_sum_to_one() {
        let table = lines();
        assert_eq!(table.trawls.len(), 80);
        for trawl in &table.trawls {
            let sum: f64 = trawl.lines.iter().map(|line| line.share).sum();
            assert!((sum - 1.0).abs() < 1e-5, "{} traps: {sum}", trawl.traps);
        }
        for (traps, mean_lbf) in [(1, 1939.4), (45, 5417.5)] {
            let trawl = table.trawls.iter().find(|trawl| trawl.traps == traps).unwrap();
            assert!((trawl.mean_strength_lbf() - mean_lbf).abs() < 0.1, "{traps}");
        }
    }
}
