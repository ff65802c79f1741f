//! Contact points: places on the rope where push and friction act.
//!
//! A segment near skin is cut into sub-segments of at most [`PIECE_M`], so that stiffness does not depend on
//! the length of segments. Each piece has a contact point at its middle, and more where another of its points
//! comes clearly nearer (a thin edge). A knot has one at its middle with its own radius as contact distance: skin pushes a knot along the
//! rope too, and so holds it at a gap narrower than it is. A contact point touches one face of skin, or several in a crease (`crease.rs`).
//!
//! A middle contact point keeps its place on the rope within a solver step. A further contact point at an edge of skin moves along its piece
//! with the edge. All others keep their places: if they moved to the nearest place in each iteration, Newton's method would not converge
//! (docs/physics.md).

use std::ops::Range;

use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};

use crate::contact::law::capstan_correction::{bend, friction_factor};
use crate::contact::rope_on_skin::crease;
use crate::contact::rope_on_skin::near::Near;
use crate::contact::rope_on_skin::pieces::Piece;
use crate::contact::rope_on_skin::stored_faces::{self, KeptFace, PIECE_BITS, SEGMENT_BITS};
use crate::contact::rope_on_skin::touch::Touch;
use crate::geometry::norm;
use crate::geometry::placed::on_triangle;
use crate::model::Model;
use crate::state::FrictionState;

/// Longest sub-segment that one contact point represents [m].
const PIECE_M: f64 = 0.025;
/// Pieces a segment is cut into at least.
const LEAST_PIECES: f64 = 2.0;
/// Further contact points are searched for only within this many contact distances.
pub(crate) const LOOK_WITHIN: f64 = 3.0;
/// How far a contact point is measured: contact distances, and besides [`LOOK_WITHIN`] lengths of its piece. Beyond, no point of the
/// piece is looked at.
const MEASURED_WITHIN: (f64, f64) = (4.0, 1.2);

/// Distances that differ by less than this are equal [m]: the closest place is on an edge or at a corner that triangles share.
const SAME_DISTANCE_M: f64 = 1e-10;

/// One place on the rope.
#[derive(Clone, Debug)]
pub(crate) struct SkinContactPoint {
    /// Number that names it from step to step: segment, piece, which of the piece's contact points; that of its first face.
    pub(super) site: u64,
    pub segment: usize,
    pub node: usize,
    pub fraction: f64,
    pub length: f64,
    /// Whether it is the middle of a knot, a ball whose surface faces every way.
    pub is_knot: bool,
    /// Its segment in `Near::groups`.
    pub(super) group: usize,
    /// Contact distance: the rope's radius [m].
    pub contact_distance: f64,
    pub(super) stiffness: f64,
    /// Where it was last measured, and the distance found there.
    pub(super) seen: Option<(DVec3, f64)>,
    /// The pair it was nearest to then, and the barycentric place on that.
    pub(super) nearest: Option<(usize, [f64; 3])>,
    /// Greatest push on its piece of rope when it was opened beside other contact points [N].
    pub(super) push_beside_n: Option<f64>,
    /// Ends of its piece, as fractions of the segment, if it follows an edge of skin; `None` for a middle contact point.
    pub(super) between: Option<[f64; 2]>,
    /// Its touches, in `SkinContactPoints::touches`.
    pub(super) touches: Range<usize>,
    /// The faces that it touched at the end of the last solver step, in `SkinContactPoints::kept`.
    pub(super) kept: Range<usize>,
}

/// All contact points of a solver step.
#[derive(Clone, Debug, Default)]
pub(crate) struct SkinContactPoints {
    pub(super) arch: Arch,
    /// In rising order of site, each once.
    pub list: Vec<SkinContactPoint>,
    /// The sub-segments of rope, in the same order, and the contact points of each in `list`.
    pub(super) pieces: Vec<Piece>,
    /// The pieces in which contact points were opened last, and these points.
    pub(super) opened: Vec<(usize, SkinContactPoint)>,
    /// Their touches, point after point.
    pub(super) touches: Vec<Touch>,
    /// Touches of the evaluation before.
    touched: Vec<Touch>,
    /// Faces that were touched at the end of the last solver step, where passes set out from it.
    pub(super) kept: Vec<KeptFace>,
    /// Bend of each segment where the solver step began, as `Near::groups`; `None` until it is asked for.
    bends: Vec<Option<f64>>,
}

