//! Contact points: places on the rope where push and friction act.
//!
//! A segment near skin is cut into sub-segments of at most [`PIECE_M`], so that stiffness does not depend on
//! the length of segments. Each piece has a contact point at its middle, and more where another of its points
//! comes clearly nearer (a thin edge). A knot has one at its middle with its own radius as contact distance: skin pushes a knot along the
//! rope too, and so holds it at a gap narrower than it is. A contact point touches one face of skin, or several in a crease (`crease.rs`). Contact points keep their place on the rope within a solver step: letting
//! them hop to the closest point in every pass is what keeps Newton from converging (docs/physics.md).

use std::ops::Range;

use glam::DVec3;

use crate::contact::law::capstan_correction::friction_factor;
use crate::contact::rope_on_skin::crease;
use crate::contact::rope_on_skin::near::Near;
use crate::contact::rope_on_skin::stored_faces::{
    self, FACE_BITS, KeptFace, MOST_POINTS, PIECE_BITS, SEGMENT_BITS,
};
use crate::contact::rope_on_skin::touch::Touch;
use crate::geometry::placed::on_triangle;
use crate::model::Model;
use crate::state::FrictionState;

/// Longest sub-segment that one contact point represents [m].
const PIECE_M: f64 = 0.025;
/// Pieces a segment is cut into at least.
const LEAST_PIECES: f64 = 2.0;
/// A further contact point is opened where its distance is below this share of those there are, and less by this share of the contact distance.
const NEARER: f64 = 0.8;
const NEARER_BY: f64 = 0.1;
/// Further contact points are searched for only within this many contact distances.
const LOOK_WITHIN: f64 = 3.0;
/// How far a contact point is measured: contact distances, and besides [`LOOK_WITHIN`] lengths of its piece. Beyond, no point of the
/// piece is looked at.
const MEASURED_WITHIN: (f64, f64) = (4.0, 1.2);

/// One place on the rope.
#[derive(Clone, Debug)]
pub(crate) struct SkinContactPoint {
    /// Number that names it from step to step: segment, piece, which of the piece's contact points; that of its first face.
    site: u64,
    pub segment: usize,
    pub node: usize,
    pub fraction: f64,
    pub length: f64,
    /// Whether it is the middle of a knot, a ball whose surface faces every way.
    pub is_knot: bool,
    segment_length: f64,
    /// Its segment in `Near::groups`, and the pairs of that which may touch, in `Near::active`.
    group: usize,
    pairs: Range<usize>,
    /// Contact distance: the rope's radius [m].
    pub contact_distance: f64,
    stiffness: f64,
    /// Where it was last measured, and the distance found there.
    seen: Option<(DVec3, f64)>,
    /// The pair it was nearest to then.
    nearest_pair: Option<usize>,
    /// Greatest push on its piece of rope when it was opened beside other contact points [N].
    push_beside_n: Option<f64>,
    /// Its touches, in `SkinContactPoints::touches`.
    touches: Range<usize>,
    /// Where the solver step began.
    pub began: Began,
    /// Force on it by the last solution less the force at the trial [N].
    pub missed: DVec3,
}

/// A contact point where the solver step began.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Began {
    /// Its place.
    pub place: DVec3,
    /// Its segment, end to end.
    pub along: DVec3,
    /// Factor on friction that corrects for the polygon (`law/capstan_correction.rs`).
    pub friction_factor: f64,
}

