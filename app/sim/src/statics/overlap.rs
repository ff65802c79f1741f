//! Removal of overlaps at rest: rope inside bodies, and rope inside other rope.
//!
//! Rope on bodies (a bridle across its trap, a gangion beside it, a leadline over an anchor): statics first finds equilibrium
//! with rope that passes through bodies, which most gear never does. If rope is inside a body, equilibrium is found again from
//! that state with bodies that push the rope out, softly at first. If that does not converge, the rope is not changed: it is
//! treated as stowed inside the body (`contact/rope_on_solid/excluded.rs`), and contact begins after it has left the body.
//!
//! Rope in rope: statics finds lines that pass through each other. At slack water, for example, an endline hangs in one
//! vertical plane, and its sinking part passes through its floating part. No force acts across the plane, so that the two are
//! in equilibrium beside each other. If the distance of two segments is less than the sum `h` of their radii [m], each is moved
//! by half of the difference along the common normal of their directions. The rope on either side is moved by
//! `δ (1 + cos(π a/A))/2` at the arc length `a` up to the arc length `A`. The segments are then restored to their length,
//! because a move of a few millimetres changes the tension of a short segment by hundreds of newtons.
//! The sign of the normal is the same everywhere (its greatest component is positive), so that the first strand is always on
//! the same side and the two do not wind round each other. Rope on the seabed and beside traps and anchors is not moved.
//! Nothing is moved if overlaps remain, as in a stowed coil, if a segment would change its length, or if rope would move into a
//! body.
//!
//! Restoring lengths: Newton's method on the excess lengths `C` [m] with the smallest displacement per step. With `J = ∂C/∂x`
//! at the positions `x`, `x ← x - Jᵀ (J Jᵀ)⁻¹ C`; `J Jᵀ` is tridiagonal.
//! Reference: Goldenthal et al. 2007, Efficient simulation of inextensible cloth (doi:10.1145/1276377.1276438).

use std::f64::consts::PI;

use glam::DVec3;

use super::newton::{Attempt, FAR, Hold, IterationLog, Reached};
use super::strategy::{Strategy, try_all};
use super::{Found, Outcome};
use crate::broad_phase::pieces::Pieces;
use crate::broad_phase::ropes::{Broad, Found as Near, Moves, Reach, Rope as Searched};
use crate::geometry::distance::segment_segment;
use crate::model::{Body, BodyRole, Model, PlacedShape, Seabed};
use crate::solids::lies_in_body;
use crate::state::State;
use crate::strands::{Place, Strands};

/// Strategies with bodies that push: three of four shipped assemblies with rope in a body converge.
const STRATEGIES: [Strategy; 2] = [Strategy::NewtonByTurn(60), Strategy::NewtonByResidual];

/// Contact stiffness of bodies under rope, per length of rope, from soft to that of steps of 10 ms [N/m²].
const STIFFNESS_N_M2: [f64; 2] = [2e4, 2e5];

/// Finds equilibrium again with bodies that push, if rope is inside one.
pub(super) fn lift(model: &Model, found: &mut Found, log: &mut IterationLog) {
    if found.outcome != Outcome::AtRest || !lies_in_body(model, &found.end.state) {
        return;
    }
    for stiffness_n_m2 in STIFFNESS_N_M2 {
        match lifted(model, found, stiffness_n_m2, log) {
            Some(lifted) => found.end = lifted,
            None => break,
        }
    }
}

fn lifted(
    model: &Model,
    found: &Found,
    stiffness_n_m2: f64,
    log: &mut IterationLog,
) -> Option<Reached> {
    let attempt = Attempt {
        laid: &found.held,
        guess: &found.end.state,
        hold: Hold::Released,
        on_bodies_n_m2: Some(stiffness_n_m2),
        pseudo_mass: FAR,
    };
    let lifted = try_all(&STRATEGIES, model, &attempt, log);
    lifted.at_rest().then_some(lifted)
}

/// Greatest number of rounds of moves.
const ROUNDS: usize = 40;

/// Arc length on either side that is moved, in diameters, if available.
const ALONG_DIAMETERS: f64 = 200.0;

