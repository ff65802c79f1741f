//! Rope near skin: pairs of segment and triangle that may touch within a solver step, and how far
//! rope may move without crossing.
//!
//! The invariant is that the rope's centre line never crosses the skin: every sub-move, of rope alone or
//! of rope and skin together, is cut short by additive continuous collision detection (`sweep.rs`), and
//! checked again by an independent exact test (`crossing.rs`).

use std::ops::Range;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::crossing::first_meeting;
use super::distance::{Nearest, Plane, point_triangle_in, segment_triangle_in};
use super::sweep::{SweptSegment, SweptTriangle, greatest_approach, safe_fraction_from, triangle_at};
use crate::model::Model;
use crate::whale::{Bounds, Candidate, SkinTree, Surface};

/// Rope within this distance of the path of skin is looked at [m].
pub(crate) const MARGIN_M: f64 = 0.08;
/// Rope is carried along with skin nearer than this wholly, beyond the next not at all [m].
const CARRIED_M: (f64, f64) = (0.02, 0.06);
/// Pairs farther apart than this are known by a lower bound of their distance [m].
const EXACT_M: f64 = 0.001;
/// Growth of balls over rounding: a factor, and a length [m].
const GROWN: f64 = 1.0 + 1e-12;
const ROUNDING_M: f64 = 1e-9;
/// Least separation kept, as a share of the rope's radius.
const GUARD_SHARE: f64 = 0.08;

/// A segment and a triangle that may touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub segment: usize,
    /// First node of the segment.
    pub node: usize,
    pub triangle: u32,
    /// Corners at the start and the end of the solver step.
    pub sweep: SweptTriangle,
    /// Corners now.
    pub now: [DVec3; 3],
    /// A ball around them.
    ball: Ball,
    /// Their plane; `None` for a needle.
    plane: Option<Plane>,
    /// Lower bound of their distance now [m].
    pub clear: f64,
    /// Longest move of a corner over the solver step [m].
    skin_move: f64,
    /// Separation kept [m].
    guard: f64,
}

/// All pairs of a solver step, in rising order of segment, with the surface they come from.
#[derive(Clone, Debug)]
pub(crate) struct Near {
    surface: Surface,
    sweeps: Vec<SweptSegment>,
    candidates: Vec<Candidate>,
    pub pairs: Vec<Pair>,
    /// Pairs of each segment that has any.
    pub groups: Vec<(usize, Range<usize>)>,
    /// First node of each segment.
    segment_node: Vec<usize>,
    /// Share of the solver step at which the skin stands now.
    pub fraction: f64,
    /// Whether paths are filtered ([`Settings::swept`](crate::model::Settings::swept)).
    swept: bool,
}

impl Near {
    pub fn new(model: &Model, tree: Arc<SkinTree>) -> Self {
        let nodes = model.line_nodes.iter().flat_map(|nodes| nodes.start..nodes.end - 1);
        Self {
            surface: Surface::new(tree),
            sweeps: vec![SweptSegment::default(); model.segment_count],
            candidates: Vec::new(),
            pairs: Vec::new(),
            groups: Vec::new(),
            segment_node: nodes.collect(),
            fraction: 0.0,
            swept: model.spec.settings.swept,
        }
    }

    /// Whether rope that moves from `places` by `moves` may come near skin between two poses.
    pub fn any(&mut self, bones: [&[DAffine3]; 2], places: &[DVec3], moves: impl Fn(usize) -> DVec3, margin: f64) -> bool {
        self.sweep(bones, places, moves);
        self.surface.is_any_near(&self.sweeps, margin)
    }

    fn sweep(&mut self, bones: [&[DAffine3]; 2], places: &[DVec3], moves: impl Fn(usize) -> DVec3) {
        self.surface.begin(bones[0], bones[1]);
        for (sweep, &node) in self.sweeps.iter_mut().zip(&self.segment_node) {
            let (a0, b0) = (places[node], places[node + 1]);
            *sweep = SweptSegment { a0, b0, a1: a0 + moves(node), b1: b0 + moves(node + 1) };
        }
    }

