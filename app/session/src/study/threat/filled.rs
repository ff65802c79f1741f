//! The rows of the experts' table of 2019 with simulated risks.
//!
//! A simulated row has its rate. Rates and bands are interpolated linearly between two lengths of trawl, then between two diameters;
//! beyond the longest and the shortest simulated trawl they are constant. A row with a thicker or thinner rope, or another device, is
//! omitted.

use serde::Serialize;

use super::experts::{COLUMNS, ExpertRow, ExpertTable};
use super::{Threat, Threats};

/// Columns of the table with bands.
const WITH_BANDS: [&str; 6] =
    ["Risk_lo", "Risk_hi", "Risk_priors_lo", "Risk_priors_hi", "Risk_n", "how"];

/// The origin of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum How {
    /// Its own encounters were simulated.
    Simulated,
    /// Interpolated between simulated rows.
    Between,
    /// That of the nearest trawl; its own is longer or shorter than any simulated one.
    Held,
}

/// A row of the table of 2019 with a simulated risk.
#[derive(Clone, Debug, PartialEq)]
pub struct Filled<'a> {
    /// The row of the table of 2019.
    pub row: &'a ExpertRow,
    /// Its origin.
    pub how: How,
    risk: Risk,
}

/// A rate with its bands.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Risk {
    rate: f64,
    /// Band of chance: least, greatest.
    chance: [f64; 2],
    /// Band of priors: least, greatest.
    priors: [f64; 2],
    /// Number of runs.
    runs: u64,
}

impl Risk {
    fn of(threat: &Threat) -> Self {
        let (chance, priors) = (threat.rate.interval, threat.by_priors());
        Self {
            rate: threat.rate.rate,
            chance: [chance.low, chance.high],
            priors: [priors.low, priors.high],
            runs: threat.rate.runs,
        }
    }

    /// A share of the way to another.
    fn to(self, other: Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + share * (b - a);
        let both = |a: [f64; 2], b: [f64; 2]| [between(a[0], b[0]), between(a[1], b[1])];
        Self {
            rate: between(self.rate, other.rate),
            chance: both(self.chance, other.chance),
            priors: both(self.priors, other.priors),
            runs: self.runs.min(other.runs),
        }
    }
}

impl Threats {
    /// The rows of the experts' table for which the study has a risk, in that table's order.
    pub fn fill<'a>(&self, experts: &'a ExpertTable) -> Vec<Filled<'a>> {
        let filled = |row: &'a ExpertRow| {
            let (risk, how) = self.risk_of(row)?;
            Some(Filled { row, how, risk })
        };
        experts.rows.iter().filter_map(filled).collect()
    }

    fn risk_of(&self, row: &ExpertRow) -> Option<(Risk, How)> {
        let on_rope = |keeps: &dyn Fn(&Threat) -> bool| {
            let own: Vec<&Threat> = self
                .rows
                .iter()
                .filter(|threat| threat.device == row.device && keeps(threat))
                .collect();
            by_traps(&own, row.traps)
        };
        if let Some(found) = on_rope(&|threat| threat.rope == row.rope) {
            return Some(found);
        }
        let diameters = self.rows.iter().filter(|threat| threat.device == row.device);
        let diameters: Vec<f64> = diameters.map(|threat| threat.diameter_in).collect();
        let thinner = diameters.iter().copied().filter(|at| *at < row.diameter_in);
        let thicker = diameters.iter().copied().filter(|at| *at > row.diameter_in);
        let (low, high) = (thinner.reduce(f64::max)?, thicker.reduce(f64::min)?);
        let at = |diameter: f64| {
            on_rope(&|threat| (threat.diameter_in - diameter).abs() < 1e-9 * diameter)
        };
        let ((one, by), (other, other_by)) = (at(low)?, at(high)?);
        let share = (row.diameter_in - low) / (high - low);
        Some((one.to(other, share), by.max(other_by).max(How::Between)))
    }
}

/// The risk of a number of traps by rows of one rope and device, in the order of their traps.
fn by_traps(rows: &[&Threat], traps: u64) -> Option<(Risk, How)> {
    if let Some(own) = rows.iter().find(|row| row.traps == traps) {
        return Some((Risk::of(own), How::Simulated));
    }
    let shorter = rows.iter().rfind(|row| row.traps < traps);
    let longer = rows.iter().find(|row| row.traps > traps);
    match (shorter, longer) {
        (Some(one), Some(other)) => {
            let share = (traps - one.traps) as f64 / (other.traps - one.traps) as f64;
            Some((Risk::of(one).to(Risk::of(other), share), How::Between))
        }
        (Some(end), None) | (None, Some(end)) => Some((Risk::of(end), How::Held)),
        (None, None) => None,
    }
}

