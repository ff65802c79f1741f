//! The uncertainty of a rate, in three separate bands: chance, assumed inputs, segments and steps.
//!
//! | band | content |
//! |---|---|
//! | chance | the interval of the rate (`interval.rs`) |
//! | assumed inputs | least and greatest rate with one assumed input at one of its levels, or in one half of its range: the envelope over all of them, others as drawn |
//! | segments | the rate times its ratio with finer segments and shorter steps, which another study found on the same encounters (`[[discretisation]]`) |
//!
//! Rates of small parts spread by chance too. The envelope is therefore shown beside that of parts assigned at random, on average over
//! [`DEALS`]: if it is no wider, no effect of the assumed inputs is shown.

use endline_gear::{Confidence, Discretisation, Prior, StudyEvent};
use schemars::JsonSchema;
use serde::Serialize;

use crate::study::prepared::PreparedStudy;
use crate::study::registration::Registration;
use crate::study::runs::Runs;

use super::bootstrap::Draws;
use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate};
use super::paired::Paired;
use super::sensitivity::parts_of;

/// Number of random assignments of levels.
const DEALS: usize = 200;

/// The bands of an event's rate with an option.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Bands {
    /// Id of the option.
    pub option: String,
    /// Its name.
    pub name: String,
    /// Name of the event.
    pub event: String,
    /// The rate with its interval: the band of chance.
    pub rate: Rate,
    /// The band of assumed inputs; none where no assumed input varies.
    pub assumed: Option<AssumedBand>,
    /// The band of segments; none where the study names nothing about this event.
    pub segments: Option<SegmentBand>,
}

/// Rates over the levels of assumed inputs, one input at a time.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct AssumedBand {
    /// Least rate.
    pub least: f64,
    /// Greatest rate.
    pub greatest: f64,
    /// Input and level with the least rate.
    pub least_at: String,
    /// Input and level with the greatest rate.
    pub greatest_at: String,
    /// Mean least and greatest rate with levels assigned at random.
    pub by_chance: Interval,
}

/// The effect of finer segments and steps on a rate.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct SegmentBand {
    /// Rate with finer ones over rate with those of this study.
    pub ratio: f64,
    /// Its interval.
    pub ratio_interval: Interval,
    /// The rate of this study times that interval, at most 1.
    pub rate: Interval,
    /// The study and program that found it.
    pub source: String,
}

/// The bands of every registered event with every option.
pub(super) fn of_registered(
    opened: &PreparedStudy,
    runs: &Runs,
    registration: &Registration,
) -> Vec<Bands> {
    let divided = divide(opened, runs);
    let events = registration.events.iter().filter_map(|name| StudyEvent::find(name));
    let of = |event: StudyEvent| {
        let found = opened.study.discretisations.iter().find(|found| found.event == event);
        let divided = &divided;
        opened.reading_order().into_iter().map(move |option| {
            let option = &opened.options[option];
            let indicators = EventIndicators::of(runs, &option.id, &event);
            let rate = Rate::of(&indicators);
            Bands {
                option: option.id.clone(),
                name: option.name.clone(),
                event: event.name(),
                assumed: AssumedBand::of(divided, &indicators),
                segments: found.and_then(|found| SegmentBand::of(found, &rate)),
                rate,
            }
        })
    };
    events.flat_map(of).collect()
}

/// An assumed input's levels: their names, and by encounter which of them was drawn.
struct Divided {
    names: Vec<String>,
    level: Vec<Option<usize>>,
}

/// The assumed inputs that vary.
fn divide(opened: &PreparedStudy, runs: &Runs) -> Vec<Divided> {
    let assumed =
        opened.study.priors.iter().filter(|prior| prior.confidence == Confidence::Assumed);
    let of = |prior: &Prior| {
        let parts = parts_of(opened, prior, runs)?;
        let count = parts.iter().map(|(_, keep)| keep.len()).max().unwrap_or_default();
        let level = (0..count).map(|encounter| parts.iter().position(|(_, keep)| keep[encounter]));
        let level: Vec<Option<usize>> = level.collect();
        let names: Vec<String> =
            parts.iter().map(|(name, _)| format!("{}: {name}", prior.words())).collect();
        (names.len() > 1).then_some(Divided { names, level })
    };
    assumed.filter_map(of).collect()
}

