//! Rates at any strength of rope, weak links or weak places, from the run in which nothing can part.
//!
//! In encounter `i` with weight `w_i`, whole rope parts if and only if it delivers less than the strength needed there, `N_i`
//! (`report/needed.rs`). The rate of parting is therefore known for every strength `S` from the same runs:
//!
//! ```text
//! P(parts | S) = Σ w_i [N_i > S] / Σ w_i            n = (Σ w_i)² / Σ w_i²            half-width = √(ln(2/0.05) / (2 n))
//! ```
//!
//! The band of that half-width contains the whole curve with a probability of 95 % (Dvoretzky, Kiefer and Wolfowitz, with Massart's
//! constant). Weighted encounters count by Kish's effective number `n`, for which the band is wider than needed where events are of
//! small weight. The curve given held is that of the encounters in which a whale is held if nothing parts.
//!
//! The rates of weak links and of the weak places along a line follow likewise from the strengths that they need. Those of weak places
//! belong to the positions in the option that cannot part.
//!
//! What follows the parting is known at the strengths that were simulated. `P(held | S)` takes, where rope parts, the run of the option
//! whose strength is nearest on a scale of ratios among those that part too.
//! Shares of held whales at the strengths asked for most are also given by route of attachment, by parts of each input, and weighted by the
//! observed shares of routes (`held_whales.rs`).
//! References: Massart 1990 (doi:10.1214/aop/1176990746); Kish 1965, Survey Sampling, section 11.2.

use endline_gear::StudyEvent;
use schemars::JsonSchema;
use serde::Serialize;

use crate::study::plan::OptionPlan;
use crate::study::prepared::PreparedStudy;
use crate::study::runs::{RunRow, Runs};
use crate::units::N_PER_LBF;

use super::held_whales::{Route, Weighted, observed_shares};
use super::indicators::{EventIndicator, EventIndicators};
use super::weighted::kish;
use super::{Rate, sensitivity};

/// Least and greatest strength of a curve [lbf], and the step between its points.
const FROM_LBF: u32 = 200;
const TO_LBF: u32 = 10_000;
const STEP_LBF: usize = 50;

/// Strengths asked for most [lbf]: the weak link of the rules, one between, weak rope of the rules, ropes taken off whales.
const ASKED_LBF: [f64; 4] = [600.0, 1000.0, 1700.0, 2600.0];

/// Probability that a band does not contain its whole curve.
const OUTSIDE: f64 = 0.05;

/// Rates against the strength of a part.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct StrengthCurve {
    /// Which part is as strong as stated: whole rope, weak links or weak places.
    pub part: String,
    /// Option in which nothing can part.
    pub option: String,
    /// Share of encounters in which the part parts.
    pub parts: Banded,
    /// Share among the encounters in which a whale is held if nothing parts.
    pub parts_given_held: Banded,
    /// Share of encounters in which a whale is held, by strength; none for a part whose options have no strengths.
    pub held: Vec<f64>,
    /// The strengths [N].
    pub strengths_n: Vec<f64>,
    /// Shares of held whales at the strengths asked for most, from the least.
    pub asked: Vec<AskedStrength>,
    /// Shares among whales held by each route, at these strengths; for whole rope alone.
    pub by_route: Vec<HeldKind>,
    /// Shares by part of each input, at these strengths; for whole rope alone.
    pub by_input: Vec<HeldKind>,
}

/// Held whales that have a route of attachment or a part of an input in common.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct HeldKind {
    /// `held by`, or the input in words.
    pub of: String,
    /// The route, or the part of the input.
    pub name: String,
    /// Share on which the part parts, at each of the strengths asked for most.
    pub parts: Vec<Rate>,
}

/// The encounters of a kind.
struct Kind {
    of: String,
    name: String,
    keep: Vec<bool>,
}

