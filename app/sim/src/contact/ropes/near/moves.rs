//! How far rope may move without crossing rope, and what a move does to the bounds of distance.

use glam::DVec3;

use super::{Pair, RopeWorkspace, TOUCH_M, sweep_of};
use crate::contact::crossing::first_crossing;
use crate::contact::ropes::sweep::{greatest_approach, nearest, safe_fraction};
use crate::model::Model;
use crate::state::State;

/// Rope that moved less than this from its drift has met nothing but what was gathered: two ropes less than the margin [m].
const UNWATCHED_M: f64 = 0.014;

/// That move as a share of the shortest segment, so that a straight piece stayed straight.
const UNWATCHED_SHARE: f64 = 0.125;

impl RopeWorkspace {
    /// Largest share of the move `places` → `target` along which no ropes cross.
    pub fn safe_share(&self, places: &[DVec3], target: impl Fn(usize) -> DVec3) -> f64 {
        let share_of = |pair: &Pair| {
            let [one, other] = pair.nodes.map(|node| sweep_of(node, places, &target));
            if pair.gap_bound - pair.min_separation > greatest_approach(&one, &other) {
                return 1.0;
            }
            safe_fraction(
                &one,
                &other,
                pair.min_separation,
                nearest(one.at(0.0), other.at(0.0)).distance,
            )
        };
        self.pairs.iter().map(share_of).fold(1.0, f64::min)
    }

    /// Makes the move `places` → `target`: bounds of distance shrink by what moved, and an exact test counts crossings on the way.
    pub fn make_move(&mut self, places: &[DVec3], target: impl Fn(usize) -> DVec3) {
        for pair in &mut self.pairs {
            let [one, other] = pair.nodes.map(|node| sweep_of(node, places, &target));
            let approach = greatest_approach(&one, &other);
            if pair.gap_bound - approach > pair.contact_distance {
                pair.gap_bound -= approach;
                continue;
            }
            pair.gap_bound = nearest(one.at(1.0), other.at(1.0)).distance;
            self.crossings += u64::from(first_crossing(&one, &other).is_some());
        }
    }

    /// Whether free rope that was moved by this much from its drift may have met rope on its way to these places.
    pub fn met(&mut self, model: &Model, state: &State, to: &[DVec3]) -> bool {
        self.touching = self.met_gathered(&state.rope.position, to);
        self.gather_to(model, state, |node| to[node], TOUCH_M);
        self.touching
    }

    /// Move from the drift up to which rope that was not gathered has met nothing [m].
    pub fn unwatched_m(&self) -> f64 {
        if self.law.is_none() {
            f64::INFINITY
        } else {
            UNWATCHED_M.min(UNWATCHED_SHARE * self.shortest_m)
        }
    }

    fn met_gathered(&self, from: &[DVec3], to: &[DVec3]) -> bool {
        let near = |pair: &Pair| {
            let [one, other] = pair.nodes.map(|node| sweep_of(node, from, &|node| to[node]));
            pair.first - greatest_approach(&one, &other) < pair.contact_distance
        };
        self.pairs.iter().any(near)
    }
}