/// The valid encounters of an input: the level drawn in each, whether the event occurred, and its weight.
struct Known<'a> {
    names: &'a [String],
    levels: Vec<usize>,
    values: Vec<(f64, f64)>,
}

impl<'a> Known<'a> {
    fn of(divided: &'a Divided, indicators: &EventIndicators) -> Self {
        let counts = |(level, indicator): (&Option<usize>, &Option<EventIndicator>)| {
            let (level, indicator) = ((*level)?, (*indicator)?);
            Some((level, (f64::from(indicator.occurred), indicator.weight)))
        };
        let (levels, values) = divided.level.iter().zip(&indicators.0).filter_map(counts).unzip();
        Self { names: &divided.names, levels, values }
    }

    /// Weighted rate at each level, with its name; none of a level that has no encounter.
    fn rates(&self, levels: &[usize]) -> impl Iterator<Item = (f64, &'a String)> {
        let mut sums = vec![(0.0, 0.0); self.names.len()];
        for (level, (occurred, weight)) in levels.iter().zip(&self.values) {
            sums[*level].0 += occurred * weight;
            sums[*level].1 += weight;
        }
        let rate = |((hits, all), name)| (all > 0.0).then(|| (hits / all, name));
        sums.into_iter().zip(self.names).filter_map(rate)
    }
}

impl AssumedBand {
    /// The band of a study's indicators by its assumed inputs; none where none varies.
    pub(in crate::study) fn of_study(
        opened: &PreparedStudy,
        runs: &Runs,
        indicators: &EventIndicators,
    ) -> Option<Self> {
        Self::of(&divide(opened, runs), indicators)
    }

    fn of(divided: &[Divided], indicators: &EventIndicators) -> Option<Self> {
        let inputs: Vec<Known<'_>> =
            divided.iter().map(|divided| Known::of(divided, indicators)).collect();
        let mut found: Vec<(f64, &String)> =
            inputs.iter().flat_map(|known| known.rates(&known.levels)).collect();
        found.sort_by(|one, other| one.0.total_cmp(&other.0));
        let ((least, least_at), (greatest, greatest_at)) = (*found.first()?, *found.last()?);
        Some(Self {
            least,
            greatest,
            least_at: least_at.clone(),
            greatest_at: greatest_at.clone(),
            by_chance: by_chance(&inputs),
        })
    }

    /// The least and greatest rate of a band, or the rate itself where no assumed input varies.
    pub fn or_rate(band: Option<&Self>, rate: f64) -> Interval {
        band.map_or(Interval { low: rate, high: rate }, Self::rates)
    }

    /// Least and greatest rate.
    pub fn rates(&self) -> Interval {
        Interval { low: self.least, high: self.greatest }
    }

    /// Whether the levels spread the rate by no more than levels assigned at random.
    pub fn is_chance(&self) -> bool {
        self.greatest - self.least <= self.by_chance.high - self.by_chance.low
    }
}