/// Kinds of held whales, and observed shares of routes.
#[derive(Default)]
struct Kinds {
    /// A kind for each route, in the order of the routes.
    by_route: Vec<Kind>,
    /// A kind for each part of an input.
    by_input: Vec<Kind>,
    /// Observed shares of the routes.
    observed: Option<[f64; 5]>,
}

impl Kinds {
    /// Of the run in which nothing can part.
    fn of(opened: &PreparedStudy, runs: &Runs, id: &str) -> Self {
        let routes = runs.by_encounter(id, |run| Some(Route::of(run)));
        let on = |route: Route| Kind {
            of: "held by".to_owned(),
            name: route.words().to_owned(),
            keep: routes.iter().map(|known| *known == Some(route)).collect(),
        };
        let by_input = opened.study.priors.iter().flat_map(|prior| {
            let parts = sensitivity::parts_of(opened, prior, runs).unwrap_or_default();
            parts.into_iter().map(|(name, keep)| Kind { of: prior.words(), name, keep })
        });
        Self {
            by_route: Route::ALL.map(on).into(),
            by_input: by_input.collect(),
            observed: opened.study.routes.as_ref().map(observed_shares),
        }
    }
}

/// Shares of the whales held if nothing parts, at one strength.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct AskedStrength {
    /// The strength [N].
    pub strength_n: f64,
    /// Share on which the part parts.
    pub parts: Rate,
    /// Share on which it parts, but would not with the greatest of these strengths.
    pub parts_alone: Rate,
    /// Share on which it parts, weighted by the observed shares of routes.
    pub weighted: Option<Weighted>,
}

impl StrengthCurve {
    /// Whether it is that of whole rope.
    pub fn is_of_rope(&self) -> bool {
        self.part == Part::Rope.name()
    }
}

/// A curve with its band.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Banded {
    /// Encounters.
    pub encounters: u64,
    /// Number of encounters of equal weight that would give the same precision.
    pub effective: f64,
    /// Half-width of the band.
    pub half_width: f64,
    /// The share at each strength.
    pub shares: Vec<f64>,
}

impl Banded {
    /// The share of encounters that need more than each strength, from needed strengths [N] with weights.
    fn of(needed: &[(f64, f64)], strengths_n: &[f64]) -> Self {
        let all: f64 = needed.iter().map(|(_, weight)| weight).sum();
        let effective = kish(needed.iter().map(|(_, weight)| *weight));
        let above = |strength_n: &f64| {
            let own = needed.iter().filter(|(needed_n, _)| needed_n > strength_n);
            own.map(|(_, weight)| weight).sum::<f64>() / all.max(f64::MIN_POSITIVE)
        };
        Self {
            encounters: needed.len() as u64,
            effective,
            half_width: if effective > 0.0 {
                ((2.0 / OUTSIDE).ln() / (2.0 * effective)).sqrt().min(1.0)
            } else {
                1.0
            },
            shares: strengths_n.iter().map(above).collect(),
        }
    }

    /// The band at a strength, by its place.
    pub fn band(&self, place: usize) -> [f64; 2] {
        let share = self.shares[place];
        [(share - self.half_width).max(0.0), (share + self.half_width).min(1.0)]
    }
}

/// An option that states a strength, for the runs after a parting.
struct Simulated {
    strength_n: f64,
    /// By encounter: whether the whale is held.
    held: EventIndicators,
}

/// A part of the gear whose strength the options of a curve differ in.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Rope,
    Link,
    Places,
}

impl Part {
    const ALL: [Self; 3] = [Self::Rope, Self::Link, Self::Places];

    /// The part that is weaker than the rest of an option's gear.
    fn of(option: &OptionPlan) -> Self {
        let spec = &option.prepared.model.spec;
        if spec.links.iter().any(|link| link.enabled) {
            Self::Link
        } else if spec.lines.iter().any(|line| !line.weak_places.is_empty()) {
            Self::Places
        } else {
            Self::Rope
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Rope => "whole rope",
            Self::Link => "weak link",
            Self::Places => "weak place",
        }
    }

