//! Moves of rope near skin in the passes of a searching Newton: carried along, cut short where they would cross, and made.

use std::ops::Range;

use glam::DVec3;

use super::{EXACT_M, Near, Pair};
use crate::contact::crossing::first_meeting;
use crate::contact::distance::Nearest;
use crate::contact::sweep::{
    SweptSegment, SweptTriangle, greatest_approach, safe_fraction_from, triangle_at,
};

/// Rope is carried along with skin nearer than this wholly, beyond the next not at all [m].
const CARRIED_M: (f64, f64) = (0.015, 0.04);

/// A triangle that stays where it is.
const STILL: SweptTriangle = [[DVec3::ZERO; 3]; 2];

impl Near {
    /// Where rope goes when it is carried along as the skin makes the rest of its move: written into `target`.
    pub fn carry(&self, places: &[DVec3], target: &mut [DVec3]) {
        for group in &self.groups {
            let Some((pair, nearest)) = self.nearest(places, group.pairs.clone()) else { continue };
            let share =
                ((CARRIED_M.1 - nearest.distance) / (CARRIED_M.1 - CARRIED_M.0)).clamp(0.0, 1.0);
            let skin = &self.skin[pair.skin];
            let skin_move = skin.move_of(nearest.barycentric) * (self.goal - self.fraction);
            for node in [pair.node, pair.node + 1] {
                let carried = places[node] + skin_move;
                target[node] = target[node].lerp(carried, share);
            }
        }
    }

    fn nearest(&self, places: &[DVec3], range: Range<usize>) -> Option<(&Pair, Nearest)> {
        let mut best: Option<(&Pair, Nearest)> = None;
        for pair in &self.pairs[range] {
            if best.is_some_and(|(_, nearest)| pair.gap_bound >= nearest.distance) {
                continue;
            }
            let nearest =
                self.skin[pair.skin].nearest_to([places[pair.node], places[pair.node + 1]]);
            if best.is_none_or(|(_, found)| nearest.distance < found.distance) {
                best = Some((pair, nearest));
            }
        }
        best
    }

    /// Largest share of the move `places` → `target`, while the skin goes to `skin_to` of its step, along
    /// which nothing crosses.
    pub fn safe_share(
        &mut self,
        places: &[DVec3],
        target: impl Fn(usize) -> DVec3,
        skin_to: f64,
    ) -> f64 {
        let mut share = 1.0_f64;
        if !self.swept {
            return share;
        }
        let skin_share = skin_to - self.fraction;
        for group in &self.groups {
            let segment = self.pairs[group.pairs.start].sweep_of(places, &target);
            let (moved, alone) = (greatest_move(&segment), greatest_approach(&segment, &STILL));
            for pair in &mut self.pairs[group.pairs.clone()] {
                let skin = &self.skin[pair.skin];
                if pair.gap_bound - pair.min_separation > moved + skin.longest_move * skin_share {
                    continue;
                }
                let triangle = [
                    skin.now,
                    if skin_share > 0.0 { triangle_at(&skin.sweep, skin_to) } else { skin.now },
                ];
                let approach =
                    if skin_share > 0.0 { greatest_approach(&segment, &triangle) } else { alone };
                if pair.gap_bound - pair.min_separation > approach {
                    continue;
                }
                if !pair.exact {
                    (pair.gap_bound, pair.exact) =
                        (skin.nearest_to(segment.at(0.0)).distance, true);
                }
                share = share.min(safe_fraction_from(
                    &segment,
                    &triangle,
                    pair.min_separation,
                    pair.gap_bound,
                ));
            }
        }
        share
    }

    /// Makes the move `places` → `target`: skin goes to `skin_to` of its step, bounds of distance shrink by what
    /// moved. Gives the number of crossings an exact test finds on the way.
    pub fn make_move(
        &mut self,
        places: &[DVec3],
        target: impl Fn(usize) -> DVec3,
        skin_to: f64,
    ) -> u64 {
        let skin_share = skin_to - self.fraction;
        self.skin.iter_mut().for_each(|skin| skin.go(skin_to));
        let mut crossings = 0;
        for group in &self.groups {
            let segment = self.pairs[group.pairs.start].sweep_of(places, &target);
            let (moved, alone) = (greatest_move(&segment), greatest_approach(&segment, &STILL));
            for pair in &mut self.pairs[group.pairs.clone()] {
                let skin = &self.skin[pair.skin];
                let most = moved + skin.longest_move * skin_share;
                if pair.gap_bound > most + EXACT_M {
                    (pair.gap_bound, pair.exact) = (pair.gap_bound - most, false);
                    continue;
                }
                let triangle = [skin.before, skin.now];
                let approach =
                    if skin_share > 0.0 { greatest_approach(&segment, &triangle) } else { alone };
                if pair.gap_bound > approach {
                    (pair.gap_bound, pair.exact) = (pair.gap_bound - approach, false);
                    continue;
                }
                (pair.gap_bound, pair.exact) = (skin.nearest_to(segment.at(1.0)).distance, true);
                crossings += u64::from(first_meeting(&segment, &triangle).is_some());
            }
        }
        self.fraction = skin_to;
        crossings
    }
}

impl Pair {
    fn sweep_of(&self, places: &[DVec3], target: impl Fn(usize) -> DVec3) -> SweptSegment {
        SweptSegment {
            a0: places[self.node],
            b0: places[self.node + 1],
            a1: target(self.node),
            b1: target(self.node + 1),
        }
    }
}

/// The longer move of a segment's two ends [m].
fn greatest_move(segment: &SweptSegment) -> f64 {
    (segment.a1 - segment.a0)
        .length_squared()
        .max((segment.b1 - segment.b0).length_squared())
        .sqrt()
}