/// Greatest relative error of a segment's length: 1e-4 of the strain at which rope breaks.
const CLOSE: f64 = 2e-5;

/// Ratio of the distance after a move to the sum of the radii.
const APART: f64 = 1.02;

/// Distance from the seabed, a trap or an anchor within which rope is not moved [m].
const BESIDE_BODY_M: f64 = 0.5;

/// Arc length between two points of a strand below which they are neighbours, in sums of radii.
const BESIDE: f64 = 4.0;

/// Moves rope out of other rope, if the model has contact of rope with rope and the gear is at rest.
pub(super) fn separate(model: &Model, found: &mut Found) {
    if model.spec.settings.rope_on_rope.is_none() || found.outcome != Outcome::AtRest {
        return;
    }
    let mut search = Search::new(model);
    let rope = Rope::of(model, &found.end.state);
    let mut overlaps = rope.overlaps(&mut search, &found.end.state);
    if overlaps.is_empty() {
        return;
    }
    let mut moved = found.end.state.clone();
    for _ in 0..ROUNDS {
        for overlap in &overlaps {
            rope.push_apart(overlap.segments, &mut moved);
        }
        rope.draw_in(&mut moved);
        overlaps = rope.overlaps(&mut search, &moved);
        if overlaps.is_empty() {
            break;
        }
    }
    let is_clear = |state: &State| !lies_in_body(model, state);
    let is_apart = overlaps.is_empty() && rope.has_its_lengths(&moved);
    if is_apart && (is_clear(&moved) || !is_clear(&found.end.state)) {
        found.end.state = moved;
    }
}

/// Broad phase for rope near rope.
struct Search {
    pieces: Pieces,
    broad: Broad,
    near: Near,
    /// Greatest sum of two radii: the diameter of the thickest rope [m].
    reach_m: f64,
}

impl Search {
    fn new(model: &Model) -> Self {
        let reach_m = model.spec.ropes.iter().map(|rope| rope.diameter_m).fold(0.0, f64::max);
        let (broad, near) = (Broad::default(), Near::default());
        Self { pieces: Pieces::new(model), broad, near, reach_m }
    }

    /// Returns the pairs of segments that may overlap.
    fn pairs(&mut self, state: &State) -> &[[usize; 2]] {
        let at = &state.rope.position;
        let to = |node: usize| at[node];
        self.pieces.measure(at, to, &state.rope.segment_length);
        let reach = Reach { ropes_m: self.reach_m, knots_m: self.reach_m };
        let rope = Searched { pieces: &self.pieces, knots: &[], may_touch: &|_, _| true };
        self.broad.collect(rope, &Moves { from: at, to }, reach, reach, &mut self.near);
        &self.near.segments
    }
}

/// The gear's rope as strands of lines spliced end to end.
struct Rope {
    strands: Strands,
    /// Nodes along each strand; at a splice the nodes of both lines.
    chains: Vec<Vec<Vec<usize>>>,
    /// First node and radius of each segment [m].
    segments: Vec<(usize, f64)>,
    /// Length of each strand [m].
    lengths_m: Vec<f64>,
    /// Stretched length of each segment at rest [m].
    at_rest_m: Vec<f64>,
    /// Whether each node along each strand is on the seabed or beside a trap or anchor.
    beside_bodies: Vec<Vec<bool>>,
}

/// Two segments that overlap.
struct Overlap {
    segments: [usize; 2],
    /// Arc lengths of their nearest points along their strands [m].
    arcs_m: [f64; 2],
    /// Displacement of the first; that of the second is opposite [m].
    shift_m: DVec3,
}

