//! One solver step of rope near skin: the pairs that may touch in it, and the check of its path.
//!
//! The iterations are free to move anywhere; what is checked is the straight path from the start of the step to its end. It is proved
//! free by the bound of the move of a segment relative to its skin, else by additive continuous collision detection (`geometry/sweep.rs`),
//! and checked by an exact test (`geometry/crossing.rs`).

use glam::DVec3;
use pulp::{Simd, WithSimd};

use crate::contact::rope_on_skin::near::{Group, Near};
use crate::geometry::crossing::first_meeting;
use crate::geometry::distance::{Nearest, segment_triangle};
use crate::geometry::placed::on_triangle;
use crate::geometry::sweep::{SweptSegment, safe_fraction_from, triangle_at};
use crate::simd::lesser;

/// Margin of the search beyond the reach of rope and its move [m].
const SEARCH_M: f64 = 1.5e-3;
/// Factor on the predicted move in the search.
const SEARCH_MOVES: f64 = 1.5;
/// Longest predicted move in the search [m].
const LONGEST_MOVE_M: f64 = 0.02;
/// Travel since a distance was measured beyond which it is measured again [m].
const STALE_M: f64 = 5e-4;

/// Share of its radius to which rope may approach skin by its velocity before its predictor is projected.
const HELD_OFF_SHARE: f64 = 0.3;

/// How far a place lies from the straight path between two others [m].
fn away(from: DVec3, to: DVec3, place: DVec3) -> f64 {
    let path = to - from;
    let along = ((place - from).dot(path) / path.length_squared().max(1e-30)).clamp(0.0, 1.0);
    (place - from - path * along).length()
}

/// Pairs whose bounds are computed together.
const TOGETHER: usize = 4;

/// Finds the pairs that may touch, with the instructions of the processor.
struct FindActive<'a> {
    near: &'a mut Near,
    path: (&'a [DVec3], &'a [DVec3]),
    goal: f64,
}

impl WithSimd for FindActive<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.near.find_active_on(self.path, self.goal);
    }
}

/// The least of the bounds of pairs measured together, if all are above `look`; `None` for fewer pairs.
#[inline(always)]
fn least_beyond((gap_bound, measured_at): (&[f64], &[f64]), moved: f64, look: f64) -> Option<f64> {
    let (gaps, at) = (gap_bound.first_chunk::<TOGETHER>()?, measured_at.first_chunk::<TOGETHER>()?);
    let bounds: [f64; TOGETHER] = std::array::from_fn(|lane| gaps[lane] - (moved - at[lane]));
    let beyond = bounds.iter().fold(true, |all, bound| all & (*bound > look));
    let least = lesser(lesser(bounds[0], bounds[1]), lesser(bounds[2], bounds[3]));
    beyond.then_some(least)
}

impl Near {
    /// Moves skin to the end of a solver step, and finds the pairs that may touch on the path of rope to its predictor.
    pub fn find_active(&mut self, from: &[DVec3], to: &[DVec3], goal: f64) {
        self.arch.dispatch(FindActive { near: self, path: (from, to), goal });
    }

    #[inline(always)]
    fn find_active_on(&mut self, (from, to): (&[DVec3], &[DVec3]), goal: f64) {
        (self.start, self.goal) = (self.fraction, goal);
        self.active.clear();
        let share = goal - self.start;
        for group in &mut self.groups {
            // Without sweeps only what is near at the start of the step is found.
            group.moving = if self.swept { group.relative_move(from, to, share) } else { 0.0 };
            let look = group.reach + SEARCH_M + SEARCH_MOVES * group.moving.min(LONGEST_MOVE_M);
            let first = self.active.len();
            (group.active, group.far) = (first..first, group.clear - group.moved);
            if group.far > look {
                continue;
            }
            let segment = [from[group.node], from[group.node + 1]];
            let (mut least, mut far) = (f64::INFINITY, f64::INFINITY);
            for begin in group.pairs.clone().step_by(TOGETHER) {
                let pairs = begin..group.pairs.end.min(begin + TOGETHER);
                let measured = (&self.gap_bound[pairs.clone()], &self.measured_at[pairs.clone()]);
                let beyond = least_beyond(measured, group.moved, look);
                if let Some(bound) = beyond {
                    far = lesser(far, bound);
                    continue;
                }
                for index in pairs {
                    let debt = group.moved - self.measured_at[index];
                    let mut bound = self.gap_bound[index] - debt;
                    let pair = &mut self.pairs[index];
                    if bound <= look && (debt > STALE_M || !pair.exact) {
                        let skin = &mut self.skin[pair.skin];
                        skin.stand(self.start);
                        let gap = skin.gap(segment);
                        pair.exact = gap <= look;
                        bound = if pair.exact { skin.nearest_to(segment).distance } else { gap };
                        (self.gap_bound[index], self.measured_at[index]) = (bound, group.moved);
                    }
                    if bound <= look {
                        least = least.min(bound);
                        self.active.push(index);
                    } else {
                        far = far.min(bound);
                    }
                }
            }
            (group.clear, group.far) = (least.min(far) + group.moved, far);
            group.active = first..self.active.len();
        }
        for index in &self.active {
            self.skin[self.pairs[*index].skin].stand(goal);
        }
    }

    /// Whether anything may touch in the solver step.
    pub fn may_touch(&self) -> bool {
        !self.active.is_empty()
    }

