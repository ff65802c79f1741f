//! Cost and precision of a study, from its first encounters, timed.
//!
//! | figure | from |
//! |---|---|
//! | time | mean time of an encounter times the encounters that are left; the range is a factor ([`Pace::factor`]) |
//! | encounters for a difference | the rate of the study's event with the baseline (`stats/verdict.rs`) |
//! | encounters for a band | `n = p (1 - p) (1.96 / d)²` whales with the event for a share `p = 0.3` known to `±d = 0.05`: 323 |
//!
//! These encounters are stored in the study's folder, so that no work is lost. With weighted encounters, numbers
//! are scaled by the effective numbers of those that were run.

use std::time::Duration;

use schemars::JsonSchema;
use serde::Serialize;

use crate::campaign::control::{Control, Pace};
use crate::campaign::pool::Shard;
use crate::error::Error;

use super::folder::Folder;
use super::prepared::PreparedStudy;
use super::stats::{
    EventIndicators, Rate, WORTH_FINDING, effective_with, encounters_missing, encounters_to_tell,
    expected_newly, rounded, whales_for_band,
};
use super::{batch, results};

/// Half-width of the band about a share of held whales.
const BAND: f64 = 0.05;

/// Factor within which a forecast of the time is useful.
pub const USEFUL_FACTOR: f64 = 1.5;

/// The forecast of a study.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Forecast {
    /// Encounters of the study.
    pub encounters: u64,
    /// Its first encounters that have been run.
    pub done: u64,
    /// The cost of the others; `None` if no encounter was timed.
    pub cost: Option<Cost>,
    /// Rate of the study's event with the baseline.
    pub rate: Rate,
    /// Share of the event that an option must prevent to be found.
    pub prevented: f64,
    /// Encounters in all with which such an option is distinguished from the baseline with a probability of 80 %.
    pub needed_to_tell: Option<f64>,
    /// Whether the study has as many.
    pub tells: Option<bool>,
    /// Encounters in all with which the share that an option prevents is known to ±5 points.
    pub needed_for_band: Option<f64>,
}

/// The cost of the encounters that are left.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Cost {
    /// Encounters that were timed.
    pub timed: u32,
    /// Mean time of an encounter on one thread [s].
    pub encounter_s: f64,
    /// Factor by which it may be greater or smaller; `None` for fewer than three encounters.
    pub factor: Option<f64>,
    /// Number of timed encounters after which that factor is expected to be at most 1.5.
    pub for_useful_factor: Option<f64>,
    /// Encounters that are left.
    pub left: u64,
}

impl Cost {
    /// Time of one thread for the encounters that are left [s].
    pub fn left_s(&self) -> f64 {
        self.encounter_s * self.left as f64
    }

    /// Cost and time of the encounters that are left, with their range, in words.
    pub fn words(&self, threads: usize) -> String {
        let Self { timed, encounter_s, factor, for_useful_factor, left } = *self;
        if left == 0 {
            return format!("{encounter_s:.1} s of a core for each encounter; none is left");
        }
        let range = |seconds: f64| {
            factor.map_or_else(String::new, |factor| {
                let [low, high] = [seconds / factor, seconds * factor].map(duration_words);
                format!(" [{low}, {high}]")
            })
        };
        let more = match (factor, for_useful_factor) {
            (Some(factor), Some(number)) if factor > USEFUL_FACTOR => format!(
                "; about {} timed encounters narrow the range to a factor of {USEFUL_FACTOR}",
                rounded(number)
            ),
            _ => String::new(),
        };
        let (whole_s, count) = (self.left_s(), threads as f64);
        format!(
            "{encounter_s:.1} s of a core for each of {timed} timed encounters; {left} left take {} of a core{}, {} on {threads} threads{more}",
            duration_words(whole_s),
            range(whole_s),
            duration_words(whole_s / count),
        )
    }

    fn of(pace: &Pace, left: u64) -> Option<Self> {
        let encounter_s = pace.mean_s()?;
        Some(Self {
            timed: pace.encounters,
            encounter_s,
            factor: pace.factor(),
            for_useful_factor: pace.encounters_for(USEFUL_FACTOR),
            left,
        })
    }
}

