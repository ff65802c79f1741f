//! Contact slots: places on the rope where push and friction act.
//!
//! A segment near skin is cut into sub-segments of at most [`PIECE_M`], so that stiffness does not depend on
//! the length of segments. Each piece has a slot at its middle, and one more where another of its points
//! comes clearly nearer (a thin edge). Slots keep their place on the rope within a solver step: letting
//! them hop to the closest point in every pass is what keeps Newton from converging (docs/physics.md).

use std::ops::Range;

use glam::DVec3;

use super::distance::{point_triangle, segment_triangle};
use super::law::Press;
use super::near::{Near, on_triangle};
use crate::model::Model;

/// Longest piece of rope one slot stands for [m].
const PIECE_M: f64 = 0.025;
/// A second slot is opened where its distance is below this share of the first's.
const NEARER: f64 = 0.8;
/// Second slots are looked for only within this many contact distances.
const LOOK_WITHIN: f64 = 3.0;

/// One place on the rope.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    /// Number that names it from step to step: segment, piece, first or second.
    pub site: u64,
    pub segment: usize,
    pub node: usize,
    pub fraction: f64,
    pub length: f64,
    segment_length: f64,
    /// Its pairs in `Near::pairs`.
    pairs: Range<usize>,
    /// Contact distance: the rope's radius [m].
    pub reach: f64,
    stiffness: f64,
    /// Where it was last measured, and the distance found there.
    seen: Option<(DVec3, f64)>,
    /// What it touches now.
    pub touch: Option<Touch>,
}

/// A slot in touch with skin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub pair: usize,
    pub barycentric: [f64; 3],
    pub place: DVec3,
    pub normal: DVec3,
    pub distance: f64,
    pub press: Press,
}

/// All slots of a solver step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slots {
    pub list: Vec<Slot>,
}

impl Slots {
    /// Opens the middle slots of every segment that has pairs.
    pub fn open(&mut self, model: &Model, near: &Near, stiffness_n_m2: f64) {
        self.list.clear();
        for (segment, range) in &near.groups {
            let length = model.segment_length(*segment);
            let pieces = (length / PIECE_M).ceil().max(1.0);
            let reach = 0.5 * model.rope_of_segment(*segment).diameter_m;
            for piece in 0..pieces as u64 {
                self.list.push(Slot {
                    site: ((*segment as u64) << 16) | (piece << 1),
                    segment: *segment,
                    node: near.pairs[range.start].node,
                    fraction: (piece as f64 + 0.5) / pieces,
                    length: length / pieces,
                    segment_length: length,
                    pairs: range.clone(),
                    reach,
                    stiffness: stiffness_n_m2 * length / pieces,
                    seen: None,
                    touch: None,
                });
            }
        }
    }

    /// Opens second slots where a piece of rope is clearly nearer to skin than at its middle.
    pub fn open_second(&mut self, near: &Near, places: &[DVec3]) {
        for index in 0..self.list.len() {
            let slot = &self.list[index];
            let is_second = slot.site & 1 == 1;
            let has_second = self.list.get(index + 1).is_some_and(|next| next.site == slot.site + 1);
            if is_second || has_second {
                continue;
            }
            if let Some(second) = slot.second(near, places) {
                self.list.push(second);
            }
        }
        self.list.sort_unstable_by_key(|slot| slot.site);
    }

    /// Measures every slot at the places given.
    pub fn measure(&mut self, near: &Near, places: &[DVec3]) {
        for slot in &mut self.list {
            slot.measure(near, places);
        }
    }

    /// Forgets what was seen, for skin that has moved.
    pub fn forget(&mut self) {
        for slot in &mut self.list {
            slot.seen = None;
        }
    }
}

impl Slot {
    /// Its place on the rope.
    pub fn on_rope(&self, place: impl Fn(usize) -> DVec3) -> DVec3 {
        place(self.node).lerp(place(self.node + 1), self.fraction)
    }

    fn measure(&mut self, near: &Near, places: &[DVec3]) {
        let place = self.on_rope(|node| places[node]);
        self.touch = None;
        if self.out_of_reach(place) {
            return;
        }
        if let Some((distance, pair, barycentric)) = self.nearest(near, place, 0.0, f64::INFINITY) {
            self.seen = Some((place, distance));
            self.touch = self.touch_of(near, place, (distance, pair, barycentric));
        }
    }

    /// What it touches with the rope moved by `step` from the places measured last.
    pub fn touch_moved(&self, near: &Near, place: DVec3, step: DVec3) -> Option<Touch> {
        let (place, moved) = (place + step, step.length());
        if self.out_of_reach(place) {
            return None;
        }
        let nearest = self.nearest(near, place, moved, self.reach)?;
        self.touch_of(near, place, nearest)
    }

    fn touch_of(&self, near: &Near, place: DVec3, (distance, pair, barycentric): (f64, usize, [f64; 3])) -> Option<Touch> {
        let press = Press::new(distance, self.reach, self.stiffness);
        (press.force > 0.0).then(|| {
            let foot = on_triangle(near.pairs[pair].now, barycentric);
            let normal = (place - foot) / distance.max(1e-12);
            Touch { pair, barycentric, place, normal, distance, press }
        })
    }

    /// Whether it cannot touch, from where it was last measured.
    fn out_of_reach(&self, place: DVec3) -> bool {
        self.seen.is_some_and(|(seen, distance)| distance - seen.distance(place) > self.reach)
    }

    /// The nearest triangle within `most`, with the rope moved by at most `moved` since pairs were bounded.
    fn nearest(&self, near: &Near, place: DVec3, moved: f64, most: f64) -> Option<(f64, usize, [f64; 3])> {
        let mut best: Option<(f64, usize, [f64; 3])> = None;
        let mut least = most;
        for index in self.pairs.clone() {
            let pair = &near.pairs[index];
            if pair.clear - moved >= least {
                continue;
            }
            let (distance, barycentric) = point_triangle(place, pair.now);
            if distance < least {
                least = distance;
                best = Some((distance, index, barycentric));
            }
        }
        best
    }

    /// A slot at the piece's closest point, where that is clearly nearer than this one.
    fn second(&self, near: &Near, places: &[DVec3]) -> Option<Self> {
        let (_, middle) = self.seen?;
        let share = 0.5 * self.length / self.segment_length;
        let (from, to) = (self.fraction - share, self.fraction + share);
        let ends = [from, to].map(|fraction| places[self.node].lerp(places[self.node + 1], fraction));
        if middle - 0.5 * ends[0].distance(ends[1]) > LOOK_WITHIN * self.reach {
            return None;
        }
        let mut least = (NEARER * middle).min(LOOK_WITHIN * self.reach);
        let mut along = None;
        for pair in near.pairs[self.pairs.clone()].iter() {
            if pair.clear >= least {
                continue;
            }
            let nearest = segment_triangle(ends, pair.now);
            if nearest.distance < least {
                least = nearest.distance;
                along = Some(nearest.fraction);
            }
        }
        let fraction = from + (to - from) * along?;
        Some(Self { site: self.site | 1, fraction, seen: None, touch: None, ..self.clone() })
    }
}
