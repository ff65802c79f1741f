//! What an option does for whales that are held with the baseline.
//!
//! A rate given an encounter mixes how often a whale is held, which depends on assumed behaviour, with what the gear does once it is
//! held. Here the two are separate. With `H` the encounters with the event under the baseline, `w` their weights and `x` 1 where the
//! option's run has not the event, the share freed is
//!
//! ```text
//! p = Σ_H w x / Σ_H w            P = Σ_r q_r p_r
//! ```
//!
//! Both runs are of the same encounter, so that `p` needs no further pairing; its interval is that of a rate (`interval.rs`).
//! `p_r` is the share on route `r` of attachment ([`Route`]), and `q_r` the share of the route among observed whales (post-stratification).
//! The interval of `P` follows from those of `p_r` by the squares of their arms: `P ± √Σ q_r² (p_r - end_r)²`. Where no simulated whale
//! is held by a route, the other `q_r` are scaled to a sum of 1, and `covered` is their sum before.
//! References: Holt and Smith 1979 (doi:10.2307/2344652); Zou and Donner 2008 (doi:10.1002/sim.3095).

use endline_gear::{HOOKED_TURNS, ObservedRoutes, StudyEvent};
use endline_sdk::{BodyPart, Limb};
use schemars::JsonSchema;
use serde::Serialize;
use strum::IntoStaticStr;

use crate::study::runs::{RunRow, Runs};

use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate};

/// Where rope holds a whale at the end of a run.
#[derive(Clone, Copy, Debug, Eq, IntoStaticStr, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum Route {
    /// Lodged in the mouth, or half a turn about the head.
    Mouth,
    /// Half a turn about a flipper or the body.
    Flipper,
    /// Half a turn about the peduncle or a fluke.
    Tail,
    /// At least two of these.
    Several,
    /// None of these: rope lies on the whale.
    Loose,
}

impl Route {
    /// All routes, in the order of a report.
    pub const ALL: [Self; 5] = [Self::Mouth, Self::Flipper, Self::Tail, Self::Several, Self::Loose];

    /// Words for a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::Mouth => "mouth or head",
            Self::Flipper => "flipper or body",
            Self::Tail => "tail",
            Self::Several => "several places",
            Self::Loose => "no turn",
        }
    }

    /// The route by the places with rope: mouth, flipper, tail.
    pub(super) fn by_places(places: [bool; 3]) -> Self {
        match places {
            [false, false, false] => Self::Loose,
            [true, false, false] => Self::Mouth,
            [false, true, false] => Self::Flipper,
            [false, false, true] => Self::Tail,
            _ => Self::Several,
        }
    }

    /// The route at the end of a run.
    pub(in crate::study) fn of(run: &RunRow) -> Self {
        let turned = |is_it: fn(BodyPart) -> bool| {
            let parts = BodyPart::ALL.into_iter().filter(|part| is_it(*part));
            let turns = parts.filter_map(|part| run.parts.get(part as usize)?.wraps);
            turns.fold(0.0, f64::max) >= HOOKED_TURNS
        };
        let is_tail = |part: BodyPart| part == BodyPart::Peduncle || part.limb() == Limb::Fluke;
        Self::by_places([
            run.lodged_in_mouth || turned(|part| part == BodyPart::Head),
            turned(|part| part == BodyPart::Body || part.limb() == Limb::Flipper),
            turned(is_tail),
        ])
    }
}

/// What each option does for the whales that are held with the baseline.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct HeldWhales {
    /// The event by which a whale counts as held.
    pub event: String,
    /// Rate of the event with the baseline, given an encounter.
    pub rate: Rate,
    /// The routes by which whales are held with the baseline.
    pub routes: Vec<RouteFinding>,
    /// Source of the observed shares of routes; `None` without any.
    pub observed_from: Option<String>,
    /// The options except for the baseline.
    pub options: Vec<OptionOnHeld>,
}

/// A route by which whales are held with the baseline.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct RouteFinding {
    /// The route.
    pub route: Route,
    /// Its share among the whales held with the baseline.
    pub share: Rate,
    /// Its share among observed whales.
    pub observed: Option<f64>,
}

/// An option, for the whales held with the baseline.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct OptionOnHeld {
    /// Id.
    pub id: String,
    /// Name.
    pub name: String,
    /// Share that the option does not hold.
    pub freed: Rate,
    /// Encounters in which it holds a whale that the baseline does not.
    pub newly_held: u64,
    /// Their weight as a share of that of the whales held with the baseline.
    pub newly_held_share: f64,
    /// Share that the option does not hold by route, in the order of the routes.
    pub freed_by_route: Vec<Rate>,
    /// Share that it does not hold, weighted by the observed shares of routes.
    pub weighted: Option<Weighted>,
}