/// All contact points of a solver step.
#[derive(Clone, Debug, Default)]
pub(crate) struct SkinContactPoints {
    pub list: Vec<SkinContactPoint>,
    /// Their touches, point after point.
    touches: Vec<Touch>,
    /// Touches of the evaluation before.
    touched: Vec<Touch>,
    /// Faces that were touched at the end of the last solver step, where passes set out from it.
    kept: Vec<KeptFace>,
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
        self.list.clear();
        for (index, group) in near.groups.iter().enumerate() {
            if group.active.is_empty() {
                continue;
            }
            let (segment, length) = (group.segment, segment_length[group.segment]);
            let pieces = (length / PIECE_M).ceil().max(LEAST_PIECES);
            let point = |piece: u64, fraction: f64, bears_m: f64| SkinContactPoint {
                site: ((segment as u64) << SEGMENT_BITS) | (piece << PIECE_BITS),
                segment,
                node: group.node,
                fraction,
                length: bears_m,
                is_knot: false,
                segment_length: length,
                group: index,
                pairs: group.active.clone(),
                contact_distance: group.radius,
                stiffness: stiffness_n_m2 * bears_m,
                seen: None,
                nearest_pair: None,
                push_beside_n: None,
                touches: 0..0,
                began: Began::default(),
                missed: DVec3::ZERO,
            };
            for piece in 0..pieces as u64 {
                self.list.push(point(piece, (piece as f64 + 0.5) / pieces, length / pieces));
            }
            for (knot, piece) in model.knots_of_segment(segment).iter().zip(pieces as u64..) {
                self.list.push(SkinContactPoint {
                    is_knot: true,
                    contact_distance: knot.radius_m,
                    ..point(piece, knot.fraction(length), 2.0 * knot.radius_m)
                });
            }
        }
    }

    /// Opens further contact points where a piece of rope is clearly nearer to skin than at those it has; how many.
    pub fn open_more(&mut self, near: &Near, places: &[DVec3]) -> usize {
        let count = self.list.len();
        let mut from = 0;
        while from < count {
            let piece = self.list[from].site >> PIECE_BITS;
            let to = (from..count)
                .find(|index| self.list[*index].site >> PIECE_BITS != piece)
                .unwrap_or(count);
            let least = self.list[from..to]
                .iter()
                .map(|point| point.at_least(places))
                .fold(f64::INFINITY, f64::min);
            if self.list[from].is_knot || self.list[from].is_far(least, places) {
                from = to;
                continue;
            }
            // Else each step would first sink in where a point is missing that bears.
            let most = if to - from <= stored_faces::points_beside(&self.kept, piece) {
                least
            } else {
                (NEARER * least).min(least - NEARER_BY * self.list[from].contact_distance)
            };
            if to - from < MOST_POINTS
                && let Some(fraction) = self.list[from].nearer_fraction(near, places, most)
            {
                let site = self.list[to - 1].site + (1 << FACE_BITS);
                let beside = self.list[from..to].iter().flat_map(|point| self.touches(point));
                let push_n = beside.map(|touch| touch.barrier.force).fold(0.0, f64::max);
                self.list.push(SkinContactPoint {
                    site,
                    fraction,
                    seen: None,
                    push_beside_n: Some(push_n),
                    touches: 0..0,
                    missed: DVec3::ZERO,
                    ..self.list[from].clone()
                });
            }
            from = to;
        }
        let opened = self.list.len() - count;
        if opened > 0 {
            self.list.sort_unstable_by_key(|point| point.site);
        }
        debug_assert!(
            self.list.windows(2).all(|two| two[0].site < two[1].site),
            "contact points in rising order of site, each once"
        );
        opened
    }

    /// Evaluates every contact point at these places.
    pub fn measure(&mut self, near: &Near, places: &[DVec3]) {
        std::mem::swap(&mut self.touches, &mut self.touched);
        self.touches.clear();
        for point in &mut self.list {
            let first = self.touches.len();
            point.measure(near, places, (&self.touched, &self.kept), &mut self.touches);
            point.touches = first..self.touches.len();
        }
    }

    /// Notes where the contact points were when the solver step began, with the rope `from` there.
    pub fn begin(&mut self, model: &Model, from: &[DVec3]) {
        for point in &mut self.list {
            let segment = (point.segment, point.node);
            point.began = Began {
                place: point.on_rope(|node| from[node]),
                along: from[point.node + 1] - from[point.node],
                friction_factor: friction_factor(model, from, segment, point.fraction),
            };
        }
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

    /// Touches of a contact point, as evaluated last.
    pub fn touches(&self, point: &SkinContactPoint) -> &[Touch] {
        &self.touches[point.touches.clone()]
    }
}

impl SkinContactPoint {
    /// Its place on the rope.
    pub fn on_rope(&self, place: impl Fn(usize) -> DVec3) -> DVec3 {
        place(self.node).lerp(place(self.node + 1), self.fraction)
    }