    /// Begins a solver step: gathers the pairs of uncut rope near skin; whether there are any.
    pub fn begin(
        &mut self,
        model: &Model,
        bones: [&[DAffine3]; 2],
        places: &[DVec3],
        moves: impl Fn(usize) -> DVec3,
        cut: &[bool],
    ) -> bool {
        self.sweep(bones, places, moves);
        self.surface.gather(&self.sweeps, MARGIN_M, &mut self.candidates);
        self.fraction = 0.0;
        self.pairs.clear();
        self.groups.clear();
        for place in 0..self.candidates.len() {
            let Candidate { segment, triangle } = self.candidates[place];
            let segment = segment as usize;
            if cut[segment] {
                continue;
            }
            let sweep = self.surface.triangle_sweep(triangle);
            let guard = GUARD_SHARE * 0.5 * model.rope_of_segment(segment).diameter_m;
            let node = self.segment_node[segment];
            let index = self.pairs.len();
            let skin_move = (0..3).map(|corner| sweep[0][corner].distance_squared(sweep[1][corner])).fold(0.0, f64::max).sqrt();
            let (now, ball, plane) = (sweep[0], Ball::around(sweep[0]), Plane::of(sweep[0]));
            self.pairs.push(Pair { segment, node, triangle, sweep, now, ball, plane, clear: 0.0, skin_move, guard });
            match self.groups.last_mut() {
                Some((last, range)) if *last == segment => range.end = index + 1,
                _ => self.groups.push((segment, index..index + 1)),
            }
        }
        !self.pairs.is_empty()
    }

    /// Measures every pair at the places given: near ones exactly, others by a lower bound.
    pub fn measure(&mut self, places: &[DVec3]) {
        for (_, range) in &self.groups {
            let node = self.pairs[range.start].node;
            let segment = [places[node], places[node + 1]];
            let rope_box = Bounds::around(&segment);
            for pair in &mut self.pairs[range.clone()] {
                let gap = rope_box.gap(&Bounds::around(&pair.now)).max(pair.gap(segment));
                pair.clear = if gap > EXACT_M { gap } else { pair.nearest_to(segment).distance };
            }
        }
    }

    /// Where rope goes as the skin makes the rest of its move: on to `target`, held back from coming nearer to skin
    /// than it is, or than its radius; written over `target`.
    pub fn hold_off(&self, places: &[DVec3], target: &mut [DVec3]) {
        if !self.swept {
            return;
        }
        for (_, range) in &self.groups {
            let Some((pair, nearest)) = self.nearest(places, range.clone()) else { continue };
            let between = |at: &[DVec3]| at[pair.node].lerp(at[pair.node + 1], nearest.fraction);
            let foot = on_triangle(pair.now, nearest.barycentric);
            let skin_move = on_triangle(pair.sweep[1], nearest.barycentric) - foot;
            let from = between(places);
            let normal = (from - foot) / nearest.distance.max(1e-12);
            let approach = normal.dot(skin_move - (between(target) - from));
            let too_near = approach - (nearest.distance - pair.guard / GUARD_SHARE).max(0.0);
            if too_near > 0.0 {
                target[pair.node] += normal * too_near;
                target[pair.node + 1] += normal * too_near;
            }
        }
    }

    /// Where rope goes when it is carried along as the skin makes the rest of its move: written into `target`.
    pub fn carry(&self, places: &[DVec3], target: &mut [DVec3]) {
        for (_, range) in &self.groups {
            let Some((pair, nearest)) = self.nearest(places, range.clone()) else { continue };
            let share = ((CARRIED_M.1 - nearest.distance) / (CARRIED_M.1 - CARRIED_M.0)).clamp(0.0, 1.0);
            let end = on_triangle(pair.sweep[1], nearest.barycentric);
            let skin_move = end - on_triangle(pair.now, nearest.barycentric);
            for node in [pair.node, pair.node + 1] {
                let carried = places[node] + skin_move;
                target[node] = target[node].lerp(carried, share);
            }
        }
    }

    fn nearest(&self, places: &[DVec3], range: Range<usize>) -> Option<(&Pair, Nearest)> {
        let mut best: Option<(&Pair, Nearest)> = None;
        for pair in &self.pairs[range] {
            if best.is_some_and(|(_, nearest)| pair.clear >= nearest.distance) {
                continue;
            }
            let nearest = pair.nearest_to([places[pair.node], places[pair.node + 1]]);
            if best.is_none_or(|(_, found)| nearest.distance < found.distance) {
                best = Some((pair, nearest));
            }
        }
        best
    }

