//! Statistics of a study: rates with intervals, options compared on the same encounters, claims, sensitivity.
//!
//! A rate is relative, given an encounter, under the study's distribution of encounters. Invalid runs are counted, shown
//! and left out; a comparison leaves out an encounter in which either run is invalid. Every interval is of 95 %.
//! Encounters count by their weights, which importance sampling gives them; without it all count alike.
//! Encounters are taken as independent; those of a Sobol sequence fill their space more evenly, so that intervals err on the wide side.

mod answer;
mod bands;
pub(super) mod bootstrap;
mod changes;
mod claims;
mod exposure;
mod findings;
mod held_whales;
mod indicators;
mod interval;
mod observations;
mod paired;
mod sensitivity;
mod sobol;
mod strength_curve;
mod survival;
mod tensions;
mod verdict;
mod weighted;

#[cfg(test)]
mod coverage;

pub use answer::{answer, observed, resolution};
pub use bands::{AssumedBand, Bands, SegmentBand};
pub use changes::{Change, Changes};
pub use claims::{ClaimFinding, Verdict};
pub use exposure::{ExposureFinding, TrackRate, figure, words as track_words};
pub use findings::{Findings, LevelFinding, OptionFinding, ResolutionChecks};
pub use held_whales::{HeldWhales, OptionOnHeld, Route, RouteFinding, Weighted};
pub use indicators::{EventIndicator, EventIndicators, effective_with};
pub(super) use interval::z95;
pub use interval::{Interval, Rate};
pub use observations::{Agreement, ObservationFinding};
pub use paired::Paired;
pub use sensitivity::{InputFinding, Lowest, Part};
pub use sobol::SobolIndex;
pub use strength_curve::{AskedStrength, Banded, HeldKind, StrengthCurve};
pub use survival::{HeldShare, Survival};
pub use tensions::Tensions;
pub use verdict::{
    WORTH_FINDING, encounters_missing, encounters_to_tell, expected_newly, rounded, whales_for_band,
};

use endline_gear::StudyEvent;

use super::plan::OptionPlan;
use crate::study::runs::Runs;

/// Whether the interval of an event's rate is narrower than `width` in every option.
pub fn is_narrow(runs: &Runs, options: &[OptionPlan], event: &StudyEvent, width: f64) -> bool {
    options.iter().all(|option| {
        let rate = Rate::of(&EventIndicators::of(runs, &option.id, event));
        rate.runs > 0 && rate.interval.high - rate.interval.low < width
    })
}