impl SkinContactPoints {
    /// Opens the middle contact points of every segment that has pairs. Passes set out from what skin pushed with in the last solver step, and
    /// not from the distances of a first guess.
    pub fn open(
        &mut self,
        model: &Model,
        near: &Near,
        segment_length: &[f64],
        stiffness_n_m2: f64,
        friction: &FrictionState,
    ) {
        stored_faces::take(friction, &mut self.kept);
        self.arch.dispatch(Open { points: self, model, near, segment_length, stiffness_n_m2 });
    }

    #[inline(always)]
    fn open_middles(
        &mut self,
        model: &Model,
        near: &Near,
        segment_length: &[f64],
        stiffness_n_m2: f64,
    ) {
        self.list.clear();
        self.pieces.clear();
        self.bends.clear();
        self.bends.resize(near.groups.len(), None);
        let mut kept = 0..0;
        for (index, group) in near.groups.iter().enumerate() {
            if group.active.is_empty() {
                continue;
            }
            let (segment, length) = (group.segment, segment_length[group.segment]);
            let pieces = (length / PIECE_M).ceil().max(LEAST_PIECES);
            let knots = model.knots_of_segment(segment);
            let piece_m = length / pieces;
            for piece in 0..pieces as usize + knots.len() {
                let knot = piece.checked_sub(pieces as usize).map(|knot| &knots[knot]);
                let (fraction, bears_m) = knot.map_or_else(
                    || ((piece as f64 + 0.5) / pieces, piece_m),
                    |knot| (knot.fraction(length), 2.0 * knot.radius_m),
                );
                let site = ((segment as u64) << SEGMENT_BITS) | ((piece as u64) << PIECE_BITS);
                kept = stored_faces::next_of_piece(&self.kept, kept.end, site);
                let faces = &self.kept[kept.clone()];
                let first = self.list.len();
                let share = 0.5 * bears_m / length;
                let of_middle = stored_faces::of_point(faces, site);
                self.pieces.push(Piece {
                    points: first..first + 1,
                    between: [fraction - share, fraction + share],
                    segment_length: length,
                    beside: stored_faces::points_beside(faces),
                    looked: None,
                });
                self.list.push(SkinContactPoint {
                    site,
                    segment,
                    node: group.node,
                    fraction,
                    length: bears_m,
                    is_knot: knot.is_some(),
                    group: index,
                    contact_distance: knot.map_or(group.radius, |knot| knot.radius_m),
                    stiffness: stiffness_n_m2 * bears_m,
                    seen: None,
                    nearest: None,
                    push_beside_n: None,
                    between: None,
                    touches: 0..0,
                    kept: kept.start..kept.start + of_middle.len(),
                });
            }
        }
    }

    /// Evaluates every contact point at these places.
    pub fn measure(&mut self, near: &Near, places: &[DVec3]) {
        std::mem::swap(&mut self.touches, &mut self.touched);
        self.touches.clear();
        self.arch.dispatch(Measure { points: self, near, places, only_opened: false });
    }

    /// Evaluates the contact points that were opened last, at the places at which all others have been evaluated.
    pub fn measure_opened(&mut self, near: &Near, places: &[DVec3]) {
        self.arch.dispatch(Measure { points: self, near, places, only_opened: true });
    }

    /// Factor on the friction of a contact point that corrects for the polygon (`law/capstan_correction.rs`), with the rope `from` where the
    /// solver step began.
    #[inline(always)]
    pub fn friction_factor(&mut self, model: &Model, from: &[DVec3], point: usize) -> f64 {
        let point = &self.list[point];
        let bend = *self.bends[point.group]
            .get_or_insert_with(|| bend(model, from, point.segment, point.node));
        friction_factor(bend, point.fraction)
    }

    /// Notes the push that a solution found for a face of a contact point, which it moves by `step`.
    pub fn note_solved(&mut self, point: usize, face: usize, step: DVec3) {
        let touch = &mut self.touches[self.list[point].touches.start + face];
        touch.solved_n = Some(touch.push_after(step));
    }

    /// Makes the normal force of a face linear about a solution that moves it by `step`.
    pub fn follow_law(&mut self, point: usize, face: usize, step: DVec3) -> &Touch {
        let point = &self.list[point];
        let touch = &mut self.touches[point.touches.start + face];
        touch.follow_law(step, point.contact_distance, point.stiffness);
        touch
    }

    /// How far the push that a solution found for a face of a contact point is from the law's [N].
    pub fn law_missed(&self, point: usize, face: usize, step: DVec3) -> f64 {
        let point = &self.list[point];
        let touch = &self.touches[point.touches.start + face];
        touch.law_missed(step, point.contact_distance, point.stiffness)
    }