    /// Strength that it must have for nothing to part in a run [N].
    fn needed_n(self, run: &RunRow) -> Option<f64> {
        match self {
            Self::Rope => run.needed_rope_n,
            Self::Link => run.needed_link_n,
            Self::Places => run.needed_place_n,
        }
    }
}

/// Positions of the weak places of an option's lines [m].
fn positions_m(option: &OptionPlan) -> Vec<Vec<f64>> {
    let lines = option.prepared.model.spec.lines.iter();
    lines.map(|line| line.weak_places.iter().map(|place| place.at_m).collect()).collect()
}

/// Curves of a study, one for each part whose needed strength is known, if an option cannot part.
pub(super) fn of_study(
    opened: &PreparedStudy,
    runs: &Runs,
    event: &StudyEvent,
) -> Vec<StrengthCurve> {
    let Some(unbreakable) = opened.unbreakable() else { return Vec::new() };
    let is_of = |option: &OptionPlan, part: Part| {
        Part::of(option) == part
            && (part != Part::Places || positions_m(option) == positions_m(unbreakable))
    };
    let simulated = |part: Part| -> Vec<Simulated> {
        let followed = opened.options.iter().filter(|option| !option.until_parted);
        let own = followed.filter(|option| is_of(option, part));
        let with_strength = own.filter_map(|option| Some((option.strength_n?, option)));
        with_strength
            .map(|(strength_n, option)| Simulated {
                strength_n,
                held: EventIndicators::of(runs, &option.id, event),
            })
            .collect()
    };
    let curve = |part: Part| {
        let id = &unbreakable.id;
        let needed = runs.by_encounter(id, |run| Some((part.needed_n(run)?, run.weight)));
        let held = EventIndicators::of(runs, id, event);
        let known = needed.iter().any(Option::is_some);
        let kinds = if part == Part::Rope { Kinds::of(opened, runs, id) } else { Kinds::default() };
        known.then(|| curve(part, id, &needed, &held, &simulated(part), &kinds))
    };
    Part::ALL.into_iter().filter_map(curve).collect()
}

fn curve(
    part: Part,
    option: &str,
    needed: &[Option<(f64, f64)>],
    held: &EventIndicators,
    simulated: &[Simulated],
    kinds: &Kinds,
) -> StrengthCurve {
    let strengths_n: Vec<f64> =
        (FROM_LBF..=TO_LBF).step_by(STEP_LBF).map(|lbf| f64::from(lbf) * N_PER_LBF).collect();
    let known =
        || needed.iter().enumerate().filter_map(|(place, needed)| Some((place, (*needed)?)));
    let is_held =
        |indicators: &EventIndicators, place: usize| Some((*indicators.0.get(place)?)?.occurred);
    let all: Vec<(f64, f64)> = known().map(|(_, needed)| needed).collect();
    let needed_by_held: Vec<(f64, f64)> = known()
        .filter(|(place, _)| is_held(held, *place) == Some(true))
        .map(|(_, needed)| needed)
        .collect();
    let held_at = |strength_n: &f64| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (place, (needed_n, weight)) in known() {
            let run = if needed_n <= *strength_n {
                Some(held)
            } else {
                let part = simulated.iter().filter(|other| other.strength_n < needed_n);
                let apart = |other: &Simulated| (other.strength_n / strength_n).ln().abs();
                part.min_by(|one, other| apart(one).total_cmp(&apart(other))).map(|run| &run.held)
            };
            if let Some(is_held) = run.and_then(|run| is_held(run, place)) {
                sum += weight * f64::from(is_held);
                weights += weight;
            }
        }
        sum / f64::max(weights, f64::MIN_POSITIVE)
    };
    let asked_n = ASKED_LBF.map(|lbf| lbf * N_PER_LBF);
    let strongest_n = asked_n.into_iter().fold(0.0, f64::max);
    let among_held = |occurs: &dyn Fn(f64) -> bool| {
        let of = |(place, needed): (usize, &Option<(f64, f64)>)| {
            let (needed_n, weight) = (*needed)?;
            (is_held(held, place)?).then(|| EventIndicator { occurred: occurs(needed_n), weight })
        };
        EventIndicators(needed.iter().enumerate().map(of).collect())
    };
    let parts_at = asked_n.map(|strength_n| among_held(&|needed_n| needed_n > strength_n));
    let parts_of = |kind: &Kind| HeldKind {
        of: kind.of.clone(),
        name: kind.name.clone(),
        parts: parts_at.iter().map(|parts| Rate::among(&parts.within(&kind.keep))).collect(),
    };
    let by_route: Vec<HeldKind> = kinds.by_route.iter().map(parts_of).collect();
    let weighted = |strength: usize| {
        let rates: Vec<Rate> = by_route.iter().map(|kind| kind.parts[strength]).collect();
        Weighted::of(&rates, &kinds.observed?)
    };
    let asked = asked_n.iter().enumerate().map(|(place, strength_n)| {
        let alone = |needed_n: f64| needed_n > *strength_n && needed_n <= strongest_n;
        AskedStrength {
            strength_n: *strength_n,
            parts: Rate::among(&parts_at[place]),
            parts_alone: Rate::among(&among_held(&alone)),
            weighted: weighted(place),
        }
    });
    StrengthCurve {
        part: part.name().to_owned(),
        option: option.to_owned(),
        asked: asked.collect(),
        by_input: kinds.by_input.iter().map(parts_of).collect(),
        by_route,
        parts: Banded::of(&all, &strengths_n),
        parts_given_held: Banded::of(&needed_by_held, &strengths_n),
        held: if simulated.is_empty() {
            Vec::new()
        } else {
            strengths_n.iter().map(held_at).collect()
        },
        strengths_n,
    }
}

