//! Rates by distance swum and by time of gear in the water, of a study with `[exposure]`.
//!
//! A track with `n` meetings, one of which is simulated, counts as `n` events where that encounter has the event. With `y` the sum of
//! the events of all tracks, `v` the sum of their squares, `w` the greatest number of meetings of a track and `D` the distance of all
//! tracks, the rate is `y / D`. Its interval is that of Fay and Feuer for sums of Poisson counts with weights:
//!
//! ```text
//! low = quantile 0.025 of the gamma law with mean y and variance v
//! high = quantile 0.975 of the gamma law with mean y + w and variance v + w²
//! ```
//!
//! With one meeting on each track these are the exact ends of a Poisson count. The interval of the ratio of two rates is that of Clopper
//! and Pearson for the share of one option in the events of both, with the effective counts `y²/v` (Przyborowski and Wilenski 1940). It
//! takes both options as independent, and is too wide where they share tracks.
//! References: Fay and Feuer 1997 (see `interval.rs`); Przyborowski and Wilenski 1940 (doi:10.1093/biomet/31.3-4.313).

use endline_gear::StudyEvent;
use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF, Gamma};

use super::indicators::occurred;
use super::interval::Interval;
use crate::study::plan::OptionPlan;
use crate::study::row::{MEETINGS, SWUM_M, SWUM_S};
use crate::study::runs::Runs;
use crate::table::Column;

/// Name of the meetings with gear among the events.
pub const MET: &str = "gear_met";

/// Distance for which rates are given [m].
const PER_M: f64 = 1e5;

/// Time of gear in the water, with a whale in the area, for which rates are given [s].
const PER_GEAR_S: f64 = 1e3 * 86_400.0;

/// How often the whales of an option meet gear, and with what result.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct ExposureFinding {
    /// Id of the option.
    pub id: String,
    /// Name of the option.
    pub name: String,
    /// Distance of all tracks [km].
    pub distance_km: f64,
    /// Time of all tracks [d].
    pub days: f64,
    /// Number of gears in the area.
    pub gears: u64,
    /// Rates: of gear met, of rope that touches, and of registered events.
    pub rates: Vec<TrackRate>,
}

/// Rate of an event on tracks.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct TrackRate {
    /// Name of the event.
    pub event: String,
    /// Events on all tracks.
    pub events: f64,
    /// Events in 100 km.
    pub per_100_km: f64,
    /// Its interval.
    pub interval: Interval,
    /// Events in 1,000 days of a gear in the water with a whale in the area.
    pub per_1000_gear_days: f64,
    /// Ratio to the rate of the baseline; `None` for the baseline, and without events of it.
    pub ratio: Option<f64>,
    /// Its interval.
    pub ratio_interval: Option<Interval>,
}

/// Events on tracks, and the tracks.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    /// Sum of events, sum of their squares, greatest number on a track that could have had them.
    y: f64,
    v: f64,
    w: f64,
    way_m: f64,
    time_s: f64,
}

/// The findings of every option, the baseline at its place; empty for a study without tracks.
pub(super) fn of(
    runs: &Runs,
    options: &[&OptionPlan],
    baseline: usize,
    events: &[StudyEvent],
) -> Vec<ExposureFinding> {
    let table = runs.table();
    let columns = (table.column(SWUM_M), table.column(SWUM_S), table.column(MEETINGS));
    let (Some(Column::Real(way)), Some(Column::Real(time)), Some(Column::Whole(meetings))) =
        columns
    else {
        return Vec::new();
    };
    let names: Vec<Option<&StudyEvent>> =
        std::iter::once(None).chain(events.iter().map(Some)).collect();
    let sums = |option: &&OptionPlan| {
        let mut sums = vec![Sum::default(); names.len()];
        for (row, run) in runs.rows().iter().enumerate().filter(|(_, run)| run.option == option.id)
        {
            let (Some(way_m), Some(time_s)) = (way[row], time[row]) else { continue };
            let count = meetings[row] as f64;
            for (event, sum) in names.iter().zip(&mut sums) {
                // Gear is met on a track whether its encounter can be simulated or not.
                if event.is_some() && !run.valid {
                    continue;
                }
                let occurred = event.is_none_or(|event| occurred(run, &event.counted()));
                sum.add([way_m, time_s], count, occurred);
            }
        }
        sums
    };
    let sums: Vec<Vec<Sum>> = options.iter().map(sums).collect();
    let base = &sums[baseline];
    let finding = |(option, own): (&&OptionPlan, &Vec<Sum>)| ExposureFinding {
        id: option.id.clone(),
        name: option.name.clone(),
        distance_km: 1e-3 * own[0].way_m,
        days: own[0].time_s / 86_400.0,
        gears: option.places.len() as u64,
        rates: names
            .iter()
            .zip(own.iter().zip(base))
            .map(|(event, (own, base))| {
                let event = event.map_or_else(|| MET.to_owned(), StudyEvent::name);
                let other = (option.id != options[baseline].id).then_some(base);
                own.rate(event, other, option.places.len())
            })
            .collect(),
    };
    options.iter().zip(&sums).map(finding).collect()
}

