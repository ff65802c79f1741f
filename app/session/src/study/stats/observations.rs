//! Observations: a study's share held against what was seen on real whales.
//!
//! The simulated share is that of the encounters with the event among those that it is asked about, with Wilson's interval; or
//! `1 - ratio` of two options, on the same encounters or among those that each option has to ask about. It *agrees* where it
//! lies within what was observed, from [`LEAST`] encounters on; it *misses* where its whole interval lies outside; else the study
//! does not settle it. Of encounters of unlike weight, fewer events than that settle nothing. What the gear or the question decides
//! beforehand tests nothing: it neither agrees nor misses.

use endline_gear::ObservedShare;
use schemars::JsonSchema;
use serde::Serialize;

use crate::study::runs::Runs;

use super::indicators::EventIndicators;
use super::interval::{Interval, Rate, z95};
use super::paired::Paired;

/// Encounters asked about below which nothing agrees.
const LEAST: u64 = 10;

/// Whether a simulated share agrees with what was observed.
#[derive(Clone, Copy, Debug, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// It lies within.
    Agrees,
    /// Its whole interval lies outside.
    Misses,
    /// Neither.
    Open,
    /// The gear or the question decides it beforehand.
    ByConstruction,
}

impl Agreement {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Misses => "misses",
            Self::Open => "not settled",
            Self::ByConstruction => "by construction",
        }
    }
}

/// An observation and what the study has beside it.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct ObservationFinding {
    /// Id.
    pub id: String,
    /// The statement.
    pub says: String,
    /// Its source.
    pub source: String,
    /// The event counted, among which encounters, with which gear.
    pub counted: String,
    /// The observed share.
    pub observed: Interval,
    /// Encounters with the event and in all that it was asked about; of the option that has fewer.
    pub hits: u64,
    /// Encounters in question.
    pub runs: u64,
    /// The simulated share; none where nothing was asked about.
    pub simulated: Option<f64>,
    /// Its interval.
    pub interval: Interval,
    /// Whether it agrees; by construction it neither agrees nor misses.
    pub agreement: Agreement,
    /// Why the gear or the question decides the result beforehand; `None` for a real comparison.
    pub by_construction: Option<String>,
    /// Whether it was in the study's file, with what it expects, before the first run.
    pub registered: bool,
    /// Omissions of the comparison, or the presumed reason for a miss.
    pub notes: String,
}

/// Compares an observation with the runs of a study.
pub(super) fn compare(
    observation: &ObservedShare,
    runs: &Runs,
    baseline: &str,
) -> ObservationFinding {
    let option = observation.option.as_deref().unwrap_or(baseline);
    let own = indicators(observation, runs, option);
    let share = |own: &EventIndicators| match observation.among {
        Some(_) => Rate::among(own),
        None => Rate::of(own),
    };
    let rate = share(&own);
    let (rate, simulated, interval) = match &observation.fewer_with {
        None => (rate, (rate.runs > 0).then_some(rate.rate), rate.interval),
        Some(fewer) if observation.among.is_some() => {
            fewer_apart(rate, share(&indicators(observation, runs, fewer)))
        }
        Some(fewer) => fewer_by(&own, &indicators(observation, runs, fewer)),
    };
    let times = |value: f64| observation.times * value;
    let simulated = simulated.map(times);
    let interval = Interval { low: times(interval.low), high: times(interval.high) };
    let [low, high] = observation.observed;
    let observed = Interval { low, high };
    ObservationFinding {
        id: observation.id.value.clone(),
        says: observation.says.clone(),
        source: observation.source.clone(),
        counted: counted(observation, option),
        observed,
        hits: rate.hits,
        runs: rate.runs,
        simulated,
        interval,
        agreement: if observation.by_construction.is_some() {
            Agreement::ByConstruction
        } else if is_thin(&rate) {
            Agreement::Open
        } else {
            agreement(observed, simulated, interval, rate.runs)
        },
        by_construction: observation.by_construction.clone(),
        registered: true,
        notes: observation.notes.clone(),
    }
}

