//! Rope near skin: pairs of segment and triangle that may touch within a solver step, and how far
//! rope may move without crossing.
//!
//! The invariant is that the rope's centre line never crosses the skin: the path of every solver step, of rope and skin together, is
//! proved free by additive continuous collision detection (`sweep.rs`), and checked again by an independent exact test (`crossing.rs`).

mod group;
mod solver_step;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use pulp::{Arch, Simd, WithSimd};

use crate::broad_phase::pieces::Pieces;
use crate::geometry::distance::segment_triangle;
use crate::geometry::placed::Placed;
use crate::geometry::sweep::{SweptSegment, triangle_at};
use crate::model::Model;
use crate::whale::{Bounds, Candidate, SkinTree, Surface};
pub(crate) use group::Group;
use group::SkinMove;

/// Distance from the path of skin within which rope is gathered [m].
pub(crate) const MARGIN_M: f64 = 0.04;

/// A segment and a triangle that may touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub segment: usize,
    /// Place of the triangle in [`Near::skin`].
    skin: usize,
    /// Whether `Near::gap_bound` was their distance.
    exact: bool,
}

/// All pairs of a step of the model, in rising order of segment, with their surface.
///
/// Skin moves straight from the start of the model's step to its end; a solver step moves it from the share `start` to `goal`.
#[derive(Clone, Debug)]
pub(crate) struct Near {
    arch: Arch,
    surface: Surface,
    sweeps: Vec<SweptSegment>,
    candidates: Vec<Candidate>,
    /// Triangles that have pairs.
    skin: Vec<Placed>,
    /// Their moves over the model's step.
    skin_moves: Vec<SkinMove>,
    /// Where each triangle of the skin lies among them, with the number of the step for which that holds.
    placed_at: Vec<(u64, usize)>,
    number: u64,
    pub pairs: Vec<Pair>,
    /// Lower bound of the distance of each pair when it was measured [m].
    gap_bound: Vec<f64>,
    /// How far the group of each pair had moved relative to its skin by then [m].
    measured_at: Vec<f64>,
    /// Pairs of each segment that has any.
    pub groups: Vec<Group>,
    /// Pairs that may touch in this solver step, group after group.
    pub active: Vec<usize>,
    /// First node of each segment.
    segment_node: Vec<usize>,
    /// Share of the model's step at which the solver step begins.
    pub start: f64,
    /// Share of the model's step at which the solver step ends.
    pub goal: f64,
    /// Share of the model's step up to which rope and skin have been moved.
    pub fraction: f64,
    /// How far beyond rope skin is gathered [m].
    pub margin_m: f64,
    /// Whether paths are filtered ([`Settings::swept`](crate::model::Settings::swept)).
    swept: bool,
}

impl Near {
    pub fn new(model: &Model, tree: Arc<SkinTree>) -> Self {
        let nodes = model.line_nodes.iter().flat_map(|nodes| nodes.start..nodes.end - 1);
        Self {
            arch: Arch::new(),
            skin: Vec::new(),
            skin_moves: Vec::new(),
            placed_at: vec![(0, 0); tree.skin().triangles.len()],
            number: 0,
            surface: Surface::new(tree),
            sweeps: vec![SweptSegment::default(); model.segment_count],
            candidates: Vec::new(),
            pairs: Vec::new(),
            gap_bound: Vec::new(),
            measured_at: Vec::new(),
            groups: Vec::new(),
            active: Vec::new(),
            segment_node: nodes.collect(),
            start: 0.0,
            goal: 1.0,
            fraction: 0.0,
            margin_m: MARGIN_M + model.knots.iter().map(|knot| knot.radius_m).fold(0.0, f64::max),
            swept: model.spec.settings.swept,
        }
    }

    /// Begins a search for rope that moves from `places` by `moves`, near skin that moves between two poses; its pieces are measured over
    /// that move. Returns `false` if by their boxes none comes near.
    pub fn begin_search(
        &mut self,
        bones: [&[DAffine3]; 2],
        pieces: &Pieces,
        places: &[DVec3],
        moves: impl Fn(usize) -> DVec3,
        margin: f64,
    ) -> bool {
        self.surface.begin(bones[0], bones[1]);
        let skin = self.surface.whole().grown(margin);
        let mut lines = pieces.lines.iter().filter(|(_, bounds)| skin.meets(bounds));
        if !lines
            .any(|(own, _)| pieces.pieces[own.clone()].iter().any(|one| skin.meets(&one.bounds)))
        {
            return false;
        }
        self.sweep(places, moves);
        true
    }

    /// Whether any rope of the search that was begun may come near skin.
    pub fn is_any_near(&mut self, margin: f64) -> bool {
        self.surface.is_any_near(&self.sweeps, margin)
    }

    /// The box around all skin over the step of the last search.
    pub fn whole(&mut self) -> Bounds {
        self.surface.whole()
    }

    fn sweep(&mut self, places: &[DVec3], moves: impl Fn(usize) -> DVec3) {
        for (sweep, &node) in self.sweeps.iter_mut().zip(&self.segment_node) {
            let (a0, b0) = (places[node], places[node + 1]);
            *sweep = SweptSegment { a0, b0, a1: a0 + moves(node), b1: b0 + moves(node + 1) };
        }
    }

