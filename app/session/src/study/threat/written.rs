//! Threats by breaking strength as CSV files.

use super::by_strength::{Origin, StrengthThreat, StrengthThreats};
use super::filled::{number, written};
use super::noaa::THREAT_COLUMNS;

/// Columns beside those of the tool in the table with bands.
const BANDS: [&str; 4] = ["Threat_priors_lo", "Threat_priors_hi", "Threat_n", "how"];

impl StrengthThreats {
    /// The table in the columns of the tool: strength [lbf], rate, ends of its interval; `Threat_Lower` is the lesser one.
    /// Errors: if the table cannot be written.
    pub fn as_own(&self) -> Result<Vec<u8>, String> {
        written(&THREAT_COLUMNS, self.strengths.iter().map(columns))
    }

    /// The table with the band of the assumed inputs, the number of runs, and whether a row is `simulated` or `interpolated`.
    /// Errors: if the table cannot be written.
    pub fn with_bands(&self) -> Result<Vec<u8>, String> {
        let names: Vec<&str> = THREAT_COLUMNS.iter().chain(&BANDS).copied().collect();
        let row = |row: &StrengthThreat| {
            let priors = [number(row.priors.low), number(row.priors.high)];
            (columns(row), priors, row.runs, row.origin)
        };
        written(&names, self.strengths.iter().map(row))
    }

    /// Number of rows with a simulated strength.
    pub fn simulated(&self) -> usize {
        self.strengths.iter().filter(|row| row.origin == Origin::Simulated).count()
    }
}

fn columns(row: &StrengthThreat) -> Vec<String> {
    let simulated = row.simulated;
    let threats = [simulated.threat, simulated.lower, simulated.upper].map(number);
    std::iter::once(row.strength_lbf.to_string()).chain(threats).collect()
}

#[cfg(test)]
mod tests {
    use super::super::by_strength::tests::curve;
    use super::super::noaa::StrengthThreatTable;
    use super::super::noaa::tests::threats;
    use super::*;

    #[test]
    fn the_file_reads_as_the_tools_own_and_the_bands_mark_interpolated_rows() {
        let (reference_lbf, strengths) =
            curve(&[(1000.0, 10), (1200.0, 30)], 100).beside(&threats()).unwrap();
        let threats = StrengthThreats {
            schema: super::super::STRENGTH_SCHEMA,
            study: "s".into(),
            hash: "h".into(),
            event: "held_fast".into(),
            curve: None,
            options: Vec::new(),
            unbreakable: None,
            reference_lbf,
            strengths,
            omitted_lbf: Vec::new(),
            cap_lbf: None,
            trawls: Vec::new(),
        };
        let own = String::from_utf8(threats.as_own().unwrap()).unwrap();
        // Wilson's intervals of 10 and 30 in 100, and the means of their ends.
        let rows = [
            "RopeStrength,Threat,Threat_Lower,Threat_Upper",
            "1000,0.100000,0.055229,0.174366",
            "1100,0.200000,0.137150,0.285429",
            "1200,0.300000,0.218949,0.395849",
        ];
        let found: Vec<&str> = own.lines().collect();
        assert_eq!(found[..2], rows[..2]);
        assert_eq!(found.len(), rows.len());
        let read = StrengthThreatTable::read("own.csv", &own).unwrap();
        assert!((read.at(1100.0)[0] - 0.2).abs() < 1e-9);
        let bands = String::from_utf8(threats.with_bands().unwrap()).unwrap();
        let ends: Vec<&str> = bands.lines().filter_map(|line| line.rsplit(',').next()).collect();
        assert_eq!(ends, ["how", "simulated", "interpolated", "simulated"]);
        assert!(bands.contains("1000,0.100000,0.055229,0.174366,0.100000,0.100000,100,simulated"));
        assert_eq!(threats.simulated(), 2);
    }
}