/// Runs those of the first `count` encounters of a study that are missing in its folder, and forecasts the rest.
/// Errors: blocks that cannot be written or read.
pub fn of_first(
    opened: &PreparedStudy,
    folder: &Folder,
    count: u32,
    threads: usize,
    control: &Control,
) -> Result<Forecast, Error> {
    let progress = batch::run(opened, &folder.first(count), Shard::WHOLE, threads, control)?;
    of_stored(opened, folder, &progress.pace)
}

/// The forecast from the first encounters stored in a study's folder, with the times of those that were timed.
/// Errors: blocks that cannot be read.
pub fn of_stored(opened: &PreparedStudy, folder: &Folder, pace: &Pace) -> Result<Forecast, Error> {
    let (runs, _) = results::first_runs(folder)?;
    let indicators =
        |option: usize| EventIndicators::of(&runs, &opened.options[option].id, &opened.study.event);
    let own = indicators(opened.baseline);
    let others = (0..opened.options.len()).filter(|option| *option != opened.baseline);
    let newly: Vec<u64> =
        others.map(|option| Rate::of(&indicators(option).absent_in(&own)).hits).collect();
    let done = runs.encounters() as u64;
    let left = opened.study.encounters.saturating_sub(done);
    Ok(Forecast {
        cost: Cost::of(pace, left),
        ..of_event(opened.study.encounters, done, &own, &newly)
    })
}

/// What encounters with an event can tell, with the counts of newly held whales by option.
fn of_event(encounters: u64, done: u64, indicators: &EventIndicators, newly: &[u64]) -> Forecast {
    let rate = Rate::of(indicators);
    let newly = expected_newly(rate.hits, newly);
    let needed_to_tell = encounters_missing(&rate, newly).map(|_| {
        encounters_to_tell(rate.rate, WORTH_FINDING, newly) * rate.runs as f64 / rate.effective
    });
    let whales = whales_for_band(BAND);
    let with_event = effective_with(indicators);
    Forecast {
        encounters,
        done,
        cost: None,
        rate,
        prevented: WORTH_FINDING,
        needed_to_tell,
        tells: needed_to_tell.map(|needed| encounters as f64 >= needed),
        needed_for_band: (with_event > 0.0).then(|| whales * rate.runs as f64 / with_event),
    }
}

/// A duration in words, such as `42 min` or `3.2 h`.
pub fn duration_words(seconds: f64) -> String {
    let duration = Duration::try_from_secs_f64(seconds.max(0.0)).unwrap_or(Duration::MAX);
    match duration.as_secs() {
        0..120 => format!("{:.0} s", duration.as_secs_f64()),
        120..7200 => format!("{:.0} min", duration.as_secs_f64() / 60.0),
        _ => format!("{:.1} h", duration.as_secs_f64() / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::ContactTime;

    /// 10 of 200 encounters with the event, of equal weight, none newly: 323 whales for the band.
    #[test]
    fn numbers_follow_from_the_rate() {
        let indicators = EventIndicators::even((0..200).map(|n| Some(n < 10)));
        let found = of_event(1000, 200, &indicators, &[0, 0]);
        let needed = encounters_to_tell(0.05, 0.3, 0.05);
        assert!(
            (found.needed_to_tell.unwrap() - needed).abs() < 1e-9 && needed < 750.0,
            "{needed}"
        );
        assert_eq!(found.tells, Some(true));
        let band = found.needed_for_band.unwrap();
        assert!((band / 20.0 - 322.7).abs() < 0.1, "{band}");
        let none = of_event(1000, 20, &EventIndicators::even((0..20).map(|_| Some(false))), &[]);
        assert_eq!((none.needed_to_tell, none.tells, none.needed_for_band), (None, None, None));
    }

    #[test]
    fn the_cost_is_the_mean_time_of_what_is_left() {
        let mut pace = Pace::default();
        assert_eq!(Cost::of(&pace, 10), None);
        for seconds in [2.0, 4.0, 6.0] {
            pace.add(Duration::from_secs_f64(seconds), ContactTime::default());
        }
        let cost = Cost::of(&pace, 100).unwrap();
        assert!((cost.left_s() - 400.0).abs() < 1e-9 && cost.factor.unwrap() > 1.0);
        assert_eq!([90.0, 600.0, 9000.0].map(duration_words), ["90 s", "10 min", "2.5 h"]);
    }
}