#[cfg(test)]
mod tests {
    use super::super::bootstrap::Draws;
    use super::*;

    fn indicators(held: &[bool]) -> EventIndicators {
        EventIndicators::even(held.iter().map(|held| Some(*held)))
    }

    /// Four encounters that need 500, 1,500, 2,500 lbf and almost nothing; the first three hold if nothing parts.
    #[test]
    fn a_curve_by_hand() {
        let needed: Vec<Option<(f64, f64)>> =
            [500.0, 1500.0, 2500.0, 10.0].map(|lbf| Some((lbf * N_PER_LBF, 1.0))).into();
        let held = indicators(&[true, true, true, false]);
        // Rope of 400 lbf frees all; rope of 2,000 lbf parts in the third encounter and leaves the whale held.
        let simulated = [
            Simulated { strength_n: 400.0 * N_PER_LBF, held: indicators(&[false; 4]) },
            Simulated {
                strength_n: 2000.0 * N_PER_LBF,
                held: indicators(&[true, true, true, false]),
            },
        ];
        let kind =
            |of: &str, keep: [bool; 4]| Kind { of: of.into(), name: "x".into(), keep: keep.into() };
        let mouth = kind("held by", [true, false, false, true]);
        let others = kind("held by", [false, true, true, false]);
        let none = || kind("held by", [false; 4]);
        let kinds = Kinds {
            by_route: vec![mouth, others, none(), none(), none()],
            by_input: vec![kind("age", [false, true, false, false])],
            observed: Some([0.4, 0.4, 0.2, 0.0, 0.0]),
        };
        let found = curve(Part::Rope, "unbreakable", &needed, &held, &simulated, &kinds);
        let check = |values: &[f64], expected: [(u32, f64); 4]| {
            for (lbf, share) in expected {
                let found = values[((lbf - FROM_LBF) as usize) / STEP_LBF];
                assert!((found - share).abs() < 1e-12, "{lbf} lbf: {found}, not {share}");
            }
        };
        check(&found.parts.shares, [(400, 0.75), (600, 0.5), (2000, 0.25), (3000, 0.0)]);
        let third = 1.0 / 3.0;
        let given_held = [(400, 1.0), (600, 2.0 * third), (2000, third), (3000, 0.0)];
        check(&found.parts_given_held.shares, given_held);
        check(&found.held, [(400, 0.0), (700, 0.25), (2000, 0.75), (3000, 0.75)]);
        assert_eq!((found.parts.encounters, found.parts_given_held.encounters), (4, 3));
        // Of three held whales, rope of 600 to 1,000 lbf parts on two, of 1,700 lbf on one, of 2,600 lbf on none.
        let counts = |of: fn(&AskedStrength) -> &Rate| -> Vec<(u64, u64)> {
            found.asked.iter().map(|asked| (of(asked).hits, of(asked).runs)).collect()
        };
        assert_eq!(counts(|asked| &asked.parts), [(2, 3), (2, 3), (1, 3), (0, 3)]);
        assert_eq!(counts(|asked| &asked.parts_alone), [(2, 3), (2, 3), (1, 3), (0, 3)]);
        assert!((found.parts.half_width - (40.0_f64.ln() / 8.0).sqrt()).abs() < 1e-12);
        let counts = |kind: &HeldKind| -> Vec<(u64, u64)> {
            kind.parts.iter().map(|parts| (parts.hits, parts.runs)).collect()
        };
        assert_eq!(counts(&found.by_route[0]), [(0, 1); 4]);
        assert_eq!(counts(&found.by_route[1]), [(2, 2), (2, 2), (1, 2), (0, 2)]);
        assert_eq!(counts(&found.by_input[0]), [(1, 1), (1, 1), (0, 1), (0, 1)]);
        // Half of the observed whales are held like the first, half like the next two; nothing is known of the third route.
        let weighted = |place: usize| found.asked[place].weighted.unwrap();
        assert!(
            (weighted(0).share - 0.5).abs() < 1e-12 && (weighted(0).covered - 0.8).abs() < 1e-12
        );
        assert!((weighted(2).share - 0.25).abs() < 1e-12);
    }