impl Sum {
    fn add(&mut self, [way_m, time_s]: [f64; 2], count: f64, occurred: bool) {
        self.way_m += way_m;
        self.time_s += time_s;
        self.w = self.w.max(count).max(1.0);
        if occurred {
            self.y += count;
            self.v += count * count;
        }
    }

    /// The rate of an event, compared with that of the baseline if this is another option.
    fn rate(&self, event: String, base: Option<&Self>, gears: usize) -> TrackRate {
        let per = |events: f64, all: f64| if all > 0.0 { events / all } else { 0.0 };
        let interval = self.interval();
        let [low, high] =
            [interval.low, interval.high].map(|events| PER_M * per(events, self.way_m));
        TrackRate {
            event,
            events: self.y,
            per_100_km: PER_M * per(self.y, self.way_m),
            interval: Interval { low, high },
            per_1000_gear_days: PER_GEAR_S * per(self.y, self.time_s * gears as f64),
            ratio: base
                .filter(|base| base.y > 0.0)
                .map(|base| per(self.y, self.way_m) / per(base.y, base.way_m)),
            ratio_interval: base.and_then(|base| ratio_interval(self, base)),
        }
    }

    /// Interval of the sum of events.
    fn interval(&self) -> Interval {
        let quantile = |mean: f64, variance: f64, share: f64| {
            let law = Gamma::new(mean * mean / variance, mean / variance);
            law.map_or(f64::INFINITY, |law| law.inverse_cdf(share))
        };
        Interval {
            low: if self.y > 0.0 { quantile(self.y, self.v, 0.025) } else { 0.0 },
            high: quantile(self.y + self.w, self.v + self.w * self.w, 0.975),
        }
    }

    /// Effective number of events, and events for each of these.
    fn effective(&self, other: &Self) -> [f64; 2] {
        let each = |sum: &Self| if sum.y > 0.0 { sum.v / sum.y } else { 1.0 };
        // Without events, those of the other option are as large.
        if self.y > 0.0 { [self.y * self.y / self.v, each(self)] } else { [0.0, each(other)] }
    }
}

/// Interval of the ratio of two rates; `None` without events of the second.
fn ratio_interval(own: &Sum, base: &Sum) -> Option<Interval> {
    let ([one, each], [other, each_of_base]) = (own.effective(base), base.effective(own));
    if other <= 0.0 || own.way_m <= 0.0 {
        return None;
    }
    let quantile =
        |a: f64, b: f64, share: f64| Beta::new(a, b).map_or(f64::NAN, |law| law.inverse_cdf(share));
    let low = if one > 0.0 { quantile(one, other + 1.0, 0.025) } else { 0.0 };
    let high = quantile(one + 1.0, other, 0.975);
    let scale = each / each_of_base * base.way_m / own.way_m;
    let ratio = |share: f64| scale * share / (1.0 - share);
    Some(Interval { low: ratio(low), high: ratio(high) }).filter(|ends| ends.high.is_finite())
}

/// Sentences about an event on tracks: with the baseline, and with each other option.
pub(super) fn sentences(findings: &[ExposureFinding], baseline: usize, event: &str) -> Vec<String> {
    let Some(base) = findings.get(baseline) else { return Vec::new() };
    let of =
        |finding: &ExposureFinding| finding.rates.iter().find(|rate| rate.event == event).cloned();
    let words = words(event);
    let Some(own) = of(base) else { return Vec::new() };
    let mut sentences = vec![format!(
        "With {}, “{words}” occurs {} times [{}, {}] in 100 km that a whale swims among {} gears ({:.0} events in {:.0} km).",
        base.name,
        figure(own.per_100_km),
        figure(own.interval.low),
        figure(own.interval.high),
        base.gears,
        own.events,
        base.distance_km
    )];
    for (_, finding) in findings.iter().enumerate().filter(|(place, _)| *place != baseline) {
        let rate = of(finding).and_then(|rate| Some((rate.ratio?, rate.ratio_interval?)));
        let Some((ratio, interval)) = rate else { continue };
        let settled =
            if interval.low <= 1.0 && interval.high >= 1.0 { "; this may be chance" } else { "" };
        sentences.push(format!(
            "With {}, it occurs {} times [{}, {}] as often for the same distance{settled}.",
            finding.name,
            figure(ratio),
            figure(interval.low),
            figure(interval.high)
        ));
    }
    sentences
}