impl Rope {
    fn of(model: &Model, state: &State) -> Self {
        let mut strands = Strands::new(model);
        strands.measure(&state.rope.segment_length);
        let nodes = model.line_nodes.iter().zip(&model.spec.lines);
        let segments = nodes.flat_map(|(nodes, line)| {
            let radius_m = 0.5 * model.spec.ropes[line.rope].diameter_m;
            (nodes.start..nodes.end - 1).map(move |node| (node, radius_m))
        });
        let length = |order: &Vec<usize>| {
            order.iter().map(|segment| strands.places[*segment].length_m).sum()
        };
        let lengths_m = strands.lists().iter().map(length).collect();
        let segments: Vec<(usize, f64)> = segments.collect();
        let at = &state.rope.position;
        let at_rest_m = segments.iter().map(|(node, _)| at[*node].distance(at[node + 1])).collect();
        let chains: Vec<Vec<Vec<usize>>> =
            strands.lists().iter().map(|list| chain(&strands, &segments, list)).collect();
        let beside_bodies = Vec::new();
        let rope = Self { strands, chains, segments, lengths_m, at_rest_m, beside_bodies };
        Self { beside_bodies: rope.find_bodies(model, state), ..rope }
    }

    /// Finds the nodes of each strand that are on the seabed or beside a trap or anchor.
    fn find_bodies(&self, model: &Model, state: &State) -> Vec<Vec<bool>> {
        let longest_m = self.at_rest_m.iter().copied().fold(0.0, f64::max);
        let is_beside = |nodes: &Vec<usize>| {
            let at = state.rope.position[nodes[0]];
            if above_seabed_m(model, at) < BESIDE_BODY_M {
                return true;
            }
            let mut bodies = model.spec.bodies.iter().zip(&state.bodies);
            bodies.any(|(body, now)| {
                if body.role == BodyRole::Buoy {
                    return false;
                }
                let place =
                    now.orientation.inverse() * (state.rope.position[nodes[0]] - now.position);
                distance_m(body, place) < BESIDE_BODY_M + 0.5 * longest_m
            })
        };
        self.chains.iter().map(|chain| chain.iter().map(is_beside).collect()).collect()
    }

