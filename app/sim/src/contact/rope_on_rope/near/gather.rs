//! Gathers pairs of segments that may touch in a step.

use glam::DVec3;

use crate::broad_phase::knots::on_segments;
use crate::broad_phase::pieces::Pieces;
use crate::broad_phase::ropes::{Moves, Reach, Rope};
use crate::contact::rope_on_rope::near::{Pair, RopeOnRope, TOUCH_M};
use crate::geometry::segment_pair::{greatest_approach, nearest};
use crate::model::Model;
use crate::state::State;

/// Distance beyond contact within which pairs of ropes are gathered for long steps [m].
pub(crate) const MARGIN_M: f64 = 0.03;

/// Ropes closer than this share of the contact distance at the start of a step pass through each other, and are ignored.
const THROUGH_SHARE: f64 = 0.01;

/// Rope between two of its points, in contact distances, below which they do not touch: it cannot bend back so sharply.
const SPARED_CONTACT_DISTANCES: f64 = 3.0;

/// Segments of one line farther apart than this share of the rope between them have not returned to each other, and are gathered only
/// when they may touch.
const RUNS_ON_SHARE: f64 = 0.5;

/// Least separation on a path, as a share of the contact distance.
const MIN_SEPARATION_SHARE: f64 = 0.08;

impl RopeOnRope {
    /// Copies the lengths of segments, if they have changed.
    fn measure_lengths(&mut self, model: &Model, lengths: &[f64], pieces: &Pieces) {
        if self.lengths_number == pieces.lengths_number {
            return;
        }
        self.lengths_number = pieces.lengths_number;
        self.broad.forget();
        self.lengths.clear();
        self.lengths.extend_from_slice(lengths);
        self.shortest_m = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        for (segments, (_, whole)) in model.line_segments.iter().zip(&mut self.ends) {
            *whole = 0.0;
            for segment in segments.clone() {
                self.along_m[segment] = *whole;
                *whole += lengths[segment];
            }
        }
        for (ball, knot) in self.knots.iter_mut().zip(&model.knots) {
            ball.fraction = knot.fraction(lengths[knot.segment]);
        }
    }

    /// Gathers rope within a margin of rope, for a step from the state by its velocities, in pieces measured for it; whether any may
    /// touch.
    pub fn gather(
        &mut self,
        model: &Model,
        state: &State,
        pieces: &Pieces,
        (dt, margin_m): (f64, f64),
    ) -> bool {
        self.margin_m = margin_m;
        self.pairs.clear();
        self.room_m.clear();
        self.opened.clear();
        self.through.clear();
        self.touching = false;
        self.crowded = None;
        let rope = &state.rope;
        self.gather_to(
            model,
            state,
            pieces,
            |node| rope.position[node] + rope.velocity[node] * dt,
            margin_m,
        );
        self.touching
    }

    /// Gathers the pairs that come near each other on the path to these places besides; returns whether there are any.
    pub fn gather_more(
        &mut self,
        model: &Model,
        state: &State,
        pieces: &Pieces,
        to: &[DVec3],
    ) -> bool {
        let before = self.pairs.len();
        self.gather_to(model, state, pieces, |node| to[node], TOUCH_M);
        self.pairs.len() > before
    }

    /// Adds pairs, in order.
    pub(crate) fn gather_to(
        &mut self,
        model: &Model,
        state: &State,
        pieces: &Pieces,
        to: impl Fn(usize) -> DVec3,
        margin: f64,
    ) {
        if self.law.is_none() {
            return;
        }
        self.measure_lengths(model, &state.rope.segment_length, pieces);
        let (from, known) = (&state.rope.position, self.pairs.len());
        let (mut broad, mut found) =
            (std::mem::take(&mut self.broad), std::mem::take(&mut self.found));
        let rope = Rope {
            pieces,
            knots: &self.knots,
            may_touch: &|segments, knot| self.may_touch(segments, knot),
        };
        let moves = Moves { from, to: &to };
        let [reach, farthest] = [margin, MARGIN_M].map(|margin| self.reach(margin));
        broad.collect(rope, &moves, reach, farthest, &mut found);
        if found.crowded {
            self.crowded = found.segments.first().copied();
        }
        let cut = &state.rope.cut;
        let is_whole = |segments: [usize; 2]| segments.iter().all(|segment| !cut[*segment]);
        for segments in found.segments.iter().filter(|segments| is_whole(**segments)) {
            self.add_pair((*segments, [None; 2]), known, (from, &to), margin);
        }
        for [knot, segment] in &found.knots {
            let segments = [self.knots[*knot].segment, *segment];
            if is_whole(segments) {
                self.add_pair((segments, [Some(*knot), None]), known, (from, &to), margin);
                // Of two knots each finds the other's segment; the first takes both.
                for other in
                    on_segments(&self.knots, &(*segment..segment + 1)).filter(|other| other > knot)
                {
                    self.add_pair(
                        (segments, [Some(*knot), Some(other)]),
                        known,
                        (from, &to),
                        margin,
                    );
                }
            }
        }
        self.pairs.sort_unstable_by_key(Pair::key);
        debug_assert!(
            self.pairs.windows(2).all(|two| two[0].key() < two[1].key()),
            "each pair once"
        );
        self.room_m.clear();
        self.room_m.extend(self.pairs.iter().map(|pair| pair.first - pair.contact_distance));
        // Pairs that were added change the numbers of the others; their points are then opened again.
        if self.pairs.len() > known {
            self.opened.clear();
        }
        (self.broad, self.found) = (broad, found);
    }

