//! Rope near rope in one step: pairs of segments, the points at which they may press, and how far rope may move without crossing.

use glam::DVec3;

use super::broad::{Broad, Moves};
use super::points::{RopeContactPoint, points_of};
use super::sweep::{greatest_approach, nearest, safe_fraction};
use crate::contact::crossing::first_crossing;
use crate::contact::sweep::SweptSegment;
use crate::model::{Model, RopeOnRope};
use crate::state::{RopeGrip, State};

/// Ropes that come this near in a step, beyond touching, are gathered [m].
const MARGIN_M: f64 = 0.03;
/// Ropes that come this near in a step, beyond touching, may touch [m].
const TOUCH_M: f64 = 2e-3;
/// Rope that moved less than this from its drift has met nothing but what was gathered: two ropes less than the margin [m].
const UNWATCHED_M: f64 = 0.014;
/// That move as a share of the shortest segment, so that a straight piece stayed straight.
const UNWATCHED_SHARE: f64 = 0.125;
/// Least separation kept, as a share of the contact distance.
const MIN_SEPARATION_SHARE: f64 = 0.08;
/// Ropes nearer than this share of the contact distance when a step begins run through each other, and are left alone.
const THROUGH_SHARE: f64 = 0.01;
/// Rope between two of its points, in contact distances, below which they do not touch: it cannot bend back so sharply.
const SPARED_CONTACT_DISTANCES: f64 = 3.0;
/// How far a point may have moved along either rope in a step and be the same grip [m].
const FOLLOWED_M: f64 = 0.05;
/// Passes in which points follow the ropes; then they stay, so that Newton can finish.
const FOLLOWING_PASSES: usize = 6;
/// A place of a pair that is nearer than its points by this share calls for new ones.
const NEARER: f64 = 0.9;

/// Where a segment belongs.
#[derive(Clone, Copy, Debug)]
struct Home {
    line: usize,
    node: usize,
    radius_m: f64,
}

/// Two segments that may touch, the first below the second.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub segments: [usize; 2],
    /// First node of each.
    pub nodes: [usize; 2],
    lines: [usize; 2],
    /// Sum of the radii [m].
    pub contact_distance: f64,
    min_separation: f64,
    /// Lower bound of the distance now [m].
    gap_bound: f64,
    /// Distance when the step began [m].
    first: f64,
    pub points: [RopeContactPoint; 2],
}

/// Scratch of rope against rope for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct RopeWorkspace {
    /// `None` where ropes pass through each other.
    pub law: Option<RopeOnRope>,
    pub pairs: Vec<Pair>,
    /// Whether ropes may touch in this step.
    pub touching: bool,
    /// Pairs that run through each other; some may stand here twice.
    through: Vec<[usize; 2]>,
    /// Crossings found in the step by the exact test.
    pub crossings: u64,
    homes: Vec<Home>,
    /// Joints at the ends of each line, and its unstretched length [m].
    ends: Vec<([usize; 2], f64)>,
    /// Unstretched length of each segment, and from its line's start to it [m].
    lengths: Vec<f64>,
    along_m: Vec<f64>,
    widest_m: f64,
    shortest_m: f64,
    broad: Broad,
    found: Vec<[usize; 2]>,
    passes: usize,
}