/// A share weighted by observed shares of routes.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Weighted {
    /// The share.
    pub share: f64,
    /// Its interval.
    pub interval: Interval,
    /// Sum of the observed shares of the routes by which a simulated whale is held.
    pub covered: f64,
}

/// Shares of the routes among observed whales, by [`Route::ALL`]; their sum is 1.
pub(super) fn observed_shares(observed: &ObservedRoutes) -> [f64; 5] {
    let ObservedRoutes { mouth, flipper, tail, several, .. } = observed;
    let counts = [*mouth, *flipper, *tail, *several, 0];
    let all: u64 = counts.iter().sum();
    counts.map(|count| count as f64 / all as f64)
}

impl HeldWhales {
    /// Analyses the options of a study against `baseline`; `None` if the event does not say that a whale is held.
    pub(super) fn of(
        runs: &Runs,
        options: &[(String, String)],
        baseline: usize,
        event: &StudyEvent,
        observed: Option<&ObservedRoutes>,
    ) -> Option<Self> {
        if !event.is_held() {
            return None;
        }
        let indicators = |option: &str| EventIndicators::of(runs, option, event);
        let (id, _) = options.get(baseline)?;
        let own = indicators(id);
        let routes = runs.by_encounter(id, |run| Some(Route::of(run)));
        let others = options.iter().enumerate().filter(|(place, _)| *place != baseline);
        let shares = observed.map(observed_shares);
        let on_route = |route: Route| {
            let held = own.0.iter().zip(&routes).map(|(indicator, known)| {
                let held = indicator.filter(|indicator| indicator.occurred)?;
                Some(EventIndicator { occurred: *known == Some(route), weight: held.weight })
            });
            Rate::among(&EventIndicators(held.collect()))
        };
        Some(Self {
            event: event.name(),
            rate: Rate::of(&own),
            routes: Route::ALL
                .map(|route| RouteFinding {
                    route,
                    share: on_route(route),
                    observed: shares.map(|shares| shares[route as usize]),
                })
                .into(),
            observed_from: observed.map(|observed| observed.source.clone()),
            options: others
                .map(|(_, (id, name))| {
                    option_on_held(id, name, [&indicators(id), &own], &routes, shares)
                })
                .collect(),
        })
    }
}

fn option_on_held(
    id: &str,
    name: &str,
    [this, baseline]: [&EventIndicators; 2],
    routes: &[Option<Route>],
    observed: Option<[f64; 5]>,
) -> OptionOnHeld {
    let (freed, newly) = (baseline.absent_in(this), this.absent_in(baseline));
    let weight_of = |indicators: &EventIndicators| {
        let values = indicators.values();
        values.iter().map(|(occurred, weight)| occurred * weight).sum::<f64>()
    };
    let held: f64 = freed.values().iter().map(|(_, weight)| weight).sum();
    let on = |route: Route| {
        let keep: Vec<bool> = routes.iter().map(|known| *known == Some(route)).collect();
        Rate::among(&freed.within(&keep))
    };
    let freed_by_route: Vec<Rate> = Route::ALL.map(on).into();
    OptionOnHeld {
        id: id.to_owned(),
        name: name.to_owned(),
        freed: Rate::among(&freed),
        newly_held: Rate::of(&newly).hits,
        newly_held_share: if held > 0.0 { weight_of(&newly) / held } else { 0.0 },
        weighted: observed.and_then(|shares| Weighted::of(&freed_by_route, &shares)),
        freed_by_route,
    }
}

impl Weighted {
    /// Rates by stratum, weighted by the shares of the strata; `None` if no stratum with a share has a run.
    pub(super) fn of(rates: &[Rate], shares: &[f64]) -> Option<Self> {
        debug_assert_eq!(rates.len(), shares.len(), "a share for each stratum");
        let known = || rates.iter().zip(shares).filter(|(rate, _)| rate.runs > 0);
        let covered: f64 = known().map(|(_, share)| share).sum();
        if covered <= 0.0 {
            return None;
        }
        let sum = |of: &dyn Fn(&Rate, f64) -> f64| {
            known().map(|(rate, share)| of(rate, share / covered)).sum::<f64>()
        };
        let square = |value: f64| value * value;
        let share = sum(&|rate, share| share * rate.rate);
        let below = sum(&|rate, share| square(share * (rate.rate - rate.interval.low))).sqrt();
        let above = sum(&|rate, share| square(share * (rate.interval.high - rate.rate))).sqrt();
        let interval = Interval { low: (share - below).max(0.0), high: (share + above).min(1.0) };
        Some(Self { share, interval, covered })
    }
}