    /// Arc lengths of the nodes along a strand [m].
    fn arcs(&self, strand: usize) -> impl Iterator<Item = f64> + '_ {
        let mut arc_m = 0.0;
        std::iter::once(0.0).chain(self.strands.lists()[strand].iter().map(move |segment| {
            arc_m += self.strands.places[*segment].length_m;
            arc_m
        }))
    }

    /// Arc length from a point of a strand to its nearest node beside a body [m].
    fn to_body_m(&self, strand: usize, arc_m: f64) -> f64 {
        let along =
            self.arcs(strand).zip(&self.beside_bodies[strand]).filter(|(_, beside)| **beside);
        let along = along.map(|(body_m, _)| (body_m - arc_m).abs());
        along.fold(f64::INFINITY, f64::min)
    }

    /// Returns all overlaps.
    fn overlaps(&self, search: &mut Search, state: &State) -> Vec<Overlap> {
        search.pairs(state).iter().filter_map(|pair| self.overlap(*pair, state)).collect()
    }

    fn overlap(&self, pair: [usize; 2], state: &State) -> Option<Overlap> {
        let at = &state.rope.position;
        let ends = pair.map(|segment| {
            let node = self.segments[segment].0;
            [at[node], at[node + 1]]
        });
        let reach = self.segments[pair[0]].1 + self.segments[pair[1]].1;
        let (s, t) = segment_segment(ends[0], ends[1]);
        let between = ends[0][0].lerp(ends[0][1], s) - ends[1][0].lerp(ends[1][1], t);
        if between.length() >= reach {
            return None;
        }
        let [one, other] = pair.map(|segment| &self.strands.places[segment]);
        let arcs_m = [one.arc_at(s), other.arc_at(t)];
        // Neighbours in one strand are always near each other, and so are strands that end at one joint.
        let is_end = |place: &Place, arc_m: f64| {
            arc_m.min(self.lengths_m[place.strand] - arc_m) < BESIDE * reach
        };
        let neighbours = if one.strand == other.strand {
            (arcs_m[1] - arcs_m[0]).abs() < BESIDE * reach || one.order.abs_diff(other.order) < 2
        } else {
            is_end(one, arcs_m[0]) && is_end(other, arcs_m[1])
        };
        let near_body = [one, other]
            .into_iter()
            .zip(arcs_m)
            .any(|(place, arc_m)| self.to_body_m(place.strand, arc_m) < BESIDE_BODY_M);
        if neighbours || near_body {
            return None;
        }
        let normal = across(ends[0][1] - ends[0][0], ends[1][1] - ends[1][0]);
        let along = between.dot(normal);
        let sideways = (between - along * normal).length_squared();
        // Distance along the normal at which the segments are `apart`.
        let apart = APART * reach;
        let wanted = (apart * apart - sideways).max(0.0).sqrt();
        let side = if along < -1e-3 * reach { -1.0 } else { 1.0 };
        let missing = (wanted - side * along).max(0.0);
        Some(Overlap { segments: pair, arcs_m, shift_m: 0.5 * missing * side * normal })
    }

    /// Moves both strands of a pair, each with the rope beside it, if the two still overlap. Where strands hang along each
    /// other, the move of one pair separates most others.
    fn push_apart(&self, pair: [usize; 2], state: &mut State) {
        let Some(overlap) = self.overlap(pair, state) else { return };
        let places = overlap.segments.map(|segment| &self.strands.places[segment]);
        let between_m = if places[0].strand == places[1].strand {
            0.5 * (overlap.arcs_m[1] - overlap.arcs_m[0]).abs()
        } else {
            f64::INFINITY
        };
        for (index, place) in places.into_iter().enumerate() {
            let (strand, middle_m) = (place.strand, overlap.arcs_m[index]);
            let diameter_m = 2.0 * self.segments[overlap.segments[index]].1;
            let to_end_m = middle_m.min(self.lengths_m[strand] - middle_m);
            let along_m = (ALONG_DIAMETERS * diameter_m)
                .min(to_end_m)
                .min(between_m)
                .min(self.to_body_m(strand, middle_m));
            let shift_m = if index == 0 { overlap.shift_m } else { -overlap.shift_m };
            self.bump(strand, (middle_m, along_m), shift_m, state);
        }
    }

    /// Moves the rope of a strand about a point, with a displacement that decreases with distance; both nodes at a splice move
    /// equally.
    fn bump(
        &self,
        strand: usize,
        (middle_m, along_m): (f64, f64),
        shift_m: DVec3,
        state: &mut State,
    ) {
        let mut moved = |node: usize, arc_m: f64| {
            let off_m = (arc_m - middle_m).abs();
            if off_m < along_m {
                let share = 0.5 * (1.0 + libm::cos(PI * off_m / along_m));
                state.rope.position[node] += share * shift_m;
            }
        };
        for (nodes, arc_m) in self.chains[strand].iter().zip(self.arcs(strand)) {
            nodes.iter().for_each(|node| moved(*node, arc_m));
        }
    }
}

impl Rope {
    /// Whether every segment has its length at rest, within [`CLOSE`].
    fn has_its_lengths(&self, state: &State) -> bool {
        let at = &state.rope.position;
        let error = |(segment, wanted_m): (&(usize, f64), &f64)| {
            (at[segment.0].distance(at[segment.0 + 1]) - wanted_m).abs() / wanted_m
        };
        self.segments.iter().zip(&self.at_rest_m).map(error).fold(0.0, f64::max) < CLOSE
    }

    /// Restores the length at rest of every segment. Ends of strands and rope beside bodies do not move.
    fn draw_in(&self, state: &mut State) {
        for (index, (strand, chain)) in self.strands.lists().iter().zip(&self.chains).enumerate() {
            let mut places: Vec<DVec3> =
                chain.iter().map(|nodes| state.rope.position[nodes[0]]).collect();
            let wanted_m: Vec<f64> =
                strand.iter().map(|segment| self.at_rest_m[*segment]).collect();
            let last = chain.len() - 1;
            let may_move: Vec<bool> = (0..=last)
                .map(|place| place > 0 && place < last && !self.beside_bodies[index][place])
                .collect();
            restore(&wanted_m, &may_move, &mut places);
            for (nodes, place) in chain.iter().zip(&places) {
                nodes.iter().for_each(|node| state.rope.position[*node] = *place);
            }
        }
    }
}

