//! Gathers the segments of rope that may touch a solid in a step.

use glam::DVec3;

use crate::broad_phase::pieces::Pieces;
use crate::broad_phase::solids::NearGroup;
use crate::contact::rope_on_solid::points::SolidContactPoint;
use crate::contact::rope_on_solid::{MARGIN_M, Pair, RopeOnSolid};
use crate::geometry::Pose;
use crate::model::Knot;
use crate::solids::{Carrier, Solid};
use crate::state::{Bears, State};

/// How far beyond its radius rope is gathered in statics, where a pass moves rope far [m].
const STATIC_MARGIN_M: f64 = 2.0;

/// Margin for rounding in a distance [m].
const ROUNDING_M: f64 = 1e-9;

/// A segment that may come near a solid.
#[derive(Clone, Copy, Debug)]
struct NearSegment {
    segment: usize,
    /// First node of the segment.
    node: usize,
    line: usize,
}

/// How a segment and a solid move over a step.
#[derive(Clone, Copy)]
struct Motion<'a> {
    /// Places of the segment's ends when the step begins, then when it ends [m].
    places: [DVec3; 4],
    /// Where the solid is when the step begins and when it ends.
    poses: &'a [Pose; 2],
}

impl Motion<'_> {
    /// Whether a moving segment may come within reach of a solid, which does not turn.
    fn may_reach(&self, solid: &Solid, reach: f64) -> bool {
        let Self { places, poses } = self;
        let middles = [0.5 * (places[0] + places[1]), 0.5 * (places[2] + places[3])];
        let half = 0.5 * (places[1] - places[0]).length().max((places[3] - places[2]).length());
        let [from, to] = [0, 1].map(|end| middles[end] - poses[end].place);
        let travel = 0.5 * (to - from).length();
        // The distance from the enclosing ball is cheaper than that from the solid, and a lower bound.
        if from.length().min(to.length()) - solid.radius_m - half - travel > reach + ROUNDING_M {
            return false;
        }
        let (from, to) = (poses[0].inward(middles[0]), poses[1].inward(middles[1]));
        let nearest = solid.shape.distance(from);
        // It is nearer at the other end by no more than its way.
        if nearest - half - 3.0 * travel > reach + ROUNDING_M {
            return false;
        }
        let nearest = nearest.min(solid.shape.distance(to));
        nearest - half - 0.5 * (to - from).length() <= reach
    }
}

/// Where a solid is over a step, with bodies where they are when it begins: then, and by its drift.
fn poses_of(solid: &Solid, state: &State, bodies: &[Pose], dt: f64) -> [Pose; 2] {
    match solid.carrier {
        Carrier::World(pose) => [pose, pose],
        Carrier::Body { body, middle_m } => {
            let (from, now) = (bodies[body].about(middle_m), &state.bodies[body]);
            let velocity = now.velocity + now.spin.cross(bodies[body].orientation * middle_m);
            [from, Pose { place: from.place + velocity * dt, ..from }]
        }
    }
}

/// A search for rope near solids.
#[derive(Clone, Copy)]
struct Search<'a> {
    /// Rope in pieces, measured over the step.
    pieces: &'a Pieces,
    /// Places of nodes when it begins [m].
    from: &'a [DVec3],
    /// Length of the step; zero in statics [s].
    dt: f64,
    /// How far beyond its radius rope is gathered [m].
    margin: f64,
    /// Whether it adds to the pairs that were gathered before.
    again: bool,
}

impl RopeOnSolid {
    /// Gathers rope within a margin of solids for a step of length `dt`, as the state begins it, by rope's pieces over the step.
    pub fn gather(&mut self, state: &State, pieces: &Pieces, (dt, margin): (f64, f64)) {
        self.predicted.clear();
        self.bodies.clear();
        self.bodies.extend(state.bodies.iter().map(Pose::of));
        if !self.solids.is_empty() {
            self.take_lengths(pieces, &state.rope.segment_length);
            self.take_within(state);
        }
        let from = &state.rope.position;
        self.gather_all(state, &Search { pieces, from, dt, margin, again: false });
    }

    /// Gathers rope near solids for an iteration of statics that begins with rope and bodies at these places. It continues from the
    /// normal forces that the last iteration predicted.
    pub fn gather_at_rest(
        &mut self,
        state: &State,
        pieces: &mut Pieces,
        from: &[DVec3],
        bodies: impl Iterator<Item = Pose>,
    ) {
        self.predicted.clear();
        self.predicted
            .extend(self.nodes.iter().map(|point| ((point.solid, point.node), point.predicted_n)));
        self.bodies.clear();
        self.bodies.extend(bodies);
        self.within.clear();
        pieces.measure(from, |node| from[node], &state.rope.segment_length);
        if !self.solids.is_empty() {
            self.take_lengths(pieces, &state.rope.segment_length);
        }
        let margin = STATIC_MARGIN_M;
        self.gather_all(state, &Search { pieces, from, dt: 0.0, margin, again: false });
    }

    fn gather_all(&mut self, state: &State, search: &Search<'_>) {
        self.pairs.clear();
        self.nodes.clear();
        self.knots.clear();
        self.touching = false;
        (self.passes, self.dt, self.margin_m) = (0, search.dt, search.margin);
        if self.solids.is_empty() {
            return;
        }
        let drift = |node: usize| search.from[node] + state.rope.velocity[node] * search.dt;
        self.add_pairs(state, search, drift);
    }

    /// Adds the pairs that come near each other on the path to these places and were not gathered; returns whether there are any.
    pub fn gather_more(&mut self, state: &State, pieces: &Pieces, to: &[DVec3], dt: f64) -> bool {
        let before = self.pairs.len();
        let from = &state.rope.position;
        let search = Search { pieces, from, dt, margin: 0.0, again: true };
        self.add_pairs(state, &search, |node| to[node]);
        self.pairs.len() > before
    }