/// Whether a share rests on so few events of unlike weight that its interval may be too narrow: it knows the weights of the
/// events that were met alone, and one may also come among encounters of greater weight.
fn is_thin(rate: &Rate) -> bool {
    let weighted = (rate.effective - rate.runs as f64).abs() > 0.5;
    weighted && (1..LEAST).contains(&rate.hits)
}

/// The event's indicators in an option, of the encounters that are asked about.
fn indicators(observation: &ObservedShare, runs: &Runs, option: &str) -> EventIndicators {
    let own = EventIndicators::of(runs, option, &observation.of);
    match &observation.among {
        None => own,
        Some(among) => own.within(&EventIndicators::of(runs, option, among).occurred()),
    }
}

/// By what share an event is rarer with one option than with another.
fn fewer_by(own: &EventIndicators, fewer: &EventIndicators) -> (Rate, Option<f64>, Interval) {
    let paired = Paired::of(fewer, own);
    let interval =
        paired.ratio_interval.map_or(Interval { low: f64::NEG_INFINITY, high: 1.0 }, |ratio| {
            Interval { low: 1.0 - ratio.high, high: 1.0 - ratio.low }
        });
    (Rate::of(fewer), paired.ratio.map(|ratio| 1.0 - ratio), interval)
}

/// Reduction of shares among independent encounters: interval on the logarithm of the ratio with
/// variance `Σ (1 - p)/k`, half an event added to each count `k` (Katz et al. 1978).
fn fewer_apart(own: Rate, fewer: Rate) -> (Rate, Option<f64>, Interval) {
    let unknown = Interval { low: f64::NEG_INFINITY, high: 1.0 };
    if own.hits == 0 || fewer.runs == 0 {
        return (fewer, None, unknown);
    }
    let counts = [&own, &fewer].map(|rate| rate.rate * rate.effective + 0.5);
    let variance: f64 = counts
        .iter()
        .zip([&own, &fewer])
        .map(|(k, rate)| 1.0 / k - 1.0 / (rate.effective + 0.5))
        .sum();
    let middle = counts[1] / (fewer.effective + 0.5) / (counts[0] / (own.effective + 0.5));
    let factor = (z95() * variance.max(0.0).sqrt()).exp();
    let interval = Interval { low: 1.0 - middle * factor, high: 1.0 - middle / factor };
    (fewer, Some(1.0 - fewer.rate / own.rate), interval)
}

fn agreement(
    observed: Interval,
    simulated: Option<f64>,
    interval: Interval,
    runs: u64,
) -> Agreement {
    let Some(simulated) = simulated else { return Agreement::Open };
    if interval.high < observed.low || interval.low > observed.high {
        return Agreement::Misses;
    }
    let within = (observed.low..=observed.high).contains(&simulated);
    if within && runs >= LEAST { Agreement::Agrees } else { Agreement::Open }
}

