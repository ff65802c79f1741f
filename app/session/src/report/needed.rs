//! Strength needed in a run: the least strength with which nothing parts.
//!
//! A segment parts at `S f v`, with `S` the mean delivered strength of its line at its weakest place, `f ≥ 1` the strength of the segment's
//! place over that of the weakest, and `v` the drawn strength over the mean. With the greatest tension `T` of each place,
//!
//! ```text
//! S_needed = max over lines and places of T / (f v)
//! ```
//!
//! Lines that all deliver more have this run to the bit (`study/equivalence.rs`); if they all deliver less, one parts. The same holds for
//! the mean rating of weak links and the strength of weak places, with `f = 1`. In a run in which something parted, tensions after it
//! belong to the parted gear.

use endline_gear::{StrengthBudget, WEAK_PLACES};
use endline_sim::metrics::{LineSummary, LinkSummary, Summary};
use endline_sim::model::Line;
use endline_sim::{Model, ModelSpec};

/// Strengths needed in a run [N].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NeededStrength {
    /// Strength that every line must deliver at its weakest place.
    pub needed_rope_n: Option<f64>,
    /// Mean rating that every weak link must have.
    pub needed_link_n: Option<f64>,
    /// Strength that the weak places of every line must have; `None` if no line has any.
    pub needed_place_n: Option<f64>,
}

impl NeededStrength {
    /// Strengths needed in a run with this summary, with the drawn strengths of its budgets.
    pub fn of(model: &Model, summary: &Summary, budgets: &[StrengthBudget]) -> Self {
        let ModelSpec { lines, .. } = &model.spec;
        let drawn = |id: &str| {
            budgets.iter().find(|budget| budget.part == id).map_or(1.0, |budget| budget.drawn)
        };
        let of_line =
            |(borne, line): (&LineSummary, &Line)| needed_of(borne, line) / drawn(&line.id);
        let of_link =
            |link: &LinkSummary| link.peak_tension_n.max(link.unconverged_peak_n) / drawn(&link.id);
        let of_places = |(borne, line): (&LineSummary, &Line)| {
            let peaks = line.weak_places.iter().map(|place| borne.peak_near_n(place.at_m));
            Some(peaks.reduce(f64::max)? / drawn(&format!("{}.{WEAK_PLACES}", line.id)))
        };
        Self {
            needed_rope_n: summary.lines.iter().zip(lines).map(of_line).reduce(f64::max),
            needed_link_n: summary.links.iter().map(of_link).reduce(f64::max),
            needed_place_n: summary.lines.iter().zip(lines).filter_map(of_places).reduce(f64::max),
        }
    }
}

/// Strength that a line must have at its weakest place to hold its greatest tensions [N].
pub(super) fn needed_of(borne: &LineSummary, line: &Line) -> f64 {
    let left = [line.strength.end_a, 1.0, line.strength.end_b];
    let weakest = left.into_iter().fold(1.0, f64::min);
    let places = borne.place_peaks_n.iter().zip(left);
    places.map(|(peak_n, left)| peak_n * weakest / left).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use endline_fixtures::gear::{fixed, line, model, water};
    use endline_sim::DVec3;
    use endline_sim::metrics::TENSION_BIN_M;
    use endline_sim::model::{Settings, Strength, WeakPlace};

    use super::*;
    use crate::figures::tests::made_up;

    /// A line that delivers a little more than it needs holds at every place, and one that delivers a little less does not.
    #[test]
    fn a_line_that_delivers_the_needed_strength_just_holds() {
        for (places, end_a, end_b) in [
            ([50.0, 90.0, 70.0], 0.9, 0.7),
            ([50.0, 120.0, 70.0], 0.9, 0.7),
            ([95.0, 90.0, 1.0], 0.8, 1.0),
        ] {
            let spec =
                Line { strength: Strength { all: 0.8, end_a, end_b }, ..line("line", 30.0, 3) };
            let mut borne = made_up::report().summary.lines[0].clone();
            borne.place_peaks_n = places;
            let needed_n = needed_of(&borne, &spec);
            let holds = |delivered_n: f64| {
                let along_n = delivered_n / end_a.min(end_b).min(1.0);
                let strengths = [along_n * end_a, along_n, along_n * end_b];
                places.iter().zip(strengths).all(|(peak, strength)| *peak <= strength)
            };
            assert!(
                holds(1.0001 * needed_n) && !holds(0.9999 * needed_n),
                "{places:?}: {needed_n}"
            );
        }
    }

    /// Weak places need the greatest tension where they lie; lines without any need none.
    #[test]
    fn weak_places_need_the_tension_at_their_lengths() {
        let mut report = made_up::report();
        report.summary.lines.truncate(1);
        report.summary.lines[0].bin_peaks_n = vec![10.0, 40.0, 20.0, 30.0];
        let ends = [0.0, 2.0].map(|x_m| fixed("end", DVec3::new(x_m, 0.0, -1.0)));
        let lines = vec![line("line", 4.0 * TENSION_BIN_M, 4)];
        let model =
            model(water(1025.0, 0.0), ends.to_vec(), lines, Vec::new(), Settings::default());
        let needed_n =
            |model: &Model| NeededStrength::of(model, &report.summary, &[]).needed_place_n;
        assert_eq!(needed_n(&model), None);
        let mut spec = model.spec.clone();
        let place = |at_m: f64| WeakPlace { at_m, strength_n: 1.0 };
        spec.lines[0].weak_places = vec![place(0.1 * TENSION_BIN_M), place(2.9 * TENSION_BIN_M)];
        assert_eq!(needed_n(&Model::new(spec).unwrap()), Some(20.0));
    }
}
