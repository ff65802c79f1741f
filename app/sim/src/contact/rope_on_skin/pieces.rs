//! Sub-segments of rope near skin, and the search for places on them that are nearer to skin than their contact points.

use std::ops::Range;

use glam::DVec3;
use pulp::{Simd, WithSimd};

use crate::contact::rope_on_skin::near::{Group, Near};
use crate::contact::rope_on_skin::points::{LOOK_WITHIN, SkinContactPoint, SkinContactPoints};
use crate::contact::rope_on_skin::stored_faces::{self, FACE_BITS, MOST_POINTS};
use crate::geometry::norm;

/// A further contact point is opened where its distance is below this share of those there are, and less by this share of the contact distance.
const NEARER: f64 = 0.8;
const NEARER_BY: f64 = 0.1;
/// A search measures distances up to this share of the contact distance beyond what it needs, so that the next search may be omitted.
const BEYOND: f64 = 0.1;
/// Rounding of distances [m].
const ROUNDING_M: f64 = 1e-9;

/// A sub-segment of rope near skin, with a contact point in its middle and perhaps more.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// Its contact points in `SkinContactPoints::list`.
    pub points: Range<usize>,
    /// Where on the segment it begins and ends, as fractions.
    pub between: [f64; 2],
    /// Length of its segment [m].
    pub segment_length: f64,
    /// Contact points beside its middle one that bore much of the push on it in the last solver step.
    pub beside: usize,
    /// The last search that found nothing.
    pub looked: Option<Looked>,
}

/// A search that found no place nearer to skin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Looked {
    /// Ends of the piece.
    ends: [DVec3; 2],
    /// Lower bound of its distance there from all triangles that may touch its segment in the solver step [m].
    bound: f64,
}

impl Looked {
    /// Whether a piece with its ends there is certainly no nearer than `least`.
    #[inline(always)]
    fn excludes(&self, ends: [DVec3; 2], least: f64) -> bool {
        let room = self.bound - least - ROUNDING_M;
        let moved =
            ends[0].distance_squared(self.ends[0]).max(ends[1].distance_squared(self.ends[1]));
        room > 0.0 && moved < room * room
    }
}

/// Searches pieces for further contact points, with the instructions of the processor.
struct Search<'a> {
    points: &'a mut SkinContactPoints,
    near: &'a Near,
    places: &'a [DVec3],
    /// The number of contact points opened last, if only their pieces are searched.
    beside: Option<usize>,
}

impl WithSimd for Search<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { points, near, places, beside } = self;
        for place in 0..beside.unwrap_or(points.pieces.len()) {
            let piece = if beside.is_some() { points.opened[place].0 } else { place };
            points.open_in(piece, near, places);
        }
    }
}

impl SkinContactPoints {
    /// Opens further contact points where a piece of rope is clearly nearer to skin than at those it has; returns how many.
    pub fn open_more(&mut self, near: &Near, places: &[DVec3]) -> usize {
        self.opened.clear();
        self.arch.dispatch(Search { points: self, near, places, beside: None });
        self.insert_opened()
    }

    /// Opens further contact points in the pieces in which some were opened last, with rope at the same places; returns how many. A search in
    /// any other piece would find nothing again.
    pub fn open_more_beside_opened(&mut self, near: &Near, places: &[DVec3]) -> usize {
        let count = self.opened.len();
        self.arch.dispatch(Search { points: self, near, places, beside: Some(count) });
        self.opened.drain(..count);
        self.insert_opened()
    }

    /// Appends a further contact point of a piece to those opened, if there is one.
    #[inline(always)]
    fn open_in(&mut self, index: usize, near: &Near, places: &[DVec3]) {
        let piece = &mut self.pieces[index];
        let points = &self.list[piece.points.clone()];
        let middle = &points[0];
        if middle.is_knot || points.len() >= MOST_POINTS {
            return;
        }
        let least = points.iter().map(|point| point.at_least(places)).fold(f64::INFINITY, f64::min);
        if piece.is_far(middle, least, places) {
            return;
        }
        // Else each step would first sink in where a point is missing that bears.
        let most = if points.len() <= piece.beside {
            least
        } else {
            (NEARER * least).min(least - NEARER_BY * middle.contact_distance)
        };
        let Some(fraction) = piece.nearer_fraction(middle, near, places, most) else { return };
        let touches = points.iter().flat_map(|point| &self.touches[point.touches.clone()]);
        let push_n = touches.map(|touch| touch.barrier.force).fold(0.0, f64::max);
        let site = points[points.len() - 1].site + (1 << FACE_BITS);
        let point = SkinContactPoint {
            site,
            fraction,
            seen: None,
            nearest: None,
            push_beside_n: Some(push_n),
            between: Some(piece.between),
            touches: 0..0,
            kept: stored_faces::of_point(&self.kept, site),
            ..middle.clone()
        };
        self.opened.push((index, point));
    }