    /// Adds its touches at these places to `touches`; copies those of the evaluation before if it has not moved.
    fn measure(
        &mut self,
        near: &Near,
        places: &[DVec3],
        (touched, kept): (&[Touch], &[KeptFace]),
        touches: &mut Vec<Touch>,
    ) {
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
        if let Some((distance, pair)) = self.add_touches(near, place, within, touches) {
            self.seen = Some((place, distance));
            self.nearest_pair = Some(pair);
        }
        if !self.is_knot {
            let along = (places[self.node + 1] - places[self.node]).normalize_or_zero();
            touches[first..].iter_mut().for_each(|touch| touch.turn_across(along));
        }
        stored_faces::assign(&mut touches[first..], kept, stored_faces::of_point(kept, self.site));
        for touch in &mut touches[first..] {
            let whole_n = touch
                .solved_before(&touched[self.touches.clone()])
                .or_else(|| Some(kept[touch.kept?].push_n))
                .or(self.push_beside_n);
            touch.solved_n = whole_n.map(|whole_n| whole_n * touch.share);
            touch.take_solved(self.contact_distance, self.stiffness);
        }
    }

    /// Number that names a face that it touches from step to step.
    pub fn site(&self, face: usize) -> u64 {
        self.site | face as u64
    }

    /// Adds its touches; returns distance and pair of the nearest triangle within `most`. The nearest triangle of the last evaluation is
    /// measured first: most others are then excluded by their bounds.
    fn add_touches(
        &self,
        near: &Near,
        place: DVec3,
        most: f64,
        touches: &mut Vec<Touch>,
    ) -> Option<(f64, usize)> {
        let (first, mut nearest, mut nearest_place) = (touches.len(), None, 0);
        let mut least = most;
        let group = &near.groups[self.group];
        let active = near.active[self.pairs.clone()].iter().copied();
        let others = active.filter(|index| Some(*index) != self.nearest_pair);
        for index in self.nearest_pair.into_iter().chain(others) {
            let within = least.max(self.contact_distance);
            if near.bound(index, group) >= within {
                continue;
            }
            let Some((distance, barycentric)) = near.skin_of(index).nearest_to_point(place, within)
            else {
                continue;
            };
            if distance < least {
                least = distance;
                (nearest, nearest_place) = (Some((distance, index)), touches.len());
            }
            touches.extend(self.touch_of(near, place, distance, index, barycentric));
        }
        if touches.len() > first {
            crease::keep_faces(touches, first, nearest_place);
            let law = (self.contact_distance, self.stiffness);
            touches[first..].iter_mut().for_each(|touch| touch.take_law(law));
        }
        nearest
    }

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
    fn out_of_reach(&self, place: DVec3) -> bool {
        self.seen
            .is_some_and(|(seen, distance)| distance - seen.distance(place) > self.contact_distance)
    }

    /// Lower bound of its distance from skin at these places.
    fn at_least(&self, places: &[DVec3]) -> f64 {
        let place = self.on_rope(|node| places[node]);
        self.seen.map_or(0.0, |(seen, distance)| distance - seen.distance(place))
    }

    /// Whether its sub-segment is too far from skin for a further contact point, if a place of it is `least` from skin.
    fn is_far(&self, least: f64, places: &[DVec3]) -> bool {
        let segment = places[self.node].distance(places[self.node + 1]);
        let piece = segment * self.length / self.segment_length;
        least - piece > LOOK_WITHIN * self.contact_distance
    }

    /// Where along the segment its sub-segment is nearest to skin, if closer than `most`. Called for the middle contact point.
    fn nearer_fraction(&self, near: &Near, places: &[DVec3], most: f64) -> Option<f64> {
        let share = 0.5 * self.length / self.segment_length;
        let (from, to) = (self.fraction - share, self.fraction + share);
        let ends =
            [from, to].map(|fraction| places[self.node].lerp(places[self.node + 1], fraction));
        let mut least = most.min(LOOK_WITHIN * self.contact_distance);
        let mut along = None;
        let group = &near.groups[self.group];
        for index in near.active[self.pairs.clone()].iter().copied() {
            if near.bound(index, group) >= least || near.skin_of(index).gap(ends) >= least {
                continue;
            }
            let nearest = near.skin_of(index).nearest_to(ends);
            if nearest.distance < least {
                least = nearest.distance;
                along = Some(nearest.fraction);
            }
        }
        Some(from + (to - from) * along?)
    }
}