    /// Largest share of the move `places` → `target`, while the skin goes to `skin_to` of its step, along
    /// which nothing crosses.
    pub fn safe_share(&mut self, places: &[DVec3], target: impl Fn(usize) -> DVec3, skin_to: f64) -> f64 {
        let mut share = 1.0_f64;
        if !self.swept {
            return share;
        }
        let skin_share = skin_to - self.fraction;
        for (_, range) in &self.groups {
            let segment = self.pairs[range.start].sweep_of(places, &target);
            let moved = greatest_move(&segment);
            for pair in &mut self.pairs[range.clone()] {
                if pair.clear - pair.guard > moved + pair.skin_move * skin_share {
                    continue;
                }
                let triangle = [pair.now, if skin_share > 0.0 { triangle_at(&pair.sweep, skin_to) } else { pair.now }];
                if pair.clear - pair.guard > greatest_approach(&segment, &triangle) {
                    continue;
                }
                pair.clear = pair.nearest_to(segment.at(0.0)).distance;
                share = share.min(safe_fraction_from(&segment, &triangle, pair.guard, pair.clear));
            }
        }
        share
    }

    /// Makes the move `places` → `target`: skin goes to `skin_to` of its step, bounds of distance shrink by what
    /// moved. Gives the number of crossings an exact test finds on the way.
    pub fn make_move(&mut self, places: &[DVec3], target: impl Fn(usize) -> DVec3, skin_to: f64) -> u64 {
        let skin_share = skin_to - self.fraction;
        let mut crossings = 0;
        for (_, range) in &self.groups {
            let segment = self.pairs[range.start].sweep_of(places, &target);
            let moved = greatest_move(&segment);
            for pair in &mut self.pairs[range.clone()] {
                let after = if skin_share > 0.0 { triangle_at(&pair.sweep, skin_to) } else { pair.now };
                crossings += u64::from(pair.follow(&segment, after, moved + pair.skin_move * skin_share));
            }
        }
        self.fraction = skin_to;
        crossings
    }
}

impl Pair {
    /// Takes a move of both: keeps a lower bound of the distance; whether an exact test finds a crossing.
    fn follow(&mut self, segment: &SweptSegment, after: [DVec3; 3], most: f64) -> bool {
        let triangle = [self.now, after];
        if self.now != after {
            (self.now, self.ball, self.plane) = (after, Ball::around(after), Plane::of(after));
        }
        if self.clear > most + EXACT_M {
            self.clear -= most;
            return false;
        }
        let approach = greatest_approach(segment, &triangle);
        if self.clear > approach {
            self.clear -= approach;
            return false;
        }
        self.clear = self.nearest_to(segment.at(1.0)).distance;
        first_meeting(segment, &triangle).is_some()
    }

    /// Nearest places of a segment and the triangle as it stands.
    pub fn nearest_to(&self, segment: [DVec3; 2]) -> Nearest {
        segment_triangle_in(self.plane.as_ref(), segment, self.now)
    }

    /// Nearest place on it to a point: distance and barycentric place; `None` where it is no nearer than `most`.
    pub fn nearest_to_point(&self, point: DVec3, most: f64) -> Option<(f64, [f64; 3])> {
        let reach = most + self.ball.radius;
        if point.distance_squared(self.ball.centre) > reach * reach {
            return None;
        }
        point_triangle_in(self.plane.as_ref(), point, self.now, most)
    }

    /// No more than a segment's distance from it, below zero where that tells nothing [m].
    pub fn gap(&self, segment: [DVec3; 2]) -> f64 {
        let [from, to] = segment;
        let (along, centre) = (to - from, self.ball.centre - from);
        let fraction = (centre.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let round = centre.distance(along * fraction) - self.ball.radius;
        self.plane.as_ref().map_or(round, |plane| round.max(plane.gap(segment)))
    }

    fn sweep_of(&self, places: &[DVec3], target: impl Fn(usize) -> DVec3) -> SweptSegment {
        SweptSegment { a0: places[self.node], b0: places[self.node + 1], a1: target(self.node), b1: target(self.node + 1) }
    }
}

/// A ball around a triangle, grown over rounding.
#[derive(Clone, Copy, Debug)]
struct Ball {
    centre: DVec3,
    radius: f64,
}

impl Ball {
    fn around(corners: [DVec3; 3]) -> Self {
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let square = corners.iter().map(|corner| corner.distance_squared(centre)).fold(0.0, f64::max);
        Self { centre, radius: square.sqrt() * GROWN + ROUNDING_M }
    }
}

/// The longer move of a segment's two ends [m].
fn greatest_move(segment: &SweptSegment) -> f64 {
    (segment.a1 - segment.a0).length_squared().max((segment.b1 - segment.b0).length_squared()).sqrt()
}

/// A barycentric place on a triangle.
pub(crate) fn on_triangle(corners: [DVec3; 3], barycentric: [f64; 3]) -> DVec3 {
    corners[0] * barycentric[0] + corners[1] * barycentric[1] + corners[2] * barycentric[2]
}
