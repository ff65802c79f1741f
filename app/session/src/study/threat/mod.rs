//! Threat tables of a study, in the two forms of NOAA's decision support tool.
//!
//! | form | columns | from options with | source |
//! |---|---|---|---|
//! | of 2019, by rope, length of trawl and device | `Rope, RopeDiam, TrawlLen, BuoylineDevice, Risk` | `threat = { ... }` | a poll of experts (`experts.rs`) |
//! | since V2.1, by breaking strength | `RopeStrength, Threat, Threat_Lower, Threat_Upper` | `strength` on a `curve` | a logistic curve fitted to ropes taken off right whales (`noaa.rs`) |
//!
//! A risk or threat is the rate of the event given an encounter. The tool multiplies endlines by risks and compares sums, so that a
//! factor common to all rows has no effect. There are two bands: that of chance (the number of encounters), and that of the priors
//! (the rate at the levels of each assumed input). This file has the table of 2019; `kendall.rs` compares it with the experts' by Kendall's
//! τ, and `filled.rs` interpolates rows that were not simulated. `by_strength.rs` has the table by strength beside NOAA's, and `trawls.rs`
//! averages both over the lines of trawls.

mod by_strength;
mod experts;
mod filled;
mod interpolation;
mod kendall;
mod noaa;
mod reading;
mod trawls;
mod written;

use endline_gear::{StudyEvent, ThreatRow};
use schemars::JsonSchema;
use serde::Serialize;

use super::prepared::PreparedStudy;
use super::stats::{AssumedBand, EventIndicators, Interval, Rate};
use crate::study::runs::Runs;
use crate::units::METRES_PER_INCH;

pub use by_strength::{
    NoaaModel, OptionThreat, Origin, RelativeThreat, STRENGTH_SCHEMA, StrengthThreat,
    StrengthThreats, curves,
};
pub use experts::{ExpertRow, ExpertTable};
pub use filled::{Filled, How, as_own, with_bands};
pub use kendall::Tau;
pub use noaa::{LineShare, LineStrengthTable, StrengthThreatTable, ThreatRange, TrawlLines};
pub(crate) use reading::at_line;
pub use trawls::{CappedTrawl, TrawlThreat};

/// Name and version of the JSON form.
pub(super) const SCHEMA: &str = "endline.threat/1";

/// A row of the table.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Threat {
    /// Id of the option that was simulated.
    pub option: String,
    /// Rope by the tool's name.
    pub rope: String,
    /// Its diameter [in].
    pub diameter_in: f64,
    /// Traps of the trawl.
    pub traps: u64,
    /// Device in the endline.
    pub device: String,
    /// Rate of the event, with its band of chance.
    pub rate: Rate,
    /// Least and greatest rate at the levels of the assumed inputs, where these vary.
    pub priors: Option<AssumedBand>,
}

/// The threat table of a study in the form of 2019.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Threats {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the study.
    pub study: String,
    /// Hash of what defines its runs.
    pub hash: String,
    /// Name of the event.
    pub event: String,
    /// By rope, device and traps.
    pub rows: Vec<Threat>,
    /// Agreement with the experts' table of 2019, if two rows are in common.
    pub tau: Option<Tau>,
}

impl Threats {
    /// The threats of a merged study by an event, beside the experts' table.
    /// Errors: a study without an option that names a row, or with two options that name the same row.
    pub fn of(
        opened: &PreparedStudy,
        runs: &Runs,
        event: &StudyEvent,
        experts: Option<&ExpertTable>,
    ) -> Result<Self, String> {
        let mut rows: Vec<(Threat, EventIndicators)> = Vec::new();
        for option in &opened.study.options {
            let Some(row) = option.threat.row() else { continue };
            let indicators = EventIndicators::of(runs, &option.id.value, event);
            rows.push((threat(opened, runs, &option.id.value, row, &indicators), indicators));
        }
        if rows.is_empty() {
            return Err(format!(
                "{}: no option names a row of a threat table; write threat = {{ rope = \"3/8in\", diameter = \"3/8 in\", traps = 12, device = \"NA\" }} in options, or parts of it in values of axes",
                opened.study.id
            ));
        }
        rows.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let same = |pair: &&[(Threat, EventIndicators)]| pair[0].0.key() == pair[1].0.key();
        if let Some([(one, _), (other, _)]) = rows.windows(2).find(same) {
            return Err(format!(
                "{}: options `{}` and `{}` name the same row of the threat table",
                opened.study.id, one.option, other.option
            ));
        }
        let tau = experts.and_then(|experts| kendall::against(experts, &rows));
        Ok(Self {
            schema: SCHEMA,
            study: opened.study.id.clone(),
            hash: opened.hash.clone(),
            event: event.name(),
            rows: rows.into_iter().map(|(row, _)| row).collect(),
            tau,
        })
    }
}

fn threat(
    opened: &PreparedStudy,
    runs: &Runs,
    id: &str,
    row: ThreatRow,
    indicators: &EventIndicators,
) -> Threat {
    Threat {
        option: id.to_owned(),
        rope: row.rope,
        diameter_in: row.diameter_m / METRES_PER_INCH,
        traps: row.traps,
        device: row.device,
        rate: Rate::of(indicators),
        priors: AssumedBand::of_study(opened, runs, indicators),
    }
}

impl Threat {
    /// Its key: rope, device, traps.
    fn key(&self) -> (&str, &str, u64) {
        (&self.rope, &self.device, self.traps)
    }

    /// The order of rows: by device, diameter, rope and traps.
    fn total_cmp(&self, other: &Self) -> std::cmp::Ordering {
        let by_diameter = self.diameter_in.total_cmp(&other.diameter_in);
        let by_rope = (&self.rope, self.traps).cmp(&(&other.rope, other.traps));
        self.device.cmp(&other.device).then(by_diameter).then(by_rope)
    }

    /// Least and greatest rate at the levels of the assumed inputs; the rate itself where none varies.
    pub fn by_priors(&self) -> Interval {
        let rate = self.rate.rate;
        self.priors.as_ref().map_or(Interval { low: rate, high: rate }, AssumedBand::rates)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A row with a rate from counts.
    pub(crate) fn row(rope: &str, diameter_in: f64, traps: u64, device: &str, hits: u64) -> Threat {
        Threat {
            option: format!("{rope}-{traps}-{device}"),
            rope: rope.to_owned(),
            diameter_in,
            traps,
            device: device.to_owned(),
            rate: Rate::from_counts(hits, 100),
            priors: None,
        }
    }
}
