//! How an option's runs differ from the baseline's in the same encounters: outcome against outcome, and mean greatest tension.
//!
//! Of the encounters in which both runs count, *changed* are those with another outcome. Those in which rope touched in
//! either run are counted apart, for an encounter in which nothing touches has little to change. With `P` the greatest
//! tension of a run, the change of tension is `sum P / sum P_baseline - 1` over the same encounters.

use schemars::JsonSchema;
use serde::Serialize;

use crate::study::runs::Runs;

use super::bootstrap;
use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate};

/// Outcomes in the order of how bad they are.
const OUTCOMES: [&str; 5] = ["no_contact", "shed", "parted_free", "parted_entangled", "entangled"];

/// An option's runs beside the baseline's.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Changes {
    /// Outcome with the baseline, outcome with the option, encounters; the same outcome too, none that did not come.
    pub counts: Vec<(&'static str, &'static str, u64)>,
    /// Over all encounters.
    pub all: Change,
    /// Over those in which rope touched in either run.
    pub touching: Change,
}

/// Changes over some encounters.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Change {
    /// Encounters with another outcome.
    pub outcome: Rate,
    /// Mean of the greatest tensions, with the baseline and with the option [N]; none of no encounters.
    pub mean_tension_n: Option<[f64; 2]>,
    /// The second over the first, less 1.
    pub tension: Option<f64>,
    /// Its interval.
    pub tension_interval: Option<Interval>,
}

/// The end of a run.
#[derive(Clone, Copy, Debug)]
struct End {
    outcome: usize,
    tension_n: f64,
    weight: f64,
}

impl Changes {
    /// The changes of an option from another.
    pub fn of(runs: &Runs, option: &str, baseline: &str) -> Self {
        let (own, other) = (ends(runs, option), ends(runs, baseline));
        let pairs: Vec<[End; 2]> =
            other.iter().zip(&own).filter_map(|(other, own)| Some([(*other)?, (*own)?])).collect();
        let touching: Vec<[End; 2]> =
            pairs.iter().filter(|pair| pair.iter().any(|end| end.outcome > 0)).copied().collect();
        let cell = |one: usize, other: usize| {
            let count =
                pairs.iter().filter(|pair| pair.map(|end| end.outcome) == [one, other]).count()
                    as u64;
            (count > 0).then_some((OUTCOMES[one], OUTCOMES[other], count))
        };
        let counts = (0..OUTCOMES.len())
            .flat_map(|one| (0..OUTCOMES.len()).filter_map(move |other| cell(one, other)))
            .collect();
        Self {
            counts,
            all: Change::of(&format!("change {option}"), &pairs),
            touching: Change::of(&format!("change {option} touching"), &touching),
        }
    }
}

impl Change {
    fn of(label: &str, pairs: &[[End; 2]]) -> Self {
        let changed = pairs.iter().map(|[one, other]| {
            Some(EventIndicator { occurred: one.outcome != other.outcome, weight: one.weight })
        });
        let weight: f64 = pairs.iter().map(|[one, _]| one.weight).sum();
        let every: Vec<usize> = (0..pairs.len()).collect();
        let mean_tension_n =
            sums(pairs, &every).filter(|_| weight > 0.0).map(|sums| sums.map(|sum| sum / weight));
        let ratio =
            |indices: &[usize]| sums(pairs, indices).map(|[baseline, own]| own / baseline - 1.0);
        Self {
            outcome: Rate::of(&EventIndicators(changed.collect())),
            mean_tension_n,
            tension: ratio(&every),
            tension_interval: bootstrap::interval(label, pairs.len(), ratio),
        }
    }
}

/// Weighted sums of the greatest tensions of some encounters; none where the baseline's is nothing [N].
fn sums(pairs: &[[End; 2]], indices: &[usize]) -> Option<[f64; 2]> {
    let one = |end: End| end.weight * end.tension_n;
    let sum = |which: usize| indices.iter().map(|index| one(pairs[*index][which])).sum::<f64>();
    (sum(0) > 0.0).then(|| [sum(0), sum(1)])
}

/// By encounter: the end of an option's run, if it is valid and followed to the end.
fn ends(runs: &Runs, option: &str) -> Vec<Option<End>> {
    runs.by_encounter(option, |run| {
        let outcome = OUTCOMES.iter().position(|known| *known == run.outcome)?;
        (!run.until_parted).then_some(())?;
        Some(End { outcome, tension_n: run.peak_tension_n?, weight: run.weight })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::runs::RunRow;

    /// Encounter, option, whether it counts, outcome, greatest tension.
    fn runs(rows: &[(u64, &str, bool, &str, f64)]) -> Runs {
        let row =
            |(encounter, option, valid, outcome, tension): &(u64, &str, bool, &str, f64)| RunRow {
                encounter: *encounter,
                option: (*option).to_owned(),
                weight: 1.0,
                valid: *valid,
                outcome: (*outcome).to_owned(),
                peak_tension_n: Some(*tension),
                ..RunRow::default()
            };
        Runs::of_rows(rows.iter().map(row).collect())
    }

    #[test]
    fn outcomes_and_tensions_are_compared_encounter_by_encounter() {
        let runs = runs(&[
            (0, "whole", true, "no_contact", 10.0),
            (0, "half", true, "no_contact", 10.0),
            (1, "whole", true, "shed", 100.0),
            (1, "half", true, "entangled", 130.0),
            // Only one of the two counts.
            (2, "whole", true, "shed", 1e6),
            (2, "half", false, "entangled", 1.0),
            (3, "half", true, "no_contact", 20.0),
            (3, "whole", true, "shed", 40.0),
        ]);
        let changes = Changes::of(&runs, "half", "whole");
        assert_eq!(
            changes.counts,
            [("no_contact", "no_contact", 1), ("shed", "no_contact", 1), ("shed", "entangled", 1)]
        );
        assert_eq!((changes.all.outcome.hits, changes.all.outcome.runs), (2, 3));
        assert_eq!((changes.touching.outcome.hits, changes.touching.outcome.runs), (2, 2));
        assert_eq!(changes.all.mean_tension_n, Some([50.0, 160.0 / 3.0]));
        assert!(
            (changes.touching.tension.unwrap() - (150.0 / 140.0 - 1.0)).abs() < 1e-12,
            "{changes:?}"
        );
        let interval = changes.touching.tension_interval.unwrap();
        assert!(
            (interval.low + 0.5).abs() < 1e-12 && (interval.high - 0.3).abs() < 1e-12,
            "one of the two drawn twice: {interval:?}"
        );
    }

    #[test]
    fn an_option_and_itself_do_not_differ() {
        let runs = runs(&[(0, "one", true, "shed", 7.0), (1, "one", true, "entangled", 9.0)]);
        let changes = Changes::of(&runs, "one", "one");
        assert_eq!(changes.all.outcome.hits, 0);
        assert_eq!(changes.all.tension.map(f64::to_bits), Some(0.0_f64.to_bits()));
        assert_eq!(Changes::of(&Runs::default(), "one", "one").all.tension, None);
    }
}