#[cfg(test)]
mod tests {
    use super::super::bootstrap::Draws;
    use super::*;
    use crate::study::runs::PartRow;

    /// A run that is held by these places, or shed.
    fn run(encounter: u64, option: &str, held_by: Option<[bool; 3]>) -> RunRow {
        let mut parts = vec![PartRow::default(); BodyPart::ALL.len()];
        let [mouth, flipper, tail] = held_by.unwrap_or_default();
        for (is_there, part) in [(flipper, BodyPart::LeftFlipper), (tail, BodyPart::Peduncle)] {
            parts[part as usize].wraps = Some(if is_there { 1.2 } else { 0.1 });
        }
        RunRow {
            encounter,
            option: option.to_owned(),
            weight: 1.0,
            valid: true,
            outcome: if held_by.is_some() { "entangled" } else { "shed" }.to_owned(),
            lodged_in_mouth: mouth,
            parts,
            ..RunRow::default()
        }
    }

    const MOUTH: [bool; 3] = [true, false, false];
    const TAIL: [bool; 3] = [false, false, true];

    fn options() -> Vec<(String, String)> {
        ["strong", "weak"].map(|id| (id.to_owned(), id.to_owned())).into()
    }

    /// Ten encounters: the strong rope holds six, four by the mouth and two by the tail. The weak one frees three of the mouth's and holds another.
    #[test]
    fn counts_by_hand() {
        let strong = |n: u64| match n {
            0..4 => Some(MOUTH),
            4..6 => Some(TAIL),
            _ => None,
        };
        let weak = |n: u64| match n {
            0..3 => None,
            9 => Some(TAIL),
            n => strong(n),
        };
        let rows =
            (0..10).flat_map(|n| [run(n, "strong", strong(n)), run(n, "weak", weak(n))]).collect();
        let observed = ObservedRoutes {
            mouth: 25,
            flipper: 25,
            tail: 50,
            several: 0,
            source: "made up".into(),
        };
        let runs = Runs::of_rows(rows);
        let found =
            HeldWhales::of(&runs, &options(), 0, &StudyEvent::Entangled, Some(&observed)).unwrap();
        assert_eq!((found.rate.hits, found.rate.runs), (6, 10));
        let routes: Vec<u64> = found.routes.iter().map(|route| route.share.hits).collect();
        assert_eq!(routes, [4, 0, 2, 0, 0]);
        let weak = &found.options[0];
        assert_eq!((weak.freed.hits, weak.freed.runs, weak.newly_held), (3, 6, 1));
        assert!((weak.newly_held_share - 1.0 / 6.0).abs() < 1e-12);
        assert_eq!((weak.freed_by_route[0].hits, weak.freed_by_route[2].hits), (3, 0));
        // Mouth 3 of 4 with a share of 1/3, tail 0 of 2 with a share of 2/3 of what is covered.
        let weighted = weak.weighted.unwrap();
        assert!((weighted.share - 0.25).abs() < 1e-12 && (weighted.covered - 0.75).abs() < 1e-12);
        assert!(weighted.interval.low < 0.25 && weighted.interval.high > 0.4, "{weighted:?}");
        assert_eq!(HeldWhales::of(&runs, &options(), 0, &StudyEvent::Contact, None), None);
    }

    /// Two routes with known shares freed, of which the study meets the one too often.
    #[test]
    fn intervals_of_weighted_shares_cover_the_truth_whatever_the_study_meets() {
        let mut draws = Draws::of("post-stratified");
        let mut uniform = || draws.below(1 << 30) as f64 / f64::from(1 << 30);
        let (studies, shares, freed) = (2000, [0.3, 0.7], [0.8, 0.3]);
        let truth = shares[0] * freed[0] + shares[1] * freed[1];
        let covers = |_: &usize| {
            let mut counts = [[0_u64; 2]; 2];
            for _ in 0..80 {
                let route = usize::from(uniform() < 0.3);
                counts[route][usize::from(uniform() < freed[route])] += 1;
            }
            let rates = counts.map(|[held, freed]| Rate::from_counts(freed, held + freed));
            let Interval { low, high } = Weighted::of(&rates, &shares).unwrap().interval;
            (low..=high).contains(&truth)
        };
        let share = (0..studies).filter(covers).count() as f64 / studies as f64;
        assert!((0.93..=0.97).contains(&share), "{share}");
    }
}