/// An event in words.
pub fn words(event: &str) -> String {
    if event == MET {
        return "gear within reach".to_owned();
    }
    StudyEvent::find(event).map_or_else(|| event.to_owned(), |event| event.words())
}

/// Three figures.
pub fn figure(value: f64) -> String {
    let three: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    format!("{three}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(counts: &[f64], way_m: f64) -> Sum {
        let mut sum = Sum::default();
        for count in counts {
            sum.add([way_m / counts.len() as f64, 1.0], *count, *count > 0.0);
        }
        sum
    }

    /// Exact ends for Poisson counts: 2.202 to 13.06 for six events, 0 to 3.689 for none.
    #[test]
    fn an_interval_of_single_meetings_is_that_of_a_poisson_count() {
        let six = sum(&[[1.0; 6].as_slice(), &[0.0; 94]].concat(), 1e6).interval();
        assert!((six.low - 2.202).abs() < 1e-3 && (six.high - 13.06).abs() < 5e-3, "{six:?}");
        let none = sum(&[0.0; 50], 1e6).interval();
        assert!(none.low.abs() < 1e-12 && (none.high - 3.689).abs() < 1e-3, "{none:?}");
        // Two meetings on each of three tracks are less certain than six on six.
        let pairs = sum(&[[2.0; 3].as_slice(), &[0.0; 97]].concat(), 1e6).interval();
        assert!(pairs.low < six.low && pairs.high > six.high, "{pairs:?}");
    }

    /// 8 of 20 events, for equal distances: Clopper and Pearson give 0.1912 to 0.6395, a ratio of 0.236 to 1.774.
    #[test]
    fn the_ratio_of_two_counts_is_conditional_on_their_sum() {
        let (own, base) = (sum(&[1.0; 8], 1e5), sum(&[1.0; 12], 1e5));
        let interval = ratio_interval(&own, &base).unwrap();
        assert!((interval.low - 0.2364).abs() < 1e-3, "{interval:?}");
        assert!((interval.high - 1.774).abs() < 5e-3, "{interval:?}");
        let far = ratio_interval(&sum(&[1.0; 8], 2e5), &base).unwrap();
        assert!((far.low - 0.5 * interval.low).abs() < 1e-9, "twice the distance: {far:?}");
        assert!(ratio_interval(&own, &sum(&[0.0; 9], 1e5)).is_none());
        let none = ratio_interval(&sum(&[0.0; 9], 1e5), &base).unwrap();
        assert!(none.low.abs() < 1e-12 && none.high < 0.5, "{none:?}");
    }

    /// Of simulated studies of 200 tracks, with two options of different rates, 93 % and more of the intervals hold the truth.
    #[test]
    fn intervals_cover_the_truth_in_simulated_studies() {
        let draws = |study: u64, track: u32, rate: f64| {
            // Poisson by inversion; half of all meetings have the event, as the one that is simulated says.
            let [even, hit, ..] = crate::encounters::tracks::even(study, track, 1);
            let (mut count, mut probability, mut below) = (0.0, (-rate).exp(), (-rate).exp());
            while even > below {
                count += 1.0;
                probability *= rate / count;
                below += probability;
            }
            (count, hit < 0.5)
        };
        let (mut rates, mut ratios) = (0, 0);
        for study in 0..600 {
            let of = |seed: u64, rate: f64| {
                let mut sum = Sum::default();
                for track in 0..200 {
                    let (count, hit) = draws(2 * study + seed, track, rate);
                    sum.add([1.0, 1.0], count, hit);
                }
                sum
            };
            let (own, base) = (of(0, 0.08), of(1, 0.2));
            let is_in =
                |interval: Interval, truth: f64| interval.low <= truth && truth <= interval.high;
            rates += usize::from(is_in(own.interval(), 200.0 * 0.04));
            ratios += usize::from(ratio_interval(&own, &base).is_some_and(|ends| is_in(ends, 0.4)));
        }
        println!("{rates} and {ratios} of 600");
        assert!(rates >= 558 && ratios >= 558, "{rates} {ratios}");
    }
}
