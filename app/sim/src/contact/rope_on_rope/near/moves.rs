//! How far rope may move without crossing rope, and what a move changes in the bounds of distance.

use glam::DVec3;

use crate::broad_phase::pieces::Pieces;
use crate::contact::rope_on_rope::near::{Pair, RopeOnRope, TOUCH_M, between};
use crate::geometry::crossing::first_crossing;
use crate::geometry::segment_pair::{greatest_approach, nearest, safe_fraction};
use crate::geometry::sweep::{SweptSegment, walk};
use crate::model::Model;
use crate::state::State;

/// Distance of rope from its drift up to which a straight piece stayed straight, as a share of the shortest segment.
const STRAIGHT_SHARE: f64 = 0.125;

/// Share of their contact distance to which ropes may approach by their velocities before the predictor is projected.
const HELD_OFF_SHARE: f64 = 0.3;

/// Largest relative move of a knot and rope in a step, as a share of their contact distance: a knot that passes rope within a step would
/// feel no force at either end of it.
const FOLLOWED_SHARE: f64 = 0.5;

impl RopeOnRope {
    /// Checks the straight path of a step; returns the number of crossings that an exact test finds, `None` if ropes may cross.
    pub fn end(&self, from: &[DVec3], to: &[DVec3]) -> Option<u64> {
        let mut crossings = 0;
        let reach_m = greatest_approach_m(from, to);
        for pair in self.pairs_within(reach_m) {
            let [one, other] = pair.sweeps(from, |node| to[node]);
            if pair.is_of_knot() && !pair.is_followed(&one, &other) {
                return None;
            }
            if pair.first - pair.min_separation > greatest_approach(&one, &other) {
                continue;
            }
            if safe_fraction(&one, &other, pair.min_separation, pair.first) < 1.0 {
                return None;
            }
            crossings += u64::from(!pair.is_of_knot() && first_crossing(&one, &other).is_some());
        }
        Some(crossings)
    }

    /// Removes from the move `from` -> `target` the part that brings ropes closer than their contact distance, or than they are.
    pub fn hold_off(&self, from: &[DVec3], target: &mut [DVec3]) {
        let mut reach_m = greatest_approach_m(from, target);
        for (pair, room_m) in self.pairs.iter().zip(&self.room_m) {
            if *room_m > reach_m {
                continue;
            }
            let [one, other] = pair.sweeps(from, |node| target[node]);
            if pair.first - greatest_approach(&one, &other) > HELD_OFF_SHARE * pair.contact_distance
            {
                continue;
            }
            let (fractions, distance) = {
                let nearest = nearest(one.at(0.0), other.at(0.0));
                (nearest.fractions, nearest.distance)
            };
            let (before, _) = between(one.at(0.0), other.at(0.0), fractions);
            let (after, _) = between(one.at(1.0), other.at(1.0), fractions);
            let normal = before / distance.max(1e-12);
            let approach = normal.dot(before - after);
            let too_near = approach - (distance - pair.contact_distance).max(0.0);
            if too_near > 0.0 {
                for (node, sign) in pair.nodes.into_iter().zip([0.5, -0.5]) {
                    target[node] += normal * (sign * too_near);
                    target[node + 1] += normal * (sign * too_near);
                    let moved = node..node + 2;
                    reach_m =
                        reach_m.max(greatest_approach_m(&from[moved.clone()], &target[moved]));
                }
            }
        }
    }

    /// Whether free rope that was moved by this much from its drift may have met rope on its way to these places.
    pub fn met(&mut self, model: &Model, state: &State, pieces: &Pieces, to: &[DVec3]) -> bool {
        self.met_known(&state.rope.position, to);
        self.gather_to(model, state, pieces, |node| to[node], TOUCH_M);
        self.touching
    }

    /// Whether gathered pairs may touch, if rope is too close to its drift to have reached others.
    pub fn met_known(&mut self, from: &[DVec3], to: &[DVec3]) -> bool {
        self.touching = self.met_gathered(from, to);
        self.touching
    }

    /// Distance of rope from its drift up to which it has met nothing that was not gathered: two ropes that both move so far still have
    /// more than [`TOUCH_M`] between them [m].
    pub fn unwatched_m(&self) -> f64 {
        if self.law.is_none() {
            f64::INFINITY
        } else {
            (0.5 * (self.margin_m - TOUCH_M)).min(STRAIGHT_SHARE * self.shortest_m)
        }
    }

    fn met_gathered(&self, from: &[DVec3], to: &[DVec3]) -> bool {
        let near = |pair: &Pair| {
            let [one, other] = pair.sweeps(from, |node| to[node]);
            pair.first - greatest_approach(&one, &other) < pair.contact_distance
        };
        self.pairs_within(greatest_approach_m(from, to)).any(near)
    }

    /// Pairs that may touch when they approach each other by this much [m].
    fn pairs_within(&self, approach_m: f64) -> impl Iterator<Item = &Pair> {
        let within =
            self.pairs.iter().zip(&self.room_m).filter(move |(_, room)| **room <= approach_m);
        within.map(|(pair, _)| pair)
    }
}

/// Distance by which any two places of rope approach each other at most when its nodes move so [m].
pub(super) fn greatest_approach_m(from: &[DVec3], to: &[DVec3]) -> f64 {
    let moved = from.iter().zip(to).map(|(from, to)| from.distance_squared(*to));
    2.0 * moved.fold(0.0, f64::max).sqrt()
}

impl Pair {
    /// Whether a step follows how a knot meets rope: it moves little relative to it, or does not touch it on its way.
    fn is_followed(&self, one: &SweptSegment, other: &SweptSegment) -> bool {
        let (reach, approach) = (self.contact_distance, greatest_approach(one, other));
        if approach <= FOLLOWED_SHARE * reach || self.first - approach > reach {
            return true;
        }
        let apart = |at: f64| nearest(one.at(at), other.at(at)).distance;
        self.first > reach && walk(self.first, reach, approach, apart) >= 1.0
    }
}