/// Height above the seabed; infinite without one [m].
fn above_seabed_m(model: &Model, at: DVec3) -> f64 {
    let height =
        |seabed: &Seabed| at.dot(seabed.normal) / seabed.normal.z + model.spec.water.depth_m;
    model.spec.seabed.as_ref().map_or(f64::INFINITY, height)
}

/// Distance of a point in a body's frame from the bounding boxes of its parts [m].
fn distance_m(body: &Body, place: DVec3) -> f64 {
    let from_part = |part: &PlacedShape| {
        ((place - part.middle_m).abs() - part.shape.half_m()).max(DVec3::ZERO).length()
    };
    body.parts.iter().map(from_part).fold(f64::INFINITY, f64::min)
}

/// Nodes along a strand; at a splice the nodes of both lines.
fn chain(strands: &Strands, segments: &[(usize, f64)], strand: &[usize]) -> Vec<Vec<usize>> {
    let mut chain: Vec<Vec<usize>> = Vec::with_capacity(strand.len() + 1);
    for segment in strand {
        let node = segments[*segment].0;
        let [first, last] =
            if strands.places[*segment].reversed { [node + 1, node] } else { [node, node + 1] };
        match chain.last_mut() {
            Some(nodes) if nodes.contains(&first) => {}
            Some(nodes) => nodes.push(first),
            None => chain.push(vec![first]),
        }
        chain.push(vec![last]);
    }
    chain
}

/// Unit normal to two directions with its greatest component positive; any normal to the first if they are parallel.
fn across(one: DVec3, other: DVec3) -> DVec3 {
    let normal = one.cross(other);
    let normal = if normal.length() > 1e-9 * one.length() * other.length() {
        normal.normalize()
    } else {
        one.any_orthonormal_vector()
    };
    let greatest = [normal.x, normal.y, normal.z]
        .into_iter()
        .max_by(|a, b| a.abs().total_cmp(&b.abs()))
        .unwrap_or(1.0);
    if greatest < 0.0 { -normal } else { normal }
}

/// Newton steps to restore lengths; each squares the error.
const PROJECTIONS: usize = 6;

/// Regularisation of the diagonal of `J Jᵀ` [1].
const SINGULAR: f64 = 1e-9;

/// Restores the target lengths of the segments of a chain by [`PROJECTIONS`] steps; `may_move` marks the nodes that may move.
fn restore(wanted_m: &[f64], may_move: &[bool], places: &mut [DVec3]) {
    debug_assert_eq!(wanted_m.len() + 1, places.len(), "one node more than segments");
    debug_assert_eq!(may_move.len(), places.len(), "one flag per node");
    for _ in 0..PROJECTIONS {
        project(wanted_m, may_move, places);
    }
}

/// One Newton step.
fn project(wanted_m: &[f64], may_move: &[bool], places: &mut [DVec3]) {
    let count = wanted_m.len();
    let free = |node: usize| f64::from(u8::from(may_move[node]));
    let along: Vec<DVec3> =
        (0..count).map(|index| (places[index + 1] - places[index]).normalize_or_zero()).collect();
    let excess = |index: usize| places[index].distance(places[index + 1]) - wanted_m[index];
    // Forward elimination; `SINGULAR` regularises a straight chain between two fixed ends.
    let (mut above, mut right) = (vec![0.0; count], vec![0.0; count]);
    for index in 0..count {
        let beside = |index: usize| -along[index].dot(along[index - 1]) * free(index);
        let mut diagonal = free(index) + free(index + 1) + SINGULAR;
        right[index] = excess(index);
        if index > 0 {
            let below = beside(index);
            diagonal -= below * above[index - 1];
            right[index] -= below * right[index - 1];
        }
        right[index] /= diagonal;
        above[index] = if index + 1 < count { beside(index + 1) / diagonal } else { 0.0 };
    }
    for index in (0..count.saturating_sub(1)).rev() {
        right[index] -= above[index] * right[index + 1];
    }
    for (index, multiplier) in right.iter().enumerate() {
        places[index] += free(index) * *multiplier * along[index];
        places[index + 1] -= free(index + 1) * *multiplier * along[index];
    }
}