/// Rows as a file that the tool of 2019 reads in place of its own.
/// Errors: where the table cannot be written.
pub fn as_own(rows: &[Filled<'_>]) -> Result<Vec<u8>, String> {
    written(&COLUMNS, rows.iter().map(columns))
}

/// Rows with their bands and origins.
/// Errors: where the table cannot be written.
pub fn with_bands(rows: &[Filled<'_>]) -> Result<Vec<u8>, String> {
    let names: Vec<&str> = COLUMNS.iter().chain(&WITH_BANDS).copied().collect();
    let row = |filled: &Filled<'_>| {
        let Risk { chance, priors, runs, .. } = filled.risk;
        let bands: Vec<String> = chance.into_iter().chain(priors).map(number).collect();
        (columns(filled), bands, runs, filled.how)
    };
    written(&names, rows.iter().map(row))
}

fn columns(filled: &Filled<'_>) -> Vec<String> {
    let ExpertRow { rope, diameter_in, traps, device, .. } = filled.row;
    vec![
        rope.clone(),
        diameter_in.to_string(),
        traps.to_string(),
        device.clone(),
        number(filled.risk.rate),
    ]
}

pub(super) fn number(value: f64) -> String {
    format!("{value:.6}")
}

/// A CSV table with a heading.
pub(super) fn written<R: Serialize>(
    names: &[&str],
    rows: impl Iterator<Item = R>,
) -> Result<Vec<u8>, String> {
    let fault = |error: csv::Error| format!("the threat table: {error}");
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    writer.write_record(names).map_err(fault)?;
    for row in rows {
        writer.serialize(row).map_err(fault)?;
    }
    writer.into_inner().map_err(|error| format!("the threat table: {error}"))
}

#[cfg(test)]
mod tests {
    use super::super::tests::row;
    use super::*;

    fn threats() -> Threats {
        let mut rows = vec![
            row("3/8in", 0.375, 3, "NA", 10),
            row("3/8in", 0.375, 12, "NA", 28),
            row("1/2in", 0.5, 3, "NA", 30),
            row("1/2in", 0.5, 12, "NA", 48),
        ];
        rows.sort_by(|one, other| one.total_cmp(other));
        Threats {
            schema: super::super::SCHEMA,
            study: "s".into(),
            hash: "h".into(),
            event: "held_fast".into(),
            rows,
            tau: None,
        }
    }

    const POLL: &str = "Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk\n3/8in,0.375,3,NA,0.6\n3/8in,0.375,7,NA,0.6\n3/8in,0.375,50,NA,0.6\n\
        7/16in,0.4375,12,NA,0.6\n7/16in,0.4375,7,NA,0.6\n5/8in,0.625,12,NA,0.6\n\"1,700\",0.25,12,NA,0.6\n3/8in,0.375,3,SSS,0.6\n";

    /// Rates by hand: 0.10 + 4/9 of 0.18, the mean of 0.28 and 0.48, and that of 0.18 and 0.38.
    #[test]
    fn rows_between_are_linear_and_what_was_not_simulated_is_left_out() {
        let poll = ExpertTable::read("poll.csv", POLL).unwrap();
        let threats = threats();
        let filled = threats.fill(&poll);
        let expected = [
            (How::Simulated, 0.10),
            (How::Between, 0.18),
            (How::Held, 0.28),
            (How::Between, 0.38),
            (How::Between, 0.28),
        ];
        assert_eq!(filled.len(), expected.len());
        for (row, (how, rate)) in filled.iter().zip(expected) {
            assert_eq!(row.how, how, "{row:?}");
            assert!((row.risk.rate - rate).abs() < 1e-12, "{row:?}");
            assert!(row.risk.chance[0] < rate && rate < row.risk.chance[1], "{row:?}");
        }
    }

    #[test]
    fn the_file_reads_as_the_tools_own_and_the_bands_stand_beside() {
        let poll = ExpertTable::read("poll.csv", POLL).unwrap();
        let threats = threats();
        let filled = threats.fill(&poll);
        let own = String::from_utf8(as_own(&filled).unwrap()).unwrap();
        let read = ExpertTable::read("own.csv", &own).unwrap();
        assert_eq!(read.rows.len(), filled.len());
        assert!(
            (read.rows[1].risk - 0.18).abs() < 1e-6 && read.rows[1].key() == ("3/8in", "NA", 7)
        );
        let bands = String::from_utf8(with_bands(&filled).unwrap()).unwrap();
        let first = bands.lines().nth(1).unwrap();
        // Wilson's interval of 10 in 100.
        assert_eq!(
            first,
            "3/8in,0.375,3,NA,0.100000,0.055229,0.174366,0.100000,0.100000,100,simulated"
        );
    }
}