    /// Whether skin is nearer than this to any contact point in touch [m].
    pub fn any_nearer_than(&self, distance: f64) -> bool {
        self.touches.iter().any(|touch| touch.distance < distance)
    }

    /// Touches of a contact point, as evaluated last.
    pub fn touches(&self, point: &SkinContactPoint) -> &[Touch] {
        &self.touches[point.touches.clone()]
    }
}

/// Opens the middle contact points, with the instructions of the processor.
struct Open<'a> {
    points: &'a mut SkinContactPoints,
    model: &'a Model,
    near: &'a Near,
    segment_length: &'a [f64],
    stiffness_n_m2: f64,
}

impl WithSimd for Open<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { points, model, near, segment_length, stiffness_n_m2 } = self;
        points.open_middles(model, near, segment_length, stiffness_n_m2);
    }
}

/// Evaluates every contact point, with the instructions of the processor.
struct Measure<'a> {
    points: &'a mut SkinContactPoints,
    near: &'a Near,
    places: &'a [DVec3],
    /// Whether only those are evaluated that were opened last, each behind the others of its piece.
    only_opened: bool,
}

impl WithSimd for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let SkinContactPoints { list, pieces, opened, touches, touched, kept, .. } = self.points;
        let count = if self.only_opened { opened.len() } else { list.len() };
        for place in 0..count {
            let point = if self.only_opened {
                &mut list[pieces[opened[place].0].points.end - 1]
            } else {
                &mut list[place]
            };
            let first = touches.len();
            point.measure(self.near, self.places, (touched, kept), touches);
            point.touches = first..touches.len();
        }
    }
}

/// Whether two barycentric places of a triangle are on the same edge, or one is at a corner of the other's edge.
#[inline(always)]
fn are_on_one_edge(one: [f64; 3], other: [f64; 3]) -> bool {
    one.iter().zip(other).any(|(one, other)| *one == 0.0 && other == 0.0)
}

/// Whether a triangle is nearer than another, each given by its distance and pair. Of triangles at equal distances the first pair is the
/// nearest: else rounding would choose, and friction change from iteration to iteration where an edge is between two regions.
#[inline(always)]
fn is_nearer((distance, pair): (f64, usize), other: (f64, usize)) -> bool {
    distance < other.0 - SAME_DISTANCE_M || (distance < other.0 + SAME_DISTANCE_M && pair < other.1)
}

impl SkinContactPoint {
    /// Its place on the rope.
    pub fn on_rope(&self, place: impl Fn(usize) -> DVec3) -> DVec3 {
        place(self.node).lerp(place(self.node + 1), self.fraction)
    }

    /// Adds its touches at these places to `touches`; copies those of the evaluation before if it has not moved.
    #[inline(always)]
    fn measure(
        &mut self,
        near: &Near,
        places: &[DVec3],
        (touched, kept): (&[Touch], &[KeptFace]),
        touches: &mut Vec<Touch>,
    ) {
        self.follow_edge(near, places);
        let place = self.on_rope(|node| places[node]);
        let first = touches.len();
        if self.seen.is_some_and(|(seen, _)| seen == place) {
            touches.extend_from_slice(&touched[self.touches.clone()]);
            return;
        }
        if self.out_of_reach(place) {
            return;
        }
        let within = (MEASURED_WITHIN.0 * self.contact_distance)
            .max(LOOK_WITHIN * self.contact_distance + MEASURED_WITHIN.1 * self.length);
        self.seen = Some((place, within));
        if let Some((distance, nearest)) = self.add_touches(near, place, within, touches) {
            self.seen = Some((place, distance));
            self.nearest = Some(nearest);
        }
        if touches.len() == first {
            return;
        }
        if !self.is_knot {
            let along = norm::normalize_or(places[self.node + 1] - places[self.node], DVec3::ZERO);
            touches[first..].iter_mut().for_each(|touch| touch.turn_across(along));
        }
        stored_faces::assign(&mut touches[first..], kept, self.kept.clone());
        for touch in &mut touches[first..] {
            let before = touch.among(&touched[self.touches.clone()]);
            if let Some(before) = before {
                touch.region_pair = before.region_pair;
            }
            let whole_n = before
                .and_then(Touch::whole_solved_n)
                .or_else(|| Some(kept[touch.kept?].push_n))
                .or(self.push_beside_n);
            touch.solved_n = whole_n.map(|whole_n| whole_n * touch.share);
            touch.take_solved(self.contact_distance, self.stiffness);
        }
    }

