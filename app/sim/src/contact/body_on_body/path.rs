//! Whether a solver step takes two bodies through each other, or farther past each other than it can follow.

use crate::contact::body_on_body::{BodyOnBody, Pair};
use crate::geometry::Pose;
use crate::geometry::core::BodyCore;
use crate::geometry::sweep::walk;
use crate::state::State;

/// Share of their contact distance by which two cores may be closer on their path than at both of its ends. Without this limit, bodies
/// that pass each other within a step would feel no force at either end.
const DIP_SHARE: f64 = 0.1;
/// Least share of their contact distance at the end of a step; bodies that begin closer may approach to this share of their distance.
const PINCHED_SHARE: f64 = 0.3;
const STILL_SHARE: f64 = 0.9;
/// Share of their contact distance by which bodies may move relative to each other in a step in which they touch: a blow takes a few steps.
const FOLLOWED_SHARE: f64 = 0.5;

impl BodyOnBody {
    /// The first pair of bodies whose cores come too close on their path to these poses, or that move too far relative to each other.
    pub fn meeting(&self, state: &State, pose: impl Fn(usize) -> Pose) -> Option<[usize; 2]> {
        let refused = |(index, pair): &(usize, &Pair)| {
            let paths =
                pair.bodies.map(|thing| [self.began(state, thing), self.pose(thing, &pose)]);
            !self.is_free(*index, &paths)
        };
        self.pairs.iter().enumerate().find(refused).map(|(_, pair)| pair.bodies)
    }

    fn is_free(&self, index: usize, paths: &[[Pose; 2]; 2]) -> bool {
        let pair = &self.pairs[index];
        let [first, second] = pair.parts.map(|part| &self.cores[part]);
        let turn = |core: &BodyCore, [from, to]: &[Pose; 2]| {
            let is_still = core.thing >= self.count;
            let angle = || from.orientation.angle_between(to.orientation);
            if is_still { 0.0 } else { angle() * core.radius }
        };
        let turns = [turn(first, &paths[0]), turn(second, &paths[1])];
        let [one_m, two_m] = [0, 1].map(|k| paths[k][1].place - paths[k][0].place);
        let approach = (one_m - two_m).length() + turns[0] + turns[1];
        let reach = self.reach_of(index);
        if pair.gap - approach > reach {
            return true;
        }
        let apart = |at: f64| {
            let [one, two] = paths.map(|path| between(&path, at));
            first.nearest_to(&one, second, &two).map_or(0.0, |[a, b]| a.distance(b))
        };
        let end = apart(1.0);
        if end < (PINCHED_SHARE * reach).min(STILL_SHARE * pair.gap) {
            return false;
        }
        let touches = || pair.gap.min(end) < reach || walk(pair.gap, reach, approach, apart) < 1.0;
        if approach > FOLLOWED_SHARE * reach && touches() {
            return false;
        }
        let keep = pair.gap.min(end).min(reach) - DIP_SHARE * reach;
        walk(pair.gap, keep.max(0.0), approach, apart) >= 1.0
    }
}

/// A pose between two.
fn between([from, to]: &[Pose; 2], at: f64) -> Pose {
    Pose {
        place: from.place.lerp(to.place, at),
        orientation: from.orientation.slerp(to.orientation, at),
    }
}
