//! Intervals cover the truth: simulated studies with known rates.

use endline_gear::Study;

use crate::encounters::draw::{Drawn, draw_from};
use crate::encounters::fitted::{Fitted, Held, Mixture};

use crate::study::adapt::fitted_to;

use super::bootstrap::Draws;
use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate};
use super::paired::Paired;

/// Simulated studies.
const STUDIES: usize = 2000;

/// Encounters of each.
const ENCOUNTERS: usize = 300;

/// Joint rates by whether the event occurred with an option and with the other.
const JOINT: [[f64; 2]; 2] = [[0.50, 0.20], [0.10, 0.20]];

/// Draws the counts of a study.
fn counts(draws: &mut Draws) -> [[u64; 2]; 2] {
    let mut counts = [[0; 2]; 2];
    for _ in 0..ENCOUNTERS {
        let mut left = draws.below(1 << 30) as f64 / f64::from(1 << 30);
        let cell = [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().find(|(this, other)| {
            left -= JOINT[*this][*other];
            left < 0.0
        });
        let (this, other) = cell.unwrap_or((1, 1));
        counts[this][other] += 1;
    }
    counts
}

/// Share of studies whose interval holds the truth.
fn covered(label: &str, truth: f64, interval: impl Fn([[u64; 2]; 2]) -> Option<Interval>) -> f64 {
    let mut draws = Draws::of(label);
    let holds = |interval: Interval| (interval.low..=interval.high).contains(&truth);
    let held = (0..STUDIES).filter(|_| interval(counts(&mut draws)).is_some_and(holds)).count();
    held as f64 / STUDIES as f64
}

#[test]
fn intervals_of_rates_and_paired_differences_and_ratios_cover_the_truth() {
    let rate = covered("rate", 0.3, |[_, [only, both]]| {
        Some(Rate::from_counts(only + both, ENCOUNTERS as u64).interval)
    });
    let difference =
        covered("difference", -0.1, |counts| Some(Paired::from_counts(counts).difference_interval));
    let ratio = covered("ratio", 0.3 / 0.4, |counts| Paired::from_counts(counts).ratio_interval);
    println!("covered: rate {rate}, difference {difference}, ratio {ratio}");
    for share in [rate, difference, ratio] {
        assert!(
            (0.93..=0.97).contains(&share),
            "rate {rate}, difference {difference}, ratio {ratio}"
        );
    }
}

#[test]
fn rare_events_are_covered_too() {
    let mut draws = Draws::of("rare");
    let held = (0..STUDIES).filter(|_| {
        let hits = (0..1000).filter(|_| draws.below(100) < 2).count() as u64;
        let Interval { low, high } = Rate::from_counts(hits, 1000).interval;
        (low..=high).contains(&0.02)
    });
    let share = held.count() as f64 / STUDIES as f64;
    assert!((0.93..=0.97).contains(&share), "{share}");
}

/// A share of 15 % among 24 held whales whose weights differ by a factor of 90, as in `rope-strength`: the interval covers the truth at least
/// as often as stated, and is narrower than that of a rate, which covers it always.
#[test]
fn shares_among_few_whales_of_unlike_weight_are_covered() {
    const WEIGHTS: [f64; 8] = [0.03, 0.06, 0.1, 0.2, 0.3, 0.8, 1.4, 2.6];
    let mut draws = Draws::of("among");
    let (mut covered, mut widths) = ([0; 2], [0.0; 2]);
    for _ in 0..STUDIES {
        let whale = |_| {
            let weight = WEIGHTS[draws.below(WEIGHTS.len())];
            Some(EventIndicator { occurred: draws.below(100) < 15, weight })
        };
        let whales = EventIndicators((0..24).map(whale).collect());
        for (place, rate) in [Rate::among(&whales), Rate::of(&whales)].into_iter().enumerate() {
            let Interval { low, high } = rate.interval;
            covered[place] += usize::from((low..=high).contains(&0.15));
            widths[place] += (high - low) / STUDIES as f64;
        }
    }
    let [among, of] = covered.map(|count| count as f64 / STUDIES as f64);
    println!("covered {among}, {of}; widths {widths:?}");
    assert!(among >= 0.95 && of >= among, "{among}, {of}");
    assert!(widths[0] < 0.75 * widths[1], "{widths:?}");
}

/// The median of differences by drawing again: of a symmetric law about 3 the truth is 3.
#[test]
fn the_bootstrap_covers_the_truth() {
    let mut draws = Draws::of("bootstrap");
    let studies = 200;
    let held = (0..studies).filter(|study| {
        let values: Vec<f64> = (0..60)
            .map(|_| (0..4).map(|_| draws.below(1000) as f64 / 1000.0).sum::<f64>() + 1.0)
            .collect();
        let mean = |indices: &[usize]| {
            Some(indices.iter().map(|index| values[*index]).sum::<f64>() / indices.len() as f64)
        };
        let interval = super::bootstrap::interval(&format!("study {study}"), values.len(), mean);
        interval
            .is_some_and(|interval| (interval.low..=interval.high).contains(&(1.0 + 4.0 * 0.4995)))
    });
    let share = held.count() as f64 / f64::from(studies);
    assert!((0.90..=0.99).contains(&share), "{share}");
}

/// A study whose event needs a value that is rare, with most encounters drawn where it is not.
const RARE: &str = r#"
format = 1
kind = "study"
name = "Rare"
scenario = "hello-endline"
encounters = 1000
baseline = "a"
[[option]]
id = "a"
[encounter.offset]
uniform = ["0 m", "1 m"]
proposal = { bins = ["0 m", "0.02 m", "1 m"], weights = [0.6, 0.4] }
source = "assumed"
"#;

/// One simulated study: whether each of two options holds the whale, with the weights of encounters; `elsewhere` is the probability of
/// the event far from most proposals, as a share of that near them.
fn rare_study(
    study: &Study,
    draws: &mut Draws,
    plain: bool,
    (encounters, elsewhere): (usize, f64),
) -> [EventIndicators; 2] {
    let mut uniform = || draws.below(1 << 30) as f64 / f64::from(1 << 30);
    let mut indicators = [EventIndicators::default(), EventIndicators::default()];
    for _ in 0..encounters {
        let share = uniform();
        let from_prior = plain || uniform() < study.from_priors;
        let low = [0.0, 0.02];
        let offset = match (from_prior, share < 0.6) {
            (true, _) => share,
            (false, true) => low[1] * share / 0.6,
            (false, false) => low[1] + (1.0 - low[1]) * (share - 0.6) / 0.4,
        };
        let drawn = Drawn {
            name: "offset".into(),
            text: String::new(),
            number: Some(offset),
            plain: false,
        };
        let mixture = Mixture {
            from_priors: study.from_priors,
            has_proposal: !plain,
            fitted: &Fitted::default(),
        };
        let weight = mixture.weight(&study.priors, &[drawn]);
        let by_chance = uniform();
        for (indicators, chance) in indicators.iter_mut().zip([0.8, 0.5]) {
            let chance = if offset < 0.02 { chance } else { elsewhere * chance };
            indicators.0.push(Some(EventIndicator { occurred: by_chance < chance, weight }));
        }
    }
    indicators
}

/// Rates of 1.6 and 1.0 % whose events all come where most encounters are drawn: importance sampling covers them as plain sampling does, with
/// narrower intervals.
#[test]
fn weighted_encounters_cover_the_truth_and_know_rare_events_better() {
    let study = Study::read("rare.toml", RARE).unwrap();
    let mut covered_by = Vec::new();
    for plain in [false, true] {
        let mut draws = Draws::of("importance");
        let (mut held, mut width) = ([0_u32; 3], 0.0);
        for _ in 0..STUDIES {
            let [one, other] = rare_study(&study, &mut draws, plain, (1000, 0.0));
            let (rate, paired) = (Rate::of(&one), Paired::of(&other, &one));
            let holds = |interval: Interval, truth: f64| {
                u32::from((interval.low..=interval.high).contains(&truth))
            };
            held[0] += holds(rate.as_met, 0.016);
            held[1] += holds(paired.difference_as_met, -0.006);
            held[2] += paired.ratio_as_met.map_or(1, |interval| holds(interval, 0.625));
            width += (rate.as_met.high - rate.as_met.low) / STUDIES as f64;
        }
        covered_by.push((held.map(|count| f64::from(count) / STUDIES as f64), width));
    }
    println!("importance sampling {:?}, plain {:?}", covered_by[0], covered_by[1]);
    assert!(covered_by[0].0.iter().all(|share| (0.93..=0.97).contains(share)), "{covered_by:?}");
    assert!(covered_by[0].1 < 0.3 * covered_by[1].1, "{covered_by:?}");
}

/// Half of the events come where few encounters are drawn, so that a small study often meets light ones alone.
#[test]
fn events_that_a_small_study_has_not_met_are_allowed_for() {
    let study = Study::read("rare.toml", RARE).unwrap();
    let elsewhere = 0.02;
    let rate = |chance: f64| chance * (0.02 + 0.98 * elsewhere);
    let mut draws = Draws::of("light events");
    let mut held = [0_u32; 2];
    for _ in 0..STUDIES {
        let [one, other] = rare_study(&study, &mut draws, false, (100, elsewhere));
        let difference = Paired::of(&other, &one).difference_interval;
        assert!(difference.low >= -1.0 && difference.high <= 1.0, "{difference:?}");
        for (held, (interval, truth)) in held
            .iter_mut()
            .zip([(Rate::of(&one).interval, rate(0.8)), (difference, rate(0.5) - rate(0.8))])
        {
            *held += u32::from((interval.low..=interval.high).contains(&truth));
        }
    }
    let held = held.map(|count| f64::from(count) / STUDIES as f64);
    println!("rate and difference covered: {held:?}");
    assert!(held.iter().all(|share| *share >= 0.93), "{held:?}");
}

/// A study of which one encounter in forty may hold a whale, by two routes.
const TWO_ROUTES: &str = r#"
format = 1
kind = "study"
name = "Two routes"
scenario = "hello-endline"
encounters = 400
baseline = "a"
[[option]]
id = "a"
[encounter]
from_priors = 0.15
[encounter.offset]
uniform = ["0 m", "1 m"]
source = "assumed"
[encounter.behaviour]
choice = ["swim", "skim-feed"]
weights = [0.9, 0.1]
source = "assumed"
"#;

/// One simulated study of 400 encounters: whether a whale is held, with the weights. If it adapts, stages begin at 0, 100 and 200.
/// Whales that skim at the left are held by one route, and whales at the right edge by another.
fn adapted_study(study: &Study, draws: &mut Draws, adapts: bool) -> EventIndicators {
    let mut uniform = || (draws.below(1 << 30) as f64 + 0.5) / f64::from(1 << 30);
    let (mut fitted, mut held) = (Fitted::default(), Vec::new());
    let mut indicators = EventIndicators::default();
    for encounter in 0..400 {
        if adapts && (encounter == 100 || encounter == 200) {
            let first = held.iter().filter(|(at, _)| *at < fitted_to(encounter));
            let first: Vec<Held> = first.map(|(_, held): &(u32, Held)| held.clone()).collect();
            fitted = Fitted::to(study, &first);
        }
        let draw = draw_from(study, &fitted, &mut uniform);
        let skims = draw.values.iter().any(|drawn| drawn.text == "skim-feed");
        let offset = draw.values.iter().find_map(|drawn| drawn.number).unwrap_or_default();
        let route = match (skims && offset < 0.25, offset > 0.98) {
            (true, _) => Some((0, 0.8)),
            (_, true) => Some((1, 0.5)),
            _ => None,
        };
        let held_by = route.filter(|(_, chance)| uniform() < *chance);
        let occurred = held_by.is_some();
        indicators.0.push(Some(EventIndicator { occurred, weight: draw.weight }));
        held.extend(held_by.map(|(route, _)| {
            (encounter, Held { drawn: draw.values, weight: draw.weight, route })
        }));
    }
    indicators
}

/// A rate of 3 %: the interval of an adaptive study covers it as that of plain sampling does, and is narrower.
#[test]
fn stages_cover_the_truth_and_hold_more_whales() {
    let study = Study::read("routes.toml", TWO_ROUTES).unwrap();
    let truth = 0.1 * 0.25 * 0.8 + 0.02 * 0.5;
    let mut found = Vec::new();
    for adapts in [true, false] {
        let mut draws = Draws::of("stages");
        let (mut covered, mut width, mut held) = (0_u32, 0.0, 0);
        for _ in 0..STUDIES {
            let rate = Rate::of(&adapted_study(&study, &mut draws, adapts));
            let Interval { low, high } = rate.as_met;
            covered += u32::from((low..=high).contains(&truth));
            width += (high - low) / STUDIES as f64;
            held += rate.hits;
        }
        let share = f64::from(covered) / STUDIES as f64;
        found.push((share, width, held as f64 / STUDIES as f64));
    }
    println!("adaptive {:?}, plain {:?}: covered, width, held", found[0], found[1]);
    let [(adaptive, narrow, many), (plain, wide, few)] = found[..] else { panic!("{found:?}") };
    assert!([adaptive, plain].iter().all(|share| (0.93..=0.97).contains(share)), "{found:?}");
    assert!(narrow < 0.85 * wide && many > 3.0 * few, "{found:?}");
}