impl RopeWorkspace {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let Some(law) = model.spec.settings.rope_on_rope else { return Self::default() };
        let mut homes = Vec::with_capacity(model.segment_count);
        for (line, nodes) in model.line_nodes.iter().enumerate() {
            let radius_m = 0.5 * model.spec.ropes[model.spec.lines[line].rope].diameter_m;
            homes.extend((nodes.start..nodes.end - 1).map(|node| Home { line, node, radius_m }));
        }
        Self {
            law: Some(law),
            widest_m: homes.iter().map(|home| home.radius_m).fold(0.0, f64::max),
            homes,
            ends: model.spec.lines.iter().map(|line| ([line.from, line.to], 0.0)).collect(),
            along_m: vec![0.0; model.segment_count],
            broad: Broad::new(model),
            ..Self::default()
        }
    }

    /// Takes over the lengths of segments, where they are not those there are.
    fn measure_lengths(&mut self, model: &Model, lengths: &[f64]) {
        if self.lengths == lengths {
            return;
        }
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
    }

    /// Gathers rope near rope for a step from the state by its velocities; whether any may touch.
    pub fn gather(&mut self, model: &Model, state: &State, dt: f64) -> bool {
        self.pairs.clear();
        self.through.clear();
        (self.touching, self.crossings) = (false, 0);
        let rope = &state.rope;
        self.gather_to(
            model,
            state,
            |node| rope.position[node] + rope.velocity[node] * dt,
            MARGIN_M,
        );
        self.touching
    }

    /// Gathers rope that came near rope on its way to these places besides; whether there is any.
    pub fn gather_more(&mut self, model: &Model, state: &State, to: &[DVec3]) -> bool {
        let before = self.pairs.len();
        self.gather_to(model, state, |node| to[node], TOUCH_M);
        self.pairs.len() > before
    }

    /// Adds pairs, in order.
    fn gather_to(
        &mut self,
        model: &Model,
        state: &State,
        to: impl Fn(usize) -> DVec3,
        margin: f64,
    ) {
        if self.law.is_none() {
            return;
        }
        self.measure_lengths(model, &state.rope.segment_length);
        let (from, mut found, known) =
            (&state.rope.position, std::mem::take(&mut self.found), self.pairs.len());
        let moves = Moves { from, to: &to, lengths: &self.lengths };
        self.broad.collect(&moves, 2.0 * self.widest_m + margin, &mut found);
        for [one, other] in &found {
            if state.rope.cut[*one] || state.rope.cut[*other] || self.is_spared(*one, *other) {
                continue;
            }
            if self.pairs[..known]
                .binary_search_by_key(&[*one, *other], |pair| pair.segments)
                .is_err()
            {
                self.add_pair([*one, *other], from, &to, margin);
            }
        }
        self.pairs.sort_unstable_by_key(|pair| pair.segments);
        self.found = found;
    }

    fn add_pair(
        &mut self,
        segments: [usize; 2],
        from: &[DVec3],
        to: &impl Fn(usize) -> DVec3,
        margin: f64,
    ) {
        let [one, other] = segments.map(|segment| self.homes[segment]);
        let (nodes, contact_distance) = ([one.node, other.node], one.radius_m + other.radius_m);
        let [a, b] = nodes.map(|node| sweep_of(node, from, to));
        let first = nearest(a.at(0.0), b.at(0.0)).distance;
        let least = first - greatest_approach(&a, &b);
        if least > contact_distance + margin {
            return;
        }
        if first < THROUGH_SHARE * contact_distance {
            self.through.push(segments);
            return;
        }
        self.touching |= least < contact_distance + TOUCH_M;
        let (lines, min_separation) =
            ([one.line, other.line], MIN_SEPARATION_SHARE * contact_distance);
        self.pairs.push(Pair {
            segments,
            nodes,
            lines,
            contact_distance,
            min_separation,
            gap_bound: first,
            first,
            points: Default::default(),
        });
    }

    /// Whether so little rope lies between two segments, through a joint too, that they do not touch.
    fn is_spared(&self, one: usize, other: usize) -> bool {
        let (a, b) = (self.homes[one], self.homes[other]);
        let little = SPARED_CONTACT_DISTANCES * (a.radius_m + b.radius_m);
        if a.line == b.line && self.along_m[other] - self.along_m[one] - self.lengths[one] < little
        {
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

    /// Opens the points of every pair at these places, with the grips that they continue.
    pub fn open(&mut self, state: &State, places: &[DVec3]) {
        self.passes = 0;
        for index in 0..self.pairs.len() {
            self.open_pair(index, state, places, false);
        }
    }

    fn open_pair(&mut self, index: usize, state: &State, places: &[DVec3], only: bool) {
        let pair = &self.pairs[index];
        let [one, other] = pair.places(|node| places[node]);
        let mut points = points_of(one, other, pair.contact_distance, only);
        for point in points.iter_mut().filter(|point| point.length > 0.0) {
            let along = self.along_of(pair, point);
            match grip_at(&state.rope.rope_grips, pair.lines, along) {
                Some(grip) => (point.kept, point.forgiven_m) = (grip.stretch, grip.forgiven_m),
                // What touches already and holds no grip lay so when the run began.
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
        RopeGrip { lines: pair.lines, along_m: self.along_of(pair, point), stretch, forgiven_m }
    }

    /// Lets points follow the ropes in the first passes.
    pub fn follow(&mut self, places: &[DVec3]) {
        self.passes += 1;
        if self.passes > FOLLOWING_PASSES {
            return;
        }
        for pair in &mut self.pairs {
            let [one, other] = pair.places(|node| places[node]);
            for point in pair.points.iter_mut().filter(|point| point.length > 0.0) {
                point.fractions = point.followed(one, other);
            }
        }
    }

    /// Whether points follow the ropes within a pass.
    pub fn follows(&self) -> bool {
        self.passes < FOLLOWING_PASSES
    }

    /// Opens points anew where ropes have come nearer than at those they have; whether there were any.
    pub fn open_more(&mut self, state: &State, places: &[DVec3]) -> bool {
        let mut opened = false;
        for index in 0..self.pairs.len() {
            let pair = &self.pairs[index];
            if pair.gap_bound >= pair.contact_distance {
                continue;
            }
            let [one, other] = pair.places(|node| places[node]);
            let least = nearest(one, other).distance;
            let known = pair.points.iter().filter(|point| point.length > 0.0);
            let known = known
                .map(|point| between(one, other, point.fractions).1)
                .fold(f64::INFINITY, f64::min);
            if least < pair.contact_distance && least < NEARER * known {
                self.open_pair(index, state, places, true);
                opened = true;
            }
        }
        opened
    }

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

    /// How many pairs run through each other.
    pub fn count_through(&mut self) -> u64 {
        self.through.sort_unstable();
        self.through.dedup();
        self.through.len() as u64
    }

    /// Goes back to where the step began.
    pub fn begin(&mut self) {
        for pair in &mut self.pairs {
            pair.gap_bound = pair.first;
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

impl Pair {
    /// Ends of both segments by a quantity given at nodes.
    pub fn places(&self, at: impl Fn(usize) -> DVec3) -> [[DVec3; 2]; 2] {
        self.nodes.map(|node| [at(node), at(node + 1)])
    }
}

/// From the point of the second segment to that of the first, and how long that is.
pub(crate) fn between(one: [DVec3; 2], other: [DVec3; 2], [s, t]: [f64; 2]) -> (DVec3, f64) {
    let gap = one[0].lerp(one[1], s) - other[0].lerp(other[1], t);
    (gap, gap.length())
}

fn sweep_of(node: usize, from: &[DVec3], to: &impl Fn(usize) -> DVec3) -> SweptSegment {
    SweptSegment { a0: from[node], b0: from[node + 1], a1: to(node), b1: to(node + 1) }
}

/// The nearest grip between two lines at these lengths along them, if any is near enough.
fn grip_at(grips: &[RopeGrip], lines: [usize; 2], along: [f64; 2]) -> Option<&RopeGrip> {
    let away = |grip: &RopeGrip| {
        (grip.along_m[0] - along[0]).abs().max((grip.along_m[1] - along[1]).abs())
    };
    let mine = grips.iter().filter(|grip| grip.lines == lines && away(grip) <= FOLLOWED_M);
    mine.min_by(|a, b| away(a).total_cmp(&away(b)))
}