fn counted(observation: &ObservedShare, option: &str) -> String {
    let among = observation
        .among
        .as_ref()
        .map_or_else(String::new, |among| format!(" among \"{}\"", among.words()));
    let of = observation.of.words();
    let times = if observation.times.total_cmp(&1.0).is_eq() {
        String::new()
    } else {
        format!(", times {}", observation.times)
    };
    match &observation.fewer_with {
        Some(fewer) => format!(
            "share by which \"{of}\"{among} is rarer with {fewer} than with {option}{times}"
        ),
        None => format!("\"{of}\"{among}, {option}{times}"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::indicators::EventIndicator;
    use super::*;
    use crate::study::runs::RunRow;

    #[test]
    fn a_share_agrees_within_misses_outside_and_is_open_where_chance_decides() {
        let observed = Interval { low: 0.60, high: 0.89 };
        let of = |hits, runs| {
            let rate = Rate::from_counts(hits, runs);
            agreement(observed, Some(rate.rate), rate.interval, runs)
        };
        assert_eq!(of(24, 31), Agreement::Agrees);
        assert_eq!(of(3, 31), Agreement::Misses);
        assert_eq!(of(12, 24), Agreement::Open);
        // Three of four lie within, but four say little.
        assert_eq!(of(3, 4), Agreement::Open);
        assert_eq!(agreement(observed, None, observed, 0), Agreement::Open);
    }

    /// Five of ten runs touch, as observed: it agrees, unless the gear decides it.
    #[test]
    fn what_is_decided_by_construction_does_not_agree() {
        let text = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 10\nbaseline = \"a\"\n\
            [[option]]\nid = \"a\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n\
            [[observation]]\nid = \"o\"\nsays = \"seen\"\nsource = \"a paper\"\nof = \"contact\"\nobserved = [0.4, 0.6]\n";
        let run = |encounter: u64| RunRow {
            encounter,
            option: "a".to_owned(),
            weight: 1.0,
            valid: true,
            first_contact_s: (encounter < 5).then_some(3.0),
            ..RunRow::default()
        };
        let runs = Runs::of_rows((0..10).map(run).collect());
        let compared = |text: &str| {
            let study = endline_gear::Study::read("s.toml", text).unwrap();
            compare(&study.observations[0], &runs, "a")
        };
        assert_eq!(compared(text).agreement, Agreement::Agrees);
        let decided = compared(&format!("{text}by_construction = \"the aim decides it\"\n"));
        assert_eq!(decided.agreement, Agreement::ByConstruction);
        assert_eq!(decided.simulated, Some(0.5));
        assert_eq!(decided.by_construction.as_deref(), Some("the aim decides it"));
    }

    #[test]
    fn a_few_events_of_unlike_weight_settle_nothing() {
        let of = |hits: usize, weight: f64| {
            let indicator = |index: usize| {
                let occurred = index < hits;
                Some(EventIndicator { occurred, weight: if occurred { weight } else { 1.0 } })
            };
            Rate::of(&EventIndicators((0..94).map(indicator).collect()))
        };
        assert!(is_thin(&of(1, 0.06)) && is_thin(&of(9, 0.06)));
        assert!(!is_thin(&of(10, 0.06)) && !is_thin(&of(0, 0.06)) && !is_thin(&of(1, 1.0)));
    }

    /// By hand: 20 of 40 and 5 of 50 give a ratio of 0.2; logarithm's deviation 0.447 from 20.5, 5.5, 40.5 and 50.5.
    #[test]
    fn shares_among_different_encounters_are_compared_as_independent() {
        let (_, fewer, interval) = fewer_apart(Rate::from_counts(20, 40), Rate::from_counts(5, 50));
        assert!((fewer.unwrap() - 0.8).abs() < 1e-12);
        let deviation = (1.0_f64 / 20.5 + 1.0 / 5.5 - 1.0 / 40.5 - 1.0 / 50.5).sqrt();
        let middle: f64 = (5.5 / 50.5) / (20.5 / 40.5);
        assert!((interval.low - (1.0 - middle * (1.959_964 * deviation).exp())).abs() < 1e-6);
        assert!(interval.low < 0.8 && interval.high > 0.8 && interval.high < 1.0);
        assert_eq!(fewer_apart(Rate::from_counts(0, 9), Rate::from_counts(1, 9)).1, None);
    }

    #[test]
    fn fewer_is_one_less_the_ratio_of_the_same_encounters() {
        let indicators =
            |hits: usize| EventIndicators::even((0..100).map(|index| Some(index < hits)));
        let (rate, fewer, interval) = fewer_by(&indicators(40), &indicators(10));
        assert_eq!((rate.hits, rate.runs), (10, 100));
        assert!((fewer.unwrap() - 0.75).abs() < 1e-12);
        assert!(interval.low < 0.75 && interval.high > 0.75 && interval.high < 1.0);
        assert_eq!(fewer_by(&indicators(0), &indicators(0)).1, None);
    }
}
