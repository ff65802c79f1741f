//! Bending of rope: an elastic hinge at each inner node of a line.
//!
//! Node `i` between segments of unstretched lengths `l₋`, `l₊` with end-to-end vectors `e₋`, `e₊` has the turn
//! `g = e₊/l₊ - e₋/l₋` and the energy `½ c |g|²`, `c = EI/L`, `L = ½(l₋ + l₊)`. Where rope is not stretched
//! `|g|² = 2 - 2 cos θ`, with `θ = κL` the angle between the segments, so that the energy tends to `½ EI κ² L` with the
//! square of the segment. The force is `-c g` times `1/l₊`, `-(1/l₊ + 1/l₋)`, `1/l₋` on the nodes `i+1`, `i`, `i-1`.
//! A line's ends are hinges, at bodies, fixtures and joints alike, and so is a cut.
//!
//! The energy is a square, so its derivative `H = c d dᵀ` is constant, but couples three nodes. The matrix holds instead
//! `B = c (a aᵀ + b bᵀ)`, with `a`, `b` the rows of `e₊/l₊` and `e₋/l₋` and `d = a - b`: it couples neighbours only, and
//! `H ⪯ 2B` as `|a - b|² ≤ 2|a|² + 2|b|²`. With `A` all the rest of the matrix, a pass `(A + B) δ = r` lowers the
//! energy by `δᵀ(A + B)δ - ½ δᵀ(A + H)δ ≥ ½ δᵀAδ`: it converges whatever the bending stiffness and never overshoots into
//! instability, and as the force is exact, to the exact balance. It converges slowly only where bending outweighs inertia,
//! tension and drag together, `EI/l³` against `m l/h²` and `T/l`; a step that takes too many passes is halved.
//! Reference: Bergou et al. 2008, Discrete elastic rods (doi:10.1145/1360612.1360662), in this simpler energy.

use glam::{DMat3, DVec3};

use crate::forces::Forces;
use crate::model::Model;
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::Trial;

/// An inner node of a line that resists bending.
struct Hinge {
    node: usize,
    /// Segment before the node; the other is the next.
    before: usize,
    /// `c` [N m].
    stiffness: f64,
    /// `1/l₋` and `1/l₊` [1/m].
    inverse: [f64; 2],
}

impl Hinge {
    /// `g` of vectors at the nodes: of places the turn, of moves its change.
    fn turn(&self, at: &[DVec3]) -> DVec3 {
        (at[self.node + 1] - at[self.node]) * self.inverse[1]
            - (at[self.node] - at[self.node - 1]) * self.inverse[0]
    }

    /// Adds its forces to those on the nodes.
    fn push(&self, place: &[DVec3], force: &mut [DVec3]) {
        let pull = self.turn(place) * self.stiffness;
        let [before, after] = self.inverse;
        force[self.node - 1] -= pull * before;
        force[self.node] += pull * (before + after);
        force[self.node + 1] -= pull * after;
    }
}

/// Energy of bending [J].
pub(crate) fn bending_energy(model: &Model, state: &State) -> f64 {
    let (rope, mut energy) = (&state.rope, 0.0);
    each_hinge(model, &rope.cut, &rope.segment_length, |hinge| {
        energy += 0.5 * hinge.stiffness * hinge.turn(&rope.position).length_squared();
    });
    energy
}

impl Forces {
    /// Adds the force of every hinge and its blocks.
    pub(crate) fn add_bending(&self, model: &Model, trial: &Trial, system: &mut LinearSystem) {
        let tridiagonal = &mut system.rope;
        each_hinge(model, &self.cut, &self.lengths.segment, |hinge| {
            hinge.push(&trial.place, &mut tridiagonal.force);
            let [before, after] = hinge.inverse;
            for (segment, node, inverse) in
                [(hinge.before, hinge.node, before), (hinge.before + 1, hinge.node + 1, after)]
            {
                let block = DMat3::from_diagonal(DVec3::splat(hinge.stiffness * inverse * inverse));
                tridiagonal.diagonal[node - 1] += block;
                tridiagonal.diagonal[node] += block;
                tridiagonal.up[segment] -= block;
                tridiagonal.low[segment] -= block;
            }
        });
    }

    /// Adds the force of every hinge alone.
    pub(crate) fn push_hinges(&self, model: &Model, trial: &Trial, force: &mut [DVec3]) {
        each_hinge(model, &self.cut, &self.lengths.segment, |hinge| {
            hinge.push(&trial.place, force);
        });
    }

    /// Slope of the energy of bending along the solved step, a share of it taken.
    pub(crate) fn bending_slope(
        &self,
        model: &Model,
        (trial, system): (&Trial, &LinearSystem),
        share: f64,
    ) -> f64 {
        let mut slope = 0.0;
        each_hinge(model, &self.cut, &self.lengths.segment, |hinge| {
            let change = hinge.turn(&system.rope.step);
            slope += hinge.stiffness * (hinge.turn(&trial.place) + change * share).dot(change);
        });
        slope
    }
}

/// Does something at every hinge of every line whose rope resists bending.
fn each_hinge(model: &Model, cut: &[bool], lengths_m: &[f64], mut act: impl FnMut(&Hinge)) {
    for (index, line) in model.spec.lines.iter().enumerate() {
        let bending = model.spec.ropes[line.rope].bending_stiffness_n_m2;
        if bending <= 0.0 {
            continue;
        }
        let (segments, nodes) = (&model.line_segments[index], &model.line_nodes[index]);
        for (before, node) in (segments.start..segments.end - 1).zip(nodes.start + 1..) {
            if cut[before] || cut[before + 1] {
                continue;
            }
            let (behind, ahead) = (lengths_m[before], lengths_m[before + 1]);
            let stiffness = 2.0 * bending / (behind + ahead);
            act(&Hinge { node, before, stiffness, inverse: [1.0 / behind, 1.0 / ahead] });
        }
    }
}