    /// Gathers the pairs of uncut rope near skin over a step of the model, of which a share has passed.
    pub fn gather(
        &mut self,
        model: &Model,
        bones: [&[DAffine3]; 2],
        places: &[DVec3],
        moves: impl Fn(usize) -> DVec3,
        (cut, passed): (&[bool], f64),
    ) {
        self.surface.begin(bones[0], bones[1]);
        self.sweep(places, moves);
        self.gather_swept(model, (cut, passed));
    }

    /// Gathers the pairs of uncut rope near skin for the moves that were swept last.
    pub fn gather_swept(&mut self, model: &Model, (cut, passed): (&[bool], f64)) {
        self.surface.gather_keeping(&self.sweeps, self.margin_m, &mut self.candidates);
        (self.start, self.goal, self.fraction) = (passed, 1.0, passed);
        self.number += 1;
        self.skin.clear();
        self.skin_moves.clear();
        self.pairs.clear();
        self.groups.clear();
        self.active.clear();
        for place in 0..self.candidates.len() {
            let Candidate { segment, triangle } = self.candidates[place];
            let segment = segment as usize;
            if cut[segment] {
                continue;
            }
            let skin = self.place_of(triangle);
            let index = self.pairs.len();
            self.pairs.push(Pair { segment, skin, exact: false });
            match self.groups.last_mut() {
                Some(group) if group.segment == segment => group.pairs.end = index + 1,
                _ => {
                    let radius = 0.5 * model.rope_of_segment(segment).diameter_m;
                    let knots = model.knots_of_segment(segment).iter().map(|knot| knot.radius_m);
                    let reach = knots.fold(radius, f64::max);
                    let node = self.segment_node[segment];
                    self.groups.push(Group::new(segment, node, [radius, reach], index));
                }
            }
        }
        for bounds in [&mut self.gap_bound, &mut self.measured_at] {
            bounds.clear();
            bounds.resize(self.pairs.len(), 0.0);
        }
        debug_assert!(
            self.groups.windows(2).all(|two| two[0].segment < two[1].segment),
            "one group for each segment, in rising order"
        );
        self.arch.dispatch(FollowSkin {
            groups: &mut self.groups,
            pairs: &self.pairs,
            moves: &self.skin_moves,
        });
    }

    /// Where a triangle lies among those that have pairs; put there where it is new.
    fn place_of(&mut self, triangle: u32) -> usize {
        let at = &mut self.placed_at[triangle as usize];
        if at.0 != self.number {
            *at = (self.number, self.skin.len());
            let sweep = self.surface.triangle_sweep(triangle);
            self.skin.push(Placed::new(triangle, sweep, self.fraction));
            self.skin_moves.push(SkinMove::of(sweep));
        }
        at.1
    }

    /// The triangle of a pair, by the place of the pair.
    pub fn skin_of(&self, pair: usize) -> &Placed {
        &self.skin[self.pairs[pair].skin]
    }

    /// Lower bound of the distance of a group's pair at the trial [m].
    #[inline(always)]
    pub fn bound(&self, pair: usize, group: &Group) -> f64 {
        self.gap_bound[pair] - (group.moved - self.measured_at[pair]) - group.moving
    }

    /// A segment that crosses skin where a solver step begins, if any.
    pub fn crossed(&self) -> Option<usize> {
        let crosses = |pair: usize| self.pairs[pair].exact && self.gap_bound[pair] <= 0.0;
        let mut crossed = self.active.iter().filter(|pair| self.swept && crosses(**pair));
        crossed.next().map(|pair| self.pairs[*pair].segment)
    }

    /// Returns to the start of a rejected solver step; if its path had been ended, all distances are invalidated.
    #[expect(clippy::float_cmp, reason = "the same share, to the bit, is the same place")]
    pub fn go_back(&mut self) {
        if self.fraction == self.start {
            return;
        }
        self.fraction = self.start;
        self.pairs.iter_mut().for_each(|pair| pair.exact = false);
        self.gap_bound.fill(0.0);
        self.measured_at.fill(0.0);
        for group in &mut self.groups {
            (group.clear, group.moved, group.moving) = (0.0, 0.0, 0.0);
        }
    }

    /// How far a point of rope was from the triangle of a pair where the solver step began [m].
    pub fn began_at(&self, pair: usize, place: DVec3) -> f64 {
        let skin = self.skin_of(pair);
        segment_triangle([place, place], triangle_at(&skin.sweep, self.start)).distance
    }
}

/// Sets the mean and the spread of the moves of the skin of each group, with the instructions of the processor.
struct FollowSkin<'a> {
    groups: &'a mut [Group],
    pairs: &'a [Pair],
    moves: &'a [SkinMove],
}

impl WithSimd for FollowSkin<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for group in self.groups {
            let pairs = &self.pairs[group.pairs.clone()];
            group.follow_skin(pairs.iter().map(|pair| &self.moves[pair.skin]));
        }
    }
}