    /// The reach of the search for a margin beyond contact [m].
    fn reach(&self, margin: f64) -> Reach {
        Reach { ropes_m: 2.0 * self.widest_m + margin, knots_m: 2.0 * self.widest_knot_m + margin }
    }

    /// Whether two segments, or a knot on the first and the second or its knots, are far enough apart along rope to touch.
    fn may_touch(&self, segments: [usize; 2], knot: Option<usize>) -> bool {
        let may = |knots| !self.is_spared(segments, self.contact_distance(segments, knots));
        let own = segments[1]..segments[1] + 1;
        let others = knot.map_or(0..0, |_| on_segments(&self.knots, &own));
        may([knot, None]) || others.into_iter().any(|other| may([knot, Some(other)]))
    }

    /// Sum of the radii of two things [m].
    pub(super) fn contact_distance(&self, segments: [usize; 2], knots: [Option<usize>; 2]) -> f64 {
        let rope = |k: usize| self.homes[segments[k]].radius_m;
        let radius = |k: usize| knots[k].map_or_else(|| rope(k), |knot| self.knots[knot].radius_m);
        radius(0) + radius(1)
    }

    /// Two things that may touch, without where they are.
    fn pair_of(
        &self,
        segments: [usize; 2],
        knots: [Option<usize>; 2],
        contact_distance: f64,
    ) -> Pair {
        let homes = segments.map(|segment| self.homes[segment]);
        Pair {
            segments,
            knots,
            knots_at: knots.map(|knot| knot.map(|knot| self.knots[knot].fraction)),
            nodes: homes.map(|home| home.node),
            lines: homes.map(|home| home.line),
            contact_distance,
            min_separation: MIN_SEPARATION_SHARE * contact_distance,
            first: 0.0,
            may_touch: false,
            points: Default::default(),
        }
    }

    /// Adds a pair, if it is not among those `known` and may come near.
    fn add_pair(
        &mut self,
        (segments, knots): ([usize; 2], [Option<usize>; 2]),
        known: usize,
        (from, to): (&[DVec3], &impl Fn(usize) -> DVec3),
        margin: f64,
    ) {
        let contact_distance = self.contact_distance(segments, knots);
        if self.is_spared(segments, contact_distance)
            || self.pairs[..known].binary_search_by_key(&(segments, knots), Pair::key).is_ok()
        {
            return;
        }
        let mut pair = self.pair_of(segments, knots, contact_distance);
        let [a, b] = pair.sweeps(from, to);
        let first = nearest(a.at(0.0), b.at(0.0)).distance;
        let least = first - greatest_approach(&a, &b);
        if least > contact_distance + margin {
            return;
        }
        if least > contact_distance + TOUCH_M && first > RUNS_ON_SHARE * self.between_m(segments) {
            return;
        }
        if first < THROUGH_SHARE * contact_distance {
            if !pair.is_of_knot() {
                self.through.push(segments);
            }
            return;
        }
        pair.may_touch = least < contact_distance + TOUCH_M;
        self.touching |= pair.may_touch;
        pair.first = first;
        self.pairs.push(pair);
    }

    /// Length of rope between two segments of one line; infinite for two lines [m].
    fn between_m(&self, segments: [usize; 2]) -> f64 {
        let [one, other] = [segments[0].min(segments[1]), segments[0].max(segments[1])];
        if self.homes[one].line != self.homes[other].line {
            return f64::INFINITY;
        }
        self.along_m[other] - self.along_m[one] - self.lengths[one]
    }

    /// Whether so little rope lies between two segments, through a joint too, that they do not touch.
    fn is_spared(&self, [one, other]: [usize; 2], contact_distance: f64) -> bool {
        let (a, b) = (self.homes[one], self.homes[other]);
        let little = SPARED_CONTACT_DISTANCES * contact_distance;
        if self.between_m([one, other]) < little {
            return true;
        }
        let to_end = |line: usize, segment: usize, end: usize| match end {
            0 => self.along_m[segment],
            _ => self.ends[line].1 - self.along_m[segment] - self.lengths[segment],
        };
        let meets = |(end, other_end): (usize, usize)| {
            self.ends[a.line].0[end] == self.ends[b.line].0[other_end]
                && (a.line != b.line || end != other_end)
                && to_end(a.line, one, end) + to_end(b.line, other, other_end) < little
        };
        [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().any(meets)
    }
}
