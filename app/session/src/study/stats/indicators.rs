//! Whether an event occurred, encounter by encounter.

use endline_gear::{Counted, StudyEvent};

use crate::study::runs::{RunRow, Runs};

use super::weighted::kish;

/// Whether an event occurred in an encounter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventIndicator {
    /// Whether it occurred.
    pub occurred: bool,
    /// Weight of the encounter.
    pub weight: f64,
}

/// By encounter: whether the event occurred; `None` if the run is invalid or missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventIndicators(pub Vec<Option<EventIndicator>>);

impl EventIndicators {
    /// The indicators of an event in the runs of an option; none if the runs end before the event is decided.
    pub fn of(runs: &Runs, option: &str, event: &StudyEvent) -> Self {
        let counted = event.counted();
        Self(runs.by_encounter(option, |run| {
            let is_known = !run.until_parted || event.is_known_at_parting();
            is_known
                .then(|| EventIndicator { occurred: occurred(run, &counted), weight: run.weight })
        }))
    }

    /// The indicators of encounters of equal weight.
    pub fn even(occurred: impl IntoIterator<Item = Option<bool>>) -> Self {
        let even =
            |occurred: Option<bool>| Some(EventIndicator { occurred: occurred?, weight: 1.0 });
        Self(occurred.into_iter().map(even).collect())
    }

    /// 1 where the event occurred and 0 where it did not, each with its weight.
    pub(super) fn values(&self) -> Vec<(f64, f64)> {
        let known = self.0.iter().flatten();
        known.map(|indicator| (f64::from(indicator.occurred), indicator.weight)).collect()
    }

    /// Encounters in which the event occurred.
    pub fn occurred(&self) -> Vec<bool> {
        let occurred = |indicator: EventIndicator| indicator.occurred;
        self.0.iter().map(|indicator| indicator.is_some_and(occurred)).collect()
    }

    /// Number of encounters in the longest of several lists.
    pub(super) fn longest<'a>(lists: impl IntoIterator<Item = &'a Self>) -> usize {
        lists.into_iter().map(|list| list.0.len()).max().unwrap_or_default()
    }

    /// By encounter with the event here: whether it does not occur in `other`. Other encounters are left out.
    pub fn absent_in(&self, other: &Self) -> Self {
        let both = self.0.iter().zip(&other.0);
        let absent = both.map(|(own, other)| {
            let (own, other) = ((*own)?, (*other)?);
            let absent = EventIndicator { occurred: !other.occurred, weight: own.weight };
            own.occurred.then_some(absent)
        });
        Self(absent.collect())
    }

    /// Only the indicators of some encounters.
    pub fn within(&self, keep: &[bool]) -> Self {
        let kept = self.0.iter().zip(keep);
        Self(kept.map(|(indicator, keep)| indicator.filter(|_| *keep)).collect())
    }
}

/// Effective number of encounters of equal weight with the event.
pub fn effective_with(indicators: &EventIndicators) -> f64 {
    let with = indicators.0.iter().flatten().filter(|indicator| indicator.occurred);
    kish(with.map(|indicator| indicator.weight))
}

/// Whether an event occurred in a run.
pub(super) fn occurred(run: &RunRow, counted: &Counted<'_>) -> bool {
    let number = |column: &str, is_it: &dyn Fn(f64) -> bool| run.number(column).is_some_and(is_it);
    match *counted {
        Counted::Outcome(wanted) => wanted.contains(&run.outcome.as_str()),
        Counted::Present(column) => run.number(column).is_some(),
        Counted::Flag(column) => run.flag(column),
        Counted::AtLeast(column, parts, least) => parts.iter().any(|part| {
            let own = run.parts.get(*part as usize);
            own.and_then(|own| own.number(column)).is_some_and(|value| value >= least)
        }),
        Counted::Above(column, least) => number(column, &|value| value > least),
        Counted::All(parts) => parts.iter().all(|part| occurred(run, part)),
        Counted::Any(parts) => parts.iter().any(|part| occurred(run, part)),
    }
}

#[cfg(test)]
mod tests {
    use endline_sdk::BodyPart;

    use super::*;
    use crate::study::runs::PartRow;

    /// A column that is no field fails a debug assertion.
    #[test]
    fn every_event_is_counted_by_fields_of_a_run() {
        let parts = vec![PartRow::default(); BodyPart::ALL.len()];
        let run = RunRow { parts, ..RunRow::default() };
        for event in StudyEvent::all() {
            assert!(!occurred(&run, &event.counted()), "{}", event.name());
        }
    }

    #[test]
    fn a_wrap_counts_on_its_own_part_and_a_held_whale_by_its_state_at_the_end() {
        let mut parts = vec![PartRow::default(); BodyPart::ALL.len()];
        parts[BodyPart::Peduncle as usize].peak_wraps = Some(0.5);
        let run = RunRow {
            parts,
            outcome: "entangled".to_owned(),
            anchored: true,
            rope_on_head: true,
            rope_on_tail: true,
            carried_buoys: 1,
            trailing_m: Some(12.0),
            speed_made_good_m_s: Some(0.1),
            ..RunRow::default()
        };
        let of =
            |run: &RunRow, name: &str| occurred(run, &StudyEvent::find(name).unwrap().counted());
        assert!(of(&run, "wrap_peduncle") && of(&run, "wrap_any") && !of(&run, "wrap_head"));
        assert!(of(&run, "anchored") && !of(&run, "towing") && !of(&run, "contact"));
        let is_so = |name: &&str| of(&run, name);
        assert!(
            ["on_head", "on_tail", "on_two_places", "buoys_attached", "trailing_10m"]
                .iter()
                .all(is_so)
        );
        assert!(!["on_flipper", "traps_attached", "constricting"].iter().any(is_so));
        let one = RunRow { rope_on_tail: false, speed_made_good_m_s: Some(0.2), ..run.clone() };
        assert!(!of(&one, "on_two_places") && of(&one, "towing"));
        let free = RunRow { outcome: "shed".to_owned(), ..run };
        assert!(!of(&free, "buoys_attached") && !of(&free, "trailing_10m"));
    }
}