    /// Updates the moves of segments to the trial.
    pub fn follow(&mut self, from: &[DVec3], to: &[DVec3]) {
        let share = self.goal - self.start;
        for group in self.groups.iter_mut().filter(|group| !group.active.is_empty()) {
            group.moving = group.relative_move(from, to, share);
        }
    }

    /// Ends the solver step if its path is free; returns the number of crossings that an exact test finds. `None` if it may lead
    /// through skin, or came near skin that is not active.
    pub fn end(&mut self, from: &[DVec3], to: &[DVec3]) -> Option<u64> {
        let share = self.goal - self.start;
        let mut crossings = 0;
        for index in 0..self.groups.len() {
            let moving = self.groups[index].relative_move(from, to, share);
            let group = &mut self.groups[index];
            group.moving = moving;
            if !self.swept {
                crossings += self.crossings_of(index, (from, to));
                continue;
            }
            if group.far - moving < group.reach {
                return None;
            }
            for place in self.groups[index].active.clone() {
                crossings += self.check(index, self.active[place], (from, to))?;
            }
        }
        for group in &mut self.groups {
            group.moved += group.moving;
            group.moving = 0.0;
        }
        self.fraction = self.goal;
        Some(crossings)
    }

    /// Crossings found on the path of a group with all its pairs.
    fn crossings_of(&self, group: usize, (from, to): (&[DVec3], &[DVec3])) -> u64 {
        let Group { node, ref pairs, .. } = self.groups[group];
        let segment =
            SweptSegment { a0: from[node], b0: from[node + 1], a1: to[node], b1: to[node + 1] };
        let met = self.pairs[pairs.clone()].iter().filter(|pair| {
            let sweep = &self.skin[pair.skin].sweep;
            let triangle = [triangle_at(sweep, self.start), triangle_at(sweep, self.goal)];
            first_meeting(&segment, &triangle).is_some()
        });
        met.count() as u64
    }

    /// Crossings found on the path of a pair; `None` where it is not free.
    fn check(
        &mut self,
        group: usize,
        index: usize,
        (from, to): (&[DVec3], &[DVec3]),
    ) -> Option<u64> {
        let group = &self.groups[group];
        let bound = self.gap_bound[index] - (group.moved - self.measured_at[index]);
        if bound - group.min_separation > group.moving {
            return Some(0);
        }
        let pair = &mut self.pairs[index];
        let skin = &self.skin[pair.skin];
        let triangle = [triangle_at(&skin.sweep, self.start), triangle_at(&skin.sweep, self.goal)];
        let node = group.node;
        let segment =
            SweptSegment { a0: from[node], b0: from[node + 1], a1: to[node], b1: to[node + 1] };
        let gap = segment_triangle(segment.at(0.0), triangle[0]).distance;
        pair.exact = true;
        (self.gap_bound[index], self.measured_at[index]) = (gap, group.moved);
        if safe_fraction_from(&segment, &triangle, group.min_separation, gap) < 1.0 {
            return None;
        }
        Some(u64::from(first_meeting(&segment, &triangle).is_some()))
    }

    /// Whether any segment's end lies farther than `most_m` from the straight path by which its pairs were gathered.
    pub fn strayed(&self, places: &[DVec3], most_m: f64) -> bool {
        // Half of it from where the path begins is near the path, whatever the rounding.
        let near = 0.25 * most_m * most_m.abs();
        let strays = |from: DVec3, to: DVec3, place: DVec3| {
            place.distance_squared(from) > near && away(from, to, place) > most_m
        };
        let mut last = None;
        for (sweep, node) in self.sweeps.iter().zip(&self.segment_node) {
            // If the segment before ends at its first node, that node has been tested.
            let begins = last != Some(*node);
            if (begins && strays(sweep.a0, sweep.a1, places[*node]))
                || strays(sweep.b0, sweep.b1, places[*node + 1])
            {
                return true;
            }
            last = Some(*node + 1);
        }
        false
    }

    /// Removes from the move `from` → `target` of a solver step the part that brings rope closer to skin than its radius, or than it is.
    pub fn hold_off(&self, from: &[DVec3], target: &mut [DVec3]) {
        if !self.swept {
            return;
        }
        let share = self.goal - self.start;
        let near = |group: &&Group| {
            !group.active.is_empty()
                && group.clear - group.moved - group.moving < HELD_OFF_SHARE * group.radius
        };
        for group in self.groups.iter().filter(near) {
            let segment = [from[group.node], from[group.node + 1]];
            let mut best: Option<(usize, Nearest)> = None;
            for index in &self.active[group.active.clone()] {
                let skin = self.skin_of(*index);
                let nearest = segment_triangle(segment, triangle_at(&skin.sweep, self.start));
                if best.is_none_or(|(_, found)| nearest.distance < found.distance) {
                    best = Some((*index, nearest));
                }
            }
            let Some((index, nearest)) = best else { continue };
            let skin = self.skin_of(index);
            let between = |at: &[DVec3]| at[group.node].lerp(at[group.node + 1], nearest.fraction);
            let closest = on_triangle(triangle_at(&skin.sweep, self.start), nearest.barycentric);
            let normal = (between(from) - closest) / nearest.distance.max(1e-12);
            let skin_move = skin.move_of(nearest.barycentric) * share;
            let approach = normal.dot(skin_move - (between(target) - between(from)));
            let too_near = approach - (nearest.distance - group.radius).max(0.0);
            if too_near > 0.0 {
                target[group.node] += normal * too_near;
                target[group.node + 1] += normal * too_near;
            }
        }
    }
}
