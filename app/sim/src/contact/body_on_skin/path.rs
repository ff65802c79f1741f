//! Whether a solver step takes a body through skin.
//!
//! Body and skin go from where the step begins to where it ends: the body's place straight, its rotation evenly, each corner of skin straight.
//! The path is proved free by steps of time that the distance of the core and the greatest possible approach allow (`sweep.rs`), and
//! checked by an exact test of the core's axis that knows nothing of distances (`crossing.rs`).

use crate::contact::body_on_skin::{BodyOnSkin, NearPart, Pair};
use crate::contact::failure::Reason;
use crate::geometry::Pose;
use crate::geometry::crossing::first_meeting;
use crate::geometry::placed::on_triangle;
use crate::geometry::sweep::{SweptSegment, triangle_at, walk};
use crate::state::State;

/// Share of its contact distance that a core keeps from skin on its path, and below which it is overcompressed at the end of a step.
const KEPT_SHARE: f64 = 0.1;
const PINCHED_SHARE: f64 = 0.2;
/// A body that begins a step pinched may end it this much nearer to skin, as a share.
const STILL_PINCHED: f64 = 0.99;
/// Share of the contact distance to which a guess may bring a core.
const HELD_OFF_SHARE: f64 = 0.6;

impl BodyOnSkin {
    /// Ends a solver step at these poses where every path is free; the number of crossings that an exact test finds.
    pub fn end_path(
        &mut self,
        state: &State,
        pose: impl Fn(usize) -> Pose,
    ) -> Result<u64, ([usize; 2], Reason)> {
        let share = self.goal - self.start;
        let mut crossings = 0;
        for place in 0..self.near.len() {
            let near = &self.near[place];
            let core = &self.cores[near.part];
            let poses = [Pose::of(&state.bodies[near.body]), pose(near.body)];
            let own_m = own_move(&poses, core.radius);
            if near.moved + own_m > near.room {
                return Err(([near.body, 0], Reason::LeftSearchMargin));
            }
            if !self.swept {
                crossings += self.crossings_of(near, &poses);
                self.near[place].moved += own_m;
                continue;
            }
            for index in near.pairs.clone() {
                let pair = self.pairs[index];
                let approach = own_m + near.skin_move * share;
                if pair.gap - approach > core.reach {
                    self.pairs[index].gap = pair.gap - approach;
                } else if pair.active {
                    crossings += u64::from(self.crosses(near, &pair, &poses));
                    let gap = self.proved(near, &pair, &poses, approach);
                    let through = ([near.body, pair.triangle as usize], Reason::PassedThrough);
                    self.pairs[index].gap = gap.ok_or(through)?;
                } else {
                    return Err(([near.body, pair.triangle as usize], Reason::PathNotProved));
                }
            }
            self.near[place].moved += own_m;
        }
        self.fraction = self.goal;
        Ok(crossings)
    }

    /// Distance of a core from a triangle at the end of a path that is proved free and leaves nothing pinched.
    fn proved(
        &self,
        near: &NearPart,
        pair: &Pair,
        poses: &[Pose; 2],
        approach: f64,
    ) -> Option<f64> {
        let reach = self.cores[near.part].reach;
        if !self.is_free(near, pair, poses, approach) {
            return None;
        }
        let gap = self.distance_at(near, pair, poses, 1.0);
        let pinched = gap < PINCHED_SHARE * reach && gap < STILL_PINCHED * pair.gap;
        (!pinched).then_some(gap)
    }

    fn is_free(&self, near: &NearPart, pair: &Pair, poses: &[Pose; 2], approach: f64) -> bool {
        let keep = (KEPT_SHARE * self.cores[near.part].reach).min(0.5 * pair.gap);
        walk(pair.gap, keep, approach, |at| self.distance_at(near, pair, poses, at)) >= 1.0
    }

    /// Distance of a core from a triangle at a share of the solver step; zero where they meet.
    fn distance_at(&self, near: &NearPart, pair: &Pair, [from, to]: &[Pose; 2], at: f64) -> f64 {
        let pose = Pose {
            place: from.place.lerp(to.place, at),
            orientation: from.orientation.slerp(to.orientation, at),
        };
        let corners = triangle_at(&pair.sweep, self.start + (self.goal - self.start) * at);
        let nearest = self.cores[near.part].nearest(&pose, corners);
        nearest.map_or(0.0, |nearest| nearest.distance)
    }

    /// Crossings found on the path of a body with all skin near it.
    fn crossings_of(&self, near: &NearPart, poses: &[Pose; 2]) -> u64 {
        let pairs = self.pairs[near.pairs.clone()].iter();
        pairs.filter(|pair| self.crosses(near, pair, poses)).count() as u64
    }

    fn crosses(&self, near: &NearPart, pair: &Pair, poses: &[Pose; 2]) -> bool {
        let [[a0, b0], [a1, b1]] = [0, 1].map(|k| self.cores[near.part].axis(&poses[k]));
        let triangle = [self.start, self.goal].map(|share| triangle_at(&pair.sweep, share));
        first_meeting(&SweptSegment { a0, b0, a1, b1 }, &triangle).is_some()
    }

    /// The predictor, or a better one if its path leads into skin: the body moves with the nearest skin, or stays.
    pub fn held_off(&self, state: &State, body: usize, guess: Pose) -> Pose {
        let from = Pose::of(&state.bodies[body]);
        if !self.swept || self.all_may_go(body, &[from, guess]) {
            return guess;
        }
        let parts = self.near.iter().filter(|near| near.body == body);
        let pairs = parts.flat_map(|near| {
            let pairs = self.pairs[near.pairs.clone()].iter().filter(|pair| pair.active);
            pairs.map(move |pair| (near, pair))
        });
        let nearest = pairs.min_by(|(_, one), (_, other)| one.gap.total_cmp(&other.gap));
        let Some((near, pair)) = nearest else {
            return guess;
        };
        let corners = triangle_at(&pair.sweep, self.start);
        let Some(nearest) = self.cores[near.part].nearest(&from, corners) else { return guess };
        let [start, end] = pair.sweep;
        let moves = [0, 1, 2].map(|corner| end[corner] - start[corner]);
        let skin_move = on_triangle(moves, nearest.barycentric) * (self.goal - self.start);
        let along = Pose { place: from.place + skin_move, ..from };
        if self.all_may_go(body, &[from, along]) { along } else { from }
    }

    /// Whether every part of a body may go along a path.
    fn all_may_go(&self, body: usize, poses: &[Pose; 2]) -> bool {
        let mut parts = self.near.iter().filter(|near| near.body == body);
        parts.all(|near| self.may_go(near, poses))
    }

    /// Whether a path of a part is free and ends well off skin, or no nearer than it began.
    fn may_go(&self, near: &NearPart, poses: &[Pose; 2]) -> bool {
        let core = &self.cores[near.part];
        let approach = own_move(poses, core.radius) + near.skin_move * (self.goal - self.start);
        self.pairs[near.pairs.clone()].iter().filter(|pair| pair.active).all(|pair| {
            let least = (HELD_OFF_SHARE * core.reach).min(pair.gap);
            pair.gap - approach > least
                || (self.is_free(near, pair, poses, approach)
                    && self.distance_at(near, pair, poses, 1.0) >= 0.999 * least)
        })
    }
}

/// How far any place within a radius of a body's place moves between two poses, at most [m].
fn own_move([from, to]: &[Pose; 2], radius: f64) -> f64 {
    from.place.distance(to.place) + from.orientation.angle_between(to.orientation) * radius
}
