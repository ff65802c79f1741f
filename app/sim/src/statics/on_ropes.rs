//! Rope that would lie in other rope at rest: it is moved beside it.
//!
//! Statics finds lines that pass through each other. An endline at slack water hangs in one vertical plane, its sinking part below
//! the floating one where they meet, and so in that rope. Across the plane nothing holds it, so that the two lie beside each other at rest.
//! Where two segments are nearer than the sum `h` of their radii, both are moved by half of what lacks along the common normal
//! of their directions, and the rope to either side of them less and less, `δ (1 + cos(π a / A))/2` at the arc `a`, as far as
//! the arc `A`. Segments then have their lengths drawn in again, for a few millimetres aside stretch a short one by hundreds of newtons.
//! The sign of the normal is the same everywhere (its greatest part is positive): the strand that comes first along
//! the lines lies on one side wherever they meet, so that the two do not wind round each other.
//! Rope on the seabed and beside traps and anchors stays, for it lies on them. All stays where that does not part what lies in
//! each other, as a stowed coil, where a segment would lose its length, or where rope would come to lie in a body: it
//! touches at the distance it has.

use std::f64::consts::PI;

use glam::DVec3;

use super::outcome::Outcome;
use super::{Found, lengths};
use crate::broad_phase::pieces::Pieces;
use crate::broad_phase::ropes::Reach;
use crate::broad_phase::ropes::{Broad, Found as Near, Moves, Rope as Searched};
use crate::geometry::distance::segment_segment;
use crate::model::{Body, BodyRole, Model, PlacedShape, Seabed};
use crate::solids::lies_in_body;
use crate::state::State;
use crate::strands::{Place, Strands};

/// How often what still overlaps is moved.
const ROUNDS: usize = 40;
/// Arc to either side that goes along, in diameters, where there is so much rope.
const ALONG_DIAMETERS: f64 = 200.0;
/// Share of its length by which a segment may then be longer or shorter: a ten-thousandth of the stretch at which rope breaks.
const CLOSE: f64 = 2e-5;
/// Distance to which ropes are moved apart, over the sum of their radii [1].
const APART: f64 = 1.02;
/// Distance from the seabed, a trap or an anchor, and rope to it, within which rope stays where it is [m].
const BESIDE_BODY_M: f64 = 0.5;
/// Rope along a strand from one place to another below which the two are neighbours, in sums of radii.
const BESIDE: f64 = 4.0;

/// Moves rope out of other rope, where ropes touch each other and the gear is at rest.
pub(super) fn part(model: &Model, found: &mut Found) {
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

/// The search for rope near rope, as a step has it.
struct Search {
    pieces: Pieces,
    broad: Broad,
    near: Near,
    /// Diameter of the widest rope: the greatest sum of two radii [m].
    reach_m: f64,
}

impl Search {
    fn new(model: &Model) -> Self {
        let reach_m = model.spec.ropes.iter().map(|rope| rope.diameter_m).fold(0.0, f64::max);
        let (broad, near) = (Broad::default(), Near::default());
        Self { pieces: Pieces::new(model), broad, near, reach_m }
    }

    /// Pairs of segments that may lie in each other.
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

/// The gear's rope as strands: lines spliced end to end count as one.
struct Rope {
    strands: Strands,
    /// The nodes along each strand; at a splice both copies of one.
    chains: Vec<Vec<Vec<usize>>>,
    /// First node and radius of each segment [m].
    segments: Vec<(usize, f64)>,
    /// Length of each strand [m].
    lengths_m: Vec<f64>,
    /// Length of each segment at rest, stretched as it is there [m].
    at_rest_m: Vec<f64>,
    /// Places along each strand that are on the seabed or beside a trap or anchor.
    beside_bodies: Vec<Vec<bool>>,
}

/// Two segments that lie in each other.
struct Overlap {
    segments: [usize; 2],
    /// Where they are nearest, along their strands [m].
    arcs_m: [f64; 2],
    /// What to move the first by; the second by its opposite [m].
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

    /// Places along each strand that are on the seabed or beside a trap or anchor.
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

    /// Arcs of the nodes along a strand [m].
    fn arcs(&self, strand: usize) -> impl Iterator<Item = f64> + '_ {
        let mut arc_m = 0.0;
        std::iter::once(0.0).chain(self.strands.lists()[strand].iter().map(move |segment| {
            arc_m += self.strands.places[*segment].length_m;
            arc_m
        }))
    }

    /// Rope of a strand from an arc to where it is next beside a body [m].
    fn to_body_m(&self, strand: usize, arc_m: f64) -> f64 {
        let along =
            self.arcs(strand).zip(&self.beside_bodies[strand]).filter(|(_, beside)| **beside);
        let along = along.map(|(body_m, _)| (body_m - arc_m).abs());
        along.fold(f64::INFINITY, f64::min)
    }

    /// Every pair that lies in each other.
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
        // Neighbours of one strand always lie near each other, and so do strands that end at one place.
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
        // The distance along the normal that takes the two as far apart as they should be.
        let apart = APART * reach;
        let wanted = (apart * apart - sideways).max(0.0).sqrt();
        let side = if along < -1e-3 * reach { -1.0 } else { 1.0 };
        let lacks = (wanted - side * along).max(0.0);
        Some(Overlap { segments: pair, arcs_m, shift_m: 0.5 * lacks * side * normal })
    }

    /// Moves both strands of a pair, each with the rope beside it, if the two still lie in each other: where strands hang along
    /// each other, the first of a hundred pairs takes most others along.
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

    /// Moves the rope of a strand about a place, less and less away from it; both copies of a node at a splice alike.
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
    /// Whether every segment is as long as at rest, but for [`CLOSE`].
    fn has_its_lengths(&self, state: &State) -> bool {
        let at = &state.rope.position;
        let error = |(segment, wanted_m): (&(usize, f64), &f64)| {
            (at[segment.0].distance(at[segment.0 + 1]) - wanted_m).abs() / wanted_m
        };
        self.segments.iter().zip(&self.at_rest_m).map(error).fold(0.0, f64::max) < CLOSE
    }

    /// Gives every segment its length at rest again. Ends of strands stay, and so does rope beside bodies.
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
            lengths::restore(&wanted_m, &may_move, &mut places);
            for (nodes, place) in chain.iter().zip(&places) {
                nodes.iter().for_each(|node| state.rope.position[*node] = *place);
            }
        }
    }
}

/// Height of a place above the seabed [m]; without end where there is none.
fn above_seabed_m(model: &Model, at: DVec3) -> f64 {
    let height =
        |seabed: &Seabed| at.dot(seabed.normal) / seabed.normal.z + model.spec.water.depth_m;
    model.spec.seabed.as_ref().map_or(f64::INFINITY, height)
}

/// Distance of a place in a body's frame from the boxes round its parts [m].
fn distance_m(body: &Body, place: DVec3) -> f64 {
    let from_part = |part: &PlacedShape| {
        ((place - part.middle_m).abs() - part.shape.half_m()).max(DVec3::ZERO).length()
    };
    body.parts.iter().map(from_part).fold(f64::INFINITY, f64::min)
}

/// The nodes along a strand; at a splice both copies of one.
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

/// Unit normal to two directions, its greatest part positive; any across the first where they are one.
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