    /// Moves it along its piece to the place that is nearest to the edge of skin at which it was measured last.
    ///
    /// While rope slides over an edge, the distance of one of its places from the edge changes to second order. The linear system does not
    /// contain that term, and the normal force had an error from it. The distance of the nearest place does not change to first order with
    /// the place (docs/lab-notebook.md).
    #[inline(always)]
    fn follow_edge(&mut self, near: &Near, places: &[DVec3]) {
        let (Some([from, to]), Some((pair, barycentric))) = (self.between, self.nearest) else {
            return;
        };
        if !barycentric.contains(&0.0) {
            return;
        }
        let ends = [from, to].map(|end| places[self.node].lerp(places[self.node + 1], end));
        let nearest = near.skin_of(pair).nearest_to(ends);
        let fraction = from + (to - from) * nearest.fraction;
        let piece_m = norm::distance(ends[0], ends[1]);
        let moved_m = piece_m * (fraction - self.fraction).abs() / (to - from);
        // Two edges of a triangle may be equally near; a point that changed between them would not converge.
        if are_on_one_edge(nearest.barycentric, barycentric) && moved_m < self.contact_distance {
            self.fraction = fraction;
        }
    }

    /// Number that names a face that it touches from step to step.
    pub fn site(&self, face: usize) -> u64 {
        self.site | face as u64
    }

    /// Adds its touches; returns distance, pair and barycentric place of the nearest triangle within `most`. The nearest triangle of the
    /// last evaluation is measured first: most others are then excluded by their bounds.
    #[inline(always)]
    fn add_touches(
        &self,
        near: &Near,
        place: DVec3,
        most: f64,
        touches: &mut Vec<Touch>,
    ) -> Option<(f64, (usize, [f64; 3]))> {
        let (first, mut nearest_place) = (touches.len(), 0);
        let mut nearest: Option<(f64, (usize, [f64; 3]))> = None;
        let mut least = most;
        let group = &near.groups[self.group];
        let active = near.active[group.active.clone()].iter().copied();
        let last = self.nearest.map(|(pair, _)| pair);
        let others = active.filter(|index| Some(*index) != last);
        for index in last.into_iter().chain(others) {
            let within = least.max(self.contact_distance);
            if near.bound(index, group) >= within {
                continue;
            }
            let Some((distance, barycentric)) = near.skin_of(index).nearest_to_point(place, within)
            else {
                continue;
            };
            let so_far =
                nearest.map_or((most, usize::MAX), |(distance, (pair, _))| (distance, pair));
            if is_nearer((distance, index), so_far) {
                (nearest, nearest_place) = (Some((distance, (index, barycentric))), touches.len());
            }
            least = least.min(distance);
            touches.extend(self.touch_of(near, place, distance, index, barycentric));
        }
        if touches.len() > first {
            crease::keep_faces(touches, first, nearest_place);
            let law = (self.contact_distance, self.stiffness);
            touches[first..].iter_mut().for_each(|touch| touch.take_law(law));
        }
        nearest
    }

    #[inline(always)]
    fn touch_of(
        &self,
        near: &Near,
        place: DVec3,
        distance: f64,
        pair: usize,
        barycentric: [f64; 3],
    ) -> Option<Touch> {
        (distance < self.contact_distance).then(|| {
            let closest = on_triangle(near.skin_of(pair).now, barycentric);
            let away = (place - closest) / distance.max(1e-12);
            Touch::new((pair, barycentric), place, (away, distance))
        })
    }

    /// Whether it cannot touch, by its last evaluation.
    #[inline(always)]
    fn out_of_reach(&self, place: DVec3) -> bool {
        self.seen.is_some_and(|(seen, distance)| {
            distance - norm::distance(seen, place) > self.contact_distance
        })
    }

    /// The way from the nearest place of skin to where it was last measured, zero if there is none.
    #[inline(always)]
    pub(super) fn away(&self, near: &Near) -> DVec3 {
        let (Some((seen, _)), Some((pair, barycentric))) = (self.seen, self.nearest) else {
            return DVec3::ZERO;
        };
        seen - on_triangle(near.skin_of(pair).now, barycentric)
    }

    /// Lower bound of its distance from skin at these places.
    #[inline(always)]
    pub(super) fn at_least(&self, places: &[DVec3]) -> f64 {
        let place = self.on_rope(|node| places[node]);
        self.seen.map_or(0.0, |(seen, distance)| distance - norm::distance(seen, place))
    }
}