    /// Needed strengths of an exponential law, alone and with weights that depend on them: the whole curve is inside its band.
    #[test]
    fn the_band_covers_the_whole_curve() {
        let strengths_n: Vec<f64> = (0..200).map(|place| 0.02 * f64::from(place)).collect();
        for (weighted, expected) in [(false, 0.93..=0.97), (true, 0.93..=1.0)] {
            let mut draws = Draws::of("strength curve");
            let mut uniform = || (draws.below(1 << 30) as f64 + 0.5) / f64::from(1 << 30);
            let studies = 2000;
            let covers = |_: &u32| {
                let encounter = |_| {
                    // Drawn with mean 2 instead of 1: the weight is the ratio of the densities.
                    let mean = if weighted { 2.0 } else { 1.0 };
                    let needed = -mean * uniform().ln();
                    (needed, mean * (-needed + needed / mean).exp())
                };
                let needed: Vec<(f64, f64)> = (0..200).map(encounter).collect();
                let found = Banded::of(&needed, &strengths_n);
                strengths_n.iter().enumerate().all(|(place, strength)| {
                    let [low, high] = found.band(place);
                    (low..=high).contains(&(-strength).exp())
                })
            };
            let share = f64::from((0..studies).filter(covers).count() as u32) / f64::from(studies);
            println!("weighted {weighted}: {share}");
            assert!(expected.contains(&share), "weighted {weighted}: {share}");
        }
    }

    #[test]
    fn a_study_without_encounters_has_a_curve_that_knows_nothing() {
        let none = Banded::of(&[], &[1.0]);
        assert_eq!((none.encounters, none.band(0)), (0, [0.0, 1.0]));
        let missing =
            EventIndicators(vec![None, Some(EventIndicator { occurred: true, weight: 1.0 })]);
        let needed = [None, Some((5.0, 1.0))];
        let found = curve(Part::Link, "unbreakable", &needed, &missing, &[], &Kinds::default());
        assert_eq!((found.parts.encounters, found.held.len()), (1, 0));
    }
}
