//! Opens contact points of pairs and lets them follow the ropes.

use glam::DVec3;

use crate::contact::rope_on_rope::near::moves::greatest_approach_m;
use crate::contact::rope_on_rope::near::{Pair, RopeOnRope, between};
use crate::contact::rope_on_rope::points::{RopeContactPoint, point_of_ball, points_of};
use crate::geometry::segment_pair::nearest;
use crate::state::{RopeGrip, State};

/// Largest move of a point along either rope in a step with which it continues a grip [m].
const FOLLOWED_M: f64 = 0.05;

/// Assemblies in which points follow the ropes; then they stay, so that Newton can finish.
const FOLLOWING_ASSEMBLIES: usize = 6;

/// Iteration since points were last opened in which they follow once more. Only short steps get so far; they take half moves from
/// there on.
const FOLLOWING_AGAIN: usize = 9;

/// Distance beyond contact within which points are opened, besides twice the way of the predictor [m].
const OPENED_WITHIN_M: f64 = 2e-3;

/// A place of a pair that is nearer than its points by this share calls for new ones.
const NEARER: f64 = 0.9;

impl RopeOnRope {
    /// Opens the points of every pair that may touch in the step, at the places of its predictor, with the grips that they continue.
    ///
    /// Other pairs touch only where the step moves rope much farther than the predictor; [`open_nearer_points`](Self::open_nearer_points)
    /// finds them then.
    pub fn open_points(&mut self, state: &State, places: &[DVec3]) {
        (self.assemblies, self.iterations) = (0, 0);
        self.opened.clear();
        let within_m = OPENED_WITHIN_M + 2.0 * greatest_approach_m(&state.rope.position, places);
        for index in 0..self.pairs.len() {
            if self.room_m[index] <= within_m {
                self.opened.push(index);
                self.open_pair(index, state, places, false);
            }
        }
    }

    fn open_pair(&mut self, index: usize, state: &State, places: &[DVec3], only: bool) {
        let pair = &self.pairs[index];
        let [one, other] = pair.shapes(|node| places[node]);
        let mut points = if pair.is_of_knot() {
            let point = point_of_ball([one, other], pair.knots_at, pair.contact_distance);
            [point, RopeContactPoint::default()]
        } else {
            points_of(one, other, pair.contact_distance, only)
        };
        for point in points.iter_mut().filter(|point| point.length > 0.0) {
            let along = self.along_of(pair, point);
            match grip_at(&state.rope.rope_grips, pair, along) {
                Some(grip) => (point.kept, point.forgiven_m) = (grip.stretch, grip.forgiven_m),
                // Ropes that touch without a stored grip did so at the start of the run.
                None => point.forgiven_m = (pair.contact_distance - pair.first).max(0.0),
            }
        }
        self.pairs[index].points = points;
    }

    /// Unstretched length along both lines to a point [m].
    pub fn along_of(&self, pair: &Pair, point: &RopeContactPoint) -> [f64; 2] {
        [0, 1].map(|k| {
            self.along_m[pair.segments[k]] + point.fractions[k] * self.lengths[pair.segments[k]]
        })
    }

    /// The grip of a point that has been solved for.
    pub fn grip_of(
        &self,
        pair: &Pair,
        point: &RopeContactPoint,
        stretch: DVec3,
        forgiven_m: f64,
    ) -> RopeGrip {
        let along_m = self.along_of(pair, point);
        RopeGrip { lines: pair.lines, knots: pair.knots, along_m, stretch, forgiven_m }
    }

    /// Lets points follow the ropes in the first assemblies, and once more later.
    pub fn follow(&mut self, places: &[DVec3]) {
        self.assemblies += 1;
        if self.assemblies > FOLLOWING_ASSEMBLIES && self.iterations != FOLLOWING_AGAIN {
            return;
        }
        for index in &self.opened {
            let pair = &mut self.pairs[*index];
            if pair.knots[1].is_some() {
                continue;
            }
            let [one, other] = pair.places(|node| places[node]);
            for point in pair.points.iter_mut().filter(|point| point.length > 0.0) {
                point.fractions = point.followed(one, other);
            }
        }
    }

    /// Opens points again where ropes are closer than at their points; returns whether there were any.
    pub fn open_nearer_points(&mut self, state: &State, places: &[DVec3]) -> bool {
        let mut opened = false;
        let reach_m = greatest_approach_m(&state.rope.position, places);
        for index in 0..self.pairs.len() {
            if self.room_m[index] > reach_m {
                continue;
            }
            let pair = &self.pairs[index];
            let [one, other] = pair.shapes(|node| places[node]);
            let least = nearest(one, other).distance;
            let [one, other] = pair.places(|node| places[node]);
            let known = pair.points.iter().filter(|point| point.length > 0.0);
            let known = known
                .map(|point| between(one, other, point.fractions).1)
                .fold(f64::INFINITY, f64::min);
            if least < pair.contact_distance && least < NEARER * known {
                self.open_pair(index, state, places, true);
                if let Err(at) = self.opened.binary_search(&index) {
                    self.opened.insert(at, index);
                }
                opened = true;
            }
        }
        if opened {
            self.iterations = 0;
        }
        opened
    }
}

/// The nearest grip of a pair's lines or knots at these lengths along them, if any is near enough.
fn grip_at<'a>(grips: &'a [RopeGrip], pair: &Pair, along: [f64; 2]) -> Option<&'a RopeGrip> {
    let away = |grip: &RopeGrip| {
        (grip.along_m[0] - along[0]).abs().max((grip.along_m[1] - along[1]).abs())
    };
    let is_mine = |grip: &RopeGrip| grip.lines == pair.lines && grip.knots == pair.knots;
    let mine = grips.iter().filter(|grip| is_mine(grip) && away(grip) <= FOLLOWED_M);
    mine.min_by(|a, b| away(a).total_cmp(&away(b)))
}