/// Mean least and greatest rate with levels assigned at random.
fn by_chance(inputs: &[Known<'_>]) -> Interval {
    let mut draws = Draws::of("assumed inputs");
    let mut mean = Interval { low: 0.0, high: 0.0 };
    for _ in 0..DEALS {
        let (mut low, mut high) = (1.0_f64, 0.0_f64);
        for known in inputs {
            let mut dealt = known.levels.clone();
            draws.shuffle(&mut dealt);
            for (rate, _) in known.rates(&dealt) {
                (low, high) = (low.min(rate), high.max(rate));
            }
        }
        mean.low += low / DEALS as f64;
        mean.high += high / DEALS as f64;
    }
    mean
}

impl SegmentBand {
    fn of(found: &Discretisation, rate: &Rate) -> Option<Self> {
        let Discretisation { both, only_here, only_finer, neither, .. } = *found;
        let paired = Paired::from_counts([[neither, only_here], [only_finer, both]]);
        let (ratio, ratio_interval) = (paired.ratio?, paired.ratio_interval?);
        let end = |ratio: f64| (rate.rate * ratio).min(1.0);
        Some(Self {
            ratio,
            ratio_interval,
            rate: Interval { low: end(ratio_interval.low), high: end(ratio_interval.high) },
            source: found.source.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn divided(level: impl IntoIterator<Item = usize>, names: &[&str]) -> Divided {
        Divided {
            names: names.iter().map(ToString::to_string).collect(),
            level: level.into_iter().map(Some).collect(),
        }
    }

    /// 400 encounters, the event in each fourth of them; the first input decides it, the second has nothing to do with it.
    #[test]
    fn an_input_that_decides_spreads_the_rate_and_an_idle_one_by_chance() {
        let indicators = EventIndicators::even((0..400).map(|index| Some(index % 4 == 0)));
        let deciding = divided((0..400).map(|index| usize::from(index % 4 == 0)), &["no", "yes"]);
        let idle = divided((0..400).map(|index| (index / 4) % 2), &["one", "other"]);
        let band = AssumedBand::of(&[deciding, idle], &indicators).unwrap();
        assert_eq!((band.least, band.greatest), (0.0, 1.0));
        assert_eq!((band.least_at.as_str(), band.greatest_at.as_str()), ("no", "yes"));
        assert!(!band.is_chance() && band.by_chance.low > 0.15 && band.by_chance.high < 0.4);

        let idle = divided((0..400).map(|index| (index / 4) % 2), &["one", "other"]);
        let band = AssumedBand::of(&[idle], &indicators).unwrap();
        assert!(band.is_chance(), "{band:?}");
        // Two random halves: their rates differ from 0.25 by about 0.8 of √(p q / 400) either way.
        let half = 0.8 * (0.25_f64 * 0.75 / 400.0).sqrt();
        assert!((band.by_chance.high - 0.25 - half).abs() < 0.2 * half, "{band:?}");
    }

    #[test]
    fn levels_count_by_weight_and_invalid_runs_do_not() {
        let weights = [4.0, 1.0, 1.0, 2.0];
        let occurred = [true, false, true, false];
        let mut indicators: Vec<Option<EventIndicator>> = occurred
            .into_iter()
            .zip(weights)
            .map(|(occurred, weight)| Some(EventIndicator { occurred, weight }))
            .collect();
        indicators.push(None);
        let band =
            AssumedBand::of(&[divided([0, 0, 1, 1, 1], &["a", "b"])], &EventIndicators(indicators))
                .unwrap();
        assert!((band.greatest - 0.8).abs() < 1e-12 && (band.least - 1.0 / 3.0).abs() < 1e-12);
    }

    /// Ratio 24/20 by hand; the rate of the study goes with it.
    #[test]
    fn finer_segments_scale_the_rate() {
        let found = Discretisation {
            event: StudyEvent::Lodged,
            both: 19,
            only_here: 1,
            only_finer: 5,
            neither: 195,
            source: "a study".to_owned(),
        };
        let band = SegmentBand::of(&found, &Rate::from_counts(10, 200)).unwrap();
        assert!((band.ratio - 1.2).abs() < 1e-12);
        assert!(band.ratio_interval.low < 1.0 && band.ratio_interval.high > 1.2);
        assert!((band.rate.high - 0.05 * band.ratio_interval.high).abs() < 1e-12);
        let none = Discretisation { both: 0, only_here: 0, ..found };
        assert_eq!(SegmentBand::of(&none, &Rate::from_counts(10, 200)), None);
    }
}