    /// Inserts the contact points opened into the list, each behind the others of its piece; returns how many.
    fn insert_opened(&mut self) -> usize {
        let opened = self.opened.len();
        if opened == 0 {
            return 0;
        }
        let mut end = self.list.len() + opened;
        self.list.extend(self.opened.iter().map(|(_, point)| point.clone()));
        // From the last on: what is behind a contact point changes places with it and with those before it.
        for (before, (piece, _)) in self.opened.iter().enumerate().rev() {
            let begin = self.pieces[*piece].points.end;
            self.list[begin..end].rotate_right(before + 1);
            end = begin + before;
        }
        let (mut shift, mut places) = (0, self.opened.iter().map(|(piece, _)| *piece).peekable());
        for (index, piece) in self.pieces.iter_mut().enumerate() {
            piece.points.start += shift;
            shift += usize::from(places.next_if_eq(&index).is_some());
            piece.points.end += shift;
        }
        debug_assert!(
            self.list.windows(2).all(|two| two[0].site < two[1].site),
            "contact points in rising order of site, each once"
        );
        opened
    }
}

impl Piece {
    /// Whether it is too far from skin for a further contact point, if a place of it is `least` from skin.
    #[inline(always)]
    fn is_far(&self, middle: &SkinContactPoint, least: f64, places: &[DVec3]) -> bool {
        let within = LOOK_WITHIN * middle.contact_distance;
        least > within && {
            let segment = norm::distance(places[middle.node], places[middle.node + 1]);
            least - segment * middle.length / self.segment_length > within
        }
    }

    /// Where along the segment it is nearest to skin, if closer than `most`.
    #[inline(always)]
    fn nearer_fraction(
        &mut self,
        middle: &SkinContactPoint,
        near: &Near,
        places: &[DVec3],
        most: f64,
    ) -> Option<f64> {
        let ends = self
            .between
            .map(|fraction| places[middle.node].lerp(places[middle.node + 1], fraction));
        let mut least = most.min(LOOK_WITHIN * middle.contact_distance);
        if self.looked.is_some_and(|looked| looked.excludes(ends, least)) {
            return None;
        }
        let group: &Group = &near.groups[middle.group];
        let (mut along, mut bound) = (None, f64::INFINITY);
        let beyond = BEYOND * middle.contact_distance;
        let side = Side::of(middle, near, ends);
        for index in near.active[group.active.clone()].iter().copied() {
            let mut clear = near.bound(index, group);
            if clear < least + beyond {
                let skin = near.skin_of(index);
                if side.is_beyond(&skin.now, least + beyond) || skin.is_beyond(ends, least + beyond)
                {
                    clear = least + beyond;
                } else {
                    let nearest = skin.nearest_to(ends);
                    clear = nearest.distance;
                    if clear < least {
                        (least, along) = (clear, Some(nearest.fraction));
                    }
                }
            }
            bound = bound.min(clear);
        }
        self.looked = along.is_none().then_some(Looked { ends, bound });
        let [from, to] = self.between;
        Some(from + (to - from) * along?)
    }
}

/// The side of a plane on which a piece lies.
struct Side {
    /// Across the plane, of any length.
    across: DVec3,
    length: f64,
    /// The lesser of its ends in that direction.
    least: f64,
}

impl Side {
    /// The plane through the place on skin that is nearest to the middle contact point, across the way there.
    #[inline(always)]
    fn of(middle: &SkinContactPoint, near: &Near, ends: [DVec3; 2]) -> Self {
        let across = middle.away(near);
        let [from, to] = ends.map(|end| end.dot(across));
        Self { across, length: norm::length(across), least: from.min(to) }
    }

    /// Whether a triangle lies on the other side, no nearer than `most`.
    #[inline(always)]
    fn is_beyond(&self, triangle: &[DVec3; 3], most: f64) -> bool {
        let least = self.least - most * self.length;
        triangle.iter().all(|corner| corner.dot(self.across) < least)
    }
}