    fn add_pairs(&mut self, state: &State, search: &Search<'_>, to: impl Fn(usize) -> DVec3) {
        let Search { pieces, from, dt, margin, .. } = *search;
        let (solids, mut poses) =
            (std::mem::take(&mut self.solids), std::mem::take(&mut self.poses));
        let mut neighbours = std::mem::take(&mut self.neighbours);
        poses.clear();
        poses.extend(solids.iter().map(|solid| poses_of(solid, state, &self.bodies, dt)));
        let farthest_m = self.widest_m + margin.max(MARGIN_M);
        neighbours.update(pieces, &solids, &poses, farthest_m);
        let spares_bodies = dt <= 0.0 && self.at_rest_n_m2.is_none();
        let pushes = |solid: &Solid| !spares_bodies || matches!(solid.carrier, Carrier::World(_));
        let near = neighbours.within(pieces, &solids, &poses, self.widest_m + margin);
        for NearGroup { solid, piece, group } in near.filter(|near| pushes(&solids[near.solid])) {
            let piece = &pieces.pieces[piece];
            let (segments, node) = piece.group(group);
            for (segment, node) in segments.zip(node..) {
                let near = NearSegment { segment, node, line: piece.line };
                let places = [from[node], from[node + 1], to(node), to(node + 1)];
                let motion = Motion { places, poses: &poses[solid] };
                self.search_pair(state, solid, &solids[solid], near, &motion, search);
            }
        }
        (self.solids, self.poses, self.neighbours) = (solids, poses, neighbours);
    }

    /// Adds a segment and a solid, if the pair is new and may come near each other.
    fn search_pair(
        &mut self,
        state: &State,
        solid: usize,
        thing: &Solid,
        near: NearSegment,
        motion: &Motion<'_>,
        search: &Search<'_>,
    ) {
        let Search { margin, again, .. } = *search;
        let NearSegment { segment, line, .. } = near;
        let knots = Knot::on_segment(&self.all_knots, segment).iter().map(|knot| knot.radius_m);
        let reach = knots.fold(self.radius_m[line], f64::max) + margin;
        let is_it = |pair: &Pair| pair.solid == solid && pair.segment == segment;
        let known = again && self.pairs.iter().any(is_it);
        if !known && motion.may_reach(thing, reach) {
            self.add_pair(state, solid, thing, near, motion, again);
        }
    }

    fn add_pair(
        &mut self,
        state: &State,
        solid: usize,
        thing: &Solid,
        NearSegment { segment, node, line }: NearSegment,
        Motion { places, poses }: &Motion<'_>,
        again: bool,
    ) {
        let reach_m = [self.along_m[node], self.along_m[node + 1]];
        if self.lies_within(solid, line, reach_m) {
            return;
        }
        let (range, radius_m) = (self.range_of(solid, line, node), self.radius_m[line]);
        let follows = self.pairs.last().is_some_and(|last| {
            last.solid == solid && last.segment + 1 == segment && last.line == line
        });
        for (end, node) in [(0, node), (1, node + 1)] {
            let there = (end == 0 && follows)
                || (again
                    && self.nodes.iter().any(|point| point.solid == solid && point.node == node));
            if there || self.is_spared(solid, line, self.along_m[node]) {
                continue;
            }
            let point = SolidContactPoint {
                solid,
                line,
                segment,
                node,
                radius_m,
                open: true,
                bears: Bears::Node,
                ..SolidContactPoint::default()
            };
            let point =
                self.begin_point(state, thing, point, [places[end], places[2 + end]], poses);
            self.nodes.push(point);
        }
        let inner = [SolidContactPoint {
            solid,
            line,
            segment,
            node,
            radius_m,
            ..SolidContactPoint::default()
        }; 2];
        let mut pair = Pair { solid, segment, line, node, range, inner };
        for (places, pose) in [(&places[..2], &poses[0]), (&places[2..], &poses[1])] {
            self.follow(state, thing, &mut pair, [places[0], places[1]], pose);
        }
        for point in pair.inner.iter_mut().filter(|point| point.open) {
            let at = |ends: &[DVec3]| ends[0].lerp(ends[1], point.fraction.unwrap_or(0.0));
            *point =
                self.begin_point(state, thing, *point, [at(&places[..2]), at(&places[2..])], poses);
        }
        self.pairs.push(pair);
        self.add_knots(state, thing, &pair, &Motion { places: *places, poses });
    }

    /// Knots of a segment, each a contact point that stays where it is on the rope.
    fn add_knots(&mut self, state: &State, thing: &Solid, pair: &Pair, motion: &Motion) {
        let Pair { solid, segment, line, node, .. } = *pair;
        let knots = std::mem::take(&mut self.all_knots);
        for knot in Knot::on_segment(&knots, segment) {
            let fraction = knot.fraction(self.length_of(node));
            if self.is_spared(solid, line, self.along_m[node] + fraction * self.length_of(node)) {
                continue;
            }
            let point = SolidContactPoint {
                solid,
                line,
                segment,
                node,
                fraction: Some(fraction),
                bears: Bears::Knot,
                radius_m: knot.radius_m,
                open: true,
                ..SolidContactPoint::default()
            };
            let [a, b, c, d] = motion.places;
            let places = [a.lerp(b, fraction), c.lerp(d, fraction)];
            let point = self.begin_point(state, thing, point, places, motion.poses);
            self.knots.push(point);
        }
        self.all_knots = knots;
    }
}
