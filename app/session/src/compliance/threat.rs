//! The row of a threat table that stands for a gear: nearest in diameter of its endline, then in traps, with its device.

use serde::Deserialize;

use crate::error::Error;
use crate::rules::RuleGear;
use crate::study::threat::at_line;
use crate::units::{METRES_PER_INCH, N_PER_LBF};

/// Device in an endline with weak links between its ends, and without, as the table names them.
const DEVICES: [&str; 2] = ["SSS_Regular", "NA"];

/// The name of rope of at most 1,700 lbf in the table, and that strength [N].
const WEAK: (&str, f64) = ("1,700", 1700.0 * N_PER_LBF);

/// What rounding may add to a strength [N].
const ROUNDING_N: f64 = 1e-6;

/// A row of a threat table with bands.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Row {
    #[serde(rename = "Rope")]
    pub rope: String,
    #[serde(rename = "RopeDiam")]
    diameter_in: f64,
    #[serde(rename = "TrawlLen")]
    pub traps: u64,
    #[serde(rename = "BuoylineDevice")]
    pub device: String,
    #[serde(rename = "Risk")]
    pub risk: f64,
    #[serde(rename = "Risk_lo")]
    pub low: f64,
    #[serde(rename = "Risk_hi")]
    pub high: f64,
    #[serde(rename = "Risk_priors_lo")]
    pub priors_low: f64,
    #[serde(rename = "Risk_priors_hi")]
    pub priors_high: f64,
    #[serde(rename = "Risk_n")]
    pub runs: u64,
    pub how: String,
}

/// What a table says of a gear.
pub(super) struct ThreatOfGear {
    /// The table's file.
    pub file: String,
    /// The row taken for the gear.
    pub row: Row,
    /// The greatest risk of the table, for comparison.
    pub greatest: f64,
}

impl ThreatOfGear {
    /// The row for a gear.
    ///
    /// # Errors
    /// A table that is none, at its line; gear without an endline; a table without the gear's device.
    pub fn find(file: &str, text: &str, gear: &RuleGear) -> Result<Self, Error> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let rows: Result<Vec<Row>, csv::Error> = reader.deserialize().collect();
        let help = "give the file with bands that `endline study threat STUDY --to FILE.csv` writes: FILE-bands.csv";
        let rows =
            rows.map_err(|error| Error::from(Box::new(at_line(file, text, &error, help))))?;
        let failed = |message: String| Error::Message(format!("{file}: {message}"));
        let endline = gear
            .endline()
            .ok_or_else(|| failed(format!("{} has no endline to look up", gear.assembly)))?;
        let device = DEVICES[usize::from(!endline.has_sleeves)];
        let is_weak = endline.rated_n <= WEAK.1 + ROUNDING_N && !endline.has_sleeves;
        let diameter_in = endline.diameter_m / METRES_PER_INCH;
        let apart = |row: &Row| {
            let rope = if (row.rope == WEAK.0) == is_weak { 0.0 } else { 1.0 };
            let traps = (row.traps as f64 - gear.traps() as f64).abs();
            [rope, (row.diameter_in - diameter_in).abs(), traps]
        };
        let greatest = rows.iter().map(|row| row.risk).fold(0.0, f64::max);
        let row = rows
            .into_iter()
            .filter(|row| row.device == device)
            .min_by(|one, other| {
                let pairs = apart(one).into_iter().zip(apart(other));
                pairs
                    .map(|(a, b)| a.total_cmp(&b))
                    .find(|order| order.is_ne())
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .ok_or_else(|| failed(format!("has no row of device {device}")))?;
        Ok(Self { file: file.to_owned(), row, greatest })
    }
}
