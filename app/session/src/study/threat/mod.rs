//! The threat table of a study: how often an event comes by rope, length of trawl and device, in the columns of NOAA's decision
//! support tool (`Rope, RopeDiam, TrawlLen, BuoylineDevice, Risk`).
//!
//! A risk is the rate of the event given an encounter. The tool multiplies endlines by risks and compares sums, so that a
//! factor common to all rows has no effect. There are two bands: that of chance (the number of encounters), and that of the priors
//! (the rate at the levels of each assumed input). Held against the tool's own table, which asks experts, by Kendall's τ
//! (`kendall.rs`). Rows of that table that were not simulated lie between those that were (`filled.rs`).

mod filled;
mod kendall;
mod poll;

use endline_gear::{StudyEvent, ThreatRow};
use schemars::JsonSchema;
use serde::Serialize;

use super::prepared::PreparedStudy;
use super::stats::{AssumedBand, EventIndicators, Interval, Rate};
use crate::study::runs::Runs;
use crate::units::METRES_PER_INCH;

pub use filled::{Filled, How, as_own, with_bands};
pub use kendall::Tau;
pub(crate) use poll::at_line;
pub use poll::{Poll, Polled};

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

/// The threat table of a study.
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
    /// Agreement with a poll, if there is one with two rows in common.
    pub tau: Option<Tau>,
}

impl Threats {
    /// The threats of a merged study by an event, beside a poll.
    /// Errors: a study without an option that names a row, or with two options that name the same row.
    pub fn of(
        opened: &PreparedStudy,
        runs: &Runs,
        event: &StudyEvent,
        poll: Option<&Poll>,
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
        let tau = poll.and_then(|poll| kendall::against(poll, &rows));
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
